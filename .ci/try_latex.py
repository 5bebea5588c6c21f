#!/usr/bin/env python3
"""What `derive --latex` prints is read back.

Each formula of `derive --json` stands there twice, as the page has it and in LaTeX. Both are evaluated
by readers of their own, at the same random values, and must agree; and the document of `--latex` must
hold each of the LaTeX formulas. A slip is planted in each document to see that it would be found.

usage: try_latex.py PROGRAM
"""
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile

TOKEN = re.compile(r"\\(?:left|right)?[|()]|\\[A-Za-z]+|\d+\.?\d*(?:e[-+]?\d+)?|[A-Za-z][A-Za-z0-9_]*|\S")
FUNCTIONS = {"sin": math.sin, "cos": math.cos, "tan": math.tan, "exp": math.exp, "sqrt": math.sqrt,
             "log": math.log, "ln": math.log, "abs": abs, "atan": math.atan, "arctan": math.atan,
             "sinh": math.sinh, "cosh": math.cosh, "tanh": math.tanh,
             "sgn": lambda x: math.copysign(1.0, x)}
# names with an index in coordinates, parameters and headings; |x| and its derivative
INDEXED = """&scene system = 'indexed', title = 'y_1 & y_2', dt = 0.1, duration = 1.0, q = 0.3, 0.2, 0.1 /
&lagrangian coordinates = 'y_1 .. y_2', 'x_long_name', parameters = 'm_1', 'k_a', 'c'
  T = 'm_1/2 sum(i, 1, 2, y_i_dot^2) + m_1/2 x_long_name_dot^2', Q_y_1 = '-c sgn(y_1_dot)'
  V = 'k_a/2 |y_1|^3 + k_a/2 (|y_2 - 1| - y_2)^2' /
&indexed m_1 = 1.0, k_a = 2.0, c = 0.5 /
"""


class Reader:
    """Sums of products of powers; products without a sign. Values by name, drawn once."""

    def __init__(self, values):
        self.values = values

    def read(self, text):
        self.tokens = TOKEN.findall(text)
        self.place = 0
        value = self.sum()
        if self.place < len(self.tokens):
            raise ValueError(f"'{self.tokens[self.place]}' is left of {text}")
        return value

    def next(self):
        return self.tokens[self.place] if self.place < len(self.tokens) else ""

    def take(self, token):
        if self.next() != token:
            raise ValueError(f"'{token}' wanted, '{self.next()}' found: {' '.join(self.tokens)}")
        self.place += 1

    def value_of(self, name):
        """Between 0.5 and 1.5, of both signs in no root and no logarithm."""
        if name == "pi":
            return math.pi
        if name not in self.values:
            self.values[name] = random.uniform(0.5, 1.5)
        return self.values[name]

    def sum(self):
        sign = 1.0
        if self.next() == "-":
            self.place += 1
            sign = -1.0
        value = sign * self.product()
        while self.next() in ("+", "-"):
            sign = 1.0 if self.next() == "+" else -1.0
            self.place += 1
            value += sign * self.product()
        return value


class Page(Reader):
    """The grammar of the program's pages: `m/2 l^2 theta_dot^2 cos(D)`."""

    def product(self):
        value = self.power()
        while True:
            if self.next() == "/":
                self.place += 1
                value /= self.power()
            elif self.next() == "*":
                self.place += 1
                value *= self.power()
            elif self.next() and (self.next() == "(" or self.next()[0].isalnum()):
                value *= self.power()
            else:
                return value

    def power(self):
        name = self.next()
        if name in FUNCTIONS:
            self.place += 1
            exponent = 1.0
            if self.next() == "^":
                exponent = self.exponent()
            value = FUNCTIONS[name](self.bracket())
            value = value ** exponent
        elif name == "(":
            value = self.bracket()
        elif name[:1].isdigit():
            self.place += 1
            value = float(name)
        elif name[:1].isalpha():
            self.place += 1
            value = self.value_of(name)
        else:
            raise ValueError(f"'{name}' begins no factor: {' '.join(self.tokens)}")
        return value ** self.exponent() if self.next() == "^" else value

    def exponent(self):
        self.take("^")
        sign = 1.0
        if self.next() == "-":
            self.place += 1
            sign = -1.0
        if self.next() == "(":
            return sign * self.bracket()
        self.place += 1
        word = self.tokens[self.place - 1]
        return sign * (float(word) if word[0].isdigit() else self.value_of(word))

    def bracket(self):
        self.take("(")
        value = self.sum()
        self.take(")")
        return value


