"""Units come from the program's own declarations, or from the ends of names."""

import re

import pytest
from conftest import ROOT

import seawall
from seawall import Units
from seawall._units import columns, unit_of


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("first_force_max", "½ρgh²"),
        ("runup_max", "h"),
        ("stop_impulse", "½ρgh² √(h/g)"),
        ("spring_stiffness_n_per_m", "N/m"),
        ("force_max_time_s", "s"),
        ("paddle_work_j_per_m", "J/m"),
        ("still_water_depth_m", "m"),
        ("kinematic_viscosity_m2_per_s", "m²/s"),
        ("wall_angle_deg", "°"),
        ("force_gap_percent", "%"),
        ("status", ""),
        ("steps", ""),
    ],
)
def test_a_column_has_its_unit(name: str, unit: str) -> None:
    assert unit_of(name) == unit


def test_a_declaration_says_bar_and_bound() -> None:
    declared = columns("summary")["displacement_max"]
    assert (declared.bar, declared.bound) == ("displacement_error", "displacement_truncated")
    assert columns("summary")[declared.bar].unit == declared.unit


def test_labels_say_a_unit_once() -> None:
    units = Units(["first_force_max", "spring_stiffness_n_per_m", "column_height_m"])
    labels = [units.label(name) for name in units]
    assert labels == ["first F*", "k, N/m", "column height, m"]
    assert units.label("log10_k_star") == "log₁₀ k*"


def test_an_unknown_name_is_no_column() -> None:
    with pytest.raises(KeyError):
        Units(["steps"])["force_max"]


def test_package_and_program_have_one_version() -> None:
    told = re.search(r'^version = "(.*)"', (ROOT / "Cargo.toml").read_text(), re.MULTILINE)
    assert told and seawall.__version__ == told[1]
