"""Where C++ code can be changed into code that is likely to be wrong, and how a switch puts in the change."""

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
}
# Statements that decide nothing: what is only checked or logged, and what is decided when it is compiled.
IDLE = re.compile(r"^\s*#|ORIEL_ASSERT|static_assert|\btemplate\b|\busing |\bnamespace |\bconstexpr\b|\bconsteval\b|\bcase [^:]*$"
                  r"|\.(debug|info|warn)\(|\boperator\b|\brequires\b", re.M)
# What ends an expression on its left side, besides brackets and commas.
STARTS = re.compile(r"(?:\breturn|\bthrow|(?<![=!<>])=|(?<!:):|[?,;])\s*$")
OPENING, CLOSING = "([{", ")]}"


@dataclass(frozen=True)
class Mutation:
    """The bytes from `begin` to `end` of a file become what `switched` writes: both what was and what is tried."""

    path: str
    begin: int
    end: int
    line: int
    kind: str
    switched: str  # with NUMBER for the number of the mutation
    shown: str  # the code as it is tried, or what is left out or negated

    first_line: int  # of the bytes

    @property
    def lines(self):
        """The lines of the file that the switch covers."""
        return range(self.first_line, self.first_line + self.switched.count("\n") + 1)


def blanked(source):
    """The source with comments as blanks and strings and characters as \\x01, so that all else keeps its place."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)

    def blank(found):
        return re.sub(r"[^\n]", " " if found.group().startswith("/") else "\x01", found.group())

    return pattern.sub(blank, source)


class Code:
    """A file, and where its expressions and statements begin and end."""

    def __init__(self, path, source):
        self.path, self.source, self.code = path, source, blanked(source)
        self.partner = self.brackets()

    def brackets(self):
        partner, open_ones = {}, []
        for at, letter in enumerate(self.code):
            if letter in OPENING:
                open_ones.append(at)
            elif letter in CLOSING and open_ones:
                partner[at] = open_ones.pop()
                partner[partner[at]] = at
        return partner

    def line_of(self, at):
        return self.code.count("\n", 0, at) + 1

    def begin_of_expression(self, at):
        while at > 0:
            letter = self.code[at - 1]
            if letter in OPENING or letter == "\n" and self.code[at - 2] in ";}{":
                break
            if letter in CLOSING:
                at = self.partner.get(at - 1, at - 1)
                continue
            if self.code[at] not in "=>:" and STARTS.search(self.code, max(0, at - 12), at):
                break
            at -= 1
        return self.after_blanks(at)

    def end_of_expression(self, at):
        while at < len(self.code):
            letter = self.code[at]
            if letter in CLOSING + ",;?" or letter == ":" and ":" not in (self.code[at - 1], self.code[at + 1]):
                break
            at = self.partner.get(at, at) + 1 if letter in OPENING else at + 1
        while self.code[at - 1].isspace():
            at -= 1
        return at

    def end_of_term(self, at, enders):
        """Where the term that begins at `at` ends: at one of `enders` or where the expression does."""
        end = self.end_of_expression(at)
        while at < end:
            if self.code[at].isspace() and self.code.startswith(enders, self.after_blanks(at)):
                return at
            at = self.partner.get(at, at) + 1 if self.code[at] in OPENING else at + 1
        return end

    def after_blanks(self, at):
        while self.code[at].isspace():
            at += 1
        return at

    def statement_before(self, at):
        """What stands before `at` in its statement."""
        return self.code[max(self.code.rfind(c, 0, at) for c in ";{}") + 1 : at]

    def text(self, begin, end):
        """A part of the source in one line, without comments."""
        parts = (" " if c.isspace() else s for s, c in zip(self.source[begin:end], self.code[begin:end]))
        return re.sub(r"  +", " ", "".join(parts))


def mutations_of(path, source):
    file = Code(path, source)
    code = file.code
    found = []

    def add(place, begin, end, switched, kind, shown):
        line = code[code.rfind("\n", 0, place) + 1 : code.find("\n", place)]
        if begin < end and not IDLE.search(file.statement_before(place)) and not IDLE.search(line):
            found.append(Mutation(path, begin, end, file.line_of(place), kind, switched, shown, file.line_of(begin)))

    def swap(at, end_at, new, kind):
        """The expression around `at`, in which the bytes up to `end_at` become `new`."""
        begin, end = file.begin_of_expression(at), file.end_of_expression(max(at, end_at))
        if not begin <= at <= end_at <= end:
            return
        changed = file.text(begin, at) + new + file.text(end_at, end)
        add(at, begin, end, f"(ORIEL_MUTANT(NUMBER) ? ({changed}) : ({source[begin:end]}))", kind, changed)

    for old, news in SWAPPED.items():
        for match in re.finditer(re.escape(old[:-1]) + r"\s", code):
            for new in news:
                swap(match.start(), match.end(), new, old.strip() + " to " + new.strip())
    for match in re.finditer(r" &&\s+", code):
        swap(match.start(), file.end_of_term(match.end(), ("&& ", "|| ")), "", "term dropped")
    for match in re.finditer(r" [+-]\s+", code):
        swap(match.start(), file.end_of_term(match.end(), tuple("+-<>=!&|")), "", "term dropped")
    for match in re.finditer(r"\bif \(", code):
        begin, end = match.end(), file.partner.get(match.end() - 1, 0)
        if ";" not in code[begin:end]:
            add(begin, begin, end, f"ORIEL_MUTANT(NUMBER) != static_cast<bool>({source[begin:end]})", "condition negated",
                file.text(begin, end))
    for word in ("min", "max"):
        for match in re.finditer(rf"\bstd::{word}\(", code):
            end = file.partner.get(match.end() - 1, 0) + 1
            other = "max" if word == "min" else "min"
            add(match.start(), match.start(), end,
                f"(ORIEL_MUTANT(NUMBER) ? std::{other}({file.text(match.end(), end)} : {source[match.start():end]})",
                f"{word} to {other}", file.text(match.start(), end))
    for match in re.finditer(r"\breturn (true|false);", code):
        is_not = "!" if match[1] == "true" else ""
        add(match.start(), match.start(), match.end(), f"return {is_not}ORIEL_MUTANT(NUMBER);", "other answer", match.group())
    for match in re.finditer(r"\bcontinue;", code):
        add(match.start(), match.start(), match.end(), "{ if (ORIEL_MUTANT(NUMBER)) break; continue; }", "continue to break", "continue")
    for match in re.finditer(r"(?<=\n)[ ]+([^\s;{}]+) (\+|-)= [^;{}]+;", code):
        begin, end = file.after_blanks(match.start()), match.end()
        other = "-" if match[2] == "+" else "+"
        changed = file.text(begin, match.end(1)) + f" {other}=" + file.text(match.end(2) + 1, end)
        if code.count("(", begin, end) == code.count(")", begin, end):
            add(begin, begin, end, f"{{ if (ORIEL_MUTANT(NUMBER)) {changed} else {source[begin:end]} }}", f"{match[2]}= to {other}=",
                file.text(begin, end))
            add(begin, begin, end, f"{{ if (!ORIEL_MUTANT(NUMBER)) {source[begin:end]} }}", "term dropped", file.text(begin, end))
    for match in re.finditer(r"\breturn (?!true;|false;|\{\};|std::nullopt;)[^;{}]+;", code):
        add(match.start(), match.start(), match.end(),
            f"{{ if (ORIEL_MUTANT(NUMBER)) return {{}}; {source[match.start():match.end()]} }}", "nothing returned",
            file.text(match.start(), match.end()))
    return found
