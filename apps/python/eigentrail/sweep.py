"""Traces at many values of other parameters, on all cores."""

from __future__ import annotations

import itertools
import os
from collections import UserDict
from collections.abc import Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, Optional

import numpy as np

from .checked import checked
from .errors import SceneError, TraceError, tell
from .given import Source, within
from .later import xarray
from .progress import Progress, bar
from .runs import Run, trace_file
from .selection import columns_of, evaluated, path_of

RUNS = "eigentrail_runs"  # key of a Dataset's encoding: the Datasets of the single traces
# Weight of the distance of loci beside modal assurance, both from 0 to 1: it decides where shapes are alike to a percent.
TIE = 0.01
COLUMNS = ("eigenvalue", "natural_frequency", "damped_frequency", "damping_ratio", "certified")
NO_EIGENVALUE = complex(np.nan, np.nan)


@checked
def sweep(scene: Source, over: Mapping[str, Sequence[Any]], *, points: Any = 201, jobs: int = 0, progress: Progress = None,
          **how: Any) -> xarray.Dataset:
    """Traces a scene at all combinations of the values `over`: one Dataset with a dimension for each of them.

        sweep("rotor.toml", {"bearing_damping": [500, 1000, 2000]}, speed=(0, 400))

    `how` are the keywords of `trace`. Every trace is evaluated from its dense output at the same values of the traced
    parameter: `points` of them over the range, or an array. Variables: eigenvalue, natural_frequency, damped_frequency,
    damping_ratio and certified along the dimensions of `over`, the parameter and `mode`; per trace also `flutter`, the
    first flutter along it (NaN: none), `least_damping`, the least damping ratio of its modes at the values, and `status`
    with `message`. What could not be traced is NaN, and its status says so.

    Modes are brought into the order of the trace next to it: by their shapes where the traces begin (modal assurance), and by
    their eigenvalues where shapes do not tell. `.eigentrail.runs` are the Datasets of the single traces, by their values. `jobs`: traces at a time, 0 for one
    per core. Ctrl-C ends the sweep with KeyboardInterrupt.

    >>> swept = et.sweep(scene, {"drag": [0.1, 0.2]}, points=3)
    >>> swept.eigenvalue.dims, swept.flutter.values.round(3)
    (('drag', 'p', 'mode'), array([0.515, 0.557]))
    """
    names = list(over)
    values = {name: list(over[name]) for name in names}
    if not names or any(not column for column in values.values()):
        raise SceneError("expected values of at least one parameter: {'damping': [500, 1000, 2000]}")
    within("jobs", jobs, 1024)
    if np.asarray(points).dtype.kind not in "iuf" or np.size(points) == 0 or np.ndim(points) == 0 and points < 2:
        raise SceneError(f"points: expected the number of values of the traced parameter, 2 at least, or a list of values; found {points!r}")
    both = [name for name in names if name in how]
    if both:
        raise SceneError(f"{both[0]}: is swept, and has a value of its own; give one of them")
    places = list(itertools.product(*values.values()))
    runs = _run_all(scene, names, places, how, jobs or os.cpu_count() or 1, progress)
    tell(dict.fromkeys(remark for run in runs for remark in run.remarks))
    return _together(names, values, places, runs, points)


class _Traced:
    """What a sweep needs of a trace."""

    def __init__(self, run: Run):
        loci = run.loci()
        parameter = loci.attrs["parameter"]
        self.run, self.remarks = run, run.remarks
        self.path, self._dense = loci[parameter].values, path_of(loci, parameter)
        self._certified, self.shapes = loci.certified.values, loci.mode_shape.values[0]
        self.status, self.message = str(loci.attrs["status"]), str(loci.attrs.get("message", ""))
        self.flutter = next(iter(loci.event_parameter.values[loci.event_kind.values == "flutter"]), np.nan)
        self.n_modes = loci.sizes["mode"]

    def at(self, values: Any, n_modes: int) -> dict[str, Any]:
        """COLUMNS at values of the traced parameter, (value, mode) each: NaN where it has not been, at the first of several
        places with a value."""
        _, s, certified = evaluated(self._dense, self._certified, values)
        beyond = [(0, 0), (0, n_modes - self.n_modes)]
        return columns_of(np.pad(s[:, 0], beyond, constant_values=NO_EIGENVALUE),
                          np.pad(certified[:, 0], beyond, constant_values=-1))


class _Failed:
    """A trace that could not begin, or of which the scene with these values is bad input."""

    status, flutter, shapes, remarks = "not traced", np.nan, None, ()

    def __init__(self, error: SceneError | TraceError):
        self.run, self.message = error, str(error)

    def at(self, values: Any, n_modes: int) -> dict[str, Any]:
        shape = (len(values), n_modes)
        return columns_of(np.full(shape, NO_EIGENVALUE), np.full(shape, -1))


def _run_all(scene: Source, names: Sequence[str], places: Sequence[tuple[Any, ...]], how: Mapping[str, Any],
             jobs: int, progress: Progress) -> list[Any]:
    """Per place its trace, or the error that kept it from beginning."""
    stopped = False

    def go_on(share: float, count: int) -> None:
        if stopped:
            raise KeyboardInterrupt

    def run(place: tuple[Any, ...]) -> Any:
        try:
            settings: Any = {**how.get("settings", {}), **dict(zip(names, place))}
            traced = trace_file(scene, **{**how, "settings": settings, "threads": 1, "progress": go_on})
        except (SceneError, TraceError) as error:
            return _Failed(error)
        return _Traced(traced)

    with ThreadPoolExecutor(jobs) as pool, bar(progress, "sweep") as show:
        futures: list[Future[Any]] = [pool.submit(run, place) for place in places]
        try:
            found = []
            for done, future in enumerate(futures):
                found.append(future.result())
                if show is not None:
                    show((done + 1) / len(futures), done + 1)
            return found
        except BaseException:
            stopped = True
            pool.shutdown(wait=False, cancel_futures=True)
            raise


