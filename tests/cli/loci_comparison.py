"""Compares loci files bit for bit."""

import h5py
import numpy as np

NOT_COMPARED = {"seconds"}  # the wall time of a run


def same(a, b):
    if a.shape != b.shape or a.dtype != b.dtype:
        return False
    if a.dtype.kind == "O":
        return bool((a[()] == b[()]).all())
    return np.asarray(a[()]).tobytes() == np.asarray(b[()]).tobytes()


def differences(a, b):
    """Names of attributes and datasets that are not the same in two files."""
    with h5py.File(a) as first, h5py.File(b) as second:
        attributes = [name for name in {*first.attrs, *second.attrs} - NOT_COMPARED
                      if name not in first.attrs or name not in second.attrs or first.attrs[name] != second.attrs[name]]
        datasets = [name for name in {*first, *second}
                    if name not in first or name not in second
                    or isinstance(first[name], h5py.Dataset) and not same(first[name], second[name])]
        return attributes + datasets
