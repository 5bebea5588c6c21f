#!/usr/bin/env python3
"""The files of a folder as one text: .ci/written_files.py FOLDER, for .ci/try_pages.sh.

Texts as they are, but for the build and what a run cost; of a table the head, its first and its last
row to three digits, and how many there are; of .npy the header; of a page of HTML what its template
does not say, of a film's series the length and the bounds."""
import json
import os
import re
import struct
import sys

FLOAT = re.compile(r"[+-]?(?<![\w.])\d+\.\d*[eE][+-]\d+\b")


def brief(text):
    """Numbers with an exponent to three digits."""
    return FLOAT.sub(lambda m: f"{float(m.group()):.2e}" if abs(float(m.group())) > 1e-9 else "~0", text)


def is_row(line):
    """Of a table: nothing but numbers."""
    return bool(line.strip()) and not re.sub(r"[+-]?\d+(\.\d*)?([eE][+-]\d+)?|nan|NaN|[ ,]", "", line)


def folded(lines):
    """The first and the last row of each table."""
    kept, rows = [], []
    for line in [*lines, None]:
        if line is not None and is_row(line):
            rows.append(" ".join(brief(line).split()))
            continue
        if rows:
            kept += [rows[0], f"... {len(rows)} rows", rows[-1]]
        rows = []
        if line is not None:
            kept.append(line.rstrip())
    return kept


def film(text):
    """A film's data, a member a line; of the energies only that they are there: whether one is
    constant is rounding's choice."""
    def member(name, value):
        if name in ("energy", "kinetic", "distance", "channels"):
            return [name]
        return [f"{name}: " + re.sub(r"-?\d+\.\d+(e[+-]?\d+)?", lambda m: brief(f"{float(m.group()):e}"),
                                     json.dumps(value, ensure_ascii=False))]
    lines = []
    for name, value in json.loads(text).items():
        for part in value if name == "films" else [{name: value}]:
            for inner, item in part.items():
                lines += member(inner, item)
            used = re.findall(r'"c": (\d+)', json.dumps([part.get("places"), part.get("states")]))
            for number in sorted(map(int, used)):
                series = part["channels"][number]
                lines.append(brief(f"{number}: {series['lo']:e} to {series['hi']:e}, ") + f"{len(series['d'])} letters")
    return lines


def page(text):
    """What a page says beside its styles, its scripts and the pictures that gnuplot drew."""
    main = text[text.index("<main"):text.index("</main>")]
    films = [film(t) for t in re.findall(r'class="film-data">\n(.*?)\n</script>', main, re.S)]
    main = re.sub(r"<svg.*?</svg>", "<svg>", re.sub(r"<(script|noscript).*?</\1>", r"<\1>", main, flags=re.S), flags=re.S)
    main = re.sub(r"^<p>lagrangia .*, GCC .*", "<p>lagrangia ~", main, flags=re.M)
    return [*main.splitlines(), *(line for lines in films for line in lines)]


def text_of(path):
    """The file as lines."""
    data = open(path, "rb").read()
    if path.endswith(".npy"):
        length = struct.unpack("<H", data[8:10])[0]
        return [data[10:10 + length].decode().strip(), f"{len(data)} bytes"]
    if path.endswith(".html"):
        return page(data.decode())
    if path.endswith((".svg", ".png", ".pdf")):
        return ["a picture"]
    text = re.sub(r"^([#!] build:).*", r"\1 ~", data.decode(), flags=re.M)
    text = re.sub(r"^([#!] steps:.*)", lambda m: re.sub(r"\d+", "~", m.group(1)), text, flags=re.M)
    text = re.sub(r"^set logscale y; .*10\^\{-\d\d\}.*", "set logscale y; ~", text, flags=re.M)
    text = re.sub(r"\b[\d.]+e-(0[89]|[1-9]\d)\b", "~0", text) if path.endswith(".gp") else text
    return folded(text.splitlines())


for place, folders, names in os.walk(sys.argv[1]):
    folders.sort()
    for name in sorted(names):
        path = os.path.join(place, name)
        print("=== " + os.path.relpath(path, sys.argv[1]))
        print("\n".join(text_of(path)))
