"""Draws docs/rotating_mass.svg from a loci file: python3 docs/rotating_mass.py build/rotating_mass.h5"""
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

matplotlib.rcParams["svg.hashsalt"] = "eigentrail"  # the same input gives the same file
loci = xr.open_dataset(sys.argv[1], engine="h5netcdf")
names = ["lag", "flap"]
styles = [dict(color="#0072b2"), dict(color="#d55e00", linestyle="--")]

# Between the points: the two-point Taylor interpolant of the stored series.
def dense(points, series, per_step=40):
    x, y = [], []
    for a, b, left, right in zip(points[:-1], points[1:], series[:-1], series[1:]):
        h, q = b - a, series.shape[1]
        f = {(i + 1, 0): left[i] * h**i for i in range(q)} | {(0, i + 1): right[i] * h**i for i in range(q)}
        for i in range(1, q + 1):
            for j in range(1, q + 1):
                f[i, j] = f[i - 1, j] - f[i, j - 1]
        t = np.linspace(0, 1, per_step, endpoint=False)
        x.append(a + t * h)
        y.append(sum((t * (t - 1)) ** k * (f[k + 1, k] + f[k + 1, k + 1] * t) for k in range(q)))
    return np.concatenate(x + [points[-1:]]), np.concatenate(y + [series[-1:, 0]])

omega = loci["omega"].values
series = loci["eigenvalue_series"].values
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
for i, (name, style) in enumerate(zip(names, styles)):
    x, s = dense(omega, series[:, i, :])
    left.plot(x, s.imag, label=name, **style)
    left.plot(omega, series[:, i, 0].imag, ".", color=style["color"], markersize=4)
    right.plot(x, s.real, label=name, **style)
left.set(xlabel="rotor speed, rad/s", ylabel="Im s, rad/s", xlim=(5, 60), ylim=(0, 70))
right.set(xlabel="rotor speed, rad/s", ylabel="Re s, 1/s", xlim=(5, 20), ylim=(-0.4, 0.4))
right.axhline(0, color="0.6", linewidth=0.8)
right.axvline(12.4393882, color="0.6", linewidth=0.8)
right.annotate("lag unstable below\n12.44 rad/s", (12.4393882, 0.0), (13.6, 0.16), arrowprops=dict(arrowstyle="->"))
for axes in (left, right):
    axes.legend(frameon=False, loc="lower right")
figure.savefig("docs/rotating_mass.svg", metadata={"Date": None})
