"""Rules that learn from samples."""
from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, Iterable, Optional, Union

from . import _oriel
from ._oriel import Learnt, Result, Truth
from .buildings import Path
from .errors import Error
from .features import Features, feature_set
from .packs import Rules, pack_of
from .scores import read_truth

Costs = Mapping[tuple[str, str], float]


def _records_of(features: Any) -> list[str]:
    """The paths, if files of records are meant."""
    several = [features] if isinstance(features, (str, os.PathLike)) else features
    if isinstance(several, (list, tuple)) and several and all(isinstance(one, (str, os.PathLike)) for one in several):
        return [os.fspath(one) for one in several]
    return []


def _costs_of(objective: str, costs: Union[Costs, Path, None]) -> Optional[dict[tuple[str, str], float]]:
    if costs is None:
        if objective == "cost":
            raise ValueError("objective 'cost' needs costs")
        return None
    if objective != "cost":
        raise ValueError("costs work only with objective 'cost'")
    if isinstance(costs, Mapping):
        if any(not cost >= 0 for cost in costs.values()):
            raise ValueError("costs must be 0 or more")
        return dict(costs)
    return _oriel.read_costs(os.fspath(costs))


def learn(features: Union[Features, Path, Iterable[Path], Result, Iterable[Result]],
          truth: Union[Truth, Path, Iterable[Path], None], rules: Rules = "residential", *, objective: str = "macro_f1",
          costs: Union[Costs, Path, None] = None, params: Iterable[str] = (), folds: int = 5, leave_one_out: bool = False,
          penalty: float = 0.001, restarts: int = 1, seed: int = 1, corrections: Optional[Path] = None,
          jobs: int = 1) -> Learnt:
    """Values of a pack's params, within their ranges, with which it labels samples best (docs/learn.md).

    features: what segment(), label() or features() gave, or files of records.
    truth: what read_truth() gave or takes; None: only `corrections` are known.
    objective: what is made best: macro_f1, a class of the pack for its F1, or cost for the least cost of errors.
    costs: with cost: {(truth, predicted): cost}, "-" for nothing there or nothing found, or a file of such lines.
    params: the params that may be changed; empty: all that have a range and that a label depends on.
    folds: parts of the buildings that are held out in turn.
    leave_one_out: hold out each building by itself.
    penalty: what each changed param must gain.
    restarts: how often the search begins again elsewhere.
    seed: of folds, restarts and intervals.
    corrections: a file of what people say of single features: truth, too.
    jobs: threads; 0: one per core. The result is the same.

    The pack stays as it is where nothing is better on held-out folds: then `params` are empty, and `reason` says why.
    Raises Error: R284 truth of other buildings, R282 fewer than two buildings, R283 no object of the objective, R206 an
    unknown param. Warnings are in `issues`.
    """
    if not 2 <= folds <= 1000:
        raise ValueError(f"folds is {folds}; it must be in 2 to 1000")
    if not 0 <= penalty <= 1:
        raise ValueError(f"penalty is {penalty}; it must be in 0 to 1")
    if not 0 <= restarts <= 100:
        raise ValueError(f"restarts is {restarts}; it must be in 0 to 100")
    if truth is None and corrections is None:
        raise ValueError("learn() needs truth or corrections")
    base = pack_of(rules)._base
    options = _oriel.LearnOptions(base, objective, _costs_of(objective, costs), penalty, restarts, seed, list(params))
    known = truth if isinstance(truth, Truth) else read_truth(() if truth is None else truth)
    paths = _records_of(features)
    learnt, issues = _oriel.learn(paths, None if paths else feature_set(features), known, base,
                                  "" if corrections is None else os.fspath(corrections), options,
                                  0 if leave_one_out else folds, jobs or os.cpu_count() or 1)
    if learnt is None:
        raise Error(issues)
    return learnt
