"""Errors of measured data that tools/wrong_data.py makes: kinds, sizes, and how a record is changed."""
import math

import numpy as np

# kind of corruption: sizes, faults that name it, whether single columns are named (or the whole record)
KINDS = {
    "unit": ([1e3, 1e-3, 1e6, 25.4, math.pi / 180, 180 / math.pi], {"unit", "range"}, True),
    "factor": ([2.0, 0.5, math.sqrt(2), 0.3, 4.07], {"unit"}, True),
    "sign": ([-1.0], {"sign"}, True),
    "swap": ([0, 1], {"swap", "unit", "sign"}, True),        # 0: of one kind, 1: of different kinds
    "lag": ([1, 5, 50, 250], {"lag"}, False),                # rows, of the whole record
    "instrument": ([0.004, 0.02], {"lag"}, True),            # s, of all positions
    "lag-column": ([5, 50, 250], {"lag"}, True),
    "clip": ([0.5, 0.8], {"clip"}, True),                    # of the largest movement
    "freeze": ([0.05, 0.15, 0.4], {"freeze", "lost"}, True),  # part of the record
    "zeroed": ([0.05, 0.2], {"freeze", "lost"}, True),
    "lost": ([0.02, 0.08, 0.2], {"lost"}, False),
    "scenario": ([0], {"scenario"}, False),
    "rate": ([1.01, 0.99], {"lag"}, False),                  # the logger's clock
    "spikes": ([0.3, 3.0], {"range"}, True),                 # of the column's range, 10 rows
    "offset": ([1.0, 5.0], set(), True),                     # of the movement: a zero is no verdict
    "decimated": ([4], set(), True),
    "quantised": ([6], set(), True),                         # bits
    "hum": ([0.3], set(), True),                             # of the movement, 50 Hz
}
TOGETHER = {"lag", "instrument", "lost", "rate", "scenario"}  # the same change of many columns
NOT_ASKED = {k for k, v in KINDS.items() if not v[1]}


def movement(y):
    return float(np.std(y))


def kind_of(name):
    """Kind of a channel: reading, current, set-point, force; "" for what is not corrupted alone."""
    last = name.split(".")[-1]
    if last in ("x", "y", "z") and name.count(".") <= 1:
        return "reading"
    if last[:1] in "is" and last[1:].isdigit():
        return {"i": "current", "s": "set-point"}[last[0]]
    if last in ("fx", "fy", "fz"):
        return "force"
    return "bus" if name == "bus" else ""


def put(columns, name, value):
    columns[name] = (value, columns[name][1])


def exchange(size, columns, name, rng):
    """The column and another one of its kind (size 0) or of another kind (1), exchanged."""
    y = columns[name][0]
    same = [n for n in columns if n != name and (kind_of(n) == kind_of(name)) == (size == 0) and kind_of(n)
            and movement(columns[n][0]) > 0]
    if not same:
        return None
    if size == 0:  # a swap is seen where the two differ
        same.sort(key=lambda n: -float(np.std(columns[n][0] - y)))
        same = same[:max(1, len(same) // 2)]
    other = same[rng.integers(len(same))]
    first, second = columns[name], columns[other]
    columns[name], columns[other] = (second[0], first[1]), (first[0], second[1])
    return [name, other]


def late(y, rows):
    """The column so many rows late; before its first row it did what it does at its start, backwards."""
    return np.concatenate([y[1:1 + rows][::-1], y[:len(y) - rows]])


def change_columns_together(kind, size, columns, name, rng, rate, others):
    """Errors of the logger, which all columns have, or of an instrument. Returns the columns that may be named (`name`
    where all have it), None where it cannot be done."""
    rows = len(next(iter(columns.values()))[0])
    if kind == "lag":
        for n in columns:
            put(columns, n, late(columns[n][0], size))
    elif kind == "instrument":
        readings = [n for n in columns if kind_of(n) == "reading" and movement(columns[n][0]) > 0]
        if len(readings) < 2 or round(size * rate) >= rows // 2:
            return None
        for n in readings:
            put(columns, n, late(columns[n][0], round(size * rate)))
        return readings
    elif kind == "lost":
        count = int(size * rows)
        first = int(rng.integers(rows // 5, rows - count - rows // 5))
        for n in columns:
            put(columns, n, np.delete(columns[n][0], slice(first, first + count)))
    elif kind == "rate":
        at = np.arange(rows) * size
        at = at[at <= rows - 1]
        for n in columns:
            put(columns, n, np.interp(at, np.arange(rows), columns[n][0]))
    elif kind == "scenario":
        if not others:
            return None
        columns.clear()
        columns.update(others[rng.integers(len(others))])
    return [name]


def changed_column(kind, size, y, rng, rate):
    """The column with its error; as it is for a kind of no single column."""
    rows, z = len(y), y.copy()
    if kind in ("unit", "factor", "sign"):
        return y * size
    if kind == "lag-column":
        return late(y, size)
    if kind == "clip":
        middle = np.median(y)
        most = size * np.max(np.abs(y - middle))
        return np.clip(y, middle - most, middle + most)
    if kind in ("freeze", "zeroed"):
        count = int(size * rows)
        first = int(rng.integers(rows // 10, rows - count - 1))
        z[first:first + count] = y[first] if kind == "freeze" else 0
    elif kind == "spikes":
        z[rng.integers(0, rows, 10)] += size * np.ptp(y) * rng.choice([-1, 1], 10)
    elif kind == "offset":
        return y + size * movement(y)
    elif kind == "decimated":
        return np.repeat(y[::size], size)[:rows]
    elif kind == "quantised":
        step = np.ptp(y) / 2 ** size
        return np.round(y / step) * step
    elif kind == "hum":
        return y + size * movement(y) * math.sqrt(2) * np.sin(2 * np.pi * 50 * np.arange(rows) / rate)
    return z


def corrupt(kind, size, columns, name, rng, record, others):
    """Changes `columns` in place; returns the columns that may be named, None where this kind cannot be done here."""
    if kind == "swap":
        return exchange(size, columns, name, rng)
    if kind in TOGETHER:
        return change_columns_together(kind, size, columns, name, rng, record["rate"], others)
    put(columns, name, changed_column(kind, size, columns[name][0], rng, record["rate"]))
    return [name]
