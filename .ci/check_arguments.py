#!/usr/bin/env python3
"""Dummy arguments of public procedures in src that no `!!` text documents, as file:line: procedure: argument.

Public are the module procedures that a module lists as public, by themselves or behind a generic name, the
public type-bound procedures of public types, and the abstract interfaces that are public or of such a binding.
An argument is documented by `!!` behind its declaration, or on the lines that follow it; one text may serve
all names of a declaration. The passed object is documented by its type, and a binding that overrides another
by that one. Interfaces of other libraries are theirs to document, and operands need no text.

.ci/arguments_left has, for each room, the number of arguments that nobody has documented yet, 0 where a room
is not in it. A room may not have more than that.

  check_arguments.py [DIRECTORY] [ROOM...]     the project, and the rooms whose arguments are listed
  check_arguments.py --tighten                 write the numbers of today, where they are lower
"""
import pathlib
import re
import sys

PREFIX = re.compile(r"(?:(?:pure|impure|elemental|recursive|non_recursive|module|logical|integer|real|complex|"
                    r"character|type|class)\s*(?:\([^)]*\))?\s*)*$")
PROCEDURE = re.compile(r"^(.*?)\b(?:subroutine|function)\s+(\w+)\s*(?:\(([^)]*)\))?")
DECLARATION = re.compile(r"^(?:integer|real|logical|character|complex|type|class|procedure)\b[^:]*?(?:\(.*?\))?.*?::(.*)")


class Procedure:
    def __init__(self, line, dummies):
        self.line = line
        self.dummies = dummies
        self.declared = {}     # name: line
        self.documented = set()
        self.passed = None     # the first argument, if it is a class(...)


class Module:
    def __init__(self, path):
        self.path = path
        self.private = False
        self.public, self.hidden = set(), set()
        self.procedures, self.abstract, self.generics = {}, {}, {}
        self.types = {}        # name: (parent, bindings, generics)

    def is_public(self, name):
        return name in self.public or not (self.private or name in self.hidden)


def statements(path):
    """(line, code in lower case without strings, whether a `!!` text belongs to it)"""
    result, pending, first = [], "", 0
    documented = False
    for number, line in enumerate(path.read_text().splitlines(), 1):
        code, comment = split_comment(line)
        text = comment.startswith("!!") and comment[2:].strip() != ""
        if not code.strip():
            if text and not pending and result:
                result[-1][2] = True
            continue
        code = code.strip()
        if code.startswith("#"):
            continue
        first = first if pending else number
        pending += code.removeprefix("&").strip() if pending else code
        documented = documented or text
        if pending.endswith("&"):
            pending = pending[:-1]
            continue
        result.append([first, pending.lower(), documented])
        pending, documented = "", False
    return result


def split_comment(line):
    """The code with its strings emptied, and the comment"""
    code, position = "", 0
    while position < len(line):
        letter = line[position]
        if letter == "!":
            return code, line[position:].strip()
        if letter in "\"'":
            end = line.find(letter, position + 1)
            if end < 0:
                return code + '""', ""
            code += '""'
            position = end
        else:
            code += letter
        position += 1
    return code, ""


def names_of(text):
    """The names that a list declares: a(n, m), b => null(), operator (+)"""
    result, depth, word = [], 0, ""
    for letter in text + ",":
        depth += (letter in "([") - (letter in ")]")
        if letter == "," and depth == 0:
            word = word.strip()
            generic = re.match(r"(?:operator|assignment)\s*\(.*?\)|\w+", word)
            if generic:
                result.append(re.sub(r"\s", "", generic.group()))
            word = ""
        else:
            word += letter
    return result


def read(path):
    module, scopes = Module(path), []
    for line, code, documented in statements(path):
        inside = scopes[-1] if scopes else (None, None)
        kind, item = inside
        if re.match(r"end\s*(module|submodule|interface|type|subroutine|function|procedure)?\b(?!\s*[=(%])", code) \
                and not re.match(r"end\s*(if|do|select|associate|block|where|forall|enum|critical|file)", code):
            if scopes:
                scopes.pop()
            continue
        if re.match(r"(submodule\s*\(|module\s+(?!procedure\b|subroutine\b|function\b|pure\b|elemental\b|"
                    r"recursive\b|impure\b|logical\b|integer\b|real\b|type\b|character\b)\w+$)", code):
            scopes.append(("submodule" if code.startswith("sub") else "module", None))
            continue
        interface = re.match(r"(abstract\s+)?interface\b\s*(.*)$", code)
        if interface:
            name = re.sub(r"\s", "", interface.group(2))
            scopes.append(("abstract" if interface.group(1) else "interface", name))
            continue
        if re.match(r"module\s+procedure\b", code) and kind == "interface":
            listed = re.sub(r"^module\s+procedure\s*(::)?", "", code)
            module.generics.setdefault(item, []).extend(names_of(listed))
            continue
        if re.match(r"module\s+procedure\b", code):
            scopes.append(("procedure", Procedure(line, [])))
            continue
        start = PROCEDURE.match(code)
        if start and PREFIX.match(start.group(1)):
            dummies = [name.strip() for name in (start.group(3) or "").split(",") if name.strip()]
            procedure = Procedure(line, dummies)
            name, ours = start.group(2), kind in ("module", "interface") and re.search(r"\bmodule\b", start.group(1))
            if kind == "module" or ours:
                module.procedures[name] = procedure
            elif kind == "abstract" and len(scopes) < 3:
                module.abstract[name] = procedure
            if ours and item:
                module.generics.setdefault(item, []).append(name)
            if kind in ("abstract", "interface") and len(scopes) > 2 and documented:
                scopes[-2][1].documented.add(name)
            scopes.append(("procedure", procedure))
            continue
        start = re.match(r"type\b(?!\s*\()(.*)", code)
        if start and not re.match(r"\s*(is|=|%)", start.group(1)):
            attributes, _, name = start.group(1).rpartition("::")
            parent = re.search(r"extends\s*\(\s*(\w+)", attributes)
            found = (parent.group(1) if parent else None, {}, {})
            module.types[name.strip()] = found
            scopes.append(("type", found))
            continue
        if kind == "module":
            access = re.match(r"(private|public)\s*(?:(?:::)?\s*(.*))$", code)
            if access and not access.group(2):
                module.private = access.group(1) == "private"
            elif access:
                (module.public if access.group(1) == "public" else module.hidden).update(names_of(access.group(2)))
        elif kind == "type":
            bind(item, code)
        elif kind == "procedure":
            declaration = DECLARATION.match(code)
            if declaration:
                for name in names_of(declaration.group(1)):
                    item.declared[name] = line
                    if documented:
                        item.documented.add(name)
                    if code.startswith("class") and item.dummies[:1] == [name]:
                        item.passed = name
    return module


