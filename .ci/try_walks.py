#!/usr/bin/env python3
"""try_walks.py PAGE [--accept]: the commands and the Python of a page print what the page says.

A ```console block is `$ command` and what it prints; a ```python block is followed by an ```output block.
A line `    lagrangia ...` or `    fpm run --profile release -- ...` in a plain block is run, ends with status 0
(`grade` with 1), and the file that stands behind its # is then there. Pieces of Python share one interpreter. Times are not compared, nor digits that are only rounding. With
--accept the page gets what was printed. Of a scorecard or a scene in a plain block each line is printed; docs/stress.md has the tables of one run. A notebook's cells are run the same way, its outputs compared."""
import contextlib
import io
import json
import os
import re
import subprocess
import sys


def plain(text):
    text = re.sub(r" \d+\.\d{4} s$", " TIME", text, flags=re.M)
    text = re.sub(r" in \S+ s by \d+ process(es)?", " in TIME", text, flags=re.M)
    return [re.sub(r"\d(\.\d+)?[Ee]-(0?9|1\d)", "~", line).rstrip() for line in text.splitlines()]


def shell(command):
    done = subprocess.run(["bash", "-c", command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    slow = re.compile("^lagrangia: .* takes about ")  # said where the machine is busy
    return "".join(line.rstrip() + "\n" for line in done.stdout.splitlines() if not slow.match(line))


def python(code):
    caught = io.StringIO()
    with contextlib.redirect_stdout(caught):
        exec(compile(code, "page", "exec"), names)  # the page's own code
    return caught.getvalue()


def compare(what, expected, got):
    global count, bad
    count += 1
    if plain(expected) != plain(got):
        bad += 1
        print(f"{what}\n--- documented\n{expected}--- printed\n{got}")


def console(block):
    text = ""
    for command, expected in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", block[1], re.M):
        got = shell(command)
        compare("$ " + command, expected, got)
        text += f"$ {command}\n{got}"
    return f"```console\n{text}```"


def piece(block):
    if block[0].startswith("```console"):
        return console(re.match(r"```console\n(.*?)```", block[0], re.S))
    got = python(block[2])
    compare(block[2], block[3], got)
    return f"```python\n{block[2]}```\n```output\n{got}```"


def lines_of(command, block):
    """A page shows some lines of what a command prints, as they are printed: the others are left out."""
    printed = plain(shell(command))
    missing = "".join(line + "\n" for line in plain(block) if line not in printed)
    compare("some lines of $ " + command, "", missing)


def listed(command, remark):
    """A command that stands in a list: it ends well, and writes the file that its remark names."""
    done = subprocess.run(["bash", "-c", command], text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    file = re.match(r"data/output/\S+\w", remark)
    expected = (1 if " grade " in command else 0, bool(file))
    got = (done.returncode, bool(file) and os.path.exists(file[0]))
    compare(command, f"status, file: {expected}", f"status, file: {got}" + (done.stdout if got != expected else ""))


def stress_rows(text):
    """The tables of docs/stress.md are those of one run: a section a row, in the order of the rows."""
    section = re.compile(r"^## `(\w+)`: (.*)\n\n(.*)\n\n((?:    .*\n)+)", re.M)
    printed = re.split(r"\n\n", shell("lagrangia stress"))
    tables = {table.split(":")[0]: table.rstrip("\n") + "\n" for table in printed[1:-1]}
    compare("rows of $ lagrangia stress", "\n".join(m[1] for m in section.finditer(text)), "\n".join(tables))
    said = re.search(r"all rows: (\d+) lines", text)
    compare("lines of $ lagrangia stress", f"{said and said[1]} lines, 0 do not hold", printed[-1])

    def row(m):
        expected = f"{m[1]}: {m[2]}\n  {m[3]}\n" + re.sub("^  ", "", m[4], flags=re.M)
        got = tables.get(m[1], "")
        compare(f"$ lagrangia stress {m[1]}", rounded(expected), rounded(got))
        lines = got.splitlines()
        if len(lines) < 3:
            return m[0]
        head = lines[0].split(": ", 1)[1]
        return f"## `{m[1]}`: {head}\n\n{lines[1].strip()}\n\n" + "".join("  " + line + "\n" for line in lines[2:])
    return section.sub(row, text)


def rounded(table):
    """Without values that are rounding, which stand before the bound, and digits that hang on those."""
    table = re.sub(r" +\S+(  (?:<= \S+|= \S+) +holds)", lambda m: " ~" + m[1] if rounding(m[0], m[1]) else m[0], table)
    table = re.sub(r" +\S+(  <= \S+ +holds .*: rounding$)", r" ~\1", table, flags=re.M)  # a slope of rounding
    table = re.sub(r"(<= \S+)e-(\d+)", r"\1(-\2)", table)  # bounds stay
    table = re.sub(r"(last digits) +\S+", r"\1 ~", table)
    table = re.sub(r"^(  Lyapunov's exponent .*1/s) +\S+ (.*)\+- .*(, from .*), .*;", r"\1 ~ \2 +- ~\3, ~;", table, flags=re.M)
    table = re.sub(r"(sqrt N|bounded|linear): \S+e-1\d after", r"\1: ~ after", table)
    return re.sub(r" +", " ", table)


def rounding(cell, bound):
    value, most = float(cell[:len(cell) - len(bound)]), float(re.search(r"= (\S+)", bound)[1])
    return value < 1e-7 or most < 1e-7


page, accept = sys.argv[1], "--accept" in sys.argv
names, count, bad = {}, 0, 0
if page.endswith(".ipynb"):
    notebook = json.load(open(page))
    for cell in notebook["cells"]:
        if cell["cell_type"] != "code":
            continue
        code = "".join(cell["source"])
        commands = "\n".join(line[1:] for line in code.splitlines() if line.startswith("!"))
        got = shell(commands) if commands else ""
        got += python("\n".join(line for line in code.splitlines() if line[:1] not in "!%"))
        expected = "".join("".join(o.get("text", [])) for o in cell["outputs"])
        compare(code, expected, got)
        cell["outputs"] = [{"name": "stdout", "output_type": "stream", "text": got.splitlines(True)}] if got else []
    result = json.dumps(notebook, indent=1) + "\n"
else:
    text = open(page).read()
    for block in re.findall(r"^```\n(scene  .*?)```", text, re.M | re.S):
        lines_of("lagrangia", block)
    for block in re.findall(r"^```fortran\n((?:!.*\n)?&scene.*?)```", text, re.M | re.S):
        lines_of("lagrangia show cart_pendulum", block)
    for command, remark in re.findall(r"^    (?:fpm run --profile release --|lagrangia) (.*?)(?: +# (.*))?$", text, re.M):
        if not page.endswith("stress.md"):
            listed("lagrangia " + command, remark)
    if page.endswith("stress.md"):
        text = stress_rows(text)
    result = re.sub(r"```console\n(.*?)```|```python\n(.*?)```\n```output\n(.*?)```", piece, text, flags=re.S)
if accept:
    open(page, "w").write(result)
print(f"{page}: {count} pieces, {0 if accept else bad} differ")
sys.exit((bad > 0 and not accept) or count < 3)
