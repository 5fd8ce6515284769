"""CSV files as pandas tables with the right types."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pandas as pd

from seawall._errors import SeawallError
from seawall._units import Units, columns

#: What says which case a row is of: sixteen digits that must not be taken for a number.
CASE_ID = "case_id"

_TYPES = {"text": "string", "count": "Int64", "flag": "boolean", "number": "float64"}


def read_table(path: Path, declared: str | None = None) -> pd.DataFrame:
    """Reads a table, typed as it is declared; its units are in ``attrs["units"]``."""
    kinds = columns(declared) if declared else {}
    types: dict[str, Any] = {name: _TYPES[column.kind] for name, column in kinds.items()}
    types[CASE_ID] = "string"
    try:
        header = pd.read_csv(path, nrows=0).columns
        present = {name: kind for name, kind in types.items() if name in header}
        table = pd.read_csv(path, dtype=present, true_values=["true"], false_values=["false"])
    except FileNotFoundError as error:
        raise SeawallError(f"{path}: is not there") from error
    except (OSError, ValueError) as error:
        raise SeawallError(f"{path}: cannot be read: {error}") from error
    table.attrs["units"] = dict(Units(list(table.columns)))
    return table
