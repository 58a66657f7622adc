"""Draws docs/pictures/events.svg, the kinds of special points on systems of one or two freedoms: python3 docs/pictures/events.py"""
import pathlib

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

ONE, TWO, POINT = "#0072b2", "#d55e00", "#b2182b"
HERE = pathlib.Path(__file__).resolve().parent


def roots(c, k):
    """Both s of s^2 + c s + k = 0."""
    half = np.sqrt(np.asarray(c * c / 4 - k, dtype=complex))
    return -c / 2 + half, -c / 2 - half


def frequencies(k11, k22, k12, k21):
    """Both s = j omega of two freedoms with unit masses, Im s >= 0."""
    mean, half = (k11 + k22) / 2, np.sqrt(np.asarray(((k11 - k22) / 2) ** 2 + k12 * k21, dtype=complex))
    values = [np.sqrt(-(mean + sign * half)) for sign in (-1, 1)]
    return [np.where(s.imag < 0, -s, s) for s in values]


def curves(axes, p, first, second=None):
    axes.plot(p, first, color=ONE)
    if second is not None:
        axes.plot(p, second, color=TWO, linestyle="--")


def flutter(axes, p):
    s, _ = roots(0.6 * (0.5 - p), 1.0)
    curves(axes, p, s.real)
    axes.axhline(0, color="0.6", linewidth=0.8)
    return 0.5, 0, "Re s"


def divergence(axes, p):
    slow, fast = roots(1.0, 0.3 * (0.5 - p))
    curves(axes, p, slow.real)
    axes.axhline(0, color="0.6", linewidth=0.8)
    return 0.5, 0, "s (real)"


def collision(axes, p):
    a, b = frequencies(1 + 0 * p, 2 - p, 0.25 + 0 * p, -0.25 + 0 * p)
    curves(axes, p, a.imag, b.imag)
    return 0.5, np.sqrt(1.25), "Im s"


def crossing(axes, p):
    curves(axes, p, 1 + 0 * p, np.sqrt(0.5 + p))
    return 0.5, 1, "Im s"


def veering(axes, p):
    a, b = frequencies(1 + 0 * p, 0.5 + p, 0.05, 0.05)
    curves(axes, p, a.imag, b.imag)
    return 0.5, 1, "Im s"


def fold(axes, p):
    x = np.linspace(-1, 1, 200)
    curves(axes, 0.7 - 0.6 * x * x, x)
    return 0.7, 0, "equilibrium"


def branch_point(axes, p):
    after = np.linspace(0.5, 1, 200)
    curves(axes, p, 0 * p)
    for side in (-1, 1):
        axes.plot(after, side * np.sqrt(2 * (after - 0.5)), color=TWO, linestyle="--")
    return 0.5, 0, "equilibrium"


def resonance(axes, p):
    curves(axes, p, np.sqrt(0.2 + 0.2 * p * p))
    axes.plot(p, p, color="0.6", linewidth=0.9)
    axes.annotate("1 per revolution", (0.93, 0.93), xytext=(-6, 0), textcoords="offset points", ha="right", fontsize=8, color="0.4")
    return 0.5, 0.5, "Im s"


def main():
    matplotlib.rcParams.update({"svg.hashsalt": "eigentrail", "font.size": 9})  # the same input gives the same file
    kinds = [flutter, divergence, resonance, crossing, veering, collision, fold, branch_point]
    figure, all_axes = plt.subplots(2, 4, figsize=(9, 4.2), layout="constrained")
    p = np.linspace(0, 1, 401)
    for axes, kind in zip(all_axes.flat, kinds):
        x, y, label = kind(axes, p)
        if kind is veering:
            axes.axvline(x, color=POINT, linewidth=1, linestyle=":")
        else:
            axes.plot(x, y, "o", color=POINT, markersize=6, zorder=4)
        axes.set(title=kind.__name__, xlabel="parameter", ylabel=label, xticks=[], yticks=[], xlim=(0, 1))
        axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(HERE / "events.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
