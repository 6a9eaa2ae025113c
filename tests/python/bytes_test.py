"""The module gives the bytes of the command."""
import base64
import json
import unittest
import xml.etree.ElementTree as ET

import oriel
from oriel.buildings import Items
from support import GENERATE, HOUSE, OPEN_CUBE, SAMPLES, TRUTH, FolderTest, run, stripped_samples


class BytesTest(FolderTest):
    def compare(self, name, items, *words, **options):
        """What write() makes of the items is what the command writes."""
        ours, theirs = self.folder / ("ours" + name), self.folder / ("theirs" + name)
        oriel.write(ours, items, **options)
        run(*words, "-o", theirs)
        self.assert_same_bytes(ours, theirs)

    def test_labels_of_every_sample(self):
        samples = stripped_samples()
        self.assertGreaterEqual(len(samples), 8)
        for sample in samples:
            with self.subTest(sample.name):
                self.compare(".city.json", oriel.label(sample), "label", sample)

    def test_buildings_redrawn_for_scales_and_levels_of_detail(self):
        labelled = oriel.label(HOUSE)
        for scale in (2000, "1:5000", "1 : 20000"):
            with self.subTest(scale):
                self.compare(".city.json", oriel.generalise(labelled, scale=scale), "generalise", HOUSE, "--scale", scale)
        self.compare(".city.json", oriel.generalise(HOUSE, to_lod=["2.0", "1.2"]), "generalise", HOUSE, "--to-lod", "2.0,1.2")
        self.compare(".stl", oriel.generalise(labelled, to_lod="2.0"), "generalise", HOUSE, "--to-lod", "2.0")
        self.compare(".city.json", oriel.generalise(labelled, profile="lod:2.0", edge_min=0.4), "generalise", HOUSE,
                     "--profile", "lod:2.0", "--edge-min", 0.4)

    def test_pictures(self):
        labelled = oriel.label(HOUSE)
        for ending, options, words in (("png", {}, []), ("svg", {"facade": 180, "dark": True}, ["--facade", "south", "--dark"]),
                                       ("pdf", {"plan": True, "size": (300, 200)}, ["--plan", "--size", "300,200"])):
            with self.subTest(ending):
                theirs = self.folder / f"theirs.{ending}"
                run("view", HOUSE, *words, "-o", theirs)
                self.assertEqual(oriel.picture(labelled, format=ending, **options), theirs.read_bytes())
        self.assertTrue(labelled._repr_png_().startswith(b"\x89PNG"))
        self.assertTrue(labelled[0]._repr_png_().startswith(b"\x89PNG"))
        with self.assertRaises(ValueError):
            oriel.picture(labelled, size=(0, 5))

    def test_a_notebook_shows_a_picture_with_the_counts_of_labels(self):
        labelled = oriel.label(HOUSE)
        svg = oriel.picture(labelled, format="svg", size=(900, 600))
        for shown in (labelled._repr_html_(), labelled["house"]._repr_html_()):
            image = ET.fromstring(shown).find("img")
            start = "data:image/svg+xml;base64,"
            self.assertTrue(image.get("src").startswith(start))
            self.assertEqual(base64.b64decode(image.get("src")[len(start):]), svg)
            self.assertEqual(ET.fromstring(shown).findtext("figcaption"),
                             "house: 1 balcony, 1 canopy, 1 chimney, 2 door, 2 dormer, 1 stairs, 16 window, 29 unknown")
        two = [sample for name in ("house", "hip") for sample in oriel.label(SAMPLES / f"{name}.stripped.city.json")]
        self.assertIn("<figcaption>2 buildings: ", Items(two)._repr_html_())
        self.assertIsNone(oriel.read(HOUSE)._repr_html_())
        self.assertIsNone(oriel.read(HOUSE)._repr_png_())

    def test_a_notebook_shows_names_and_faults_as_text(self):
        text = OPEN_CUBE.replace('"cube"', '"<b>a & \\"b\\"</b>"')
        far = [item for x in (0, 900_000) for item in
               oriel.label(oriel.read_text(text.replace('"translate":[0', f'"translate":[{x}'), name="far.city.json"))]
        self.assertIn("&lt;b&gt;a &amp; &quot;b&quot;&lt;/b&gt;: no labels", far[0]._repr_html_())
        self.assertIsNotNone(far[0]._repr_png_())
        self.assertIn("E163", ET.fromstring(Items(far)._repr_html_()).findtext("p"))
        self.assertIsNone(Items(far)._repr_png_())

    def test_repaired_buildings(self):
        for name in ("house", "block"):
            sample = SAMPLES / f"{name}.stripped.city.json"
            self.compare(".city.json", oriel.repair(sample), "repair", sample)

    def test_labels_with_options(self):
        noisy = SAMPLES / "house-noisy.stripped.city.json"
        self.compare(".city.json", oriel.label(HOUSE, explain=True), "label", HOUSE, "--explain")
        self.compare(".city.json", oriel.label(noisy, repaired=True), "label", noisy, "--repaired")
        self.compare(".city.json", oriel.label(noisy, plane_offset=0.004, order="paper", close="none"), "label", noisy,
                     "--plane-offset", 0.004, "--order", "paper", "--close", "none")
        labelled = SAMPLES / "house.labelled.city.json"
        self.compare(".city.json", oriel.label(labelled, ignore_semantics=True), "label", labelled, "--existing", "replace",
                     "--ignore-semantics", existing="replace")

    def test_neighbours(self):
        city = self.folder / "town.city.jsonl"
        run("--style", "city", "--count", 16, "--seed", 5, "-o", city, command=GENERATE)
        self.compare(".city.jsonl", oriel.label(city, neighbours=True, jobs=2), "label", city, "--neighbours")
        self.assertIn("oriel_party_wall", (self.folder / "ours.city.jsonl").read_text())
        lines = city.read_text().splitlines(keepends=True)
        half = self.folder / "half.city.jsonl"
        half.write_text("".join(lines[:9]))
        self.compare(".city.jsonl", oriel.label(half, neighbours=city), "label", half, f"--neighbours={city}")
        one = oriel.label(oriel.read(half)[2], neighbours=[city])
        self.assertTrue(one.has_neighbours)
        self.assertEqual(oriel.to_text(one).splitlines()[3], (self.folder / "theirs.city.jsonl").read_text().splitlines()[3])
        self.compare(".city.jsonl", oriel.generalise(city, scale=2000, neighbours=True), "generalise", city, "--scale",
                     "1:2000", "--neighbours")

    def test_rows_and_blocks(self):
        city, town = self.folder / "town.city.jsonl", self.folder / "town.yaml"
        run("--style", "city", "--count", 16, "--seed", 5, "-o", city, command=GENERATE)
        town.write_text("schema: oriel-profile/1\nprofile: {name: town, version: 1.0.0}\nlevels:\n  map: {form: as-is, "
                        "map-mm: 0.3, verdicts: {point: omit}, buildings: {aggregate: touching, gap-mm: 0.2}}\n")
        drawn = oriel.generalise(city, scale=10000, profile=str(town), neighbours=True)
        self.compare(".city.jsonl", drawn, "generalise", city, "--scale", "1:10000", "--profile", town, "--neighbours")
        self.assertTrue(any(one.is_gone for one in drawn))
        alone = oriel.generalise(city, scale=10000, profile=str(town))
        self.assertEqual([issue.code for issue in alone.issues if issue.code == "R277"], ["R277"])
        self.assertFalse(any(one.is_gone for one in alone))

    def test_meshes(self):
        for name in (".gml", ".gpkg", ".obj", ".off", ".ply", ".stl"):
            with self.subTest(name):
                self.compare(name, oriel.label(HOUSE), "label", HOUSE)

    def test_streams_and_texts(self):
        stream, _ = self.houses()
        labelled = oriel.label(oriel.read(stream), jobs=2)
        self.compare(".city.jsonl", labelled, "label", stream)
        self.assertEqual(oriel.to_text(labelled), (self.folder / "theirs.city.jsonl").read_text())
        self.assertEqual(oriel.to_text(oriel.read(stream)), stream.read_text())
        again = oriel.read_text(stream.read_text(), from_="cityjsonseq")
        self.assertEqual(oriel.to_text(oriel.label(again)), oriel.to_text(labelled))

    def test_the_text_of_a_mesh_is_called_by_its_name(self):
        mesh = self.folder / "house.obj"
        oriel.write(mesh, oriel.read(HOUSE))
        by_text = oriel.read_text(mesh.read_text(), from_="obj", name="house.obj")
        self.assertEqual(by_text[0].id, "house")
        self.assertEqual(oriel.to_text(oriel.label(by_text)), oriel.to_text(oriel.label(mesh)))

    def test_what_was_not_labelled_stays_unchanged(self):
        stream, _ = self.houses()
        buildings = oriel.read(stream)
        some = [oriel.label(building) for building in buildings[1:3]]
        lines = oriel.to_text(some).splitlines()
        before, after = stream.read_text().splitlines(), oriel.to_text(oriel.label(buildings)).splitlines()
        self.assertEqual([line == old for line, old in zip(lines, before)], [True, True, False, False, True])
        self.assertEqual(lines[2:4], after[2:4])

    def test_reasons(self):
        result = oriel.label(HOUSE)["house"]
        name = "chimney 1 of roof slope north"
        explanation = oriel.explain(result, name)
        self.assertEqual(explanation.json + "\n", run("explain", HOUSE, name, "--json"))
        self.assertEqual(str(explanation), run("explain", HOUSE, name))
        self.assertEqual(explanation.full_text, run("explain", HOUSE, name, "--full"))
        self.assertEqual(oriel.explain_json(result) + "\n", run("explain", HOUSE, "--json"))
        self.assertEqual((explanation.label, explanation.name), ("chimney", name))
        self.assertEqual(oriel.explain(result, explanation.feature[:5]).feature, explanation.feature)
        self.assertEqual([one.feature for one in oriel.explain(result)], list(oriel.features(result)["id"]))

    def test_scores(self):
        records = self.folder / "parts.csv"
        labelled = oriel.label(HOUSE)
        oriel.write_features(records, labelled)
        words = ["score", records, "--truth", TRUTH, "--bootstrap", 50, "--by-rule", "--models", HOUSE]
        for labels in (labelled, labelled[0], oriel.features(labelled), records):
            score = oriel.score(labels, TRUTH, bootstrap=50, by_rule=True, models=HOUSE)
            self.assertEqual(score.json + "\n", run(*words, "--json"))
            self.assertEqual(str(score), run(*words))
            self.assertEqual(score.issues, [])
        members = json.loads(score.json)
        self.assertEqual(members["classes"]["window"]["f1"], score.classes["window"].f1)
        self.assertEqual(oriel.score(labelled, oriel.read_truth(TRUTH), iou=0.7).json + "\n",
                         run("score", records, "--truth", TRUTH, "--iou", 0.7, "--json"))


if __name__ == "__main__":
    unittest.main()
