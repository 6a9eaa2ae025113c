"""Rule packs."""
from __future__ import annotations

import os
from typing import NamedTuple, Optional, Union

from . import _oriel
from .errors import Error


class Param(NamedTuple):
    """A number of a pack that may be set to another value."""

    name: str
    value: float
    unit: str
    """m, m2, m3, deg, or empty."""
    range: Optional[tuple[float, float]]
    """The values that it may have, ends included; None: any."""
    why: str


class Pack:
    """A rule pack that was checked and is ready to be run; it never changes, and threads may share it.

    `Pack("residential")` is a pack that is built in, `Pack("mine.yaml")` one of a file; Pack.from_text() takes the YAML
    itself. Raises Error with all that is wrong, each with file, line and column; warnings are in `issues`.
    """

    issues: list[_oriel.Issue]

    def __init__(self, name: Union[str, os.PathLike[str]]) -> None:
        self._take(*_oriel.load_pack_file(os.fspath(name)))

    @classmethod
    def from_text(cls, text: str, file: str = "pack.yaml") -> Pack:
        """The pack in `text`, called `file` in places. It may extend packs that are built in."""
        pack = cls.__new__(cls)
        pack._take(*_oriel.load_pack(text, file))
        return pack

    def with_params(self, **values: Union[float, str]) -> Pack:
        """The pack with params at other values: numbers in the unit of the param, or texts with it, "0.8 m".

        Labels are those of a pack that extends this one and states these values. Raises Error: R206 no such param, R212
        a value beyond the param's range, R230 and R231 a wrong or missing unit of a text.
        """
        numbers = [(name, float(value)) for name, value in values.items() if not isinstance(value, str)]
        texts = [f"{name}={value}" for name, value in values.items() if isinstance(value, str)]
        pack = Pack.__new__(Pack)
        pack._take(*_oriel.with_params(self._base, numbers, texts))
        return pack

    @property
    def params(self) -> dict[str, Param]:
        """The params by name, in the order of the pack."""
        return {row[0]: Param(*row) for row in _oriel.param_rows(self._base)}

    def _take(self, base: Union[_oriel.RuleBase, None], issues: list[_oriel.Issue]) -> None:
        if base is None:
            raise Error(issues)
        self._base = base
        self.issues = issues

    @property
    def name(self) -> str:
        """As the pack states it."""
        return self._base.name

    @property
    def version(self) -> str:
        """As the pack states it."""
        return self._base.version

    @property
    def file(self) -> str:
        """The name it was loaded under, as places show it."""
        return self._base.file

    @property
    def files(self) -> list[str]:
        """That one and the packs that it extends, the nearest first."""
        return self._base.files

    @property
    def sha256(self) -> str:
        """Of the pack's text and of those that it extends, 64 hexadecimal digits."""
        return self._base.sha256

    @property
    def labels(self) -> list[str]:
        """The labels it may give, in the order of the pack."""
        return self._base.labels

    @property
    def rule_count(self) -> int:
        """How many rules it has."""
        return self._base.rule_count

    @property
    def codelists(self) -> list[str]:
        """The code lists that it has codes for, sorted: what `codelist` of label() may be."""
        return self._base.codelists

    def __repr__(self) -> str:
        return f"<oriel.Pack '{self.name}' {self.version}: {self.rule_count} rules for {len(self.labels)} labels>"


Rules = Union[str, "os.PathLike[str]", Pack]


def pack_of(rules: Rules) -> Pack:
    return rules if isinstance(rules, Pack) else Pack(rules)


def embedded_packs() -> list[str]:
    """The names of the packs that are built in, sorted."""
    return _oriel.embedded_packs()
