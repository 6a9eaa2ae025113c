#!/usr/bin/env python3
"""Measures how long the studio takes to answer, through HTTP as its page asks: from a keystroke in the pack to labels and F1, while
a slider is dragged, for scales, and to open a city.

  bench/studio.py [--only WORD] [--repeat N] [ORIEL [ORIEL-GENERATE]]

Sets: Ingolstadt of ../shared (or $ORIEL_SHARED; left out where it is absent) and 1,000 generated houses, both with truth. Times are
milliseconds: the median, and the longest of N (20). Run it on a quiet machine.
"""
import argparse
import glob
import http.client
import json
import os
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import urllib.parse

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


class Studio:
    def __init__(self, oriel, folder, files, truths):
        self.process = subprocess.Popen(
            [oriel, "studio", *files, "--truth", *truths, "--rules", os.path.join(ROOT, "rules/residential.yaml"), "--no-browser"],
            cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        threading.Thread(target=self.process.stderr.read, daemon=True).start()
        address = urllib.parse.urlparse(self.process.stdout.readline().strip())
        self.port, self.token = address.port, urllib.parse.parse_qs(address.query)["token"][0]
        self.version = 0
        self.number = 0  # of the labels at hand, as the page keeps it

    def ask(self, verb, body):
        """The answer, its bytes and the seconds it took to come and to be read."""
        data, seconds = self.ask_bytes(verb, body)
        return json.loads(data), len(data), seconds

    def ask_bytes(self, verb, body):
        """The answer as it comes, and the seconds it took."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=600)
        headers = {"X-Oriel-Token": self.token, "Content-Type": "application/json"}
        text = json.dumps(body)
        begin = time.perf_counter()
        connection.request("POST", "/api/" + verb, text, headers)
        answer = connection.getresponse()
        data = answer.read()
        seconds = time.perf_counter() - begin
        if answer.status not in (200, 409):
            sys.exit(f"{verb}: {answer.status} {data[:300].decode()}")
        return data, seconds

    def type(self, text, params=None, everything=False):
        """A keystroke: the pack has another text."""
        self.version += 1
        body = {"text": text, "version": self.version, "since": 0 if everything else self.number}
        if params:
            body["params"] = params
        asked = self.ask("pack", body)
        self.number = asked[0].get("number", self.number)
        return asked

    def close(self):
        self.process.send_signal(signal.SIGINT)
        self.process.wait()


def line(what, seconds, note=""):
    middle = statistics.median(seconds) * 1000
    print(f"  {what:<58} {middle:9.1f} {max(seconds) * 1000:9.1f}  {note}", flush=True)


def with_other(text, pattern, replacement):
    changed, count = re.subn(pattern, replacement, text, count=1)
    if count == 0:
        sys.exit(f"the pack has no {pattern}")
    return changed


def measure_opening(studio):
    begin = time.perf_counter()
    while True:
        state, _, seconds = studio.ask("state", {})
        if state["loading"]["done"] == state["loading"]["all"] and state["buildings"]:
            break
        time.sleep(0.02)
    loaded = time.perf_counter() - begin
    begin = time.perf_counter()
    state, _, _ = studio.ask("state", {})
    answer, _, labelled = studio.type(state["pack"]["text"], everything=True)
    size = 0
    count = len(state["buildings"])
    for first in range(0, count, 60):
        size += len(studio.ask_bytes("geometry", {"buildings": list(range(first, min(first + 60, count)))})[0])
    shown = time.perf_counter() - begin
    features = sum(b["features"] for b in state["buildings"] if b.get("features"))
    print(f"  {len(state['buildings'])} buildings, {features} features; read and segmented in {loaded:.2f} s")
    line("then: state, labels and F1, geometry of all", [shown], f"{size / 1e6:.1f} MB; labels {labelled * 1000:.0f} ms")
    if answer.get("score") is None:
        sys.exit("there is no score: truth was not read")
    return state["pack"]["text"], answer


def measure_keys(studio, text, repeat):
    kinds = {
        "a letter in a comment": lambda i: text + f"# {'a' * (i + 1)}\n",
        "a param that decides windows": lambda i: with_other(text, r"(widest_window:\s*\{value: )[\d.]+", rf"\g<1>{3 + i / 100:.2f}"),
        "a param that decides doors": lambda i: with_other(text, r"(door_height:\s*\{value: )[\d.]+", rf"\g<1>{1.7 + i / 100:.2f}"),
        "a priority of a rule": lambda i: with_other(text, r"(priority: )\d+", rf"\g<1>{2 + i}"),
        "a pack that is wrong for a moment": lambda i: text + f"  - {{id: w{'x' * i}, label: windo\n",
    }
    for what, variant in kinds.items():
        try:
            texts = [variant(i) for i in range(repeat)]
        except SystemExit:
            continue
        seconds, changed = [], 0
        for changed_text in texts:
            answer, _, took = studio.type(changed_text)
            seconds.append(took)
            changed += answer.get("changed_count", 0)
        line(what, seconds, f"{changed} labels changed")
        studio.type(text)


def measure_burst(studio, text, repeat):
    """Letters that follow each other quickly: from the last to its answer."""
    seconds = []
    for _ in range(max(1, repeat // 5)):
        answers = []
        for i in range(10):
            version = studio.version = studio.version + 1
            body = {"text": text + f"# {'b' * (i + 1)}\n", "version": version, "since": studio.number}
            thread = threading.Thread(target=lambda b=body: answers.append((b["version"], studio.ask("pack", b)[2])))
            thread.start()
            time.sleep(0.03)
        threads = [t for t in threading.enumerate() if t is not threading.current_thread() and not t.daemon]
        for thread in threads:
            thread.join()
        seconds.append(max(answers)[1])
    line("the last of ten letters, 30 ms apart", seconds)


def measure_slider(studio, text, answer, repeat):
    params = [p for p in answer["params"] if p.get("from") is not None and p.get("to") is not None]
    preferred = [p for p in params if p["name"] == "widest_window"] or params
    if not preferred:
        return
    param = preferred[0]
    unit = f" {param['unit']}" if param.get("unit") else ""
    low, high = float(param["from"]), float(param["to"])
    begin = time.perf_counter()
    seconds = []
    for i in range(repeat):
        value = low + (high - low) * (i + 1) / (repeat + 1)
        seconds.append(studio.type(text, {param["name"]: f"{value:.3f}{unit}"})[2])
    rate = repeat / (time.perf_counter() - begin)
    line(f"a step of the slider of {param['name']}", seconds, f"{rate:.1f} updates a second")
    studio.type(text)


def measure_scales(studio, repeat):
    for scale in (2500, 10000):
        first, again = [], []
        for building in range(min(5, repeat)):
            first.append(studio.ask("scale", {"building": building, "scale": scale})[2])
            again.append(studio.ask("scale", {"building": building, "scale": scale})[2])
        line(f"one building at 1:{scale}, for the first time", first)
        line(f"one building at 1:{scale}, again", again)


def measure_rest(studio, repeat):
    state, _, _ = studio.ask("state", {})
    building = max(range(len(state["buildings"])), key=lambda i: state["buildings"][i].get("features") or 0)
    count = min(repeat, state["buildings"][building]["features"])
    line("explain a feature", [studio.ask("explain", {"building": building, "feature": i})[2] for i in range(count)])
    line("complete", [studio.ask("language", {"verb": "complete", "text": state["pack"]["text"], "line": 16, "column": 3})[2]
                      for _ in range(repeat)])
    line("search: width > 3 m", [studio.ask("search", {"text": "width > 3 m"})[2] for _ in range(3)])


def measure(name, oriel, files, truths, repeat):
    print(f"{name}{'':<{60 - len(name)}} {'median':>9} {'longest':>9}")
    with tempfile.TemporaryDirectory() as folder:
        studio = Studio(oriel, folder, files, truths)
        try:
            text, answer = measure_opening(studio)
            measure_keys(studio, text, repeat)
            measure_burst(studio, text, repeat)
            measure_slider(studio, text, answer, repeat)
            for rest in (measure_scales, measure_rest):
                try:
                    rest(studio, repeat)
                except SystemExit as fault:
                    print(f"  left out: {fault}")
        finally:
            studio.close()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("oriel", nargs="?", default=os.path.join(ROOT, "build/release/cli/oriel"))
    parser.add_argument("generate", nargs="?", default=os.path.join(ROOT, "build/release/examples/generator/oriel-generate"))
    parser.add_argument("--only", default="")
    parser.add_argument("--repeat", type=int, default=20)
    parser.add_argument("--houses", type=int, default=1000)
    given = parser.parse_args()
    shared = os.environ.get("ORIEL_SHARED", os.path.join(os.path.dirname(ROOT), "shared"))
    town = sorted(glob.glob(os.path.join(shared, "data/ingolstadt/*.stripped.city.json")))
    oriel = os.path.abspath(given.oriel)
    if town and given.only in "ingolstadt":
        measure("ingolstadt", oriel, town, [os.path.join(shared, "data/ingolstadt")], given.repeat)
    if given.only in "houses":
        with tempfile.TemporaryDirectory() as folder:
            city, truth = os.path.join(folder, "town.city.jsonl"), os.path.join(folder, "town.truth.jsonl")
            subprocess.run([given.generate, "--seed", "5", "--count", str(given.houses), "-o", city, "--truth", truth], check=True,
                           stderr=subprocess.DEVNULL)
            measure("houses", oriel, [city], [truth], given.repeat)


main()
