"""What is made of buildings: segment, label, explain, repair, generalise.

Options have the names of the command's, with _ for -, and its defaults (docs/command.md says what each does).
"""
from __future__ import annotations

import concurrent.futures
import os
from typing import Any, Callable, Iterable, Optional, Union, overload

from . import _oriel
from ._oriel import Building, Explanation, Generalised, Issue, Repaired, Result
from .buildings import Items, Path, buildings_of, read
from .packs import Rules, pack_of

_BUDGET = 40_000_000

Several = Union[Iterable[Building], Path]
Neighbours = Union[bool, Path, Iterable[Path]]


def _options(*, order: str = "natural", value_rel: float = 0.01, ignore_semantics: bool = False, codelist: str = "sig3d",
             explain: bool = False, repaired: bool = False, coplanar_deg: float, plane_offset: Optional[float],
             weld: float, close: str, close_area: float, crossings: str, budget: int = _BUDGET) -> _oriel.StageOptions:
    return _oriel.StageOptions(order, coplanar_deg, plane_offset, weld, value_rel, close, close_area, crossings, budget,
                               ignore_semantics, codelist, explain, repaired)


def _each(work: Callable[[Any], Any], items: list[Any], jobs: int) -> list[Any]:
    """In their order, on so many threads: C++ works without the interpreter's lock."""
    jobs = jobs or os.cpu_count() or 1
    if jobs == 1 or len(items) < 2:
        return [work(item) for item in items]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(work, items))


def _made(buildings: Any, work: Callable[[Building], Any], jobs: int, issues: Iterable[Issue] = ()) -> Any:
    """Of one building what was made of it, of several a list."""
    if isinstance(buildings, Building):
        return work(buildings)
    several, files, found = buildings_of(buildings)
    return Items(_each(work, several, jobs), files, [*found, *issues])


def _neighbours(buildings: list[Building], neighbours: Neighbours) -> tuple[Optional[_oriel.NeighbourSearch], list[Issue]]:
    """What stands beside them, and what was found; nothing if nobody asks."""
    if neighbours is False or neighbours is None:
        return None, []
    named = [] if neighbours is True else [neighbours] if isinstance(neighbours, (str, os.PathLike)) else list(neighbours)
    others = [file for path in named for file in read(path).files]
    return _oriel.neighbours_in(list(dict.fromkeys(building.file for building in buildings)), others)


@overload
def segment(buildings: Building, *, order: str = ..., coplanar_deg: float = ..., plane_offset: Optional[float] = ...,
            weld: float = ..., value_rel: float = ..., close: str = ..., close_area: float = ..., crossings: str = ...,
            budget: int = ..., jobs: int = ...) -> Result: ...
@overload
def segment(buildings: Several, *, order: str = ..., coplanar_deg: float = ..., plane_offset: Optional[float] = ...,
            weld: float = ..., value_rel: float = ..., close: str = ..., close_area: float = ..., crossings: str = ...,
            budget: int = ..., jobs: int = ...) -> Items[Result]: ...
def segment(buildings: Any, *, order: str = "natural", coplanar_deg: float = 0.5, plane_offset: Optional[float] = None,
            weld: float = 0.001, value_rel: float = 0.01, close: str = "ground", close_area: float = 10.0,
            crossings: str = "leave", budget: int = _BUDGET, jobs: int = 1) -> Any:
    """The features of buildings, without labels: a Result of a building, a list of several or of a file.

    order: order of cuts: natural (along existing edges first) or paper (as in the paper).
    coplanar_deg: polygons share a plane if their tilt differs by no more than this, in degrees.
    plane_offset: ... and their offset by no more than this, in m; None is 0.002 and more for noisy buildings.
    weld: merge vertices closer than this, in m.
    value_rel: values of features that differ by no more than this fraction count as equal.
    close: holes to close in a building that is not a closed shell: none, planar, ground or any.
    close_area: largest plane hole to close with planar or ground, in m2.
    crossings: polygons that cross each other in a building that is not a closed shell: leave or cut.
    budget: most steps that each stage may take on one building.
    jobs: buildings to work on at the same time; 0: one per core. The results are the same.

    Never raises for what is wrong with a building: Result.is_done is False then, and `issues` say why. The result
    depends on the building and the options only.
    """
    options = _options(order=order, coplanar_deg=coplanar_deg, plane_offset=plane_offset, weld=weld, value_rel=value_rel,
                       close=close, close_area=close_area, crossings=crossings, budget=budget)
    return _made(buildings, lambda building: _oriel.segment(building, options), jobs)


@overload
def label(buildings: Building, rules: Rules = ..., *, codelist: str = ..., explain: bool = ..., repaired: bool = ...,
          ignore_semantics: bool = ..., order: str = ..., coplanar_deg: float = ...,
          plane_offset: Optional[float] = ..., weld: float = ..., value_rel: float = ..., close: str = ...,
          close_area: float = ..., crossings: str = ..., budget: int = ..., neighbours: Neighbours = ...,
          jobs: int = ...) -> Result: ...
