"""The polynomial between two power series."""

import numpy as np


class TwoPointTaylor:
    """Polynomials of degree 2q + 1, each of which shares two series of order q: about t = 0 and about t = 1.

    `length` (...) is the length h of the steps, `series` (..., 2, q + 1) has the coefficients at both ends in powers
    of the step's own coordinate, which grows by h as t goes from 0 to 1.
    """

    def __init__(self, length, series):
        left, right = series[..., 0, :], series[..., 1, :]
        self._from_left = _newton_form(length, left, right)
        self._from_right = _newton_form(-length, right, left)

    def __getitem__(self, index):
        """Those of the polynomials that `index` takes, as numpy does along the leading axes."""
        part = object.__new__(TwoPointTaylor)
        part._from_left = tuple(table[index] for table in self._from_left)
        part._from_right = tuple(table[index] for table in self._from_right)
        return part

    def __call__(self, t):
        """Values at t in [0, 1], broadcast with the polynomials, each seen from the nearer end.

        A function that vanishes at an end keeps its digits there.
        """
        return np.where(t <= 0.5, _horner(*self._from_left, t), _horner(*self._from_right, 1.0 - t))


def _newton_form(length, near, far):
    """F(k + 1, k) and F(k + 1, k + 1), (..., q + 1) each, of docs/loci-file.md."""
    n = near.shape[-1]
    powers = np.asarray(length)[..., np.newaxis] ** np.arange(n)
    near, far = near * powers, far * powers
    values, slopes = np.empty_like(near), np.empty_like(near)
    row = [far[..., j] for j in range(n)]  # F(0, 1) ... F(0, n)
    for i in range(n):
        before = near[..., i]  # F(i + 1, 0)
        for j in range(n):
            if j == i:
                values[..., i] = before
            before = row[j] = row[j] - before  # F(i + 1, j + 1)
        slopes[..., i] = row[i]
    return values, slopes


def _horner(values, slopes, t):
    bubble = t * (t - 1.0)
    total = 0.0
    for k in reversed(range(values.shape[-1])):
        total = total * bubble + values[..., k] + slopes[..., k] * t
    return total
