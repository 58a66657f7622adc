"""Eigenvalues of a loci file at given values of its parameter, as a Dataset."""

import numpy as np
import xarray

from .dense_output import DenseOutput
from .errors import SceneError

# Bounds of the errors of eigenvalues that come from the data, per step and mode; only for sampled families.
DATA_ERRORS = ("interpolation_error", "digits_error")


class Selection:
    """Evaluates the dense output of a loci file at parameter values."""

    def __init__(self, loci):
        self._loci = loci
        self._parameter = loci[loci.attrs["parameter"]]
        if not loci.sizes["step"]:
            raise SceneError("the trace has no steps: there is nothing to evaluate between points")
        self._dense_output = DenseOutput(loci)

    def at(self, wanted):
        """Dataset at these values: along their dimension (none for a number), `passage` if the path turns back, and
        `mode`."""
        dimension, values = self._indexer(wanted)
        which, step, t = self._dense_output.path.positions(values)
        self._refuse_missing(values, which)
        passage = np.arange(len(which)) - np.searchsorted(which, which)
        shape = (len(values), passage.max(initial=0) + 1, self._loci.sizes["mode"])
        s = np.full(shape, complex(np.nan, np.nan))
        certified = np.full(shape, -1)
        s[which, passage] = self._dense_output.at(step, t)
        certified[which, passage] = self._dense_output.certified_at(step, t)
        errors = {name: np.full(shape, np.nan) for name in DATA_ERRORS if name in self._loci}
        for name, column in errors.items():
            column[which, passage] = self._loci[name].values[step]
            column[np.isnan(s)] = np.nan
        found = self._dataset(s, certified, errors, dimension or "place", values)
        if not self._dense_output.path.turns_back:
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

    def _refuse_missing(self, values, which):
        missing = np.setdiff1d(np.arange(len(values)), which)
        if len(missing):
            name, path = self._parameter.name, self._parameter.values
            unit = self._parameter.attrs["units"]
            raise SceneError(f"{name} = {values[missing[0]]:.15g} lies outside the traced range "
                             f"{path.min():.15g} ... {path.max():.15g}{'' if unit == '1' else ' ' + unit}")

    def _dataset(self, s, certified, errors, dimension, values):
        loci = self._loci
        with np.errstate(invalid="ignore"):
            columns = {"eigenvalue": s, "frequency": np.abs(s), "natural_frequency": np.abs(s),
                       "damped_frequency": np.abs(s.imag), "damping_ratio": -s.real / np.abs(s),
                       "certified": certified, **errors}
        dims = (dimension, "passage", "mode")
        labels = {name: loci[name] for name in ("mode", "mode_name") if name in loci.variables}
        return xarray.Dataset(
            {name: (dims, column, loci[name].attrs) for name, column in columns.items()},
            coords={self._parameter.name: (dimension, values, self._parameter.attrs),
                    "passage": ("passage", np.arange(s.shape[1]),
                                {"long_name": "how often the path has taken the value before", "units": "1"}), **labels},
            attrs={"title": loci.attrs["title"]})
