"""A user's program; mypy checks it."""

import numpy as np
import pandas
import xarray

import eigentrail as et


def first_flutter(scene: str, damper: float) -> float:
    loci: xarray.Dataset = et.trace(scene, omega=(5, 100), damper=damper, tolerance=1e-8)
    table: pandas.DataFrame = et.events(loci)
    return float(table.query("kind == 'flutter'")["omega"].iloc[0])


def families() -> list[xarray.Dataset]:
    family = et.Family(M=np.eye(2), K=[np.eye(2), np.eye(2)], parameter="p", names=["x", "y"])
    samples = et.StateSpace(np.zeros((3, 2, 2)), [0.0, 1.0, 2.0], digits=4)
    return [et.trace(family, p=(0, 1)), et.trace(samples, p=(0, 2)), et.map(family, p=(0, 1), q=(0, 1), grid=(4, 4))]


def gradient(loci: xarray.Dataset) -> "pandas.Series[float]":
    return et.gradient(loci, "damping_ratio", mode="lag", omega=30)
