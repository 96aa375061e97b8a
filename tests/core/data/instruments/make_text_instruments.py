#!/usr/bin/env python3
"""Writes lvm_*.lvm, uff_units.uff, uff_latin1.uff and uff_binary_double.uff, which tests/core/record/formats read.

    python3 make_text_instruments.py       # in this folder; needs nothing beside Python

LVM: "Specification for the LabVIEW Measurement File" of National Instruments. UFF: "Universal Dataset Number 58". The signals
are x(k) = sin(0.3 k) and y(k) = k - 2.5, so that the tests know them without these files.
"""
import math
import struct

X = [math.sin(0.3 * k) for k in range(13)]
Y = [k - 2.5 for k in range(13)]


def lvm_head(mark, multi_headings, columns):
    return ["LabVIEW Measurement\t", "Writer_Version\t2", "Reader_Version\t2", "Separator\tTab", f"Decimal_Separator\t{mark}",
            f"Multi_Headings\t{multi_headings}", f"X_Columns\t{columns}", "Time_Pref\tAbsolute", "Operator\tambrig", "Date\t2024/05/01",
            f"Time\t12:00:00{mark}25", "***End_of_Header***\t", "\t"]


def write(name, lines, encoding="utf-8", end="\n"):
    with open(name, "wb") as f:
        f.write((end.join(lines) + end).encode(encoding))


def write_lvm_comma():
    """Decimal comma, no column of times."""
    lines = lvm_head(",", "Yes", "No")
    lines += ["Channels\t2\t\t", "Samples\t10\t10\t", "Date\t2024/05/01\t2024/05/01\t", "Time\t12:00:00,25\t12:00:00,25\t",
              "Y_Unit_Label\tNewtons\tm/s^2\t", "X_Dimension\tTime\tTime\t", "X0\t0,0000000000000000E+0\t0,0000000000000000E+0\t",
              "Delta_X\t1,250000E-4\t1,250000E-4\t", "***End_of_Header***\t\t\t", "X_Value\tLoad cell (left)\tCasing\tComment"]
    lines += [f"\t{X[k]:.6f}\t{Y[k]:.6f}".replace(".", ",") for k in range(10)]
    write("lvm_comma.lvm", lines)


def write_lvm_multi():
    """A column of times for every channel."""
    lines = lvm_head(".", "Yes", "Multi")
    lines += ["Channels\t2\t\t\t", "Samples\t3\t\t3\t", "Date\t2024/05/01\t\t2024/05/01\t", "Time\t12:00:00.25\t\t12:00:00.25\t",
              "Y_Unit_Label\tVolts\t\tg\t", "X_Dimension\tTime\t\tTime\t", "X0\t0.0E+0\t\t0.0E+0\t",
              "Delta_X\t1.953125E-5\t\t1.953125E-5\t", "***End_of_Header***\t\t\t\t", "X_Value\tSupply\tX_Value\tFoot\tComment"]
    lines += [f"{1.953125e-5 * k:.6E}\t{X[k]:.6f}\t{1.953125e-5 * k:.6E}\t{Y[k]:.6f}" for k in range(3)] + [""]
    write("lvm_multi.lvm", lines)


def write_lvm_empty_fields():
    """Four channels without rows between three with."""
    names = ["Rack0/Ai0", "Rack0/Ai2", "Untitled", "Untitled 1", "Untitled 2", "Untitled 3", "Rack0/Ai0 1"]
    full = [True, True, False, False, False, False, True]
    row = lambda key, cells: key + "\t" + "\t".join(cells)
    lines = lvm_head(".", "No", "One")
    lines += ["Notes\tonly the first is calibrated", "Channels\t7", row("Samples", ["7" if f else "0" for f in full]),
              row("Date", ["2024/05/01"] * 7), row("Time", ["12:00:00.25"] * 7), row("X_Dimension", ["Time"] * 7), row("X0", ["0.0E+0"] * 7),
              row("Delta_X", ["0.001000" if f else "1.000000" for f in full]), "***End_of_Header***", row("X_Value", names + ["Comment"])]
    for k in range(7):
        cells = [f"{X[k]:.6f}", f"{Y[k]:.6f}", "", "", "", "", f"{X[k]:.6f}"]
        lines.append(f"{0.001 * k:.6f}\t" + "\t".join(cells))
    write("lvm_empty_fields.lvm", lines)


