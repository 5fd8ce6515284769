"""What the tests share: the program, a tiny study of its own, and a stored one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import seawall

ROOT = Path(__file__).resolve().parents[2]

#: Two waves on movable walls in a short, coarse tank: seconds of work.
TINY: dict[str, Any] = {
    "name": "tiny",
    "scene": {
        "wall": "movable",
        "tank_length_m": 1.0,
        "wave_gauge_m": 0.5,
        "end_after_stroke_centre_s": 0.8,
        "seawall_mass_kg_per_m": 50,
    },
    "numerics": {"particle_spacing_m": 0.025, "error_bars": "pair"},
    "grid": {"wave_height_ratio": [0.4, 0.5], "spring_stiffness_n_per_m": [10, 1e4]},
}

#: One of its cases, as a scene.
SCENE: dict[str, Any] = {
    "scene": {**TINY["scene"], "wave_height_ratio": 0.5, "spring_stiffness_n_per_m": 10},
    "numerics": {"particle_spacing_m": 0.025},
}


@pytest.fixture(scope="session")
def program() -> Path:
    """The program under test; without one there is nothing to run."""
    try:
        return seawall.find_program()
    except seawall.SeawallError as error:
        pytest.skip(str(error))


@pytest.fixture(scope="session")
def swept(program: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The directory of a finished tiny study."""
    out = tmp_path_factory.mktemp("swept") / "out"
    seawall.sweep(TINY, out=out, program=program)
    return out


@pytest.fixture(scope="session")
def stored() -> seawall.Study:
    """The 300 cases that are stored beside the code."""
    return seawall.load(ROOT / "results" / "liang2017_study")