class Runs(UserDict[tuple[Any, ...], Any]):
    """The Datasets of the traces by their values; the error of one that could not begin. Each is read when it is asked for."""

    def __getitem__(self, place: tuple[Any, ...]) -> Any:
        run = super().__getitem__(place)
        return run.loci() if isinstance(run, Run) else run


def _together(names: Sequence[str], values: Mapping[str, Sequence[Any]], places: Sequence[tuple[Any, ...]],
              runs: Sequence[Any], points: Any) -> xarray.Dataset:
    traced = [run for run in runs if isinstance(run, _Traced)]
    if not traced and isinstance(runs[0].run, SceneError):
        raise runs[0].run
    if not traced:
        raise TraceError(f"none of {len(runs)} traces could begin; the first: {runs[0].message}")
    loci = traced[0].run.loci()
    parameter = loci.attrs["parameter"]
    longest = max((run.path for run in traced), key=lambda path: abs(path[-1] - path[0]))
    at = np.asarray(points, float) if np.ndim(points) > 0 else np.linspace(longest[0], longest[-1], int(points))
    n_modes = max(run.n_modes for run in traced)
    shape = tuple(len(values[name]) for name in names)
    parts = _in_order(shape, runs, [run.at(at, n_modes) for run in runs], n_modes)
    coordinates = {name: _coordinate(name, values[name], loci) for name in names}
    coordinates[parameter] = (parameter, at, loci[parameter].attrs)
    coordinates["mode"] = ("mode", np.array([f"mode {i + 1}" for i in range(n_modes)], object))
    data = xarray.Dataset(coords=coordinates, attrs={"title": loci.attrs["title"], "parameter": parameter,
                                                     "scene": loci.attrs["scene"]})
    for column in COLUMNS:
        whole = np.stack([part[column] for part in parts])
        data[column] = ((*names, parameter, "mode"), whole.reshape(*shape, at.size, n_modes), loci[column].attrs)
    for name in ("flutter", "status", "message"):
        data[name] = (names, np.array([getattr(run, name) for run in runs]).reshape(shape))
    data["flutter"].attrs = dict(loci[parameter].attrs, long_name="first flutter")
    data["least_damping"] = data["damping_ratio"].min([parameter, "mode"]).assign_attrs(
        long_name="least damping ratio", units="1")
    data.encoding[RUNS] = Runs(zip(places, [run.run for run in runs]))
    return data


def _coordinate(name: str, values: Sequence[Any], loci: xarray.Dataset) -> tuple[Any, ...]:
    units = dict(zip(loci.scene_parameter.values, loci.scene_parameter_unit.values))
    texts = any(isinstance(value, str) for value in values)
    return (name, np.array([str(value) for value in values], object) if texts else np.asarray(values),
            {} if texts else {"units": units.get(name, "1")})


def _in_order(shape: tuple[int, ...], runs: Sequence[Any], parts: Sequence[Any], n_modes: int) -> list[Any]:
    """The columns of each trace with its modes in another order: the i-th one resembles the i-th one of the trace before it,
    along the last dimension and at its start along the one before."""
    from scipy.optimize import linear_sum_assignment

    order: list[Any] = []
    for i, run in enumerate(runs):
        before = _before(i, shape)
        order.append(np.arange(n_modes))
        if before is not None and run.shapes is not None and runs[before].shapes is not None:
            there, here = parts[before]["eigenvalue"][:, order[before]], parts[i]["eigenvalue"]
            unlike = 1.0 - _assurance(runs[before].shapes, run.shapes, n_modes)[order[before]]
            order[i] = linear_sum_assignment(unlike + TIE * _distance(there, here))[1]
    return [{name: column[:, order[i]] for name, column in part.items()} for i, part in enumerate(parts)]


def _before(i: int, shape: tuple[int, ...]) -> Optional[int]:
    index = np.unravel_index(i, shape)
    axis = max((axis for axis in range(len(shape)) if index[axis] > 0), default=None)
    return None if axis is None else i - int(np.prod(shape[axis + 1:]))


def _assurance(there: Any, here: Any, n_modes: int) -> Any:
    """Modal assurance of the modes where two traces begin, n_modes x n_modes; one half for modes that come later."""
    result = np.full((n_modes, n_modes), 0.5)
    if there.shape[-1] != here.shape[-1]:
        return result
    square = np.abs(there.conj() @ here.T) ** 2
    with np.errstate(invalid="ignore"):
        size = np.outer((np.abs(there) ** 2).sum(1), (np.abs(here) ** 2).sum(1))
        result[:len(there), :len(here)] = np.where(np.isfinite(size), square / size, 0.5)
    return result


def _distance(there: Any, here: Any) -> Any:
    """Mean distance of loci (value, mode) from each other, relative to the largest one."""
    distance = np.abs(there[:, :, np.newaxis] - here[:, np.newaxis, :])
    known = np.isfinite(distance)
    mean = np.where(known, distance, 0.0).sum(0) / np.maximum(known.sum(0), 1)
    mean[~known.any(0)] = mean.max(initial=1.0)
    return mean / max(mean.max(), 1e-300)
