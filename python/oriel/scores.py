"""Labels compared with truth."""
from __future__ import annotations

import glob
import os
from typing import Any, Iterable, Optional, Union

from . import _oriel
from ._oriel import Building, Result, Score, Truth
from .buildings import Path, buildings_of
from .errors import Error
from .features import Features, feature_set
from .packs import Rules, pack_of


def read_truth(paths: Union[Path, Iterable[Path]]) -> Truth:
    """The true objects of buildings: of *.truth.json files, of lines of *.truth.jsonl, or of all of these in a folder.

    Raises Error if nothing can be read; of several buildings those with faults are left out and are in `issues` (E112).
    """
    several = [paths] if isinstance(paths, (str, os.PathLike)) else list(paths)
    files: list[str] = []
    for one in several:
        path = os.fspath(one)
        if os.path.isdir(path):
            files += sorted(glob.glob(os.path.join(glob.escape(path), "*.truth.json")) +
                            glob.glob(os.path.join(glob.escape(path), "*.truth.jsonl")))
        else:
            files.append(path)
    truth = _oriel.read_truth(files)
    if not truth.buildings and truth.issues:
        raise Error(truth.issues)
    return truth


def score(labels: Union[Features, Path, Result, Iterable[Result]], truth: Union[Truth, Path, Iterable[Path]], *,
          iou: float = 0.5, bootstrap: int = 0, by_rule: bool = False, rules: Rules = "residential",
          models: Union[Building, Iterable[Building], Path, None] = None) -> Score:
    """Compares labels with truth, by the boxes of features and objects: precision, recall and F1 of every class.

    labels: what label() or interpret() gave, or the path of a table of features.
    truth: what read_truth() gave or takes.
    iou: least intersection over union for boxes to match, above 0 and up to 1.
    bootstrap: also 95 % intervals of F1, from this many samples of the buildings.
    by_rule: also each rule: what it decided, how much of that is right; `rules` is the pack that gave the labels.
    models: the buildings that were labelled: compare also by the area of polygons.

    Buildings of the truth without features are a warning E131 in `issues`.
    """
    known = truth if isinstance(truth, Truth) else read_truth(truth)
    base: Any = pack_of(rules)._base if by_rule else None
    buildings: Optional[list[Building]] = None if models is None else buildings_of(models)[0]
    return _oriel.score(feature_set(labels), known, iou, bootstrap, by_rule, base, buildings)
