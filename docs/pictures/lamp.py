"""Draws docs/pictures/lamp.svg from the two traces of docs/first-trace.md: python3 docs/pictures/lamp.py lamp.h5 leaning.h5"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import h5py
import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

from rotating_mass import eigenvalues, parameter

INK, UPRIGHT, LEANING = "#222222", "#0072b2", "#d55e00"


def curve(path):
    """Masses and eigenvalues of all modes along a trace, from its dense output."""
    with h5py.File(path) as file:
        loci = {name: data[()] for name, data in file.items() if isinstance(data, h5py.Dataset)}
    places = [(step, t) for step in range(len(loci["step_length"])) for t in np.linspace(0, 1, 60)]
    return np.array([parameter(loci, *place) for place in places]), np.array([eigenvalues(loci, *place) for place in places])


def pole(axes, angle, colour, **style):
    top = 2 * np.array([np.sin(angle), np.cos(angle)])
    axes.plot([0, top[0]], [0, top[1]], color=colour, linewidth=4, solid_capstyle="round", **style)
    axes.plot(*top, "o", color=colour, markersize=14, **style)


def sketch(axes):
    pole(axes, 0.35, LEANING, alpha=0.35)
    pole(axes, 0.0, UPRIGHT)
    turns = np.linspace(0, 3.6 * np.pi, 200)
    axes.plot((0.05 + 0.012 * turns) * np.cos(turns), (0.05 + 0.012 * turns) * np.sin(turns), color=INK, linewidth=1)
    axes.plot([-0.5, 0.5], [-0.22, -0.22], color=INK, linewidth=1)
    axes.annotate("lamp", (0, 2), (-0.28, 2), ha="right", va="center")
    axes.annotate("height", (0, 1), (-0.12, 1), ha="right", va="center")
    axes.annotate("foot", (0, 0), (-0.28, 0), ha="right", va="center")
    axes.set(aspect="equal", xlim=(-0.9, 1.0), ylim=(-0.4, 2.35))
    axes.axis("off")


def main():
    matplotlib.rcParams.update({"svg.hashsalt": "eigentrail", "font.size": 9.5})
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(9, 3.3), width_ratios=[1, 1.7, 1.7], layout="constrained")
    sketch(left)
    for path, name, colour, dash in ((sys.argv[1], "upright", UPRIGHT, "-"), (sys.argv[2], "leaning", LEANING, "--")):
        mass, s = curve(path)
        for k in range(s.shape[1]):
            label = name if k == 0 else None
            middle.plot(mass, s[:, k].imag, color=colour, linestyle=dash, label=label)
            right.plot(mass, s[:, k].real, color=colour, linestyle=dash, label=label)
    middle.set(xlabel="lamp, kg", ylabel="Im s, rad/s", xlim=(1, 6), ylim=(0, 3.5))
    right.set(xlabel="lamp, kg", ylabel="Re s, 1/s", xlim=(1, 6), ylim=(-0.6, 0.6))
    right.axhline(0, color="0.6", linewidth=0.8)
    for axes in (middle, right):
        axes.axvline(100 / (9.81 * 2) - 0.75, color="0.6", linewidth=0.8)
        axes.spines[["top", "right"]].set_visible(False)
    middle.annotate("4.347 kg", (4.347, 3.2), (4.42, 3.2), color="0.3")
    middle.legend(frameon=False, loc="lower left")
    figure.savefig(HERE / "lamp.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
