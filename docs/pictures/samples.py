"""Draws docs/pictures/samples.svg from two traces of docs/sampled-families.md: python3 docs/pictures/samples.py five.h5 eight.h5"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "examples")]

import h5py
import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

from rotating_mass import eigenvalues, parameter
from typical_section import state_matrix

CURVE, BAND, POINT, RANGE = "#0072b2", "#56b4e9", "#222222", "#e69f00"


def least_damped(V):
    return max(np.linalg.eigvals(state_matrix(V)), key=lambda s: s.imag).real


def draw(axes, path, samples):
    with h5py.File(path) as file:
        loci = {name: data[()] for name, data in file.items() if isinstance(data, h5py.Dataset)}
    places = [(step, t) for step in range(len(loci["step_length"])) for t in np.linspace(0, 1, 60)]
    speed = np.array([parameter(loci, *place) for place in places])
    real = np.array([eigenvalues(loci, *place)[1].real for place in places])
    error = np.array([loci["interpolation_error"][step, 1] for step, _ in places])
    low, high = next(pair for pair in loci["event_interval"] if np.isfinite(pair[0]))
    axes.axhline(0, color="0.6", linewidth=0.8)
    axes.axvspan(low, high, color=RANGE, alpha=0.25, linewidth=0, label="flutter lies in here")
    axes.fill_between(speed, real - error, real + error, color=BAND, alpha=0.4, linewidth=0, label="error between samples")
    axes.plot(speed, real, color=CURVE, label="trace")
    axes.plot(samples, [least_damped(V) for V in samples], "o", color=POINT, markersize=4, label="samples")
    axes.set(xlabel="V, m/s", ylabel="Re s of the pitch mode, 1/s", xlim=(140, 262), ylim=(-3, 13),
             title=f"{len(samples)} samples: flutter between {low:.5g} and {high:.5g} m/s")


def main():
    matplotlib.rcParams.update({"svg.hashsalt": "eigentrail", "font.size": 9.5})
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), sharey=True, layout="constrained")
    draw(left, sys.argv[1], [80, 125, 170, 215, 260])
    draw(right, sys.argv[2], [80, 97.1, 125, 170, 193.4, 215, 242.9, 260])
    right.set(ylabel=None)
    left.legend(loc="upper left", frameon=False)
    figure.savefig(HERE / "samples.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
