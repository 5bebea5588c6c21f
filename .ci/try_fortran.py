#!/usr/bin/env python3
"""Systems in formulas, written in Fortran by `derive --fortran`, compiled and compared.

    .ci/try_fortran.py PREFIX

PREFIX is where lagrangia is installed. Every shipped scene with formulas, and some whose names clash
with Fortran's or the module's or with other kinds of constraints, becomes a module; all are compiled with
warnings as errors into one program, whose audit must hold for each, and whose motion must be the scene's,
with the multipliers and what is left of the constraints.
"""
import glob
import json
import os
import re
import subprocess
import sys
import tempfile

prefix = os.path.abspath(sys.argv[1])
here = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
lagrangia = f"{prefix}/bin/lagrangia"
claims = failures = 0

CLASHES = """&scene system = 'clashes' dt = 0.01 duration = 1.0 method = 'gauss16' every = 10
  q = 0.3, 0.2, 0.4 v = 0.1, 0.2, 0.3 /
&lagrangian coordinates = 'a1 [m] of a body', 'r [m] it''s "so"', 'value',
  parameters = 'q', 'f [kg] mass', 'P', 'i', 'self', 'sine2', 'd', 'k'
  T = 'f/2 (a1_dot^2 + r_dot^2 + 1/3 a1_dot r_dot cos(a1 - r) + i value_dot^2/7) + |q| exp(-r^2)/11 value_dot^2'
  V = 'self/2 a1^2 + P sinh(r/3)^2 + cosh(value) + sine2 a1^4/4 + k sqrt(1 + a1^2) + atan(r)^2 + log(2 + value^2) + tanh(a1)^2'
  Q_r = '-d r_dot + 1e-3 sin(t)^2 (1 + r^2)^(-1) - (1 + a1^2)^(2/3)/10 - tan(value/9)'
  positions = 'b: a1, r, value'
  quantities = 'speed [m/s] of b = sqrt(a1_dot^2 + r_dot^2)', 'w = sin(sin(r)) + 2^(a1/3) pi^2/6'
  definitions = 'e = f/2 r_dot^2'
  domain = 'f > 0', 'i >= 0.125', 'sine2 <= 1e3', 'd >= 0'
  equilibrium = '0', '0', '0' /
&clashes q = 1.0 f = 2.0 P = 3.0 i = 1.5 self = 2.5 sine2 = 0.7 d = 0.1 k = 0.3 /
"""
CHAIN = """&scene system = 'chain12' dt = 0.01 duration = 1.0 method = 'rk4' every = 10 q = 12*0.3 v = 12*0.0 /
&lagrangian coordinates = 'theta_1 .. theta_12 [rad]' parameters = 'm', 'l', 'g', 'b'
  V = '-m g sum(i, 1, 12, sum(k, 1, i, l cos(theta_k)))', Q_theta_i = '-b theta_i_dot'
  positions = 'bob_1 .. bob_12, m: sum(k, 1, i, l sin(theta_k)), -sum(k, 1, i, l cos(theta_k))' /
&chain12 m = 1.0 l = 0.2 g = 9.81 b = 0.1 /
"""
PLAIN = """&scene system = 'plain' duration = 1.0 method = 'dop853' tolerance = 1e-11 samples = 10 q = 1.0 /
&lagrangian coordinates = 'x' L = 'x_dot^2/2 - x^2/2 + t x_dot' /
"""
BALL = """&scene system = 'ball_on_track' dt = 0.01 duration = 1.0 method = 'rk4' every = 10
  q = 0.0, 0.0, 0.0 v = 1.0 columns = 't', 'lambda1', 'lambda2', 'constraint1', 'constraint2', 'energy' /
&lagrangian coordinates = 'lambda', 'rows', 'drift' parameters = 'values', 'self', 'g'
  T = 'values/2 (lambda_dot^2 + rows_dot^2) + self/2 drift_dot^2', V = 'values g rows'
  constraint = 'rows = 0.3 sin(2 lambda)', 'drift_dot = lambda_dot exp(rows) + 0.1 t'
  positions = 'ball, values: lambda, rows', 'mark: drift, 0' /
&ball_on_track values = 1.0 self = 0.2 g = 9.81 /
"""
PIVOT = """&scene system = 'moving_pivot' dt = 0.01 duration = 1.0 method = 'rk4' every = 10
  q = 0.0, -1.3 v = 0.6 columns = 't', 'x', 'y', 'lambda1', 'constraint1', 'energy' /
&lagrangian coordinates = 'x', 'y' parameters = 'mass', 'length', 'amplitude', 'omega', 'g'
  T = 'mass/2 (x_dot^2 + y_dot^2)', V = 'mass g y'
  constraint = '(x - amplitude sin(omega t))^2 + (y - amplitude sin(omega t)^2)^2 = length^2'
  domain = 'mass > 0', 'length > 0' /
&moving_pivot mass = 0.8 length = 1.3 amplitude = 0.2 omega = 3.0 g = 9.81 /
"""


def check(claim, holds, why=""):
    """One claim."""
    global claims, failures
    claims += 1
    if holds:
        print(f"ok      {claim}")
    else:
        failures += 1
        print(f"FAILED  {claim}")
        print("        | " + "\n        | ".join(str(why).splitlines()[:30]))


def run(*words, **more):
    return subprocess.run(words, text=True, capture_output=True, stdin=subprocess.DEVNULL, timeout=300, **more)


def group_of(text, name):
    """The group `&name ... /` of a scene, with texts in quotes skipped."""
    return re.search(r"&%s\b(?:'(?:[^']|'')*'|\"[^\"]*\"|![^\n]*|[^'\"/!])*/" % name, text, re.S | re.I)


