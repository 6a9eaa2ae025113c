"""Files: read, write, and the lists of what is read and made."""
from __future__ import annotations

import base64
import html
import os
import tempfile
from collections import Counter
from typing import Any, Generic, Iterable, Iterator, Sequence, TypeVar, Union

from . import _oriel
from ._oriel import Building, File, Issue, Made
from .errors import Error

Path = Union[str, "os.PathLike[str]"]
Item = TypeVar("Item", Building, _oriel.Result, _oriel.Repaired, _oriel.Generalised)


class Items(Sequence[Item], Generic[Item]):
    """Buildings of files, or what was made of them, in the order of the files. It never changes.

    `issues` has all that was found: in the files, in the pack, and in the buildings.
    """

    def __init__(self, items: Iterable[Item], files: Iterable[File] = (), issues: Iterable[Issue] = ()) -> None:
        self._items: list[Item] = list(items)
        self.files = list(files)
        self._issues = list(issues)

    @property
    def issues(self) -> list[Issue]:
        """What was found, in its order."""
        of_items = [issue for item in self._items if isinstance(item, Made) for issue in item.issues]
        return self._issues + of_items

    def __len__(self) -> int:
        return len(self._items)

    def __iter__(self) -> Iterator[Item]:
        return iter(self._items)

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, slice):
            return Items(self._items[key], self.files, self._issues)
        if isinstance(key, str):
            for item in self._items:
                if item.id == key:
                    return item
            raise KeyError(key)
        return self._items[key]

    def _made(self) -> list[Made]:
        return [item for item in self._items if isinstance(item, Made)]

    def _repr_png_(self) -> bytes | None:
        """What a notebook shows: a picture, of what was made."""
        return _png_of(self._made())

    def _repr_html_(self) -> str | None:
        """What a notebook shows: a picture with the counts of labels below it, of what was made."""
        return _html_of(self._made())

    def __repr__(self) -> str:
        shown = ", ".join(repr(item) for item in self._items[:3])
        more = f", ... {len(self) - 3} more" if len(self) > 3 else ""
        return f"[{shown}{more}]"


def read(path: Path, *, lod: str = "", from_: str = "") -> Items[Building]:
    """All buildings of a file: CityJSON, CityJSONSeq, CityGML, OBJ, OFF or PLY (docs/formats.md).

    lod: level of detail to read, as written in the input (default: of each building the highest).
    from_: format of the input: cityjson, cityjsonseq, citygml, obj, off, ply (default: from its name).

    A fault in one building, or in one line of a stream, costs that one and is in `issues`. Raises Error if nothing of
    the file can be read. The whole file is held in memory.
    """
    name = os.fspath(path)
    return _buildings_of(_oriel.read(name, name, lod, from_))


def read_text(text: str, *, from_: str = "cityjson", lod: str = "", name: str = "text") -> Items[Building]:
    """The same of the text of a file; `name` is what places and messages call it, and the id of a mesh without its
    ending."""
    with tempfile.TemporaryDirectory(prefix="oriel-") as folder:
        path = os.path.join(folder, os.path.basename(name) or "text")
        with open(path, "w", encoding="utf-8", newline="") as file:
            file.write(text)
        return _buildings_of(_oriel.read(path, name, lod, from_))


def _buildings_of(file: File) -> Items[Building]:
    if file.records == 0 and file.issues:
        raise Error(file.issues)
    return Items(file.buildings(), [file], file.issues)


def buildings_of(buildings: Any) -> tuple[list[Building], list[File], list[Issue]]:
    """The buildings that an argument means: a building, several, or the path of a file."""
    if isinstance(buildings, Building):
        return [buildings], [], []
    if isinstance(buildings, (str, os.PathLike)):
        buildings = read(buildings)
    if isinstance(buildings, Items):
        return list(buildings), buildings.files, buildings.issues
    return list(buildings), [], []


def _files_and_made(items: Any) -> tuple[list[File], list[Made]]:
    one_or_more = [items] if isinstance(items, (Building, Made)) else items
    files = list(one_or_more.files) if isinstance(one_or_more, Items) else []
    made = []
    for item in one_or_more:
        building = item.building if isinstance(item, Made) else item
        if not isinstance(building, Building):
            raise TypeError(f"{type(item).__name__} is nothing that can be written")
        files.append(building.file)
        if isinstance(item, Made):
            made.append(item)
    return list(dict.fromkeys(files)), made


