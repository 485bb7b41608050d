"""Doxygen makes the reference pages without a warning, and every public header's page begins with its comment.

    reference_pages_test.py DOXYGEN DOXYFILE OUTPUT_DIRECTORY HEADERS
"""

import html
import re
import subprocess
import sys
from pathlib import Path

FILE_COMMENT = re.compile(r"\A#pragma once\n\n((?://.*\n)+)\n")


def page_of(header, output):
    return output / "html" / (header.name.replace("_", "__").replace(".", "_8") + ".html")


def words(text):
    return " ".join(text.split())


def text_of(page):
    return words(html.unescape(re.sub(r"<[^>]*>", "", page.read_text(encoding="utf-8"))))


def main(doxygen, doxyfile, output, headers):
    output.mkdir(parents=True, exist_ok=True)
    if subprocess.run([doxygen, doxyfile], stdin=subprocess.DEVNULL).returncode != 0:
        raise SystemExit("doxygen warned or failed, expected no warning")
    documented = 0
    for header in sorted(headers.glob("*.h")):
        comment = FILE_COMMENT.match(header.read_text(encoding="utf-8"))
        if comment is None:
            continue
        begin = words(comment[1].splitlines()[0].removeprefix("//"))
        if begin not in text_of(page_of(header, output)):
            raise SystemExit(f"{page_of(header, output)}: not found, expected '{begin}', the comment of {header.name}")
        documented += 1
    print(f"{documented} pages of headers")
    return 0 if documented > 0 else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3], *map(Path, sys.argv[3:5])))
