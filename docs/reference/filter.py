"""Doxygen's input filter: a header whose plain comments it then takes for documentation.

    filter.py HEADER

The headers have ordinary comments, which anybody can read. A block of comment lines documents what follows, or the file
if it is the first and an empty line follows it; a comment behind code, with the lines below it in the same column,
documents that code. Text is taken literally: characters that Doxygen would take for commands or HTML are escaped.
"""

import itertools
import re
import sys

COMMENT_LINE = re.compile(r"^(\s*)// ?(.*)$")
CODE_AND_COMMENT = re.compile(r"^(.*\S)(\s*)// ?(.*)$")
NOT_DOCUMENTED = re.compile(r"^\s*(#|}|namespace\b)")  # a comment behind these is no documentation


def literal(text):
    return re.sub(r"([\\@<>#%&$]|(?<!\w)::)", r"\\\1", text)


def is_comment(line):
    return COMMENT_LINE.match(line) is not None


def blocks(lines):
    """Runs of comment lines and single other lines."""
    for comment, run in itertools.groupby(lines, is_comment):
        run = list(run)
        yield from [run] if comment else ([line] for line in run)


def documented(lines):
    all_blocks = list(blocks(lines))
    first = next((block for block in all_blocks if is_comment(block[0])), None)
    column = None  # of the comment behind the code of the line before
    for block, following in zip(all_blocks, [*all_blocks[1:], [""]]):
        if is_comment(block[0]):
            if block is first and not following[0].strip():
                yield "/// \\file"
            for line in block:
                indent, text = COMMENT_LINE.match(line).groups()
                column = column if len(indent) == column else None
                yield f"{indent}///{'' if column is None else '<'} {literal(text)}"
            continue
        both = CODE_AND_COMMENT.match(block[0])
        if both and not NOT_DOCUMENTED.match(block[0]):
            code, space, text = both.groups()
            column = len(code) + len(space)
            yield f"{code}{space}///< {literal(text)}"
        else:
            column = None
            yield block[0]


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as header:
        print(*documented(header.read().splitlines()), sep="\n")
