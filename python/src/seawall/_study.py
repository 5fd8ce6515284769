"""A finished study: what a directory of results holds."""

from __future__ import annotations

import json
import os
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from seawall._errors import SeawallError
from seawall._tables import CASE_ID, read_table
from seawall._units import Column, Units, columns


def load(directory: str | os.PathLike[str]) -> Study:
    """Reads the output directory of ``seawall sweep`` or ``seawall run``.

    Raises:
        SeawallError: the directory holds no ``summary.csv``, or one that cannot be read.
    """
    return Study(directory)


class Study:
    """The tables of a directory of results. Each is read when it is first asked for, and kept."""

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        self.directory = Path(directory)
        if not (self.directory / "summary.csv").is_file():
            reason = "holds no summary.csv: not the output directory of a sweep"
            raise SeawallError(f"{self.directory}: {reason}")

    def __repr__(self) -> str:
        cases, failed = len(self.summary), int((self.summary["status"] != "ok").sum())
        told = f", {failed} failed" if failed else ""
        noun = "case" if cases == 1 else "cases"
        return f"<seawall study {self.name!r}: {cases} {noun}{told}, in {self.directory}>"

    @cached_property
    def manifest(self) -> dict[str, Any]:
        """Where the results come from: version, sweep file as written, hosts, times."""
        path = self.directory / "manifest.json"
        if not path.is_file():
            return {}
        try:
            found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        except ValueError as error:
            raise SeawallError(f"{path}: cannot be read: {error}") from error
        return found

    @property
    def name(self) -> str:
        """The study's name; the directory's, where there is no manifest."""
        return str(self.manifest.get("name", self.directory.name))

    @property
    def keys(self) -> list[str]:
        """The swept keys, in the order of the sweep file."""
        return [str(key) for key in self.manifest.get("keys", [])]

    @cached_property
    def summary(self) -> pd.DataFrame:
        """A row per case, in the order of the grid: ``summary.csv``."""
        return read_table(self.directory / "summary.csv", "summary")

    @property
    def ok(self) -> pd.DataFrame:
        """The rows of the cases that ended well."""
        return self.summary[self.summary["status"] == "ok"]

    @cached_property
    def energy(self) -> pd.DataFrame:
        """Where the paddle's work went, J per metre of width: ``energy.csv``."""
        return read_table(self.directory / "energy.csv", "energy")

    @cached_property
    def tables(self) -> dict[str, pd.DataFrame]:
        """What the report shows, by name: ``tables/*.csv``."""
        paths = sorted((self.directory / "tables").glob("*.csv"))
        return {path.stem: read_table(path) for path in paths}

    @cached_property
    def histories(self) -> pd.DataFrame:
        """The histories of all cases in one table, with the column ``case_id``."""
        all_in_one = self.directory / "histories.csv.gz"
        if all_in_one.is_file():
            table = read_table(all_in_one, "histories")
            if set(table[CASE_ID]) >= set(self._with_history()):
                return table
        single = [self.history(case).assign(case_id=case) for case in self._with_history()]
        if not single:
            raise SeawallError(f"{self.directory}: holds no histories")
        table = pd.concat(single, ignore_index=True)
        table[CASE_ID] = table[CASE_ID].astype("string")
        table = table[[CASE_ID, *table.columns.drop(CASE_ID)]]
        table.attrs["units"] = dict(Units(list(table.columns)))
        return table

    def history(self, case: str | pd.Series | None = None, **keys: Any) -> pd.DataFrame:
        """Force, runup and displacement of a case over time.

        The case is given by its id or the start of it, by a row of :attr:`summary`, or by values of columns,
        as for :meth:`case`.
        """
        return read_table(self._of_case("histories", case, keys), "histories")

    def probes(self, case: str | pd.Series | None = None, **keys: Any) -> pd.DataFrame:
        """What the gauges of a case recorded; ``attrs["units"]`` has their units."""
        table = read_table(self._of_case("probes", case, keys))
        about = self.directory / "probes" / "columns.csv"
        known = {row["name"]: row["unit"] for _, row in read_table(about).iterrows()}
        table.attrs["units"] = dict(Units(list(table.columns), known))
        return table

    def readings(self, case: str | pd.Series | None = None, **keys: Any) -> pd.DataFrame:
        """What else the scene told of a case: name, value, unit."""
        return read_table(self._of_case("readings", case, keys))

    def envelope(self, case: str | pd.Series | None = None, **keys: Any) -> pd.DataFrame:
        """The largest pressures up the wall of a case, by height."""
        return read_table(self._of_case("envelopes", case, keys), "envelopes")

    def case(self, case_id: str | None = None, /, **keys: Any) -> pd.Series:
        """The only row of the summary with this id, or the start of it, and these values, numbers to four digits.

        Raises:
            SeawallError: no case, or more than one, fits.
        """
        rows = self.summary
        if case_id is not None:
            rows = rows[rows[CASE_ID].str.startswith(str(case_id)).astype(bool)]
            if rows.empty:
                raise SeawallError(f"{case_id}: no case of this study has an id that starts so")
        for key, wanted in keys.items():
            if key not in rows:
                raise SeawallError(f"{key}: no such column in {self.directory}/summary.csv")
            fits = _equal(rows[key], wanted)
            if not fits.any():
                there = ", ".join(str(value) for value in rows[key].drop_duplicates())
                raise SeawallError(f"{key} = {wanted}: no such case; there is {there}")
            rows = rows[fits]
        if len(rows) != 1:
            open_keys = [key for key in self.keys if key in rows and rows[key].nunique() > 1]
            which = f"; say which one by {', '.join(open_keys)}" if open_keys else ""
            raise SeawallError(f"{len(rows)} cases fit{which}")
        return rows.iloc[0]

    @cached_property
    def units(self) -> Units:
        """What the columns of summary, histories and energy count."""
        names = [*self.summary.columns, *columns("histories"), *columns("energy")]
        return Units(list(dict.fromkeys(names)))

    @property
    def columns(self) -> dict[str, Column]:
        """The declared columns of the summary: unit, symbol, meaning, error bar, bound."""
        return {name: column for name, column in columns("summary").items() if name in self.summary}

    def _with_history(self) -> list[str]:
        folder = self.directory / "histories"
        return [case for case in self.ok[CASE_ID] if (folder / f"{case}.csv").is_file()]

    def _of_case(self, folder: str, case: str | pd.Series | None, keys: dict[str, Any]) -> Path:
        if case is None:
            case = self.case(**keys)
        elif keys:
            raise SeawallError("give the case's id or values of columns, not both")
        name = case if isinstance(case, str) else str(case[CASE_ID])
        path = self.directory / folder / f"{name}.csv"
        if not path.is_file() and isinstance(case, str):
            name = str(self.case(case)[CASE_ID])  # the start of an id
            path = self.directory / folder / f"{name}.csv"
        if not path.is_file():
            raise SeawallError(f"{path}: is not there: case {name} has left no {folder}")
        return path


def _equal(column: pd.Series, wanted: Any) -> pd.Series:
    """Equal as settings: nobody writes more than four digits by hand."""
    is_number = isinstance(wanted, (int, float)) and not isinstance(wanted, bool)
    if is_number and pd.api.types.is_numeric_dtype(column):
        near: pd.Series = (column - wanted).abs() <= 5e-4 * column.abs()
        return near.fillna(False).astype(bool)
    return (column.astype("string") == str(wanted)).fillna(False).astype(bool)