def links(path):
    """Multipliers and what is left of constraints, of all columns of the last row of a data file."""
    with open(path) as file:
        lines = file.read().splitlines()
    heads = [line for line in lines if re.match(r"# \w+\[", line)][-1].split()[1:]
    return [float(x) for head, x in zip(heads, lines[-1].split()) if re.match(r"lambda\d|constraint\d", head)]


def same_end(scene, bound, *changes):
    """Does a run of 1 s end the same from the formulas and from the module?"""
    ends = []
    for program, where in ((lagrangia, "."), ("../written", f"of_{scene}")):
        words = [word for change in ("duration=1.0", *changes) for word in ("--set", f"scene%{change}")]
        got = run(program, "run", f"{scene}.nml", "--json", "--output", "out", *words, cwd=where)
        try:
            ends.append(json.loads(got.stdout)[0])
            ends[-1]["links"] = links(os.path.join(where, ends[-1]["file"]))
        except ValueError:
            ends.append({"q": [], "v": [], "links": []})
            print(got.stderr, end="")
    a, b = (end["q"] + end["v"] + end["links"] for end in ends)
    return a and len(a) == len(b) and all(abs(x - y) <= bound * max(1, abs(x)) for x, y in zip(a, b)), f"{ends}"


work = tempfile.TemporaryDirectory()
os.chdir(work.name)
scenes = {}
for path in glob.glob(f"{here}/data/scenes/*.nml"):
    text = open(path).read()
    if group_of(text, "lagrangian"):
        scenes[os.path.basename(path)[:-4]] = text
for text in (CLASHES, CHAIN, PLAIN, BALL, PIVOT):
    scenes[re.search(r"system = '(\w+)'", text)[1]] = text
names, kept = {}, {}
for number, (scene, text) in enumerate(sorted(scenes.items())):
    name = re.search(r"system\s*=\s*'(\w+)'", text)[1]
    if name in names.values():
        continue
    os.makedirs(f"of_{scene}", exist_ok=True)
    with open(f"{scene}.nml", "w") as file:
        file.write(text)
    got = run(lagrangia, "derive", f"{scene}.nml", "--fortran")
    if got.returncode:
        check(f"{scene}: written", False, got.stderr)
        continue
    wide = [line for line in got.stdout.splitlines() if len(line) > 100 or line != line.rstrip()]
    check(f"{scene}: at most 100 columns, no blanks at the end of a line", not wide, "\n".join(wide))
    with open(f"{name}.f90", "w") as file:
        file.write(got.stdout)
    got = run("gfortran", "-c", "-O2", "-march=native", "-mno-avx512f", "-ffp-contract=off", "-std=f2018", "-Wall", "-Wextra",
              "-Wno-unused-dummy-argument", "-Werror", f"-I{prefix}/include", f"{name}.f90")
    check(f"{scene}: compiled without a warning", got.returncode == 0, got.stderr)
    if got.returncode == 0:
        names[scene], kept[scene] = name, text
with open("main.f90", "w") as file:
    file.write("program main\n    use lagrangia, only: error_t, lagrangia_main, register_system\n")
    file.writelines(f"    use {name}, only: {name}_t\n" for name in names.values())
    file.write("    implicit none (type, external)\n    type(error_t), allocatable :: error\n")
    for name in names.values():
        file.write(f"    if (.not. allocated(error)) call register_system({name}_t(), error)\n")
    file.write("    call lagrangia_main(error)\nend program main\n")
got = run("gfortran", "-std=f2018", "-Wall", f"-I{prefix}/include", "main.f90", *(f"{name}.o" for name in names.values()),
          f"-L{prefix}/lib", "-llagrangia", "-llapack", "-lblas", "-lgsl", "-lgslcblas", "-lgomp", "-o", "written")
check("all of them in one program", got.returncode == 0, got.stderr)
for scene, name in names.items() if got.returncode == 0 else ():
    got = run("./written", "check", name)
    check(f"{scene}: the audit holds", got.returncode == 0 and "accelerations in lanes" in got.stdout, got.stdout + got.stderr)
    text = kept[scene].replace(group_of(kept[scene], "lagrangian")[0], "")
    with open(f"of_{scene}/{scene}.nml", "w") as file:
        file.write(text)
    check(f"{scene}: the motion is that of the formulas", *same_end(scene, 1e-9, "method=gauss16", "tolerance=1e-11"))
    if "constraint1 is conserved" in got.stdout:  # rk4 alone would leave them
        for where in (".", f"of_{scene}"):
            with open(f"{where}/{scene}.nml") as file:
                steps = re.sub(r"^  tolerance = .*", "  dt = 0.02, duration = 1.0", file.read(), flags=re.M)
            with open(f"{where}/{scene}.nml", "w") as file:
                file.write(steps)
        check(f"{scene}: each step ends on the constraints", *same_end(scene, 1e-13, "method=rk4"))
for words, message in (
        (("pendulum", "--fortran"), "lagrangia: pendulum is in Fortran already; --fortran is for a scene with formulas, "
         "such as spring_pendulum\n"),
        (("spring_pendulum", "--fortran", "--latex"), "lagrangia: the option '--fortran' goes with '--set' only\n")):
    got = run(lagrangia, "derive", *words)
    check("refused: derive " + " ".join(words), got.returncode == 2 and got.stderr == message and not got.stdout, got.stderr)
print(f"{claims} claims, {failures} failed")
sys.exit(failures > 0)
