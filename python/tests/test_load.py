"""Loading directories of results."""

from __future__ import annotations

import shutil
from pathlib import Path

import pandas as pd
import pytest

import seawall


def test_a_stored_study_has_typed_tables_with_units(stored: seawall.Study) -> None:
    assert stored.name == "liang2017"
    assert len(stored.summary) == 300 and len(stored.ok) == 300
    assert stored.summary["case_id"].str.len().eq(16).all()
    assert stored.summary["displacement_truncated"].dtype == "boolean"
    assert stored.summary["steps"].dtype == "Int64"
    assert stored.units["first_force_max"] == "½ρgh²"
    assert stored.units["force"] == "½ρgh²"
    assert stored.summary.attrs["units"]["seawall_mass_kg_per_m"] == "kg/m"
    assert stored.columns["first_force_max"].bar == "force_error"
    assert "300 cases" in repr(stored)


def test_a_case_is_found_by_its_values(stored: seawall.Study) -> None:
    keys = {"wave_height_ratio": 0.5, "spring_stiffness_n_per_m": 500}
    case = stored.case(**keys, seawall_mass_kg_per_m=250)
    assert case["m_star"] == pytest.approx(6.25)
    for start in (case["case_id"], case["case_id"][:10]):
        pd.testing.assert_series_equal(stored.case(start), case)
        assert stored.case(start, seawall_mass_kg_per_m=250)["case_id"] == case["case_id"]
    with pytest.raises(seawall.SeawallError, match="force_max: no case of this study has an id"):
        stored.case("force_max")
    with pytest.raises(seawall.SeawallError, match="6 cases fit; .* by seawall_mass_kg_per_m$"):
        stored.case(**keys)
    with pytest.raises(seawall.SeawallError, match="no such case; there is 0.2, 0.3"):
        stored.case(wave_height_ratio=0.35)
    with pytest.raises(seawall.SeawallError, match="stiffness: no such column"):
        stored.case(stiffness=500)


def test_what_is_not_there_is_named(stored: seawall.Study, tmp_path: Path) -> None:
    with pytest.raises(seawall.SeawallError, match="holds no summary.csv"):
        seawall.load(tmp_path)
    with pytest.raises(seawall.SeawallError, match="has left no histories"):
        stored.history(stored.summary.iloc[0])
    with pytest.raises(seawall.SeawallError, match="energy.csv: is not there"):
        _ = stored.energy
    with pytest.raises(seawall.SeawallError, match="holds no histories"):
        _ = stored.histories


def test_an_id_of_digits_alone_stays_text(tmp_path: Path) -> None:
    ids = ["0123456789012345", "12345e6789012345"]
    rows = "".join(f"{case},ok,0.5\n" for case in ids)
    (tmp_path / "summary.csv").write_text("case_id,status,wave_height_ratio\n" + rows)
    assert list(seawall.load(tmp_path).summary["case_id"]) == ids


def test_a_finished_study_is_read_whole(swept: Path) -> None:
    study = seawall.load(swept)
    assert study.keys == ["wave_height_ratio", "spring_stiffness_n_per_m"]
    assert study.manifest["name"] == "tiny" and len(study.summary) == 4
    assert (study.summary["force_error"] > 0).all()
    assert set(study.tables) >= {"summary", "health", "energy"}
    work = study.energy.set_index("case_id")
    spent = work.drop(columns=["paddle_work_j_per_m", "energy_gap_percent"]).sum(axis=1)
    gap = 100 * (1 - spent / work["paddle_work_j_per_m"])
    assert (gap - work["energy_gap_percent"]).abs().max() < 1e-6
    assert study.energy.attrs["units"]["spring_j_per_m"] == "J/m"


def test_all_histories_are_the_single_ones_text_for_text(swept: Path) -> None:
    study = seawall.load(swept)
    told = pd.read_csv(swept / "histories.csv.gz", dtype=str)
    for case, rows in told.groupby("case_id", sort=False):
        single = pd.read_csv(swept / "histories" / f"{case}.csv", dtype=str)
        assert rows.drop(columns="case_id").reset_index(drop=True).equals(single)
    assert list(told["case_id"].unique()) == list(study.summary["case_id"])
    assert len(study.histories) == len(told)


def test_histories_are_joined_where_the_table_is_missing_or_old(swept: Path, tmp_path: Path) -> None:
    whole = seawall.load(swept).histories
    copy = tmp_path / "copy"
    shutil.copytree(swept, copy)
    (copy / "histories.csv.gz").unlink()
    pd.testing.assert_frame_equal(seawall.load(copy).histories, whole)
    whole[whole["case_id"] == whole["case_id"][0]].to_csv(copy / "histories.csv.gz", index=False)
    pd.testing.assert_frame_equal(seawall.load(copy).histories, whole)


def test_a_history_holds_the_maxima_of_the_summary(swept: Path) -> None:
    study = seawall.load(swept)
    case = study.case(wave_height_ratio=0.5, spring_stiffness_n_per_m=10)
    history = study.history(wave_height_ratio=0.5, spring_stiffness_n_per_m=10)
    assert history["displacement"].max() == pytest.approx(case["displacement_max"], rel=1e-2)
    assert history.attrs["units"]["force"] == "½ρgh²"
    with pytest.raises(seawall.SeawallError, match="not both"):
        study.history(case, wave_height_ratio=0.5)


def test_a_history_is_found_by_the_start_of_its_id(tmp_path: Path) -> None:
    ids = ["0123456789012345", "0199996789012345"]
    rows = "".join(f"{case},ok,0.5\n" for case in ids)
    (tmp_path / "summary.csv").write_text("case_id,status,wave_height_ratio\n" + rows)
    (tmp_path / "histories").mkdir()
    (tmp_path / "histories" / f"{ids[0]}.csv").write_text("time_s,force\n0,1\n")
    study = seawall.load(tmp_path)
    assert len(study.history("012")) == 1
    with pytest.raises(seawall.SeawallError, match="2 cases fit"):
        study.history("01")
    with pytest.raises(seawall.SeawallError, match="case 0199996789012345 has left no histories"):
        study.history("0199")
    with pytest.raises(seawall.SeawallError, match="no case of this study has an id"):
        study.history("77")
