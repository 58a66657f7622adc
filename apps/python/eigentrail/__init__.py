"""Follows eigenvalues of mechanical systems and of families of matrices while a parameter changes.

    import eigentrail as et
    loci = et.trace("rotor.toml", speed=(0, 400), tolerance=1e-8)    # an xarray Dataset
    loci.eigentrail.sel(speed=[120, 250])                            # eigenvalues anywhere on the trace, from the dense output
    loci.eigentrail.events                                           # a pandas DataFrame
    loci.eigentrail.campbell(harmonics=[1, 2])                       # a figure
    loci.eigentrail.save("out.h5")                                   # the file that the program writes
    loci = et.open("out.h5")

Examples of functions have the `scene` of that of `trace`.
"""

import sys
from typing import TYPE_CHECKING, Any

from .errors import Error, NotProjected, NotResolved, SceneError, TraceError
from .families import Family, Samples, StateSpace
from .files import open
from .gradients import gradient, least_damping
from .imports import Imported, from_files, from_openfast
from .linear import LinearModel
from .ross import from_ross
from .runs import accuracy, boundary, events, explain, linearize, map, spectrum, trace
from .sweep import sweep
from .version import __version__

__all__ = ["Eigentrail", "Error", "Family", "Imported", "LinearModel", "NotProjected", "NotResolved", "Samples", "SceneError", "StateSpace",
           "TraceError", "accuracy", "boundary", "events", "explain", "from_files", "from_openfast", "from_ross", "gradient",
           "least_damping", "linearize", "map", "open", "spectrum", "sweep", "trace", "__version__"]

if TYPE_CHECKING or "xarray" in sys.modules:  # somebody may have Datasets
    from .accessor import Eigentrail
else:
    def __getattr__(name: str) -> Any:
        """The accessor, which imports xarray."""
        if name != "Eigentrail":
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        from .accessor import Eigentrail
        return Eigentrail
