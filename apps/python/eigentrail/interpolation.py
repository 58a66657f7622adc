"""The polynomial that agrees with power series at both ends of a step."""

import numpy as np


class TwoPointTaylor:
    """Polynomials of degree 2q + 1 that agree with power series of order q about t = 0 and t = 1 (docs/loci-file.md).

    `length` (...): length h of the steps. `series` (..., 2, q + 1): coefficients at both ends in powers of the
    coordinate of the step, which increases by h as t goes from 0 to 1.
    """

    def __init__(self, length, series):
        left, right = series[..., 0, :], series[..., 1, :]
        self._from_left = _newton_form(length, left, right)
        self._from_right = _newton_form(-length, right, left)

    def __getitem__(self, index):
        """The polynomials selected by `index`, as in numpy, along the leading axes."""
        part = object.__new__(TwoPointTaylor)
        part._from_left = tuple(table[index] for table in self._from_left)
        part._from_right = tuple(table[index] for table in self._from_right)
        return part

    def __call__(self, t):
        """Values at t in [0, 1], broadcast with the polynomials.

        Each is evaluated in the distance from the nearer end, so that a function that vanishes at an end keeps its
        relative accuracy there.
        """
        return np.where(t <= 0.5, _horner(*self._from_left, t), _horner(*self._from_right, 1.0 - t))


def _newton_form(length, near, far):
    """The divided differences F(k + 1, k) and F(k + 1, k + 1) of docs/loci-file.md, (..., q + 1) each."""
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
