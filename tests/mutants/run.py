#!/usr/bin/env python3
"""Changes the code at random places and counts which changes the tests notice.

    tests/mutants/run.py --count 200 --seed 1

All changes are put into a copy of the sources at once, each behind a switch, so that they are compiled only once; the tree itself
and its build stay as they are. A first run of all tests notes which cases reach which change. Then the cases that reach a change run
with it switched on, the likeliest and quickest first, until one fails, crashes or does not end in time. A change that no case
reaches, or that none notices, has survived: a test is missing, or the change can be seen nowhere, as those listed in
tests/mutants/equivalents.txt. Changes that do not compile are drawn anew.

The copy stays (--tree): after new tests, run the same command again with --only and the numbers of the survivors.
"""

import argparse
import os
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from mutations import mutations_of
from tree import Tree

ROOT = Path(__file__).resolve().parents[2]
ROOMS = ("model", "kernel", "io", "interpret", "generalise")
PROGRAMS = ("test_kernel_base", "test_model", "test_kernel_geometry", "test_kernel_mesh", "test_kernel_attach", "test_kernel_blocks",
            "test_kernel_describe", "test_io", "test_kernel_solidify", "test_kernel_segment", "test_kernel_validate",
            "test_interpret", "test_generalise", "test_oriel", "test_cli", "test_fuzz_replay")
SPARE = 1.2  # how many more changes are drawn than judged, for those that do not compile
SAME = re.compile(r'return (0|""|nullptr);')  # as what is returned in their place
QUICK, SLOW = 0.3, 3  # seconds of a case
MEMORY = 6 << 30  # bytes that a run may have


def draw(arguments):
    """Changes of which no two share a line, in the order in which they are judged; None for one that changes nothing."""
    places = []
    for room in arguments.rooms:
        for path in sorted((ROOT / room).rglob("*.cpp")):
            if path.name != "log.cpp":  # compiled with definitions of its own
                places += mutations_of(os.path.relpath(path, ROOT), path.read_text())
    random.Random(arguments.seed).shuffle(places)
    drawn, taken = [], set()
    for mutation in places:
        lines = {(mutation.path, line) for line in mutation.lines}
        if not lines & taken:
            drawn.append(mutation)
            taken |= lines
        if len(drawn) >= arguments.count * SPARE:
            break
    print(f"{len(places)} places, {len(drawn)} drawn", flush=True)
    return [None if SAME.fullmatch(mutation.shown) else mutation for mutation in drawn]


def build_all(tree, drawn, arguments):
    """The changes, with None where one does not compile, now or before."""
    known = tree.build / "not_compiling.txt"
    bad_ones = set(known.read_text().splitlines()) if known.exists() else set()
    kept = [None if mutation and named(mutation) in bad_ones else mutation for mutation in drawn]
    while True:
        tree.put_in(kept)
        errors = tree.compile(["cli/oriel"] + [f"tests/{name}" for name in PROGRAMS], arguments.jobs)
        if not errors:
            return kept
        bad = [i for i, m in enumerate(kept) if m and any(path == m.path and line in m.lines for path, line in errors)]
        if not bad:
            sys.exit(f"errors that belong to no change: see {tree.build}/mutants.log")
        for i in bad:
            print(f"does not compile: {place(kept[i])}: {kept[i].kind}", flush=True)
            with open(known, "a") as file:
                print(named(kept[i]), file=file)
            kept[i] = None