def bind(found, code):
    """Note the bindings of one statement of a derived type"""
    _, bindings, generics = found
    binding = re.match(r"(procedure|generic)\s*(?:\(\s*(\w+)\s*\))?(.*?)::(.*)", code)
    if not binding:
        return
    kind, interface, attributes, listed = binding.groups()
    hidden = "private" in attributes
    if kind == "generic":
        name, _, specific = listed.partition("=>")
        generics[re.sub(r"\s", "", name)] = [] if hidden else names_of(specific)
        return
    if "pointer" in attributes:
        return
    for word in listed.split(","):
        name, _, target = word.partition("=>")
        name, target = name.strip(), target.strip() or name.strip()
        bindings[name] = (interface if "deferred" in attributes else target, "deferred" in attributes, hidden,
                          "nopass" in attributes)


def missing(modules):
    """(path, line, procedure, argument) of each argument without a text"""
    parents, bound = {}, {}
    for module in modules:
        for name, (parent, bindings, _) in module.types.items():
            parents[name], bound[name] = parent, set(bindings)

    def overrides(kind, name):
        kind = parents.get(kind)
        while kind:
            if name in bound.get(kind, ()):
                return True
            kind = parents.get(kind)
        return False

    result, total = [], 0
    for module in modules:
        wanted = {}            # procedure: whether its first argument is a passed object
        for name, procedure in list(module.procedures.items()) + list(module.abstract.items()):
            if module.is_public(name):
                wanted[name] = False
        for name, listed in module.generics.items():
            if module.is_public(name) and "(" not in name:
                wanted.update({specific: False for specific in listed})
        for kind, (_, bindings, generics) in module.types.items():
            if not module.is_public(kind):
                continue
            open_by_generic = {name for listed in generics.values() for name in listed}
            for name, (target, _, hidden, nopass) in bindings.items():
                if (not hidden or name in open_by_generic) and not overrides(kind, name):
                    wanted[target] = not nopass
        for name, passes in wanted.items():
            procedure = module.procedures.get(name) or module.abstract.get(name)
            if not procedure:
                continue       # another module's, which documents it
            for dummy in procedure.dummies:
                if passes and dummy == procedure.passed:
                    continue
                total += 1
                if dummy not in procedure.documented:
                    result.append((module.path, procedure.declared.get(dummy, procedure.line), name, dummy))
    return sorted(result), total


def main(words):
    tighten = "--tighten" in words
    words = [word for word in words if word != "--tighten"]
    house = pathlib.Path(words[0] if words and "/" in words[0] else pathlib.Path(__file__).resolve().parents[1])
    rooms = {word for word in words if "/" not in word}
    paths = sorted(path for path in (house / "src").rglob("*") if path.suffix.lower() == ".f90")
    if not paths:
        sys.exit(f"no Fortran files in {house}/src")
    found, total = missing([read(path) for path in paths])
    left_file = house / ".ci" / "arguments_left"
    allowed = {}
    if left_file.exists():
        allowed = {room: int(count) for room, count in map(str.split, left_file.read_text().splitlines())}
    counts, broken = {}, []
    for path, line, procedure, dummy in found:
        place = path.relative_to(house / "src")
        room = place.parts[0] if len(place.parts) > 1 else "face"
        counts[room] = counts.get(room, 0) + 1
        text = f"{path.relative_to(house)}:{line}: {procedure}: {dummy}"
        if room in rooms:
            print(text)
        broken.append((room, text))
    if tighten:
        lower = {room: min(count, counts.get(room, 0)) for room, count in allowed.items()}
        left_file.write_text("".join(f"{room} {count}\n" for room, count in sorted(lower.items()) if count))
        allowed = lower
    bad = {room for room, count in counts.items() if count > allowed.get(room, 0)}
    for room, text in broken:
        if room in bad and room not in rooms:
            print(text)
    for room in sorted(counts.keys() | allowed.keys()):
        count, limit = counts.get(room, 0), allowed.get(room, 0)
        if count > limit:
            print(f"{room}: {count} arguments of public procedures have no text; {limit} were left")
        elif rooms == set() or room in rooms:
            print(f"{room}: {count} of {limit} left")
    print(f"{len(found)} of {total} arguments of public procedures have no text")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
