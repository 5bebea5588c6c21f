#!/usr/bin/env python3
"""try_help.py PROGRAM: what --help says of each command is so.

Each option that `COMMAND --help` names is taken with a good value, and refused without one and with a wrong one: one line, status 2,
nothing on stdout, no file. Each option that it does not name is refused. Each example runs, in a folder of its own."""
import os
import re
import subprocess
import sys
import tempfile

import claims
from claims import check

program = os.path.abspath(sys.argv[1])

# A cheap command of each kind, which stands for it; its status where that is not 0.
CHEAP = {
    "": [], "run": ["pendulum"], "compare": ["pendulum", "--methods", "rk4,verlet"],
    "report": ["atwood"], "modes": ["double_pendulum"], "check": ["atwood"], "errata": ["E1"], "principle": ["least-time"],
    "course": ["II"], "bench": ["output", "--quick"], "stress": ["step_limits"], "grade": ["right.txt"],
    "sweep": ["pendulum", "--over", "q=0.1:1:3", "--keep", "period"], "list": ["sweeps"], "show": ["pendulum"], "describe": ["pendulum"],
    "derive": ["pendulum"], "help": ["run"], "completion": ["bash"], "manual": [],
}
# What makes the cheap command one with which the option goes.
INSTEAD = {
    ("compare", "starts"): ["pendulum"], ("compare", "methods"): ["pendulum"], ("run", "overlay"): ["pendulum", "pendulum_rotation"],
    ("bench", "problems"): ["precision", "--methods", "rk4", "--quick"], ("bench", "methods"): ["precision", "--problems", "oscillator", "--quick"],
    ("bench", "systems"): ["steps", "--methods", "rk4", "--quick"], ("bench", "quick"): ["output"], ("sweep", "over"): ["pendulum", "--keep", "period"],
    ("bench", "tolerances"): ["precision", "--problems", "oscillator", "--methods", "gauss16", "--quick"],
    ("bench", "plot"): ["precision", "--problems", "oscillator", "--methods", "rk4", "--quick"],
    ("sweep", "keep"): ["pendulum", "--over", "q=0.1:1:3"], ("derive", "slip"): ["cart_pendulum"], ("derive", "fortran"): ["duffing"],
    ("describe", "set"): ["pendulum"], ("report", "set"): ["pendulum"],
}
GOOD = {
    "set": "pendulum%l=2", "at": "0.0,0.0", "output": "there", "format": "csv", "problems": "oscillator", "methods": "rk4,gauss16",
    "starts": "0.1 0.2:0.3", "systems": "pendulum", "tolerances": "1e-6", "over": "q=0.1:1:3", "keep": "max theta", "seed": "2", "threads": "1",
    "slip": "E1",
}
WRONG = {
    "set": ["pendulum", "foo%l=2", "pendulum%l=x", "pendulum%l=-1"], "at": ["x", "1,2,3", "nan"], "format": ["xml"], "plot": ["bmp"],
    "problems": ["P99"], "methods": ["rk5"], "starts": ["a:b", "1:2:3"], "systems": ["nothing"], "tolerances": ["x", "-1"],
    "over": ["q", "q=1:2", "q=1:2:x", "foo=1:2:3"], "keep": ["foo", "max foo"], "seed": ["x", "1.5"], "threads": ["0", "x"], "slip": ["E99", "x"],
}
# The systems and scenes of cheap commands that have not the parameter of GOOD["set"].
SETS = {"modes": "double_pendulum%l1=2", "check": "atwood%m1=2"}
DEAR = {
    "lagrangia bench --quick": "lagrangia bench output --quick",
    "lagrangia bench precision --problems P1 --methods gauss16,dop853 --plot": "lagrangia bench precision --problems P1 --methods dop853 --quick --plot",
    "lagrangia bench steps --systems pendulum,hanging_chain": "lagrangia bench steps --systems pendulum,hanging_chain --quick",
    "lagrangia stress": "lagrangia stress step_limits", "lagrangia report": "lagrangia report pendulum wedge",
    "lagrangia manual >lagrangia.1 && man -l lagrangia.1": "lagrangia manual >lagrangia.1",
}
MAY_BE_1 = ("lagrangia grade atwood",)  # its sheet has a wrong line, as homework has


def run(folder, words):
    return subprocess.run([program, *words], cwd=folder, capture_output=True, text=True, timeout=300, check=False, stdin=subprocess.DEVNULL)


def page_of(command):
    """The options of a command as its help names them, `name` and the value if there is one, and the examples."""
    text = run(".", [command, "--help"] if command else ["--help"]).stdout
    options = re.findall(r"^  --([a-z-]+)(?:(\[=)|( )(?=\S))?", text[text.index("\noptions:"):], re.MULTILINE)
    found = {name: "may" if may else "must" if must else "none" for name, may, must in options}
    return found, re.findall(r"^  (\S.*)$", text.partition("\nexamples:\n")[2], re.MULTILINE)


