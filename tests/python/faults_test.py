"""What cannot be done is an exception with a code and a place."""
import contextlib
import io
import unittest

import oriel
from support import HOUSE, OPEN_CUBE, SAMPLES, SOURCES, TRUTH, FolderTest, run

PACK = """schema: oriel/1
pack: {name: wrong, version: 1.0.0}
classes: {door: {}}
rules:
  - {id: door, label: door, require: [heigth >= 1 m]}
  - {id: other, label: dor, require: [height >= 1 m]}
"""


class FaultsTest(FolderTest):
    def refused(self, code, call, *arguments, **options):
        with self.assertRaises(oriel.Error) as caught:
            call(*arguments, **options)
        self.assertEqual(caught.exception.code, code, caught.exception)
        self.assertTrue(caught.exception.sentence)
        return caught.exception

    def test_a_file_that_is_not_there_is_named(self):
        missing = self.folder / "missing.city.json"
        error = self.refused("E101", oriel.read, missing)
        self.assertEqual(error.place.file, str(missing))
        self.refused("E101", oriel.label, missing)
        self.refused("E101", oriel.read_features, self.folder / "missing.csv")
        self.refused("E101", oriel.read_truth, self.folder / "missing.truth.json")
        self.refused("R200", oriel.Pack, self.folder / "missing.yaml")

    def test_a_file_that_cannot_be_read_says_why(self):
        self.refused("E102", oriel.read_text, "")
        self.refused("E106", oriel.read, self.folder / "house.docx")
        error = self.refused("E104", oriel.read_text, '{"type": }', name="mine")
        self.assertTrue(error.place.file.startswith("mine"))
        with self.assertRaises(ValueError):
            oriel.read(HOUSE, from_="ifc")

    def test_a_pack_with_errors_has_all_of_them_with_their_places(self):
        error = self.refused("R204", oriel.Pack.from_text, PACK, "wrong.yaml")
        self.assertEqual((error.place.file, error.place.line), ("wrong.yaml", 5))
        self.assertIn("height", error.sentence)
        self.assertGreaterEqual(len(error.issues), 2)
        self.assertIn("heigth", error.issues[0].excerpt)
        file = self.folder / "wrong.yaml"
        file.write_text(PACK, encoding="utf-8")
        for call in (oriel.label, oriel.interpret):
            self.assertEqual(self.refused("R204", call, HOUSE if call is oriel.label else oriel.segment(HOUSE),
                                          file).place.file, str(file))

    def test_warnings_are_returned_and_nothing_is_printed(self):
        pack = oriel.Pack.from_text(PACK.replace("heigth", "height").replace("dor,", "door,").replace("door", "gadget"))
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            labelled = oriel.label(HOUSE, pack)
            issues = oriel.write(self.folder / "out.city.json", labelled)
        self.assertEqual({issue.code for issue in issues}, {"R258"})
        self.assertEqual(issues[0].severity, "warning")
        self.assertEqual((out.getvalue(), err.getvalue()), ("", ""))

    def test_a_building_that_is_rejected_says_why(self):
        buildings = oriel.read_text(OPEN_CUBE)
        results = oriel.label(buildings)
        self.assertTrue(results["cube"].is_open)
        repaired = oriel.repair(buildings, close="none")
        self.assertFalse(repaired[0].is_solid)
        self.assertIn("error", [issue.severity for issue in repaired.issues])
        drawn = oriel.generalise(results, to_lod="1.2")
        self.assertFalse(drawn[0].is_drawn)
        self.assertEqual(drawn.issues[-1].place.building, "cube")
        self.assertEqual(oriel.to_text(drawn), OPEN_CUBE)

    def test_a_faulty_file_gives_the_bytes_of_the_command(self):
        inputs = [path for path in sorted((SOURCES / "tests" / "data" / "errors").iterdir())
                  if path.suffix in (".json", ".jsonl", ".gml", ".obj", ".off", ".ply")]
        self.assertGreater(len(inputs), 20)
        for path in inputs:
            name = "out.city.jsonl" if path.suffix == ".jsonl" else "out.city.json"
            ours, theirs = self.folder / name, self.folder / ("theirs." + name)
            with self.subTest(path.name):
                try:
                    oriel.write(ours, oriel.label(path))
                except oriel.Error as error:
                    self.assertTrue(error.code)
                run("label", path, "-o", theirs)
                self.assertEqual(ours.exists(), theirs.exists())
                if ours.exists():
                    self.assert_same_bytes(ours, theirs)
                ours.unlink(missing_ok=True)
                theirs.unlink(missing_ok=True)

    def test_nothing_half_written_is_left(self):
        labelled = oriel.label(HOUSE)
        self.refused("E601", oriel.write, self.folder / "no" / "folder" / "out.city.json", labelled)
        self.refused("E106", oriel.write, self.folder / "out.docx", labelled)
        self.refused("E106", oriel.write, self.folder / "out.city.jsonl", labelled)
        self.refused("E106", oriel.write_features, self.folder / "out.xlsx", labelled)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_values_beyond_their_range_are_refused(self):
        building = oriel.read(HOUSE)[0]
        for options in ({"coplanar_deg": 31}, {"weld": 0}, {"plane_offset": -1}, {"close": "all"}, {"order": "mine"},
                        {"crossings": "keep"}, {"budget": 0}, {"codelist": "mine"}, {"value_rel": float("nan")}):
            with self.subTest(options), self.assertRaisesRegex(ValueError, next(iter(options))):
                oriel.label(building, **options)
        with self.assertRaises(TypeError):
            oriel.label(building, colse="none")
        with self.assertRaises(ValueError):
            oriel.score(oriel.label(building), TRUTH, iou=0)

    def test_targets_that_are_none_are_refused(self):
        labelled = oriel.label(HOUSE)
        self.refused("E125", oriel.generalise, labelled, scale=0.5)
        self.refused("R275", oriel.generalise, labelled, to_lod="9")
        for options in ({}, {"scale": "big"}, {"scale": 5000, "to_lod": "2.0"}, {"to_lod": ["2.0", "2.0"]},
                        {"scale": 5000, "edge_min": 1}, {"to_lod": "2.0", "edge_min": 100}):
            with self.subTest(options), self.assertRaises(ValueError):
                oriel.generalise(labelled, **options)
        with self.assertRaisesRegex(ValueError, "segmented only"):
            oriel.generalise(oriel.segment(HOUSE), scale=5000)

    def test_a_feature_that_is_not_there_has_neighbours(self):
        result = oriel.label(HOUSE)[0]
        with self.assertRaisesRegex(KeyError, "chimney 1 of roof slope north"):
            oriel.explain(result, "chimney 2 of roof slope north")
        with self.assertRaisesRegex(KeyError, "features start with"):
            oriel.explain(result, "window")
        with self.assertRaisesRegex(ValueError, "segmented only"):
            oriel.explain(oriel.segment(HOUSE)[0], "chimney")
        with self.assertRaises(KeyError):
            oriel.features(result)["heigth_m"]

    def test_truth_of_other_buildings_is_noticed(self):
        score = oriel.score(oriel.label(SAMPLES / "hip.stripped.city.json"), TRUTH)
        self.assertEqual([issue.code for issue in score.issues], ["E131"])
        self.assertIn("house", score.issues[0].sentence)
        self.refused("E112", oriel.read_truth, HOUSE)

    def test_only_what_was_read_can_be_written(self):
        labelled = oriel.label(HOUSE)
        for items in ([], [*labelled, *oriel.label(HOUSE)]):
            with self.assertRaises(ValueError):
                oriel.write(self.folder / "out.city.json", items)
        with self.assertRaises(TypeError):
            oriel.write(self.folder / "out.city.json", ["house"])

    def test_no_building_is_no_fault(self):
        empty = '{"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},"CityObjects":{},"vertices":[]}'
        buildings = oriel.read_text(empty)
        self.assertEqual(len(buildings), 0)
        labelled = oriel.label(buildings)
        self.assertEqual([issue.code for issue in labelled.issues], ["E209"])
        self.assertEqual(len(labelled), 0)
        self.assertEqual(oriel.to_text(labelled), empty)
        self.assertEqual(oriel.features(labelled).count, 0)
        self.assertEqual(len(oriel.generalise(labelled, scale=5000)), 0)


if __name__ == "__main__":
    unittest.main()
