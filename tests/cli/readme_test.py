"""What the README and the documents show works."""

import re
import shlex

from harness import SOURCE, ProgramTest


def commands(document):
    """The lines of its shell blocks that run the program, without their comments."""
    for block in re.findall(r"^```sh\n(.*?)^```", (SOURCE / document).read_text(), re.MULTILINE | re.DOTALL):
        for line in block.splitlines():
            words = shlex.split(line, comments=True)
            if words[:1] == ["remodel"]:
                yield words[1:]


class Documents(ProgramTest):
    def run_all(self, document):
        (self.directory / "examples").symlink_to(SOURCE / "examples")
        all_of_it = list(commands(document))
        self.assertGreater(len(all_of_it), 4)
        for words in all_of_it:
            with self.subTest(" ".join(words)):
                self.succeed(*words)

    def test_every_command_of_the_readme(self):
        self.run_all("README.md")

    def test_every_command_of_the_guide(self):
        self.run_all("docs/guide.md")

    def test_every_command_of_the_tutorial(self):
        self.run_all("docs/tutorial.md")

    def test_every_command_of_the_page_on_morphs(self):
        self.run_all("docs/morph.md")

    def test_links_lead_somewhere(self):
        for document in ("README.md", "docs/guide.md", "docs/solvers.md", "docs/running_a_study.md", "docs/morph.md"):
            folder = (SOURCE / document).parent
            for target in re.findall(r"\]\((?!http)([^)#]+)", (SOURCE / document).read_text()):
                self.assertTrue((folder / target).exists(), f"{document}: {target}")

    def test_readme_shows_the_compiled_example(self):
        example = (SOURCE / "examples" / "example.cpp").read_text()
        begin = example.index('#include "remodel')
        self.assertIn(example[begin:].strip(), (SOURCE / "README.md").read_text())

    def test_the_film_of_the_readme_is_small(self):
        self.assertLess((SOURCE / "docs" / "film.webp").stat().st_size, 2_000_000)
