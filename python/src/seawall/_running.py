"""Running scenes and studies through the program."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd

from seawall._errors import CaseFailed, SeawallError
from seawall._program import call
from seawall._study import Study, load
from seawall._units import Units


@dataclass(frozen=True)
class Run:
    """What came out of one scene."""

    #: What the program says of the case: ``seawall run --format json``.
    record: dict[str, Any]
    #: Its row of the summary.
    summary: pd.Series
    #: Force, runup and displacement over time.
    history: pd.DataFrame
    #: Where the files are; ``None`` where nobody asked for them.
    directory: Path | None

    def __repr__(self) -> str:
        place = f", in {self.directory}" if self.directory else ""
        return f"<seawall run: case {self.case_id}, {len(self.history)} rows of history{place}>"

    @property
    def case_id(self) -> str:
        """Hash of everything that decides the answer."""
        return str(self.record["id"])

    @property
    def energy(self) -> dict[str, float]:
        """Where the paddle's work went, J per metre of width."""
        return dict(self.record["energy"])

    @property
    def units(self) -> Units:
        """What the columns of summary and history count."""
        return Units([*self.summary.index, *self.history.columns])


def run(
    scene: str | os.PathLike[str] | Mapping[str, Any],
    set: Mapping[str, Any] | None = None,  # noqa: A002 - as the program calls it
    out: str | os.PathLike[str] | None = None,
    *,
    fresh: bool = False,
    film: bool = False,
    vtk: float | None = None,
    threads: int | None = None,
    program: str | os.PathLike[str] | None = None,
    progress: bool = False,
) -> Run:
    """Runs one scene.

    Args:
        scene: the path of a scene file, or its tables: ``{"scene": {...}, "numerics": {...}}``.
        set: values by their paths, such as ``{"numerics.particle_spacing_m": 0.02}``.
        out: where the files stay. Without it they are removed once they are read.
        fresh: move an earlier run in ``out`` aside.
        film: leave a film in ``out``.
        vtk: leave files for ParaView in ``out``, so many seconds apart.
        threads: that share the work; the results are the same for any number.
        program: the program, where it is not the one that :func:`find_program` finds.
        progress: show what the program tells on its way.

    Raises:
        CaseFailed: the run came to no result.
        SeawallError: anything else that the program refuses, with its message.
    """
    if out is None and (film or vtk is not None):
        raise SeawallError("a film or files for ParaView need a place: give out")
    extra = [*(["--fresh"] if fresh else []), *(["--film"] if film else [])]
    extra += [] if vtk is None else ["--vtk", str(vtk)]
    extra += [] if threads is None else ["--threads", str(threads)]
    with _file(scene) as path, _directory(out) as directory:
        where = ["--out", os.fspath(directory)]
        answer = call(["run", path, *where, *_settings(set), *extra], program, progress)
        record: dict[str, Any] = answer.value
        if record.get("failure"):
            raise CaseFailed(f"case {record['id']} failed: {record['reason']}", record)
        study = load(directory)
        history = study.history(str(record["id"]))
        kept = None if out is None else Path(out)
        return Run(record, study.summary.iloc[0], history, kept)


def sweep(
    file: str | os.PathLike[str] | Mapping[str, Any],
    set: Mapping[str, Any] | None = None,  # noqa: A002 - as the program calls it
    out: str | os.PathLike[str] | None = None,
    *,
    fresh: bool = False,
    max_error: float | None = None,
    threads: int | None = None,
    program: str | os.PathLike[str] | None = None,
    progress: bool = False,
) -> Study:
    """Runs all cases of a study, or what is left of it, and loads it. A failed case is a row of its
    summary, and no exception.

    Args:
        file: the path of a sweep file, or its tables: ``{"name": ..., "scene": {...}, "grid": {...}}``.
        set: values by their paths, such as ``{"numerics.particle_spacing_m": 0.02}``.
        out: where results go; by default ``results/runs/<name>``.
        fresh: move an earlier study in ``out`` aside.
        max_error: choose the numerics so that force and displacement are this accurate, percent.
        threads: cases at once.
        program: the program, where it is not the one that :func:`find_program` finds.
        progress: show what the program tells on its way.

    Raises:
        SeawallError: what the program refuses, with its message.
    """
    extra = ["--fresh"] if fresh else []
    extra += [] if out is None else ["--out", os.fspath(out)]
    extra += [] if max_error is None else ["--max-error", str(max_error)]
    extra += [] if threads is None else ["--threads", str(threads)]
    with _file(file) as path:
        answer = call(["sweep", path, *_settings(set), *extra], program, progress)
    return load(answer.value["out"])


@contextmanager
def _file(scene: str | os.PathLike[str] | Mapping[str, Any]) -> Iterator[Path]:
    """The file of a scene; of tables, a passing one."""
    if not isinstance(scene, Mapping):
        yield Path(scene)
        return
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "from_python.toml"
        path.write_text(_text({"name": "from_python", **scene}), encoding="utf-8")
        yield path


@contextmanager
def _directory(out: str | os.PathLike[str] | None) -> Iterator[Path]:
    if out is not None:
        yield Path(out)
        return
    with tempfile.TemporaryDirectory() as folder:
        yield Path(folder) / "run"


def _settings(values: Mapping[str, Any] | None) -> list[str]:
    pairs = (values or {}).items()
    return [word for key, value in pairs for word in ("--set", f"{key}={_toml(value)}")]


def _text(tables: Mapping[str, Any]) -> str:
    """A file as a hand would write it: what stands in no section, then the sections."""
    sections = {key: value for key, value in tables.items() if isinstance(value, Mapping)}
    lines = [f"{key} = {_toml(value)}" for key, value in tables.items() if key not in sections]
    for name, section in sections.items():
        lines += ["", f"[{name}]", *(f"{key} = {_toml(value)}" for key, value in section.items())]
    return "\n".join(lines) + "\n"


def _toml(value: Any) -> str:
    """A value as TOML writes it, in one line."""
    if isinstance(value, Mapping):
        pairs = ", ".join(f"{key} = {_toml(held)}" for key, held in value.items())
        return f"{{ {pairs} }}"
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if hasattr(value, "tolist"):  # numpy and pandas
        return _toml(value.tolist())
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(_toml, value))}]"
    if isinstance(value, (bool, int, float)):
        return repr(value).lower()
    raise TypeError(f"{value!r}: must be a number, a string, a flag, a list or a dictionary")