def write_lvm_uneven():
    """Times as they came, comments in the last column, a name beyond ASCII."""
    lines = lvm_head(".", "No", "One")
    lines += ["Channels\t2\t\t", "Samples\t1\t1\t", "Date\t2024/05/01\t2024/05/01\t", "Time\t12:00:00.25\t12:00:00.25\t",
              "Y_Unit_Label\tMPa\t°C\t", "X_Dimension\tTime\tTime\t", "X0\t0.0E+0\t0.0E+0\t", "Delta_X\t1.000000\t1.000000\t",
              "***End_of_Header***\t\t\t", "X_Value\tÖldruck (MPa)\tLager (°C)\tComment"]
    times = [0, 0.25, 1.25, 1.5, 2]
    lines += [f"{t:.6f}\t{X[k]:.6f}\t{Y[k]:.6f}\t{'lost' if k == 2 else 'ok'}" for k, t in enumerate(times)]
    write("lvm_uneven.lvm", lines)


def uff_axis(kind, label, unit):
    return f"{kind:10d}{0:5d}{0:5d}{0:5d} {label:<20} {unit:<20}"


def uff(number, name, kind, form, axes):
    ordinate, points, dx = form
    return ["    -1", number, name, "NONE", "01-May-24 12:00:00", "NONE", "NONE",
            f"{kind:5d}{0:10d}{0:5d}{0:10d} {'NONE':<10}{0:10d}{0:4d} {'NONE':<10}{0:10d}{0:4d}",
            f"{ordinate:10d}{points:10d}{1:10d}{0:13.5E}{dx:13.5E}{0:13.5E}"] + [uff_axis(*a) for a in axes]


TIME, NONE = (17, "Time", "s"), (0, "NONE", "NONE")


def write_uff_units():
    """A last line of numbers that is not full, a unit in UTF-8."""
    lines = uff("    58", "casing", 1, (2, 13, 5e-5), [TIME, (1, "casing", "m/s²"), NONE, NONE])
    lines += ["".join(f"{v:13.5E}" for v in X[k:k + 6]) for k in (0, 6, 12)] + ["    -1"]
    write("uff_units.uff", lines)


def write_uff_latin1():
    """A frequency response whose unit is written in Latin-1."""
    lines = uff("    58", "blow", 4, (5, 6, 0.25), [(18, "NONE", "Hz"), (1, "Frequency Function", "(1/N)*(m/s²)"), NONE, NONE])
    pairs = [v for k in range(6) for v in (X[k], Y[k])]
    lines += ["".join(f"{v:13.5E}" for v in pairs[k:k + 6]) for k in (0, 6)] + ["    -1"]
    write("uff_latin1.uff", lines, "latin-1")


def write_uff_binary_double():
    """58b, little endian, 5 Hz in double precision; the stated size is that of single precision, as some programs write it."""
    lines = uff(f"    58b{1:6d}{2:6d}{11:12d}{1000:12d}{0:6d}{0:6d}{0:12d}{0:12d}", "sine 5 Hz", 1, (4, 250, 0.01),
                [TIME, (12, "casing", "g"), NONE, NONE])
    data = b"".join(struct.pack("<d", math.sin(0.1 * math.pi * k)) for k in range(250))
    with open("uff_binary_double.uff", "wb") as f:
        f.write(("\r\n".join(lines) + "\r\n").encode() + data + b"\r\n    -1\r\n")


for make in (write_lvm_comma, write_lvm_multi, write_lvm_empty_fields, write_lvm_uneven, write_uff_units, write_uff_latin1,
             write_uff_binary_double):
    make()
