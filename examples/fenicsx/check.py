# SPDX-License-Identifier: Apache-2.0
"""The checks and the picture of ./run fenicsx. A check prints its numbers, and ends with an error if a number is out of its
bounds."""
import itertools
import json
import pathlib
import subprocess
import sys

import numpy

RADIUS, HINGE, DT, EPS = 0.011, 0.45, 0.02, 2e-3
LEAFLET = "#d55e00"  # a colour of riis's palette, which every kind of colour vision tells apart


def require(holds, text):
    if not holds:
        raise SystemExit(f"check.py: not as it must be: {text}")


def law():
    import riis
    return riis.OpeningTimes(0.04, 0.08, 0.5, 0.08, period=1.0)


def values_at(function, points):
    """Returns the values of a function at points of the whole mesh, on rank 0. Points outside the mesh get NaN."""
    from dolfinx import geometry
    mesh = function.function_space.mesh
    tree = geometry.bb_tree(mesh, mesh.topology.dim)
    cells = geometry.compute_colliding_cells(mesh, geometry.compute_collisions_points(tree, points), points)
    here = [i for i in range(len(points)) if len(cells.links(i))]
    values = numpy.full((len(points), 3), -numpy.inf)
    values[here] = function.eval(points[here], [cells.links(i)[0] for i in here]).reshape(-1, 3)
    found = mesh.comm.gather(values)
    if found is None:
        return None
    largest = numpy.max(found, axis=0)
    return numpy.where(numpy.isinf(largest), numpy.nan, largest)


def record(folder, n_steps):
    """Runs the flow, and writes the owned points of each rank with K, K u_valve and the velocity of each step."""
    from mpi4py import MPI
    import valve_in_duct
    comm, folder = MPI.COMM_WORLD, pathlib.Path(folder)
    x, z = numpy.meshgrid(numpy.linspace(-RADIUS, RADIUS, 67), numpy.linspace(-0.012, 0.032, 133))
    grid = numpy.column_stack([x.ravel(), 0 * x.ravel(), z.ravel()])
    steps, rows, cuts = [], [], []
    for state in valve_in_duct.flow(comm, law(), DT, int(n_steps), eps=EPS, hinge_offset=HINGE):
        space = state.velocity.function_space
        n = space.dofmap.index_map.size_local
        steps.append([function.x.array.reshape(-1, size)[:n].copy()
                      for function, size in ((state.K, 1), (state.K_u, 3), (state.velocity, 3))])
        rows.append([state.time, state.opening, state.drop, state.rate])
        cuts.append(values_at(state.velocity, grid))
    fields = {name: numpy.stack(values) for name, values in zip(("K", "K_u", "velocity"), zip(*steps))}
    numpy.savez(folder / f"rank{comm.rank}of{comm.size}.npz", xyz=space.tabulate_dof_coordinates()[:n], **fields)
    if comm.rank == 0:
        numpy.savez(folder / f"cuts{comm.size}.npz", x=x, z=z, velocity=numpy.stack(cuts))
        (folder / f"rows{comm.size}.json").write_text(json.dumps(rows))


def read(folder, n_ranks):
    """Returns the points of all ranks, each once, with their fields."""
    parts = [numpy.load(pathlib.Path(folder) / f"rank{rank}of{n_ranks}.npz") for rank in range(n_ranks)]
    fields = {name: numpy.concatenate([part[name] for part in parts], axis=1) for name in ("K", "K_u", "velocity")}
    return numpy.concatenate([part["xyz"] for part in parts]), fields


def order(xyz):
    return numpy.lexsort(numpy.round(xyz, 10).T)


