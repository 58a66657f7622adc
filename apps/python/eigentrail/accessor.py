"""The accessor `.eigentrail` of Datasets."""

import os
from collections.abc import Mapping
from functools import cached_property
from typing import Any, Union

import numpy as np
import pandas
import xarray

from . import files, ross
from .figures import Figures
from .selection import Selection, curve, mode_names, mode_number


@xarray.register_dataset_accessor("eigentrail")
class Eigentrail(Figures):
    """For a loci file: `sel`, `nearest`, `events`, `stable_ranges`, `parameter`; for a boundary file: `curve`.

    Figures: `campbell`, `root_locus`, `damping`, `mode_shape`, `plane`, `work_precision`; see `figures.Figures`."""

    def sel(self, mode: Any = None, **at: Any) -> xarray.Dataset:
        """Eigenvalues at any values of the traced parameter, from the dense output: `sel(omega=[12.5, 40])`.

        Returns a Dataset of eigenvalue, natural_frequency abs(s) (also as `frequency`), damped_frequency abs(Im s),
        damping_ratio and certified along parameter and mode, for a sampled family also of interpolation_error and digits_error (1/s), the bounds of the errors that come from the samples. The values may
        be a number (then without dimension), a list, an array, or a DataArray, whose dimension is kept. If the path
        turns back, there is also a dimension `passage`: the first, second, ... place of the path with the value; NaN
        where there are fewer. `mode` is a number from 1, a label ("mode 1") or a name ("blade lag"), or a list of these.
        """
        return self._modes(self._selection.at(self._wanted(at)), mode)

    def nearest(self, mode: Any = None, **at: Any) -> xarray.Dataset:
        """The data of the stored point nearest to a value of the parameter: mode shapes, equilibrium, and others.

        Example: nearest(omega=12.5, mode="blade lag").mode_shape. For a large model that was projected, the mode shapes are
        those of the large model, along `freedom`.
        """
        loci, value = self._of("loci"), float(self._wanted(at))
        at_points = loci[[name for name, variable in loci.data_vars.items() if "node" in variable.dims]]
        distance = np.abs(loci[self.parameter].values - value)
        at_point = self._modes(at_points.isel(node=int(distance.argmin())), mode)
        if "projection_basis" in loci:
            shapes = xarray.dot(loci.projection_basis, at_point.mode_shape, dims="coordinate")
            at_point["mode_shape"] = shapes.transpose(..., "freedom").assign_attrs(at_point.mode_shape.attrs)
        return at_point

    @property
    def events(self) -> pandas.DataFrame:
        """Special points of a trace as a pandas DataFrame: one row per special point, in the order of the trace.

        For a sampled family, `interval_from` and `interval_to` are the parameter values between which it lies as far as the
        errors of the data tell; NaN for kinds that have no interval."""
        loci, names = self._of("loci"), ["kind", "parameter", "eigenvalue", "modes", "direction", "value", "half_width", "node"]
        index = pandas.Index(loci.event.values, name="event")
        table = pandas.DataFrame({name: loci[f"event_{name}"].values for name in names}, index)
        of_modes = mode_names(loci)[1]  # a mode without a name has its label, "mode 1"
        table["modes"] = ["; ".join(of_modes[int(number) - 1] for number in text.split(";") if number) for text in table["modes"]]
        table = table.rename(columns={"parameter": self.parameter})
        if "event_interval" in loci:  # of a sampled family
            table["interval_from"], table["interval_to"] = loci.event_interval.values.reshape(-1, 2).T
        return table

    @property
    def stable_ranges(self) -> pandas.DataFrame:
        """Ranges of a trace on which no mode grows, as a pandas DataFrame, in the order of the trace. Where `whole_model` is
        False it holds for the followed modes only."""
        loci = self._of("loci")
        table = {"kind": loci.stable_kind.values, "from": loci.stable_from.values, "to": loci.stable_to.values}
        for end, name in (("left", "from"), ("right", "to")):
            for what in ("cause", "margin", "mode"):
                table[f"{what}_{name}"] = loci[f"stable_{what}"].sel(end=end).values
        for name in ("least_margin", "largest_margin", "largest_at"):
            table[name] = loci[f"stable_{name}"].values
        table["whole_model"] = loci.stable_whole.values == 1 if "stable_whole" in loci else False
        return pandas.DataFrame(table, index=pandas.Index(loci.range.values, name="range"))

    def save(self, path: Union[str, os.PathLike[str]], overwrite: bool = False) -> None:
        """Writes the file that the program would write for this result. A file that exists is kept (FileExistsError), unless
        `overwrite`."""
        files.save(self._data, path, overwrite)

    @property
    def runs(self) -> Mapping[tuple[Any, ...], Any]:
        """Of a sweep: the Datasets of its traces by their values, `runs[2000,]`; an error where one could not begin."""
        return self._data.encoding.get("eigentrail_runs", {})

    def whirl(self) -> xarray.DataArray:
        """Direction and shape of the orbits of the nodes of a rotor, per stored point, mode and node; see `eigentrail.ross`."""
        return ross.whirl(self._of("loci"))

    def curve(self, number: int, points: int = 200) -> xarray.Dataset:
        """One curve of a boundary file (`number` from 0) at `points` places, from its dense output.

        Returns a Dataset along `point`."""
        return curve(self._of("boundary"), number, points)

    @cached_property
    def _selection(self) -> Selection:
        return Selection(self._of("loci"))

    def _modes(self, data: xarray.Dataset, wanted: Any) -> xarray.Dataset:
        """`data` of the modes with these numbers, labels or names; of all modes for None."""
        if wanted is None:
            return data
        one = isinstance(wanted, (str, int, np.integer))
        return data.isel(mode=mode_number(data, wanted) if one else [mode_number(data, name) for name in wanted])
