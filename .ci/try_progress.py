#!/usr/bin/env python3
"""try_progress.py PROGRAM: what takes longer says on a terminal how far it is and how long it will still take.

Each command runs in a pseudo-terminal. Within a few seconds there is a line of progress with a percentage and the time
that is left; it comes again and again; in the end it is wiped. With --quiet, on a
dumb terminal, and where stderr is none, there is none, and JSON is the same as without a terminal."""
import glob
import json
import os
import pty
import re
import select
import subprocess
import sys
import tempfile
import time

import claims
from claims import check

program = os.path.abspath(sys.argv[1])
WIPE = "\r\x1b[K"  # what stands before each line of progress, and alone in the end
LINE = re.compile(re.escape(WIPE + "\x1b[?7l") + r"([^\r\n\x1b]*)" + re.escape("\x1b[?7h"))
LEFT = re.compile(r"^[\w ,]+: \d+ %, \d+ (s|min|h|days|years)(, [0-9.E+]+ \w+/s)?, \d+ (s|min|h|days|years) left$")
END = re.compile(r" (0|100) %")  # before the first part is done nobody knows what is left, and behind the last one nothing is
ENOUGH = 2.0      # s that may pass in silence
LATE = 3.0        # s more, for parts of the work that are long themselves
LOOK = 0.2        # s between two looks at who has worked
HANGS = 60.0      # s of silence, whoever else has the machine
TICKS = os.sysconf("SC_CLK_TCK")


def threads_of(session):
    """The time that a processor has worked for each thread of a session, in seconds, by its number."""
    times = {}
    for path in glob.glob("/proc/[0-9]*/stat"):
        try:
            if int(open(path, encoding="utf-8", errors="replace").read().rpartition(")")[2].split()[3]) != session:
                continue
            for task in glob.glob(path[:-len("stat")] + "task/*/stat"):
                spent = open(task, encoding="utf-8", errors="replace").read().rpartition(")")[2].split()[11:13]
                times[task] = sum(map(int, spent))/TICKS
        except (OSError, ValueError, IndexError):  # it has just ended
            continue
    return times


class Work:
    """How long processors have worked for a session: at each moment the thread counts that had the most of them."""

    def __init__(self, session):
        self.session, self.times, self.seconds = session, {}, 0.0

    def look(self):
        now = threads_of(self.session)
        self.seconds += max((spent - self.times.get(thread, 0.0) for thread, spent in now.items()), default=0.0)
        self.times = now
        return self.seconds


def on_terminal(words, folder, stdout=None, kind="xterm", program=program):
    """What comes out of a terminal of that kind, each piece with its time and that of processors, and the status.

    The last piece is the end."""
    pid, terminal = pty.fork()
    if pid == 0:
        os.chdir(folder)
        os.environ["TERM"] = kind
        if stdout:
            os.dup2(os.open(stdout, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), 1)
        os.execv(program, [program, *words])
    begun = heard = time.monotonic()
    work = Work(pid)
    pieces = []
    while True:
        ready, _, _ = select.select([terminal], [], [], LOOK)
        spent = work.look()
        if not ready and time.monotonic() - heard < 300.0:
            continue
        try:
            got = os.read(terminal, 1 << 16) if ready else b""
        except OSError:  # Linux says so that the other end is closed
            got = b""
        if not got:
            break
        heard = time.monotonic()
        pieces.append((heard - begun, spent, got.decode(errors="replace")))
    if not ready:
        os.kill(pid, 9)
    os.close(terminal)
    _, status = os.waitpid(pid, 0)
    pieces.append((time.monotonic() - begun, spent, ""))
    return pieces, os.waitstatus_to_exitcode(status)


def silence_of(times):
    """The longest between two of these; a command that had no processor meanwhile could not speak."""
    gaps = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(times, times[1:])]
    return max(min(gap) if gap[0] < HANGS else gap[0] for gap in gaps)


def words_in(pieces):
    return "".join(text for _, _, text in pieces)


