"""The tutorial draws F1 against a threshold of a pack."""
import subprocess
import sys
import unittest

from support import SOURCES, FolderTest

SCRIPT = SOURCES / "examples" / "python" / "f1_over_threshold.py"


def call(*words):
    return subprocess.run([sys.executable, SCRIPT, *map(str, words)], capture_output=True, text=True, check=False)


class TutorialTest(FolderTest):
    def test_the_table_has_a_row_for_each_value_of_the_range(self):
        stream, truth = self.houses(4)
        done = call(stream, "--truth", truth, "--steps", 4)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = done.stdout.splitlines()
        self.assertEqual([line.split()[0] for line in lines[1:-1]], ["1.000", "1.100", "1.200", "1.300"])
        self.assertTrue(lines[-1].startswith("best: 1.000 m, the pack has 1.12 m"), lines[-1])
        for line in lines[1:-1]:
            self.assertTrue(all(0 <= float(cell) <= 1 for cell in line.split()[1:]), line)

    def test_a_picture_needs_matplotlib_and_nothing_else(self):
        stream, truth = self.houses(2)
        picture = self.folder / "f1.svg"
        done = call(stream, "--truth", truth, "--steps", 3, "-o", picture)
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.assertIn("python3-matplotlib", done.stderr)
            self.skipTest("matplotlib is not installed: the table was printed without a picture")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("<svg", picture.read_text(encoding="utf-8"))
        again = self.folder / "again.svg"
        call(stream, "--truth", truth, "--steps", 3, "-o", again)
        self.assert_same_bytes(picture, again)

    def test_a_param_or_a_file_that_is_not_there_is_named(self):
        stream, truth = self.houses(1)
        self.assertIn("'widest_leef'", call(stream, "--truth", truth, "--param", "widest_leef").stderr)
        self.assertIn("E101", call(self.folder / "missing.city.json", "--truth", truth).stderr)


if __name__ == "__main__":
    unittest.main()
