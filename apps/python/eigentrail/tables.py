"""Events and stable ranges of a loci file as pandas tables."""

from __future__ import annotations

from typing import Any

from .later import pandas
from .selection import mode_names



def events(loci: Any) -> pandas.DataFrame:
    """One row per special point, in the order of the trace.

    For a sampled family, `interval_from` and `interval_to` are the parameter values between which it lies as far as the
    errors of the data tell; NaN for kinds that have no interval."""
    names = ["kind", "parameter", "eigenvalue", "modes", "direction", "value", "half_width", "node"]
    table = pandas.DataFrame({name: loci[f"event_{name}"].values for name in names}, pandas.Index(loci.event.values, name="event"))
    table["modes"] = [_mode_names(loci, text) for text in table["modes"]]
    table = table.rename(columns={"parameter": loci.attrs["parameter"]})
    if "event_interval" in loci:  # of a sampled family
        table["interval_from"], table["interval_to"] = loci.event_interval.values.reshape(-1, 2).T
    return table


def stable_ranges(loci: Any) -> pandas.DataFrame:
    """One row per range without growing modes, in the order of the trace. Where `whole_model` is False it holds for the
    followed modes only."""
    table = {"kind": loci.stable_kind.values, "from": loci.stable_from.values, "to": loci.stable_to.values}
    for end, name in (("left", "from"), ("right", "to")):
        for what in ("cause", "margin", "mode"):
            table[f"{what}_{name}"] = loci[f"stable_{what}"].sel(end=end).values
    for name in ("least_margin", "largest_margin", "largest_at"):
        table[name] = loci[f"stable_{name}"].values
    table["whole_model"] = loci.stable_whole.values == 1 if "stable_whole" in loci else False
    return pandas.DataFrame(table, index=pandas.Index(loci.range.values, name="range"))


def _mode_names(loci: Any, text: str) -> str:
    """Names of modes from their numbers: 'flap; lag' from '1;3'. Modes without a name have their label, 'mode 1'."""
    names = mode_names(loci)[1]
    return "; ".join(names[int(number) - 1] for number in text.split(";") if number)
