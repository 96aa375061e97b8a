#!/usr/bin/env python3
"""Error of bending frequencies over the number of elements, from runs of `ambrig analyze`, against closed forms, uniform
steel of 1 m by 80 mm: a free Euler-Bernoulli shaft, a pinned shaft with rotary inertia, and the same with shear, of elements
of two nodes (the default, ROSS's) and of three (element = "three_node").

    python3 tools/convergence_study.py build/release/ambrig --svg docs/figures/convergence.svg

Prints the table of docs/theory/rotor.md and the order of the last doubling; ends with 1 when an order is below 3.5, or,
with shear and two nodes, below 1.9: the usual Timoshenko element (ROSS's too) has no shear of its own inertia load, an
error of rho w² h²/(24 kappa G)."""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

E, RHO, NU, L, D = 2.1e11, 7850.0, 0.3, 1.0, 0.08
COUNTS = (2, 4, 8, 16, 32)
THEORIES = {"pinned": "shear = false\n", "pinned, shear": "", "pinned, shear, three nodes": "element = \"three_node\"\n"}
SECOND_ORDER = "pinned, shear, mode"
PINNED = "[[rotor.support]]\nz = 0.0\nk = 1e20\n[[rotor.support]]\nz = 1.0\nk = 1e20\n"
FREE_ROOTS = (4.730040744862704, 7.853204624095838, 10.995607838001671)


def pinned_timoshenko(k):
    """rho² I/(kappa G) w⁴ - (rho A + rho I a² (1 + E/(kappa G))) w² + E I a⁴ = 0, a = k pi/L, in Hz."""
    a2, area, inertia = (k * math.pi / L) ** 2, math.pi / 4 * D**2, math.pi / 64 * D**4
    kg = 6 * (1 + NU) / (7 + 6 * NU) * E / (2 * (1 + NU))
    a, b, c = RHO**2 * inertia / kg, RHO * area + RHO * inertia * a2 * (1 + E / kg), E * inertia * a2**2
    return math.sqrt(2 * c / (b + math.sqrt(b * b - 4 * a * c))) / (2 * math.pi)


def pinned_rayleigh(k):
    a2, area, inertia = (k * math.pi / L) ** 2, math.pi / 4 * D**2, math.pi / 64 * D**4
    return math.sqrt(E * inertia * a2**2 / (RHO * area + RHO * inertia * a2)) / (2 * math.pi)


def free_euler(k):
    return FREE_ROOTS[k - 1] ** 2 * math.sqrt(E * D**2 / 16 / RHO) / L**2 / (2 * math.pi)


def analyse(binary, folder, elements, theory, supports):
    shaft = pathlib.Path(folder) / "shaft.toml"
    shaft.write_text(
        f"[rotor]\nkind = \"beam\"\nelements_per_section = {elements}\n{theory}[[rotor.section]]\nlength = {L}\nod = {D}\n"
        f"E = {E}\nrho = {RHO}\nnu = {NU}\n{supports}")
    out = pathlib.Path(folder) / "out.json"
    subprocess.run([binary, "analyze", str(shaft), "--speed", "60", "--json", str(out), "--force"], check=False, stdout=subprocess.DEVNULL)
    return json.loads(out.read_text())


def errors(binary):
    """{name of the curve: errors over COUNTS}"""
    out = {}
    with tempfile.TemporaryDirectory() as folder:
        for n in COUNTS:
            at_rest = {}
            for name, theory in THEORIES.items():
                pinned = analyse(binary, folder, n, theory, PINNED)
                at_rest[name] = sorted(m["frequency"] for m in pinned["campbell"][0]["modes"])
            free = analyse(binary, folder, n, "shear = false\nrotary_inertia = false\ngyroscopic = false\n", "")
            for k in (1, 2, 3):
                if k <= n:
                    out.setdefault(f"free, mode {k}", []).append(abs(free["free_bending"][k - 1] / free_euler(k) - 1))
                    for name in THEORIES:
                        exact = pinned_timoshenko(k) if "shear" in name else pinned_rayleigh(k)
                        out.setdefault(f"{name}, mode {k}", []).append(abs(at_rest[name][2 * k - 1] / exact - 1))
    return out


def order(e):
    """Of the last doubling whose errors stand above rounding."""
    above = [x for x in e if x > 1e-10]
    return math.log2(above[-2] / above[-1])


def svg(curves):
    width, height, left, top = 720, 400, 70, 20
    x = lambda n: left + (math.log2(n) - 1) / 4 * 380
    y = lambda e: top + (0 - math.log10(e)) / 10 * 330
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="13">', '<rect width="100%" height="100%" fill="white"/>']
    for k in range(0, 11, 2):
        parts.append(f'<line x1="{left}" x2="{left + 380}" y1="{y(10**-k)}" y2="{y(10**-k)}" stroke="#ddd"/><text x="{left - 8}" y="{y(10**-k) + 4}" text-anchor="end">1e-{k}</text>')
    for n in COUNTS:
        parts.append(f'<text x="{x(n)}" y="{top + 350}" text-anchor="middle">{n}</text>')
    parts.append(f'<text x="{left + 190}" y="{top + 372}" text-anchor="middle">elements</text><text x="16" y="{top + 165}" transform="rotate(-90 16 {top + 165})" text-anchor="middle">relative error of the frequency</text>')
    for k, (name, e) in enumerate(curves.items()):
        colour = ("#1f6fb4", "#d9731a", "#2e8b57")[k // 4]
        dash = ("2 2", "6 3", "", "9 2 2 2")[k % 4]
        counts = COUNTS[len(COUNTS) - len(e):]
        points = " ".join(f"{x(n):.1f},{y(max(v, 1e-10)):.1f}" for n, v in zip(counts, e))
        parts.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.6" stroke-dasharray="{dash}"/><line x1="475" x2="500" y1="{top + 12 + 20 * k}" y2="{top + 12 + 20 * k}" stroke="{colour}" stroke-width="2" stroke-dasharray="{dash}"/><text x="506" y="{top + 16 + 20 * k}">{name}</text>')
    parts.append(f'<line x1="{x(8)}" y1="{y(1e-2)}" x2="{x(32)}" y2="{y(1e-2 / 256)}" stroke="#999" stroke-dasharray="4 3"/><text x="{x(16) + 8}" y="{y(2e-3)}" fill="#666">order 4</text></svg>')
    return "\n".join(parts) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ambrig")
    parser.add_argument("--svg")
    args = parser.parse_args()
    curves = errors(args.ambrig)
    print("| elements | " + " | ".join(map(str, COUNTS)) + " | order |\n" + "|---" * (len(COUNTS) + 2) + "|")
    for name, e in curves.items():
        cells = ["-"] * (len(COUNTS) - len(e)) + [f"{v:.1e}" for v in e]
        print(f"| {name} | " + " | ".join(cells) + f" | {order(e):.2f} |")
    if args.svg:
        pathlib.Path(args.svg).write_text(svg(curves))
    return int(any(order(e) < (1.9 if name.startswith(SECOND_ORDER) else 3.5) for name, e in curves.items()))


if __name__ == "__main__":
    sys.exit(main())
