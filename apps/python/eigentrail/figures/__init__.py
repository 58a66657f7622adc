"""Figures of results: `loci.eigentrail.campbell()` and others.

A figure is first a description (`picture`), with all places decided; `with_plotly` and `with_matplotlib` draw it. The libraries
are imported when a figure is drawn.
"""

from importlib import import_module
from typing import Any, Mapping, Optional, Sequence, Union

import xarray

from . import planes, shapes, studies, trace_figures
from ..errors import SceneError
from .picture import Picture

Size = Optional[tuple[float, float]]
BACKENDS = {"plotly": "with_plotly", "matplotlib": "with_matplotlib"}


def drawn(picture: Picture, backend: str) -> Any:
    """The figure of a library."""
    if backend not in BACKENDS:
        raise SceneError(f"backend={backend!r}: expected one of {', '.join(map(repr, BACKENDS))}")
    return import_module(f".{BACKENDS[backend]}", __name__).draw(picture)


class Figures:
    """The figures of the accessor `.eigentrail`. Each is a plotly figure, or with backend="matplotlib" a matplotlib one.

    `size`: width and height in inches.
    """

    def __init__(self, data: xarray.Dataset):
        self._data = data

    @property
    def parameter(self) -> str:
        """Name of the traced parameter."""
        return self._of("loci").attrs["parameter"]

    def _of(self, kind: str) -> xarray.Dataset:
        found = self._data.attrs.get("format")
        if found != f"eigentrail-{kind}":
            raise SceneError(f"only {kind} files have this; the Dataset is of the format {found!r}")
        return self._data

    def _wanted(self, at: Mapping[str, Any]) -> Any:
        """The value of the only keyword, which must be the name of the parameter."""
        if list(at) != [self.parameter]:
            found = ", ".join(f"{name}=..." for name in at) or "nothing"
            raise TypeError(f"expected the traced parameter, {self.parameter}=..., found {found}")
        return at[self.parameter]

    def campbell(self, harmonics: Optional[Sequence[float]] = None, unit: Optional[str] = None, backend: str = "plotly",
                 log: bool = False, size: Size = None) -> Any:
        """Campbell diagram: damped frequency over the parameter, the damping ratio (percent) below.

        `harmonics`: multiples of the excitation frequency to draw as rays; by default those of the scene, an empty list for
        none. The axis then ends at the highest ray. `unit` of the frequency: rad/s, Hz, rpm, rev/s, deg/s; by default that of
        the parameter if it is an angular velocity, else Hz. `log`: logarithmic frequency."""
        return drawn(trace_figures.campbell_picture(self._of("loci"), harmonics, unit, log, size), backend)

    def root_locus(self, unit: Optional[str] = None, backend: str = "plotly", size: Size = None) -> Any:
        """Im s (in `unit`) over Re s (1/s); a ring where a mode begins, a dot where it ends."""
        return drawn(trace_figures.root_locus_picture(self._of("loci"), unit, size), backend)

    def damping(self, backend: str = "plotly", size: Size = None) -> Any:
        """Damping ratio (percent) of oscillating modes over the parameter."""
        return drawn(trace_figures.damping_picture(self._of("loci"), size), backend)

    def mode_shape(self, mode: Union[int, str], view: str = "3D", backend: str = "plotly", size: Size = None,
                   **at: float) -> Any:
        """The shape of a mode at the stored point nearest to a value of the parameter: mode_shape(omega=120, mode=3).

        `mode`: number from 1, label or name. Scenes of points and bodies are drawn as on the report page, displaced where the
        largest component is real, with the orbits of points; `view`: "3D", "xy", "xz", "yz". Rotors whose nodes lie on a
        straight line are drawn as their bent axis, families of matrices as bars."""
        return drawn(shapes.shape_picture(self._of("loci"), self._wanted(at), mode, view, size), backend)

    def plane(self, boundary: Optional[xarray.Dataset] = None, backend: str = "plotly", size: Size = None) -> Any:
        """The plane of two parameters: the cells of a map file by their growing modes, with the located events on its lines;
        the curves of a boundary file. `boundary`: Dataset of a boundary file to draw on a map."""
        data = self._data if self._data.attrs.get("format") == "eigentrail-boundary" else self._of("map")
        return drawn(planes.plane_picture(data, boundary, size), backend)

    def work_precision(self, work: str = "wall_time", backend: str = "plotly", size: Size = None) -> Any:
        """Largest relative error over the work of all runs of an accuracy study. `work`: wall_time (s), factorizations or
        points."""
        return drawn(studies.work_precision_picture(self._of("accuracy"), work, size), backend)
