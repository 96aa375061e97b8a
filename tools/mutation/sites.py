"""Places of a source at which a mutant can stand: found in the text, which clang-format has laid out (a binary operator
has a blank on both sides). Where the operands of an operator begin and end is the compiler's to say (switches.py)."""
import pathlib
import random
import re

SWAPS = {
    "relational": {"<": ">=", ">": "<=", "<=": ">", ">=": "<", "==": "!=", "!=": "=="},
    "boundary": {"<": "<=", ">": ">=", "<=": "<", ">=": ">"},
    "logical": {"&&": "||", "||": "&&"},
    "arithmetic": {"+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="},
}
NUMBER = re.compile(r"(?<![\w.\[])(\d+\.\d+(?:e[+-]?\d+)?|\d+e[+-]?\d+|\d+)(?![\w.])")
STATEMENT = re.compile(r"^\s+(?!return\b|break\b|continue\b|using\b|case\b|delete\b|throw\b)"
                       r"(?:[\w.>\[\]:()*-]+ [-+*/|&]?= [^;{}]*|\+\+[\w.\[\]]+|[\w.>:-]+\([^;{}]*\));$")


def masked(text):
    """The text with comments, strings, characters and preprocessor lines as blanks of the same length."""
    blank = lambda m: re.sub(r"[^\n]", " ", m.group(0))
    pattern = r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)\'|^[ \t]*#[^\n]*'
    return re.sub(pattern, blank, text, flags=re.S | re.M)


def sites(text):
    """(kind, first, last, replacement) of every possible mutant of a source."""
    bare, out = masked(text), []
    for kind, swaps in SWAPS.items():
        for m in re.finditer(r"(?<= )(<=|>=|==|!=|&&|\|\||\+=|-=|\*=|/=|<|>|\+|-|\*|/)(?= )", bare):
            if m[1] in swaps:
                out.append((kind, m.start(1), m.end(1), swaps[m[1]]))
    for m in NUMBER.finditer(bare):
        value = m[1]
        new = str(int(value) + 1) if value.isdigit() else f"({value} * 1.5)"
        out.append(("constant", m.start(1), m.end(1), new if value not in ("0.0",) else "0.5"))
    at, before = 0, "{"
    for line in bare.split("\n"):
        if STATEMENT.match(line) and before[-1] in ";{}":  # not the end of a statement of several lines
            first = at + len(line) - len(line.lstrip())
            out.append(("statement", first, at + len(line), ";"))
        at += len(line) + 1
        before = line.rstrip() or before
    return out


class Mutant:
    """One change of one source. `number` is what AMBRIG_MUTANT must be for the programs to have it."""

    def __init__(self, root, file, kind, first, last, new):
        self.file, self.kind, self.first, self.last, self.new = file, kind, first, last, new
        self.name = str(file.relative_to(root))
        self.number = 0
        text = file.read_text()
        mutated = text[:first] + new + text[last:]
        self.line = text.count("\n", 0, first) + 1
        self.before, self.after = (t.split("\n")[self.line - 1] for t in (text, mutated))

    def key(self):
        return [self.name, self.kind, self.first, self.last, self.new]

    def row(self, status):
        return {"status": status, "file": self.name, "line": self.line, "kind": self.kind, "number": self.number,
                "before": self.before, "after": self.after}


def drawn(root, folders, seed):
    """Every possible mutant of the folders in the random order in which they are tried."""
    pool = []
    for folder in folders:
        for file in sorted((pathlib.Path(root) / folder).rglob("*.cc")):
            pool += [(file, *s) for s in sites(file.read_text())]
    order = random.Random(seed).sample(pool, len(pool))
    return (Mutant(root, *place) for place in order)
