#!/usr/bin/env python3
"""What `lagrangia grade` says of each line of .ci/graded_lines.txt, `SYSTEM: LINE ;; LINE...`, as a sheet of its own.

    .ci/graded_sheets.py PROGRAM

Many sheets are graded by one process, those that are refused by one each.
"""
import os
import re
import subprocess
import sys
import tempfile

AT_ONCE = 500
program = os.path.realpath(sys.argv[1])
with open(os.path.join(os.path.dirname(__file__), "graded_lines.txt"), encoding="utf-8") as file:
    lines = file.read().splitlines()
answers = {}
with tempfile.TemporaryDirectory() as folder:
    names = [f"{number:05}.txt" for number in range(len(lines))]
    for name, line in zip(names, lines):
        system, statements = line.split(": ", 1)
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(f"system: {system}\n" + statements.replace(" ;; ", "\n") + "\n")
    first, last = 0, AT_ONCE
    while first < len(lines):
        run = subprocess.run([program, "grade", *names[first:last]], cwd=folder, capture_output=True, timeout=600,
                             stdin=subprocess.DEVNULL, encoding="utf-8", errors="surrogateescape")
        if run.returncode < 0:
            sys.exit(f"{program} ended by signal {-run.returncode}")
        refused = re.match(r"lagrangia: (\d{5})\.txt:(.*)", run.stderr)
        if refused and int(refused.group(1)) > first:  # those before it alone
            last = int(refused.group(1))
            continue
        begun = None
        for row in run.stdout.splitlines():
            header = re.match(r"(\d{5}\.txt): \d+ statements? about ", row)
            begun = header.group(1) if header else begun
            if header:
                answers[begun] = []
            elif row:
                answers[begun].append(row)
        if refused:
            answers[names[first]] = ["refused:" + refused.group(2)]
            last = first + 1
        first, last = last, last + AT_ONCE
for name, line in zip(names, lines):
    print(line)
    print("".join(f"    {row}\n" for row in answers.get(name, ["no answer"])), end="")
