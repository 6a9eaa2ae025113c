"""Where C++ code can be changed into code that is likely to be wrong, and how."""

import re
from dataclasses import dataclass

SWAPPED = {
    " < ": [" <= ", " >= "],
    " <= ": [" < ", " > "],
    " > ": [" >= ", " <= "],
    " >= ": [" > ", " < "],
    " == ": [" != "],
    " != ": [" == "],
    " && ": [" || "],
    " || ": [" && "],
    " + ": [" - "],
    " - ": [" + "],
    " += ": [" -= "],
    " -= ": [" += "],
}
WORDS = {
    "return true;": "return false;",
    "return false;": "return true;",
    "continue;": "break;",
    "std::min(": "std::max(",
    "std::max(": "std::min(",
}
# Lines that decide nothing: what is only checked or logged, and what is decided when it is compiled.
IDLE = re.compile(r"^\s*(#|ORIEL_ASSERT|static_assert|template|using |namespace )|\.(debug|info|warn)\(|\boperator\b")


@dataclass(frozen=True)
class Mutation:
    """The bytes from `begin` to `end` of a file become `text`."""

    path: str
    begin: int
    end: int
    text: str
    kind: str

    def applied(self, source):
        return source[: self.begin] + self.text + source[self.end :]

    def line(self, source):
        return source.count("\n", 0, self.begin) + 1


def blanked(source):
    """The source with comments, strings and characters as blanks, so that all else keeps its place."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
    return pattern.sub(lambda found: re.sub(r"[^\n]", "\x01", found.group()), source)


def end_of_term(code, at):
    """Where the term that begins at `at` ends: at the next operator that binds no closer than &&, or bracket."""
    depth = 0
    while at < len(code):
        if code[at] in "([{":
            depth += 1
        elif code[at] in ")]}":
            depth -= 1
            if depth < 0:
                return at
        elif depth == 0 and (code[at] in ";,?" or code.startswith(("&& ", "|| "), at)):
            return at - 1 if code[at - 1] in " \n" else at
        at += 1
    return at


def mutations_of(path, source):
    code = blanked(source)
    found = []

    def add(begin, end, text, kind):
        line = code[code.rfind("\n", 0, begin) + 1 : code.find("\n", begin)]
        if not IDLE.search(line):
            found.append(Mutation(path, begin, end, text, kind))

    for old, news in SWAPPED.items():
        for match in re.finditer(re.escape(old), code):
            for new in news:
                add(match.start(), match.end(), new, old.strip() + " to " + new.strip())
    for match in re.finditer(r" &&[ \n]\s*", code):
        add(match.start(), end_of_term(code, match.end()), "", "term dropped")
    for match in re.finditer(r"\bif \(", code):
        end = end_of_bracket(code, match.end())
        condition = code[match.end() : end]
        if ";" not in condition and "constexpr" not in condition:
            add(match.end(), end, "!(" + source[match.end() : end] + ")", "condition negated")
    for old, new in WORDS.items():
        for match in re.finditer(re.escape(old), code):
            add(match.start(), match.end(), new, old + " to " + new)
    for match in re.finditer(r"\breturn (?!true;|false;|\{\};|std::nullopt;)[^;{}]+;", code):
        add(match.start(), match.end(), "return {};", "nothing returned")
    return found


def end_of_bracket(code, at):
    depth = 1
    while at < len(code):
        depth += {"(": 1, ")": -1}.get(code[at], 0)
        if depth == 0:
            return at
        at += 1
    return at
