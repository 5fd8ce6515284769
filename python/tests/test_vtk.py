"""The files of ``seawall run --vtk``, opened with the libraries that people have."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import seawall
from conftest import SCENE

PARTS = ["water", "bed", "paddle", "wall"]
#: Still water presses with half its weight times its depth squared, N per metre of width.
STILL_FORCE = 0.5 * 1000 * 9.81 * 0.2**2


@pytest.fixture(scope="module")
def filmed(program: Path, tmp_path_factory: pytest.TempPathFactory) -> seawall.Run:
    out = tmp_path_factory.mktemp("vtk") / "out"
    return seawall.run(SCENE, out=out, vtk=0.1, program=program)


def test_pyvista_reads_every_time_and_part(filmed: seawall.Run) -> None:
    pyvista = pytest.importorskip("pyvista", reason="pyvista is not here", exc_type=ImportError)
    assert filmed.directory is not None
    reader = pyvista.PVDReader(filmed.directory / "vtk" / f"{filmed.case_id}.pvd")
    end = filmed.history["time_s"].iloc[-1]
    assert reader.time_values[0] == 0 and reader.time_values[-1] == pytest.approx(end)
    assert np.all(np.diff(reader.time_values) > 0)
    assert len(reader.time_values) == pytest.approx(end / 0.1, abs=2)
    for time in reader.time_values[:: len(reader.time_values) // 3]:
        reader.set_active_time_value(time)
        blocks = reader.read()
        assert len(blocks) == len(PARTS)
        particles = int(filmed.summary["particles"])
        water, bed, paddle, wall = (blocks[k] for k in range(len(PARTS)))
        assert water.n_points == water.n_cells == particles
        assert list(water["id"]) == list(range(particles))
        assert water["density_kg_per_m3"].min() > 900
        assert water["velocity_m_per_s"].shape == (particles, 3)
        assert bed.n_cells == bed.n_points - 1
        nearest = filmed.history.iloc[(filmed.history["time_s"] - time).abs().argmin()]
        assert wall.bounds[0] == pytest.approx(1 + 0.2 * nearest["displacement"], abs=0.01)
        assert paddle.bounds[1] < water.bounds[0] < water.bounds[1] < wall.bounds[1]
        assert water.field_data["TimeValue"][0] == pytest.approx(time)


def test_meshio_reads_a_pressure_that_adds_up_to_the_force(filmed: seawall.Run) -> None:
    meshio = pytest.importorskip("meshio", reason="meshio is not here", exc_type=ImportError)
    assert filmed.directory is not None
    folder = filmed.directory / "vtk" / filmed.case_id
    largest = 0.0
    for path in sorted(folder.glob("wall_*.vtu")):
        wall = meshio.read(path)
        lines = wall.cells_dict["line"]
        pressure, height = wall.point_data["pressure_pa"], wall.points[:, 1]
        pieces = pressure[lines].mean(axis=1) * np.diff(height[lines], axis=1)[:, 0]
        time = wall.field_data["TimeValue"][0]
        near = (filmed.history["time_s"] - time).abs() < 0.02
        force = filmed.history.loc[near, "force"].mean()
        assert pieces.sum() / STILL_FORCE == pytest.approx(force, abs=0.15), f"at {time} s"
        largest = max(largest, pieces.sum() / STILL_FORCE)
    assert largest > 1.3


def test_files_are_small(filmed: seawall.Run) -> None:
    assert filmed.directory is not None
    files = list((filmed.directory / "vtk").rglob("water_*.vtu"))
    bytes_each = sum(path.stat().st_size for path in files) / len(files)
    # Eight numbers of four bytes; as text they took 110 bytes and more.
    assert bytes_each / filmed.summary["particles"] < 45
