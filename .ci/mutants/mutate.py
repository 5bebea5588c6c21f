#!/usr/bin/env python3
"""Change one random place of the sources at a time, and see whether anything notices.

    .ci/mutants/mutate.py [--count 100] [--seed 1] [--only src/runs,src/pages] [--skip TEXT]
                          [--output mutants.jsonl] [--quick] [--gate] [--again mutants.jsonl]

Run it, by nice, in a checkout of its own whose tests pass. Each mutant is one change of one statement in
src: an operator, a number, an intrinsic function, a condition, a deleted statement or, within a
string, a sign. Each kind of change has the same chance, and a line of src/audit, src/principles,
src/scenes, src/runs, src/commands, src/bench and src/stress twice that of another. One file is compiled, and
those that see a change of its interface (a named constant, what a component begins with), and linked
with the other objects of an ordinary build. A mutant whose object file is the original's is no mutant.

It dies if a suite of the unit tests fails, crashes or uses ten times the processor's time: first those
that use the module, then all from which it can be reached, the quickest first. What survives them
meets what users run: the main job, .ci/try_pages.sh and .ci/try_commands.sh, and .ci/try_shells.sh
or .ci/try_terminals.py where the change is in what completion and manual page are made of, or lines on a terminal. Survivors are
printed with their change: each is either a hole in the tests or the same program in other words,
which a person decides. `--again` tries the survivors of an earlier list once more, and `--gate` shows them
to all else that .ci/run does with a program, too: ten minutes for each that survives. Not part of the gate:
most mutants take seconds, a survivor as long as all that looks at it.

Before the first mutant all this is tried without any: what fails there would "kill" every mutant, so
the first failure is printed and nothing is begun. `--quick` leaves out what users run, there and later.
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
import time
import tomllib

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
OF_SHELLS = tuple(f"src/commands/{name}.f90" for name in ("completion", "manual", "registry", "vocabulary",
                                                           "command_pages"))  # what try_shells.sh looks at
OF_TERMINALS = ("src/posix/console.f90",)  # what try_terminals.py looks at
OF_GATE = ("try_help.py", "try_latex.py", "try_progress.py", "attack.sh", "attack_names.sh", "attack_parts.py",
           "attack_signals.sh", "attack_environment.sh", "attack_changes.py")  # what --gate adds
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


class Sources:
    """Who uses whom: modules, their submodules, and the suites of the tests."""

    def __init__(self, root):
        self.defined, self.uses, self.submodules, self.suites = {}, {}, {}, {}
        for folder in ("src", "test", "app"):
            for place, _, names in os.walk(os.path.join(root, folder)):
                for name in names:
                    if name.endswith((".f90", ".F90")) and "pfunit" not in place:
                        self.read(root, os.path.relpath(os.path.join(place, name), root))
        for path in self.uses:
            self.uses[path] = {name for name in self.uses[path] if self.defined.get(name, path) != path}

    def read(self, root, path):
        text = open(os.path.join(root, path)).read()
        for name in re.findall(r"^\s*module (\w+)\s*$", text, re.M):
            self.defined[name] = path
        self.uses[path] = set(re.findall(r"^\s*use(?:\s*,[^:]*::)?\s+(\w+)", text, re.M))
        for parent in re.findall(r"^\s*submodule \((\w+)", text, re.M):
            self.uses[path].add(parent)
            self.submodules.setdefault(parent, []).append(path)
        suite = re.search(r'TestSuite\("([^"]*)"\)', text)
        if suite and path.startswith("test/test_"):
            self.suites[suite.group(1)] = path

    def reached(self, path):
        """All files that a call from `path` can lead to."""
        found, todo = set(), [path]
        while todo:
            path = todo.pop()
            if path in found:
                continue
            found.add(path)
            for name in self.uses[path]:
                todo += [self.defined[name], *self.submodules.get(name, [])]
        return found

    def in_order(self):
        """All files, users behind what they use."""
        done = []

        def add(path):
            if path in done:
                return
            for name in self.uses[path]:
                add(self.defined[name])
            done.append(path)
        for path in sorted(self.uses):
            add(path)
        return done


class Build:
    """The objects of an ordinary build, and how to link them with some of them exchanged."""

    def __init__(self, root, work):
        self.root, self.work = root, work
        status, text = run(["fpm", "build", "--tests", "--flag", FLAGS], root, GENEROUS)
        if status != 0:
            sys.exit(text[-3000:])
        self.objects = os.path.dirname(self.newest("app_main.f90.o"))
        self.library = self.newest("liblagrangia.a")
        if any(os.path.getmtime(place.path) > os.path.getmtime(self.library) for place in os.scandir(self.objects)
               if place.name.startswith("src_") and place.name.endswith(".o")):
            sys.exit(f"mutate.py: {self.library} is older than its objects: a build was interrupted; delete it")
        manifest = tomllib.load(open(os.path.join(root, "fpm.toml"), "rb"))
        self.libraries = ["-l" + name for name in manifest["build"]["link"]]
        macros = manifest["preprocess"]["cpp"]["macros"]
        self.flags = subprocess.check_output(["sh", "-c", "echo " + " ".join("-D" + m for m in macros)], text=True).split()
        self.sources = Sources(root)
        self.order = self.sources.in_order()
        self.originals = {}

    def newest(self, name):
        found = []
        for folder, _, files in os.walk(os.path.join(self.root, "build")):
            if name in files:
                found.append(os.path.join(folder, name))
        return max(found, key=os.path.getmtime)

    def compile(self, path, source, folder):
        """The object of the file `path` in the place of `source`, and the modules that others see of
        it, in bytes; both None if it does not compile."""
        target, seen = os.path.join(folder, source.replace("/", "_") + ".o"), {}
        fresh = os.path.join(folder, "fresh")
        os.makedirs(fresh, exist_ok=True)
        status, _ = run(["gfortran", "-c", path, *FLAGS.split(), *self.flags, "-cpp", "-fimplicit-none", "-ffree-form",
                         "-J", fresh, "-I", folder, "-I" + os.path.dirname(self.objects), "-o", target],
                        self.root, GENEROUS)
        if status != 0:
            return None, None
        for name in os.listdir(fresh):
            text = gzip.open(os.path.join(fresh, name)).read()
            seen[name] = text[text.index(b"\n"):]  # its first line names the file
            shutil.move(os.path.join(fresh, name), os.path.join(folder, name))
        return target, seen

    def original(self, source):
        """The object of a source as it stands, in bytes, and the modules that others see of it."""
        if source not in self.originals:
            folder = tempfile.mkdtemp(dir=self.work)
            path = os.path.join(folder, os.path.basename(source))
            shutil.copy(os.path.join(self.root, source), path)
            target, seen = self.compile(path, source, folder)
            if not target:
                sys.exit("does not compile: " + source)
            self.originals[source] = open(target, "rb").read(), seen
            shutil.rmtree(folder)
        return self.originals[source]

    def mutant(self, source, text):
        """The objects that differ with `text` in the place of `source`, by source, in the folder
        `mutant`; None if there is no such mutant."""
        folder = os.path.join(self.work, "mutant")
        shutil.rmtree(folder, ignore_errors=True)
        os.mkdir(folder)
        path = os.path.join(folder, os.path.basename(source))
        with open(path, "w") as file:
            file.write(text)
        target, seen = self.compile(path, source, folder)
        code, known = self.original(source)
        if not target or (seen == known and open(target, "rb").read() == code):
            return None
        objects, changed = {source: target}, {name for name in seen if seen[name] != known.get(name)}
        for user in self.order if changed else []:
            needs = {f"{name}.{kind}" for name in self.sources.uses[user] for kind in ("mod", "smod")}
            if user == source or not any(name.split("@")[0] in needs for name in changed):
                continue
            objects[user], seen = self.compile(os.path.join(self.root, user), user, folder)
            if not objects[user]:
                return None
            known = self.original(user)[1]
            changed |= {name for name in seen if seen[name] != known.get(name)}
        return objects

    def link(self, name, objects):
        """A program, `unit` or `lagrangia`; None if it cannot be."""
        first = "test/" if name == "unit" else "app/"
        place = lambda source: os.path.join(self.objects, source.replace("/", "_") + ".o")
        own = {source: place(source) for source in self.sources.uses if source.startswith(first)}
        own.update({s: o for s, o in objects.items() if s.startswith((first, "src/"))})
        output = os.path.join(self.work, name)
        status, text = run(["gfortran", *own.values(), self.library, *self.libraries, "-o", output], self.root, GENEROUS)
        if status != 0 and not objects:
            sys.exit(text[-2000:])
        return output if status == 0 else None


def noticed_by_suite(unit, root, suite, limits):
    """The first test of a suite that fails, or how the suite ended; "" if all is well."""
    status, text = run([unit, "--filter", suite + "."], root, limits, stop_at="Failure in: ")
    if status == 0:
        return ""
    found = re.search(r"^(?:Failure|Error) in:? (.*)$", text, re.M)
    return found.group(1) if found else suite + (": time-out" if status in (-9, -24) else f": crash {status}")


def suite_times(unit, build):
    """Seconds of the processor that each suite takes; ends the program if one fails."""
    times = {}
    for suite in build.sources.suites:
        used = processor_time()
        refuse(noticed_by_suite(unit, build.root, suite, GENEROUS))
        times[suite] = processor_time() - used
    return times


def refuse(noticed, printed=""):
    """End the program if something is noticed where there is no mutant, with the end of what was printed."""
    if noticed:
        sys.exit(printed[-4000:] + f"mutate.py: nothing begun: without any mutant this fails: {noticed}")


def noticed_by_tests(unit, build, source, times):
    """The first test that fails, the suites that use the module of `source` first; "" if none does."""
    name = "lagrangia_" + os.path.basename(source)[:-4]
    near = lambda suite: name in build.sources.uses[build.sources.suites[suite]]
    reaching = [suite for suite, path in build.sources.suites.items() if source in build.sources.reached(path)]
    for suite in sorted(reaching, key=lambda suite: (not near(suite), times[suite])):
        noticed = noticed_by_suite(unit, build.root, suite, Limits(10*times[suite] + 5))
        if noticed:
            return noticed
    return ""


def noticed_by_users(program, root, work, limits, source, gate):
    """The first of the things that users run which does not end well, and all that it printed; with
    a Tab in shells or on terminals if `source` has to do with them, or is None. "" and "" if all do."""
    scripts, last = ["try_pages.sh"], ["try_commands.sh", *(OF_GATE if gate else ())]
    if source is None or source in OF_SHELLS:
        scripts.append("try_shells.sh")
    if source is None or source in OF_TERMINALS:
        scripts.append("try_terminals.py")
    for command in ([program, "--output", os.path.join(work, "data")],
                    *(["python3" if script.endswith(".py") else "bash", ".ci/" + script, program]
                      for script in [*scripts, *last]),
                    *([[program, "stress", "--quiet"]] if gate else [])):
        status, text = run(command, root, limits, stop_at="FAILED")
        if status != 0:
            claim = re.search(r"^FAILED +(.*)$", text, re.M)
            name = " ".join(command[1:2]) if command[1][0] != "-" else "the main job"
            return claim.group(1) if claim else name, text
    return "", ""


def sites_of(root, only, skip):
    """All changes of all lines: (file, line, kind, new line)."""
    sites = []
    for folder, _, files in os.walk(os.path.join(root, "src")):
        for name in sorted(files):
            source = os.path.relpath(os.path.join(folder, name), root)
            if not name.endswith(".f90") or (skip and skip in source):
                continue
            if not source.startswith(tuple(only.split(","))):
                continue
            lines = open(os.path.join(root, source)).readlines()
            for k, line in enumerate(lines):
                for kind, new in changes_of(line, lines[k - 1] if k else ""):
                    if new != line:
                        sites.append((source, k, kind, new))
    if not sites:
        sys.exit(f"no source begins with {only}; write --only src/runs,src/grading/judgement, say")
    return sorted(sites)


def drawn(root, words):
    """Mutants at random, without end: (file, line, kind, new line)."""
    draw = random.Random(words.seed)
    by_kind = {}
    for site in sites_of(root, words.only, words.skip):
        by_kind.setdefault(site[2], []).extend([site]*(2 if site[0].split("/")[1] in HEAVY else 1))
    while True:
        yield draw.choice(by_kind[draw.choice(sorted(by_kind))])


def survivors(root, path):
    """Those of an earlier list, wherever the line is now."""
    for row in map(json.loads, open(path)):
        lines = open(os.path.join(root, row["file"])).readlines()
        same = [k for k, line in enumerate(lines) if line.strip() == row["old"]]
        if row["fate"] != "survived":
            continue
        if not same:
            print(f"gone         {row['file']}:{row['line']} {row['old']}")
            continue
        k = min(same, key=lambda k: abs(k + 1 - row["line"]))
        yield row["file"], k, row["kind"], row["new"] + "\n" if row["new"] else ""


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--count", type=int, default=100)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--only", default="src")
    words.add_argument("--skip", default="")
    words.add_argument("--output", default="mutants.jsonl")
    words.add_argument("--quick", action="store_true", help="unit tests only, not what users run")
    words.add_argument("--gate", action="store_true", help="all that the gate does with a program, too")
    words.add_argument("--again", default="", metavar="LIST", help="the survivors of an earlier output")
    words = words.parse_args()
    root = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
    work = tempfile.mkdtemp()
    os.environ["TMPDIR"] = os.path.join(work, "tmp")
    os.mkdir(os.environ["TMPDIR"])
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    build = Build(root, work)
    times = suite_times(build.link("unit", {}), build)
    if not words.quick:
        used = processor_time()
        refuse(*noticed_by_users(build.link("lagrangia", {}), root, work, GENEROUS, None, words.gate))
        limits = Limits(10*(processor_time() - used))
    tally = {"died": 0, "died in use": 0, "survived": 0}
    none = 0  # drawn, and no mutant
    with open(words.output, "a") as log:
        for source, k, kind, new in survivors(root, words.again) if words.again else drawn(root, words):
            start = time.monotonic()
            lines = open(os.path.join(root, source)).readlines()
            old = lines[k]
            lines[k] = new if new else "\n"
            objects = build.mutant(source, "".join(lines))
            unit = objects and build.link("unit", objects)
            if not unit:
                none += 1
                continue
            by = noticed_by_tests(unit, build, source, times)
            fate = "died" if by else "survived"
            if not by and not words.quick:
                by, _ = noticed_by_users(build.link("lagrangia", objects), root, work, limits, source, words.gate)
                fate = "died in use" if by else "survived"
            tally[fate] += 1
            row = {"seed": words.seed, "file": source, "line": k + 1, "kind": kind, "old": old.strip(),
                   "new": new.strip(), "fate": fate, "by": by, "seconds": round(time.monotonic() - start)}
            log.write(json.dumps(row) + "\n")
            log.flush()
            print(f"{fate:12} {source}:{k + 1} {kind}: {old.strip()}  ->  {new.strip() or '(deleted)'}  [{by}, "
                  f"{row['seconds']} s]", flush=True)
            if sum(tally.values()) == words.count:
                break
    shutil.rmtree(work, ignore_errors=True)
    print(", ".join(f"{n} {fate}" for fate, n in tally.items()) + f", {none} drawn were no mutants")


if __name__ == "__main__":
    main()
