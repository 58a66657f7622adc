"""Opens loci, boundary, map and accuracy files as xarray Datasets."""

import builtins
import io
import os
import tempfile
from collections.abc import Iterable, Mapping
from typing import Any, Optional, Union

import h5py
import numpy as np
import xarray

from .errors import SceneError

SCHEMA = 1
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


def open(path: Union[str, "os.PathLike[str]"]) -> xarray.Dataset:
    """Reads a file written by eigentrail into memory: an xarray Dataset with labels as coordinates.

    The accessor `.eigentrail` of the Dataset has functions for each kind of file; see `Eigentrail`.
    """
    path = os.fspath(path)
    if path.endswith(".toml"):
        raise SceneError(f"{path}: is a scene, no result; give it to eigentrail.trace, which returns one")
    if os.path.exists(path) and not os.path.isfile(path):
        raise SceneError(f"{path}: is not a plain file; folders, pipes and devices are not read")
    with builtins.open(path, "rb") as file:
        image = file.read()
    try:
        with h5py.File(path, "r") as file:
            return _labelled(file, path, image)
    except BlockingIOError as error:
        raise BlockingIOError(f"{path}: is still being written; wait until its trace has ended") from error
    except OSError as error:
        raise SceneError(f"{path}: is no HDF5 file; expected a file of eigentrail trace, boundary, map or accuracy") from error


def from_bytes(image: bytes) -> xarray.Dataset:
    """The same for the bytes of a file."""
    with h5py.File(io.BytesIO(image), "r") as file:
        return _labelled(file, "result", image)


# What the dense output needs, and what a sweep says of a trace.
FOR_SELECTION = ("step", "mode", "mode_name", "eigenvalue", "frequency", "damped_frequency", "damping_ratio", "certified",
                 "mode_block", "dense_block", "dense_chart", "step_length", "dense_output", "step_parameter",
                 "interpolation_error", "digits_error", "mode_shape", "events", "event_parameter", "scene_parameter",
                 "scene_parameter_unit")


def part_from_bytes(image: bytes) -> xarray.Dataset:
    """Of a loci file only what `sel` and a sweep need."""
    with h5py.File(io.BytesIO(image), "r") as file:
        data = _dataset(file, (*FOR_SELECTION, file.attrs["parameter"]))
    data["natural_frequency"] = data.frequency
    _add_event_kinds(data)
    return data


def part_like(like: xarray.Dataset, arrays: Mapping[str, Any], attributes: Mapping[str, str]) -> xarray.Dataset:
    """The same from arrays and texts that `read_datasets` of the engine gives for the file; `like` is that part of a file of
    the same scene, which has the same names of dimensions and attributes of datasets."""
    values = dict(arrays, natural_frequency=arrays["frequency"])
    values["event_kind"], values["event_modes"] = _event_fields(values["events"])
    variables = {name: xarray.Variable(like[name].dims, array, like[name].attrs, fastpath=True)
                 for name, array in values.items()}
    return xarray.Dataset({name: one for name, one in variables.items() if name not in like.coords},
                          {name: one for name, one in variables.items() if name in like.coords}, attributes)


def save(data: xarray.Dataset, path: Union[str, "os.PathLike[str]"], overwrite: bool = False) -> None:
    """Writes the file that the Dataset was made from; the same bytes. A file that exists is kept, unless `overwrite`."""
    image = data.encoding.get(IMAGE)
    if image is None or not from_bytes(image).identical(data):
        raise SceneError("this Dataset is a part or a change of a result; save the one that trace, boundary, map or accuracy "
                         "has returned, or write this one with to_netcdf")
    write({os.fspath(path): image}, overwrite)