class Latex(Reader):
    r"""Math mode: `\\frac{m}{2} \\ell^{2} \\dot{\\theta}^{2} \\cos\\left(D\\right)`."""

    def read(self, text):
        # digits of an index belong to no name: \theta_{1} is a letter and an index
        self.tokens = re.findall(r"\\left\(|\\right\)|\\left\||\\right\||\\[A-Za-z]+|\d+\.?\d*|\S", text)
        self.place = 0
        value = self.sum()
        if self.place < len(self.tokens):
            raise ValueError(f"'{self.tokens[self.place]}' is left of {text}")
        return value

    def product(self):
        value = self.power()
        while self.next() and self.next() not in ("+", "-", "}", "\\right)", "\\right|", ","):
            if self.next() == "\\cdot":
                self.place += 1
            value *= self.power()
        return value

    def group(self):
        self.take("{")
        value = self.sum()
        self.take("}")
        return value

    def power(self):
        token = self.next()
        word = token[1:]
        if token == "\\frac":
            self.place += 1
            value = self.group()
            value /= self.group()
        elif token == "\\sqrt":
            self.place += 1
            value = math.sqrt(self.group())
        elif token == "\\left(":
            value = self.bracket("\\left(", "\\right)")
        elif token == "\\left|":
            value = abs(self.bracket("\\left|", "\\right|"))
        elif token == "\\operatorname":
            self.place += 1
            for part in "{sgn}":
                self.take(part)
            exponent = 1.0
            if self.next() == "^":
                self.place += 1
                exponent = self.group()
            return FUNCTIONS["sgn"](self.bracket("\\left(", "\\right)")) ** exponent
        elif token == "\\mathrm" and self.tokens[self.place + 1:self.place + 5] == ["{", "e", "}", "^"]:
            self.place += 5
            return math.exp(self.group())
        elif token[:1] == "\\" and word in FUNCTIONS:
            self.place += 1
            exponent = 1.0
            if self.next() == "^":
                self.place += 1
                exponent = self.group()
            if self.next() == "\\left(":
                value = self.bracket("\\left(", "\\right)")
            else:
                value = self.value_of(self.name())
            return FUNCTIONS[word](value) ** exponent
        elif token[:1].isdigit():
            self.place += 1
            value = float(token)
        else:
            value = self.value_of(self.name())
        if self.next() == "^":
            self.place += 1
            value **= self.group()
        return value

    def bracket(self, left, right):
        self.take(left)
        value = self.sum()
        self.take(right)
        return value

    def letters(self):
        """A letter, a Greek one, an upright word, or what stands in braces as an index."""
        token = self.next()
        self.place += 1
        if token == "\\mathrm":
            token = ""
            self.take("{")
            while self.next() != "}":
                token += self.next()
                self.place += 1
            self.place += 1
            return token
        if token == "\\ell":
            return "l"
        if not re.fullmatch(r"\\?[A-Za-z]+", token):
            raise ValueError(f"'{token}' begins no factor: {' '.join(self.tokens)}")
        return token.lstrip("\\")

    def name(self):
        dots = {"\\dot": "_dot", "\\ddot": "_ddot"}.get(self.next(), "")
        if dots:
            self.place += 1
            self.take("{")
        name = self.letters()
        if dots:
            self.take("}")
        if self.next() == "_":
            self.place += 1
            self.take("{")
            while self.next() != "}":
                if re.fullmatch(r"[\d,]+\.?|[A-Za-z]", self.next()):
                    name += self.next()
                    self.place += 1
                else:
                    name += self.letters()
            self.place += 1
        return name + dots


def key(name):
    """`theta_1_dot`, `theta1_dot` and `\\dot{\\theta}_{1}` are one name, however the index is written."""
    dots = re.search(r"_d{1,2}ot$", name)
    dots = dots.group() if dots else ""
    return re.sub("[_,]", "", name[:len(name) - len(dots)]) + dots


