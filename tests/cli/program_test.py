"""The program as such: its version, what it loads, and the ranks of MPI programs without MPI."""

import os
import re
import shutil
import subprocess

import harness


class Program(harness.ProgramTest):
    def test_a_program_without_the_page_says_how_to_build_one(self):
        outcome = self.run_program("live", "-o", "live.html")
        if outcome.status == 0:
            self.skipTest("the program has its page")
        self.assertEqual(outcome.status, 2)
        self.assertFalse(self.path("live.html").exists())
        commands = outcome.stderr.split("`")[1].split(" && ")
        self.assertEqual(commands[0], "scripts/install-dependencies program live")
        readme = (harness.SOURCE / "README.md").read_text()
        for command in commands:  # those of the README, where the page is promised
            self.assertIn(command, readme)

    def libraries(self):
        """The names of the shared libraries that the program loads."""
        process = subprocess.run([harness.PROGRAM], env={**os.environ, "LD_TRACE_LOADED_OBJECTS": "1"},
                                 capture_output=True, text=True)  # fmt: skip
        names = re.findall(r"^\s*(lib\S+?)\.so", process.stdout, re.MULTILINE)
        if not names:
            self.skipTest("the loader does not list libraries")
        return names

    def test_version_is_one_short_line_of_version_h(self):
        header = (harness.SOURCE / "include/remodel/version.h").read_text()
        version = re.search(r'#define REMODEL_VERSION "(.+)"', header)
        self.assertEqual(self.succeed("--version").stdout, version[1] + "\n")

    def test_loads_no_library_that_only_one_subcommand_needs(self):
        libraries = self.libraries()
        self.assertIn("libsqlite3", libraries)
        self.assertEqual([name for name in libraries if name.startswith(("libmpi", "libopen-"))], [])

    def test_hdf5_brings_no_network_libraries(self):
        if any(name.startswith("libhdf5") for name in self.libraries()):
            self.skipTest("HDF5 has no archive here")
        self.assertEqual([name for name in self.libraries() if name.startswith(("libcurl", "libssl", "libkrb5"))], [])

    def test_refuses_ranks_where_no_program_with_mpi_is_beside_it(self):
        alone = self.directory.parent / (self.directory.name + "-alone")
        alone.mkdir()
        self.addCleanup(shutil.rmtree, alone)
        shutil.copy(harness.PROGRAM, alone / "remodel")
        process = subprocess.run([alone / "remodel", "study", "-o", "s"], cwd=self.directory, capture_output=True,
                                 text=True, env={**os.environ, "OMPI_COMM_WORLD_SIZE": "2"})  # fmt: skip
        self.assertEqual((process.returncode, process.stdout), (2, ""), process.stderr)
        self.assertEqual(len(process.stderr.splitlines()), 1)
        self.assertIn("mpirun: found 2 MPI ranks, expected one: this program was built without MPI", process.stderr)
        self.assertEqual(self.files(), {})

    def test_help_begins_with_examples_that_work_and_fits_a_screen(self):
        text = self.succeed("--help").stdout
        self.assertLess(text.index("Examples:"), text.index("Options:"))
        self.assertLess(text.index("Examples:"), text.index("Subcommands:"))
        self.assertLessEqual(len(text.splitlines()), 50)
        examples = re.findall(r"^  remodel (.+)$", text, re.MULTILINE)
        self.assertEqual(len(examples), 4)
        for example in examples:
            self.succeed(*example.split())
        for name in ("b.vtkhdf", "cp.svg", "run/best.json"):
            self.assertTrue(self.path(name).exists(), name)
        listed = text[text.index("Subcommands:") : text.index("Exit status")].strip().splitlines()[1:]
        self.assertGreater(len(listed), 10)
        for line in listed:
            self.assertRegex(line, r"^  [a-z]+ +[A-Z]")  # a name and what it does, each in one line
