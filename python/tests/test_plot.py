# SPDX-License-Identifier: Apache-2.0
"""Pictures by PyVista, where it is installed."""

import numpy
import pytest

import riis

pyvista = pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")


def test_a_surface_goes_to_pyvista():
    valve, before = riis.Valve("mitral", opening=0.4), riis.Valve("mitral", opening=0.3)
    surface = riis.Surface(valve)
    assert "velocity" not in surface.to_pyvista().point_data
    surface.update_moving(valve, before, 0.1)
    data = surface.to_pyvista()
    assert numpy.array_equal(data.points, surface.vertices)
    assert numpy.array_equal(data.faces.reshape(-1, 4)[:, 1:], surface.triangles.vertex_id)
    assert numpy.isclose(data.area, surface.info.area)
    assert numpy.array_equal(data.cell_data["leaflet_id"], surface.triangles.leaflet_id)
    assert numpy.array_equal(data.point_data["velocity"], surface.velocities)
    surface.update(valve)  # the copy is not in the way


def test_a_picture_shows_the_leaflets_and_the_marks(surface, mesh, marks, tmp_path):
    alone, marked = tmp_path / "alone.png", tmp_path / "marked.png"
    riis.plot(surface, screenshot=alone).close()
    riis.plot(surface, mesh, marks, screenshot=marked).close()
    pictures = [numpy.asarray(pyvista.read(path).active_scalars)[:, :3].astype(int) for path in (alone, marked)]
    background = pictures[0][0]
    drawn = [numpy.count_nonzero((picture != background).any(axis=1)) for picture in pictures]
    assert drawn[0] > 10_000 and drawn[1] > 1.1 * drawn[0]  # the band is wider than the leaflets
    with pytest.raises(riis.InvalidArgumentError, match="marks: goes together with mesh"):
        riis.plot(surface, mesh)