class Values(dict):
    """By `key`, so that both readers draw the same."""

    def __contains__(self, name):
        return super().__contains__(key(name))

    def __getitem__(self, name):
        return super().__getitem__(key(name))

    def __setitem__(self, name, value):
        super().__setitem__(key(name), value)


def numbers(reader, text, values):
    """Its value; None where it has none there (the root of a negative number)."""
    try:
        value = reader(values).read(text)
    except (ZeroDivisionError, OverflowError):
        return None
    except ValueError as refusal:
        if "math domain" in str(refusal):
            return None
        raise
    return None if isinstance(value, complex) else value


def agree(page, latex):
    """At the first three draws of all names where there is a value."""
    compared = 0
    for _ in range(500):
        values = Values()
        left = numbers(Page, page, values)
        right = numbers(Latex, latex, values)
        if (left is None) != (right is None):
            return False, 0
        if left is None:
            continue
        if abs(left - right) > 1e-9 * max(1.0, abs(left)):
            return False, compared
        compared += 1
        if compared == 3:
            break
    return compared > 0, compared


def slipped(latex):
    """With a sign, a letter or a number exchanged."""
    for old, new in (("\\sin", "\\cos"), (" - ", " + "), (" + ", " - "), ("^{2}", "^{3}"),
                     ("\\ell", "g"), ("\\dot{", "\\ddot{")):
        if old in latex:
            return latex.replace(old, new, 1)
    return latex + " + 1"


def bare(document):
    """Lines with a character that means something else in a text, outside of formulas and comments."""
    formula = False
    for line in document.splitlines():
        formula = formula or line.startswith("\\begin{align*}")
        text = re.sub(r"\$[^$]*\$", "", re.sub(r"^%.*", "", line))
        if not formula and re.search(r"(?<!\\)[_^&#%]", text):
            yield line
        formula = formula and not line.startswith("\\end{align*}")


def run(program, *words):
    """What it prints."""
    return subprocess.run([program, *words], capture_output=True, text=True, check=True).stdout


def main():
    program = sys.argv[1]
    random.seed(1)
    systems = [line.split()[0] for line in run(program, "list", "systems").splitlines() if line.strip()]
    scenes = [line.split()[0] for line in run(program, "list", "scenes").splitlines() if line.strip()]
    failed = formulas = planted = 0
    folder = tempfile.TemporaryDirectory()
    indexed = os.path.join(folder.name, "indexed.nml")
    with open(indexed, "w") as file:
        file.write(INDEXED)
    for name in systems + scenes + [indexed]:
        told = subprocess.run([program, "derive", name, "--json"], capture_output=True, text=True)
        if told.returncode != 0:
            if name == indexed or name in systems and "no formula for L" not in told.stderr:
                print(f"FAILED  derive {name} --json: {told.stderr.strip()}")
                failed += 1
            continue
        document = re.sub(r" \\\\\n    & \\quad\{\}", "", run(program, "derive", name, "--latex"))
        for line in bare(document):
            failed += 1
            print(f"FAILED  derive {name} --latex: '{line}' is no LaTeX")
        caught = tried = 0
        for line in json.loads(told.stdout)["lines"]:
            latex = line.get("latex")
            if not latex or line.get("formula") is None:
                continue
            page = line["formula"]
            formulas += 1
            try:
                good, _ = agree(page, latex)
            except ValueError as refusal:
                good = False
                print(f"        {refusal}")
            if not good:
                failed += 1
                print(f"FAILED  derive {name}: {page} is not {latex}")
                continue
            if latex not in document:
                failed += 1
                print(f"FAILED  derive {name} --latex: lacks {latex}")
            if len(page) > 12 and caught == 0 and tried < 4:
                tried += 1
                caught += not agree(page, slipped(latex))[0]
        planted += tried > 0
        if tried > 0 and caught == 0:
            failed += 1
            print(f"FAILED  derive {name}: a slip goes unnoticed")
    print(f"{formulas} formulas in LaTeX read back, slips in {planted} derivations seen, {failed} failed")
    return failed > 0 or formulas < 300


if __name__ == "__main__":
    sys.exit(main())