def compare(xyz, fields, other_xyz, other):
    """Compares two runs point by point. Returns the number of points whose bits differ, and a row of counts and differences
    for each step."""
    require(len(xyz) == len(other_xyz), f"both have as many points, not {len(xyz)} and {len(other_xyz)}")
    partner = numpy.empty(len(xyz), int)  # its ordinal in the other run, by the order of coordinates to 1e-10 m
    partner[order(xyz)] = order(other_xyz)
    require(numpy.abs(xyz - other_xyz[partner]).max() < 1e-12, "each point of one run is a point of the other, to 1e-12 m")
    moved = (xyz != other_xyz[partner]).any(axis=1)
    rows = []
    for step in range(min(len(fields["K"]), len(other["K"]))):
        K, there = fields["K"][step, :, 0], other["K"][step, partner, 0]
        different = (K != there) | (fields["K_u"][step] != other["K_u"][step, partner]).any(axis=1)
        velocity = fields["velocity"][step]
        rows.append([int((K > 0).sum()), int(((K > 0) != (there > 0)).sum()), int(different.sum()),
                     int((different & ~moved).sum()), numpy.abs(K - there).max() / K.max(),
                     numpy.abs(velocity - other["velocity"][step, partner]).max() / numpy.abs(velocity).max()])
    counts = numpy.array(rows)
    require(counts[:, 0].min() > 100, f"each step marks points, not {counts[:, 0]}")
    require(not counts[:, 1].any(), f"both runs mark the same points, not others in the steps' numbers {counts[:, 1]}")
    require(not counts[:, 3].any(), "points with the same bits have the same bits of K and K u_valve")
    require(counts[:, 4].max() < 1e-9, f"K differs by at most 1e-9 of the largest, not {counts[:, 4].max():.1e}")
    return int(moved.sum()), rows


def alone(xyz, fields, rows):
    """Marks the points of all ranks in one process without dolfinx, and requires the same bits."""
    import riis
    import valve_in_duct
    valve = riis.Valve("bileaflet", hinge_offset=HINGE)
    before, surface, times = valve.copy(), riis.Surface(valve, scale=0.01, half_thickness=EPS), law()
    for step, (_, opening, _, _) in enumerate(rows):
        before["opening"], valve["opening"] = times(step * DT), times((step + 1) * DT)
        require(valve["opening"] == opening, f"the run had the opening {valve['opening']}, not {opening}")
        surface.update_moving(valve, before, DT)
        marks = riis.mark(surface, riis.Mesh(xyz), fields="velocity")
        K, K_u = numpy.zeros(len(xyz)), numpy.zeros((len(xyz), 3))
        marks.add_resistance(K, K_u, R=valve_in_duct.R)
        require(numpy.array_equal(K, fields["K"][step, :, 0]) and numpy.array_equal(K_u, fields["K_u"][step]),
                f"step {step + 1} has the bits of a marking of all points at once")


def marks(folder, *ranks):
    """Compares the marks of runs on several ranks with the run on 1 rank."""
    xyz, fields = read(folder, 1)
    print(f"{len(xyz):,} points of the velocity. Those of several ranks are paired with those of 1 rank by coordinates."
          "\nThe differences are the largest, over the largest value.")
    widths = (5, 5, 13, 11, 11, 10, 12, 10, 11)
    for row in (("ranks", "steps", "marked", "marked only", "points with", "K with", "these with", "difference", "difference"),
                ("", "", "", "in one", "other bits", "other bits", "equal points", "of K", "of velocity")):
        print(" ", *(f"{word:>{width}}" for word, width in zip(row, widths)))
    for n in map(int, ranks):
        other_xyz, other = read(folder, n)
        moved, rows = compare(xyz, fields, other_xyz, other)
        alone(other_xyz, other, json.loads((pathlib.Path(folder) / f"rows{n}.json").read_text()))
        counts = numpy.array(rows)
        print(f"  {n:>5} {len(rows):>5} {int(counts[:, 0].min()):>6,}-{int(counts[:, 0].max()):<6,} {int(counts[:, 1].sum()):>11}"
              f" {moved:>11,} {int(counts[:, 2].max()):>10,} {int(counts[:, 3].sum()):>12} {counts[:, 4].max():>10.1e}"
              f" {counts[:, 5].max():>11.1e}")
        require(counts[:, 5].max() < 1e-6, "the velocities agree to 1e-6")
    alone(xyz, fields, json.loads((pathlib.Path(folder) / "rows1.json").read_text()))
    print("  Each run has K and K u_valve with the bits of a marking of all its points at once, without dolfinx.")


