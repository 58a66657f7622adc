"""The computations: traces, boundaries, maps, accuracy studies, spectra."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Optional, Union

import numpy as np

from . import files
from .checked import checked
from .engine import engine
from .errors import SceneError, TraceError, tell
from .given import Attached, Given, Source, give, number, option_text, within
from .later import pandas, xarray
from .linear import LinearModel
from .progress import Progress, bar

Options = list[tuple[str, str]]


@checked
def trace(scene: Source, *, tolerance: Optional[float] = None, modes: Any = None, certify: Optional[bool] = None,
          settings: Optional[Mapping[str, Any]] = None, options: Optional[Mapping[str, Any]] = None,
          events: Optional[Mapping[str, Any]] = None, threads: int = 0, progress: Progress = None,
          **parameters: Any) -> xarray.Dataset:
    """Follows the eigenvalues of a scene while a parameter changes: the Dataset that `open` gives for its loci file.

    `scene` is a path, the text of a scene, a dict of its tables, a `Family`, `Samples` or a `StateSpace`. Keywords are
    parameters of the scene: a pair is the range of the traced one, in its unit; other values replace those of the scene,
    as numbers in the declared unit, texts with a unit, or expressions:

        trace("rotor.toml", speed=(0, 400), bearing_damping=2000, tolerance=1e-8)
        trace(family, omega=(0, 400), modes=12)

    Without a range, [trace] of the scene gives it. `settings` is a dict of parameters whose names are keywords here.
    `tolerance` bounds the relative error of every eigenvalue, everywhere on the range (1e-6). `modes`: "all", a number, or a
    dict: dict(count=12, band=["0.05 Hz", "3 Hz"], damping_below=0.9). `options` are others of [trace]: order, reference,
    first_step, max_step, max_nodes, constant_modes, branch, without. `events` are entries of [events]: dict(harmonics=[1, 2]).

    Ctrl-C stops at the next point and keeps what there is: the attribute `status` is then "interrupted". A trace that ends
    before its range does has the status "ended early" and warns with the reason. Raises SceneError for bad input, and
    TraceError where nothing can be traced.

    >>> import eigentrail as et
    >>> scene = {"parameters": {"drag": 0.1, "p": 0.0}, "trace": {"parameter": "p", "from": 0, "to": 1},
    ...          "matrix_family": {"M": [[[1, 0], [0, 1]]], "C": [[["drag", 0], [0, "drag"]]],
    ...                            "K": [[[1, 0], [0, 2]], [[0, 1], [-1, 0]]]}}
    >>> loci = et.trace(scene, p=(0, 1), drag=0.2, tolerance=1e-9)
    >>> loci.attrs["status"], dict(loci.sizes)["mode"]
    ('completed', 2)
    >>> loci.eigentrail.sel(p=0).natural_frequency.values.round(6)              # rad/s
    array([1.      , 1.414214])
    """
    run = trace_file(scene, tolerance=tolerance, modes=modes, certify=certify, settings=settings, options=options,
                     events=events, threads=threads, progress=progress, **parameters)
    tell(run.remarks)
    return run.loci()


class Run(NamedTuple):
    """A trace as the engine leaves it."""

    image: bytes  # of the loci file
    remarks: list[str]
    attached: Attached

    def loci(self) -> xarray.Dataset:
        loci = files.from_bytes(self.image)
        loci.encoding[files.ATTACHED] = self.attached
        return loci


def trace_file(scene: Source, *, tolerance: Optional[float] = None, modes: Any = None, certify: Optional[bool] = None,
               settings: Optional[Mapping[str, Any]] = None, options: Optional[Mapping[str, Any]] = None,
               events: Optional[Mapping[str, Any]] = None, threads: int = 0, progress: Progress = None,
               **parameters: Any) -> Run:
    """The same without reading the file."""
    within("threads", threads, 1024)
    given = give(trace, scene, {**(settings or {}), **parameters}, tolerance, functions=True, events=events)
    chosen = _trace_options(given, options, tolerance=tolerance, modes=modes, certify=certify)
    outcome, remarks = _computed(given, progress, lambda show: engine().trace(given.scene, chosen, given.function, threads, show))
    if outcome.interrupted:
        remarks.append("interrupted: the Dataset has the points up to here")
    elif outcome.message:
        remarks.append(f"ended early: {outcome.message}")
    return Run(outcome.file, remarks, given.attached)


@checked
def boundary(scene: Source, *, tolerance: Optional[float] = None, damping_ratio: Optional[float] = None,
             lines: Optional[int] = None, settings: Optional[Mapping[str, Any]] = None, progress: Progress = None,
             **parameters: Any) -> xarray.Dataset:
    """The curves on which stability changes, in the plane of two parameters: the Dataset of a boundary file.

        boundary("rotor.toml", speed=(0, 400), bearing_damping=(500, 4000))

    The first range is that of the traced parameter (the one that [trace] names, if it is among them). With one range only,
    it is that of the second parameter. `damping_ratio`: the curves on which a pair has this damping ratio. `lines`: lines of
    the window that are searched in each direction (5). Raises KeyboardInterrupt for Ctrl-C.

    >>> curves = et.boundary(scene, p=(0, 1), drag=(0.05, 0.5))
    >>> curves.sizes["curve"], curves.curve_kind.values[0]
    (1, 'flutter')
    """
    given = give(boundary, scene, {**(settings or {}), **parameters}, tolerance)
    first, second = _two_ranges(given)
    low, high = (number(second, end) for end in given.ranges[second])
    from_, to = (number(first, end) for end in given.ranges[first]) if first in given.ranges else (None, None)
    options = {"parameter": first, "from": from_, "to": to, "tolerance": tolerance}
    chosen = [(key, option_text(value)) for key, value in options.items() if value is not None]
    return _result(given, progress, lambda show: engine().boundary(
        given.scene, chosen, second, low, high, damping_ratio, lines, show))


@checked
def map(scene: Source, *, grid: Union[int, tuple[int, int]] = 50, tolerance: Optional[float] = None,
        settings: Optional[Mapping[str, Any]] = None, options: Optional[Mapping[str, Any]] = None, jobs: int = 0,
        progress: Progress = None, **parameters: Any) -> xarray.Dataset:
    """Growing modes and margin on a grid over two parameters: the Dataset of a map file.

        map("rotor.toml", speed=(0, 400), bearing_damping=(500, 4000), grid=(40, 80))

    Ranges as for `boundary`. `grid`: values of the second parameter and of the first one, or one number for both. `jobs`:
    threads, 0 for one per core. Raises KeyboardInterrupt for Ctrl-C.

    >>> stability = et.map(scene, p=(0, 1), drag=(0.05, 0.5), grid=(4, 5))
    >>> stability.unstable.dims, int(stability.unstable.sel(p=0, drag=0.5))
    (('drag', 'p'), 0)
    """
    given = give(map, scene, {**(settings or {}), **parameters}, tolerance)
    first, second = _two_ranges(given)
    low, high = (number(second, end) for end in given.ranges[second])
    rows, columns = (grid, grid) if isinstance(grid, int) else grid
    chosen = _trace_options(given, options, first, tolerance=tolerance)
    return _result(given, progress, lambda show: engine().stability_map(
        given.scene, chosen, second, low, high, rows, columns, jobs, show))


@checked
def accuracy(scene: Source, *, tolerances: Optional[Sequence[float]] = None, orders: Sequence[int] = (1, 2, 3, 4),
             grids: Sequence[int] = (25, 50, 100, 200, 400, 800), samples: int = 200, repeat: int = 5,
             settings: Optional[Mapping[str, Any]] = None, progress: Progress = None, **parameters: Any) -> xarray.Dataset:
    """What accuracy costs: the error that is really met and the time, per tolerance, and those of other methods on grids.

    The Dataset of an accuracy file. `orders` of the power series, `grids`: points of the grids of the other methods,
    `samples`: values at which errors are measured, `repeat`: runs whose median time counts.

    >>> study = et.accuracy(scene, tolerances=[1e-6], orders=[4], grids=[25], samples=20, repeat=1)
    >>> bool(study.error.sel(run=0) < 1e-6)
    True
    """
    given = give(accuracy, scene, {**(settings or {}), **parameters})
    wanted = [10.0 ** -k for k in range(2, 13)] if tolerances is None else [float(t) for t in tolerances]
    return _result(given, progress, lambda show: engine().accuracy(
        given.scene, _trace_options(given), wanted, list(orders), list(grids), samples, repeat, show))


@checked
def spectrum(scene: Source, at: Any = None, *, modes: Any = None, settings: Optional[Mapping[str, Any]] = None,
             options: Optional[Mapping[str, Any]] = None, **parameters: Any) -> pandas.DataFrame:
    """The eigenvalues at one or several values of the traced parameter, by QZ: a table, one row per mode.

        spectrum("rotor.toml", at=120)

    Columns: the parameter, mode, eigenvalue (1/s), natural_frequency and damped_frequency (rad/s), damping_ratio, what_moves,
    condition; for samples also interpolation_error and digits_error (1/s). `at` is by default the value given for the parameter,
    or where [trace] begins.

    >>> et.spectrum(scene, at=0.25)[["p", "mode", "damped_frequency"]].round(4)
          p  mode  damped_frequency
    0  0.25     1            1.0317
    1  0.25     2            1.3894
    """
    given = give(spectrum, scene, {**(settings or {}), **parameters})
    found = engine().spectrum(given.scene, _trace_options(given, options, modes=modes, single=True), _values(given, at))
    table = pandas.DataFrame(_found(given, found, "rows"))
    return table.rename(columns={"parameter": given.scene.traced or next(iter(given.ranges), "parameter")})


@checked
def linearize(scene: Source, at: Any = None, *, inputs: Sequence[str] = (), settings: Optional[Mapping[str, Any]] = None,
              options: Optional[Mapping[str, Any]] = None, **parameters: Any) -> LinearModel:
    """Mass, damping and stiffness at one or several values of the traced parameter, with the tangent basis, the constraints and
    the state-space form: arrays by names, see `LinearModel`.

        model = linearize("rotor.toml", at=120, inputs=["thrust"])
        poles = scipy.linalg.eigvals(model.state_A, model.state_E)
        system = control.ss(*model.state_space(["tip.x", "rate of tip.x"]))

    `inputs`: parameters that forces of the scene contain; changes of their values are inputs, those of their rates (of the
    speed of a frame) are not. `at` as for `spectrum`.

    >>> et.linearize(scene, at=0.5).K
    array([[ 1. ,  0.5],
           [-0.5,  2. ]])
    """
    given = give(linearize, scene, {**(settings or {}), **parameters})
    found = engine().linearize(given.scene, _trace_options(given, options, single=True), _values(given, at), list(inputs))
    return LinearModel({name: array[0] if per_value and np.ndim(at) == 0 else array
                        for name, (array, per_value) in _found(given, found, "arrays").items()})


@checked
def explain(scene: Source, *, sensitivity: bool = False, settings: Optional[Mapping[str, Any]] = None,
            options: Optional[Mapping[str, Any]] = None, **parameters: Any) -> Explanation:
    """What a scene simulates and how it will be solved: effects, structure, sizes, solvers; a text.

    `sensitivity` ranks the effects by their influence on each mode where the trace begins.

    >>> print(et.explain(scene).splitlines()[0].strip())
    2 freedoms: 2 coordinates, no constraints.
    """
    given = give(explain, scene, {**(settings or {}), **parameters})
    text = engine().explain(given.scene, _trace_options(given, options, single=True), sensitivity)
    tell(given.warnings)
    return Explanation(text)


class Explanation(str):
    """A text of several lines that notebooks and interpreters show as it is."""

    def __repr__(self) -> str:
        return str(self)


@checked
def events(loci: xarray.Dataset) -> pandas.DataFrame:
    """Special points of a trace: a table, one row per event; the same as `loci.eigentrail.events`.

    >>> list(et.events(et.trace(scene)).kind)
    ['collision', 'flutter']
    """
    return loci.eigentrail.events


def _trace_options(given: Given, others: Optional[Mapping[str, Any]] = None, first: Optional[str] = None, *, single: bool = False,
                   **options: Any) -> Options:
    """Options as texts, those of the dict `others` too; `first` is the traced parameter, by default the one with a range. `single`:
    it may have a single value."""
    if first is None and given.ranges:
        if len(given.ranges) > 1:
            raise SceneError(f"expected the range of one parameter, found those of {', '.join(given.ranges)}")
        first = next(iter(given.ranges))
    traced = (others or {}).get("parameter", first or given.scene.traced)
    if traced in given.values and not single:
        raise SceneError(f"{traced}: is the traced parameter; give it a range, {traced}=(from, to)")
    twice = [key for key, value in options.items() if value is not None and key in (others or {})]
    if twice:
        raise SceneError(f"{twice[0]}: is a keyword, and among the options; give one of them")
    chosen = [(key, option_text(value)) for key, value in {**options, **(others or {})}.items() if value is not None]
    if first is None:
        return chosen
    named = [] if first == given.scene.traced else [("parameter", first)]
    ends = [(key, option_text(end)) for key, end in zip(("from", "to"), given.ranges.get(first, ()))]
    return named + ends + chosen


def _values(given: Given, at: Any) -> list[float]:
    """Of the traced parameter: those of `at`, by default the one that was given, if any."""
    if at is None:
        return [given.values[name] for name in [given.scene.traced] if name in given.values]
    return [number("at", value) for value in np.atleast_1d(at)]


def _found(given: Given, found: Mapping[str, Any], key: str) -> Any:
    """What was computed at single values; warns of the values at which nothing was."""
    faults = [f"{value:g}: {fault}" for value, fault in found["faults"]]
    if faults and not found[key]:
        raise TraceError(f"{given.scene.path}: {'; '.join(faults)}")
    tell(given.warnings + faults + found.get("notes", []))
    return found[key]


def _two_ranges(given: Given) -> tuple[Optional[str], str]:
    """Names of the traced parameter, None for that of [trace], and of the second one."""
    names, traced = list(given.ranges), given.scene.traced
    if len(names) == 1 and names[0] != traced:
        return (traced or None), names[0]
    if len(names) != 2:
        raise SceneError("expected the ranges of two parameters, such as speed=(0, 400), damping=(500, 4000); found "
                         + (", ".join(names) or "none"))
    if names[1] == traced:
        names.reverse()
    return names[0], names[1]


def _computed(given: Given, progress: Progress, compute: Callable[[Any], Any]) -> tuple[Any, list[str]]:
    """What the engine leaves, and what it and the scene have to say. `compute`: calls it with what shows the progress."""
    with bar(progress, given.scene.title or given.scene.path) as show:
        outcome = compute(show)
    remarks = given.warnings + outcome.remarks
    if not outcome.file:
        error = TraceError(f"{given.scene.path}: {outcome.message}")
        for remark in remarks:
            error.add_note(remark)
        raise error
    return outcome, remarks


def _result(given: Given, progress: Progress, compute: Callable[[Any], Any]) -> xarray.Dataset:
    outcome, remarks = _computed(given, progress, compute)
    tell(remarks + [outcome.message] * bool(outcome.message))
    return files.from_bytes(outcome.file)
