#!/usr/bin/env python3
"""try_terminals.py PROGRAM: on a terminal no line is wider than it; elsewhere each line is as it is.

Each command runs in pseudo-terminals of several widths, with one that does not say how wide it is (80), and with COLUMNS, which
goes before the terminal. The words are those of a pipe, in the same order unless a table is cut into parts; what cannot be
broken, a word, is left to the terminal. JSON, LaTeX, scripts and files that are shown are never folded."""
import fcntl
import os
import pty
import re
import select
import struct
import subprocess
import sys
import tempfile
import termios

import claims
from claims import check

program = os.path.abspath(sys.argv[1])
ESCAPES = re.compile("\r\x1b\\[K|\x1b\\[\\?7[lh]")
PLAIN = {name: value for name, value in os.environ.items() if name != "COLUMNS"}


def on_terminal(words, folder, columns, variable=None):
    """What stdout is on a terminal of so many columns; stderr is none."""
    master, slave = pty.openpty()
    fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    surroundings = dict(PLAIN, COLUMNS=variable) if variable is not None else PLAIN
    child = subprocess.Popen([program, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=slave, stderr=subprocess.DEVNULL,
                             env=surroundings)
    os.close(slave)
    pieces = []
    while select.select([master], [], [], 300)[0]:
        try:
            got = os.read(master, 1 << 16)
        except OSError:  # Linux says so that the other end is closed
            break
        if not got:
            break
        pieces.append(got)
    os.close(master)
    child.wait()
    return ESCAPES.sub("", b"".join(pieces).decode()).replace("\r\n", "\n")


def in_pipe(words, folder):
    return subprocess.run([program, *words], cwd=folder, capture_output=True, text=True, check=False, env=PLAIN).stdout


def steady(text):
    """Without what differs from run to run: times."""
    return re.sub(r"\d+\.\d{2,6}( s)?$|(?<=\"seconds\": )[^,}]*", "TIME", text, flags=re.MULTILINE)


def words_of(text):
    return re.sub(r"accelerations, \S+ s", "TIME", " ".join(text.split()))


def too_wide(text, columns):
    return [line for line in text.split("\n") if len(line) > columns and " " in line.strip()]


def try_folding(folder, words, parts=False):
    what = "lagrangia " + " ".join(words)
    flat = in_pipe(words, folder)
    for columns, variable, width in ((60, None, 60), (80, None, 80), (120, None, 120), (0, None, 80), (120, "70", 70),
                                     (60, "", 60), (60, "x", 60)):
        text = on_terminal(words, folder, columns, variable)
        where = f"{what}, {columns} columns, COLUMNS {variable}:"
        check(f"{where} no line is wider", not too_wide(text, width), str(too_wide(text, width)[:2]))
        if not parts:
            check(f"{where} the same words", words_of(text) == words_of(flat))
        if not parts and not too_wide(flat, width):
            check(f"{where} what fits is as it is", steady(text) == steady(flat))
    if not parts:  # times, of which a table is as wide as they are
        check(f"{what}, 1000 columns: as in a pipe", steady(on_terminal(words, folder, 1000)) == steady(flat))


def try_as_it_is(folder, words):
    flat = in_pipe(words, folder)
    what = "lagrangia " + " ".join(words)
    check(f"{what}: as in a pipe", steady(on_terminal(words, folder, 40)) == steady(flat) and flat)


def below(folder, words, pattern, lines):
    """The lines from the one with `pattern` on are these."""
    text = on_terminal(words, folder, 80).split("\n")
    at = next((i for i, line in enumerate(text) if pattern in line), len(text))
    check("lagrangia " + " ".join(words) + ": the form of a row", text[at:at + len(lines)] == lines, str(text[at:at + len(lines)]))


with tempfile.TemporaryDirectory() as home:
    for command in ("list", "list methods", "errata", "errata E1", "course", "describe scene", "describe hanging_chain",
                    "describe spherical_pendulum", "modes double_pendulum", "modes hanging_chain --set hanging_chain%n=8", "check pendulum",
                    "check methods", "principle", "principle action", "principle virtual-work", "derive double_pendulum --numbers",
                    "run pendulum kepler", "stress kinks zeno mass_ratios", "grade homework/notes_cart_pendulum.txt", "show", "--version"):
        try_folding(home, command.split())
    try_folding(home, "compare pendulum --methods rk4,gauss16,dop853".split(), parts=True)
    for command in ("errata --json", "check pendulum --json", "modes double_pendulum --json",
                    "derive double_pendulum --latex", "show scenes/double_pendulum_formulas.nml", "completion bash", "manual",
                    "compare pendulum --methods rk4,gauss16 --json"):
        try_as_it_is(home, command.split())
    for command in ("", "run", "sweep", "bench"):
        for columns in (60, 80, 120):
            page = on_terminal(["help", *command.split()], home, columns)
            wide = [line for line in too_wide(page, columns) if not line.startswith("  lagrangia ")]
            check(f"help {command}, {columns} columns", page and not wide, str(wide[:2]))
    below(home, ["list", "methods"], "dop853", [
        "dop853                      order 8, steps by tolerance: explicit Runge-Kutta,",
        "                            order 8(5,3), any system (Dormand & Prince 1989)"])
    below(home, ["principle", "action"], "is it zero?", [
        "oscillator, RK4's path: is it zero?",
        "      1.4261526E-03              0 1.4E-03 6.1E-13 differs"])
print(f"{claims.failed} failed")
sys.exit(1 if claims.failed else 0)