def refused(folder, words, what):
    before = sorted(os.listdir(folder))
    done = run(folder, words)
    good = done.returncode == 2 and done.stdout == "" and re.fullmatch(r"lagrangia: [^\n]+\n", done.stderr)
    check(f"{what}: lagrangia {' '.join(words)}", good, f"status {done.returncode}, {done.stdout[:100]!r} {done.stderr[:300]!r}")
    check(f"{what}: lagrangia {' '.join(words)}: no file", sorted(os.listdir(folder)) == before, str(os.listdir(folder)))


def base(command, option):
    words = INSTEAD.get((command, option), CHEAP[command])
    return [command, *words] if command else list(words)


def taken(folder, command, option, kind):
    words = base(command, option)
    if kind == "must":
        value = SETS.get(command, GOOD["set"]) if option == "set" else GOOD[option]
        for more in ([f"--{option}", value], [f"--{option}={value}"]):
            one(folder, words + more)
    else:
        one(folder, [*words, f"--{option}"])
    if kind == "may":
        for value in ("png", "svg", "pdf"):
            one(folder, [*words, f"--{option}={value}"])


def one(folder, words):
    """In a folder of its own."""
    with tempfile.TemporaryDirectory(dir=folder) as here:
        sheet(here)
        done = run(here, words)
        resumed = "--resume" in words and "there is nothing to resume" in done.stderr  # .ci/attack_signals.sh interrupts
        check(f"lagrangia {' '.join(words)}", done.returncode == (5 if resumed else 0), f"status {done.returncode}, {done.stderr[:300]!r}")


def sheet(folder):
    """And the scenes of a folder in which `lagrangia` alone is called."""
    scenes = os.path.join(folder, "data", "scenes")
    os.makedirs(scenes)
    with open(os.path.join(scenes, "pendulum.nml"), "w", encoding="utf-8") as file:
        file.write(run(folder, ["show", "pendulum"]).stdout)
    with open(os.path.join(folder, "right.txt"), "w", encoding="utf-8") as file:
        file.write("system: pendulum\nL = m/2 l^2 theta_dot^2 + m g l cos(theta)\n")


def examples(folder, lines):
    names = os.path.join(folder, "names")
    os.makedirs(os.path.join(names, ".zfunc"), exist_ok=True)
    if not os.path.exists(os.path.join(names, "lagrangia")):
        os.symlink(program, os.path.join(names, "lagrangia"))
    for line in lines:
        check(f"{line}: is a command", "lagrangia " in line)
        with tempfile.TemporaryDirectory(dir=folder) as here:
            sheet(here)
            os.rename(os.path.join(here, "right.txt"), os.path.join(here, "homework.txt"))
            with open(os.path.join(here, "mine.nml"), "w", encoding="utf-8") as file:
                file.write(run(here, ["show", "pendulum"]).stdout)
            surroundings = dict(os.environ, PATH=names + ":" + os.environ["PATH"], HOME=names)
            done = subprocess.run(["bash", "-c", "set -e; " + DEAR.get(line, line)], cwd=here, env=surroundings, capture_output=True, text=True,
                                  timeout=300, check=False, stdin=subprocess.DEVNULL)
            check(f"example {line}", done.returncode in ((0, 1) if line in MAY_BE_1 else (0,)), f"status {done.returncode}, {done.stderr[:300]!r}")


everything, _ = page_of("")
commands = [""] + re.findall(r"^  lagrangia ([a-z]+)", run(".", ["--help"]).stdout, re.MULTILINE)
check("each command is tried", sorted(commands) == sorted(CHEAP), str(set(commands) ^ set(CHEAP)))
count = 0
with tempfile.TemporaryDirectory() as home:
    sheet(home)
    for command in commands:
        options, lines = page_of(command)
        if command == "":
            accepted = re.search(r"it takes (.*)", run(home, ["--nothing"]).stderr)
            options = {name: kind for name, kind in options.items() if name in ("help", "version") or f"--{name}" in accepted[1]}
        for option, kind in everything.items():
            count += 1
            words = base(command, option)
            if option not in options:
                value = [GOOD[option]] if kind == "must" else []
                refused(home, [*words, f"--{option}", *value], "an option that help does not name")
                continue
            check(f"{command} --help: the same value of --{option}", options[option] == kind)
            taken(home, command, option, kind)
            if kind == "must":
                refused(home, [*words, f"--{option}"], "no value")
                if option != "output":
                    refused(home, [*words, f"--{option}="], "an empty value")
            if kind == "none":
                refused(home, [*words, f"--{option}=1"], "a value that is not taken")
            for value in WRONG.get(option, []):
                refused(home, [*words, f"--{option}={value}"], "a wrong value")
        examples(home, lines)
print(f"{count} options of {len(commands)} commands, {claims.failed} failed")
sys.exit(1 if claims.failed else 0)
