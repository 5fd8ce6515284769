"""Running scenes and studies through the program."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import seawall
from conftest import ROOT, SCENE, TINY
from seawall._program import _message
from seawall._running import _settings, _text


def test_a_scene_gives_its_record_and_history(program: Path) -> None:
    result = seawall.run(SCENE, program=program)
    assert result.directory is None
    assert result.case_id == result.summary["case_id"] == result.record["id"]
    assert repr(result) == f"<seawall run: case {result.case_id}, {len(result.history)} rows of history>"
    outcome = result.record["outcome"]
    assert outcome["force_max"]["value"] == result.summary["force_max"]
    assert result.units["force"] == "½ρgh²"
    assert result.energy["paddle_work"] > 0
    assert list(result.history.columns[:4]) == ["time_s", "force", "runup", "displacement"]
    assert result.history["force"].iloc[0] == pytest.approx(1, abs=0.01)


def test_settings_change_the_case_and_files_stay_where_they_are_wanted(program: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    stiff = {"scene.spring_stiffness_n_per_m": np.float64(1e6), "numerics.kernel": "gaussian"}
    result = seawall.run(SCENE, set=stiff, out=out, threads=1, program=program)
    assert result.directory == out and repr(result).endswith(f", in {out}>")
    assert result.summary["spring_stiffness_n_per_m"] == 1e6
    assert result.summary["kernel"] == "gaussian"
    pd.testing.assert_frame_equal(seawall.load(out).history(result.case_id), result.history)
    with pytest.raises(seawall.SeawallError, match="holds another sweep") as refused:
        seawall.run(SCENE, out=out, program=program)
    assert refused.value.exit_code == 2
    seawall.run(SCENE, out=out, fresh=True, program=program)


def test_the_programs_message_is_the_exception(program: Path, tmp_path: Path) -> None:
    with pytest.raises(seawall.SeawallError, match="did you mean wave_height_ratio") as bad:
        seawall.run(SCENE, set={"scene.wave_hight_ratio": 0.3}, program=program)
    assert bad.value.exit_code == 2 and not str(bad.value).startswith("error")
    with pytest.raises(seawall.SeawallError, match="nowhere.toml") as missing:
        seawall.sweep(tmp_path / "nowhere.toml", program=program)
    assert missing.value.exit_code == 2
    with pytest.raises(seawall.SeawallError, match="give out"):
        seawall.run(SCENE, film=True, program=program)


def test_a_case_that_fails_is_an_exception_with_its_record(program: Path) -> None:
    unstable = {"numerics.kernel": "gaussian", "numerics.support_radius_ratio": 2}
    unstable |= {"numerics.courant_number": 2.5, "numerics.bulk_damping": 1}
    with pytest.raises(seawall.CaseFailed, match="failed: ") as failed:
        seawall.run(SCENE, set=unstable, program=program)
    assert failed.value.record["failure"] and failed.value.exit_code == 1


def test_a_sweep_goes_on_where_it_was(program: Path, swept: Path) -> None:
    before = (swept / "journal.jsonl").read_bytes()
    study = seawall.sweep(TINY, out=swept, program=program)
    assert study.directory == swept and len(study.summary) == 4
    assert (swept / "journal.jsonl").read_bytes() == before


def test_a_shipped_file_is_run_from_its_path(
    program: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    file = ROOT / "sweeps" / "scenes" / "hydrostatic.toml"
    short = {"scene.end_time_s": 0.1, "numerics.particle_spacing_m": 0.05}
    result = seawall.run(file, set=short, program=program, progress=True)
    assert result.history["time_s"].iloc[-1] == pytest.approx(0.1, abs=0.01)
    assert "1 case on" in capfd.readouterr().err


def test_files_are_written_as_a_hand_would() -> None:
    grid = {"spring_stiffness_n_per_m": {"from": 10, "to": 1e6, "points": 3, "spacing": "log"}}
    probe = [{"name": "p", "kind": "pressure", "wall": "right", "y_m": np.float64(0.1)}]
    tables = {"name": 'a "b" ü', "scene": {"wall": "fixed", "flag": True}, "grid": grid, "probe": probe}
    text = _text(tables)
    tomllib = pytest.importorskip("tomllib", reason="Python 3.10 has no tomllib")
    assert tomllib.loads(text) == tables
    assert "\n[scene]\nwall = " in text
    words = _settings({"grid.wave_height_ratio": np.array([0.1, 0.2]), "name": "x y"})
    assert words == ["--set", "grid.wave_height_ratio=[0.1, 0.2]", "--set", 'name="x y"']
    with pytest.raises(TypeError, match="must be a number"):
        _settings({"a": object()})


def test_an_error_is_found_in_lines_and_in_json() -> None:
    assert _message(None, "resuming x\nerror: no such key\n") == "no such key"
    assert _message({"error": "told"}, "a note\n") == "told"
    assert _message(None, 'a note\n{\n"error": {"message": "told", "code": 2}\n}\n') == "told"
    assert _message(None, "") == "the program said nothing"


def test_the_program_is_found_in_its_places(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def put(folder: Path) -> Path:
        folder.mkdir(parents=True)
        path = folder / "seawall"
        path.write_text("#!/bin/sh\necho 'error: made up' >&2\nexit 2\n")
        path.chmod(0o755)
        return path

    named, on_path = put(tmp_path / "named"), put(tmp_path / "path")
    built = put(tmp_path / "work" / "target" / "release")
    (tmp_path / "work" / "deep").mkdir()
    monkeypatch.chdir(tmp_path / "work" / "deep")
    monkeypatch.setenv("PATH", str(tmp_path / "path"))
    monkeypatch.setenv("SEAWALL_BIN", str(named))
    assert seawall.find_program() == named
    with pytest.raises(seawall.SeawallError, match="^made up$"):
        seawall.run(SCENE)
    monkeypatch.delenv("SEAWALL_BIN")
    assert seawall.find_program() == on_path
    monkeypatch.setenv("PATH", str(tmp_path))
    assert seawall.find_program() == built
    monkeypatch.setenv("SEAWALL_BIN", str(tmp_path / "nothing"))
    with pytest.raises(seawall.SeawallError, match="SEAWALL_BIN = .*: must be the program"):
        seawall.find_program()
