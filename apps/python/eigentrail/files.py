"""Opens loci, boundary, map and accuracy files as xarray Datasets."""

import builtins
import io
import os
import tempfile

import h5py
import numpy as np
import xarray

SCHEMA = 1
# Keys of a Dataset's encoding.
IMAGE = "eigentrail_file"  # the bytes of its file
SCENE_FILES = "eigentrail_scene_files"  # files of matrices in memory that its scene names: their bytes by name

# Variables that describe the rows of a file. They become coordinates and label plots and tables.
COORDINATES = {
    "eigentrail-loci": ["mode_name", "event_kind", "event_modes", "stable_kind", "coordinate_unit",
                        "scene_parameter_unit"],
    "eigentrail-boundary": ["point_curve", "step_curve", "curve_kind", "curve_mode", "corner_kind"],
    "eigentrail-map": ["axis_line", "axis_kind"],
    "eigentrail-accuracy": ["method", "run_tolerance", "order", "sample_parameter"],
}


def open(path):
    """Reads a file written by eigentrail into memory: an xarray Dataset with labels as coordinates.

    The accessor `.eigentrail` of the Dataset has functions for each kind of file; see `Eigentrail`.
    """
    with builtins.open(path, "rb") as file:
        bytes_of_file = file.read()
    with _opened(os.fspath(path)) as file:
        return _labelled(file, os.fspath(path), bytes_of_file)


def from_bytes(image):
    """The same for the bytes of a file."""
    with xarray.open_dataset(io.BytesIO(image), engine="h5netcdf", decode_times=False) as file:
        return _labelled(file, "result", image)


def save(data, path, force=False):
    """Writes the file that the Dataset was made from; the same bytes. Replaces files of eigentrail of the same kind, others
    only with `force`. The file is replaced as a whole."""
    image = data.encoding.get(IMAGE)
    if image is None or not from_bytes(image).identical(data):
        raise ValueError("this Dataset is a part or a change of a result; save the one that trace, boundary, map or accuracy "
                         "has returned, or write this one with to_netcdf")
    path = os.fspath(path)
    if os.path.exists(path) and not force and _kind_of(path) != data.attrs["format"]:
        raise FileExistsError(f"{path}: exists and is no file of the kind {data.attrs['format']}; give another name, or "
                              "force=True")
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


def _labelled(file, path, image):
    kind = _checked_format(path, file.attrs)
    data = file.load()
    if kind == "eigentrail-loci":
        data = _with_frequencies(_with_event_kinds(data))
    data = data.set_coords([name for name in COORDINATES[kind] if name in data])
    data.encoding[IMAGE] = image
    return data


def _kind_of(path):
    try:
        with h5py.File(path, "r") as file:
            return file.attrs.get("format")
    except OSError:
        return None


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _opened(path):
    try:
        return xarray.open_dataset(path, engine="h5netcdf", decode_times=False)
    except BlockingIOError as error:
        raise BlockingIOError(f"{path}: is still being written; wait until its trace has ended") from error


def _checked_format(path, attributes):
    expected = "expected a file of eigentrail trace, boundary, map or accuracy"
    kind = attributes.get("format")
    if kind is None:
        raise ValueError(f"{path}: has no attribute 'format'; {expected}")
    if kind not in COORDINATES:
        raise ValueError(f"{path}: holds {kind!r}; {expected}")
    if attributes.get("schema_version") != SCHEMA:
        raise ValueError(f"{path}: has schema {attributes.get('schema_version')}, this reader knows schema {SCHEMA}; "
                         "take the reader that came with the program that wrote it")
    return kind


def _with_frequencies(data):
    """Both frequencies by their names: `natural_frequency` abs(s), which the file calls `frequency`, and `damped_frequency`
    abs(Im s), which files of earlier versions do not hold."""
    data = data.assign(natural_frequency=data.frequency)
    if "damped_frequency" not in data:
        names = {"long_name": "damped frequency abs(Im(s))", "units": "rad/s"}
        data = data.assign(damped_frequency=np.abs(data.eigenvalue.imag).assign_attrs(names))
    return data


def _with_event_kinds(data):
    """Adds `event_kind` and `event_modes`, the first and the last field of the lines in `events`."""
    words = [line.split(",") for line in data.events.values]

    def texts(place, long_name):
        return "event", np.array([line[place] for line in words], object), {"long_name": long_name, "units": "1"}

    return data.assign(event_kind=texts(0, "what happens"), event_modes=texts(-1, "numbers of the modes"))
