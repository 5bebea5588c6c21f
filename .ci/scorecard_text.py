#!/usr/bin/env python3
"""scorecard_text.py TEXT JSON: the scorecard's rows are those of --json, to the digits that are shown."""
import json
import re
import sys

ROW = re.compile(r"(\S+) +(\S+) +(\S+) +(\d+) +(\d+) +(?:-|(\S+) (\S+)) +(?:-|(\S+) (exact|estimate|steps)) +"
                 r"(?:-|([-+.\dE]+)( small)?) +(?:-|(\S+)(?: (\d\S+E\S+))?) +(\d+\.\d{4}) +(.*)$")


def near(shown, value, digits):
    """Half a unit of the last digit that is shown, and both or none."""
    if shown is None or value is None:
        return shown is None and value is None
    return abs(float(shown) - value) <= 0.5001*10.0**(1 - digits)*abs(value)


lines = open(sys.argv[1]).read().splitlines()[1:]
rows = json.load(open(sys.argv[2]))
for row, line in zip(rows, lines):
    found = ROW.match(line)
    assert found, line
    scene, system, method, steps, evaluations, drift, of, error, source, period, small, omega, omega_error, _, verdict = found.groups()
    assert (scene, system, method, int(steps), int(evaluations), verdict) == (
        row["scene"], row["system"], row["method"], row["steps"], row["evaluations"], row["verdict"]), line
    worst = max(row["drifts"], key=row["drifts"].get) if row["drifts"] else None
    assert near(drift, row["drifts"].get(worst), 2), line
    assert worst is None or row["drifts"][of + "_drift"] == row["drifts"][worst], line
    assert near(error, row["error"], 2) and source == row["error_from"], line
    shown = row["small_period_error" if small else "period_error"]
    assert near(period, shown, 2) and (period or row["small_period_error"] is None), line
    assert small is None or row["period_error"] is None or row["period_error"] != shown, line
    assert near(omega, row["omega"], 6 if omega and "E" in omega else 5), line
    assert near(omega_error, row["omega_error"], 2), line
assert len(rows) <= len(lines) and "drift: " in lines[len(rows)], "a row for each"
