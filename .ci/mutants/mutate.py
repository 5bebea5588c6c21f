#!/usr/bin/env python3
"""Change one random place of the sources at a time, and see whether anything notices.

    .ci/mutants/mutate.py [--count 100] [--seed 1] [--only src/systems] [--output mutants.jsonl]

Run it in a checkout whose tests pass. Each mutant is one change of one statement in src: an
operator, a number, an intrinsic function, a condition, a deleted statement or, within a string,
a sign. One file is compiled and linked with the objects of an ordinary build (no other file sees
its inside). A mutant whose machine code is that of the original is no mutant. It dies if the unit
tests fail, crash or take more than ten times as long; what survives them meets what users run:
the main job, check, errata, stress and .ci/try_commands.sh. Survivors are printed with their
change: each is either a hole in the tests or the same program in other words, which a person
decides. Not part of the gate: a hundred mutants take about half an hour on one core.
"""
import argparse
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

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
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d+(?:e-?\d+)?_dp|\d+(?!\.\d)(?:_i8)?)(?![\w.])")
DECLARATION = re.compile(r"^\s*(use|import|implicit|public|private|end|module|submodule|contains|type|class|real|integer|"
                         r"logical|character|procedure|abstract|interface|pure|elemental|subroutine|function|"
                         r"generic|!|else\s*$|associate|block|do\s*$|return\s*$|select|case default)", re.I)


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
    constant = "parameter ::" in line
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
        if re.match(r"(call |if \(.*\) (return|cycle|exit|call|[a-z_%()0-9:]+ =)|[a-z_][\w%()+\-*/:, ]* = )", statement):
            found.append(("deletion", ""))
        block = re.match(r"(\s*)if \((.*)\) then\s*$", line)
        if block:
            found.append(("condition", f"{block.group(1)}if (.not. ({block.group(2)})) then\n"))
    return found


def run(command, seconds, cwd, env=None):
    """Exit status and output; a status of None is a time-out."""
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              timeout=seconds, cwd=cwd, env=env, errors="replace", text=True)
        return done.returncode, done.stdout
    except subprocess.TimeoutExpired:
        return None, ""


class Build:
    """The objects of an ordinary build, and how to link them with one of them exchanged."""

    def __init__(self, root, work):
        self.root, self.work = root, work
        status, text = run(["fpm", "build", "--tests", "--flag", FLAGS], 3600, root)
        if status != 0:
            sys.exit(text[-3000:])
        newest = max((path for path in self.glob("build", "unit")), key=os.path.getmtime)
        self.unit = newest
        self.program = max((path for path in self.glob("build", "lagrangia") if "/app/" in path),
                           key=os.path.getmtime)
        self.library = max(self.glob("build", "liblagrangia.a"), key=os.path.getmtime)
        objects = os.path.dirname(max((p for p in self.glob("build", "app_main.f90.o")), key=os.path.getmtime))
        self.objects = objects
        self.tests = [os.path.join(objects, name) for name in os.listdir(objects)
                      if name.startswith("test_") and name.endswith(".o")]

    def glob(self, top, name):
        for folder, _, files in os.walk(os.path.join(self.root, top)):
            for file in files:
                if file == name:
                    yield os.path.join(folder, file)

    def compile(self, source, text):
        """The object of `text` in the place of `source`, or None if it does not compile."""
        path = os.path.join(self.work, os.path.basename(source))
        with open(path, "w") as file:
            file.write(text)
        modules = os.path.dirname(self.objects)
        target = os.path.join(self.work, "mutant.o")
        status, _ = run(["gfortran", "-c", path, *FLAGS.split(), "-fimplicit-none", "-ffree-form", "-J", self.work,
                         "-I" + modules, "-o", target], 300, self.root)
        return target if status == 0 else None

    def link(self, target, unit, program):
        libraries = [self.library, "-llapack", "-lblas", "-lgsl", "-lgslcblas"]
        for output, objects in ((unit, self.tests), (program, [os.path.join(self.objects, "app_main.f90.o")])):
            status, text = run(["gfortran", *objects, target, *libraries, "-o", output], 300, self.root)
            if status != 0:
                return text
        return ""


