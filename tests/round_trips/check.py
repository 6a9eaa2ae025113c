"""check.py ORIEL [--all] [FILE...]: what `label` writes as CityGML and GeoPackage has the labels, surfaces and counts of its CityJSON.

FILEs are samples of the project and every so-many-th file of the shared data if none are given; --all: all of the shared data.
"""
import collections
import os
import pathlib
import subprocess
import sys
import tempfile

import city_text
import gpkg
import structure

ROOT = pathlib.Path(__file__).resolve().parents[2]
STEP = 80  # of the shared data that is looked at by default


class Check:
    def __init__(self, oriel):
        self.oriel = oriel
        self.faults = 0
        self.counts = collections.Counter()

    def fault(self, text):
        self.faults += 1
        print("  FAIL", text)

    def run(self, *arguments):
        """Rejected buildings are written as they were."""
        done = subprocess.run([self.oriel, *arguments, "--progress", "none", "-j", "0"], capture_output=True, text=True, check=False)
        if done.returncode not in (0, 3, 5):
            self.fault(f"{' '.join(arguments)} ends with {done.returncode}: {done.stderr[-300:]}")
        return done.returncode in (0, 3)

    def file(self, path, folder):
        name = pathlib.Path(path).name
        base = f"{folder}/base.city.jsonl" if path.endswith(".jsonl") else f"{folder}/base.city.json"
        if not self.run("label", path, "-o", base):
            return
        expected = city_text.objects_of(base)
        self.counts["files"] += 1
        self.counts["objects"] += len(expected)
        for version in ("citygml2", "citygml3"):
            if not self.run("label", path, "--to", version, "-o", f"{folder}/a.gml"):
                continue
            for text in structure.faults(f"{folder}/a.gml", version):
                self.fault(f"{name} as {version}: {text}")
            if self.run("cat", f"{folder}/a.gml", "-o", f"{folder}/back.city.jsonl"):
                # Levels 0 and 1 of CityGML 2.0 have no surfaces.
                without = "01" if version == "citygml2" else ""
                self.citygml(f"{name} as {version}", without, expected, city_text.objects_of(f"{folder}/back.city.jsonl"))
        if self.run("label", path, "-o", f"{folder}/a.gpkg"):
            for text in gpkg.differences(f"{folder}/a.gpkg", expected, self.counts):
                self.fault(f"{name} as GeoPackage: {text}")

    def citygml(self, name, without, expected, found):
        for gone in sorted(set(expected) ^ set(found))[:3]:
            self.fault(f"{name}: {gone} is only {'written' if gone in expected else 'read'}")
        for key in sorted(set(expected) & set(found)):
            before, after = expected[key], found[key]
            for member in ("type", "parents"):
                if before[member] != after[member]:
                    self.fault(f"{name}: {key}: {member} {before[member]} became {after[member]}")
            self.attributes(f"{name}: {key}", before["attributes"], after["attributes"])
            self.geometry(f"{name}: {key}", without, before["geometries"], after["geometries"])

    def attributes(self, name, before, after):
        for key, value in before.items():
            value = city_text.as_text(value)
            if isinstance(value, (str, int, float)) and after.get(key) != value:
                self.fault(f"{name}: {key} was {value!r}, is {after.get(key)!r}")

    def geometry(self, name, without, before, after):
        """The one that has labels, polygon by polygon, in their order."""
        one = city_text.chosen(before)
        if one is None:
            return
        if one.lod[0] in without:
            one = one.without_surfaces()
        same = [g for g in after if g.named() == one.named()]
        if not same:
            levels = ", ".join(f"{g.lod} ({len(g.polygons)})" for g in after)
            self.fault(f"{name}: level {one.lod} with {len(one.polygons)} polygons is none of {levels}: {self.first(one, after)}")
        elif same[0].plain() != one.plain():
            self.fault(f"{name}: the polygons of level {one.lod} are in another order")
        self.counts["polygons"] += len(one.polygons)

    @staticmethod
    def first(one, after):
        other = max(after, key=lambda g: sum((g.named() & one.named()).values()), default=None)
        if other is None:
            return ""
        return f"{list((one.named() - other.named()).items())[:1]} became {list((other.named() - one.named()).items())[:1]}"


def shared_files():
    data = pathlib.Path(os.environ.get("ORIEL_SHARED") or ROOT / ".." / "shared") / "data"
    files = [str(path) for path in data.rglob("*") if path.name.endswith((".city.json", ".city.jsonl")) and path.parent.name != "faults"]
    if not files:
        print("skipped: the shared data, as there is no", data)
    return sorted(files)


def main():
    oriel, *files = sys.argv[1:]
    shared = shared_files() if not files or "--all" in files else []
    if "--all" in files:
        files = shared
    elif not files:
        small = [path for path in shared if os.path.getsize(path) < 200_000]
        files = sorted(str(path) for path in (ROOT / "examples/samples").glob("*.stripped.city.json")) + small[::STEP]
    check = Check(oriel)
    with tempfile.TemporaryDirectory() as folder:
        for path in files:
            check.file(path, folder)
    print(", ".join(f"{count} {what}" for what, count in check.counts.items()))
    print("all come back as they were" if check.faults == 0 else f"{check.faults} faults")
    return 0 if check.faults == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
