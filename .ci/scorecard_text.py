#!/usr/bin/env python3
"""scorecard_text.py TEXT JSON: the scorecard, of the main job or of `run`, says what --json says, to the
digits that are shown, in 80 columns."""
import json
import re
import sys

ROW = re.compile(r"(\S+) +(\S+) +(?:-|(\S+) (\S+)) +(?:-|(\S+) (exact|estimate|steps)) +(holds|-|NOT|failed)$")


def near(shown, value, digits):
    """Half a unit of the last digit that is shown, and both or none."""
    if shown is None or value is None:
        return shown is None and value is None
    return abs(float(shown) - value) <= 0.5001*10.0**(1 - digits)*abs(value)


text = open(sys.argv[1]).read()
for line in text.splitlines():
    assert len(line) <= 80 or line.split()[-1].startswith("/"), line  # a path is as long as it is
lines = text[:text.index("\nmethod   of the steps;")].splitlines()
assert lines[0].split() == ["scene", "method", "drift", "error", "verdict"], lines[0]
rows = json.load(open(sys.argv[2]))
starts = [i for i, line in enumerate(lines) if i > 0 and line and line[0] != " "]
assert len(starts) == len(rows), "a row for each"
for row, first, end in zip(rows, starts, starts[1:] + [len(lines)]):
    line, below = lines[first], " ".join(" ".join(lines[first + 1:end]).split())
    found = ROW.match(line)
    assert found, line
    scene, method, drift, of, error, source, verdict = found.groups()
    assert (scene, method) == (row["scene"], row["method"]), line
    assert verdict == {"NOT": "NOT", "not": "-"}.get(row["verdict"][:3], row["verdict"]), line
    assert below.count("NOT as expected") == row["verdict"].count("NOT "), below
    worst = max(row["drifts"], key=row["drifts"].get) if row["drifts"] else None
    assert near(drift, row["drifts"].get(worst), 2), line
    assert worst is None or row["drifts"][of + "_drift"] == row["drifts"][worst], line
    assert near(error, row["error"], 2) and source == row["error_from"], line
    if len(sys.argv) == 3:
        continue  # the main job has rows only
    assert below.startswith(" ".join(row["title"].split())), below
    assert ("changed by --set" in below) == (row["changes"] is not None), below
    assert re.search(fr"\b{row['steps'] or 'no'} steps\b", below), below
    assert not row["steps"] or f" {row['evaluations']} evaluations" in below, below
    for key, pattern in (("period", r"period (\S+) s measured"), ("exact_period", r" (\S+) s exact; they differ"),
                         ("small_period", r" (\S+) s 2 pi/omega of small swings"), ("omega", r" omega (\S+) rad/s the")):
        shown = re.search(pattern, below)
        if key != "omega" and row["period"] is None:
            assert not shown, below
        elif row[key] is None:
            assert not shown, below
        else:
            assert abs(float(shown[1]) - row[key]) <= max(0.5001e-10, 0.5001e-10*row[key]), below
    for key, pattern in (("period_error", r"they differ by (\S+) of it"), ("small_period_error", r"swings; off by (\S+) of it"),
                         ("omega_error", r"differ by at most (\S+)")):
        shown = re.search(pattern, below)
        assert near(shown and shown[1], row[key], 2), (key, below)
    assert (row["omega_formula"] or "") in below, below