class Runs:
    """Runs of the test programs, with one change switched on or noting which are reached."""

    def __init__(self, tree, longest, most):
        self.tree, self.longest, self.most = tree, longest, most
        self.reaching = {}  # number: [(seconds, program, case)]

    def run(self, program, cases, environment, seconds):
        """Whether the program passes; nothing if it has not ended in time."""
        words = [self.tree.build / "tests" / program]
        if cases:
            names = ",".join(case.replace("\\", "\\\\").replace(",", "\\,") for case in cases)
            words += ["--abort-after=1", "--test-case=" + names]
        else:
            words += ["--test-case-exclude=slow:*"]
        with tempfile.TemporaryDirectory(prefix="oriel-mutants-") as folder:
            process = subprocess.Popen(words, cwd=self.tree.build / "tests", env={**os.environ, "TMPDIR": folder, **environment},
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
                                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY)))
            try:
                return process.wait(timeout=seconds) == 0
            except subprocess.TimeoutExpired:
                return None
            finally:
                try:
                    os.killpg(process.pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
                process.wait()

    def note(self, program):
        """Runs all cases of a program without any change, unless that was done, and reads which changes each of them reaches."""
        notes = self.tree.build / f"{program}.notes"
        built = [self.tree.build / "tests" / program] + [self.tree.build / "cli/oriel"] * (program in ("test_cli", "test_oriel"))
        if not notes.exists() or notes.stat().st_mtime < max(path.stat().st_mtime for path in built):
            draft = notes.with_suffix(".draft")
            draft.unlink(missing_ok=True)
            self.run(program, [], {"ORIEL_MUTANT_NOTES": str(draft)}, 3600)
            draft.rename(notes)
        always, numbers, case = set(), set(), None
        for line in notes.read_text(errors="replace").splitlines():
            word, _, rest = line.partition(" ")
            if word == "begin":
                if case is None:
                    always = set(numbers)  # by what is computed before main
                case, numbers = rest, set()
            elif word == "passed":
                for number in numbers | always:
                    self.reaching.setdefault(number, []).append((float(rest), program, case))
            elif word == "failed":
                print(f"fails without any change: {program}: {case}", flush=True)
            else:
                numbers.add(int(word))

    def judge(self, number, own):
        """'not reached', 'survived' or what noticed the change."""
        cases = sorted(self.reaching.get(number, []), key=lambda one: (one[1] != own, one[0]))
        if not cases:
            return "not reached"
        # Quick ones of its own room, then of others, then the slower ones.
        rounds = [[one for one in cases if one[1] == own and one[0] < QUICK], [one for one in cases if one[1] != own and one[0] < QUICK],
                  [one for one in cases if QUICK <= one[0] < SLOW], [one for one in cases if SLOW <= one[0] <= self.longest]]
        left = self.most
        for ones in rounds:
            for program in dict.fromkeys(one[1] for one in ones):
                chosen = [one for one in ones if one[1] == program and (left := left - one[0]) >= 0]
                if not chosen:
                    continue
                passed = self.run(program, [one[2] for one in chosen], {"ORIEL_MUTANT": str(number)},
                                  20 + 5 * sum(one[0] for one in chosen))
                if not passed:
                    return f"noticed by {program}" + (" (no end)" if passed is None else "")
        return "survived"


def own_test(name):
    parts = Path(name).parts
    return "test_" + "_".join(parts[:2] if parts[0] == "kernel" else parts[:1])


def place(mutation):
    return f"{mutation.path}:{mutation.line}"


def named(mutation):
    """What a change is called where line numbers may have moved."""
    return f"{mutation.path} {mutation.kind}: {mutation.shown}"


def known_equivalents():
    """The changes of tests/mutants/equivalents.txt, as 'PATH KIND: SHOWN'."""
    text = (ROOT / "tests/mutants/equivalents.txt").read_text()
    return {line for line in text.splitlines() if line and not line.startswith(("#", " "))}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rooms", nargs="+", default=list(ROOMS), help="folders")
    parser.add_argument("--only", nargs="+", type=int, help="judge only the changes with these numbers")
    parser.add_argument("--longest", type=float, default=60, help="seconds (60); cases that take longer are left out")
    parser.add_argument("--most", type=float, default=300, help="seconds (300) of all cases that a change is tried with, quick ones first")
    parser.add_argument("--tree", type=Path, default=ROOT / "build/mutants/tree", help="where the copy is made (build/mutants/tree)")
    parser.add_argument("--as-copied", action="store_true", help="do not copy what has changed since the last run")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()

    tree = Tree(ROOT, arguments.tree.absolute())
    if not arguments.as_copied:
        tree.copy()
    kept = build_all(tree, draw(arguments), arguments)
    runs = Runs(tree, arguments.longest, arguments.most)
    begin = time.monotonic()
    with ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(runs.note, reversed(PROGRAMS)))
    print(f"all tests without a change: {time.monotonic() - begin:.0f} s", flush=True)

    numbers = [i for i, mutation in enumerate(kept, 1) if mutation][: arguments.count]
    numbers = [i for i in numbers if not arguments.only or i in arguments.only]
    equivalents = known_equivalents()
    totals = {}

    def judge(number):
        mutation, start = kept[number - 1], time.monotonic()
        verdict = runs.judge(number, own_test(mutation.path))
        if not verdict.startswith("noticed") and named(mutation) in equivalents:
            verdict = "equivalent"
        print(f"{number} {place(mutation)}: {mutation.kind}: {mutation.shown[:100]}: {verdict} ({time.monotonic() - start:.0f} s)", flush=True)
        return verdict

    with ThreadPoolExecutor(arguments.jobs) as pool:
        verdicts = list(pool.map(judge, numbers))
    for number, verdict in zip(numbers, verdicts):
        room = totals.setdefault(kept[number - 1].path.split("/")[0], {})
        word = verdict.split()[0]
        room[word] = room.get(word, 0) + 1
    print("\nSurvivors:")
    for number, verdict in zip(numbers, verdicts):
        if verdict in ("survived", "not reached"):
            print(f"{number} {place(kept[number - 1])}: {verdict}\n    {kept[number - 1].switched}")
    print()
    for room, words in totals.items():
        print(f"{room}: {words.get('noticed', 0)} of {sum(words.values())} noticed, {words.get('equivalent', 0)} equivalent")
    noticed = sum(words.get("noticed", 0) for words in totals.values())
    equal = sum(words.get("equivalent", 0) for words in totals.values())
    share = 100 * noticed / max(1, len(numbers) - equal)
    print(f"in all {noticed} of {len(numbers)} noticed, {equal} equivalent: {share:.1f} % of those that are not, seed {arguments.seed}")


if __name__ == "__main__":
    sys.exit(main())
