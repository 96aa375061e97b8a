#!/usr/bin/env python3
"""Writes the files of instruments that tests/core/record/formats read, from the published formats and not from the readers.

    python3 make_instruments.py            # in this folder; needs numpy and scipy (scipy.io.savemat)

UFF: "Universal Dataset Number 58" of the I-DEAS specification. TDMS: "TDMS File Format Internal Structure" of National
Instruments. MAT: scipy.io; the opaque object by hand after "MAT-File Format" of MathWorks. The signals are
x(k) = sin(0.3 k) and y(k) = k - 2.5 throughout, so that the tests know them without these files.
"""
import math
import struct

import numpy as np
from scipy.io import savemat

N = 10
X = [math.sin(0.3 * k) for k in range(N)]
Y = [k - 2.5 for k in range(N)]


def e13(v):
    return f"{v:13.5E}"


def e20(v):
    return f"{v:20.12E}"


def uff_axis(kind, label, unit):
    return f"{kind:10d}{0:5d}{0:5d}{0:5d} {label:<20} {unit:<20}"


def uff_head(name, kind, dof, form, axes, number="58"):
    ordinate, points, even, x0, dx = form
    response, node, direction, reference, ref_node, ref_direction = dof
    lines = ["    -1", number, name, "NONE", "30-Apr-20 19:12:52", "NONE", "NONE",
             f"{kind:5d}{0:10d}{0:5d}{0:10d} {response:<10}{node:10d}{direction:4d} {reference:<10}{ref_node:10d}{ref_direction:4d}",
             f"{ordinate:10d}{points:10d}{even:10d}{e13(x0)}{e13(dx)}{e13(0)}"]
    return lines + [uff_axis(*a) for a in axes]


TIME = (17, "Time", "s")
NONE = (0, "NONE", "NONE")


def uff_columns(cells, per_line):
    return ["".join(cells[k:k + per_line]) for k in range(0, len(cells), per_line)]


def write_uff_ascii():
    """Two time responses of single and double precision, an uneven one, a frequency response of each precision."""
    out = ["    -1", "   151", "skipped data set", "    -1"]
    axes = [TIME, (8, "Displacement", "um"), NONE, NONE]
    out += uff_head("shaft x", 1, ("A.x", 5, 1, "NONE", 0, 0), (2, N, 1, 0.5, 1 / 3000), axes, "    58")
    out += uff_columns([e13(v) for v in X], 6) + ["    -1"]
    axes = [TIME, (13, "Current", "A"), NONE, NONE]
    out += uff_head("coil", 1, ("A.i1", 6, -2, "NONE", 0, 0), (4, N, 1, 0.5, 1 / 3000), axes, "    58")
    out += uff_columns([e20(v) for v in Y], 4) + ["    -1"]
    out += uff_head("uneven", 1, ("B.x", 7, 3, "NONE", 0, 0), (4, N, 0, 0, 0), [TIME, (8, "d", "um"), NONE, NONE], "    58")
    out += uff_columns([c for k in range(N) for c in (e13(0.5 + k / 1500), e20(X[k]))], 4) + ["    -1"]
    for ordinate, name in ((5, "H1"), (6, "H2")):
        axes = [(18, "Frequency", "Hz"), (8, "d", "m"), (13, "f", "N"), NONE]
        out += uff_head(name, 4, ("A.x", 5, 1, name, 9, 2), (ordinate, N, 1, 10, 2.5), axes, "    58")
        values = [v for k in range(N) for v in (X[k], Y[k])]
        out += uff_columns([(e13 if ordinate == 5 else e20)(v) for v in values], 6 if ordinate == 5 else 4) + ["    -1"]
    open("uff_ascii.unv", "w").write("\n".join(out) + "\n")


def write_uff_binary(name, order, double, with_complex, even):
    """Functions of one kind; the bytes of complex ones are stated as those of real ones, as a common writer does."""
    mark, size = ("<" if order == 1 else ">"), (8 if double else 4)
    letter = "d" if double else "f"
    ordinate = (6 if double else 5) if with_complex else (4 if double else 2)
    kind = f"    58b{order:6d}{2:6d}{11:12d}{size * N:12d}{0:6d}{0:6d}{0:12d}{0:12d}"
    data = b""
    for k in range(N):
        if not even:
            data += struct.pack(mark + "f", 1.0 + k / 1000)
        data += struct.pack(mark + letter, X[k])
        if with_complex:
            data += struct.pack(mark + letter, Y[k])
    axis = (18, "Frequency", "Hz") if with_complex else TIME
    head = uff_head("binary", 4 if with_complex else 1, ("A.x", 5, 1, "NONE", 0, 0), (ordinate, N, int(even), 1.0 if even else 0,
                    0.001 if even else 0), [axis, (8, "d", "m"), NONE, NONE], kind)
    open(name, "wb").write("\r\n".join(head).encode() + b"\r\n" + data + b"\r\n    -1\r\n")


