#!/usr/bin/env python3
"""Fails where a line of a comment is longer than 100 columns, or breaks inside an equation. Run by ctest.

    tools/check_comments.py            check
    tools/check_comments.py --wrap     wrap what is too long, without changing a word

The formatter leaves comments alone. Equations stand on lines of their own; a line that goes on with the equation of the
line before is indented further. A long line goes over into the lines of its paragraph: up to an empty line, a list, a
line that is indented otherwise, or the end of the comment."""
import re
import subprocess
import sys

COLUMNS = 100
COMMENT = re.compile(r"\s*//+(.*)$")
LINE = re.compile(r"(\s*//[/!]?)( ?)(.*)$")
BEGINS = re.compile(r"\s*(?:=|\+|\*|/|<=|>=|·|±) +\S")
ENDS = re.compile(r"\S +(?:=|\+|\*|/|<=|>=|<|>|·|-)\s*$")
# A line of prose may begin with a dash; an equation that goes on has something open before it.
MINUS = re.compile(r"\s*- +\S")
OWN_LINE = re.compile(r"(?:[-*|#@\\]|\d+[.)] |clang-format|NOLINT)")
RAW = re.compile(r'R"([^(\s]*)\(.*?\)\1"', re.DOTALL)


def indent(text):
    return len(text) - len(text.lstrip())


def broken(before, after):
    """Whether an equation goes over from one line of a comment to the next."""
    if indent(after) > indent(before) or not before.strip():
        return False
    going_on = MINUS.match(after) and before.count("(") > before.count(")")
    return bool(BEGINS.match(after) or ENDS.search(before) or going_on)


def in_raw_strings(text):
    """Numbers, from 0, of the lines of raw strings."""
    out = set()
    for match in RAW.finditer(text):
        first = text.count("\n", 0, match.start())
        out.update(range(first + 1, first + 1 + match[0].count("\n")))
    return out


def is_long(line):
    """Whether a line is too long because of its comment; one word (an address) may be."""
    at = line.find("//")
    return len(line) > COLUMNS and at >= 0 and line.count('"', 0, at) % 2 == 0 and " " in line[at:].strip("/ ")


def lines_of(words, width):
    """The words on lines of at most this width, none of which breaks an equation."""
    out = []
    while words:
        count, used = 0, -1
        while count < len(words) and (count == 0 or used + 1 + len(words[count]) <= width):
            used += 1 + len(words[count])
            count += 1
        line = " ".join(words[:count])
        while 1 < count < len(words) and broken(line, " ".join(words[count:count + 2])):
            count -= 1
            line = " ".join(words[:count])
        out.append(line)
        words = words[count:]
    return out


def wrapped(lines, skipped):
    """The lines with long comments wrapped into their paragraphs."""
    out, k = [], 0
    while k < len(lines):
        match = LINE.match(lines[k])
        if not match or k in skipped or not is_long(lines[k]) or "NOLINT" in lines[k]:
            out.append(lines[k])
            k += 1
            continue
        mark, text = match[1], match[2] + match[3]
        hang = indent(text) + (2 if re.match(r"\s*(?:[-*]|\d+[.)]) ", text) else 0)
        body, end = [text.strip()], k + 1
        while end < len(lines):
            more = LINE.match(lines[end])
            if not more or more[1] != mark or indent(more[2] + more[3]) != hang or OWN_LINE.match(more[3].strip()) \
                    or not more[3].strip():
                break
            body.append(more[3].strip())
            end += 1
        words = re.split(r"(?<=\S) (?=\S)", " ".join(body))
        first = True
        for line in lines_of(words, COLUMNS - len(mark) - hang):
            out.append(mark + " " * (indent(text) if first else hang) + line)
            first = False
        k = end
    return out


def main():
    files = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "*.h", "*.cc", "*.c"], check=True,
                           capture_output=True, text=True).stdout.split()
    bad = 0
    for file in files:
        text = open(file, encoding="utf-8").read()
        raw = in_raw_strings(text)
        if "--wrap" in sys.argv:
            new = "\n".join(wrapped(text.split("\n"), raw))
            if new != text:
                open(file, "w", encoding="utf-8").write(new)
                text = new
                raw = in_raw_strings(text)
        source = text.split("\n")
        lines = [COMMENT.match(line) for line in source]
        for k, (a, b) in enumerate(zip(lines, lines[1:]), 1):
            if a and b and broken(a[1], b[1]):
                print(f"{file}:{k}: an equation is broken: {a[1].strip()[-40:]} | {b[1].strip()[:40]}")
                bad += 1
        for k, line in enumerate(source, 1):
            if k - 1 not in raw and is_long(line):
                print(f"{file}:{k}: a comment of {len(line)} columns, allowed: {COLUMNS} (--wrap)")
                bad += 1
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
