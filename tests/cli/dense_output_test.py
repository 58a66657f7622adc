"""The dense output of loci files, evaluated in numpy by the formulas of docs/loci-file.md, also where modes meet."""

import csv
import io
import unittest

import h5py
import numpy as np

from program import BIRTH, CROSSING, CROSSING_WITHIN, SCENES, ProgramTest, datasets


def between(h, left, right, t):
    """The polynomial of degree 2q + 1 that shares the series (last axis) at both ends of a step of length h."""
    if t > 0.5:
        return between(-h, right, left, 1.0 - t)
    n = left.shape[-1]
    table = {}
    for i in range(1, n + 1):
        table[i, 0], table[0, i] = left[..., i - 1] * h ** (i - 1), right[..., i - 1] * h ** (i - 1)
    for i in range(1, n + 1):
        for j in range(1, n + 1):
            table[i, j] = table[i - 1, j] - table[i, j - 1]
    return sum((t * (t - 1.0)) ** k * (table[k + 1, k] + table[k + 1, k + 1] * t) for k in range(n))


def roots_of_block(functions):
    """The roots from the values of one function, or of tau and delta."""
    if len(functions) == 1:
        return functions
    tau, delta = functions
    return tau + np.sqrt(delta) * np.array([1.0, -1.0])


def in_order_of(known, roots):
    """Two roots in the order nearest to the known values."""
    swapped = roots[::-1]
    n = len(known)
    return swapped if np.sum(np.abs(swapped[:n] - known)) < np.sum(np.abs(roots[:n] - known)) else roots


def followed(roots_at, start, a, b):
    """The roots at b in the order of those at a. Intervals are halved until roots move little compared with their distance."""
    middle = in_order_of(start, roots_at(0.5 * (a + b)))
    end = in_order_of(middle, roots_at(b))
    moved = max(np.max(np.abs(middle - start)), np.max(np.abs(end - middle)))
    if moved < 0.3 * min(abs(s[0] - s[1]) for s in (start, middle, end)) or abs(b - a) < 1e-6:
        return end
    return followed(roots_at, followed(roots_at, start, a, 0.5 * (a + b)), 0.5 * (a + b), b)


def dense_eigenvalues(data, parameter, place):
    """Eigenvalues of all modes where the parameter is the path's coordinate; NaN for modes that do not exist."""
    begin, h = data[parameter][:-1], data["step_length"]
    step = np.flatnonzero((place - begin) / h <= 1.0)
    step = step[(place - begin[step]) / h[step] >= 0.0][0]
    t = (place - begin[step]) / h[step]
    eigenvalues = np.full(len(data["mode"]), complex(np.nan, np.nan))
    for block in set(data["mode_block"][step]) - {-1}:
        modes, = np.nonzero(data["mode_block"][step] == block)
        left, right = np.moveaxis(data["dense_output"][step][data["dense_block"][step] == block], 1, 0)
        follows_reciprocal = data["dense_chart"][step, block] == 1

        def roots_at(t, left=left, right=right):
            return roots_of_block(between(h[step], left, right, t))

        roots = roots_at(t)
        if len(roots) == 2:
            end = max((0, 1), key=lambda end: abs(np.subtract(*roots_at(float(end)))))
            known = data["eigenvalue"][step + end, modes]
            named = in_order_of(1.0 / known if follows_reciprocal else known, roots_at(float(end)))
            roots = followed(roots_at, named, float(end), t)
        eigenvalues[modes] = (1.0 / roots if follows_reciprocal else roots)[:len(modes)]
    return np.where(eigenvalues.imag < 0.0, np.conj(eigenvalues), eigenvalues)


# (p - 1/2) s^2 + s + 1 = 0: the second root passes through infinity at p = 1/2.
THROUGH_INFINITY = """\
[trace]
parameter = "p"
from = 0
to = 0.7

[matrix_family]
M = [[[-0.5]], [[1]]]
C = [[[1]]]
K = [[[1]]]
"""


class DenseOutput(ProgramTest):
    def check(self, scene, parameter, places, block_sizes, charts=(0,)):
        """numpy and eval agree at all places; blocks of these sizes and charts occur."""
        self.write("scene.toml", scene)
        self.run_well("trace", "scene.toml", "-o", "loci.h5", "--quiet")
        with h5py.File(self.folder / "loci.h5") as file:
            data = {name: dataset[()] for name, dataset in datasets(file).items()}
        sizes = {int(n) for row in data["dense_block"] for n in np.unique(row[row >= 0], return_counts=True)[1]}
        self.assertEqual(sizes, set(block_sizes))
        self.assertEqual(set(data["dense_chart"].ravel().tolist()) - {-1}, set(charts))

        text = self.run_well("eval", "loci.h5", "--csv", "--at", *map(repr, map(float, places)))
        expected = np.full((len(places), len(data["mode"])), complex(np.nan, np.nan))
        names = [name.decode() for name in data["mode"]]
        where = {float(place): i for i, place in enumerate(places)}
        for row in csv.DictReader(io.StringIO(text)):
            expected[where[float(row["parameter"])], names.index(row["mode"])] = complex(float(row["real"]),
                                                                                         float(row["imag"]))
        actual = np.array([dense_eigenvalues(data, parameter, place) for place in places])
        np.testing.assert_allclose(actual, expected, rtol=1e-10, atol=1e-13, equal_nan=True)
        return actual

    def test_blocks_of_one(self):
        self.check((SCENES / "rotating_mass.toml").read_text(encoding="utf-8"), "omega", np.linspace(5.0, 100.0, 173), [1])

    def test_block_of_two_that_holds_a_pair_and_then_two_real_modes(self):
        places = np.linspace(0.0, 1.5, 151)
        s = self.check(BIRTH, "p", places, [1, 2])
        np.testing.assert_array_equal(np.isnan(s[:, 1]), places < 0.9975)

    def test_block_of_two_modes_that_cross(self):
        places = np.linspace(0.0, 1.0, 152)  # not the crossing itself
        s = self.check(CROSSING_WITHIN, "p", places, [1, 2])
        apart = (places - 0.5) * np.sqrt(1.0 + (places - 0.5) ** 2)
        np.testing.assert_allclose(s, 1j * np.sqrt(np.column_stack([1.5 + apart, 1.5 - apart])), rtol=1e-6)

    def test_independent_modes_that_cross_are_no_block(self):
        places = np.linspace(0.0, 1.0, 152)
        s = self.check(CROSSING, "p", places, [1])
        np.testing.assert_allclose(s, 1j * np.sqrt(np.column_stack([1.0 + places, 2.0 - places])), rtol=1e-6)

    def test_chart_of_a_mode_that_passes_through_infinity(self):
        places = np.linspace(0.0, 0.7, 139)  # not p = 1/2 itself
        s = self.check(THROUGH_INFINITY, "p", places, [1, 2], charts=[0, 1])
        m = places - 0.5
        roots = -2.0 / (1.0 + np.array([[1.0], [-1.0]]) * np.sqrt(1.0 - 4.0 * m))
        np.testing.assert_allclose(s, roots.T, rtol=1e-4)


if __name__ == "__main__":
    unittest.main()
