"""Compares loci files bit for bit."""

import h5py
import numpy as np

NOT_COMPARED = {"seconds"}  # the wall time of a run


def contents(path):
    """Attributes, and shapes, types and bytes of datasets, by name."""
    with h5py.File(path) as file:
        found = {("attribute", name): value for name, value in file.attrs.items() if name not in NOT_COMPARED}
        for name, item in file.items():
            values = item[()] if isinstance(item, h5py.Dataset) else np.zeros(0)
            found["dataset", name] = values.shape, values.dtype, values.tolist() if values.dtype.kind == "O" else values.tobytes()
        return found


def differences(a, b):
    """Names of attributes and datasets that are not the same in two files."""
    first, second = contents(a), contents(b)
    return [one[1] for one in {*first, *second} if one not in first or one not in second or first[one] != second[one]]
