"""xarray and pandas, which take a second to import: they are imported when a result is first asked for.

`from .later import pandas, xarray` in place of their import; annotations that name them are texts, by
`from __future__ import annotations`.
"""

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any


class Later(ModuleType):
    """A module that is imported at the first use of what it has."""

    def __getattr__(self, name: str) -> Any:
        module = import_module(self.__name__)
        import_module(".accessor", __package__)  # registers `.eigentrail` of Datasets
        return getattr(module, name)


if TYPE_CHECKING:
    import pandas as pandas
    import xarray as xarray
else:
    pandas, xarray = Later("pandas"), Later("xarray")
