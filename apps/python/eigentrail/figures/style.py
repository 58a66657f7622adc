"""Colours, marks and units that all figures share; those of the report page."""

import math
from functools import cache

from ..engine import engine

# Okabe and Ito's colours without yellow, which is too light for lines on white.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9"]
SYMBOLS = ["circle", "square", "diamond", "triangle-up", "triangle-down", "cross", "x", "star", "pentagon", "hexagram"]
INK = "#1a1a1a"
GREY = "#777777"
FAINT = "#cfcfcf"
GRID = "#e8e8e8"

RANGES = {"stable": ("#009e73", 0.13, "stable"), "marginal": ("#e69f00", 0.16, "marginal"),
          "undecided": ("#6e6e6e", 0.16, "undecided: errors of the data")}
PARTIAL_RANGE = ("#0072b2", 0.10, "no followed mode grows, others are not known")

TOO_CLOSE = "too_close"  # a resonance in the separation margin of an operating range
WARNING = "#b2182b"
OPERATION = ("#56b4e9", 0.3, "operating range")
MARGIN = ("#d55e00", 0.16, "separation margin")
OTHER_EVENT = "circle-open-dot"

# rad/s in one unit of an angular velocity or a frequency.
ANGULAR = {"rad/s": 1.0, "Hz": 2 * math.pi, "kHz": 2000 * math.pi, "rpm": math.pi / 30, "rev/s": 2 * math.pi,
           "deg/s": math.pi / 180}

SAME_AS_ZERO = 1e-9  # real parts below this share of abs(s) are rounding, as in the stability analysis


@cache
def event_kinds():
    """Per kind of event: its mark, its words in the legend, and whether these stand beside the mark."""
    return {**engine().event_kinds(), TOO_CLOSE: ("diamond-open", "resonance, too close", True)}


def mode_colour(mode):
    """The colour of a mode, counted from 0."""
    return COLOURS[mode % len(COLOURS)]


def mode_symbol(mode):
    """The mark of a mode; modes with the same colour have different ones."""
    return SYMBOLS[(mode + mode // len(COLOURS)) % len(SYMBOLS)]


def number(value, digits=4):
    """A number as text with this many significant digits; a true minus sign."""
    text = f"{value:.{digits}g}"
    if "e" in text:
        mantissa, exponent = text.split("e")
        text = f"{mantissa}e{int(exponent)}"
    return text.replace("-", "\u2212")


def with_unit(text, unit):
    """The title of an axis: "omega, rad/s"; without a unit for "1"."""
    return text if unit in ("1", "") else f"{text}, {unit}"
