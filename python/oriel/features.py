"""Features as columns, and labels of stored features."""
from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any, Iterable, Iterator, NamedTuple, NoReturn, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _oriel
from ._oriel import FeatureSet, Issue, Result
from .buildings import Path
from .packs import Rules, pack_of


class Attribute(NamedTuple):
    """What a column says."""

    name: str
    """As rules call it: `height`."""
    unit: str
    """m, m2, m3, deg, count, ratio, text or yes/no (1 and 0)."""
    meaning: str
    words: list[str]
    """What a text can be; empty if it can be anything."""


schema: dict[str, Attribute] = {
    column: Attribute(name, unit, meaning, words) for column, name, unit, meaning, words in _oriel.schema_rows()
}
"""The columns of attributes, "height_m", with their units (docs/describe.md)."""

relation_schema: dict[str, str] = dict(_oriel.relation_rows())
"""The relations between features of a building, with their meaning."""


class _NoArray:
    """A mapping that NumPy and pandas.DataFrame refuse: they would take its keys for its values."""

    def __array__(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError(f"{self!r} is not one array: call to_pandas() of oriel.Features, or dict() for all its arrays")


class Lists(_NoArray, Mapping[int, npt.NDArray[np.int64]]):
    """A list of numbers for each feature: those of row i are `others[starts[i]:starts[i + 1]]`, which is `lists[i]`."""

    def __init__(self, starts: npt.NDArray[np.int64], others: npt.NDArray[np.int64]) -> None:
        self.starts = starts
        self.others = others

    def __len__(self) -> int:
        return len(self.starts) - 1

    def __iter__(self) -> Iterator[int]:
        return iter(range(len(self)))

    def __getitem__(self, row: int) -> npt.NDArray[np.int64]:
        if not 0 <= row < len(self):
            raise KeyError(row)
        return self.others[self.starts[row]:self.starts[row + 1]]

    def __repr__(self) -> str:
        return f"<oriel.Lists: {len(self.others)} numbers in {len(self)} lists>"


class _Relations(_NoArray, Mapping[str, Lists]):
    def __init__(self, features: FeatureSet) -> None:
        self._set = features

    def __len__(self) -> int:
        return len(_oriel.list_names())

    def __iter__(self) -> Iterator[str]:
        return iter(_oriel.list_names())

    def __getitem__(self, name: str) -> Lists:
        return Lists(*self._set.lists(name))


class Features(_NoArray, Mapping[str, npt.NDArray[Any]]):
    """A dict of columns, one row for each feature of all buildings: NumPy arrays of doubles (NaN: missing) or of texts
    (empty: missing).

    Columns are those of the command's tables of features (docs/tables.md): building, id, name, label, score ...,
    the box as xmin_m ... zmax_m, then all attributes, whose units are in `oriel.schema`. A column is made when it is
    asked for; to_pandas() has all of them, with types.
    """

    def __init__(self, features: FeatureSet) -> None:
        self._set = features
        self._columns: dict[str, npt.NDArray[Any]] = {}

    @property
    def issues(self) -> list[Issue]:
        """What was found when they were read or labelled."""
        return self._set.issues

    @property
    def buildings(self) -> list[str]:
        """The ids of the buildings, in their order."""
        return self._set.buildings

    @property
    def count(self) -> int:
        """How many features there are: the length of each column."""
        return self._set.features

    @property
    def relations(self) -> Mapping[str, Lists]:
        """For each relation of `oriel.relation_schema` the rows that each row is related to; and `source_polygons`, the
        numbers of the polygons in it."""
        return _Relations(self._set)

    def to_pandas(self) -> Any:
        """All columns as a pandas.DataFrame: texts are string, counts Int64, yes/no boolean, all with NA where missing;
        other numbers are float64 with NaN."""
        import pandas  # type: ignore[import]

        frame = pandas.DataFrame(dict(self)).replace("", None)
        types = {"count": "Int64", "yes/no": "boolean"}
        kinds = {name: types.get(attribute.unit, "float64") for name, attribute in schema.items()}
        return frame.astype({name: "string" if self[name].dtype.kind == "U" else kinds.get(name, "float64") for name in self})

    def __len__(self) -> int:
        return len(_oriel.column_names())

    def __iter__(self) -> Iterator[str]:
        return iter(_oriel.column_names())

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        if name not in self._columns:
            column = self._set.column(name)
            self._columns[name] = np.array(column, dtype=np.str_) if isinstance(column, list) else column
        return self._columns[name]

    def __repr__(self) -> str:
        return f"<oriel.Features: {self.count} features of {len(self.buildings)} buildings>"


def features(results: Union[Result, Iterable[Result]]) -> Features:
    """The features of what segment() or label() gave, as columns. Buildings that were rejected have none."""
    return Features(feature_set(results))


def energy(results: Union[Result, Iterable[Result]], table: str = "energy", *,
           unheated: Iterable[str] = ("balcony", "canopy", "chimney", "stairs", "vent")) -> list[dict[str, Any]]:
    """The rows of the command's `label --table`, as dictionaries: of each building, or of each face of its envelope.

    results: what label() gave.
    table: "energy" (buildings) or "envelope" (faces); docs/energy.md has the columns.
    unheated: classes whose features are no part of the heated body.

    Raises ValueError for another table, for results without labels, and for a class that their pack does not have.
    """
    if table not in ("energy", "envelope"):
        raise ValueError(f"there is no table '{table}': energy, envelope")
    several = [results] if isinstance(results, Result) else list(results)
    rows: list[dict[str, Any]] = json.loads(_oriel.energy_text(several, table, list(unheated)))
    return rows


def read_features(path: Path) -> Features:
    """Features that are stored: .csv, .json or .jsonl, as write_features() and the command write them.

    A record that cannot be read is left out, and is in `issues` (E111). Raises Error if the file cannot be read.
    """
    return Features(_oriel.read_features(os.fspath(path)))


def write_features(path: Path, features: Union[Features, Result, Iterable[Result]]) -> None:
    """Writes one record for each feature: .csv, .json or .jsonl, with the bytes that `--features` writes.

    Raises Error for another name, or if the file cannot be written.
    """
    _oriel.write_features(os.fspath(path), feature_set(features))


def feature_set(features: Any) -> FeatureSet:
    """The features that an argument means: Features, results, or the path of a file."""
    if isinstance(features, Features):
        return features._set
    if isinstance(features, (str, os.PathLike)):
        return _oriel.read_features(os.fspath(features))
    return _oriel.features_of([features] if isinstance(features, Result) else list(features))


def interpret(features: Union[Features, Path, Result, Iterable[Result]], rules: Rules = "residential") -> Features:
    """Labels features by the rules of a pack, without their buildings: they get what label() would say of them.

    This is the quick way to try packs: the buildings are cut once, by segment() or label(). Returns the features with
    new labels; what is given stays as it is. Raises Error if the pack has faults.
    """
    return Features(_oriel.interpret(feature_set(features), pack_of(rules)._base))
