#!/usr/bin/env python3
"""Which operands never make a difference, whatever the tests try: holes for mutants, without drawing any.

    .ci/mutants/operands.py --instrument [--mods FOLDER]   in a clone, built from nothing: rewrite its sources
    fpm build --tests --flag "-O1 -ffree-line-length-none"
    OPERANDS_FILE=$PWD/seen UNIT_TESTS; OPERANDS_FILE=$PWD/seen .ci/try_pages.sh PROGRAM
    .ci/mutants/operands.py --report seen [src/grading]    the places that nothing distinguishes

Every abs, min, max, any, all, maxval, minval, .and., .or. and comparison of one line notes what it was
given: an abs that never has a negative argument, an any that is always all, operands of .and. that
are always alike, a comparison that is always true or always false. A mutant there survives for
certain; a place that is not listed may still be a hole, since a difference may change no answer.
Each is a hole, dead code, or a guard against what no test brings about: a person decides.
"""
import argparse
import importlib.util
import json
import os
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.abspath(os.path.join(HERE, "..", ".."))
spec = importlib.util.spec_from_file_location("mutate", os.path.join(HERE, "mutate.py"))
mutate = importlib.util.module_from_spec(spec)
spec.loader.exec_module(mutate)

PLACES = os.path.join(ROOT, "build", "operands.json")
ROOM = 1 << 18  # places, a byte each
KINDS = {"d": "real(dp)", "q": "real(qp)", "i": "integer", "l": "integer(i8)"}
PAIRS = ("dd", "qq", "ii", "ll", "il", "li", "di", "id")
FUNCTIONS = ("abs", "min", "max", "any", "all", "maxval", "minval")
COMPARISONS = {" <= ": "le", " >= ": "ge", " < ": "lt", " > ": "gt", " == ": "eq", " /= ": "ne"}
LOGICAL = {" .and. ": "and", " .or. ": "or"}
NOTE = r"""
#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>
int w_note(int place, int bits) {
    static unsigned char *seen;
    if (!seen) {
        const char *name = getenv("OPERANDS_FILE");
        int file = name ? open(name, O_RDWR | O_CREAT, 0666) : -1;
        if (file >= 0 && ftruncate(file, ROOM) == 0)
            seen = mmap(0, ROOM, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        if (!seen || seen == MAP_FAILED) seen = malloc(ROOM);
        if (file >= 0) close(file);
    }
    seen[place] |= bits;
    return 0;
}
""".replace("ROOM", str(ROOM))


def specific(prefix, name, arguments, result, value, bits, other):
    """One function that notes `bits` at its place; the note is always 0, which no compiler knows."""
    return (f"{prefix} function {name}(place, {', '.join(a for a, _ in arguments)}) result(r)\ninteger, intent(in) :: place\n"
            + "".join(f"{kind}, intent(in) :: {a}\n" for a, kind in arguments)
            + f"{result} :: r\nr = {value}\nif (w_note(place, {bits}) /= 0) r = {other}\nend function")


