"""Writes files of Nastran: OUTPUT4 as text and in binary form, and DMIG."""

import struct

import numpy as np


def op4_text(matrices):
    """Dense columns with all digits of a double."""
    text = ""
    for name, matrix in matrices.items():
        rows, columns = matrix.shape
        text += f"{columns:8d}{rows:8d}{1:8d}{2:8d}{name:8s}1P,3E23.16\n"
        for c in range(columns):
            numbers = [f"{x:23.16E}" for x in matrix[:, c]]
            text += f"{c + 1:8d}{1:8d}{rows:8d}\n"
            text += "".join("".join(numbers[i:i + 3]) + "\n" for i in range(0, rows, 3))
        text += f"{columns + 1:8d}{1:8d}{1:8d}\n{1:23.16E}\n"
    return text


def op4_binary(matrices, order="<"):
    """Strings of numbers between zeros, in the variant "bigmat"."""
    def record(content):
        marker = struct.pack(order + "i", len(content))
        return marker + content + marker

    data = b""
    for name, matrix in matrices.items():
        rows, columns = matrix.shape
        data += record(struct.pack(order + "4i8s", columns, -rows, 1, 2, name.ljust(8).encode()))
        for c in range(columns):
            strings = b"".join(struct.pack(order + "iid", 3, r + 1, x) for r, x in enumerate(matrix[:, c]) if x != 0)
            if strings:
                data += record(struct.pack(order + "3i", c + 1, 0, len(strings) // 4) + strings)
        data += record(struct.pack(order + "3id", columns + 1, 1, 2, 1.0))
    return data


def dmig(matrices):
    """Large fields, with as many digits as Nastran punches; grid i + 1 has component 3."""
    def number(x):
        return np.format_float_scientific(x, precision=9, unique=False).replace("e", "D").rjust(16)

    text = "$ punched\n"
    for name, matrix in matrices.items():
        text += f"DMIG    {name:8s}{0:8d}{1:8d}{2:8d}{0:8d}\n"
        for c in range(matrix.shape[1]):
            text += f"{'DMIG*':8s}{name:16s}{c + 1:16d}{3:16d}\n"
            text += "".join(f"{'*':8s}{r + 1:16d}{3:16d}{number(x)}\n" for r, x in enumerate(matrix[:, c]) if x != 0)
    return text
