#!/usr/bin/env python3
"""Changes the code at random places, one at a time, and counts which changes the tests notice.

    tests/mutants/run.py --count 200 --seed 1

Needs a release build with tests (tests/run.sh). Nothing in the tree or the build is touched: the changed file, and those that
are compiled together with it, are compiled apart (-O1) and linked in the place of their library's, into copies of the tests of its
room; if they notice nothing, into copies of the other rooms' and of the command (--own leaves that out). A test that does not end
in time has noticed. Changes that do not compile are drawn anew.
"""

import argparse
import json
import os
import random
import re
import shlex
import subprocess
import sys
import time
from pathlib import Path

from mutations import mutations_of

ROOT = Path(__file__).resolve().parents[2]
ROOMS = ("kernel", "interpret", "generalise")
# What runs if the tests of the room notice nothing; slower ones last.
FURTHER = ("test_generalise", "test_oriel", "test_cli")


class Build:
    """The commands by which the build makes its objects and programs."""

    def __init__(self, folder):
        self.folder = folder
        self.work = folder / "mutants"
        self.work.mkdir(exist_ok=True)
        self.command_of, self.unit_of = {}, {}
        for entry in json.loads((folder / "compile_commands.json").read_text()):
            self.add_unit(entry)
        self.originals = {}
        self.seconds = {}

    def add_unit(self, entry):
        path = Path(entry["file"])
        members = [path]
        if path.name.startswith("unity_"):
            members = [Path(p) for p in re.findall(r'#include "(.+?)"', path.read_text())]
        for member in members:
            name = os.path.relpath(member, ROOT)
            self.command_of[name] = entry["command"]
            self.unit_of[name] = [os.path.relpath(m, ROOT) for m in members]

    def compile(self, name, source, target):
        words = shlex.split(self.command_of[name])
        place = words.index("-o")
        words[place + 1] = str(target)
        words[words.index("-c") + 1] = str(source)
        words = [w for w in words if w not in ("-O3", "-Winvalid-pch", "-Werror")] + ["-O1", "-w"]
        return subprocess.run(words, cwd=self.folder, capture_output=True, timeout=1200).returncode == 0

    def original(self, name):
        """The object of an unchanged file; made when it is asked for first."""
        target = self.work / (name.replace("/", "__") + ".o")
        if not target.exists() or target.stat().st_mtime < (ROOT / name).stat().st_mtime:
            if not self.compile(name, ROOT / name, target):
                raise RuntimeError(f"{name} cannot be compiled")
        return target

    def link(self, program, objects, target):
        """Links a program with `objects` in the place of what their library has of the same files."""
        commands = subprocess.run(["ninja", "-t", "commands", program], cwd=self.folder, capture_output=True,
                                  text=True, check=True).stdout.splitlines()
        line = next(c for c in reversed(commands) if f"-o {program} " in c)
        line = line.split(" && ")[1] if line.startswith(": && ") else line
        words = shlex.split(line)
        words[words.index("-o") + 1] = str(target)
        first = next(i for i, word in enumerate(words) if word.endswith(".a"))
        words[first:first] = [str(o) for o in objects]
        words.append("-Wl,--allow-multiple-definition")
        subprocess.run(words, cwd=self.folder, capture_output=True, check=True)

    def passes(self, program, environment):
        """Whether a copy of a test program passes in five times the time of the original."""
        name = Path(program).name
        if name not in self.seconds:
            begin = time.monotonic()
            run_tests(self.folder / "tests" / name, self.folder, {}, 3600)
            self.seconds[name] = time.monotonic() - begin
        return run_tests(program, self.folder, environment, 20 + 5 * self.seconds[name])


def run_tests(program, folder, environment, seconds):
    try:
        return subprocess.run([program, "--abort-after=1", "--test-case-exclude=slow:*"], cwd=folder / "tests", timeout=seconds,
                              env={**os.environ, **environment}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def own_test(name):
    parts = Path(name).parts
    return "test_" + "_".join(parts[:2] if parts[0] == "kernel" else parts[:1])


def judge(build, mutation, is_own_only):
    """'noticed by PROGRAM', 'survived', or nothing if the change does not compile."""
    source = (ROOT / mutation.path).read_text()
    changed, mutant = build.work / "mutant.cpp", build.work / "mutant.o"
    changed.write_text(mutation.applied(source))
    if not build.compile(mutation.path, changed, mutant):
        return None
    objects = [mutant] + [build.original(n) for n in build.unit_of[mutation.path] if n != mutation.path]
    programs = [own_test(mutation.path)] + ([] if is_own_only else list(FURTHER))
    for program in dict.fromkeys(programs):
        target = build.work / program
        if not (build.folder / "tests" / program).exists():
            continue
        environment = {}
        if program in ("test_cli", "test_oriel"):
            build.link("cli/oriel", objects, build.work / "oriel")
            environment["ORIEL_COMMAND"] = str(build.work / "oriel")
        if program == "test_cli":
            target = build.folder / "tests" / program
        else:
            build.link(f"tests/{program}", objects, target)
        if not build.passes(target, environment):
            return f"noticed by {program}"
    return "survived"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rooms", nargs="+", default=list(ROOMS), help="folders")
    parser.add_argument("--own", action="store_true", help="only the tests of the changed file's own room")
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    arguments = parser.parse_args()

    build = Build(arguments.build.resolve())
    places = []
    for room in arguments.rooms:
        for path in sorted((ROOT / room).rglob("*.cpp")):
            name = os.path.relpath(path, ROOT)
            if name in build.command_of:
                places += mutations_of(name, path.read_text())
    print(f"{len(places)} places", flush=True)
    random.Random(arguments.seed).shuffle(places)
    judged = noticed = 0
    survivors = []
    for mutation in places:
        if judged == arguments.count:
            break
        begin = time.monotonic()
        verdict = judge(build, mutation, arguments.own)
        if verdict is None:
            continue
        judged += 1
        noticed += verdict != "survived"
        line = f"{mutation.path}:{mutation.line((ROOT / mutation.path).read_text())}: {mutation.kind}"
        print(f"{judged} {line}: {verdict} ({time.monotonic() - begin:.0f} s)", flush=True)
        if verdict == "survived":
            survivors.append(line)
    print(f"{noticed} of {judged} noticed ({100 * noticed / max(judged, 1):.1f} %), seed {arguments.seed}; survivors:")
    print("\n".join(survivors))


if __name__ == "__main__":
    sys.exit(main())
