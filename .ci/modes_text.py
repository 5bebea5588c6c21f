#!/usr/bin/env python3
"""What `lagrangia modes` prints is what its --json says, and both solve the equation of motion.

    .ci/modes_text.py TEXT JSON

TEXT and JSON are what the command printed of one equilibrium, without and with --json. Twelve digits
are printed; (-omega^2 M + i omega G + K) u = 0 and u^+ M u = 1 hold to that of the largest term.
"""
import json
import math
import re
import sys

text = open(sys.argv[1]).read().splitlines()
page = json.load(open(sys.argv[2]))
n = len(page["omega2"])
printed = 6e-12  # half a unit of the eleventh decimal, and a little
G = page.get("G", [[0.0]*n for _ in range(n)])


def is_number(word, value):
    assert abs(float(word) - value) <= printed*max(1.0, abs(value)), (word, value)


def matrix(letter, rows):
    first = next(k for k, line in enumerate(text) if line.startswith(letter + " = "))
    for i in range(n):
        words = text[first + i].replace(letter + " = ", "").split()
        assert len(words) == n, text[first + i]
        for word, value in zip(words, rows[i]):
            is_number(word, value)


assert text[0].startswith(page["system"] + ": small oscillations about ")
places = text[0].split(" about ")[1].split(", ")
assert [float(place.split(" = ")[1]) for place in places] == page["at"]
matrix("M", page["M"])
matrix("K", page["K"])
if "G" in page:
    matrix("G", G)
head = next(k for k, line in enumerate(text) if line.startswith("omega^2"))
for k in range(n):
    line, _, bound = text[head + 1 + k].partition(", omega below ")
    assert bound == "" or page["label"][k] == "zero mode" and float(bound.split()[0])**2 < 1e-12, bound
    assert line.endswith(page["label"][k]), line
    words = line[:len(line) - len(page["label"][k])].split()
    omega2 = page["omega2"][k]
    is_number(words.pop(0), omega2)
    if page["label"][k] == "oscillation":
        omega = math.sqrt(omega2)
        is_number(page["omega"][k], omega)
        for value in (omega, omega/(2*math.pi), 2*math.pi/omega):
            is_number(words.pop(0), value)
    elif page["label"][k] == "unstable":
        assert words[:2] + words[3:4] == ["growth", "rate", "1/s"], line
        is_number(words[2], math.sqrt(-omega2))
        del words[:4]
    if "closed_form" in page:
        closed = page["closed_form"][k]
        is_number(words.pop(0), closed)
        differ = abs(omega2 - closed)/(abs(closed) or 1.0)
        assert abs(float(words.pop(0)) - differ) <= 0.06*differ
    assert not words, line
first = next(k for k, line in enumerate(text) if line.startswith("shapes"))
imaginary = page.get("shapes_imaginary")
sign = 1
if imaginary:
    sign = {"+": 1, "-": -1}[re.match(r"shapes \(a ([+-]) i b\) exp\(i omega t\), ", text[first]).group(1)]
lines = text[first + 1:-1]
assert len(lines) == (2*n if imaginary else n)
for k in range(n):
    u = [complex(x) for x in page["shapes"][k]]
    parts = [page["shapes"][k]]
    if imaginary:
        u = [complex(a, sign*b) for a, b in zip(page["shapes"][k], imaginary[k])]
        parts.append(imaginary[k])
    for mark, part in zip(" i", parts):
        line = lines.pop(0)
        assert line[0] == mark and len(line[1:].split()) == n, line
        for word, value in zip(line[1:].split(), part):
            is_number(word, value)
    inertia = sum((u[i].conjugate()*page["M"][i][j]*u[j]).real for i in range(n) for j in range(n))
    assert abs(inertia - 1.0) < 1e-12, inertia
    rate = complex(page["omega2"][k])**0.5  # i omega is the eigenvalue
    for i in range(n):
        terms = [f*u[j] for j in range(n) for f in
                 (-rate**2*page["M"][i][j], 1j*rate*G[i][j], page["K"][i][j])]
        assert abs(sum(terms)) <= 1e-11*max(1.0, max(map(abs, terms))), terms
last = text[-1]
assert last.startswith("LAPACK: "), last
ratio = page["residual_ratio"]
assert abs(float(last.split(" = ")[1]) - ratio) <= 0.06*ratio, last
