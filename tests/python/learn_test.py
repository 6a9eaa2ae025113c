"""Learning from Python gives what the command learns."""
import pathlib
import tempfile
import unittest

import oriel
from support import GENERATE, HOUSE, SAMPLES, TRUTH, FolderTest, run

HIP_TRUTH = SAMPLES / "hip.truth.json"

# Deeper than the ledges of English houses: something is to be learnt.
DEEP = """schema: oriel/1
pack: {name: deep, version: 1.0.0}
extends: residential
params:
  ledge_depth: {value: 0.8 m}
"""
SHORT = ("--folds", 2, "--restarts", 0, "--params", "ledge_depth,narrowest_door")
PARAMS = ["ledge_depth", "narrowest_door"]


class LearnTest(FolderTest):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        there = pathlib.Path(folder.name)
        stream, cls.truth = there / "houses.city.jsonl", there / "houses.truth.jsonl"
        run("--style", "english", "--count", 8, "--seed", 2, "-o", stream, "--truth", cls.truth, command=GENERATE)
        cls.records = there / "parts.jsonl"
        run("segment", stream, "--features", cls.records)
        cls.pack = there / "deep.yaml"
        cls.pack.write_text(DEEP, encoding="utf-8")

    def learn(self, rules="residential", **options):
        """Quickly."""
        return oriel.learn(self.records, self.truth, rules, **{"folds": 2, "restarts": 0, "params": PARAMS, **options})

    def compare(self, learnt, *words, rules="residential"):
        """The texts are those of the command, and so is the pack."""
        file = self.pack.parent / "learnt.yaml"
        call = ["learn", self.records, "--truth", self.truth, "--rules", rules, *words]
        self.assertEqual(str(learnt), run(*call, "-o", file))
        self.assertEqual(learnt.json + "\n", run(*call, "--json"))
        self.assertEqual(learnt.yaml(), file.read_text(encoding="utf-8"))

    def test_what_is_learnt_is_what_the_command_learns(self):
        learnt = self.learn(self.pack)
        self.compare(learnt, *SHORT, rules=self.pack)
        self.assertEqual(list(learnt.values), ["ledge_depth"])
        self.assertGreater(learnt.held_out_after, learnt.held_out_before)
        features = oriel.read_features(self.records)
        for again in (oriel.learn(features, self.truth, self.pack, folds=2, restarts=0, params=PARAMS, jobs=2),
                      oriel.learn([self.records], oriel.read_truth(self.truth), oriel.Pack(self.pack), folds=2, restarts=0,
                                  params=PARAMS)):
            self.assertEqual(again.json, learnt.json)
        changed = oriel.Pack(self.pack).with_params(**learnt.values)
        score = oriel.score(oriel.interpret(features, changed), self.truth)
        self.assertAlmostEqual(score.macro_f1, learnt.after)

    def test_objectives_and_params_are_those_of_the_command(self):
        learnt = self.learn(objective="door", restarts=1, params=["widest_leaf", "narrowest_door"], seed=3)
        self.compare(learnt, "--objective", "door", "--folds", 2, "--params", "widest_leaf,narrowest_door", "--seed", 3)
        costs = self.folder / "costs.csv"
        costs.write_text("door,-,5\n-,door,1\n", encoding="utf-8")
        for given in (costs, {("door", "-"): 5, ("-", "door"): 1}):
            self.compare(self.learn(objective="cost", costs=given), "--objective", "cost", "--costs", costs, *SHORT)

    def test_questions_and_proposals_are_those_of_the_command(self):
        learnt = self.learn(self.pack)
        printed = run("learn", self.records, "--truth", self.truth, "--rules", self.pack, *SHORT, "--ask", 4, "--propose")
        asked = learnt.questions(4)
        self.assertEqual(len(asked), 4)
        for question in asked:
            self.assertIn(question.feature, printed)
            self.assertEqual(sum(question.by_fold.values()), 2)
        proposals = learnt.proposals()
        self.assertTrue(printed.endswith(learnt.proposals_yaml(proposals) or "no change of a rule pays on held-out folds\n"), printed)

    def test_features_that_were_just_made_are_learnt_from(self):
        labelled = oriel.label([*oriel.read(HOUSE), *oriel.read(SAMPLES / "hip.stripped.city.json")])
        learnt = oriel.learn(labelled, [TRUTH, HIP_TRUTH], leave_one_out=True, restarts=0, params=["parapet"])
        self.assertEqual((learnt.buildings, learnt.issues), (2, []))
        self.assertTrue(learnt.reason)

    def test_corrections_are_truth(self):
        labelled = oriel.features(oriel.label([*oriel.read(HOUSE), *oriel.read(SAMPLES / "hip.stripped.city.json")]))
        window = labelled["id"][(labelled["label"] == "window") & (labelled["building"] == "hip")][0]
        said = self.folder / "corrections.jsonl"
        said.write_text('{"building": "hip", "feature": "%s", "class": "window", "by": "ada"}\n' % window, encoding="utf-8")
        learnt = oriel.learn(labelled, TRUTH, corrections=said, leave_one_out=True, restarts=0, params=["parapet"])
        self.assertEqual(learnt.buildings, 2)

    def test_what_cannot_be_learnt_has_a_code(self):
        for code, arguments, options in (
                ("R284", (self.records, TRUTH), {}), ("R282", (oriel.label(HOUSE), TRUTH), {}),
                ("R206", (self.records, self.truth), {"params": ["widest_leef"]}),
                ("E101", (self.folder / "missing.csv", self.truth), {})):
            with self.subTest(code), self.assertRaises(oriel.Error) as caught:
                oriel.learn(*arguments, **options)
            self.assertEqual(caught.exception.code, code)
        for options in ({"objective": "dor"}, {"objective": "cost"}, {"costs": {}}, {"folds": 1}, {"penalty": -1},
                        {"restarts": 101}):
            with self.subTest(options), self.assertRaises(ValueError):
                self.learn(**options)
        with self.assertRaises(ValueError):
            oriel.learn(self.records, None)

    def test_a_changed_pack_has_no_file_to_extend(self):
        changed = oriel.Pack("residential").with_params(ledge_depth=0.8)
        learnt = self.learn(changed)
        self.assertTrue(learnt.values)
        with self.assertRaisesRegex(ValueError, "with_params"):
            learnt.yaml()


if __name__ == "__main__":
    unittest.main()
