"""Smooth curves of all modes along the path of a trace, from its dense output."""

import numpy as np

from ..errors import SceneError
from ..selection import DATA_ERRORS, path_of
from .style import SAME_AS_ZERO

FIRST_PLACES = 5       # of each step before it is refined
MANY_STEPS = 300       # more steps than this have three places at first
MOST_REFINEMENTS = 7
BENT = 4e-4            # largest distance of a curve from its polygon, as a share of the usual range
BISECTIONS = 50
SOLID, DASHED, DOTTED = 0, 1, 2
ROUND = 0.1            # an orbit whose short axis is below a twentieth of the long one counts as a line


class Curves:
    """Values of all modes at places along the path.

    `step` (n), `t` (n): places; `parameter` (n); `s` (n, mode), NaN where a mode does not exist and where it is infinite.
    The places are dense enough to be joined by straight lines; steps follow each other, so that the end of a step is there
    twice.
    """

    def __init__(self, loci):
        if not loci.sizes["step"]:
            raise SceneError("the trace has no steps: there are no curves to draw")
        self._loci = loci
        self._path = path_of(loci, loci.attrs["parameter"])
        self._refine()

    def eigenvalues(self, step, t):
        """Eigenvalues (n, mode) and the parameter (n) at t (n) on steps (n)."""
        s, parameter = self._path.evaluate(step, t)
        return without_rounding(np.where(np.isfinite(s), s, complex(np.nan, np.nan))), parameter

    def styles(self, mode):
        """Of the line between each place and the next (n - 1): solid; dashed where the identity is not certified; dotted where
        the mode whirls backward, if the file says so."""
        step = self.step[1:]
        certified = self._loci.certified.values[step, mode]
        style = np.where(certified == 0, DASHED, SOLID)
        if "whirl" in self._loci:
            whirl = self._loci.whirl.values[:, mode]  # at stored points
            style[np.where(self.t < 0.5, whirl[self.step], whirl[self.step + 1])[1:] < -ROUND] = DOTTED
        return style

    def errors(self):
        """Bounds (n, mode) of the errors of the eigenvalues that come from the data, 1/s; None if the file has none."""
        names = [name for name in DATA_ERRORS if name in self._loci]
        return sum(np.nan_to_num(self._loci[name].values[self.step]) for name in names) if names else None

    def crossings(self, modes, excess):
        """Places where `excess(parameter, s)` of one of the modes passes through zero, mode by mode: the mode, the parameter
        and the eigenvalue, (k) each."""
        value = excess(self.parameter[:, np.newaxis], self.s[:, modes])
        with np.errstate(invalid="ignore"):
            passes = (self.step[1:] == self.step[:-1]) & (value[:-1] * value[1:] < 0).T
        column, at = np.nonzero(passes)
        mode, step, low, high = np.asarray(modes)[column], self.step[at], self.t[at], self.t[at + 1]

        def there(t):
            s, p = self.eigenvalues(step, t)
            return p, s[np.arange(len(mode)), mode]

        for _ in range(BISECTIONS):
            middle = 0.5 * (low + high)
            before = (excess(*there(middle)) < 0) == (value[at, column] < 0)
            low, high = np.where(before, middle, low), np.where(before, high, middle)
        return mode, *there(0.5 * (low + high))

    def _refine(self):
        steps = self._loci.sizes["step"]
        places = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, FIRST_PLACES if steps <= MANY_STEPS else 3))
        step, t = np.repeat(np.arange(steps), len(places)), np.tile(places, steps)
        s, p = self.eigenvalues(step, t)
        new = np.ones(len(t), bool)
        for _ in range(MOST_REFINEMENTS):
            usual = _usual_size(s)
            pairs = np.flatnonzero((step[1:] == step[:-1]) & (new[1:] | new[:-1]))
            if not len(pairs):
                break
            between = 0.5 * (t[pairs] + t[pairs + 1])
            s_between, p_between = self.eigenvalues(step[pairs], between)
            bent = _largest_bend(s[pairs], s_between, s[pairs + 1], usual) > BENT
            at = pairs[bent] + 1
            step, t, p = (np.insert(array, at, values) for array, values in
                          ((step, step[pairs[bent]]), (t, between[bent]), (p, p_between[bent])))
            s = np.insert(s, at, s_between[bent], axis=0)
            new = np.insert(np.zeros(len(new), bool), at, True)
        self.step, self.t, self.s, self.parameter = step, t, s, p


