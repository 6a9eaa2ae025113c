"""Blocks of Python in pages print what the pages show."""
import doctest
import os
import pathlib
import re
import shutil
import unittest

from support import SOURCES, FolderTest

PAGES = [*(SOURCES / "docs").glob("*.md"), SOURCES / "README.md", SOURCES / "python" / "README.md"]


def blocks_of(page):
    """The blocks that are Python, each with its language and the number of its first line."""
    text = page.read_text(encoding="utf-8")
    for match in re.finditer(r"^```(python|pycon)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        yield match[1], text.count("\n", 0, match.start()) + 1, match[2]


class AnyText(doctest.OutputChecker):
    """An … matches any characters, as in blocks of the command."""

    def check_output(self, want, got, optionflags):
        return re.fullmatch(".*".join(map(re.escape, want.split("…"))), got, re.DOTALL) is not None


class PagesTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.addCleanup(os.chdir, pathlib.Path.cwd())
        shutil.copytree(SOURCES / "examples" / "samples", self.folder / "examples" / "samples")
        shutil.copy(SOURCES / "examples" / "first_pack.yaml", self.folder / "examples")
        os.chdir(self.folder)

    def run_page(self, page):
        names, said = {}, []
        runner = doctest.DocTestRunner(checker=AnyText(), verbose=False)
        for language, line, text in blocks_of(page):
            if language == "python":
                exec(compile(text, str(page), "exec"), names)
                continue
            test = doctest.DocTestParser().get_doctest(text, names, page.name, str(page), line)
            runner.run(test, out=said.append, clear_globs=False)
            names = test.globs
        self.assertEqual("".join(said), "")

    def test_every_block_prints_what_the_page_shows(self):
        pages = [page for page in PAGES if any(blocks_of(page))]
        self.assertIn("python.md", [page.name for page in pages])
        for page in pages:
            with self.subTest(page.name):
                self.run_page(page)


if __name__ == "__main__":
    unittest.main()
