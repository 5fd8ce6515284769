"""Finding and calling the program."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from seawall._errors import SeawallError

_NAME = "seawall.exe" if os.name == "nt" else "seawall"


def find_program(program: str | os.PathLike[str] | None = None) -> Path:
    """The program: as given, or else ``$SEAWALL_BIN``, the one on the ``PATH``, or a build in
    ``target/release`` of this directory or one above it.

    Raises:
        SeawallError: none of these is there.
    """
    for named, source in ((program, "program"), (os.environ.get("SEAWALL_BIN"), "SEAWALL_BIN")):
        if named:
            path = Path(named)
            if not os.access(path, os.X_OK) or path.is_dir():
                raise SeawallError(f"{source} = {path}: must be the program seawall")
            return path.resolve()
    on_path = shutil.which(_NAME)
    if on_path:
        return Path(on_path)
    here = Path.cwd()
    for folder in (here, *here.parents, *Path(__file__).resolve().parents):
        built = folder / "target" / "release" / _NAME
        if built.is_file():
            return built
    reason = "it is neither in $SEAWALL_BIN, nor on the PATH, nor in target/release"
    raise SeawallError(f"the program seawall was not found: {reason}; build it with cargo")


@dataclass(frozen=True)
class Answer:
    """What the program said."""

    exit_code: int
    value: Any
    notes: str


def call(
    arguments: Sequence[str | os.PathLike[str]],
    program: str | os.PathLike[str] | None = None,
    progress: bool = False,
) -> Answer:
    """Runs the program with ``--format json`` and reads what it prints. Its notes go to standard error
    where ``progress`` is wanted.

    Raises:
        SeawallError: with the program's message, where it neither ended well nor with a failed case.
    """
    command = [find_program(program), *arguments, "--format", "json"]
    with tempfile.TemporaryFile("w+", encoding="utf-8") as printed:
        with subprocess.Popen(
            [os.fspath(part) for part in command],
            stdin=subprocess.DEVNULL,
            stdout=printed,
            stderr=subprocess.PIPE,
            encoding="utf-8",
        ) as process:
            notes = _listen(process, progress)
        printed.seek(0)
        text = printed.read()
    value = _parsed(text)
    if process.returncode not in (0, 1) or value is None:
        raise SeawallError(_message(value, notes), process.returncode)
    return Answer(process.returncode, value, notes)


def _listen(process: subprocess.Popen[str], progress: bool) -> str:
    """All that the program writes to standard error, until its end."""
    notes: list[str] = []
    assert process.stderr is not None
    try:
        for line in process.stderr:
            notes.append(line)
            if progress:
                print(line, end="", file=sys.stderr, flush=True)
        process.wait()
    except KeyboardInterrupt:
        # It keeps what is finished, and the same call goes on.
        process.send_signal(signal.SIGINT)
        process.wait()
        raise
    return "".join(notes)


def _parsed(text: str) -> Any:
    try:
        return json.loads(text)
    except ValueError:
        return None


def _message(value: Any, notes: str) -> str:
    """The error that the program told: as JSON, printed or at the end of its notes, or as a line."""
    start = notes.find("{") if notes.startswith("{") else notes.find("\n{")
    for told in (value, _parsed(notes[start:]) if start >= 0 else None):
        if isinstance(told, dict) and "error" in told:
            error = told["error"]
            return str(error.get("message", error) if isinstance(error, dict) else error)
    lines = notes.strip().splitlines() or ["the program said nothing"]
    at = next((k for k, line in enumerate(lines) if line.startswith("error: ")), len(lines) - 1)
    return "\n".join(lines[at:]).removeprefix("error: ").strip()
