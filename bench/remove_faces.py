"""Takes 5 % of the faces out of stripped buildings, as if a survey had missed them: remove_faces.py OUT_FOLDER FILE…

Each face goes by a number that the building's id seeds, so that everybody takes the same ones. What is left is a MultiSurface."""
import json
import os
import random
import sys

SHARE = 0.05


def surfaces_of(geometry):
    if geometry["type"] == "Solid":
        return [surface for shell in geometry["boundaries"] for surface in shell]
    if geometry["type"] == "MultiSurface":
        return geometry["boundaries"]
    sys.exit(f"{geometry['type']} is not read here")


def remove_faces(model):
    for name, city_object in sorted(model["CityObjects"].items()):
        chance = random.Random(name)
        for geometry in city_object.get("geometry", []):
            geometry["boundaries"] = [s for s in surfaces_of(geometry) if chance.random() >= SHARE]
            geometry["type"] = "MultiSurface"
            geometry.pop("semantics", None)


def main(folder, files):
    for file in files:
        with open(file, encoding="utf-8") as text:
            model = json.load(text)
        remove_faces(model)
        with open(os.path.join(folder, os.path.basename(file)), "w", encoding="utf-8") as out:
            json.dump(model, out)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
