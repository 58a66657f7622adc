"""Files of other programs with faults: what imports them names the file and the place, and leaves nothing behind."""

import io
import struct
import zipfile
import zlib

import numpy as np
import scipy.io

import nastran_files

ONE = np.eye(2)


def row(name, form, files, *fragments, arguments=None):
    """`files`: content by name; a function takes the path. They are the arguments unless others are given."""
    return name, form, files, tuple(files) if arguments is None else arguments, fragments


def edited(content, old, new):
    assert content.count(old) >= 1, old
    return content.replace(old, new, 1)


def half(content):
    return content[:len(content) // 2]


# OpenFAST

LIN = """\
Simulation information:
   Rotor Speed:                         0.7301 rad/s
   Azimuth:                             0.0067 rad
   Wind Speed:                          3.0000 m/s

Order of continuous states:
   Row/Column Operating Point Rotating Frame? Derivative Order Description
          1    2.8E-002       F               2                ED 1st tower fore-aft bending mode DOF, m
          2    1.5E+000       F               2                ED First time derivative of 1st tower fore-aft bending mode DOF, m/s

A: 2 x 2
 0.000E+00  1.000E+00
-2.500E+00 -1.000E-01
"""


def lin(name, old, new, *fragments):
    return row(f"lin with {name}", "openfast", {"a.lin": edited(LIN, old, new)}, "a.lin:", *fragments)


OPENFAST = [
    row("lin of no bytes", "openfast", {"a.lin": ""}, "a.lin:", "no table 'Order of continuous states'"),
    row("lin that is gone", "openfast", {}, "a.lin: no such file", arguments=["a.lin"]),
    row("lin that is a folder", "openfast", {"a.lin": lambda path: path.mkdir()}, "a.lin: is a folder"),
    row("lin cut within A", "openfast", {"a.lin": LIN[:-24]}, "a.lin:12: ", "the file ends before row 2 of A"),
    row("lin cut in a number of A", "openfast", {"a.lin": LIN[:-20]}, "a.lin:13: row 2 of A has 1 numbers"),
    row("lin that is binary", "openfast", {"a.lin": bytes(range(256)) * 40}, "a.lin:", "Order of continuous states"),
    row("lin in place of which there is a zip", "openfast", {"a.lin": b"PK\x03\x04" + bytes(100)}, "a.lin:"),
    row("lin of one line without end", "openfast", {"a.lin": "A: " * 100000}, "a.lin:1: expected 'A: n x n'"),
    row("two lin with different states", "openfast", {"a.lin": LIN, "b.lin": edited(LIN, "ED 1st", "ED 2nd")}, "b.lin:",
        "has no state 'ED 1st tower"),
    row("two lin of one azimuth", "openfast", {"a.lin": LIN, "b.lin": LIN}, "b.lin: ", "give each azimuth once"),
    lin("nan", "-2.500E+00", "NaN", "row 2 of A: expected a number, found 'NaN'"),
    lin("stars", "-2.500E+00", "**********", "found '**********'"),
    row("lin with a parameter that is no number", "openfast", {"a.lin": edited(LIN, "2.8E-002", "NaN")},
        "a.lin: --parameter: the operating value of 'ED 1st tower fore-aft", arguments=["a.lin", "--parameter", "1st tower"]),
    lin("a huge matrix", "2 x 2", "100000 x 100000", "expected 'A: n x n' with n up to 5000"),
    lin("a matrix of no size", "2 x 2", "0 x 0", "expected 'A: n x n'"),
    lin("a negative size", "2 x 2", "-2 x -2", "expected 'A: n x n'"),
    lin("a matrix too large for its rows", "2 x 2", "3 x 3", "row 1 of A has 2 numbers; expected 3"),
    lin("speed in words", "0.7301", "fast", "expected a number"),
    lin("a speed that is no number", "0.7301", "nan", "2: expected a number and its unit"),
    lin("a speed beyond all numbers", "0.7301", "1e999", "2: expected a number and its unit"),
    lin("speed in other units", "0.7301 rad/s", "0.7301 furlongs", "expected a number in rad/s, found furlongs"),
    lin("a state twice", "First time derivative of 1st tower fore-aft bending mode DOF, m/s", "1st tower fore-aft bending mode DOF, m",
        "lists the state"),
]

# Matrix Market

BANNER = "%%MatrixMarket matrix coordinate real general\n"
GOOD = BANNER + "2 2 2\n1 1 1\n2 2 1\n"
MTX = {"M0.mtx": GOOD, "K0.mtx": GOOD}


def mtx(name, content, *fragments):
    return row(f"mtx {name}", "matrix-market", {**MTX, "K1.mtx": content}, "K1.mtx:", *fragments)


def table(name, content, *fragments):
    return row(f"table {name}", "matrix-market", {**MTX, "t.csv": content}, *fragments, arguments=["t.csv"])


MATRIX_MARKET = [
    mtx("of no bytes", "", "expected '%%MatrixMarket"),
    mtx("that is binary", bytes(range(256)) * 10, "1: expected '%%MatrixMarket"),
    mtx("that is a comma-separated table", "1,0\n0,1\n", "1: expected '%%MatrixMarket"),
    mtx("without sizes", BANNER, "ends before the line with the sizes"),
    mtx("cut short", GOOD[:-6], "3: the file ends after 1 of 2 entries"),
    mtx("cut in an entry", GOOD[:-3], "4: expected 3 numbers, found 2"),
    mtx("with an entry too many", GOOD + "1 2 1\n", "5: more lines than the 2 entries"),
    mtx("with nan", edited(GOOD, "2 2 1\n", "2 2 nan\n"), "4: expected a finite number, found 'nan'"),
    mtx("with infinity", edited(GOOD, "2 2 1\n", "2 2 inf\n"), "expected a finite number"),
    mtx("with a number beyond all", edited(GOOD, "2 2 1\n", "2 2 1e999\n"), "expected a finite number"),
    mtx("with a row beyond the last", edited(GOOD, "1 1 1", "3 1 1"), "3: expected a row from 1 to 2, found '3'"),
    mtx("with a column before the first", edited(GOOD, "1 1 1", "1 0 1"), "expected a column from 1 to 2"),
    mtx("with huge sizes", BANNER + "9000000 9000000 1\n1 1 1\n", "2: the matrix is 9000000 x 9000000"),
    mtx("with sizes of another one", BANNER + "1000000 1000000 1\n1 1 1\n", "the matrix is 1000000 x 1000000; expected 2 x 2"),
    mtx("with sizes beyond all numbers", BANNER + "99999999999999999999 1 1\n", "2: expected a size"),
    mtx("with very many entries", BANNER + "5000 5000 9000000000000000000\n1 1 1\n", "more than the file has room for"),
    mtx("of an array without numbers", "%%MatrixMarket matrix array real general\n5000 5000\n", "more than the file has room for"),
    mtx("of another size", BANNER + "3 3 1\n1 1 1\n", "the matrix is 3 x 3; expected 2 x 2, as in M0.mtx"),
    mtx("that is not square", BANNER + "2 3 1\n1 1 1\n", "the matrix is 2 x 3; expected 2 x 2"),
    mtx("that is complex", "%%MatrixMarket matrix array complex general\n1 1\n1 2\n", "3: the matrix is complex"),
    mtx("of a kind that there is not", edited(GOOD, "real", "octonion"), "1: expected real, double"),
    mtx("with a symmetry that there is not", edited(GOOD, "general", "round"), "1: expected general, symmetric"),
    row("mtx by a name that says nothing", "matrix-market", {"a.mtx": GOOD}, "a.mtx: the name does not say which matrix"),
    row("mtx without stiffness", "matrix-market", {"M0.mtx": GOOD}, "expected K with M, C or both"),
    table("of no bytes", "", "t.csv:", "no table"),
    table("without rows", "p,M,K\n", "t.csv:1: the table has no rows"),
    table("that is binary", bytes(range(256)), "t.csv:1: "),
    table("with a value that is no number", "p,M,K\nnan,M0.mtx,K0.mtx\n", "t.csv:2: expected a value of p"),
    table("with a value twice", "p,M,K\n1,M0.mtx,K0.mtx\n1,M0.mtx,K0.mtx\n", "t.csv:3: the value 1 of p is there already"),
    table("with a file that is gone", "p,M,K\n1,M0.mtx,none.mtx\n", "none.mtx: no such file"),
    table("with itself as a matrix", "p,A\n1,t.csv\n", "t.csv:1: expected '%%MatrixMarket"),
    table("with a column of another name", "p,Q\n1,M0.mtx\n", "t.csv: column 'Q'"),
    table("of mass only", "p,M\n1,M0.mtx\n", "t.csv: expected A (and optionally E), or K"),
]

# Nastran

OP4 = nastran_files.op4_text({"MAA": ONE, "KAA": ONE})
BINARY = nastran_files.op4_binary({"MAA": ONE, "KAA": ONE})
PCH = nastran_files.dmig({"MAAX": ONE, "KAAX": ONE})
FREE = "DMIG,M,0,1,2\nDMIG,M,1,1,,1,1,1.0\nDMIG,K,0,1,2\nDMIG,K,1,1,,1,1,1.0\n"


def op4(name, content, *fragments):
    return row(f"op4 {name}", "nastran", {"a.op4": content}, "a.op4:", *fragments)


def pch(name, content, *fragments):
    return row(f"pch {name}", "nastran", {"a.pch": content}, "a.pch:", *fragments)


def header(columns, rows, form=1, kind=2):
    return struct.pack("<i4i8si", 24, columns, rows, form, kind, b"KAA     ", 24)


NASTRAN = [
    op4("of no bytes", "", "is empty"),
    op4("that is a scene", "title = 'x'\n", "1: expected a whole number in columns 1 to 8"),
    op4("as text cut short", OP4[:-60], "cut short"),
    op4("as text cut after its header", OP4[:OP4.index("\n") + 1], "the file ends within matrix MAA"),
    op4("as text with nan", edited(OP4, " 1.0000000000000000E+00", "                    NaN"), "3: expected a finite number"),
    op4("as text with stars", edited(OP4, " 1.0000000000000000E+00", "*" * 23), "3: expected a finite number"),
    op4("as text with more numbers than rows", edited(OP4, "       1       1       2", "       1       2       2"),
        "2: 2 numbers from row 2 on"),
    op4("as text with very many numbers", edited(OP4, "       1       1       2", "       1       199999999"), "2: "),
    op4("as text with huge sizes", edited(OP4, "       2       2       1", "99999999" * 2 + "       1"),
        "8: column 2 of matrix MAA follows column 3 of 99999999"),
    op4("as text with a format that there is not", edited(OP4, "1P,3E23.16", "1P,3Z23.16"), "1: expected a format"),
    op4("of one matrix", nastran_files.op4_text({"MAA": ONE}), "no stiffness; found MAA"),
    op4("of complex matrices", edited(OP4, "       1       2MAA", "       1       4MAA"), "matrix MAA is complex"),
    op4("in binary form cut short", BINARY[:-60], "cut short"),
    op4("in binary form without its last byte", BINARY[:-1], "cut short"),
    op4("in binary form with nan", edited(BINARY, struct.pack("<d", 1.0), struct.pack("<d", np.nan)),
        "matrix MAA, column 1: row 1 is not finite"),
    op4("in binary form with another length behind a record", BINARY[:28] + b"\x19" + BINARY[29:], "in front and another one behind"),
    op4("in binary form with a record longer than the file", header(2, 2) + struct.pack("<4i", 2**31 - 1, 1, 1, 4),
        "cut short"),
    op4("in binary form with huge sizes", header(2**31 - 1, 2**31 - 1), "no header of a matrix"),
    op4("in binary form with large sizes", header(900000, 900000) + struct.pack("<i3idi", 20, 900001, 1, 2, 1.0, 20),
        "matrix KAA has 900000 rows; matrices of up to 5000"),
    op4("of zeros", bytes(1000), "is no file of Nastran's OUTPUT4"),
    op4("that is a zip", b"PK\x03\x04" + bytes(100), "is no file of Nastran's OUTPUT4"),
    pch("of no bytes", "", "has no matrices"),
    pch("without matrices", "GRID,1\nENDDATA\n", "has no matrices"),
    pch("that is binary without zeros", bytes(range(1, 256)) * 10, "has no matrices"),
    pch("of zeros", bytes(1000), "is no file of Nastran's OUTPUT4"),
    pch("with a number cut off", PCH[:-4], "matrix KAAX: expected a finite number, found '1.000000000D'"),
    pch("with nan", edited(FREE, "1,1,1.0", "1,1,nan"), "2: matrix M: expected a finite number, found 'nan'"),
    pch("with a number beyond all", edited(FREE, "1,1,1.0", "1,1,1e999"), "2: matrix M: expected a finite number"),
    pch("with a point that is no number", edited(FREE, "M,1,1,,1", "M,1,1,,one"), "2: expected the number of a point"),
    pch("with a point beyond all", edited(FREE, "M,1,1,,1", "M,1,1,,99999999999"), "2: expected the number of a point"),
    pch("with a component beyond the last", edited(FREE, "M,1,1", "M,1,9"), "2: expected a component from 0 to 6"),
    pch("with an entry twice", FREE + "DMIG,K,1,1,,1,1,2.0\n", "matrix K has two entries for row grid 1, T1"),
    pch("without a header", edited(FREE, "DMIG,M,0,1,2\n", ""), "1: matrix M has no header"),
    pch("with two headers", FREE + "DMIG,M,0,1,2\n", "5: matrix M has two headers"),
    pch("of complex matrices", edited(FREE, "M,0,1,2", "M,0,1,4"), "matrix M is complex (type 4)"),
    pch("of rectangular matrices", edited(FREE, "M,0,1,2", "M,0,9,2"), "matrix M has form 9"),
    pch("of more rows than can be solved",
        FREE + "".join(f"DMIG,K,{i},1,,{i},1,1.0\n" for i in range(2, 5002)), "the matrices have 5001 rows"),
    row("nastran of different points", "nastran", {"a.pch": FREE, "b.pch": FREE + "DMIG,K,2,1,,2,1,1.0\n"},
        "b.pch: has grid 2, T1, which a.pch lacks", arguments=["a.pch", "b.pch", "--values", "1,2"]),
]

# NumPy and MATLAB


def npz(**arrays):
    stream = io.BytesIO()
    np.savez(stream, **arrays)
    return stream.getvalue()


def zip_of(**entries):
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, content in entries.items():
            with archive.open(f"{name}.npy", "w") as entry:
                entry.writelines([content] if isinstance(content, bytes) else content)
    return stream.getvalue()


def npy(shape, data, kind="<f8"):
    text = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}\n".encode()
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text + data


