"""The one exception of oriel."""
from __future__ import annotations

from typing import TYPE_CHECKING, Sequence

if TYPE_CHECKING:
    from ._oriel import Issue, Place


class Error(Exception):
    """A call that cannot be honoured: a file that cannot be read or written, a pack with faults.

    Everything that was found is in `issues`; `code`, `place` and `sentence` are those of the first error among them.
    docs/errors.md and docs/rules.md say of each code what it means and what to do. What is wrong with one building of
    several raises nothing: it is in the `issues` of that building's result.
    """

    issues: list[Issue]
    code: str
    sentence: str
    place: Place

    def __init__(self, issues: Sequence[Issue]) -> None:
        super().__init__("\n".join(str(issue) for issue in issues))
        self.issues = list(issues)
        first = next((issue for issue in issues if issue.severity == "error"), issues[0])
        self.code = first.code
        self.sentence = first.sentence
        self.place = first.place
