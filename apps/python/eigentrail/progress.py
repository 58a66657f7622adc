"""Progress of long computations."""

import os
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Callable, Optional, Union

Progress = Union[bool, None, Callable[[float, int], Any]]


@contextmanager
def bar(wanted: Progress, what: str) -> Iterator[Optional[Callable[[float, int], Any]]]:
    """What shows the progress: the user's function, or a bar of tqdm, where it is installed, which appears when a computation
    takes longer than a second; else None."""
    shown: Any = _tqdm(what) if wanted is True or (wanted is None and _watched()) else None
    if shown is None:
        yield wanted if callable(wanted) else None
        return

    def update(share: float, count: int) -> None:
        shown.set_postfix_str(str(count), refresh=False)
        shown.update(max(0.0, min(1.0, share)) - shown.n)

    with shown:
        yield update


def _watched() -> bool:
    """Whether somebody sees the bar: a notebook or a terminal, unless the environment says EIGENTRAIL_PROGRESS=off."""
    if os.environ.get("EIGENTRAIL_PROGRESS") == "off":
        return False
    return "ipykernel" in sys.modules or sys.stderr.isatty()


def _tqdm(unit: str) -> Any:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # tqdm warns of widgets that are not installed
            from tqdm.auto import tqdm
            return tqdm(total=1.0, delay=1.0, leave=False, desc=unit,
                        bar_format="{desc} {percentage:3.0f}% |{bar}| {postfix} {elapsed}")
    except ImportError:
        return None