def module_text():
    """The module of the functions that take the place of intrinsic ones and of operators."""
    generics, bodies = {}, []

    def add(generic, name, *rest):
        generics.setdefault(generic, []).append(name)
        bodies.append(specific(rest[0], name, *rest[1:]))

    for k, kind in KINDS.items():
        add("wabs", f"wabs_{k}", "elemental", [("x", kind)], kind, "abs(x)", "merge(2, 1, x < 0)", "-r")
        for f in ("min", "max"):
            for n in (2, 3, 4):
                names = "abcd"[:n]
                both = ", ".join(names)
                add("w" + f, f"w{f}_{k}{n}", "elemental", [(a, kind) for a in names], kind, f"{f}({both})",
                    f"merge(2, 1, abs(min({both}) - max({both})) > 0)", "-r")
        for f in ("maxval", "minval"):
            for rank in (1, 2, 3):
                shape = ", dimension(" + ",".join(":"*rank) + ")"
                add("w" + f, f"w{f}_{k}{rank}", "pure", [("x", kind + shape)], kind, f"{f}(x)",
                    "merge(2, 1, maxval(x) > minval(x))", "-r")
    for f in ("any", "all"):
        for rank in (1, 2, 3):
            add("w" + f, f"w{f}_{rank}", "pure", [("x", "logical, dimension(" + ",".join(":"*rank) + ")")], "logical",
                f"{f}(x)", "merge(2, 1, any(x) .neqv. all(x))", ".not. r")
    for sign, f in COMPARISONS.items():
        bits = "merge(2, 0, x == y) + merge(4, 0, x < y) + merge(8, 0, x > y) + 1"
        for a, b in PAIRS:
            add("w" + f, f"w{f}_{a}{b}", "elemental", [("x", KINDS[a]), ("y", KINDS[b])], "logical", f"x{sign}y", bits, ".not. r")
        add("w" + f, f"w{f}_c", "elemental", [("x", "character(*)"), ("y", "character(*)")], "logical", f"x{sign}y", bits, ".not. r")
    for sign, f in LOGICAL.items():
        add("w" + f, f"w{f}_1", "elemental", [("x", "logical"), ("y", "logical")], "logical", f"x{sign}y",
            "merge(2, 1, x .neqv. y)", ".not. r")
    head = ["module lagrangia_operands", "use, intrinsic :: iso_c_binding, only: c_int", "implicit none (type, external)", "private",
            "integer, parameter :: dp = kind(1d0), qp = selected_real_kind(30), i8 = selected_int_kind(18)", "interface",
            "pure function w_note(place, bits) bind(c) result(r)", "import c_int", "integer(c_int), value :: place, bits",
            "integer(c_int) :: r", "end function", "end interface"]
    for name, members in generics.items():
        head += [f"interface {name}", "module procedure " + ", ".join(members), "end interface"]
    return "\n".join([*head, "public :: " + ", ".join(generics), "contains", *bodies, "end module lagrangia_operands", ""])


def code_of(line):
    """The line with its strings and comment blotted out, letter by letter."""
    text = [" "]*len(line)
    for a, b, is_string in mutate.split_code(line):
        text[a:b] = "~"*(b - a) if is_string else line[a:b]
    return "".join(text)


def left_end(text, at, logical):
    """Where the operand begins that ends at `at`."""
    depth = 0
    while at > 0:
        letter = text[at - 1]
        if letter == ")":
            depth += 1
        elif letter == "(":
            if depth == 0:
                break
            depth -= 1
        elif depth == 0:
            if letter in ",[;" or (letter == "=" and text[at - 2:at - 1] not in tuple("=/<>")):
                break
            word = re.search(r"\.(and|or|eqv|neqv|not)\.$", text[:at])
            if word and (word.group(1) != "not" or not logical):
                break
        at -= 1
    return at + len(text[at:]) - len(text[at:].lstrip(" "))


def right_end(text, at):
    """Where the operand ends that begins at `at`; None if it goes on in the next line."""
    depth = 0
    start = at
    while at < len(text):
        letter = text[at]
        if letter == "(":
            depth += 1
        elif letter == ")":
            if depth == 0:
                break
            depth -= 1
        elif depth == 0 and (letter in ",&;]" or re.match(r"\.(and|or|eqv|neqv)\.", text[at:])):
            break
        at += 1
    if depth or text[at:at + 1] == "&":
        return None
    return start + len(text[start:at].rstrip())


def instrumented_line(line, before, source, number, places):
    """The line with functions that note their operands."""
    def place(name):
        places.append((source, number, name))
        return len(places) - 1

    for name in FUNCTIONS:
        for found in list(re.finditer(r"(?<![\w%])" + name + r"\(", code_of(line)))[::-1]:
            line = line[:found.start()] + f"w{name}({place(name)}, " + line[found.end():]
    for signs, logical in ((COMPARISONS, False), (LOGICAL, True)):
        for sign, name in signs.items():
            start = 0
            while (at := code_of(line).find(sign, start)) >= 0:
                text = code_of(line)
                a, b = left_end(text, at, logical), right_end(text, at + len(sign))
                cut = a == len(line) - len(line.lstrip()) and before.rstrip().endswith("&") and \
                    not re.search(r"(\.and\.|\.or\.|[(,\[=]) *&$", before.rstrip())
                start = at + len(sign)
                if cut or b is None or a >= at or b <= start or text[a] == "&":
                    continue
                line = line[:a] + f"w{name}({place(name)}, {line[a:at]}, {line[start:b]})" + line[b:]
                start = 0
    return line


