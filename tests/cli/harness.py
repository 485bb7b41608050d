"""Runs the program in a temporary directory and reports its results and files. Standard library only.

    harness.py PROGRAM MODULE.Class.method     one test; exit status 77 if it was skipped
    harness.py --list MODULE...                the names of all tests, one a line
"""

import importlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
SHARED = SOURCE.parent / "shared"  # test data that is no part of the repository
PROGRAM = None


class Outcome:
    def __init__(self, process):
        self.status = process.returncode
        self.stdout = (process.stdout or b"").decode("utf-8", "replace")
        self.stderr = process.stderr.decode("utf-8", "replace")

    def json(self):
        return json.loads(self.stdout)

    def __str__(self):
        return f"exit status {self.status}\nstdout: {self.stdout[:2000]}\nstderr: {self.stderr[:2000]}"


class ProgramTest(unittest.TestCase):
    def setUp(self):
        self.directory = Path(tempfile.mkdtemp(prefix="remodel-test-"))
        self.addCleanup(shutil.rmtree, self.directory, ignore_errors=True)

    def path(self, name):
        return self.directory / name

    def write(self, name, content):
        if isinstance(content, str):
            content = content.encode()
        self.path(name).write_bytes(content)
        return name

    def run_program(self, *arguments, stdout=subprocess.PIPE, **options):
        process = subprocess.run(
            [PROGRAM, *map(str, arguments)],
            cwd=self.directory,
            stdin=subprocess.DEVNULL,
            stdout=stdout,
            stderr=subprocess.PIPE,
            timeout=300,
            **options,
        )
        return Outcome(process)

    def succeed(self, *arguments, status=0):
        outcome = self.run_program(*arguments)
        self.assertEqual(outcome.status, status, f"remodel {' '.join(map(str, arguments))}: {outcome}")
        return outcome

    def figures(self, *arguments, status=0):
        """The JSON object of a command that is to end with the status."""
        outcome = self.succeed(*arguments, "--json", status=status)
        figures = outcome.json()
        self.assertIsInstance(figures, dict)
        return figures

    def files(self):
        """Every file below the directory with its content."""
        return {
            str(path.relative_to(self.directory)): path.read_bytes() if path.is_file() else None
            for path in sorted(self.directory.rglob("*"))
        }

    def refused(self, *arguments, names, **options):
        """Asserts the properties of every refusal: exit status 2, one line that names the place, no output, and an
        unchanged directory without partial or temporary files."""
        before = self.files()
        outcome = self.run_program(*arguments, **options)
        shown = f"remodel {' '.join(map(str, arguments))}: {outcome}"
        self.assertEqual(outcome.status, 2, shown)
        self.assertEqual(outcome.stdout, "", shown)
        lines = outcome.stderr.splitlines()
        self.assertEqual(len(lines), 1, shown)
        self.assertTrue(lines[0].startswith("remodel: error: "), shown)
        self.assertIn(names, lines[0], shown)
        self.assertEqual(self.files(), before, shown)
        return lines[0]

    def assertKeys(self, figures, keys):
        missing = [key for key in keys.split() if key not in figures]
        self.assertEqual(missing, [], f"keys that are not in {sorted(figures)}")


def read_terminal(descriptor):
    """All that is shown on a pseudo-terminal until its other end is closed; closes this end."""
    shown = b""
    while True:
        try:
            shown += os.read(descriptor, 4096)
        except OSError:
            break
    os.close(descriptor)
    return shown


def shared_file(test, name):
    file = SHARED / name
    if not file.exists():
        test.skipTest(f"needs shared/{name}, which is not beside this checkout")
    return file


def names_of(suite):
    for test in suite:
        if isinstance(test, unittest.TestSuite):
            yield from names_of(test)
        else:
            yield test.id()


def main(arguments):
    global PROGRAM
    sys.path.insert(0, str(Path(__file__).resolve().parent))
    # Tests import this file as a module, which must be this instance with PROGRAM set.
    sys.modules["harness"] = sys.modules["__main__"]
    loader = unittest.TestLoader()
    if arguments[0] == "--list":
        for module in arguments[1:]:
            importlib.import_module(module)
            print(*names_of(loader.loadTestsFromName(module)), sep="\n")
        return 0
    PROGRAM = os.path.abspath(arguments[0])
    result = unittest.TextTestRunner(verbosity=2).run(loader.loadTestsFromName(arguments[1]))
    if not result.wasSuccessful() or result.testsRun == 0:
        return 1
    return 77 if result.skipped else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
