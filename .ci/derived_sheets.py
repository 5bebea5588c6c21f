#!/usr/bin/env python3
"""What `lagrangia grade` says of the lines of derivations, and of the same lines with a slip.

    .ci/derived_sheets.py PROGRAM SCENE...

The lines are those that `lagrangia derive` prints for the systems of the scenes. A slip is another sign or
another factor in front of the last term of a line: it is right where that term is a constant in L, or zero.
"""
import json
import os
import re
import subprocess
import sys
import tempfile


def answer(program, *words):
    return subprocess.run([program, *words], capture_output=True, timeout=600, stdin=subprocess.DEVNULL,
                          encoding="utf-8").stdout


def lines_of(derivation):
    """The statements, each once; those about small oscillations with their word in front."""
    found = {}
    for row in json.loads(derivation or '{"lines": []}')["lines"]:
        line = row["line"]
        if "formula" not in row or " = " not in line or re.match(r"([MKCGB]\d*|f\d*) = |.*lambda", line):
            continue
        small = row["step"] == "small oscillations" and line.endswith(" = 0") and "omega^" not in line
        found["small: "*small + line] = True
    return list(found)


def with_slips(line):
    """The last term outside of brackets gets another sign, and a factor."""
    end = len(line) - 4 if line.endswith(" = 0") else len(line)
    at = line.rindex(" = ", 0, end) + 3 if end == len(line) else len("small: ") if line.startswith("small: ") else 0
    depth = 0
    for i in range(at, end):
        depth += (line[i] in "([") - (line[i] in ")]")
        if depth == 0 and line[i - 1:i + 2] in (" + ", " - ") and i > at:
            at = i
    if line[at:end] == "0" or (end < len(line) and line[at:at + 2] not in ("+ ", "- ")):
        return []  # no other term would make it wrong
    sign, term = re.match(r"([-+] ?)?(.*)", line[at:end]).groups(default="")
    other = {"": "-", "-": "", "+ ": "- ", "- ": "+ "}[sign]
    return [line[:at] + other + term + line[end:], line[:at] + sign + "3*" + term + line[end:]]


def main():
    program = os.path.realpath(sys.argv[1])
    for scene in sys.argv[2:]:
        lines = lines_of(answer(program, "derive", scene, "--json"))
        slips = [[slip] for line in lines for slip in with_slips(line)]
        print(scene)
        with tempfile.TemporaryDirectory() as folder:
            names = [os.path.join(folder, f"{number:04}") for number in range(1 + len(slips))]
            for name, sheet in zip(names, [lines, *slips]):
                with open(name, "w", encoding="utf-8") as file:
                    file.write(f"system: {os.path.realpath(scene)}\n" + "\n".join(sheet) + "\n")
            for row in answer(program, "grade", *names).splitlines():
                if row.startswith("line ") or row.startswith("  "):
                    print(re.sub("^line [0-9]+ +", "    ", row))


if __name__ == "__main__":
    main()