class Tdms:
    """Segments by hand: objects are (path, raw index, properties)."""
    NO_DATA, SAME = 0xffffffff, 0

    def __init__(self, big=False):
        self.big, self.bytes = big, b""

    def n(self, letter, v):
        return struct.pack((">" if self.big else "<") + letter, v)

    def text(self, s):
        return self.n("I", len(s.encode())) + s.encode()

    def value(self, v):
        if isinstance(v, str):
            return self.n("I", 0x20) + self.text(v)
        if isinstance(v, int):
            return self.n("I", 7) + self.n("I", v)
        return self.n("I", 10) + self.n("d", v)

    def objects(self, rows):
        out = self.n("I", len(rows))
        for path, index, properties in rows:
            out += self.text(path)
            if isinstance(index, int):
                out += self.n("I", index)
            else:
                kind, count = index
                out += self.n("I", 20) + self.n("I", kind) + self.n("I", 1) + self.n("Q", count)
            out += self.n("I", len(properties))
            for k, v in properties.items():
                out += self.text(k) + self.value(v)
        return out

    def segment(self, meta, raw, new_list=True, interleaved=False, daqmx=False, unfinished=False):
        toc = (2 if meta is not None else 0) | (4 if new_list else 0) | (8 if raw else 0)
        toc |= (32 if interleaved else 0) | (64 if self.big else 0) | (128 if daqmx else 0)
        meta = meta or b""
        length = 0xffffffffffffffff if unfinished else len(meta) + len(raw)
        self.bytes += b"TDSm" + struct.pack("<I", toc) + self.n("I", 4713) + self.n("Q", length) + self.n("Q", len(meta)) + meta + raw

    def array(self, letter, values):
        return b"".join(self.n(letter, v) for v in values)

    def save(self, name):
        open(name, "wb").write(self.bytes)


WAVE = {"wf_increment": 0.001, "wf_start_offset": 0.25}
AX, I1 = "/'bench'/'A.x'", "/'bench'/'A.i1'"


def write_tdms_incremental(name, big):
    """Four segments: a full list, no metadata, one object changed, a new list in which one object is as before."""
    t = Tdms(big)
    meta = t.objects([("/", t.NO_DATA, {"title": "run"}), ("/'bench'", t.NO_DATA, {}), (AX, (10, 2), {**WAVE, "unit_string": "um"}),
                      (I1, (2, 2), {**WAVE, "unit_string": "A", "NI_Number_Of_Scales": 1, "NI_Scale[0]_Scale_Type": "Linear",
                                    "NI_Scale[0]_Linear_Slope": 0.5, "NI_Scale[0]_Linear_Y_Intercept": -2.5,
                                    "NI_Scale[0]_Linear_Input_Source": 0xffffffff})])
    def counts(a, b):
        return t.array("h", [2 * k for k in range(a, b)])  # y = 0.5 * 2 k - 2.5
    # Two chunks in the first segment.
    t.segment(meta, t.array("d", X[0:2]) + counts(0, 2) + t.array("d", X[2:4]) + counts(2, 4))
    t.segment(None, t.array("d", X[4:6]) + counts(4, 6), new_list=False)
    t.segment(t.objects([(AX, (10, 3), {})]) , t.array("d", X[6:9]) + counts(6, 8), new_list=False)
    t.segment(t.objects([(I1, t.SAME, {})]), counts(8, 10))
    t.segment(t.objects([(AX, (10, 1), {}), (I1, t.NO_DATA, {})]), t.array("d", X[9:10]), new_list=False)
    t.save(name)


def write_tdms_interleaved():
    t = Tdms()
    meta = t.objects([(AX, (9, N), WAVE), (I1, (10, N), WAVE)])
    t.segment(meta, b"".join(t.n("f", X[k]) + t.n("d", Y[k]) for k in range(N)), interleaved=True)
    t.save("tdms_interleaved.tdms")


def write_tdms_stopped():
    """The writer was killed in its second segment, within a row."""
    t = Tdms()
    t.segment(t.objects([(AX, (10, 4), WAVE), (I1, (10, 4), WAVE)]), t.array("d", X[:4]) + t.array("d", Y[:4]))
    t.segment(None, b"".join(t.n("d", X[k]) + t.n("d", Y[k]) for k in range(4, 6)) + b"\0\0\0", new_list=False, interleaved=True,
              unfinished=True)
    t.save("tdms_stopped.tdms")


