"""Puts mutants into a source behind a switch that is read at run time (mutant schemata):

    a + b       ->   (AMBRIG_MUTANT(17) ? (a - b) : (a + b))
    f(x);       ->   if (AMBRIG_MUTANT(18)) {} else { f(x); }
    0.5         ->   (AMBRIG_MUTANT(19) ? (0.5 * 1.5) : 0.5)

so that one build holds them all. Where an expression begins and ends is read from clang's syntax tree. A constexpr variable
with a mutant becomes const. What does not compile this way (a constant expression, a template argument, an operator that
the type does not have) is declined, and the caller draws another one."""
import re

try:
    from clang import cindex
    from clang.cindex import CursorKind as Kind
except ModuleNotFoundError:
    raise SystemExit("mutate: no module clang: install python3-clang-16 (tools/setup.sh --tidy), run with /usr/bin/python3")

# Declarations for the mutated sources; switches.cc defines them.
HEADER = """#pragma once
#include <utility>
extern "C" int ambrig_mutant;
extern "C" int ambrig_reached[];
#define AMBRIG_MUTANT(n) (ambrig_reached[n] = 1, ambrig_mutant == (n))
// The value of an expression: templates of Eigen for a sum and a difference are two types, their values are one.
template <class T>
auto AmbrigValue(T&& v) {
  if constexpr (requires { v.eval(); }) {
    return v.eval();
  } else {
    return std::decay_t<T>(std::forward<T>(v));
  }
}
"""
# At the end a program appends the numbers of the mutants that it came by to the file $AMBRIG_REACHED.
SOURCE = """#include <cstdio>
#include <cstdlib>
extern "C" {
int ambrig_mutant = 0;
int ambrig_reached[AMBRIG_MUTANTS + 1];
__attribute__((constructor(101))) void AmbrigReadMutant() {
  if (const char* number = std::getenv("AMBRIG_MUTANT")) ambrig_mutant = std::atoi(number);
}
__attribute__((destructor)) void AmbrigWriteReached() {
  const char* name = std::getenv("AMBRIG_REACHED");
  std::FILE* file = name ? std::fopen(name, "a") : nullptr;
  if (!file) return;
  for (int n = 0; n <= AMBRIG_MUTANTS; ++n) {
    if (ambrig_reached[n]) std::fprintf(file, "%d\\n", n);
  }
  std::fclose(file);
}
}
"""
BUILTIN = {Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR}
CLASSES = {Kind.CLASS_DECL, Kind.STRUCT_DECL, Kind.CLASS_TEMPLATE}


class Declined(Exception):
    """A mutant that cannot stand behind a switch, and why."""


class Wrap:
    """The text [first, last) of a source that a mutant's switch encloses."""

    def __init__(self, mutant, first, last, form, constexpr=None):
        self.mutant, self.first, self.last, self.form, self.constexpr = mutant, first, last, form, constexpr

    def extent(self):
        return [self.first, self.last, self.form, self.constexpr]


