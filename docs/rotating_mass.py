"""Draws docs/rotating_mass.svg from a loci file: python3 docs/rotating_mass.py build/rotating_mass.h5

The dense output is evaluated for any loci file, as docs/loci-file.md describes it.
"""
import sys
from itertools import permutations

import h5py
import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np


def two_point_taylor(h, left, right, t):
    """The polynomial that shares the series (last axis) of both ends, at t in [0, 1]."""
    if t > 0.5:  # seen from the nearer end, where a function may vanish
        return two_point_taylor(-h, right, left, 1 - t)
    q = left.shape[-1]
    f = {(i + 1, 0): left[..., i] * h**i for i in range(q)} | {(0, i + 1): right[..., i] * h**i for i in range(q)}
    for i in range(1, q + 1):
        for j in range(1, q + 1):
            f[i, j] = f[i - 1, j] - f[i, j - 1]
    return sum((t * (t - 1)) ** k * (f[k + 1, k] + f[k + 1, k + 1] * t) for k in range(q))


def block_roots(f):
    """Eigenvalues of a block from its functions: one, two, or the entries of a matrix."""
    if len(f) == 1:
        return f
    if len(f) == 2:
        return f[0] + np.sqrt(f[1]) * np.array([1, -1])
    k = round(len(f) ** 0.5)
    return np.linalg.eigvals(f.reshape(k, k).T)


def distances(roots):
    return [abs(a - b) for i, a in enumerate(roots) for b in roots[:i]]


def gap(roots):
    """The least distance of two roots; those that coincide need not be told apart."""
    return min((d for d in distances(roots) if d > 1e-7 * max(abs(roots))), default=np.inf)


def assigned(known, roots):
    """The roots with the least total distance from the known values, in their order; the others behind them."""
    k = len(roots)
    cost = lambda order: sum(abs(known[i] - roots[j]) for i, j in enumerate(order[: len(known)]))
    return roots[list(min(permutations(range(k)), key=cost))]


def follow(roots_at, now, a, b):
    """From the roots at a to those at b, in pieces on which they move by less than a third of their gap."""
    ahead = assigned(now, roots_at(b))
    if abs(ahead - now).max() < 0.3 * min(gap(now), gap(ahead)) or abs(b - a) < 1e-4:
        return ahead
    middle = (a + b) / 2
    return follow(roots_at, follow(roots_at, now, a, middle), middle, b)


def reciprocal(s):
    return np.where(np.isinf(s), 0, 1 / np.where(s == 0, np.nan, s))


def eigenvalues(loci, step, t):
    """Eigenvalues of all modes at t in [0, 1] on a step; NaN where a mode does not exist."""
    h, mode_block = loci["step_length"][step], loci["mode_block"][step]
    s = np.full(len(mode_block), complex(np.nan, np.nan))
    for block in np.unique(mode_block[mode_block >= 0]):
        modes, rows = np.flatnonzero(mode_block == block), loci["dense_block"][step] == block
        left, right = (loci["dense_output"][step, rows, end] for end in (0, 1))
        roots_at = lambda x: block_roots(two_point_taylor(h, left, right, x))
        inverted = loci["dense_chart"][step, block] == 1
        roots = roots_at(t)
        if len(roots) > 1:
            ends = roots_at(0.0), roots_at(1.0)
            end = 0 if min(distances(ends[0])) >= min(distances(ends[1])) else 1
            known = loci["eigenvalue"][step + end, modes]
            roots = follow(roots_at, assigned(reciprocal(known) if inverted else known, ends[end]), end, t)
        s[modes] = (1 / roots if inverted else roots)[: len(modes)]
    return np.where(s.imag < 0, s.conj(), s)


def parameter(loci, step, t):
    return two_point_taylor(loci["step_length"][step], *loci["step_parameter"][step], t)


def main():
    matplotlib.rcParams["svg.hashsalt"] = "eigentrail"  # the same input gives the same file
    with h5py.File(sys.argv[1]) as file:
        loci = {name: file[name][()] for name in file if isinstance(file[name], h5py.Dataset)}
    places = [(step, t) for step in range(len(loci["step_length"])) for t in np.linspace(0, 1, 41)]
    x = np.array([parameter(loci, *place) for place in places])
    s = np.array([eigenvalues(loci, *place) for place in places])
    kinds = np.array([line.decode().split(",")[0] for line in loci["events"]])
    flutter = loci["event_parameter"][kinds == "flutter"][0]

    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    styles = {"lag": dict(color="#0072b2"), "flap": dict(color="#d55e00", linestyle="--")}
    for mode, (name, style) in enumerate(styles.items()):
        left.plot(x, s[:, mode].imag, label=name, **style)
        left.plot(loci["omega"], loci["eigenvalue"][:, mode].imag, ".", color=style["color"], markersize=4)
        right.plot(x, s[:, mode].real, label=name, **style)
    left.set(xlabel="rotor speed, rad/s", ylabel="Im s, rad/s", xlim=(5, 60), ylim=(0, 70))
    right.set(xlabel="rotor speed, rad/s", ylabel="Re s, 1/s", xlim=(5, 20), ylim=(-0.4, 0.4))
    right.axhline(0, color="0.6", linewidth=0.8)
    right.axvline(flutter, color="0.6", linewidth=0.8)
    right.annotate(f"lag unstable below\n{flutter:.2f} rad/s", (flutter, 0.0), (13.6, 0.16), arrowprops=dict(arrowstyle="->"))
    for axes in (left, right):
        axes.legend(frameon=False, loc="lower right")
    figure.savefig("docs/rotating_mass.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
