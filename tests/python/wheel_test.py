"""What pip makes of the sources is whole and can be imported."""
import os
import pathlib
import subprocess
import sys
import unittest
import zipfile

from support import HOUSE, SOURCES, FolderTest

sys.path.insert(0, str(SOURCES / "python"))
import backend  # noqa: E402

BUILD = os.environ["ORIEL_BUILD"]


def imported_from(folder):
    """Where `import oriel` finds it, and what it makes of the sample."""
    program = f"import oriel; print(oriel.__file__); print(oriel.label({str(HOUSE)!r}).issues)"
    return subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, cwd=folder,
                          env={**os.environ, "PYTHONPATH": str(folder)}).stdout.splitlines()


class WheelTest(FolderTest):
    def test_a_wheel_has_the_module_with_its_types_and_a_record_of_all_files(self):
        name = backend.build_wheel(str(self.folder), {"build-dir": BUILD})
        self.assertRegex(name, r"^oriel-[0-9.]+-cp3\d+-cp3\d+-linux_\w+\.whl$")
        with zipfile.ZipFile(self.folder / name) as wheel:
            names = wheel.namelist()
            record = next(one for one in names if one.endswith("/RECORD"))
            recorded = [line.split(",")[0] for line in wheel.read(record).decode().splitlines()]
            wheel.extractall(self.folder)
        self.assertEqual(recorded, names)
        for file in (SOURCES / "python" / "oriel").iterdir():
            if file.suffix in (".py", ".pyi", ".typed") or file.name == "py.typed":
                self.assertIn("oriel/" + file.name, names)
        where, issues = imported_from(self.folder)
        self.assertEqual(pathlib.Path(where), self.folder / "oriel" / "__init__.py")
        self.assertEqual(issues, "[]")
        first = (self.folder / name).read_bytes()
        backend.build_wheel(str(self.folder), {"build-dir": BUILD})
        self.assertEqual((self.folder / name).read_bytes(), first)

    def test_pip_installs_it_without_a_net(self):
        if subprocess.run([sys.executable, "-m", "pip", "--version"], capture_output=True, check=False).returncode:
            self.skipTest("pip is not installed")
        words = ["--no-build-isolation", "--no-index", "--no-deps", "--quiet", "--target", str(self.folder / "site"),
                 "--config-settings", f"build-dir={BUILD}"]
        subprocess.run([sys.executable, "-m", "pip", "install", str(SOURCES / "python"), *words], check=True,
                       capture_output=True)
        where, _ = imported_from(self.folder / "site")
        self.assertEqual(pathlib.Path(where).parents[1], self.folder / "site")


if __name__ == "__main__":
    unittest.main()