def write(path: Path, items: Any, *, existing: str = "fill") -> list[Issue]:
    """Writes buildings with what was made of them: what read(), label(), repair() or generalise() gave.

    The name says the format: .city.json, .city.jsonl, .gml (CityGML 2.0), .gpkg, .obj, .off, .ply, .stl. All records of the file that the buildings
    were read from are written; what was made of none of their buildings stays unchanged. The file appears when it is
    whole, with the bytes that the command writes.

    existing: semantics that the input has: fill adds what is missing; keep does so and changes nothing else; replace
    overwrites them.

    Returns what was found: classes without a type in the output (R258). Raises Error if the name has no format that can
    be written, or the file cannot be written, and ValueError if the buildings are of several files: write those one by
    one.
    """
    files, made = _files_and_made(items)
    if len(files) != 1:
        raise ValueError(f"{len(files)} files cannot be written as one: write what is of one file at a time")
    return _oriel.write(os.fspath(path), files[0], made, existing)


def to_text(items: Any, *, existing: str = "fill") -> str:
    """The same as text: CityJSON, or the lines of a CityJSONSeq where that or CityGML was read."""
    files, made = _files_and_made(items)
    return "".join(_oriel.to_text(file, made, existing) for file in files)


def picture(made: Any, *, format: str = "png", azimuth: float = 150, elevation: float = 25, facade: float | None = None,
            plan: bool = False, size: tuple[int, int] = (1200, 900), dark: bool = False, transparent: bool = False,
            scale_bar: bool = False, legend: bool = True, grid: bool = False) -> bytes:
    """A picture of what was made of buildings, as `oriel view` draws it: the bytes of a PNG, SVG or PDF.

    made: a Result, Repaired or Generalised, or several.
    format: png, svg or pdf.
    azimuth, elevation: where the viewer stands, clockwise from north, and how high, in degrees.
    facade: the side whose largest facade is looked at straight, in degrees clockwise from north.
    plan: from straight above, north up.
    size: width and height in pixels, 16 to 16384.
    dark, transparent: a dark ground; none.
    scale_bar, legend: a bar of metres; the list of classes.
    grid: each building has a panel of its own; else all are in one picture.

    Raises Error if no wall looks to that side (E170), or if this build has no pictures (E171).
    """
    if not all(16 <= pixels <= 16384 for pixels in size):
        raise ValueError(f"size is {size}; expected two numbers from 16 to 16384")
    view = "plan" if plan else "oblique" if facade is None else "facade"
    bytes_, issues = _oriel.picture([made] if isinstance(made, Made) else list(made), format, view,
                                    (azimuth if facade is None else facade, elevation), size, dark, transparent, legend,
                                    scale_bar, grid)
    if issues:
        raise Error(issues)
    return bytes_


def _png_of(made: list[Made]) -> bytes | None:
    """None where nothing can be drawn: a notebook then shows something else instead of a traceback."""
    try:
        return picture(made, size=(900, 600)) if made else None
    except Error:
        return None


def _html_of(made: list[Made]) -> str | None:
    """The picture is an image of its own, so that ids of its parts clash with nothing in the notebook."""
    if not made:
        return None
    counts: Counter[str] = Counter()
    for item in made:
        counts.update(item.counts)
    names = made[0].id if len(made) == 1 else f"{len(made)} buildings"
    labels = [f"{count} {label or 'unknown'}" for label, count in sorted(counts.items(), key=lambda it: (not it[0], it[0]))
              if count > 0]
    caption = html.escape(f"{names}: {', '.join(labels) or 'no labels'}")
    try:
        svg = base64.b64encode(picture(made, format="svg", size=(900, 600))).decode()
        shown = f'<img src="data:image/svg+xml;base64,{svg}" alt="{caption}" style="max-width: 100%"/>'
    except Error as error:
        shown = f"<p>{html.escape(str(error))}</p>"
    return f"<figure>{shown}<figcaption>{caption}</figcaption></figure>"


Made._repr_png_ = lambda self: _png_of([self])  # type: ignore[attr-defined]
Made._repr_html_ = lambda self: _html_of([self])  # type: ignore[attr-defined]
