# SPDX-License-Identifier: Apache-2.0
"""After ten thousand steps of a moving valve, the process uses as much memory as before."""

import numpy

import riis


def resident_kib():
    with open("/proc/self/status", encoding="utf-8") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))


def test_ten_thousand_steps_take_no_memory():
    nodes = numpy.random.default_rng(4).uniform(-2.0, 2.0, (2000, 3))
    mesh, valve = riis.Mesh(nodes), riis.Valve("mitral")
    before, own = valve.copy(), riis.Marks()
    surface = riis.Surface(valve, half_thickness=0.3, tolerance=0.5, n_threads=1)
    coefficient, momentum = numpy.zeros(len(nodes)), numpy.zeros((len(nodes), 3))

    def step(i):
        before["opening"] = valve["opening"]
        valve["opening"] = 0.5 + 0.4 * numpy.sin(0.01 * i)
        surface.update_moving(valve, before, 0.01)
        riis.mark(surface, mesh, into=own, fields="velocity, normal", n_threads=1)
        fresh = riis.mark(surface, mesh, fields=["velocity"], n_threads=1)
        fresh.add_resistance(coefficient, momentum, R=1.0)
        total = own.distance.sum() + fresh.velocity.sum() + surface.vertices.sum() + len(own.within_limit)
        try:
            riis.mark(surface, mesh, search="none")
        except riis.InvalidArgumentError as error:
            total += len(str(error))
        surface.closest_points(nodes[:10])
        nodes[:] += 1e-9
        mesh.update()
        return total

    for i in range(1000):
        step(i)
    start = resident_kib()
    for i in range(1000, 11_000):
        step(i)
    grown = resident_kib() - start
    print(f"10,000 steps: the process grew by {grown} KiB from {start} KiB")
    assert grown < 2000  # 0.2 KiB per step; one array of a step has 16 KiB
