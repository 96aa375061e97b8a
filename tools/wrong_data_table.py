"""What tools/wrong_data.py tells of its runs: what was recognised, with confidence limits."""
import collections
import math

from data_errors import KINDS, NOT_ASKED


def judged(r):
    """(recognised, right channel, faults that name something sound)"""
    faults = r.get("data", [])
    own = [f for f in faults if f["record"] == "wrong.h5"]
    named = set(r["named"])
    right = [f for f in own if (not named and f["channel"] == "") or f["channel"] in named or f["with"] in named]
    of_kind = [f for f in right if f["fault"] in KINDS.get(r["kind"], ([], set(), True))[1]]
    return bool(own), bool(right) and bool(of_kind), len(faults) - len(right)


def bounds(k, n):
    """Clopper-Pearson, 95 %, by bisection on the binomial sums."""
    def below(p, upto):
        return sum(math.comb(n, j) * p ** j * (1 - p) ** (n - j) for j in range(upto + 1))

    def root(f):
        a, b = 0.0, 1.0
        for _ in range(60):
            c = (a + b) / 2
            a, b = (c, b) if f(c) else (a, c)
        return a
    low = 0.0 if k == 0 else root(lambda p: 1 - below(p, k - 1) < 0.025)
    high = 1.0 if k == n else root(lambda p: below(p, k) > 0.025)
    return low, high


def share(k, n):
    if n == 0:
        return "-"
    low, high = bounds(k, n)
    return f"{k} of {n} ({100 * low:.0f} to {100 * high:.0f} %)"


def table(results, options):
    rows = collections.OrderedDict()
    asked = [r for r in results if r["kind"] != "none"]
    for r in sorted(asked, key=lambda r: (list(KINDS).index(r["kind"]), r["size"])):
        rows.setdefault((r["kind"], r["size"]), []).append(r)
    lines = ["| error | size | runs | gross | recognised, of the gross | kind and column right | small ones recognised | "
             "sound columns named |", "|---|---|---|---|---|---|---|---|"]
    total = [0, 0, 0, 0]
    for (kind, size), group in rows.items():
        gross = [r for r in group if r["floors"] >= options.gross or not r["column"]]
        small = [r for r in group if r not in gross]
        hit = sum(judged(r)[0] for r in gross)
        right = sum(judged(r)[1] for r in gross)
        lines.append(f"| {kind} | {size:.4g} | {len(group)} | {len(gross)} | {share(hit, len(gross))} | "
                     f"{share(right, len(gross))} | {sum(judged(r)[0] for r in small)} of {len(small)} | "
                     f"{sum(judged(r)[2] > 0 for r in group)} |")
        if kind not in NOT_ASKED:
            total = [a + b for a, b in zip(total, (len(gross), hit, right, len(group)))]
    sound = [r for r in results if r["kind"] == "none"]
    lines += ["", f"Gross errors of kinds that are asked for, recognised: {share(total[1], total[0])}; with kind and "
              f"column: {share(total[2], total[0])}.",
              f"Right data called wrong: {share(sum(bool(r.get('data')) for r in sound), len(sound))}."]
    if any("adopted" in r for r in asked):
        wrong = [r for r in asked if r["kind"] not in NOT_ASKED]
        lines.append("Effects named from wrong data: "
                     f"{share(sum(bool(r.get('adopted')) for r in wrong), len(wrong))}.")
    return "\n".join(lines) + "\n"
