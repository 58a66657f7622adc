"""Curves of a boundary file, evaluated from its dense output."""

import numpy as np
import xarray

from .engine import engine
from .errors import SceneError


def curve(boundary: xarray.Dataset, number: int, points: int) -> xarray.Dataset:
    """Dataset of both parameters and the eigenvalue at `points` places along curve `number`.

    The places are equidistant if every step counts as long as any other."""
    steps = np.flatnonzero(boundary.step_curve.values == number)
    if not len(steps):
        raise SceneError(f"curve {number}: the file has {boundary.sizes['curve']} curves, counted from 0")
    place = np.linspace(0.0, len(steps), points)
    which = np.minimum(place.astype(int), len(steps) - 1)
    at = steps[which]
    first, second, mean, delta = engine().boundary_places(
        boundary.step_length.values[at], boundary.dense_output.values[at], place - which).T
    s = mean + np.sqrt(delta.astype(complex))
    parameters = {name: ("point", column, boundary[name].attrs)
                  for name, column in zip(boundary.parameter.values, (first, second))}
    return xarray.Dataset({"eigenvalue": ("point", s, boundary.eigenvalue.attrs)}, coords=parameters)
