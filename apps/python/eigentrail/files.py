"""Opens loci, boundary, map and accuracy files as xarray Datasets."""

from __future__ import annotations

import builtins
import os
from collections.abc import Mapping
from typing import Any, Union

import numpy as np

from .checked import checked
from .engine import engine
from .errors import SceneError
from .later import xarray

SCHEMA = 1
EXPECTED = "expected a file of eigentrail trace, boundary, map or accuracy"
# Attributes by which HDF5 and xarray know dimensions and coordinates.
NOT_ATTRIBUTES = ("CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "coordinates")
# Keys of a Dataset's encoding.
IMAGE = "eigentrail_file"  # the bytes of its file
ATTACHED = "eigentrail_attached"  # matrices in memory that its scene names

# Variables that describe the rows of a file. They become coordinates and label plots and tables.
COORDINATES = {
    "eigentrail-loci": ["mode_name", "event_kind", "event_modes", "stable_kind", "coordinate_unit",
                        "scene_parameter_unit"],
    "eigentrail-boundary": ["point_curve", "step_curve", "curve_kind", "curve_mode", "corner_kind"],
    "eigentrail-map": ["axis_line", "axis_kind"],
    "eigentrail-accuracy": ["method", "run_tolerance", "order", "sample_parameter"],
}

Contents = tuple[dict[str, Any], dict[str, Any]]  # {name: (array, attributes)} of the datasets; attributes of the file


@checked
def open(path: Union[str, os.PathLike[str]]) -> xarray.Dataset:
    """Reads a file written by eigentrail into memory: an xarray Dataset with labels as coordinates.

    The accessor `.eigentrail` of the Dataset has functions for each kind of file; see `Eigentrail`. Raises ValueError for
    files of other programs and for damaged ones.
    """
    path = os.fspath(path)
    if path.endswith(".toml"):
        raise SceneError(f"{path}: is a scene, no result; give it to eigentrail.trace, which returns one")
    if os.path.exists(path) and not os.path.isfile(path):
        raise SceneError(f"{path}: is not a plain file; folders, pipes and devices are not read")
    with builtins.open(path, "rb") as file:
        return from_bytes(file.read(), path)


def from_bytes(image: bytes, path: str = "result") -> xarray.Dataset:
    """The same for the bytes of a file."""
    contents = engine().read_file(image, path)
    kind = _checked_format(path, contents[1])
    try:
        data = _dataset(contents)
        if kind == "eigentrail-loci":
            _add_event_kinds(data)
            _add_frequencies(data)
    except (AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
        raise ValueError(f"{path}: is damaged: {error}") from error
    data = data.set_coords([name for name in COORDINATES[kind] if name in data])
    data.encoding[IMAGE] = image
    return data


def save(data: xarray.Dataset, path: Union[str, os.PathLike[str]], overwrite: bool = False) -> None:
    """Writes the file that the Dataset was made from; the same bytes. A file that exists is kept, unless `overwrite`."""
    image = data.encoding.get(IMAGE)
    if image is None or not from_bytes(image).identical(data):
        raise SceneError("this Dataset is a part or a change of a result; save the one that trace, boundary, map or accuracy "
                         "has returned, or write this one with to_netcdf(path, engine='h5netcdf', invalid_netcdf=True)")
    write({os.fspath(path): image}, overwrite)


def write(contents: Mapping[str, bytes], overwrite: bool) -> None:
    """Writes one or two files, each as a whole, in their order. If one of them exists, none is written and FileExistsError is
    raised, unless `overwrite`, or a process was killed after it had written the first of two."""
    for path in contents:
        if os.path.exists(path) and not os.path.isfile(path):
            raise FileExistsError(f"{path}: is no regular file, and is not replaced")
        if not os.path.isdir(os.path.dirname(path) or "."):
            raise FileNotFoundError(f"{path}: there is no such folder")
    engine().write_files([(os.fsencode(path), content) for path, content in contents.items()], overwrite)


def _dataset(contents: Contents) -> xarray.Dataset:
    """What xarray.open_dataset gives for the file, in a fraction of its time."""
    datasets, of_file = contents
    variables: dict[str, Any] = {}
    labels: set[str] = set()
    for name, (array, attributes) in datasets.items():
        shown = {key: value for key, value in attributes.items() if key not in NOT_ATTRIBUTES}
        variables[name] = (tuple(attributes.get("DIMENSION_LIST", (name,) * array.ndim)), array, shown)
        labels.update(attributes.get("coordinates", "").split())
    coordinates = {name: value for name, value in variables.items() if value[0] == (name,) or name in labels}
    return xarray.Dataset({name: value for name, value in variables.items() if name not in coordinates}, coordinates, of_file)


def _checked_format(path: str, attributes: Mapping[str, Any]) -> str:
    kind = attributes.get("format")
    if not isinstance(kind, str):
        raise SceneError(f"{path}: has no attribute 'format'; {EXPECTED}")
    if kind not in COORDINATES:
        raise SceneError(f"{path}: holds {kind!r}; {EXPECTED}")
    if not np.array_equal(attributes.get("schema_version", 0), SCHEMA):
        raise SceneError(f"{path}: has schema {attributes.get('schema_version')}, this reader knows schema {SCHEMA}; "
                         "take the reader that came with the program that wrote it")
    return kind


def _add_frequencies(data: xarray.Dataset) -> None:
    """Both frequencies by their names: `natural_frequency` abs(s), which the file calls `frequency`, and `damped_frequency`
    abs(Im s), which files of earlier versions do not hold."""
    data["natural_frequency"] = data.frequency
    if "damped_frequency" not in data:
        names = {"long_name": "damped frequency abs(Im(s))", "units": "rad/s"}
        data["damped_frequency"] = np.abs(data.eigenvalue.imag).assign_attrs(names)


def _add_event_kinds(data: xarray.Dataset) -> None:
    """Adds `event_kind` and `event_modes`, the first and the last field of the lines in `events`."""
    words = [line.split(",") for line in data.events.values]
    for name, field, what in (("event_kind", 0, "what happens"), ("event_modes", -1, "numbers of the modes")):
        data[name] = ("event", np.array([line[field] for line in words], object), {"long_name": what, "units": "1"})
