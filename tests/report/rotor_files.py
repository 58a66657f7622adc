"""A rotor with many modes and a wing with real roots as scenes, and whirl as the loci file of a rotor has it."""

import h5py
import numpy as np


# A section of a wing that plunges and pitches, with two lags of the air, l' = -b V l + pitch rate: two real roots, and a plunge
# that becomes two more before one of them diverges.
WING = """\
title = "Wing section with lags"
[parameters]
V = { value = 1, unit = "m/s" }
[trace]
parameter = "V"
from = 1
to = 60
[matrix_family]
state_names = ["plunge", "pitch", "plunge rate", "pitch rate", "lag 1", "lag 2"]
A = [
  [[0,0,1,0,0,0], [0,0,0,1,0,0], [-900,-160,-0.3,0,0,0], [-90,-2500,0,-0.5,0,0], [0,0,0,1,0,0], [0,0,0,1,0,0]],
  [[0,0,0,0,0,0], [0,0,0,0,0,0], [0,0,-0.12,0,0,0], [0,0,0.02,-0.05,0,0], [0,0,0,0,-0.15,0], [0,0,0,0,0,-0.6]],
  [[0,0,0,0,0,0], [0,0,0,0,0,0], [0,-0.8,0,0,0.05,0.1], [0,0.9,0,0,0.02,0.02], [0,0,0,0,0,0], [0,0,0,0,0,0]]]
"""


def rotor(pairs, events):
    """Scene of a rotor: so many pairs of bending modes in two planes, coupled by gyroscopic terms; speed in rpm."""
    frequency = 2.0 * np.pi * 12.0 * np.arange(1, pairs + 1) ** 1.35
    n = 2 * pairs
    stiffness, damping, gyroscopic = np.zeros((3, n, n))
    for k, w in enumerate(frequency):
        x, y = 2 * k, 2 * k + 1
        stiffness[x, x], stiffness[y, y] = w**2, 1.04 * w**2
        damping[x, x] = damping[y, y] = 0.02 * w
        gyroscopic[x, y], gyroscopic[y, x] = 0.25, -0.25
    texts = ["[" + ", ".join(str(list(map(float, row))) for row in m) + "]" for m in (np.eye(n), damping, gyroscopic, stiffness)]
    return (f'title = "Rotor with {n} modes"\n[parameters]\nspeed = {{ value = 0, unit = "rpm" }}\n[trace]\nparameter = "speed"\nfrom = 0\n'
            f"to = 12000\n{events}\n[matrix_family]\nM = [{texts[0]}]\nC = [{texts[1]}, {texts[2]}]\nK = [{texts[3]}]\n")


def add_whirl(path):
    """Gives a loci file the datasets on whirl: odd modes forward, even ones backward, from the middle of the points on in a plane."""
    with h5py.File(path, "r+") as file:
        points, modes = file["eigenvalue"].shape
        whirl = np.where(np.arange(modes) % 2 == 0, 0.9, -0.9) * np.ones((points, 1))
        whirl[points // 2:] = 0.0
        for name, values in (("whirl", whirl), ("whirl_reverse", 0.0 * whirl)):
            if name in file:
                del file[name]
            file[name] = values
