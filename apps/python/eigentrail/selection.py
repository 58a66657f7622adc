"""Results between their stored points, from the dense output of a loci file or a boundary file, as Datasets."""

from __future__ import annotations

import numpy as np

from .engine import engine
from .errors import SceneError
from .later import xarray

# Datasets that hold the path of a trace, beside that of the parameter.
OF_PATH: tuple[str, ...] = ("eigenvalue", "step_length", "step_parameter", "dense_output", "dense_block", "dense_chart",
                            "mode_block", "certified")
# Bounds of the errors of eigenvalues that come from the data, per step and mode; only for sampled families.
DATA_ERRORS = ("interpolation_error", "digits_error")


def path_of(arrays, parameter):
    """The points of a trace and its dense output, in the engine; `arrays` has the datasets of a loci file by their names."""
    return engine().Path({name: np.asarray(arrays[name]) for name in (parameter, *OF_PATH)}, parameter)


def evaluated(path, certified, values):
    """Steps, eigenvalues and whether these are certified at all places with values (n) of the parameter.

    Steps (n, passage), -1 where a value has fewer places; the others (n, passage, mode). `certified` (step, mode): 1 or 0, or -1
    where a mode does not exist. At the end of a step, a mode that begins there has the value of the next step."""
    step, t = path.places(values)
    flags = np.vstack([certified, np.full(certified.shape[1], -1)])  # the last row: of no step
    begins = (t == 1.0)[..., np.newaxis] & (flags[step] == -1)
    return step, path.evaluate(step, t)[0], np.where(begins, flags[step + 1], flags[step])


def columns_of(s, certified):
    """What `sel` says of eigenvalues."""
    with np.errstate(invalid="ignore"):
        size = np.hypot(s.real, s.imag)  # to the last digit as `eval` has it; np.abs may be vectorized
        return {"eigenvalue": s, "frequency": size, "natural_frequency": size, "damped_frequency": np.abs(s.imag),
                "damping_ratio": -s.real / size, "certified": certified}


def mode_names(data):
    """Labels of modes ("mode 1"), and their names: the label where a mode has none."""
    labels = [str(label) for label in data.mode.values]
    names = data.mode_name.values if "mode_name" in data.coords else labels
    return labels, [str(name or label) for name, label in zip(names, labels)]


def mode_number(data, mode):
    """From 0: of a mode that is given by its number from 1, its label or its name."""
    labels, names = mode_names(data)
    number = {**{name: i for i, name in enumerate(names)}, **{label: i for i, label in enumerate(labels)}}
    if isinstance(mode, (int, np.integer)):
        if not 1 <= mode <= len(labels):
            raise SceneError(f"mode={mode}: the modes have the numbers 1 to {len(labels)}")
        return int(mode) - 1
    if mode not in number:
        raise SceneError(f"mode {mode!r}: expected one of {', '.join(map(repr, dict.fromkeys(labels + names)))}, or a number from "
                         f"1 to {len(labels)}")
    return number[mode]


class Selection:
    """Evaluates the dense output of a loci file at parameter values."""

    def __init__(self, loci):
        self._loci = loci
        self._parameter = loci[loci.attrs["parameter"]]
        if not loci.sizes["step"]:
            raise SceneError("the trace has no steps: there is nothing to evaluate between points")
        self._path = path_of(loci, self._parameter.name)

    def at(self, wanted):
        """Dataset at these values: along their dimension (none for a number), `passage` if the path turns back, and
        `mode`."""
        dimension, values = self._indexer(wanted)
        loci, parameter = self._loci, self._parameter
        step, s, certified = evaluated(self._path, loci.certified.values, values)
        missing = values[step[:, 0] < 0]
        if len(missing):
            ends = [f"{end:.15g}" for end in (parameter.values.min(), parameter.values.max())]
            unit = parameter.attrs["units"]
            raise SceneError(f"{parameter.name} = {missing[0]:.15g} lies outside the traced range "
                             f"{' ... '.join(ends)}{'' if unit == '1' else ' ' + unit}")
        columns = columns_of(s, certified)
        columns.update({name: np.where(np.isnan(s), np.nan, loci[name].values[step]) for name in DATA_ERRORS if name in loci})
        along = dimension or "place"
        words = {"long_name": "how often the path has taken the value before", "units": "1"}
        found = xarray.Dataset(
            {name: ((along, "passage", "mode"), column, loci[name].attrs) for name, column in columns.items()},
            coords={parameter.name: (along, values, parameter.attrs), "passage": ("passage", np.arange(s.shape[1]), words),
                    **{name: loci[name] for name in ("mode", "mode_name") if name in loci.variables}},
            attrs={"title": loci.attrs["title"]})
        if not self._path.turns_back:
            found = found.isel(passage=0, drop=True)
        return found if dimension else found.isel(place=0)

    def _indexer(self, wanted):
        """The name of the dimension (None for a number) and the values (n)."""
        try:
            values = np.asarray(wanted, float)
        except (TypeError, ValueError):
            raise SceneError(f"{self._parameter.name}: expected numbers, found {wanted!r}") from None
        if values.ndim > 1:
            raise SceneError(f"{self._parameter.name} = an array of shape {values.shape}: expected a number or a list")
        if not np.all(np.isfinite(values)):
            raise SceneError(f"{self._parameter.name}: expected finite numbers, found NaN or infinity")
        of_its_own = isinstance(wanted, xarray.DataArray) and wanted.dims
        dimension = None if values.ndim == 0 else wanted.dims[0] if of_its_own else self._parameter.name
        return dimension, np.atleast_1d(values)


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
