"""Tables of a house are the same in every program that reads them."""
import json
import shutil
import subprocess
import unittest
import warnings

import oriel
from support import HOUSE, FolderTest, imported, run

BOX = ("xmin_m", "ymin_m", "zmin_m", "xmax_m", "ymax_m", "zmax_m")


def plain(value):
    """A text, a number (yes/no: 1 or 0), or None where it is missing, whatever a program has for that."""
    if value is None or str(value) in ("", "<NA>", "nan"):
        return None
    return value if isinstance(value, str) else float(value)


def plain_rows(rows, without=()):
    return [{name: plain(value) for name, value in row.items() if name not in without} for row in rows]


def types_of(rows):
    """The columns in their order, each with the types of its values that are not missing."""
    return [(name, {type(row[name]) for row in rows} - {type(None)}) for name in rows[0]]


def printed(program, *words):
    if not shutil.which(program):
        raise unittest.SkipTest(f"{program} is not installed")
    return subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=True).stdout


def by_pandas(path):
    return imported("pandas").read_csv(path, float_precision="round_trip").to_dict("records")


def by_csvkit(path):
    return json.loads(printed("csvjson", path))


def by_duckdb(path):
    return json.loads(printed("duckdb", "-json", "-c", f"FROM '{path}'"))


def by_geopandas(path, layer):
    """GeoPandas and pandas warn of what their own parts do."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return imported("geopandas").read_file(path, layer=layer).drop(columns="geometry").to_dict("records")


class TablesTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.csv = {name: self.folder / f"{name}.csv" for name in ("features", "energy", "envelope")}
        self.package = self.folder / "house.gpkg"
        run("label", HOUSE, "-o", self.package, "--features", self.csv["features"], "--table", f"energy={self.csv['energy']}",
            "--table", f"envelope={self.csv['envelope']}")

    def features(self):
        imported("pandas")
        return oriel.features(oriel.label(HOUSE)).to_pandas().to_dict("records")

    def compare(self, read):
        further = {"aabb_m", "source_polygons", *("rel_" + name for name in oriel.relation_schema)}
        for name, path in self.csv.items():
            with self.subTest(name):
                # Python has the box as six columns, and relations apart; lod is a text in tables of energy.
                ours = plain_rows(self.features() if name == "features" else oriel.energy(oriel.label(HOUSE), name), BOX)
                for row in ours:
                    if "lod" in row:
                        row["lod"] = float(row["lod"])
                theirs = plain_rows(read(path), further)
                self.assertEqual(types_of(theirs), types_of(ours))
                self.assertEqual(theirs, ours)

    def test_pandas_has_what_python_has(self):
        self.compare(by_pandas)

    def test_csvkit_has_what_python_has(self):
        self.compare(by_csvkit)

    def test_duckdb_has_what_python_has(self):
        self.compare(by_duckdb)

    def test_geopandas_has_what_python_has(self):
        """Of the features of a package: those with a label, in the order in which surfaces name them."""
        rows = {(row["building"], row["id"]): row for row in plain_rows(self.features()) if row["label"]}
        columns = set(next(iter(rows.values())))
        theirs = by_geopandas(self.package, "features")
        theirs = plain_rows(theirs, set(theirs[0]) - columns)  # attributes of installations
        self.assertEqual(columns - set(theirs[0]), {*BOX, "parent", "groups", "corrected_by", "corrected_why"})
        self.assertEqual({(row["building"], row["id"]) for row in theirs}, set(rows))
        ours = [{name: rows[row["building"], row["id"]][name] for name in row} for row in theirs]
        self.assertEqual(types_of(theirs), types_of(ours))
        self.assertEqual(theirs, ours)

    def test_geopandas_joins_the_layers_by_the_ids(self):
        ids = {name: [(row["building"], row.get("id")) for row in plain_rows(by_geopandas(self.package, name))]
               for name in ("buildings", "surfaces", "features")}
        self.assertEqual(len(set(ids["features"])), len(ids["features"]))
        self.assertEqual({building for building, _ in ids["features"]}, {building for building, _ in ids["buildings"]})
        self.assertLess(set(ids["surfaces"]) - {("house", None)}, set(ids["features"]))
        self.assertGreater(len(set(ids["surfaces"])), 10)


if __name__ == "__main__":
    unittest.main()
