"""Features are the columns of the tables of the command."""
import csv
import json
import unittest

import numpy as np

import oriel
from support import HOUSE, FolderTest, imported, run

BOX = ["xmin_m", "ymin_m", "zmin_m", "xmax_m", "ymax_m", "zmax_m"]


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class FeaturesTest(FolderTest):
    def test_energy_has_the_rows_of_the_command(self):
        labelled = oriel.label(HOUSE)
        for table in ("energy", "envelope"):
            path = self.folder / (table + ".json")
            run("label", HOUSE, "--table", f"{table}={path}")
            self.assertEqual(json.loads(path.read_text()), oriel.energy(labelled, table))
        self.assertGreater(oriel.energy(labelled, unheated=[])[0]["volume_m3"], oriel.energy(labelled)[0]["volume_m3"])
        with self.assertRaises(ValueError):
            oriel.energy(labelled, "heat")
        with self.assertRaises(ValueError):
            oriel.energy(oriel.segment(HOUSE))
        with self.assertRaisesRegex(ValueError, "did you mean 'balcony'"):
            oriel.energy(labelled, unheated=["balkony"])

    def compare_column(self, rows, name, column):
        if column.dtype.kind == "U":
            self.assertEqual([row[name] for row in rows], list(column), name)
        else:
            expected = [float(row[name]) if row[name] else np.nan for row in rows]
            np.testing.assert_array_equal(expected, column, name)

    def compare_lists(self, rows, field, lists, names):
        for i, row in enumerate(rows):
            self.assertEqual(row[field], ";".join(str(names[k]) for k in lists[i]), field)

    def compare_relation(self, rows, field, lists, names):
        """Of a class such as #3/12 all members are related (docs/tables.md)."""
        members = {}
        for row in rows:
            members.setdefault((row["building"], row[field]), []).append(row["id"])
        for i, row in enumerate(rows):
            ours = [str(names[k]) for k in lists[i]]
            if row[field].startswith("#"):
                theirs = [x for x in members[row["building"], row[field]] if x != row["id"]]
                self.assertEqual(sorted(theirs), sorted(ours), field)
            else:
                self.assertEqual(row[field], ";".join(ours), field)

    def test_columns_and_relations_have_what_the_table_says(self):
        stream, _ = self.houses(2)
        parts = self.folder / "parts.csv"
        run("label", stream, "--features", parts)
        rows = rows_of(parts)
        for features in (oriel.features(oriel.label(stream)), oriel.read_features(parts)):
            self.assertEqual(features.count, len(rows))
            self.assertEqual(len(features), len(list(features)))
            compared = {"aabb_m", "source_polygons"}
            for name in features:
                if name in BOX:
                    continue
                self.compare_column(rows, name, features[name])
                compared.add(name)
            boxes = np.stack([features[name] for name in BOX], axis=1)
            np.testing.assert_array_equal(boxes, [[float(x) for x in row["aabb_m"].split(";")] for row in rows])
            self.compare_lists(rows, "source_polygons", features.relations["source_polygons"], range(10_000))
            for relation in oriel.relation_schema:
                if relation != "host":
                    self.compare_relation(rows, "rel_" + relation, features.relations[relation], features["id"])
                    compared.add("rel_" + relation)
            self.assertEqual(compared, set(rows[0]))

    def test_tables_have_the_bytes_of_the_command(self):
        labelled, segmented = oriel.label(HOUSE), oriel.segment(HOUSE)
        for name in ("parts.csv", "parts.json", "parts.jsonl"):
            for command, results in (("label", labelled), ("segment", segmented)):
                with self.subTest(command + " " + name):
                    ours, theirs = self.folder / name, self.folder / ("theirs." + name)
                    oriel.write_features(ours, results)
                    run(command, HOUSE, "--features", theirs)
                    self.assert_same_bytes(ours, theirs)

    def test_stored_features_get_the_labels_of_their_building(self):
        stream, _ = self.houses(2)
        parts, ours, theirs = (self.folder / name for name in ("parts.csv", "ours.csv", "theirs.csv"))
        segmented, labelled = oriel.segment(stream), oriel.features(oriel.label(stream))
        oriel.write_features(parts, segmented)
        stored = oriel.read_features(parts)
        self.assertEqual(set(stored["label"]), {""})
        for named in (oriel.interpret(stored), oriel.interpret(segmented), oriel.interpret(parts)):
            for column in ("label", "score", "margin", "rule", "runner_up", "name", "groups", "part_of"):
                np.testing.assert_array_equal(named[column], labelled[column], column)
        self.assertEqual(set(stored["label"]), {""})
        oriel.write_features(ours, oriel.interpret(parts))
        run("interpret", parts, "-o", theirs)
        self.assert_same_bytes(ours, theirs)

    def test_every_attribute_has_a_unit_and_a_meaning(self):
        features = oriel.features(oriel.segment(HOUSE))
        self.assertLessEqual(set(oriel.schema), set(features))
        for column, attribute in oriel.schema.items():
            self.assertIn(attribute.unit, ("m", "m2", "m3", "deg", "count", "ratio", "text", "yes/no"))
            self.assertTrue(attribute.meaning)
            self.assertEqual(features[column].dtype.kind == "U", attribute.unit == "text", column)
            self.assertEqual(features[column].shape, (features.count,))
        self.assertEqual(oriel.schema["height_m"].unit, "m")
        self.assertTrue(all(oriel.relation_schema.values()))

    def test_nothing_is_a_table_without_rows(self):
        features = oriel.features([])
        self.assertEqual(features.count, 0)
        self.assertEqual(features["label"].shape, (0,))
        self.assertEqual(features["height_m"].shape, (0,))
        self.assertEqual(len(features.relations["contains"]), 0)
        self.assertEqual(oriel.interpret(features)["label"].shape, (0,))

    def test_lists_are_cut_from_two_arrays(self):
        lists = oriel.features(oriel.segment(HOUSE)).relations["contains"]
        self.assertEqual(lists.starts[0], 0)
        self.assertEqual(lists.starts[-1], len(lists.others))
        self.assertEqual(sum(len(lists[row]) for row in lists), len(lists.others))
        with self.assertRaises(KeyError):
            lists[len(lists)]

    def test_no_mapping_is_taken_for_its_keys(self):
        features = oriel.features(oriel.label(HOUSE))
        for mapping in (features, features.relations, features.relations["contains"]):
            with self.assertRaisesRegex(TypeError, "call to_pandas()"):
                np.asarray(mapping)
            with self.assertRaisesRegex(TypeError, "call to_pandas()"):
                imported("pandas").DataFrame(mapping)

    def test_pandas_has_the_columns_with_their_types(self):
        pandas = imported("pandas")
        features = oriel.features(oriel.label(HOUSE))
        frame = features.to_pandas()
        self.assertEqual(list(frame), list(features))
        types = {"text": "string", "count": "Int64", "yes/no": "boolean"}
        for name, attribute in oriel.schema.items():
            self.assertEqual(str(frame[name].dtype), types.get(attribute.unit, "float64"), name)
        for name, column in features.items():
            if column.dtype.kind == "U":
                self.assertEqual(list(frame[name].fillna("")), list(column), name)
            else:
                np.testing.assert_array_equal(frame[name].astype("Float64").to_numpy(float, na_value=np.nan), column, name)
        self.assertTrue(frame["label"].isna().any() and frame["storey"].isna().any())
        nothing = oriel.features([]).to_pandas()
        pandas.testing.assert_series_equal(nothing.dtypes, frame.dtypes)
        self.assertEqual(len(nothing), 0)


if __name__ == "__main__":
    unittest.main()