class Trees:
    """Syntax trees of sources: all sources of a folder are parsed in one piece, as a unity build has them, so that headers
    are read once. `arguments` are those of clang (include folders, definitions, standard)."""

    def __init__(self, arguments):
        self.index = cindex.Index.create()
        self.arguments = [*arguments, "-w"]
        self.units, self.top = [], {}  # name of a file -> its outermost cursors

    def read(self, files):
        """Parses these sources together, or in two halves where a name stands twice in them."""
        whole = str(files[0].parent / "mutated_folder.cc")  # exists in memory only
        unsaved = [(whole, "".join(f'#include "{f}"\n' for f in files))]
        # clang counts bytes
        unsaved += [(str(f), re.sub(r"[^\x00-\x7f]", "?", f.read_text())) for f in files if not f.read_text().isascii()]
        unit = self.index.parse(whole, self.arguments, unsaved_files=unsaved)
        errors = [d for d in unit.diagnostics if d.severity >= cindex.Diagnostic.Error]
        if errors and len(files) > 1:
            self.read(files[:len(files) // 2])
            self.read(files[len(files) // 2:])
            return
        if errors:
            raise SystemExit(f"clang cannot read {files[0]} as it is: line {errors[0].location.line}: {errors[0].spelling}")
        self.units.append(unit)
        names = {str(f) for f in files}
        self.top.update({name: [] for name in names})
        for cursor in unit.cursor.get_children():
            at = cursor.location.file
            if at is not None and at.name in names:
                self.top[at.name].append(cursor)


def offsets(cursor):
    return cursor.extent.start.offset, cursor.extent.end.offset


def in_file(cursor, file):
    at = cursor.extent.start.file
    return at is not None and at.name == str(file)


def path_to(trees, file, first, last):
    """Cursors of this file that contain [first, last), outermost first."""
    out, level = [], trees.top[str(file)]
    while level:
        inside = [c for c in level if in_file(c, file) and offsets(c)[0] <= first and last <= offsets(c)[1]]
        if not inside:
            return out
        # Two may stand at one place (a structure and the variable declared with it): the later one is the inner one.
        out.append(inside[-1])
        level = list(inside[-1].get_children())
    return out


def constexpr_of(path):
    """(first, last, replacement) of the word constexpr of the variable whose initialiser this is, if it has one."""
    for k, cursor in enumerate(path):
        if cursor.kind in (Kind.FUNCTION_DECL, Kind.CXX_METHOD, Kind.CONSTRUCTOR, Kind.FUNCTION_TEMPLATE):
            words = [t.spelling for t in cursor.get_tokens()][:12]
            if "constexpr" in words[:words.index("(")] if "(" in words else False:
                raise Declined("a constexpr function")
        if cursor.kind == Kind.VAR_DECL:
            for token in cursor.get_tokens():
                if token.spelling == "=":
                    break
                if token.spelling == "constexpr":
                    member = k > 0 and path[k - 1].kind in CLASSES
                    return (token.extent.start.offset, token.extent.end.offset, "inline const" if member else "const")
    return None


def operator_of(path, text, mutant):
    """The cursor whose operator the mutant changes."""
    symbol = text[mutant.first:mutant.last]
    inner = [c for c in path if offsets(c) != (mutant.first, mutant.last)]
    for cursor in reversed(inner):
        if cursor.kind in BUILTIN or (cursor.kind == Kind.CALL_EXPR and "operator" in cursor.spelling):
            return cursor
        if cursor.kind != Kind.UNEXPOSED_EXPR and cursor.kind != Kind.CALL_EXPR:
            break
    raise Declined(f"no operand of {symbol} in the syntax tree")


def arithmetic(kind):
    return cindex.TypeKind.BOOL.value <= kind.value <= cindex.TypeKind.LONGDOUBLE.value


def wrap_of(trees, file, text, mutant):
    """The part of the text that the mutant's switch must enclose."""
    path = path_to(trees, file, mutant.first, mutant.last)
    if not path:
        raise Declined("not in the syntax tree")
    constexpr = constexpr_of(path)
    if mutant.kind == "constant":
        return Wrap(mutant, mutant.first, mutant.last, "expression", constexpr)
    if mutant.kind == "statement":
        first = mutant.last - 1
        inner = path_to(trees, file, mutant.first, first)
        if not inner or inner[-1].kind.is_declaration() or not any(c.kind == Kind.COMPOUND_STMT for c in inner):
            raise Declined("no statement of a function")
        return Wrap(mutant, mutant.first, mutant.last, "statement")
    cursor = operator_of(path, text, mutant)
    first, last = offsets(cursor)
    if not first < mutant.first < mutant.last < last:
        raise Declined("an operator in a macro")
    compound = mutant.kind == "arithmetic" and mutant.new.endswith("=")
    plain = compound or arithmetic(cursor.type.get_canonical().kind)
    return Wrap(mutant, first, last, "expression" if plain else "value", constexpr)


def mutated_text(text, wrap, first, last):
    """[first, last) of the text with this one mutant."""
    return text[first:wrap.mutant.first] + wrap.mutant.new + text[wrap.mutant.last:last]


def rendered(text, wraps, first, last):
    """[first, last) of the text with the switches of all wraps, which enclose one another or stand apart."""
    inside = sorted((w for w in wraps if first <= w.first and w.last <= last), key=lambda w: (w.first, -w.last))
    out, at = [], first
    while inside:
        wrap = inside.pop(0)
        own = [w for w in inside if w.last <= wrap.last]
        inside = [w for w in inside if w.last > wrap.last]
        if any(w.first < wrap.last for w in inside):
            raise Declined("two expressions that overlap")
        out.append(text[at:wrap.first])
        healthy = rendered(text, own, wrap.first, wrap.last)
        other = mutated_text(text, wrap, wrap.first, wrap.last)
        switch = f"AMBRIG_MUTANT({wrap.mutant.number})"
        if wrap.form == "statement":
            out.append(f"if ({switch}) {{}} else {{ {healthy} }}")
        elif wrap.form == "value":
            out.append(f"({switch} ? AmbrigValue({other}) : AmbrigValue({healthy}))")
        else:
            out.append(f"({switch} ? ({other}) : ({healthy}))")
        at = wrap.last
    return "".join(out) + text[at:last]


def with_switches(text, wraps):
    """The whole source with the switches of all wraps; lines stay where they are."""
    edits = sorted({tuple(w.constexpr) for w in wraps if w.constexpr}, reverse=True)
    result = rendered(text, wraps, 0, len(text))
    if not edits:
        return result
    # The words constexpr stand before the expressions they belong to, outside of every wrap.
    parts, last = [], len(text)
    for first, end, word in edits:
        parts.append(rendered(text, [w for w in wraps if w.first >= end], end, last))
        parts.append(word)
        last = first
    parts.append(rendered(text, [w for w in wraps if w.last <= last], 0, last))
    return "".join(reversed(parts))


def lines_of(text, wrap):
    return text.count("\n", 0, wrap.first) + 1, text.count("\n", 0, wrap.last) + 1


def switched(trees, file, mutants):
    """(wraps, declined) of the mutants of one source."""
    text = file.read_text()
    wraps, declined = [], []
    for mutant in mutants:
        try:
            wraps.append(wrap_of(trees, file, text, mutant))
            with_switches(text, wraps)
        except Declined as why:
            wraps = [w for w in wraps if w.mutant is not mutant]
            declined.append((mutant, str(why)))
    result = with_switches(text, wraps)
    lost = [w for w in wraps if f"AMBRIG_MUTANT({w.mutant.number})" not in result]
    declined += [(w.mutant, "a constexpr variable inside of it") for w in lost]
    return [w for w in wraps if w not in lost], declined