def instrumented(lines, source, left_alone, places):
    """The lines of a file: (number of the original or 0, text)."""
    result, interface = [], False
    for k, line in enumerate(lines):
        interface = bool(re.match(r"\s*(abstract )?interface\b", line)) or (interface and not re.match(r"\s*end interface", line))
        plain = ("::" in code_of(line) and not re.match(r"\s*(allocate|associate)", line)) or interface or k in left_alone or \
            (mutate.DECLARATION.match(line) and not re.match(r"\s*(else if|select)", line)) or \
            re.match(r"\s*(where|elsewhere|forall|do concurrent|#)", line)
        result.append((k, line if plain else instrumented_line(line, lines[k - 1] if k else "", source, k + 1, places)))
        if re.match(r"\s*(module (?!procedure|function|subroutine)\w+|submodule \(.*\) \w+)\s*(!.*)?$", line):
            result.append((k, "use lagrangia_operands"))
    return result


def instrument(mods):
    """Rewrite every source; a line that then does not compile stays as it is."""
    work = tempfile.mkdtemp()
    own = os.path.join(ROOT, "src", "operands.f90")
    with open(own, "w") as file:
        file.write(module_text())
    with open(os.path.join(ROOT, "src", "operands_note.c"), "w") as file:
        file.write(NOTE)
    flags = ["gfortran", "-cpp", "-DLAGRANGIA_NATIVE", "-fopenmp", "-fcoarray=single", "-ffree-line-length-none"]
    subprocess.run([*flags, "-J" + work, "-c", own, "-o", os.path.join(work, "own.o")], check=True)
    places = []
    for folder, _, names in os.walk(os.path.join(ROOT, "src")):
        for name in sorted(names):
            if not name.endswith(".f90") or name in ("operands.f90", "shipped.f90"):
                continue
            path = os.path.join(folder, name)
            lines = open(path).read().split("\n")
            left_alone = set()
            while True:
                first = len(places)
                rewritten = instrumented(lines, os.path.relpath(path, ROOT), left_alone, places)
                trial = os.path.join(work, name)
                with open(trial, "w") as file:
                    file.write("\n".join(text for _, text in rewritten))
                with tempfile.TemporaryDirectory() as unread:  # else its modules would be taken for the build's
                    run = subprocess.run([*flags, "-fsyntax-only", "-J" + unread, "-I" + mods, "-I" + work, trial],
                                         capture_output=True, text=True)
                if run.returncode == 0:
                    break
                bad = {rewritten[int(n) - 1][0] for n in re.findall(r"\.f90:(\d+):\d+:", run.stderr)}
                bad = bad - left_alone or {k + d for k in bad for d in (-1, 1)} - left_alone
                if not bad:
                    sys.exit(run.stderr)
                del places[first:]
                left_alone |= bad
            os.replace(trial, path)
    os.makedirs(os.path.dirname(PLACES), exist_ok=True)
    with open(PLACES, "w") as file:
        json.dump(places, file)
    print(f"{len(places)} places note their operands")


def state(name, bits):
    """What is never seen at a place, or ""."""
    if bits == 0:
        return "never reached"
    if name in FUNCTIONS or name in LOGICAL.values():
        return "" if bits & 2 else "never a difference"
    less, equal, more = bits & 4, bits & 2, bits & 8
    true = {"lt": less, "le": less or equal, "gt": more, "ge": more or equal, "eq": equal, "ne": less or more}[name]
    false = {"lt": more or equal, "le": more, "gt": less or equal, "ge": less, "eq": less or more, "ne": equal}[name]
    return "" if true and false else "always true" if true else "always false"


def report(seen, begins):
    """The places at which nothing makes a difference, and how many there are."""
    bits = open(seen, "rb").read()
    places = json.load(open(PLACES))
    listed = 0
    for k, (source, line, name) in enumerate(places):
        what = state(name, bits[k])
        if what and source.startswith(begins):
            listed += 1
            print(f"{source}:{line} {name}: {what}")
    print(f"{listed} of {sum(source.startswith(begins) for source, _, _ in places)} places")


if __name__ == "__main__":
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--instrument", action="store_true")
    words.add_argument("--mods", default="", metavar="FOLDER", help="of the build's .mod files; the newest, if not given")
    words.add_argument("--report", metavar="SEEN")
    words.add_argument("begins", nargs="?", default="src")
    words = words.parse_args()
    if words.instrument:
        found = [place for place, _, names in os.walk(os.path.join(ROOT, "build")) if "lagrangia_kinds.mod" in names]
        if not (words.mods or found):
            sys.exit("operands.py: nothing is built here: fpm build --tests")
        instrument(words.mods or max(found, key=os.path.getmtime))
    elif words.report:
        report(words.report, words.begins)
    else:
        sys.exit("operands.py: --instrument or --report SEEN")