def drops():
    """Compares the drop across the closed valve with (R / eps) Q/A, where Q is the flow and A the area of the leaflets."""
    from mpi4py import MPI
    import valve_in_duct

    def drop(size, eps, opening=0.0, **parameters):
        *_, state = valve_in_duct.flow(MPI.COMM_WORLD, lambda time: opening, 0.05, 2, size, eps, **parameters)
        return state.drop, valve_in_duct.R / eps * state.rate / state.surface.info.area

    print("Drop in Pa across the closed valve in a steady flow. The closed form is (R / eps) Q / A, A the area of the leaflets.")
    print(f"  {'leaflets':>9} {'eps, mm':>8} {'edges, mm':>9} {'grad-div':>8} {'drop':>7} {'closed form':>11} {'ratio':>6}")
    term = valve_in_duct.GRAD_DIV
    ratios = {}
    for angle, size, grad_div in ((0, 2.5e-3, term), (0, 2e-3, term), (0, 1.6e-3, term), (0, 2e-3, 0.0),
                                  (30, 2.5e-3, term), (30, 2e-3, term), (30, 1.6e-3, term), (30, 2e-3, 0.0)):
        valve_in_duct.GRAD_DIV = grad_div
        found, expected = drop(size, EPS, closed_angle=float(angle), hinge_offset=HINGE)
        ratios[angle, size, grad_div] = found / expected
        print(f"  {angle:>5} deg {1e3 * EPS:>8} {1e3 * size:>9} {grad_div:>8} {found:>7.1f} {expected:>11.1f}"
              f" {found / expected:>6.3f}")
    valve_in_duct.GRAD_DIV = term
    found, expected = drop(2e-3, EPS, 1.0, hinge_offset=HINGE)
    print(f"  the open valve, edges of 2 mm: {found:.1f} Pa, {100 * found / expected:.1f} % of the closed form")
    for (angle, size, grad_div), ratio in ratios.items():
        limit = 0.05 if angle == 0 else 0.12
        require(grad_div == 0 or abs(ratio - 1) < limit,
                f"the ratio at {angle} degrees and edges of {size} m is within {limit} of 1, not {ratio}")
    require(0 < found < 0.05 * expected, f"the open valve has a drop, and at most 5 % of that of the closed one, not {found}")


def forces():
    """Computes the force on a valve that opens between equal pressures. By symmetry this force has no component along x or y."""
    from mpi4py import MPI
    import riis
    import valve_in_duct
    opens = riis.OpeningTimes(0.0, 0.04, 0.5, 0.08, period=1.0)
    resistance, term = valve_in_duct.R, valve_in_duct.GRAD_DIV
    print("Largest force in N on a valve that opens in 0.04 s between equal pressures, in steps of 0.004 s. Edges of 2.5 mm.")
    print(f"  {'valve':>10} {'R':>6} {'grad-div':>8} {'|Fx|':>7} {'|Fy|':>7} {'|Fz|':>7}")
    largest = {}
    for kind, factor in (("bileaflet", 1), ("trileaflet", 1), ("bileaflet", 100)):
        valve_in_duct.R, valve_in_duct.GRAD_DIV = factor * resistance, factor * term
        parameters = {"hinge_offset": HINGE} if kind == "bileaflet" else {}
        states = valve_in_duct.flow(MPI.COMM_WORLD, opens, 0.004, 10, 2.5e-3, EPS, kind, None, **parameters)
        found = largest[kind, factor] = numpy.abs([state.force for state in states]).max(axis=0)
        print(f"  {kind:>10} {valve_in_duct.R:>6} {valve_in_duct.GRAD_DIV:>8}" + "".join(f" {one:>7.4f}" for one in found))
    valve_in_duct.R, valve_in_duct.GRAD_DIV = resistance, term
    for kind in ("bileaflet", "trileaflet"):
        require(largest[kind, 1][:2].max() < 0.05, f"{kind}, R = {resistance}: the forces across are below 0.05 N")
    require(largest["bileaflet", 100][0] > 0.1, "with R a hundred times larger the false force exceeds 0.1 N, as README says")


