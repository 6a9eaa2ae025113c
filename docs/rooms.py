#!/usr/bin/env python3
"""Draws docs/rooms.svg: which room includes which, from the sources' own #include lines.

  docs/rooms.py            writes the picture
  docs/rooms.py --check    exits with 1 if the picture is not that of the sources

An arrow points at what is included. One that follows from two others is left out."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
PICTURE = ROOT / "docs" / "rooms.svg"
ROWS = [["cli"], ["experiments", "studio", "python"], ["oriel"], ["generalise", ""], ["interpret", "io"], ["kernel"], ["model"], ["kernel/base"]]
SAYS = {"cli": "the command", "python": "the module", "experiments": "variants, reports", "studio": "page, editing, lsp", "oriel": "the front door",
        "generalise": "operators", "interpret": "rules", "io": "readers, writers", "kernel": "geometry only", "model": "values",
        "kernel/base": "issues, text, work"}
WIDTH, HEIGHT, COLUMN, ROW = 180, 44, 240, 84


def room_of(path):
    return "kernel/base" if path.startswith("kernel/base/") else path.split("/")[0]


def includes():
    """Returns which rooms each room includes."""
    found = {room: set() for row in ROWS for room in row if room}
    for folder in {room.split("/")[0] for room in found}:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            for header in re.findall(r'^#include "([^"]+/[^"]+)"', path.read_text(encoding="utf-8"), re.M):
                source, target = room_of(str(path.relative_to(ROOT))), room_of(header)
                if target in found and target != source:
                    found[source].add(target)
    return found


def reach(graph, room):
    seen, waiting = set(), [room]
    while waiting:
        for target in graph[waiting.pop()] - seen:
            seen.add(target)
            waiting.append(target)
    return seen


def drawn(graph):
    middle = {}
    for y, row in enumerate(ROWS):
        for x, room in enumerate(row):
            if not room:
                continue
            middle[room] = (380 + (x - (len(row) - 1) / 2) * COLUMN, 40 + y * ROW)
    lines = []
    for source in middle:
        for target in sorted(graph[source]):
            if any(target in reach(graph, other) for other in graph[source] - {target}):
                continue
            (x1, y1), (x2, y2) = middle[source], middle[target]
            lines.append(f'<line x1="{x1:g}" y1="{y1 + HEIGHT / 2:g}" x2="{x2:g}" y2="{y2 - HEIGHT / 2 - 5:g}" marker-end="url(#to)"/>')
    for room, (x, y) in middle.items():
        lines.append(f'<rect x="{x - WIDTH / 2:g}" y="{y - HEIGHT / 2:g}" width="{WIDTH}" height="{HEIGHT}" rx="4"/>')
        lines.append(f'<text x="{x:g}" y="{y - 3:g}" font-weight="bold">{room}</text><text x="{x:g}" y="{y + 14:g}">{SAYS[room]}</text>')
    head = ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 760 670" font-family="sans-serif" font-size="13" text-anchor="middle" '
            'stroke="none" role="img"><title>Which room includes which</title>'
            '<defs><marker id="to" viewBox="0 0 8 8" refX="6" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
            '<path d="M0 0 8 4 0 8z" fill="#555"/></marker></defs><rect width="760" height="670" fill="#fff"/>'
            '<style>line{stroke:#555}rect[rx]{fill:#eef3f8;stroke:#555}</style>')
    return "\n".join([head, *lines, "</svg>"]) + "\n"


def main():
    picture = drawn(includes())
    if "--check" not in sys.argv[1:]:
        PICTURE.write_text(picture, encoding="utf-8")
    elif PICTURE.read_text(encoding="utf-8") != picture:
        sys.exit("docs/rooms.svg is not the picture of these sources; docs/rooms.py draws it")


main()