def examine(folder, words):
    what = "lagrangia " + " ".join(words)
    pieces, status = on_terminal(words, folder)
    seconds = pieces[-1][0]
    check(f"{what}: status", status == 0, str(status))
    if seconds < ENOUGH + 1.0:
        return check(f"{what}: takes long enough to be tried", False, f"{seconds:.1f} s")
    told = [(piece[:2], line) for piece in pieces for line in LINE.findall(piece[2]) if line]
    left = [when for when, line in told if LEFT.match(line)]
    silent = silence_of([(0.0, 0.0), *left, pieces[-1][:2]])
    check(f"{what}: how long it will still take", left)
    check(f"{what}: is said again and again", silent < ENOUGH + LATE, f"silent for {silent:.1f} of {seconds:.1f} s")
    print(f"        {seconds:.0f} s, of processors {pieces[-1][1]:.0f} s, silent for {silent:.1f} s at most")
    strange = [line for _, line in told if "%" in line and not LEFT.match(line) and not END.search(line)]
    check(f"{what}: the form of a line", not strange, str(strange[:3]))
    return check(f"{what}: is wiped in the end", wiped(words_in(pieces)), repr(words_in(pieces)[-200:]))


def wiped(text):
    """Nothing of a line of progress stays on the screen: the last of every line is empty."""
    return all("%" not in line.split(WIPE)[-1] or LINE.search(WIPE + line.split(WIPE)[-1]) is None
               for line in text.split("\n"))


def silence(folder, words):
    what = "lagrangia " + " ".join(words)
    pieces, status = on_terminal([*words, "--quiet"], folder)
    text = words_in(pieces)
    check(f"{what} --quiet: says nothing", status == 0 and text == "", repr(text[:200]))
    done = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True, check=False)
    check(f"{what}: no progress off a terminal", "\x1b" not in done.stderr + done.stdout and "\r" not in done.stderr,
          repr(done.stderr[:200]))


def dumb(folder, words):
    """Where a line cannot take the place of another, each stays where it is: no escape sequence, one announcement at most."""
    for kind in ("dumb", ""):
        what = f"TERM={kind} lagrangia {' '.join(words)}"
        pieces, status = on_terminal(words, folder, kind=kind)
        text = words_in(pieces)
        check(f"{what}: no escape sequence", status == 0 and "\x1b" not in text and "\r" not in text.replace("\r\n", ""),
              repr(text[:200]))


def same_json(folder, words):
    """stdout is a file and stderr the terminal; then both are the terminal, which shows valid JSON."""
    what = "lagrangia " + " ".join(words)
    path = os.path.join(folder, "json")
    pieces, status = on_terminal(words, folder, path)
    check(f"{what}: progress beside JSON", LINE.search(words_in(pieces)) is not None)
    with open(path, encoding="utf-8") as file:
        rows = json.load(file)
    pieces, status = on_terminal(words, folder)
    text = words_in(pieces)
    shown = json.loads(LINE.sub("", text).replace("\r\n", "\n").replace(WIPE, "").replace("\x1b[?7l\x1b[?7h", ""))
    check(f"{what}: as many rows on a terminal", len(shown) == len(rows))


LONG = (["stress", "mass_ratios"], ["stress", "energy_growth"], ["check", "hanging_chain", "--set", "hanging_chain%n=40"],
        ["modes", "hanging_chain", "--set", "hanging_chain%n=120", "--plot"],
        ["run", "pendulum", "--set", "scene%duration=4000", "--plot"], ["sweep", "lyapunov_map", "--set", "scene%duration=3000"],
        ["bench", "sweep"], ["report"], ["--plot"])
with tempfile.TemporaryDirectory() as home:
    # The limit counts time of a processor, however many others have the machine.
    mute, _ = on_terminal(["-c", f"(ulimit -t {ENOUGH + LATE + 3:.0f}; exec yes >/dev/null)"], home, program="/bin/sh")
    check("a command whose child works in silence is noticed", silence_of([(0.0, 0.0), mute[-1][:2]]) > ENOUGH + LATE, str(mute))
    for command in LONG:
        examine(home, command)
    silence(home, ["stress", "mass_ratios"])
    silence(home, ["run", "pendulum", "--set", "scene%duration=4000", "--plot"])
    dumb(home, ["stress", "mass_ratios"])
    same_json(home, ["stress", "mass_ratios", "--json"])
print(f"{len(LONG)} long commands, {claims.failed} failed")
sys.exit(1 if claims.failed else 0)
