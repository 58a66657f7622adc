"""Evaluates the dense output of a loci file (docs/loci-file.md)."""

import numpy as np

from .blocks import distinctness, followed, named, roots_of
from .interpolation import TwoPointTaylor
from .path import Path


class DenseOutput:
    """Eigenvalues of all modes at any place of the path of a trace."""

    def __init__(self, loci):
        """`loci` is the Dataset of a loci file."""
        self._eigenvalue = loci.eigenvalue.values
        self._certified = loci.certified.values
        self._mode_block = loci.mode_block.values
        self._function_block = loci.dense_block.values
        self._chart = loci.dense_chart.values
        length = loci.step_length.values
        self._functions = TwoPointTaylor(length[:, np.newaxis], loci.dense_output.values)
        self.path = Path(length, loci.step_parameter.values)

    def at(self, step, t):
        """Eigenvalues (n, mode) at t in [0, 1] on steps (n); NaN where a mode does not exist."""
        s = self._of_single_modes(step, t)
        for one in np.unique(step):
            here = np.flatnonzero(step == one)
            for block, count in zip(*np.unique(self._function_block[one], return_counts=True)):
                if block >= 0 and count > 1:
                    modes = np.flatnonzero(self._mode_block[one] == block)
                    s[np.ix_(here, modes)] = self._of_block(one, block, modes, t[here])
        s = np.where(s.imag < 0.0, s.conj(), s)
        for end in (0, 1):
            s[t == end] = self._eigenvalue[step[t == end] + end]
        return s

    def certified_at(self, step, t):
        """Whether modes are certified on steps (n): 1 or 0, or -1 where they do not exist (n, mode).

        At the end of a step (t = 1), a mode that begins there has the value of the next step."""
        here = self._certified[step]
        behind = self._certified[np.minimum(step + 1, len(self._certified) - 1)]
        return np.where((t == 1.0)[:, np.newaxis] & (here == -1), behind, here)

    def _of_single_modes(self, step, t):
        """Eigenvalues (n, mode) of modes in blocks of one. NaN where a mode does not exist; others are not valid."""
        function = self._mode_block[step]
        first = np.maximum(function, 0)
        values = self._functions[step[:, np.newaxis], first](t[:, np.newaxis])
        s = _from_chart(values, self._chart[step[:, np.newaxis], first])
        s[function < 0] = complex(np.nan, np.nan)
        return s

    def _of_block(self, step, block, modes, t):
        """Eigenvalues (n, modes) of the modes in one block, at places t (n) on one step."""
        functions = self._functions[step, self._function_block[step] == block]
        chart = self._chart[step, block]

        def roots_at(places):
            return roots_of(functions(places[:, np.newaxis]))

        ends = functions(np.array([[0.0], [1.0]]))
        at_ends = roots_of(ends)
        end = 0 if distinctness(ends[0]) >= distinctness(ends[1]) else 1
        known = _from_chart(self._eigenvalue[step + end, modes], chart)
        roots = followed(roots_at, end, named(known, at_ends[end]), t)
        return _from_chart(roots[:, :len(modes)], chart)


def _from_chart(values, chart):
    """Converts values of a chart to s: unchanged where `chart` is 0, reciprocal where it is 1. Infinity is (inf, 0).

    The function is its own inverse."""
    values = np.asarray(values, complex)
    with np.errstate(divide="ignore", invalid="ignore"):
        inverse = np.where(np.isinf(values), 0.0, np.where(values == 0.0, complex(np.inf, 0.0), 1.0 / values))
    return np.where(np.asarray(chart) == 1, inverse, values)