def machine_code(path):
    status, text = run(["objdump", "-d", "-s", "-j", ".text", "-j", ".rodata", "-j", ".rodata.str1.1", "-j",
                        ".rodata.str1.8", "-j", ".rodata.cst8", "-j", ".rodata.cst16", path], 60, "/")
    return re.sub(r"^.*file format.*$", "", text, flags=re.M)


def noticed_by_users(program, root, work):
    """The first of the things that users run which does not end well; "" if all do."""
    for command in ([program, "--output", os.path.join(work, "data")], [program, "check"], [program, "errata"],
                    [program, "stress", "--quiet"], ["bash", ".ci/try_commands.sh", program]):
        status, _ = run(command, 600, root)
        if status != 0:
            return " ".join(command[-2:]).replace(program, "").strip() or "the main job"
    return ""


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--count", type=int, default=100)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--only", default="src")
    words.add_argument("--output", default="mutants.jsonl")
    words = words.parse_args()
    root = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
    work = tempfile.mkdtemp()
    draw = random.Random(words.seed)
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    build = Build(root, work)
    start = time.time()
    status, text = run([build.unit], 3600, root)
    if status != 0:
        sys.exit("the tests fail without any mutant:\n" + text[-2000:])
    patience = 10*(time.time() - start) + 20
    text = noticed_by_users(build.program, root, work)
    if text:
        sys.exit("without any mutant this fails: " + text)
    sites = []
    for folder, _, files in os.walk(os.path.join(root, words.only)):
        for name in sorted(files):
            if not name.endswith(".f90"):
                continue
            source = os.path.relpath(os.path.join(folder, name), root)
            lines = open(os.path.join(root, source)).readlines()
            for k, line in enumerate(lines):
                for kind, new in changes_of(line, lines[k - 1] if k else ""):
                    if new != line:
                        sites.append((source, k, kind, new))
    sites.sort()
    # every kind of change has the same chance, whatever their numbers
    kinds = sorted({site[2] for site in sites})
    by_kind = {kind: [site for site in sites if site[2] == kind] for kind in kinds}
    tally = {"died": 0, "died in use": 0, "survived": 0}
    with open(words.output, "a") as log:
        done = 0
        while done < words.count:
            source, k, kind, new = draw.choice(by_kind[draw.choice(kinds)])
            lines = open(os.path.join(root, source)).readlines()
            old = lines[k]
            original = build.compile(source, "".join(lines))
            before = machine_code(original)
            lines[k] = new if new else "\n"
            target = build.compile(source, "".join(lines))
            if target is None or machine_code(target) == before:
                continue
            done += 1
            unit, program = os.path.join(work, "unit"), os.path.join(work, "lagrangia")
            fate, by = "survived", ""
            if build.link(target, unit, program):
                fate, by = "died", "link"
            else:
                status, text = run([unit], patience, root)
                if status != 0:
                    fate, by = "died", "time-out" if status is None else "unit tests"
                else:
                    by = noticed_by_users(program, root, work)
                    if by:
                        fate = "died in use"
            tally[fate] += 1
            row = {"seed": words.seed, "file": source, "line": k + 1, "kind": kind, "old": old.strip(),
                   "new": new.strip(), "fate": fate, "by": by}
            log.write(json.dumps(row) + "\n")
            log.flush()
            print(f"{fate:12} {source}:{k + 1} {kind}: {old.strip()}  ->  {new.strip() or '(deleted)'}  {by}", flush=True)
    shutil.rmtree(work)
    print(", ".join(f"{n} {fate}" for fate, n in tally.items()))


if __name__ == "__main__":
    main()
