#!/usr/bin/env python3
"""How campaigns ended, kind of fault by kind of fault, as a markdown table.

  tools/campaign_faults.py out/single_coils out/survival
"""
import argparse
import collections
import pathlib
import statistics

from campaign_table import rows_of

HEAD = ("campaign", "fault", "runs: up, touched and rose, dropped", "faults detected, rightly classified, of all",
        "delay of the slowest coil: least, median, most", "false alarms in healthy coil-periods", "largest orbit")


def numbers(rows, column):
    return [float(row[column]) for row in rows if row[column]]


def duration(seconds):
    return f"{seconds * 1e6:.0f} µs" if seconds < 1e-3 else f"{seconds * 1e3:.3g} ms"


def line(campaign, kind, rows):
    ended = collections.Counter(row["verdict"] for row in rows)
    judged, detected, right = (int(sum(numbers(rows, c))) for c in ("judged", "detected", "right_class"))
    delays = numbers(rows, "detection_delay")
    up = [row for row in rows if row["verdict"] == "up"]
    return (f"`{campaign}`", kind,
            f"{len(rows)}: {ended['up']}, {ended['touchdown']}, {ended['drop']}",
            f"{detected}, {right} of {judged}" if judged else "-",
            ", ".join(map(duration, (min(delays), statistics.median(delays), max(delays)))) if delays else "-",
            f"{int(sum(numbers(rows, 'false_alarms')))} in {sum(numbers(rows, 'coil_periods')):.1e}".replace("e+0", "e"),
            f"{1e6 * max(numbers(up, 'peak_orbit')):.1f} µm" if up else "-")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("campaigns", nargs="+", help="folders that ambrig campaign wrote")
    print("| " + " | ".join(HEAD) + " |\n" + "|---" * len(HEAD) + "|")
    for folder in map(pathlib.Path, parser.parse_args().campaigns):
        rows = rows_of(folder / "table.csv")
        for kind in dict.fromkeys(row["kind"] for row in rows):
            print("| " + " | ".join(line(folder.name, kind, [r for r in rows if r["kind"] == kind])) + " |")


if __name__ == "__main__":
    main()
