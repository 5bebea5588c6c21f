#!/usr/bin/env python3
"""Change one random place of the sources at a time, and see whether anything notices.

    .ci/mutants/mutate.py [--count 100] [--seed 1] [--only src/systems] [--skip TEXT]
                          [--output mutants.jsonl] [--quick]

Run it, by nice, in a checkout of its own whose tests pass. Each mutant is one change of one statement in
src: an operator, a number, an intrinsic function, a condition, a deleted statement or, within a
string, a sign. Each kind of change has the same chance, and a line of src/audit, src/principles,
src/scenes, src/runs, src/commands, src/bench and src/stress twice that of another. One file is compiled and linked with
the objects of an ordinary build; where the change is seen by other files (a named constant, what
a component begins with) a copy of the project is built again. A mutant whose object file is the
original's is no mutant.

It dies if the unit tests fail, crash or use ten times the processor's time; what survives them
meets what users run: the main job, check, errata, .ci/try_commands.sh and stress. Survivors are
printed with their change: each is either a hole in the tests or the same program in other words,
which a person decides. Not part of the gate: a hundred mutants take about half an hour on one core.
"""
import argparse
import gzip
import json
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading

FLAGS = "-O2 -g0"  # what calls itself optimised
SWAPS = {
    "arithmetic": [(" + ", " - "), (" - ", " + "), ("*", "/"), ("/", "*"), ("**2", "**3")],
    "relation": [(" < ", " <= "), (" <= ", " < "), (" > ", " >= "), (" >= ", " > "), (" == ", " /= "),
                 (" /= ", " == "), (" < ", " > "), (" > ", " < ")],
    "logic": [(".and.", ".or."), (".or.", ".and."), (".not. ", ""), (".true.", ".false."),
              (".false.", ".true.")],
    "function": [("sin(", "cos("), ("cos(", "sin("), ("min(", "max("), ("max(", "min("), ("abs(", "("),
                 ("sqrt(", "("), ("maxval(", "minval("), ("minval(", "maxval("), ("any(", "all("),
                 ("all(", "any("), ("trim(", "(")],
}
HEAVY = ("audit", "principles", "scenes", "runs", "commands", "bench", "stress")  # drawn twice as often
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d+(?:e-?\d+)?_dp|\d+(?!\.\d)(?:_i8)?)(?![\w.])")
DECLARATION = re.compile(r"^\s*(use|import|implicit|public|private|end|module|submodule|contains|type|class|real|integer|"
                         r"logical|character|procedure|abstract|interface|pure|elemental|subroutine|function|"
                         r"generic|!|else\s*$|associate|block|do\s*$|return\s*$|select|case default)(?!\w)", re.I)


def split_code(line):
    """The parts of a line: (text, is_string), without its comment."""
    parts, place, start = [], 0, 0
    while place < len(line):
        letter = line[place]
        if letter == "!":
            break
        if letter in "\"'":
            end = line.find(letter, place + 1)
            end = len(line) - 1 if end < 0 else end
            parts += [(start, place, False), (place, end + 1, True)]
            place = start = end + 1
        else:
            place += 1
    parts.append((start, place, False))
    return [(a, b, s) for a, b, s in parts if b > a]


def other_number(text):
    """The same kind of literal with another value."""
    if "_dp" in text:
        body = text[:-3]
        return "1.0_dp" if float(body) == 0 else "2.0_dp*" + text if float(body) == 1 else repr(1.5*float(body)) + "_dp"
    body, kind = (text[:-3], "_i8") if text.endswith("_i8") else (text, "")
    return str(int(body) + 1) + kind


def changes_of(line, before):
    """All single changes of one line: (operator, new line)."""
    found = []
    declares = DECLARATION.match(line)
    constant = re.search(r"::.*\w = ", line)  # a named constant, or what a component begins with
    continued = line.rstrip().endswith("&") or before.rstrip().endswith("&")
    for a, b, is_string in split_code(line):
        text = line[a:b]
        if is_string:
            if re.search(r"[a-z)0-9] [+-] [a-z(0-9]", text):
                for old, new in ((" + ", " - "), (" - ", " + ")):
                    at = text.find(old)
                    if at >= 0:
                        found.append(("string", line[:a] + text[:at] + new + text[at + 3:] + line[b:]))
            continue
        if declares and not constant:
            continue
        for kind, swaps in SWAPS.items():
            for old, new in swaps:
                at = -1
                while True:
                    at = text.find(old, at + 1)
                    if at < 0:
                        break
                    if old in "*/" and (text[at:at + 2] in ("**", "//", "/=", "/)") or text[at - 1:at] in ("*", "/", "(")):
                        continue
                    if old[0].isalpha() and at > 0 and (text[at - 1].isalnum() or text[at - 1] in "_%"):
                        continue
                    if old == "**2" and text[at + 3:at + 4].isdigit():
                        continue
                    found.append((kind, line[:a] + text[:at] + new + text[at + len(old):] + line[b:]))
        for match in NUMBER.finditer(text):
            at = match.start()
            if text[max(0, at - 8):at].rstrip().endswith(("case (", "dimension(")):
                continue
            found.append(("number", line[:a] + text[:at] + other_number(match.group(1)) + text[match.end():] + line[b:]))
    if not declares and not continued and line.strip():
        statement = line.strip()
        if re.match(r"(?!do )(call |if \(.*\) (return|cycle|exit|call|[a-z_%()0-9:]+ =)|[a-z_][\w%()+\-*/:, ]* = )", statement):
            found.append(("deletion", ""))
        block = re.match(r"(\s*)if \((.*)\) then\s*$", line)
        if block:
            found.append(("condition", f"{block.group(1)}if (.not. ({block.group(2)})) then\n"))
    return found


