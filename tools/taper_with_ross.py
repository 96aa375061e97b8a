#!/usr/bin/env python3
"""The cone of ROSS's tests (rotor_conical: 0.5 m, 100 to 10 mm, pinned at both ends) in more and more elements: ROSS's
tapered element, and ambrig's of two and of three nodes. First two bending frequencies at rest; what the last columns of
each program tend to is extrapolated from its last two meshes, with the order that they have.

    python3 tools/taper_with_ross.py ross build/release/ambrig --svg docs/figures/taper.svg

ROSS's frequencies come from the matrices of its elements (ShaftElement.M and K), put together here as its Rotor does, so
that thousands of elements take no dense matrix. Ends with 1 when the two limits differ by more than 1e-6."""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as spla

LENGTH, LEFT, RIGHT = 0.5, 0.1, 0.01
ROSS_COUNTS = (4, 16, 64, 256, 1024, 4096)
OUR_COUNTS = (1, 2, 4, 8, 16, 32, 64)
IN_PLANE = np.ix_((0, 4, 6, 10), (0, 4, 6, 10))  # x and beta of both ends


def of_ross(ross, n):
    od = np.linspace(LEFT, RIGHT, n + 1)
    M, K = sp.lil_matrix((2 * n + 2, 2 * n + 2)), sp.lil_matrix((2 * n + 2, 2 * n + 2))
    for k in range(n):
        e = ross.ShaftElement(L=LENGTH / n, idl=0.0, odl=od[k], idr=0.0, odr=od[k + 1], material=ross.steel)
        at = slice(2 * k, 2 * k + 4)
        M[at, at] += e.M()[IN_PLANE]
        K[at, at] += e.K()[IN_PLANE]
    free = [i for i in range(2 * n + 2) if i not in (0, 2 * n)]
    M, K = M.tocsc()[free][:, free], K.tocsc()[free][:, free]
    return np.sqrt(np.sort(spla.eigsh(K, k=2, M=M, sigma=0, return_eigenvectors=False)))


def of_ambrig(binary, material, n, element, folder):
    shaft, out = pathlib.Path(folder) / "cone.toml", pathlib.Path(folder) / "cone.json"
    shaft.write_text(
        f"[rotor]\nkind = \"beam\"\nelements_per_section = {n}\nelement = \"{element}\"\n[[rotor.section]]\nlength = {LENGTH}\nod = {LEFT}\n"
        f"od_right = {RIGHT}\nE = {material.E!r}\nrho = {material.rho!r}\nnu = {material.Poisson!r}\n"
        + "".join(f"[[rotor.support]]\nz = {z}\nk = 1e20\n" for z in (0.0, LENGTH)))
    subprocess.run([binary, "analyze", shaft, "--speed", "60", "--json", out, "--force"], check=False, stdout=subprocess.DEVNULL)
    modes = json.loads(out.read_text())["campbell"][0]["modes"]
    return 2 * math.pi * np.array(sorted(m["frequency"] for m in modes)[0:4:2])


def limit(values):
    """Of the last three meshes, each `ratio` times as fine: Aitken's, and the order for that ratio."""
    a, b, c = values[-3:]
    return c - (c - b) ** 2 / ((c - b) - (b - a)), abs((b - a) / (c - b))


def svg(curves, limits):
    left, top, wide, high = 70, 20, 420, 300
    x = lambda n: left + math.log2(n) / 12 * wide
    y = lambda e: top - math.log10(e) / 10 * high
    parts = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 720 380" font-family="sans-serif" font-size="13">', '<rect width="100%" height="100%" fill="white"/>']
    for k in range(0, 11, 2):
        parts.append(f'<line x1="{left}" x2="{left + wide}" y1="{y(10**-k)}" y2="{y(10**-k)}" stroke="#ddd"/><text x="{left - 8}" y="{y(10**-k) + 4}" text-anchor="end">1e-{k}</text>')
    for n in (1, 4, 16, 64, 256, 1024, 4096):
        parts.append(f'<text x="{x(n)}" y="{top + high + 20}" text-anchor="middle">{n}</text>')
    parts.append(f'<text x="{left + wide / 2}" y="{top + high + 44}" text-anchor="middle">elements</text><text x="16" y="{top + high / 2}" transform="rotate(-90 16 {top + high / 2})" text-anchor="middle">relative error of the first frequency</text>')
    for k, (name, rows) in enumerate(curves.items()):
        colour = ("#d9731a", "#1f6fb4", "#2e8b57")[k]
        points = " ".join(f"{x(n):.1f},{y(max(abs(v[0] / limits[0] - 1), 1e-10)):.1f}" for n, v in rows.items())
        parts.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.6"/><line x1="{left + wide + 20}" x2="{left + wide + 45}" y1="{top + 12 + 20 * k}" y2="{top + 12 + 20 * k}" stroke="{colour}" stroke-width="2"/><text x="{left + wide + 51}" y="{top + 16 + 20 * k}">{name}</text>')
    return "\n".join(parts) + "\n</svg>\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ross")
    parser.add_argument("ambrig")
    parser.add_argument("--svg")
    args = parser.parse_args()
    sys.path.insert(0, args.ross)
    import ross
    curves = {"ROSS": {n: of_ross(ross, n) for n in ROSS_COUNTS}}
    with tempfile.TemporaryDirectory() as folder:
        for element in ("two_node", "three_node"):
            curves[f"ambrig, {element}"] = {n: of_ambrig(args.ambrig, ross.steel, n, element, folder) for n in OUR_COUNTS}
    print("| elements | " + " | ".join(f"{name}, mode {k} [rad/s]" for name in curves for k in (1, 2)) + " |\n" + "|---" * 7 + "|")
    for n in sorted(set(ROSS_COUNTS) | set(OUR_COUNTS)):
        print(f"| {n} | " + " | ".join(f"{rows[n][k]:.5f}" if n in rows else "" for rows in curves.values() for k in (0, 1)) + " |")
    limits = {name: [limit([v[k] for v in rows.values()]) for k in (0, 1)] for name, rows in curves.items()}
    print("| limit | " + " | ".join(f"{limits[name][k][0]:.5f}" for name in curves for k in (0, 1)) + " |")
    orders = {name: [math.log(r, 4 if name == "ROSS" else 2) for _, r in limits[name]] for name in curves}
    print("| order | " + " | ".join(f"{o:.2f}" for name in curves for o in orders[name]) + " |")
    finest = [limits["ambrig, three_node"][k][0] for k in (0, 1)]
    apart = max(abs(limits["ROSS"][k][0] / finest[k] - 1) for k in (0, 1))
    print(f"largest difference of the limits of ROSS and of ambrig: {apart:.1e}")
    if args.svg:
        pathlib.Path(args.svg).write_text(svg(curves, finest))
    return int(not apart < 1e-6)


if __name__ == "__main__":
    sys.exit(main())
