"""Places on the path of a trace with a given value of the parameter."""

import numpy as np
from numpy.polynomial import Chebyshev

from .interpolation import TwoPointTaylor

HALVINGS = 64  # bisections of a step, more than the 53 bits of a double
APART = 4 * np.sqrt(np.finfo(float).eps)  # largest distance in t of two places at a fold that are the same


class Path:
    """The parameter along the path.

    `step_length` (step) and `step_parameter` (step, 2, order) are the datasets of the file.
    """

    def __init__(self, step_length, step_parameter):
        self._length, self._series = step_length, step_parameter
        goes_with_parameter = (step_parameter[..., 1] == 1.0) & np.all(step_parameter[..., 2:] == 0.0, axis=-1)
        self._straight = goes_with_parameter.all(axis=1)
        forward = np.sign(step_parameter[:, 1, 0] - step_parameter[:, 0, 0])
        self.turns_back = not self._straight.all() or len(set(forward)) > 1

    def positions(self, values):
        """All places with these parameter values (n): arrays of the index of the value, the step and t in [0, 1].

        They are ordered by value and then along the path. A node belongs to the step that ends there."""
        order = np.argsort(values, kind="stable")
        found = [self._positions_on(step, values[order]) for step in range(len(self._length))]
        if not found:
            return np.empty(0, int), np.empty(0, int), np.empty(0)
        step = np.repeat(np.arange(len(found)), [len(t) for _, t in found])
        which = order[np.concatenate([at for at, _ in found])]
        t = np.concatenate([t for _, t in found])
        along = np.lexsort((t, step, which))
        which, step, t = which[along], step[along], t[along]
        once = ~_repeats(which, step, t)
        return which[once], step[once], t[once]

    def _positions_on(self, step, values):
        """Places on one step for ascending values: arrays of the index of the value and t."""
        if self._straight[step]:
            a, b = self._series[step, :, 0]
            at = _between(values, a, b)
            return at, (values[at] - a) / (b - a)
        return _CurvedStep(self._length[step], self._series[step]).positions(values)


def _between(values, a, b):
    """Indices of the ascending values that lie in the closed interval with the ends a and b."""
    return np.arange(np.searchsorted(values, min(a, b)), np.searchsorted(values, max(a, b), side="right"))


def _repeats(which, step, t):
    """Mask of the places that repeat the one before: the start of a step after the end of the last step."""
    repeats = np.zeros(len(t), bool)
    repeats[1:] = (t[1:] == 0.0) & (t[:-1] == 1.0) & (step[1:] == step[:-1] + 1) & (which[1:] == which[:-1])
    return repeats


class _CurvedStep:
    """A step whose coordinate is the distance along the path, on which the parameter may turn back."""

    def __init__(self, length, series):
        self._ends = series[:, 0]
        # p(t) minus its value at each end. At a fold at an end of the step, the difference of p from its value at the
        # fold then keeps its relative accuracy.
        self._from_end = []
        for p in self._ends:
            shifted = series.copy()
            shifted[:, 0] -= p
            self._from_end.append(TwoPointTaylor(length, shifted))
        self._degree = 2 * series.shape[-1] - 1

    def _miss(self, t, values):
        """p(t) - values, relative to the value at the nearer end."""
        return np.where(t <= 0.5, self._from_end[0](t) - (values - self._ends[0]),
                        self._from_end[1](t) - (values - self._ends[1]))

    def _monotonic_pieces(self):
        """Places from 0 to 1 between which the parameter is monotonic."""
        turning = Chebyshev.interpolate(self._from_end[0], self._degree, domain=[0.0, 1.0]).deriv().roots()
        real = turning.real[np.abs(turning.imag) < 1e-7]
        return np.concatenate([[0.0], np.sort(real[(real > 0.0) & (real < 1.0)]), [1.0]])

    def positions(self, values):
        pieces = self._monotonic_pieces()
        found, places = [], []
        for start, end in zip(pieces[:-1], pieces[1:]):
            at = self._crossed(values, start, end)
            found.append(at)
            places.append(self._bisected(values[at], start, end))
        at, t = np.concatenate(found), np.concatenate(places)
        # A turning point is found on two pieces, at two places that differ by rounding. One of them is dropped; the
        # end of the step, 1, is kept exactly.
        _, first = np.unique(np.column_stack([at, t]), axis=0, return_index=True)
        at, t = at[first], t[first]
        again = (np.diff(at) == 0) & (np.diff(t) <= APART)
        t[:-1][again & (t[1:] == 1.0)] = 1.0
        once = np.append(True, ~again)[:len(at)]
        return at[once], t[once]

    def _crossed(self, values, start, end):
        before, behind = self._miss(np.array(start), values), self._miss(np.array(end), values)
        return np.flatnonzero((before <= 0.0) & (behind >= 0.0) | (before >= 0.0) & (behind <= 0.0))

    def _bisected(self, values, start, end):
        """The places of values between those at the ends of a monotonic piece, by bisection."""
        sign = np.where(self._miss(np.array(end), values) >= self._miss(np.array(start), values), 1.0, -1.0)
        low, high = np.full(len(values), start), np.full(len(values), end)
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            above = sign * self._miss(middle, values) > 0.0
            low, high = np.where(above, low, middle), np.where(above, middle, high)
        exact = [(end, self._miss(np.array(end), values) == 0.0), (start, self._miss(np.array(start), values) == 0.0)]
        return np.select([hit for _, hit in exact], [place for place, _ in exact], low)
