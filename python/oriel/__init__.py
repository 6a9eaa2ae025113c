"""oriel cuts a closed 3D building into its parts, names them by rules, and redraws the building for a map scale.

    import oriel
    buildings = oriel.read("house.city.json")
    labelled = oriel.label(buildings, "residential")
    oriel.write("labelled.city.json", labelled)

The functions give what the command `oriel` gives, byte for byte. docs/python.md shows them at work.
"""
from ._oriel import (
    Building,
    ClassScore,
    Explanation,
    File,
    Generalised,
    Issue,
    KnifeEdge,
    LearntParam,
    Learnt,
    Miss,
    Place,
    Proposal,
    Question,
    Repaired,
    Result,
    Score,
    Truth,
    __version__,
)
from .buildings import Items, picture, read, read_text, to_text, write
from .errors import Error
from .features import (
    Attribute,
    Features,
    Lists,
    energy,
    features,
    interpret,
    read_features,
    relation_schema,
    schema,
    write_features,
)
from .learning import learn
from .packs import Pack, Param, embedded_packs
from .scores import read_truth, score
from .stages import explain, explain_json, generalise, label, repair, segment

__all__ = [
    "Attribute", "Building", "ClassScore", "Error", "Explanation", "Features", "File", "Generalised", "Issue",
    "Items", "KnifeEdge", "Learnt", "LearntParam", "Lists", "Miss", "Pack", "Param", "Place", "Proposal", "Question",
    "Repaired", "Result", "Score", "Truth", "__version__", "embedded_packs", "energy", "explain", "explain_json",
    "features", "generalise", "interpret", "label", "learn", "picture", "read", "read_features", "read_text", "read_truth",
    "relation_schema", "repair", "schema", "score", "segment", "to_text", "write", "write_features",
]