def refusals():
    """Checks that each bad input is refused with the expected error and words."""
    from mpi4py import MPI
    import riis
    import valve_in_duct

    def step(opening=0.0, dt=DT, size=4e-3, **rest):
        return lambda: list(valve_in_duct.flow(MPI.COMM_WORLD, lambda time: opening, dt, 1, size, **rest))

    cases = (
        ("an unknown parameter", step(hinge_ofset=0.3), riis.InvalidParameterError, "hinge_ofset"),
        ("a parameter out of range", step(closed_angle=95.0), riis.InvalidParameterError, "closed_angle"),
        ("an opening of NaN", step(float("nan")), riis.InvalidParameterError, "opening"),
        ("a half thickness of 0", step(eps=0.0), riis.InvalidArgumentError, "half_thickness is 0"),
        ("a time step of 0", step(dt=0.0), riis.InvalidArgumentError, "dt is 0"),
        ("a valve outside the mesh", step(hinge_height=9.0), ValueError, "step 1: no point of the mesh is within eps = 0.002 m"),
        ("a size in mm", step(size=2.0), ValueError, "size is 2.0; it must be from 2e-4 to 1e-2, in m"),
    )
    for name, call, kind, words in cases:
        try:
            call()
        except kind as error:
            require(words in str(error), f"{name}: the text has '{words}', not '{error}'")
            print(f"  {name + ':':<26} {type(error).__name__}: {error}")
        else:
            require(False, f"{name} is refused by {kind.__name__}")
    program = pathlib.Path(__file__).with_name("valve_in_duct.py")
    answer = subprocess.run([sys.executable, "-B", program, "--steps", "3"], capture_output=True, text=True, check=False)
    require(answer.returncode == 1 and "takes no arguments, but got '--steps 3'" in answer.stderr,
            f"words behind the program's name are refused, not {answer}")
    print(f"  {'words behind its name:':<26} {answer.stderr.strip()}")


def leaflets(opening):
    """Returns the lines in which the leaflets cut the plane y = 0, as pairs of x and z in m."""
    import riis
    surface = riis.Surface(riis.Valve("bileaflet", hinge_offset=HINGE, opening=opening), scale=0.01, half_thickness=EPS)
    lines = []
    for corners in surface.vertices[surface.triangles.vertex_id]:
        ends = [a + a[1] / (a[1] - b[1]) * (b - a) for a, b in itertools.combinations(corners, 2) if (a[1] > 0) != (b[1] > 0)]
        if len(ends) == 2:
            lines.append([(end[0], end[2]) for end in ends])
    return lines


def picture(folder, path):
    """Draws the speed in the plane y = 0 with the leaflets: closed, half open, open, and at the end."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection
    folder = pathlib.Path(folder)
    cuts, rows = numpy.load(folder / "cuts1.npz"), json.loads((folder / "rows1.json").read_text())
    chosen = [1, 3, 5, len(rows) - 1]
    speed = numpy.linalg.norm(cuts["velocity"][chosen], axis=-1).reshape(len(chosen), *cuts["x"].shape)
    figure, axes = plt.subplots(1, len(chosen), figsize=(11, 5.4), sharey=True, layout="constrained")
    for one, step, values in zip(axes, chosen, speed):
        time, opening, drop, _ = rows[step]
        colours = one.pcolormesh(1e3 * cuts["x"], 1e3 * cuts["z"], values, vmin=0, vmax=numpy.nanmax(speed), shading="gouraud")
        u = cuts["velocity"][step].reshape(*cuts["x"].shape, 3)[::6, ::6]
        one.quiver(1e3 * cuts["x"][::6, ::6], 1e3 * cuts["z"][::6, ::6], u[..., 0], u[..., 2], color="white", scale=4,
                   width=0.004)
        lines = [[(1e3 * x, 1e3 * z) for x, z in line] for line in leaflets(opening)]
        one.add_collection(LineCollection(lines, colors=LEAFLET, linewidths=2))
        one.set_title(f"{time:.3f} s, opening {opening:.2f}\ndrop {drop:.0f} Pa", fontsize=10)
        one.set_aspect("equal")
        one.set_xlabel("x, mm")
    axes[0].set_ylabel("z, mm; blood flows upwards")
    figure.colorbar(colours, ax=axes, label="speed, m/s", shrink=0.9)
    figure.suptitle("Speed and velocity in the plane y = 0; orange: the leaflets there")
    figure.savefig(path, dpi=70)


if __name__ == "__main__":
    commands = {"record": record, "marks": marks, "drops": drops, "forces": forces, "refusals": refusals, "picture": picture}
    if len(sys.argv) < 2 or sys.argv[1] not in commands:
        raise SystemExit(f"usage: check.py {'|'.join(commands)} ARGUMENT...")
    commands[sys.argv[1]](*sys.argv[2:])