def _usual_size(s):
    """Usual magnitudes of Im s and Re s."""
    imag, real = np.abs(s.imag), np.abs(s.real)
    sizes = [np.nanquantile(part, 0.97) if np.isfinite(part).any() else 1.0 for part in (imag, real)]
    return [size or 1.0 for size in sizes]


def _largest_bend(left, middle, right, usual):
    """Largest distance (n) of the middle from the chord over all modes: of Im s and Re s as shares of their usual sizes, and of
    the damping ratio."""
    imag, real = usual
    mean = 0.5 * (left + right)
    parts = [np.abs(middle.imag - mean.imag) / imag, np.abs(middle.real - mean.real) / real]
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = [part.real / np.abs(part) for part in (left, middle, right)]
        parts.append(np.abs(ratio[1] - 0.5 * (ratio[0] + ratio[2])))
    return np.nan_to_num(np.max(parts, axis=0), nan=0.0).max(axis=1)


def without_rounding(s):
    """Eigenvalues whose real part is zero where it is rounding, as in the stability analysis."""
    return np.where(np.abs(s.real) < SAME_AS_ZERO * np.abs(s), 1j * s.imag, s)


def oscillates(s):
    """Whether eigenvalues belong to complex pairs."""
    with np.errstate(invalid="ignore"):
        return np.abs(s.imag) > SAME_AS_ZERO * np.abs(s)


def with_ends(mask, step):
    """The places of a mask (n, ...) and the ends of steps (n) next to them, so that lines reach the place where a pair becomes
    real: a step ends there."""
    end = np.diff(step, prepend=-1, append=-1) != 0
    end = (end[:-1] | end[1:])[:, np.newaxis]
    grown = mask.copy()
    grown[1:] |= mask[:-1] & end[1:]
    grown[:-1] |= mask[1:] & end[:-1]
    return grown


def damping_percent(s):
    """Damping ratio in percent."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return -100.0 * s.real / np.abs(s) + 0.0


def parts(x, y, styles, style):
    """The lines x, y (n) where the styles (n - 1) have this value: arrays with NaN between the parts."""
    joined = (styles == style) & np.isfinite(x[1:]) & np.isfinite(x[:-1]) & np.isfinite(y[1:]) & np.isfinite(y[:-1])
    gap = [np.nan]
    return tuple(np.concatenate([gap, *(part for begin, end in runs(joined) for part in (values[begin:end + 1], gap))])[1:-1]
                 for values in (x, y))


def runs(mask):
    """Where the parts of a mask (n) begin, and the places behind their ends: (k, 2)."""
    return np.flatnonzero(np.diff(mask, prepend=False, append=False)).reshape(-1, 2)


def usual_range(values):
    """Range of the values without a few that are far larger than all others, as where a mode goes to infinity."""
    values = np.sort(values[np.isfinite(values)])
    n = len(values)
    if not n:
        return 0.0, 1.0
    low, high = values[0], values[-1]
    lowest, highest = (values[min(int(share * n), n - 1)] for share in (0.03, 0.97))
    most = max(highest - lowest, 1e-12 * max(abs(low), abs(high)))
    if n > 60 and high - highest > 25 * most:
        high = highest + 0.5 * most
    if n > 60 and lowest - low > 25 * most:
        low = lowest - 0.5 * most
    return low, high
