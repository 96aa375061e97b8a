#!/usr/bin/env python3
"""Median, mean and worst of a column of a campaign's table.csv, as a markdown table.

  tools/campaign_table.py out/hand_over/table.csv --rows scenario --columns kind --of bearing_orbit
"""
import argparse
import collections
import csv
import statistics


def rows_of(table):
    """The rows of a table.csv, by the names of the columns without their units."""
    with open(table) as file:
        return [{key.split(" [")[0]: value for key, value in row.items()} for row in csv.DictReader(file)]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table")
    parser.add_argument("--rows", required=True)
    parser.add_argument("--columns", required=True)
    parser.add_argument("--of", required=True)
    parser.add_argument("--factor", type=float, default=1e6, help="e.g. 1e6: metres to um")
    options = parser.parse_args()
    values = collections.defaultdict(list)
    for row in rows_of(options.table):
        if row[options.of]:
            values[row[options.rows], row[options.columns]].append(
                options.factor * float(row[options.of]))
    columns = sorted({column for _, column in values})
    names = {row: statistics.fmean(values[row, columns[0]]) for row, _ in values}
    print(f"| {options.rows} | " + " | ".join(f"{c}: median, mean, worst" for c in columns) + " |")
    print("|---" * (len(columns) + 1) + "|")
    for name in sorted(names, key=names.get):
        cells = [values[name, column] for column in columns]
        print(f"| {name} | " + " | ".join(
            f"{statistics.median(c):.1f}, {statistics.fmean(c):.1f}, {max(c):.1f}" for c in cells)
            + " |")


if __name__ == "__main__":
    main()
