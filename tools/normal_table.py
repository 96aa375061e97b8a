#!/usr/bin/env python3
"""Writes core/math/normal_table.h: the inverse normal distribution in pieces.

  tools/normal_table.py > core/math/normal_table.h

z(p), the size that |z| exceeds with probability p / 2^31, for p in [1, 2^31): in every octave of p an
interpolant of degree 4 at Chebyshev nodes, error below 4e-5 (tests/core/math/noise_test.cc measures it).
"""
import math
from statistics import NormalDist

DEGREE, FIRST, LAST = 4, 127, 157  # exponents of p as single-precision numbers hold them


def size(p):
    return -NormalDist().inv_cdf(p * 2.0**-32)


def interpolant(f):
    """Coefficients in t of the polynomial through f at the Chebyshev nodes of [-1/2, 1/2]."""
    n = DEGREE + 1
    nodes = [0.5 * math.cos(math.pi * (k + 0.5) / n) for k in range(n)]
    divided = [f(x) for x in nodes]
    for order in range(1, n):
        for k in range(n - 1, order - 1, -1):
            divided[k] = (divided[k] - divided[k - 1]) / (nodes[k] - nodes[k - order])
    poly = [0.0] * n
    for k in range(n - 1, -1, -1):  # Horner over Newton's form
        poly = [(poly[j - 1] if j else 0.0) - nodes[k] * poly[j] for j in range(n)]
        poly[0] += divided[k]
    return poly


table = [[0.0] * 32 for _ in range(DEGREE + 1)]
for e in range(FIRST, LAST + 1):
    for power, c in enumerate(interpolant(lambda t: size((1.5 + t) * 2.0 ** (e - FIRST)))):
        table[power][e % 32] = c

print("#pragma once")
print("// Written by tools/normal_table.py. Coefficients by power of t = f - 1.5 and by exponent (modulo 32) of")
print("// p = 2^e f; the exponents of p = 1/2 and p = 2^31 share the entry that gives zero.")
print("namespace ambrig {")
print(f"inline constexpr int kNormalDegree = {DEGREE};")
print(f"alignas(64) inline constexpr float kNormalTable[{DEGREE + 1}][32] = {{")
for row in table:
    print("    {" + ",\n     ".join(", ".join(f"{c:.9g}F" if "." in f"{c:.9g}" or "e" in f"{c:.9g}" else f"{c:.9g}.0F" for c in row[k:k + 6]) for k in range(0, 32, 6)) + "},")
print("};")
print("}  // namespace ambrig")
