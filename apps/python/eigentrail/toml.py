"""Scenes as TOML text, from dictionaries."""

import json
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from .matrices import exact, is_sparse

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def dumps(scene: Mapping[str, Any]) -> str:
    """The text of a scene given as a dictionary: tables are dictionaries, arrays of tables lists of dictionaries.

    >>> print(dumps({"title": "a", "trace": {"from": 1}, "point": [{"name": "p"}, {"name": "q"}]}))
    title = "a"
    <BLANKLINE>
    [trace]
    from = 1
    <BLANKLINE>
    [[point]]
    name = "p"
    <BLANKLINE>
    [[point]]
    name = "q"
    <BLANKLINE>
    """
    plain = [f"{_key(key)} = {value_text(value)}" for key, value in scene.items() if not _is_table(value)]
    parts = ["\n".join(plain)] if plain else []
    for key, value in scene.items():
        if isinstance(value, Mapping):
            parts.append(_table(f"[{_key(key)}]", value))
        elif _is_table(value):
            parts.extend(_table(f"[[{_key(key)}]]", item) for item in value)
    return "\n\n".join(parts) + "\n"


def value_text(value: Any) -> str:
    """One value as TOML; expressions are texts."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, complex, np.floating, np.complexfloating)):
        if value.imag != 0.0:
            raise TypeError(f"a scene holds real numbers, not {value}")
        return repr(float(value.real))  # also "inf" and "nan"
    if hasattr(value, "__array__") or is_sparse(value):
        return value_text(_listed(value))
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(key)} = {value_text(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(value_text(item) for item in value) + "]"
    raise TypeError(f"a scene holds numbers, texts, lists and dictionaries, not {type(value).__name__}")


def _listed(array: Any) -> Any:
    """The entries of an array as lists: numbers with exactly their values, or texts."""
    if not isinstance(array, np.ndarray):
        array = array.toarray() if is_sparse(array) else np.asarray(array)
    if array.dtype.kind not in "USO":
        doubles = exact("array", array)
        array = array if array.dtype.kind in "biu" else doubles
    return array.tolist()


def _table(header: str, table: Mapping[str, Any]) -> str:
    return "\n".join([header] + [f"{_key(key)} = {value_text(value)}" for key, value in table.items()])


def _is_table(value: Any) -> bool:
    if isinstance(value, Mapping):
        return True
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(item, Mapping) for item in value)


def _key(key: Any) -> str:
    text = str(key)
    return text if _BARE.fullmatch(text) else json.dumps(text, ensure_ascii=False)
