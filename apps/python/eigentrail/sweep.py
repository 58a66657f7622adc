"""Traces at many values of other parameters, on all cores."""

import itertools
import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, Optional

import numpy as np
import xarray

from .checked import checked
from .engine import engine
from .errors import SceneError, TraceError
from .given import Source, within
from .progress import Bar, Progress
from .files import FOR_SELECTION, part, part_like, read
from .runs import Run, trace_file

RUNS = "eigentrail_runs"  # key of a Dataset's encoding: the Datasets of the single traces
# Weight of the distance of loci beside modal assurance, both from 0 to 1: it decides where shapes are alike to a percent.
TIE = 0.01
COLUMNS = ("eigenvalue", "natural_frequency", "damped_frequency", "damping_ratio", "certified")


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

    >>> import eigentrail as et
    >>> scene = {"parameters": {"drag": 0.1, "p": 0.0}, "trace": {"parameter": "p", "from": 0, "to": 1},
    ...          "matrix_family": {"M": [[[1, 0], [0, 1]]], "C": [[["drag", 0], [0, "drag"]]],
    ...                            "K": [[[1, 0], [0, 2]], [[0, 1], [-1, 0]]]}}
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
    runs = _run_all(scene, names, places, how, points, jobs or os.cpu_count() or 1, progress)
    for remark in dict.fromkeys(remark for run in runs for remark in run.remarks):
        warnings.warn(remark, stacklevel=2)
    return _together(names, values, places, runs, points)


class _Traced:
    """A trace of a sweep, or the error that kept it from beginning."""

    def __init__(self, run: Any, contents: Any, like: Optional["_Traced"], points: Any):
        self.run = run
        self.remarks: list[str] = run.remarks if isinstance(run, Run) else []
        self.loci: Optional[xarray.Dataset] = None
        if isinstance(run, Run):
            known = None if like is None else like.loci
            self.loci = part(contents) if known is None else part_like(known, contents)
        self._values: Any = None  # at which the loci were evaluated: for most sweeps those of the first trace are common
        self._part: Optional[xarray.Dataset] = None
        if self.loci is not None:
            self.at(like._values if like is not None else _common_values([self.loci], self.loci.attrs["parameter"], points))

    def at(self, values: Any) -> Optional[xarray.Dataset]:
        """The loci at values of the traced parameter; None if nothing was traced."""
        if self.loci is not None and (self._part is None or not np.array_equal(values, self._values)):
            self._values, self._part = values, _at(self.loci, self.loci.attrs["parameter"], values)
        return self._part


def _run_all(scene: Source, names: Sequence[str], places: Sequence[tuple[Any, ...]], how: Mapping[str, Any], points: Any,
             jobs: int, progress: Progress) -> list[_Traced]:
    """Per place its trace. The first ones are read and evaluated while others run."""
    stopped = False

    def go_on(share: float, count: int) -> None:
        if stopped:
            raise KeyboardInterrupt

    def run(place: tuple[Any, ...]) -> Any:
        try:
            settings: Any = {**how.get("settings", {}), **dict(zip(names, place))}
            traced = trace_file(scene, **{**how, "settings": settings, "threads": 1, "progress": go_on})
        except TraceError as error:
            return error, None
        return traced, read(traced.image, names=FOR_SELECTION)

    with ThreadPoolExecutor(jobs) as pool, Bar(progress, "sweep") as show:
        futures: list[Future[Any]] = [pool.submit(run, place) for place in places]
        try:
            found: list[_Traced] = []
            for done, future in enumerate(futures):
                first = next((one for one in found if one.loci is not None), None)
                run_here, contents = future.result()
                found.append(_Traced(run_here, contents, first, points))
                if show is not None:
                    show((done + 1) / len(futures), done + 1)
            return found
        except BaseException:
            stopped = True
            for future in futures:
                future.cancel()
            raise


class Runs(Mapping[tuple[Any, ...], Any]):
    """The Datasets of the traces by their values; a TraceError where one could not begin. Each is read when it is asked for."""

    def __init__(self, places: Sequence[tuple[Any, ...]], traced: Sequence[Any]):
        self._runs = dict(zip(places, traced))

    def __getitem__(self, place: tuple[Any, ...]) -> Any:
        run = self._runs[place]
        return run.loci() if isinstance(run, Run) else run

    def __iter__(self) -> Iterator[tuple[Any, ...]]:
        return iter(self._runs)

    def __len__(self) -> int:
        return len(self._runs)


def _together(names: Sequence[str], values: Mapping[str, Sequence[Any]], places: Sequence[tuple[Any, ...]],
              runs: Sequence[_Traced], points: Any) -> xarray.Dataset:
    loci = [run.loci for run in runs if run.loci is not None]
    if not loci:
        raise TraceError(f"none of {len(runs)} traces could begin; the first: {runs[0].run}")
    parameter = loci[0].attrs["parameter"]
    if parameter in names:
        raise SceneError(f"{parameter}: is the traced parameter; give it a range, {parameter}=(from, to), and sweep others")
    at = _common_values(loci, parameter, points)
    parts = [run.at(at) for run in runs]
    n_modes = max(part.sizes["mode"] for part in parts if part is not None)
    shape = tuple(len(values[name]) for name in names)
    order = _orders(shape, runs, parts, n_modes)
    coordinates = {name: _coordinate(name, values[name], loci[0]) for name in names}
    coordinates[parameter] = (parameter, at, loci[0][parameter].attrs)
    coordinates["mode"] = ("mode", np.array([f"mode {i + 1}" for i in range(n_modes)], object))
    data = xarray.Dataset(coords=coordinates, attrs={"title": loci[0].attrs["title"], "parameter": parameter,
                                                     "scene": loci[0].attrs["scene"]})
    for column in COLUMNS:
        whole = np.stack([_column(part, column, order[i], at.size, n_modes) for i, part in enumerate(parts)])
        data[column] = ((*names, parameter, "mode"), whole.reshape(*shape, at.size, n_modes), loci[0][column].attrs)
    for name, of_run in (("flutter", _first_flutter), ("status", _status), ("message", _message)):
        data[name] = (names, np.array([of_run(run) for run in runs]).reshape(shape))
    data["flutter"].attrs = dict(loci[0][parameter].attrs, long_name="first flutter")
    data["least_damping"] = data["damping_ratio"].min([parameter, "mode"]).assign_attrs(
        long_name="least damping ratio", units="1")
    data.encoding[RUNS] = Runs(places, [run.run for run in runs])
    return data


