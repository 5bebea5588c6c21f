#!/usr/bin/env python3
"""Every parameter, start and method of every shipped scene set to other values, as a student would.

Each run ends with status 0, or is refused in one line that says what physics or numerics forbids: a value
out of its domain, a method that such forces do not suit, no inertia. Nothing of the unchanged scene refuses
or judges the changed one: no line names a key that was not set, and no run has status 1. A run that says
that it takes longer than PATIENCE need not come to its end here.

Usage: attack_changes.py PROGRAM [SCENE...]; takes half a minute.
"""
import collections
import os
import re
import subprocess
import sys
import tempfile

# What may be refused: the words of the message, and why that is right.
HONEST = [
    r"--set [^:]*: &\w+: \w+ = [^:]*: .* is needed$",               # outside the parameter's domain
    r"method = '?verlet'?: verlet is for forces that depend on positions only",
    r"method '(rk4|verlet)' takes steps of dt \(add --set scene%dt=1e-3 or the like\)",
    r"dt is missing",                                               # `auto` has none, `rk4` needs one
    r"add --set scene%q=\d+\*0\.6",                                 # a chain of another length
    r"he mass matrix d2L/dv dv is singular",                       # a mass or a length of zero
    r"a derivative of the Lagrangian is not finite",                # tanh(x_dot/0)
    r"the state is not finite at t = ",                             # m1 = 0 below a lower bob
    r"constraint 1 is not kept: it gives .*; start elsewhere",      # another rod, the start as it was
    r"v does not keep the constraints",
    r"&scene: v: element 1 has no value$",                          # the second of one that is free
    r"is no finite number at t = .*; start elsewhere",              # a start beyond a shorter rod
    r"no step is small enough at t = ",                             # a fall into the centre
    r"column '\w+' is not finite at t = ",                         # thrown out to infinity
]


PATIENCE = 75  # s; a run says so within a minute that it takes one or more


def main():
    program, only = os.path.abspath(sys.argv[1]), sys.argv[2:]
    folder = tempfile.mkdtemp()

    def run(*words):
        try:
            return subprocess.run([program, *words], cwd=folder, capture_output=True, text=True, timeout=PATIENCE)
        except subprocess.TimeoutExpired as late:
            said = (late.stderr or b"").decode()
            if not re.search(r"takes about \d+ (s|min|h|days|years)", said):
                said += f"silent for {PATIENCE} s"
            return subprocess.CompletedProcess(late.cmd, "interrupted", "", said)

    names = only or [line.split()[0] for line in run("list", "scenes").stdout.splitlines() if line.split()]
    counts, wrong = collections.Counter(), 0
    for name in names:
        text = re.sub(r"!.*", "", run("show", name).stdout)
        for settings in changes(text, run("describe", name).stdout):
            words = [word for setting in settings for word in ("--set", setting)]
            done = run("run", name, "--output", "out", *words)
            counts[done.returncode] += 1
            lines = [line for line in done.stderr.splitlines() if "is not optimised" not in line]
            honest = done.returncode == 0 or (
                done.returncode == "interrupted" and "silent" not in lines[-1]) or (
                done.returncode in (2, 3) and any(re.search(words, lines[-1]) for words in HONEST))
            if not honest:
                wrong += 1
                print(f"FAILED  run {name} {' '.join(settings)}: status {done.returncode}, {lines[-1:]}")
    print(f"{sum(counts.values())} changes of {len(names)} scenes: " + ", ".join(
        f"{counts[status]} with status {status}" for status in sorted(counts, key=str)) + f"; {wrong} failed")
    return wrong > 0 or (not only and sum(counts.values()) < 700)


def changes(text, description):
    """Settings to try of the scene `text`, one after the other."""
    system = re.search(r"system = '(\w+)'", text).group(1)
    given = re.sub(r"\s+", "", re.findall(rf"&{system}\b(.*?)/", text, re.S)[-1])
    for line in description.split("parameters of &")[1].splitlines()[1:]:
        if not line.startswith("  "):
            break
        name = line.split()[0]
        here = re.search(rf"(?:^|,){name}=([^=]*?)(?:,\w+=|$)", given)
        default = re.search(r"(?:default|=) ([-\d.e, ]+)", line)
        values = (here or default).group(1) if here or default else "1"
        values = [float(value) for value in values.split(",") if value.strip()]
        for by, plus in (2.0, 0.0), (0.5, 0.0), (0.0, 0.0), (0.0, 0.1), (0.0, 3.0):
            new = [by * value + plus for value in values]
            if name == "n":
                new = [int(value) for value in new]
            yield [f"{system}%{name}={','.join(map(repr, new))}"]
    count = len(re.search(r"\n\s*q = ([^\n]*)", text).group(1).replace("10*0.6", "0.6," * 9 + "0.6").split(","))
    for i in range(1, min(2, count) + 1):
        yield [f"scene%q({i})=0.3"]
        if system != "rolling_disk":  # its velocities obey the constraint
            yield [f"scene%v({i})=0.2"]
    yield ["scene%t0=1.5"]
    yield ["scene%duration=3"]
    for method in "auto", "rk4", "verlet", "gauss16", "dop853":
        yield [f"scene%method={method}"]
    for method in "rk4", "verlet":
        yield [f"scene%method={method}", "scene%dt=1e-3", "scene%duration=1"]
    yield ["scene%method=dop853", "scene%tolerance=1e-9"]


if __name__ == "__main__":
    sys.exit(main())
