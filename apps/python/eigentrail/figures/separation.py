"""Operating ranges of a machine, and the margins that critical speeds must keep from them."""

import re
from collections import namedtuple

from ..engine import engine


class Operation(namedtuple("Operation", "ranges margin")):
    """Ranges (from, to) in the unit of the parameter, and the wanted margin as a fraction of the nearer end; None: API 684."""

    @classmethod
    def of(cls, loci):
        """As the attributes of the file have them: "3000 to 3600, 8000 to 9000", and "0.15" or "API 684"."""
        text = str(loci.attrs.get("operating_range", ""))
        ranges = [tuple(sorted(map(float, part.split(" to ")))) for part in re.split(r",\s*", text) if " to " in part]
        margin = str(loci.attrs.get("separation_margin", ""))
        return cls(ranges, float(margin) if re.fullmatch(r"[0-9.eE+-]+", margin) else None)

    def wanted(self, s, below):
        """The margin for a critical speed below or above a range, from the eigenvalue there."""
        return engine().api_margin(s, below) if self.margin is None else self.margin

    def is_too_close(self, p, s):
        """Whether a critical speed keeps less than its margin from a range, or lies within it."""
        return engine().is_too_close(self.ranges, self.margin, p, s)

    def strips(self, critical):
        """Intervals beside the ranges that critical speeds must not enter. `critical`: pairs of parameter and eigenvalue; the
        widest margin of those on a side counts."""
        found = []
        for low, high in self.ranges:
            below = max((self.wanted(s, True) for p, s in critical if abs(p) < low), default=self.margin or 0.0)
            above = max((self.wanted(s, False) for p, s in critical if abs(p) > high), default=self.margin or 0.0)
            found += [(low * (1 - below), low), (high, high * (1 + above))]
        return [(low, high) for low, high in found if high > low]