def _common_values(loci: Sequence[xarray.Dataset], parameter: str, points: Any) -> Any:
    if np.ndim(points) > 0:
        return np.asarray(points, float)
    ends = [(run[parameter].values[0], run[parameter].values[-1]) for run in loci]
    longest = max(ends, key=lambda pair: abs(pair[1] - pair[0]))
    return np.linspace(*longest, int(points))


def _coordinate(name: str, values: Sequence[Any], loci: xarray.Dataset) -> tuple[Any, ...]:
    units = dict(zip(loci.scene_parameter.values, loci.scene_parameter_unit.values))
    texts = any(isinstance(value, str) for value in values)
    return (name, np.array([str(value) for value in values], object) if texts else np.asarray(values),
            {} if texts else {"units": units.get(name, "1")})


def _at(run: xarray.Dataset, parameter: str, at: Any) -> xarray.Dataset:
    """The loci at the values that the trace has reached, NaN elsewhere; of a path that turns back, the first passage."""
    path = run[parameter].values
    reached = at[(at >= path.min()) & (at <= path.max())]
    found = run.eigentrail.sel(**{parameter: reached})
    if "passage" in found.dims:
        found = found.isel(passage=0)
    return found.reindex({parameter: at}, fill_value={"certified": -1})


def _orders(shape: tuple[int, ...], runs: Sequence[_Traced], parts: Sequence[Any], n_modes: int) -> list[Any]:
    """Per trace the number of its mode that is the i-th one: that which resembles the i-th one of the trace before it, along
    the last dimension and at its start along the one before."""
    order: list[Any] = []
    for i, part in enumerate(parts):
        before = _before(i, shape)
        there = None if before is None else runs[before].loci
        here = runs[i].loci
        if before is None or there is None or here is None:
            order.append(np.arange(n_modes))
            continue
        unlike = 1.0 - _assurance(there, here, n_modes)[order[before]]
        order.append(_assignment(unlike + TIE * _distance(parts[before], order[before], part, n_modes)))
    return order


def _before(i: int, shape: tuple[int, ...]) -> Optional[int]:
    index = list(np.unravel_index(i, shape))
    for axis in reversed(range(len(shape))):
        if index[axis] > 0:
            index[axis] -= 1
            return int(np.ravel_multi_index(index, shape))
    return None


def _assurance(before: xarray.Dataset, run: xarray.Dataset, n_modes: int) -> Any:
    """Modal assurance of the modes where the traces begin, n_modes x n_modes; one half for modes that come later."""
    result = np.full((n_modes, n_modes), 0.5)
    there, here = before.mode_shape.values[0], run.mode_shape.values[0]
    if there.shape[-1] != here.shape[-1]:
        return result
    square = np.abs(there.conj() @ here.T) ** 2
    with np.errstate(invalid="ignore"):
        size = np.outer((np.abs(there) ** 2).sum(1), (np.abs(here) ** 2).sum(1))
        result[:len(there), :len(here)] = np.where(np.isfinite(size), square / size, 0.5)
    return result


def _distance(before: Any, order: Any, part: Any, n_modes: int) -> Any:
    """Mean distance of the loci, relative to the largest one."""
    there = _column(before, "eigenvalue", order, 0, n_modes)
    here = _column(part, "eigenvalue", np.arange(n_modes), 0, n_modes)
    distance = np.abs(there[:, :, np.newaxis] - here[:, np.newaxis, :])
    known = np.isfinite(distance)
    mean = np.where(known, distance, 0.0).sum(0) / np.maximum(known.sum(0), 1)
    mean[~known.any(0)] = mean.max(initial=1.0)
    return mean / max(mean.max(), 1e-300)


def _assignment(cost: Any) -> Any:
    from scipy.optimize import linear_sum_assignment

    return linear_sum_assignment(cost)[1]


def _column(part: Any, column: str, order: Any, count: int, n_modes: int) -> Any:
    fill: Any = {"eigenvalue": complex(np.nan, np.nan), "certified": -1}.get(column, np.nan)
    if part is None:
        return np.full((count, n_modes), fill)
    values = part[column].values
    whole = np.full((values.shape[0], n_modes), fill)
    whole[:, :values.shape[1]] = values
    return whole[:, order]


def _first_flutter(run: _Traced) -> float:
    if run.loci is None:
        return np.nan
    flutter = np.flatnonzero(run.loci.event_kind.values == "flutter")
    return float(run.loci.event_parameter.values[flutter[0]]) if len(flutter) else np.nan


def _status(run: _Traced) -> str:
    return "not traced" if run.loci is None else str(run.loci.attrs["status"])


def _message(run: _Traced) -> str:
    return str(run.run) if run.loci is None else str(run.loci.attrs.get("message", ""))
