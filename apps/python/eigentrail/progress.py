"""Progress of long computations."""

import os
import sys
import warnings
from typing import Any, Callable, Optional, Union

Progress = Union[bool, None, Callable[[float, int], Any]]


class Bar:
    """A bar of tqdm, where it is installed; it appears when a computation takes longer than a second."""

    def __init__(self, wanted: Progress, unit: str):
        self._show = wanted if callable(wanted) else None
        self._bar: Optional[Any] = None
        if wanted is True or (wanted is None and _watched()):
            self._bar = _tqdm(unit)

    def __enter__(self) -> Optional[Callable[[float, int], Any]]:
        if self._show is not None:
            return self._show
        return None if self._bar is None else self._update

    def __exit__(self, *error: Any) -> None:
        if self._bar is not None:
            self._bar.close()

    def _update(self, share: float, count: int) -> None:
        bar = self._bar
        assert bar is not None
        bar.set_postfix_str(str(count), refresh=False)
        bar.update(max(0.0, min(1.0, share)) - bar.n)


def _watched() -> bool:
    """Whether somebody sees the bar: a notebook or a terminal, unless the environment says EIGENTRAIL_PROGRESS=off."""
    if os.environ.get("EIGENTRAIL_PROGRESS") == "off":
        return False
    return "ipykernel" in sys.modules or sys.stderr.isatty()


def _tqdm(unit: str) -> Optional[Any]:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # tqdm warns of widgets that are not installed
            from tqdm.auto import tqdm
            return tqdm(total=1.0, delay=1.0, leave=False, desc=unit,
                        bar_format="{desc} {percentage:3.0f}% |{bar}| {postfix} {elapsed}")
    except ImportError:
        return None
