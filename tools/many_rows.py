#!/usr/bin/env python3
"""Journals of a campaign of many runs, made from the rows of a few: to measure resuming, merging and the report at any size.

  ambrig campaign FILE -o few --shard 1/250
  tools/many_rows.py few --out half1 half2              # all runs of the campaign, shared among two shards
  tools/many_rows.py few --out all --runs 100000        # as if the campaign had so many (merge and report only)

A run without a row gets that of the run before it which has one, with its own number and with other last digits of its orbits.
"""
import argparse
import json
import pathlib

MASK = (1 << 64) - 1


def line(text):
    """As core/base/journal.h has it: the text and its check sum, FNV-1a of 64 bits."""
    check = 0xCBF29CE484222325
    for byte in text.encode():
        check = (check ^ byte) * 0x100000001B3 & MASK
    return f"{text}\t{check:016x}\n"


ORBITS = ["peak_orbit [m]", "bearing_orbit [m]", "late_orbit [m]"]


def cells_of(cells, run, orbits):
    """The cells of another run: its number, and orbits (their columns) that differ from its neighbours'."""
    changed = [str(run), *cells[1:]]
    for k in orbits:
        changed[k] = f"{float(cells[k]) * (1 + 1e-6 * (run % 9973)):.16g}" if cells[k] else ""
    return changed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("few", type=pathlib.Path, help="folder of a campaign that has run 0")
    parser.add_argument("--out", type=pathlib.Path, nargs="+", required=True, help="folders to make, one a shard")
    parser.add_argument("--runs", type=int, help="of the whole campaign (default: as in the folder)")
    options = parser.parse_args()
    head, *texts = [text.rsplit("\t", 1)[0] for text in (options.few / "journal.txt").read_text().splitlines()]
    header = json.loads(head)
    header["runs"] = options.runs or header["runs"]
    with (options.few / "table.csv").open() as table:
        columns = table.readline().strip().split(",")
    orbits = [columns.index(name) for name in ORBITS]
    rows = {int(text.split(",", 1)[0]): text.split(",") for text in texts}
    shards = [[line(json.dumps(header, separators=(",", ":"), ensure_ascii=False))] for _ in options.out]
    cells = rows[0]
    for run in range(header["runs"]):
        cells = rows.get(run, cells)
        shards[run % len(shards)].append(line(",".join(cells_of(cells, run, orbits))))
    for folder, lines in zip(options.out, shards):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "journal.txt").write_text("".join(lines))


if __name__ == "__main__":
    main()