def zeros(count):
    """As many bytes, in pieces that are the same."""
    return [bytes(1_000_000)] * (count // 1_000_000) + [bytes(count % 1_000_000)]


def archive(name, content, *fragments):
    return row(f"npz {name}", "numpy", {"a.npz": content}, "a.npz:", *fragments)


def mat(compress=False, form="5", **variables):
    stream = io.BytesIO()
    scipy.io.savemat(stream, variables, do_compression=compress, format=form)
    return stream.getvalue()


def matlab(name, content, *fragments):
    return row(f"mat {name}", "matlab", {"a.mat": content}, "a.mat:", *fragments)


def mat_of_zeros(rows, numbers, compress):
    """A variable A of rows x rows whose data have another number of zeros."""
    head = struct.pack("<2i", 6, 8) + struct.pack("<2I", 6, 0) + struct.pack("<4i", 5, 8, rows, rows)
    head += struct.pack("<2i8s2i", 1, 1, b"A", 9, 8 * numbers)
    pieces = [struct.pack("<2i", 14, len(head) + 8 * numbers) + head, *zeros(8 * numbers)]
    if compress:
        stream = zlib.compressobj(1)
        pieces = [*map(stream.compress, pieces), stream.flush()]
        pieces.insert(0, struct.pack("<2i", 15, sum(map(len, pieces))))
    return b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + b"".join(pieces)


NUMPY = [
    archive("of no bytes", b"", "cannot be read as an archive"),
    archive("that is text", "A = 1\n", "cannot be read as an archive"),
    archive("that is one array", npy("(2, 2)", ONE.tobytes()), "cannot be read as an archive"),
    archive("cut short", half(npz(A=ONE)), "cannot be read as an archive"),
    archive("without arrays", zip_of(), "no matrices"),
    archive("with an array cut short", zip_of(A=npy("(2, 2)", ONE.tobytes()[:-1])), "array A: has 31 bytes of data"),
    archive("with a header cut short", zip_of(A=npy("(2, 2)", b"")[:40]), "array A: ends within its header"),
    archive("with a text as an array", zip_of(A=b"1 0 0 1"), "array A: is no array of NumPy"),
    archive("with a bomb", zip_of(A=[npy("(2, 2)", b""), *zeros(300_000_000)]), "array A: has more bytes than its header announces"),
    archive("with huge sizes", zip_of(A=npy("(1000000, 1000000)", b"")), "array A: has more than 200000000 elements"),
    archive("with sizes beyond all numbers", zip_of(A=npy(f"({2**40}, {2**40})", b"")), "array A: has more than"),
    archive("of Python objects", zip_of(A=npy("(1,)", b"", "|O")), "array A: holds Python objects"),
    archive("of complex numbers", npz(A=ONE + 0j), "array A: is complex"),
    archive("with nan", npz(A=np.full((2, 2), np.nan)), "A, sample 1 has an entry that is not finite"),
    archive("that is not square", npz(A=np.ones((2, 3))), "array A is 2 x 3"),
    archive("of texts", npz(A=np.array(["a"])), "array A is text"),
    archive("with damaged data", bytes(b ^ 0x55 if 60 < i < 75 else b for i, b in enumerate(zip_of(A=npy("(2, 2)", ONE.tobytes())))),
            ""),
]

MATLAB = [
    matlab("of no bytes", b"", ""),
    matlab("that is text", "A = [1 0; 0 1];\n", ""),
    matlab("that is a zip", npz(A=ONE), ""),
    matlab("cut short", half(mat(A=ONE, B=ONE)), "cut short"),
    matlab("without its last byte", mat(A=ONE)[:-1], "cut short"),
    matlab("of version 4 cut short", mat(form="4", A=ONE)[:-1], ""),
    matlab("with compressed data cut short", mat(compress=True, A=np.arange(10000.0).reshape(100, 100))[:-100], "cut short"),
    matlab("without matrices", mat(x=1.0), "no matrices"),
    matlab("with fewer numbers than it should have", mat_of_zeros(4, 8, False), "variable A has 8 numbers; its dimensions announce 16"),
    matlab("with fewer compressed numbers", mat_of_zeros(4000, 1, True), "variable A has 1 numbers; its dimensions announce 16000000"),
    matlab("with a compressed bomb", mat_of_zeros(6000, 6000 * 6000, True), ""),
    matlab("with nan", mat(A=np.full((2, 2), np.nan)), "A, sample 1 has an entry that is not finite"),
    matlab("that is not square", mat(A=np.ones((2, 3))), "array A is 2 x 3"),
    matlab("of complex numbers", mat(A=ONE + 1j), "variable A is complex"),
    matlab("with huge sizes", edited(mat(A=ONE), struct.pack("<2i", 2, 2), struct.pack("<2i", 2**30, 2**30)), ""),
    matlab("with negative sizes", edited(mat(A=ONE), struct.pack("<2i", 2, 2), struct.pack("<2i", -2, -2)), ""),
]

ROWS = OPENFAST + MATRIX_MARKET + NASTRAN + NUMPY + MATLAB
