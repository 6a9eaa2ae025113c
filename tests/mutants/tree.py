"""A copy of the sources into which many changes are put at once, each behind a switch, and its build."""

import os
import re
import shutil
import subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent
# What of the repository the tests need.
FOLDERS = ("bench", "cli", "docs", "examples", "experiments", "generalise", "interpret", "io", "kernel", "model", "oriel", "rules", "tests", ".ci")
# The first lines of a file with switches; its own lines count from 1.
MARK = '#include "kernel/base/switch.h"\n#line 1\n'
ERROR = re.compile(r"^(?:In file included from )?(/[^\s:]+\.cpp):(\d+)(?::\d+)?:.*?(?:(error):|required from|$)", re.M)
# What is otherwise in the copy's build: the libraries are compiled quickly, the tests tell which case runs.
CHANGES = {
    "CMakeLists.txt": ("PRIVATE $<BUILD_INTERFACE:oriel_options>)",
                       "PRIVATE $<BUILD_INTERFACE:oriel_options>)\n  target_compile_options(${library} PRIVATE -O1 -w)"),
    "tests/CMakeLists.txt": ("OBJECT support/main.cpp", "OBJECT support/main.cpp support/listener.cpp"),
}


class Tree:
    def __init__(self, root, folder):
        self.root, self.folder = root, folder
        self.build = folder / "build/release"

    def copy(self):
        """Copies what changed since the last copy; what is the same keeps its time, so that it is not compiled again."""
        for name in FOLDERS:
            self.copy_folder(name)
        for path in self.root.iterdir():
            if path.is_file():
                self.copy_file(path.name)
        # The tests read data beside the repository where there are any.
        beside, linked = self.root.parent / "shared", self.folder.parent / "shared"
        if beside.is_dir() and not linked.exists():
            linked.symlink_to(beside)
        for name in ("switch.h", "switch.cpp"):
            write(self.folder / "kernel/base" / name, (HERE / name).read_bytes())
        write(self.folder / "tests/support/listener.cpp", (HERE / "listener.cpp").read_bytes())

    def copy_folder(self, name):
        source, target = self.root / name, self.folder / name
        target.mkdir(parents=True, exist_ok=True)
        entries = {entry.name: entry for entry in os.scandir(source) if entry.name != "__pycache__"}
        for entry in entries.values():
            if entry.is_dir():
                self.copy_folder(f"{name}/{entry.name}")
            else:
                self.copy_file(f"{name}/{entry.name}")
        for entry in os.scandir(target):
            if entry.name not in entries and entry.is_file() and entry.name not in ("switch.h", "switch.cpp", "listener.cpp"):
                os.remove(entry.path)

    def copy_file(self, name):
        target = self.folder / name
        if target.exists() and is_switched(target):
            return  # put_in writes it
        content = (self.root / name).read_bytes()
        if name in CHANGES:
            old, new = CHANGES[name]
            if old.encode() not in content:
                raise RuntimeError(f"{name} has no {old!r}")
            content = content.replace(old.encode(), new.encode())
        if write(target, content):
            shutil.copymode(self.root / name, target)

    def put_in(self, mutations):
        """Writes the files with all changes behind switches; a change's number is its place in the list, from 1."""
        by_path = {}
        for number, mutation in enumerate(mutations, 1):
            if mutation is not None:
                by_path.setdefault(mutation.path, []).append((mutation, number))
        for room in ("model", "kernel", "io", "interpret", "generalise"):
            for path in (self.folder / room).rglob("*.cpp"):
                name = os.path.relpath(path, self.folder)
                if name not in by_path and is_switched(path):
                    write(path, (self.root / name).read_bytes())
        for path, ones in by_path.items():
            text = (self.root / path).read_text()
            for mutation, number in sorted(ones, key=lambda one: -one[0].begin):
                switched = mutation.switched.replace("NUMBER", str(number))
                text = text[: mutation.begin] + switched + text[mutation.end :]
            write(self.folder / path, (MARK + text).encode())

    def compile(self, targets, jobs):
        """Builds the targets; returns the lines with errors as (file, line), nothing if all is built."""
        if not (self.build / "build.ninja").exists():
            options = ["-DORIEL_TESTS=ON", "-DORIEL_BENCH=ON", "-DORIEL_UNITY=ON"]
            if shutil.which("ccache"):
                options.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
            subprocess.run(["cmake", "--preset", "release", *options], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        done = subprocess.run(["ninja", f"-j{jobs}", "-k0", *targets], cwd=self.build, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        (self.build / "mutants.log").write_text(done.stdout)
        if done.returncode == 0:
            return []
        places = [(os.path.relpath(path, self.folder), int(line)) for path, line, _ in ERROR.findall(done.stdout)]
        if not places:
            raise RuntimeError(f"does not build for another reason: see {self.build}/mutants.log")
        return places


def is_switched(path):
    with open(path, "rb") as file:
        return file.read(len(MARK)) == MARK.encode()


def write(path, content):
    if path.exists() and path.read_bytes() == content:
        return False
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    return True
