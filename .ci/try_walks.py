#!/usr/bin/env python3
"""try_walks.py PAGE [--accept]: the commands and the Python of a page print what the page says.

A ```console block is `$ command` and what it prints; a ```python block is followed by an ```output block.
Pieces of Python share one interpreter. Times are not compared, nor digits that are only rounding. With
--accept the page gets what was printed. Of a scorecard or a scene in a plain block each line is printed. A notebook's cells are run the same way, its outputs compared."""
import contextlib
import io
import json
import re
import subprocess
import sys


def plain(text):
    text = re.sub(r" \d+\.\d{4} s$", " TIME", text, flags=re.M)
    text = re.sub(r" in \S+ s by \d+ process(es)?$", " in TIME", text, flags=re.M)
    return [re.sub(r"\d(\.\d+)?[Ee]-(0?9|1\d)", "~", line).rstrip() for line in text.splitlines()]


def shell(command):
    done = subprocess.run(["bash", "-c", command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return "".join(line.rstrip() + "\n" for line in done.stdout.splitlines())


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
    result = re.sub(r"```console\n(.*?)```|```python\n(.*?)```\n```output\n(.*?)```", piece, text, flags=re.S)
if accept:
    open(page, "w").write(result)
print(f"{page}: {count} pieces, {0 if accept else bad} differ")
sys.exit((bad > 0 and not accept) or count < 3)