@overload
def label(buildings: Several, rules: Rules = ..., *, codelist: str = ..., explain: bool = ..., repaired: bool = ...,
          ignore_semantics: bool = ..., order: str = ..., coplanar_deg: float = ...,
          plane_offset: Optional[float] = ..., weld: float = ..., value_rel: float = ..., close: str = ...,
          close_area: float = ..., crossings: str = ..., budget: int = ..., neighbours: Neighbours = ...,
          jobs: int = ...) -> Items[Result]: ...
def label(buildings: Any, rules: Rules = "residential", *, codelist: str = "sig3d", explain: bool = False,
          repaired: bool = False, ignore_semantics: bool = False, order: str = "natural", coplanar_deg: float = 0.5,
          plane_offset: Optional[float] = None, weld: float = 0.001, value_rel: float = 0.01, close: str = "ground",
          close_area: float = 10.0, crossings: str = "leave", budget: int = _BUDGET, neighbours: Neighbours = False,
          jobs: int = 1) -> Any:
    """Names the features and surfaces of buildings by the rules of a pack (docs/rules.md).

    It does what segment() does, with the same options, then runs the rules over the features.

    rules: a Pack, a file, or the name of a pack that is built in.
    codelist: code list for the functions of installations; the pack must have codes for it.
    explain: the reason for every label and surface is written, as oriel_why.
    repaired: the valid solid of each building is written, as repair makes it, with its labels.
    ignore_semantics: what the input calls its polygons is not looked at.
    neighbours: it is looked which buildings touch, for party walls, yards and streets (docs/generalisation.md): True of
    all buildings of the files that the given ones are from, or also of those of a file or of several, named here.

    Raises Error if the pack has faults. The result depends on the building, the pack and the options only, and on its
    neighbours.
    """
    pack = pack_of(rules)
    options = _options(order=order, coplanar_deg=coplanar_deg, plane_offset=plane_offset, weld=weld, value_rel=value_rel,
                       close=close, close_area=close_area, crossings=crossings, budget=budget, codelist=codelist,
                       explain=explain, repaired=repaired, ignore_semantics=ignore_semantics)
    several, files, found = buildings_of(buildings)
    search, beside = _neighbours(several, neighbours)
    if isinstance(buildings, Building):
        return _oriel.label(buildings, pack._base, options, search)
    made = _each(lambda building: _oriel.label(building, pack._base, options, search), several, jobs)
    return Items(made, files, [*found, *pack.issues, *beside])


@overload
def repair(buildings: Building, *, ignore_semantics: bool = ..., coplanar_deg: float = ...,
           plane_offset: Optional[float] = ..., weld: float = ..., close: str = ..., close_area: float = ...,
           crossings: str = ..., jobs: int = ...) -> Repaired: ...
@overload
def repair(buildings: Several, *, ignore_semantics: bool = ..., coplanar_deg: float = ...,
           plane_offset: Optional[float] = ..., weld: float = ..., close: str = ..., close_area: float = ...,
           crossings: str = ..., jobs: int = ...) -> Items[Repaired]: ...
def repair(buildings: Any, *, ignore_semantics: bool = False, coplanar_deg: float = 0.5,
           plane_offset: Optional[float] = None, weld: float = 0.001, close: str = "ground", close_area: float = 10.0,
           crossings: str = "cut", jobs: int = 1) -> Any:
    """Makes valid solids of buildings: closed, oriented, with plane faces (docs/solidify.md).

    The solid is checked as it is written. Tolerances are taken as they are given. Options are those of segment();
    ignore_semantics: the solids are written without the semantics of the input.
    """
    options = _options(coplanar_deg=coplanar_deg, plane_offset=plane_offset, weld=weld, close=close,
                       close_area=close_area, crossings=crossings, ignore_semantics=ignore_semantics)
    return _made(buildings, lambda building: _oriel.repair(building, options), jobs)


def _denominator(scale: Union[str, float]) -> float:
    """N of "1:N" or N."""
    if not isinstance(scale, str):
        return float(scale)
    number = scale.replace(" ", "")
    try:
        return float(number[2:] if number.startswith("1:") else number)
    except ValueError:
        raise ValueError(f"'{scale}' is not a scale: write 1:N with N >= 1, such as 1:2000") from None


def _profiles(to_lod: Union[str, Iterable[str]], profile: str) -> list[str]:
    """The names of the profiles, as the command makes them."""
    lods = [to_lod] if isinstance(to_lod, str) else list(to_lod)
    if not lods:
        return [profile] if profile else []
    if len(set(lods)) != len(lods):
        raise ValueError("to_lod names a level of detail twice; name each of them once")
    return [f"{profile or 'lod'}:{lod}" for lod in lods]