def write(contents: Mapping[str, bytes], overwrite: bool) -> None:
    """Writes files, each as a whole. If one of them exists, none is written and FileExistsError is raised, unless `overwrite`."""
    for path in contents:
        if os.path.lexists(path) and not overwrite:
            raise FileExistsError(f"{path}: exists; give another name, or overwrite=True")
        if os.path.exists(path) and not os.path.isfile(path):
            raise FileExistsError(f"{path}: is no regular file, and is not replaced")
    for path, content in contents.items():
        replace(path, content)


def replace(path: str, image: bytes) -> None:
    """Writes bytes to a file, which is then either the complete new one or the old one."""
    if not os.path.isdir(os.path.dirname(path) or "."):
        raise FileNotFoundError(f"{path}: there is no such folder")
    handle, partial = tempfile.mkstemp(dir=os.path.dirname(path) or ".", prefix=os.path.basename(path) + ".partial.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(image)
            os.fchmod(file.fileno(), 0o666 & ~_umask())
            file.flush()
            os.fsync(file.fileno())
        os.replace(partial, path)
    except BaseException:
        os.unlink(partial)
        raise


def _labelled(file: Any, path: str, image: bytes) -> xarray.Dataset:
    kind = _checked_format(path, file.attrs)
    data = _dataset(file)
    if kind == "eigentrail-loci":
        _add_event_kinds(data)
        _add_frequencies(data)
    data = data.set_coords([name for name in COORDINATES[kind] if name in data])
    data.encoding[IMAGE] = image
    return data


def _dataset(file: Any, names: Optional[Iterable[str]] = None) -> xarray.Dataset:
    """What xarray.open_dataset gives for the file, in a fraction of its time: all datasets, or those of `names`, with the
    names of their dimensions."""
    variables: dict[str, Any] = {}
    labels: set[str] = set()
    for name in file if names is None else [name for name in names if name in file]:
        dataset = file[name]
        if not isinstance(dataset, h5py.Dataset):
            continue  # the type of complex numbers
        attributes = {key: _plain(value) for key, value in dataset.attrs.items() if key not in NOT_ATTRIBUTES}
        variables[name] = (_dimensions(file, name, dataset), _values(dataset), attributes)
        labels.update(dataset.attrs.get("coordinates", "").split())
    coordinates = {name: value for name, value in variables.items() if value[0] == (name,) or name in labels}
    return xarray.Dataset({name: value for name, value in variables.items() if name not in coordinates}, coordinates,
                          {key: _plain(value) for key, value in file.attrs.items()})


def _values(dataset: Any) -> Any:
    return dataset.asstr()[()] if h5py.check_string_dtype(dataset.dtype) is not None else dataset[()]


def _dimensions(file: Any, name: str, dataset: Any) -> tuple[str, ...]:
    references = dataset.attrs.get("DIMENSION_LIST")
    if references is None:
        return (name,) * dataset.ndim
    return tuple(h5py.h5r.get_name(one[0], file.id).decode()[1:] for one in references)


def _plain(value: Any) -> Any:
    return value.decode() if isinstance(value, bytes) else value


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _checked_format(path: str, attributes: Mapping[str, Any]) -> str:
    expected = "expected a file of eigentrail trace, boundary, map or accuracy"
    kind: Optional[str] = attributes.get("format")
    if kind is None:
        raise SceneError(f"{path}: has no attribute 'format'; {expected}")
    if kind not in COORDINATES:
        raise SceneError(f"{path}: holds {kind!r}; {expected}")
    if attributes.get("schema_version") != SCHEMA:
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
    """Adds `event_kind` and `event_modes`."""
    kinds, modes = _event_fields(data.events.values)
    data["event_kind"] = ("event", kinds, {"long_name": "what happens", "units": "1"})
    data["event_modes"] = ("event", modes, {"long_name": "numbers of the modes", "units": "1"})


def _event_fields(lines: Any) -> tuple[Any, Any]:
    """The first and the last field of the lines in `events`."""
    words = [line.split(",") for line in lines]
    return np.array([line[0] for line in words], object), np.array([line[-1] for line in words], object)
