"""Python goes on while the module works."""
import concurrent.futures
import sys
import threading
import time
import unittest

import oriel
from support import HOUSE, SAMPLES, TRUTH, FolderTest

LEAST_TURNS = 2
MOST_TRIES = 200
BLOCK = SAMPLES / "block.stripped.city.json"


def turns_during(work):
    """How often another thread had its turn while `work` ran: with the interpreter's lock held all the time, never."""
    started, ended = threading.Event(), threading.Event()

    def run():
        started.set()
        work()
        ended.set()

    thread = threading.Thread(target=run)
    turns = 0
    before = sys.getswitchinterval()
    sys.setswitchinterval(100)  # nobody takes the lock away
    try:
        thread.start()
        started.wait()
        while not ended.is_set():
            time.sleep(0.0005)
            turns += not ended.is_set()
        thread.join()
    finally:
        sys.setswitchinterval(before)
    return turns


class ThreadsTest(FolderTest):
    def test_python_goes_on_while_cpp_works(self):
        building = oriel.read(BLOCK)[0]
        labelled = oriel.label(building)
        features, truth = oriel.features(labelled), oriel.read_truth(TRUTH)
        labelled_two = oriel.features([labelled, oriel.label(oriel.read(HOUSE)[0])])
        two_truths = oriel.read_truth([TRUTH, SAMPLES / "block.truth.json"])
        for name, work in {
            "label": lambda: oriel.label(building),
            "segment": lambda: oriel.segment(building),
            "generalise": lambda: oriel.generalise(labelled, scale=5000),
            "explain": lambda: oriel.explain(labelled),
            "score": lambda: oriel.score(features, truth, bootstrap=20000),
            "learn": lambda: oriel.learn(labelled_two, two_truths, params=["parapet"], folds=2, restarts=0),
        }.items():
            with self.subTest(name):
                turns = tries = 0
                while turns < LEAST_TURNS and tries < MOST_TRIES:
                    turns += turns_during(work)
                    tries += 1
                self.assertGreaterEqual(turns, LEAST_TURNS)

    def test_threads_get_the_same_results(self):
        stream, _ = self.houses(6)
        buildings, pack = oriel.read(stream), oriel.Pack("residential")
        alone = oriel.to_text(oriel.label(buildings, pack))
        for jobs in (0, 2, 3):
            self.assertEqual(oriel.to_text(oriel.label(buildings, pack, jobs=jobs)), alone)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            by_hand = list(pool.map(lambda building: oriel.label(building, pack), buildings))
        self.assertEqual(oriel.to_text(by_hand), alone)


if __name__ == "__main__":
    unittest.main()
