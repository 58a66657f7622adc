"""Derivatives of results with respect to the parameters of a scene."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from .checked import checked
from .engine import engine
from .errors import SceneError
from .files import ATTACHED
from .given import Attached, option_text
from .later import pandas, xarray
from .selection import mode_number

QUANTITIES = ("flutter", "damping_ratio", "frequency", "eigenvalue")
SAMPLES_PER_STEP = 16  # between two of them the least damping ratio is found by refinement


class Least(NamedTuple):
    """The least damping ratio of a trace: its value, where it is, and the number of the mode, from 1."""

    value: float
    at: float
    mode: int


@checked
def gradient(loci: xarray.Dataset, quantity: str = "flutter", *, mode: Any = None, event: int = 0,
             **at: Any) -> pandas.Series:
    """Derivatives of a result of `trace` with respect to all parameters of its scene, in their units.

    * quantity="flutter": of the parameter value of the flutter point number `event` along the trace (0, the first one); the
      trace has computed them, so they cost nothing.
    * "frequency" (damped, rad/s), "damping_ratio" or "eigenvalue": of a mode at a value of the traced parameter,

          gradient(loci, "damping_ratio", mode="blade lag", speed=300)

      at the cost of one equilibrium and one spectrum. Without a value, "damping_ratio" is the least one of all modes (or of
      `mode`) on the whole range, and its derivative that of the mode that has it, there.

    The equilibrium follows the parameters. Returns a Series by names of parameters; its attributes `value`, `at` and `mode`
    say what was differentiated. Parameters that others define are left out: their derivatives are in those of the others.
    NaN where the eigenvalue is multiple.

    >>> loci = et.trace(scene)
    >>> round(float(et.gradient(loci, "flutter")["drag"]), 4)                   # how far flutter moves per unit of drag
    0.2914
    >>> slope = et.gradient(loci, "damping_ratio", mode="mode 1", p=0)
    >>> round(slope.attrs["value"], 6), round(float(slope["drag"]), 6)          # drag / 2
    (0.05, 0.5)
    """
    if quantity not in QUANTITIES:
        raise SceneError(f"quantity: expected one of {', '.join(QUANTITIES)}; found {quantity!r}")
    if quantity == "flutter":
        return _of_flutter(loci, event)
    if not at:
        if quantity != "damping_ratio":
            raise SceneError(f"{quantity}: expected a value of the traced parameter, {loci.attrs['parameter']}=...")
        least = least_damping(loci, mode)
        return _of_mode(loci, quantity, least.at, least.mode - 1).drop(loci.attrs["parameter"])
    value = float(loci.eigentrail._wanted(at))
    if mode is None:
        raise SceneError(f"{quantity}: expected the mode, by its label or name: mode=\"mode 1\"")
    return _of_mode(loci, quantity, value, mode_number(loci, mode))


@checked
def least_damping(loci: xarray.Dataset, mode: Any = None) -> Least:
    """The least damping ratio of all modes, or of one, on the whole range of a trace, from its dense output.

    >>> least = et.least_damping(et.trace(scene, p=(0, 0.4)))
    >>> round(least.value, 4), round(least.at, 4)
    (0.0354, 0.0)
    """
    parameter = loci.attrs["parameter"]
    path = np.unique(loci[parameter].values)
    share = np.linspace(0.0, 1.0, SAMPLES_PER_STEP, endpoint=False)
    places = np.append((path[:-1, np.newaxis] + np.diff(path)[:, np.newaxis] * share).ravel(), path[-1])
    chosen = np.arange(loci.sizes["mode"]) if mode is None else np.array([mode_number(loci, mode)])

    def ratios(at: Any) -> Any:
        """Damping ratios at places: places x modes of all passages of the path, and the numbers of the modes."""
        ratio = loci.eigentrail.sel(**{parameter: at}).damping_ratio[..., chosen]
        return ratio.values.reshape(len(at), -1), np.resize(chosen, ratio.size // len(at))

    def refined(row: int, column: int) -> Least:
        at = places
        for _ in range(5):  # each time sixteen times closer: the minimum is flat, so its value is then exact to rounding
            at = np.linspace(at[max(row - 1, 0)], at[min(row + 1, len(at) - 1)], 2 * SAMPLES_PER_STEP + 1)
            values, modes = ratios(at)
            row = int(np.nanargmin(values[:, column]))
        return Least(float(values[row, column]), float(at[row]), int(modes[column]) + 1)

    values, _ = ratios(places)
    if not np.isfinite(values).any():
        raise SceneError("no mode has a damping ratio on this range")
    # Local minima of the samples. Between its neighbours a minimum is lower than its sample by less than these are higher.
    filled = np.where(np.isfinite(values), values, np.inf)
    edge = np.full((1, values.shape[1]), np.inf)
    before, behind = np.vstack([edge, filled[:-1]]), np.vstack([filled[1:], edge])
    neighbours = [np.where(np.isfinite(side), side, filled) for side in (before, behind)]
    with np.errstate(invalid="ignore"):
        lowest = filled - (np.maximum(*neighbours) - filled)
    may_be = np.isfinite(values) & (values <= before) & (values <= behind) & (lowest <= np.nanmin(values))
    return min((refined(int(row), int(column)) for row, column in np.argwhere(may_be)), key=lambda least: least.value)


def _of_flutter(loci: xarray.Dataset, event: int) -> pandas.Series:
    points = np.flatnonzero(loci.event_kind.values == "flutter")
    if len(points) <= event:
        raise SceneError(f"flutter {event}: the trace has {len(points)} flutter points")
    point = loci.isel(event=points[event])
    at = float(point.event_parameter)
    return _series(map(str, loci.scene_parameter.values), point.event_shift.values, np.float64(at), at,
                   str(point.event_modes.values)).drop(loci.attrs["parameter"])


def _of_mode(loci: xarray.Dataset, quantity: str, value: float, mode: int) -> pandas.Series:
    parameter = loci.attrs["parameter"]
    label = str(loci.mode.values[mode])
    s = complex(np.ravel(loci.eigentrail.sel(**{parameter: value}).eigenvalue.values[..., mode])[0])
    node = int(np.abs(loci[parameter].values - value).argmin())
    scene, options = _scene_of(loci)
    found = engine().sensitivities(scene, options, value, loci.equilibrium.values[node])
    nearest = int(np.argmin(np.abs(found["eigenvalue"] - s)))
    ds = found["derivative"][nearest]
    size = abs(s)
    # zeta = -Re s / |s| and d|s| = (Re s Re ds + Im s Im ds) / |s|.
    results: dict[str, tuple[Any, Any]] = {
        "eigenvalue": (ds, s),
        "frequency": (ds.imag * np.sign(s.imag or 1.0), abs(s.imag)),
        "damping_ratio": (-ds.real / size + s.real * (s.real * ds.real + s.imag * ds.imag) / size ** 3, -s.real / size)}
    derivative, result = results[quantity]
    return _series(found["parameter"], derivative, result, value, label)


def _scene_of(loci: xarray.Dataset) -> tuple[Any, list[tuple[str, str]]]:
    """The scene that was traced, with the files of its matrices, and the options that say which model it is."""
    attached = loci.encoding.get(ATTACHED, Attached())
    scene = attached.scene(loci.attrs["scene"], loci.attrs["scene_path"])
    options = [(key, option_text(loci.attrs[f"option_{key}"])) for key in ("parameter", "without")
               if loci.attrs.get(f"option_{key}", "none") not in ("none", "")]
    return scene, options


def _series(names: Any, values: Any, result: Any, at: float, mode: str) -> pandas.Series:
    series = pandas.Series(np.asarray(values), index=pandas.Index(list(names), name="parameter"))
    series.attrs.update(value=result, at=float(at), mode=mode)
    return series
