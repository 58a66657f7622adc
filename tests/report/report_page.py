"""Reads the data of a report page without a browser."""

import base64
import json

import numpy as np

BEGIN = '<script type="application/json" id="data">'
END = "</script>"


def page_data(path):
    text = path.read_text(encoding="utf-8")
    begin = text.index(BEGIN) + len(BEGIN)
    return json.loads(text[begin:text.index(END, begin)])


def numbers(text, kind):
    return np.frombuffer(base64.b64decode(text), kind)


def on_pieces(knots, values, degree, place):
    """The function at a place: barycentric interpolation through Chebyshev-Lobatto places on its piece."""
    piece = min(max(np.searchsorted(knots, place, side="right") - 1, 0), len(knots) - 2)
    u = (place - knots[piece]) / (knots[piece + 1] - knots[piece])
    j = np.arange(degree + 1)
    nodes = 0.5 * (1.0 - np.cos(np.pi * j / degree))
    own = values[piece * degree:(piece + 1) * degree + 1]
    if np.any(u == nodes):
        return own[np.flatnonzero(u == nodes)[0]]
    weights = np.where(j % 2, -1.0, 1.0) * np.where((j == 0) | (j == degree), 0.5, 1.0) / (u - nodes)
    return np.sum(weights * own) / np.sum(weights)


def eigenvalue(curves, mode, place):
    """s of a mode at a place on the path; None where it does not exist."""
    for stretch in curves["modes"][mode]:
        knots = numbers(stretch["knots"], "<f8")
        if not knots[0] <= place <= knots[-1]:
            continue
        parts = numbers(stretch["values"], "<i4").reshape(-1, 2)
        a, unit_a, b, unit_b = stretch["scale"]
        return complex(on_pieces(knots, a + unit_a * parts[:, 0], curves["degree"], place),
                       on_pieces(knots, b + unit_b * parts[:, 1], curves["degree"], place))
    return None


def parameter(curves, place):
    data = curves["parameter"]
    return on_pieces(numbers(data["knots"], "<f8"), numbers(data["values"], "<f8"), data["degree"], place)