class Limits:
    """What a mutant may use: seconds of the processor, of the clock, bytes of memory and of a file."""

    def __init__(self, seconds):
        self.processor, self.clock = int(seconds), 30*seconds + 60

    def set(self):
        os.setsid()
        for number in (signal.SIGINT, signal.SIGHUP, signal.SIGQUIT):  # nohup and & have them ignored
            signal.signal(number, signal.SIG_DFL)
        resource.setrlimit(resource.RLIMIT_CPU, (self.processor, self.processor))
        resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
        resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))


def run(command, cwd, limits, stop_at=None):
    """Exit status and output, all of it or up to the line that begins with `stop_at`."""
    child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             cwd=cwd, errors="replace", text=True, preexec_fn=limits.set)
    end = lambda: os.killpg(child.pid, signal.SIGKILL)
    watch = threading.Timer(limits.clock, end)
    watch.start()
    lines = []
    for line in child.stdout:
        lines.append(line)
        if stop_at and line.startswith(stop_at):
            end()
            break
    child.stdout.close()
    status = child.wait()
    watch.cancel()
    return status, "".join(lines)


GENEROUS = Limits(3600)


def processor_time():
    """Seconds that the processes started so far have used."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Build:
    """The objects of an ordinary build, and how to link them with one of them exchanged."""

    def __init__(self, root, work):
        self.root, self.work = root, work
        self.build(root)
        self.objects = os.path.dirname(self.newest(root, "app_main.f90.o"))
        self.library = self.newest(root, "liblagrangia.a")
        self.tests = [os.path.join(self.objects, name) for name in os.listdir(self.objects)
                      if name.startswith("test_") and name.endswith(".o")]
        self.originals = {}
        self.tree = None

    def build(self, root):
        status, text = run(["fpm", "build", "--tests", "--flag", FLAGS], root, GENEROUS)
        if status != 0:
            sys.exit(text[-3000:])
        self.unit = self.newest(root, "unit")
        self.program = self.newest(root, "lagrangia")

    def newest(self, root, name):
        found = []
        for folder, _, files in os.walk(os.path.join(root, "build")):
            if name in files:
                found.append(os.path.join(folder, name))
        return max(found, key=os.path.getmtime)

    def compile(self, source, text):
        """The object of `text` in the place of `source`, and the interface that others see of it, in
        bytes; both None if it does not compile."""
        folder = os.path.join(self.work, "compiled")
        shutil.rmtree(folder, ignore_errors=True)  # else the next file would see a mutant's .mod
        os.mkdir(folder)
        path = os.path.join(folder, os.path.basename(source))
        with open(path, "w") as file:
            file.write(text)
        target = os.path.join(folder, "mutant.o")
        status, _ = run(["gfortran", "-c", path, *FLAGS.split(), "-fimplicit-none", "-ffree-form", "-J", folder,
                         "-I" + os.path.dirname(self.objects), "-o", target], self.root, GENEROUS)
        if status != 0:
            return None, None
        seen = [gzip.open(os.path.join(folder, name)).read() for name in sorted(os.listdir(folder))
                if name.endswith(("mod", "smod"))]
        return open(target, "rb").read(), seen

    def original(self, source):
        if source not in self.originals:
            self.originals[source] = self.compile(source, open(os.path.join(self.root, source)).read())
        return self.originals[source]

    def mutant(self, source, text):
        """The tests and the program with `text` in the place of `source`; None if there is no such mutant."""
        code, seen = self.compile(source, text)
        if code is None or (code, seen) == self.original(source):
            return None
        if seen != self.original(source)[1]:
            return self.rebuilt(source, text)
        self.compile(source, text)
        pairs = []
        for name, objects in (("unit", self.tests), ("lagrangia", [os.path.join(self.objects, "app_main.f90.o")])):
            output = os.path.join(self.work, name)
            status, _ = run(["gfortran", *objects, os.path.join(self.work, "compiled", "mutant.o"), self.library,
                             "-llapack", "-lblas", "-lgsl", "-lgslcblas", "-o", output], self.root, GENEROUS)
            if status != 0:
                return None
            pairs.append(output)
        return pairs

    def rebuilt(self, source, text):
        """The same where others see the change."""
        if not self.tree:
            self.tree = os.path.join(self.work, "tree")
            shutil.copytree(self.root, self.tree, symlinks=True, ignore=shutil.ignore_patterns(".git"))
        path = os.path.join(self.tree, source)
        shutil.copy(path, path + ".kept")
        with open(path, "w") as file:
            file.write(text)
        status, _ = run(["fpm", "build", "--tests", "--flag", FLAGS], self.tree, GENEROUS)
        os.replace(path + ".kept", path)
        os.utime(path)
        return [self.newest(self.tree, "unit"), self.newest(self.tree, "lagrangia")] if status == 0 else None


def noticed_by_tests(unit, root, source, limits):
    """The first test that fails, the suites that use the module of `source` first; "" if none does."""
    module = "lagrangia_" + os.path.basename(source)[:-4]
    near = []
    for name in sorted(os.listdir(os.path.join(root, "test"))):
        if name.endswith(".f90"):
            text = open(os.path.join(root, "test", name)).read()
            suite = re.search(r'TestSuite\("([^"]*)"\)', text)
            if suite and re.search(r"\b" + module + r"\b", text):
                near.append(["--filter", suite.group(1) + "."])
    for words in near[:4] + [[]]:
        status, text = run([unit, *words], root, limits, stop_at="Failure in: ")
        if status != 0:
            found = re.search(r"^(?:Failure|Error) in:? (.*)$", text, re.M)
            return found.group(1) if found else "time-out" if status in (-9, -24) else f"crash {status}"
    return ""


def noticed_by_users(program, root, work, limits, quick):
    """The first of the things that users run which does not end well; "" if all do."""
    for command in ([program, "--output", os.path.join(work, "data")], [program, "check"], [program, "errata"],
                    ["bash", ".ci/try_commands.sh", program], [program, "stress", "--quiet"]):
        if quick and "stress" in command:
            continue
        status, text = run(command, root, limits)
        if status != 0:
            claim = re.search(r"^FAILED +(.*)$", text, re.M)
            if claim:
                return claim.group(1)
            return " ".join(command[1:2]) if command[1][0] != "-" else "the main job"
    return ""


def sites_of(root, only, skip):
    """All changes of all lines: (file, line, kind, new line)."""
    sites = []
    for folder, _, files in os.walk(os.path.join(root, only)):
        for name in sorted(files):
            source = os.path.relpath(os.path.join(folder, name), root)
            if not name.endswith(".f90") or (skip and skip in source):
                continue
            lines = open(os.path.join(root, source)).readlines()
            for k, line in enumerate(lines):
                for kind, new in changes_of(line, lines[k - 1] if k else ""):
                    if new != line:
                        sites.append((source, k, kind, new))
    return sorted(sites)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--count", type=int, default=100)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--only", default="src")
    words.add_argument("--skip", default="")
    words.add_argument("--output", default="mutants.jsonl")
    words.add_argument("--quick", action="store_true", help="no stress, and nothing is run without a mutant")
    words = words.parse_args()
    root = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
    work = tempfile.mkdtemp()
    os.environ["TMPDIR"] = os.path.join(work, "tmp")
    os.mkdir(os.environ["TMPDIR"])
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    draw = random.Random(words.seed)
    build = Build(root, work)
    limits = [Limits(60), Limits(300)] if words.quick else []
    for notice in () if words.quick else (lambda: noticed_by_tests(build.unit, root, "", GENEROUS),
                   lambda: noticed_by_users(build.program, root, work, GENEROUS, False)):
        used = processor_time()
        noticed = notice()
        if noticed:
            sys.exit("without any mutant this fails: " + noticed)
        limits.append(Limits(10*(processor_time() - used)))
    sites = sites_of(root, words.only, words.skip)
    by_kind = {}
    for site in sites:
        by_kind.setdefault(site[2], []).extend([site]*(2 if site[0].split("/")[1] in HEAVY else 1))
    tally = {"died": 0, "died in use": 0, "survived": 0}
    with open(words.output, "a") as log:
        while sum(tally.values()) < words.count:
            source, k, kind, new = draw.choice(by_kind[draw.choice(sorted(by_kind))])
            lines = open(os.path.join(root, source)).readlines()
            old = lines[k]
            lines[k] = new if new else "\n"
            pair = build.mutant(source, "".join(lines))
            if not pair:
                continue
            fate, by = "died", noticed_by_tests(pair[0], root, source, limits[0])
            if not by:
                by = noticed_by_users(pair[1], root, work, limits[1], words.quick)
                fate = "died in use" if by else "survived"
            tally[fate] += 1
            row = {"seed": words.seed, "file": source, "line": k + 1, "kind": kind, "old": old.strip(),
                   "new": new.strip(), "fate": fate, "by": by}
            log.write(json.dumps(row) + "\n")
            log.flush()
            print(f"{fate:12} {source}:{k + 1} {kind}: {old.strip()}  ->  {new.strip() or '(deleted)'}  [{by}]", flush=True)
    shutil.rmtree(work, ignore_errors=True)
    print(", ".join(f"{n} {fate}" for fate, n in tally.items()))


if __name__ == "__main__":
    main()
