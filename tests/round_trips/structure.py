"""What the schemas of CityGML ask of the elements that oriel writes: their order, unique ids, links, closed rings.

With $ORIEL_CITYGML_SCHEMAS, a folder with v2.xsd and v3.xsd that import the schemas, xmllint validates the files, too.
"""
import os
import subprocess
import xml.etree.ElementTree as tree

GML = ("name", "description", "boundedBy")
LEVELS_2 = "lod0FootPrint lod0RoofEdge lod1Solid lod1MultiSurface lod2Solid lod2MultiSurface"
BUILDING = "class function usage roofType storeysAboveGround storeysBelowGround buildingConstructiveElement buildingInstallation buildingPart"
SPACE = "genericAttribute boundary lod0MultiSurface lod1Solid lod2Solid lod2MultiSurface lod3Solid lod3MultiSurface"
SURFACES = ("WallSurface", "RoofSurface", "GroundSurface", "ClosureSurface", "OuterCeilingSurface", "OuterFloorSurface")
OF_SURFACES = "genericAttribute lod0MultiSurface lod1MultiSurface lod2MultiSurface lod3MultiSurface fillingSurface"
# After description, name and boundedBy of GML; `*` stands for generic attributes.
ORDERS = {
    "citygml2": {
        "Building": "creationDate terminationDate * class function usage yearOfConstruction yearOfDemolition roofType measuredHeight "
                    f"storeysAboveGround storeysBelowGround storeyHeightsAboveGround storeyHeightsBelowGround {LEVELS_2} "
                    "outerBuildingInstallation boundedBy lod3Solid lod3MultiSurface consistsOfBuildingPart",
        "BuildingInstallation": "creationDate terminationDate * class function usage lod2Geometry lod3Geometry boundedBy",
        **{name: "creationDate terminationDate * lod2MultiSurface lod3MultiSurface opening" for name in SURFACES},
        **{name: "creationDate terminationDate * lod3MultiSurface" for name in ("Window", "Door")}},
    "citygml3": {
        "Building": f"creationDate terminationDate validFrom validTo {SPACE} height {BUILDING}",
        "BuildingInstallation": f"creationDate terminationDate validFrom validTo {SPACE} class function usage",
        "BuildingConstructiveElement": f"creationDate terminationDate validFrom validTo {SPACE} class function usage",
        **{name: f"creationDate terminationDate validFrom validTo {OF_SURFACES}" for name in (*SURFACES, "WindowSurface", "DoorSurface")}}}
for orders in ORDERS.values():
    orders["BuildingPart"] = orders["Building"]
GENERIC_2 = ("stringAttribute", "intAttribute", "doubleAttribute", "genericAttributeSet")
ID = ("{http://www.opengis.net/gml}id", "{http://www.opengis.net/gml/3.2}id")
LINK = "{http://www.w3.org/1999/xlink}href"


def local(element):
    return element.tag.rpartition("}")[2]


def kind(element):
    """`boundedBy` is an element of GML and one of buildings."""
    if local(element) in GML and "/gml" in element.tag:
        return "gml:" + local(element)
    return "*" if local(element) in GENERIC_2 else local(element)


def order_fault(element, order):
    names = ["gml:description", "gml:name", "gml:boundedBy", *order.split()]
    last = 0
    for child in element:
        if kind(child) not in names:
            return f"{local(element)} has no {kind(child)}"
        place = names.index(kind(child))
        if place < last:
            return f"in {local(element)}, {kind(child)} comes after {names[last]}"
        last = place
    return None


def ring_fault(ring):
    numbers = ring.text.split()
    if len(numbers) < 12 or len(numbers) % 3 != 0 or numbers[:3] != numbers[-3:]:
        return f"a ring of {len(numbers)} numbers: {ring.text[:60]}"
    return None


def faults(path, version):
    """The first few, as sentences."""
    found, ids, links = [], set(), []
    for element in tree.parse(path).iter():
        order = ORDERS[version].get(local(element))
        fault = order_fault(element, order) if order else ring_fault(element) if local(element) == "posList" else None
        if fault:
            found.append(fault)
        for key in ID:
            if key in element.attrib:
                if element.attrib[key] in ids:
                    found.append(f"the id {element.attrib[key]} twice")
                ids.add(element.attrib[key])
        if LINK in element.attrib:
            links.append(element.attrib[LINK])
    found += [f"a link to {link}" for link in links if link[0] != "#" or link[1:] not in ids]
    schemas = os.environ.get("ORIEL_CITYGML_SCHEMAS")
    if schemas:
        done = subprocess.run(["xmllint", "--nonet", "--huge", "--noout", "--schema", f"{schemas}/v{version[-1]}.xsd", path],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            found.append(done.stderr[:400])
    return found[:3]