def write_tdms_daqmx():
    t = Tdms()
    meta = t.objects([(AX, 0x1269, {})])
    t.segment(meta, t.array("h", range(4)), daqmx=True)
    t.save("tdms_daqmx.tdms")


def write_tdms_times():
    """No wave-form properties, but a channel of time stamps; a channel of another rate."""
    t = Tdms()
    def stamp(k):
        fraction = int((0.75 + k / 1000) % 1 * 2**64)
        return t.n("Q", fraction) + t.n("q", 3800000000 + int(0.75 + k / 1000))
    k = 300  # crosses a full second
    raw = b"".join(stamp(j) for j in range(k)) + t.array("d", [float(j) for j in range(k)]) + t.array("d", Y)
    t.segment(t.objects([("/'log'/'Time'", (0x44, k), {}), ("/'log'/'bus'", (10, k), {"unit_string": "V"}),
                         ("/'slow'/'bus'", (10, N), {})]), raw)
    t.save("tdms_times.tdms")


def structs(fields, rows):
    out = np.zeros((1, len(rows)), dtype=[(f, object) for f in fields])
    for k, row in enumerate(rows):
        for f, v in zip(fields, row):
            out[0, k][f] = v
    return out


def write_mat():
    t = np.arange(N) / 1000.0
    y_fields = ["Name", "Path", "Unit", "XIndex", "Data"]
    dspace = {"X": structs(["Name", "Data"], [("", t[None, :]), ("slow", np.arange(4)[None, :] / 10.0)]),
              "Y": structs(y_fields, [('"Model Root"/"AMB"/"A.x"', "Model Root", "um", 1, np.array(X)[None, :]),
                                      ('"Model Root"/"AMB"/"A.i1"', "Model Root", "A", 1, np.array(Y)[None, :].astype("f4")),
                                      ('"Model Root"/"slow"', "Model Root", "", 2, np.zeros((1, 4)))]),
              "Description": "", "RTProgram": "amb.sdf", "Capture": structs(["Version"], [(1,)])}
    savemat("mat_dspace.mat", {"run_07": dspace}, do_compression=True)
    simout = {"time": t[:, None], "signals": structs(["values", "dimensions", "label"],
              [(np.array(X)[:, None], 1, "A.x"), (np.column_stack([Y, X]), 2, "")]), "blockName": "rig/To Workspace"}
    savemat("mat_simulink.mat", {"simout": simout, "tout": t[:, None], "load": np.array(Y)[:, None]})
    three = np.array(X).reshape(1, 1, N)
    savemat("mat_timeseries_struct.mat", {"ts": {"Time": t[:, None], "Data": np.array(Y)[:, None], "Name": "y"},
                                          "deep": {"Time": t[:, None], "Data": three}})
    write_opaque()


def element(kind, data):
    return struct.pack("<II", kind, len(data)) + data + b"\0" * (-len(data) % 8)


def write_opaque():
    """A timeseries as MATLAB saves it: a matrix of class 17 with its names and an array of identifiers."""
    def matrix(cls, name, rest):
        return element(14, element(6, struct.pack("<II", cls, 0)) + name + rest)
    ids = matrix(13, element(5, struct.pack("<ii", 6, 1)) + element(1, b""), element(6, struct.pack("<6I", 0xdd000000, 2, 1, 1, 1, 1)))
    opaque = matrix(17, element(1, b"ts"), element(1, b"MCOS") + element(1, b"timeseries") + ids)
    head = b"MATLAB 5.0 MAT-file".ljust(116) + struct.pack("<Q", 0) + b"\x00\x01IM"
    open("mat_object.mat", "wb").write(head + opaque)
    plain = matrix(6, element(5, struct.pack("<ii", 3, 1)) + element(1, b"A_x"), element(9, struct.pack("<3d", 1, 2, 3)))
    rate = matrix(6, element(5, struct.pack("<ii", 1, 1)) + element(1, b"rate"), element(9, struct.pack("<d", 1000)))
    open("mat_object_beside.mat", "wb").write(head + opaque + plain + rate)


if __name__ == "__main__":
    write_uff_ascii()
    for order, double, with_complex, even in ((1, False, False, True), (2, True, False, True), (2, False, True, True),
                                              (1, True, True, True), (1, True, False, False), (2, False, False, False)):
        name = f"uff_{'little' if order == 1 else 'big'}_{'double' if double else 'single'}" \
               f"{'_complex' if with_complex else ''}{'' if even else '_uneven'}.uff"
        write_uff_binary(name, order, double, with_complex, even)
    write_tdms_incremental("tdms_little.tdms", False)
    write_tdms_incremental("tdms_big.tdms", True)
    write_tdms_interleaved()
    write_tdms_stopped()
    write_tdms_daqmx()
    write_tdms_times()
    write_mat()
