"""Reads the files of eigentrail into xarray.

    import eigentrail
    loci = eigentrail.open("out.h5")                   # an xarray Dataset
    loci.eigentrail.sel(omega=[12.5, 40])              # eigenvalues anywhere on the trace, from the dense output
    loci.eigentrail.events                             # a pandas DataFrame
"""

from .accessor import Eigentrail
from .files import open
from .version import __version__

__all__ = ["Eigentrail", "open", "__version__"]
