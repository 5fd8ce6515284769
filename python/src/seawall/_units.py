"""What the columns count: as the program declares them, or as their names end."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources


@dataclass(frozen=True)
class Column:
    """A column as the program declares it."""

    name: str
    #: ``text``, ``count``, ``flag`` or ``number``.
    kind: str
    #: What stands above it in tables and beside axes, such as ``F* max`` or ``onset, s``.
    heading: str
    #: What its numbers count; empty for words and pure numbers.
    unit: str
    #: What it is.
    what: str
    #: The column of its error bar.
    bar: str | None
    #: The column of the flag which says that the value is a lower bound.
    bound: str | None


@cache
def _declared() -> dict[str, list[dict[str, str]]]:
    # Written by a test of the program from its own declarations, and held to them by it.
    text = resources.files("seawall").joinpath("quantities.json").read_text(encoding="utf-8")
    found: dict[str, list[dict[str, str]]] = json.loads(text)
    return found


@cache
def columns(table: str) -> dict[str, Column]:
    """The declared columns of ``summary``, ``histories``, ``energy`` or ``envelopes``."""
    return {entry["name"]: Column(**entry) for entry in _declared()[table]}


@cache
def _endings() -> list[tuple[str, str]]:
    return [(ending, unit) for ending, unit in _declared()["endings"]]


def unit_of(name: str) -> str:
    """The unit of a column or key; empty for a pure number or words."""
    for table in ("summary", "histories", "energy", "envelopes"):
        if name in columns(table):
            return columns(table)[name].unit
    return next((unit for ending, unit in _endings() if name.endswith(ending)), "")


class Units(Mapping[str, str]):
    """The units of some columns: ``units["force_max"]`` is ``½ρgh²``."""

    def __init__(self, names: list[str], known: Mapping[str, str] | None = None) -> None:
        known = known or {}
        self._units = {name: known.get(name, unit_of(name)) for name in names}

    def __getitem__(self, name: str) -> str:
        return self._units[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._units)

    def __len__(self) -> int:
        return len(self._units)

    def __repr__(self) -> str:
        return f"Units({self._units!r})"

    def label(self, name: str) -> str:
        """The title of an axis: symbol or name, and the unit where the symbol does not say it."""
        for table in ("summary", "histories", "energy", "envelopes"):
            if name in columns(table):
                return columns(table)[name].heading
        ending, unit = next(((e, u) for e, u in _endings() if name.endswith(e)), ("", ""))
        words = name.removesuffix(ending).replace("_", " ")
        return f"{words}, {unit}" if unit else words