@overload
def generalise(buildings: Union[Building, Result], *, scale: Union[str, float, None] = ...,
               to_lod: Union[str, Iterable[str]] = ..., profile: str = ..., edge_min: Optional[float] = ...,
               rules: Rules = ..., neighbours: Neighbours = ..., jobs: int = ...) -> Generalised: ...
@overload
def generalise(buildings: Union[Several, Iterable[Result]], *, scale: Union[str, float, None] = ...,
               to_lod: Union[str, Iterable[str]] = ..., profile: str = ..., edge_min: Optional[float] = ...,
               rules: Rules = ..., neighbours: Neighbours = ..., jobs: int = ...) -> Items[Generalised]: ...
def generalise(buildings: Any, *, scale: Union[str, float, None] = None, to_lod: Union[str, Iterable[str]] = (),
               profile: str = "", edge_min: Optional[float] = None, rules: Rules = "residential",
               neighbours: Neighbours = False, jobs: int = 1) -> Any:
    """Redraws buildings for a target scale or levels of detail, as closed solids (docs/generalisation.md).

    buildings: what label() gave, whose rules and options hold then; or buildings, which are labelled by `rules` first.
    scale: target scale, "1:2000" or 2000.
    to_lod: levels of detail to make, such as "2.0" or ("2.0", "1.2"), all in one file.
    profile: what to do with features that the pack has no entry for: NAME[:LEVEL] or a file.
    edge_min: least length of an edge and width of a gap, in m, instead of the profile's.
    neighbours: as label() takes it; what was labelled already has the neighbours that label() was given. Where the
    profile asks for it, buildings that touch become one: the others of them are `is_gone` and leave the file, which can
    be written as CityJSON, CityJSONSeq and CityGML.

    What is valid at no scale stays unchanged; what is rejected has an error in its `issues`. Raises Error if a profile
    has faults, E125 for a scale below 1 and R275 for a level that the profile does not have.
    """
    if scale is not None and to_lod:
        raise ValueError("scale and to_lod exclude each other")
    profiles = _profiles(to_lod, profile)
    if scale is None and not profiles:
        raise ValueError("generalise() needs a scale, to_lod or a profile")
    if edge_min is not None and not profiles:
        raise ValueError("edge_min works only with profile or to_lod")
    labelled = _labelled(buildings, rules, neighbours, jobs)
    one = labelled if isinstance(labelled, Result) else next(iter(labelled), None)
    targets, issues = _oriel.targets(None if scale is None else _denominator(scale), profiles, edge_min,
                                     _base_of(labelled, rules), one is not None and one.has_neighbours)
    groups = None if one is None else _oriel.groups_of(one, targets)
    if isinstance(labelled, Result):
        return _oriel.generalise(labelled, targets, groups)
    files = labelled.files if isinstance(labelled, Items) else []
    found = labelled.issues if isinstance(labelled, Items) else []
    drawn = _each(lambda result: _oriel.generalise(result, targets, groups), list(labelled), jobs)
    return Items(drawn, files, [*found, *issues])


def _labelled(buildings: Any, rules: Rules, neighbours: Neighbours, jobs: int) -> Any:
    """Results as they are; what was only read is labelled."""
    if isinstance(buildings, Result):
        return buildings
    if not isinstance(buildings, (str, os.PathLike, Building, Items)):
        buildings = list(buildings)
    if isinstance(buildings, (list, Items)) and all(isinstance(one, Result) for one in buildings):
        return buildings
    return label(buildings, rules, neighbours=neighbours, jobs=jobs)


def _base_of(labelled: Any, rules: Rules) -> _oriel.RuleBase:
    """The rules that labelled: of results their own."""
    results = [labelled] if isinstance(labelled, Result) else labelled
    own = next((result.rules for result in results if result.rules), None)
    return own or pack_of(rules)._base


@overload
def explain(labelled: Result, feature: str) -> Explanation: ...
@overload
def explain(labelled: Result, feature: None = ...) -> list[Explanation]: ...
def explain(labelled: Result, feature: Optional[str] = None) -> Any:
    """Why a feature has its label, or none: every rule with its conditions, what was found and what was asked for.

    labelled: what label() said of a building.
    feature: the id or name of a feature, or the beginning of one: "chimney 1 of roof slope north", "f11yv". Without it
    all features are explained, in their order, in less time than one by one; the nearest flip is not searched for then.

    str() of an Explanation is the summary that the command prints, `json` all of it. Raises KeyError if no feature, or
    more than one, is meant.
    """
    if feature is None:
        return _oriel.explain_features(labelled)
    return _oriel.explain_feature(labelled, feature)


def explain_json(labelled: Result) -> str:
    """All features of a building as one JSON object on one line, as `explain --json` prints it."""
    return _oriel.explanations_json(labelled.id, _oriel.explain_features(labelled))
