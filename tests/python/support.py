"""What the tests of the Python module share: the command beside it, samples, and folders that vanish."""
import importlib
import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCES = pathlib.Path(__file__).resolve().parents[2]
SAMPLES = SOURCES / "examples" / "samples"
COMMAND = os.environ["ORIEL_COMMAND"]
GENERATE = os.environ["ORIEL_GENERATE_COMMAND"]

HOUSE = SAMPLES / "house.stripped.city.json"
TRUTH = SAMPLES / "house.truth.json"

# Three walls: no solid, and nothing can be cut.
OPEN_CUBE = ('{"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},"CityObjects":{"cube":'
             '{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,5,4]],[[1,2,6,5]],'
             '[[2,3,7,6]]]}]}},"vertices":[[0,0,0],[4,0,0],[4,4,0],[0,4,0],[0,0,4],[4,0,4],[4,4,4],[0,4,4]]}')


def stripped_samples():
    return sorted(SAMPLES.glob("*.stripped.city.json"))


def imported(module):
    """A module that is no part of what oriel needs; without it the test is skipped."""
    try:
        return importlib.import_module(module)
    except ImportError:
        raise unittest.SkipTest(f"{module} is not installed") from None


def run(*words, command=COMMAND):
    """What a call of the command prints on stdout; its exit code may be another than 0."""
    done = subprocess.run([command, *map(str, words)], capture_output=True, text=True, check=False)
    return done.stdout


class FolderTest(unittest.TestCase):
    """Each test has an empty folder."""

    maxDiff = 2000

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def assert_same_bytes(self, ours, theirs):
        self.assertEqual(ours.read_bytes(), theirs.read_bytes(), f"{ours.name} and {theirs.name} differ")

    def houses(self, count=4):
        """A stream of generated houses, and the truth about them."""
        stream, truth = self.folder / "houses.city.jsonl", self.folder / "houses.truth.jsonl"
        run("--count", count, "--seed", 3, "-o", stream, "--truth", truth, command=GENERATE)
        return stream, truth
