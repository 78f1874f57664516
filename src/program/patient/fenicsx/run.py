#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One beat of a patient's valve in dolfinx 0.9, written by riis patient. case.json has the numbers, in SI units.

    python3 run.py                                       # one process
    mpirun -n 2 python3 -m mpi4py run.py                 # two

Velocity and pressure are linear, with the usual stabilisation, and are solved together with K in the matrix. K is exact at the
quadrature points. A run that was cut off goes on. valve.csv has a row for each step, and flow_*.bp is for ParaView. At the end
it prints the table of report.py.
"""
import csv
import fcntl
import json
import os
import pathlib
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))  # mpi4py starts this file from its own folder
import report  # noqa: E402

PACKAGES = "sudo apt-get install --no-install-recommends python3-dolfinx python3-gmsh openmpi-bin libopenblas0-pthread"
try:
    import basix.ufl
    import dolfinx
    import gmsh
    import numpy
    from dolfinx import fem, io
    from dolfinx.fem.petsc import LinearProblem
    from mpi4py import MPI
    from ufl import (CellDiameter, FacetNormal, Measure, TestFunctions, TrialFunctions, div, dot, dx, grad, inner, min_value,
                     sqrt, sym)
except ImportError as error:
    sys.exit(f"run.py: {sys.executable} lacks {error.name}. Debian 13 has it: {PACKAGES}")
try:
    import riis
except ImportError:
    sys.exit(f"run.py: {sys.executable} lacks riis. In the sources of riis: /usr/bin/python3 -m venv --system-site-packages"
             " ~/fenicsx && ~/fenicsx/bin/pip install --no-deps . && ~/fenicsx/bin/python run.py")
if not dolfinx.__version__.startswith("0.9"):
    sys.exit(f"run.py: dolfinx is {dolfinx.__version__}, and this program is written for 0.9, the version of Debian 13")

CASE = json.loads((HERE / "case.json").read_text("utf-8"))
RHO, MU, R, EPS, DT = (CASE[name] for name in ("density", "viscosity", "resistance", "half_thickness", "time_step"))
assert gmsh  # dolfinx reads mesh.msh by it
EACH = 10  # steps from one file to the next
MMHG = 133.322
# Numbers of each step. The balance is the flow out of all ends together. The area is the area of the leaflets and the skirt in
# the mesh.
COLUMNS = ("step", "time_s", "opening", "before_Pa", "behind_Pa", "flow_m3_s", "fastest_m_s", "fastest_in_band_m_s",
           "balance_m3_s", "area_m2")


def read_stl(path):
    """Returns the triangles of an STL file, (n, 3, 3)."""
    data = path.read_bytes()
    n = int.from_bytes(data[80:84], "little")
    if len(data) == 84 + 50 * n:
        facets = numpy.frombuffer(data, numpy.dtype([("normal", "<3f4"), ("corners", "<9f4"), ("more", "<u2")]), n, 84)
        return facets["corners"].astype(float).reshape(-1, 3, 3)
    lines = (line.split() for line in data.decode("ascii", "replace").splitlines())
    return numpy.array([words[1:] for words in lines if words[:1] == ["vertex"]], float).reshape(-1, 3, 3)


class Valve:
    """The placed valve with its skirt up to the wall. It gives K and K u_valve at points."""

    def __init__(self, xyz):
        placed = riis.read_placed(HERE / "placed.json", CASE["unit"])
        self.valve, self.placement = placed.valve, placed.placement
        if CASE["skirt"] > 0:
            corners = read_stl(HERE / "wall.stl").reshape(-1, 3)
            wall = riis.Surface.from_arrays(corners, numpy.arange(len(corners)).reshape(-1, 3), zero_area="skip")
            self.valve.skirt_to_wall(wall, CASE["skirt"], **self.placement)
        self.before = self.valve.copy()
        self.surface = riis.Surface(self.valve, half_thickness=EPS, **self.placement)
        self.points, self.marks = riis.Mesh(xyz), riis.Marks()

    def add_resistance(self, before, now, K, K_u):
        """Adds K and K u_valve of a step from one opening to the next. Returns the number of points in the band."""
        self.before["opening"], self.valve["opening"] = before, now
        self.surface.update_moving(self.valve, self.before, DT, half_thickness=EPS, **self.placement)
        riis.mark(self.surface, self.points, into=self.marks, fields="velocity", n_threads=1, allow_none=True)
        self.marks.add_resistance(K, K_u, R=R)
        return len(self.marks.ids)


class Ball:
    """The mean of a field over the nodes in a ball."""

    def __init__(self, comm, space, centre, name):
        n = space.dofmap.index_map.size_local
        away = numpy.linalg.norm(space.tabulate_dof_coordinates()[:n] - centre, axis=1)
        self.comm, self.ids = comm, numpy.flatnonzero(away <= CASE["ball_radius"])
        self.count = comm.allreduce(len(self.ids))
        if self.count == 0:
            raise ValueError(f"case.json: no node is within ball_radius = {CASE['ball_radius']} m of {name} = {centre}")

    def mean(self, function):
        return self.comm.allreduce(function.x.array[self.ids].sum()) / self.count


class Windkessel:
    """The body behind an outlet. The flow of the last step gives its pressure."""

    def __init__(self, numbers, pressure):
        self.numbers, self.stored = numbers, pressure

    def pressure(self, flow):
        proximal, distal, compliance, vein = self.numbers
        self.stored = (self.stored + DT / compliance * (flow + vein / distal)) / (1 + DT / (compliance * distal))
        return self.stored + proximal * flow


class Restart:
    """Values at nodes in the order of mesh.msh, because dolfinx numbers nodes differently in each run."""

    path = HERE / "restart.npz"

    def __init__(self, mesh, space):
        self.comm, self.n = mesh.comm, mesh.geometry.index_map().size_global
        nodes = numpy.empty(space.dofmap.index_map.size_local + space.dofmap.index_map.num_ghosts, numpy.int64)
        nodes[space.dofmap.list.ravel()] = mesh.geometry.dofmap.ravel()
        self.numbers = mesh.geometry.input_global_indices[nodes]
        self.n_owned = space.dofmap.index_map.size_local

    def write(self, fields, state):
        whole = {}
        for name, (function, size) in fields.items():
            part = numpy.zeros((self.n, size))
            part[self.numbers[:self.n_owned]] = function.x.array.reshape(-1, size)[:self.n_owned]
            whole[name] = self.comm.reduce(part)
        if self.comm.rank == 0:
            numpy.savez(self.path.with_suffix(".part.npz"), state=json.dumps(state), **whole)
            self.path.with_suffix(".part.npz").replace(self.path)

    def read(self, fields):
        """Fills the fields and returns the state, or returns None if there is no file."""
        if not self.path.exists():
            return None
        file = numpy.load(self.path)
        for name, (function, size) in fields.items():
            if len(file[name]) != self.n:
                raise ValueError(f"{self.path} belongs to another mesh: remove it for a run from the start")
            function.x.array[:] = file[name][self.numbers].reshape(-1)
        return json.loads(str(file["state"]))


def curve(keys):
    times, pressures = numpy.array(keys).T
    return lambda now: numpy.interp(now % CASE["period"], times, pressures)


def locked(comm):
    """Locks this folder for as long as the returned file is open. Ends the program if another run has the lock."""
    file, is_free = None, True
    if comm.rank == 0:
        file = open(HERE / ".lock", "a", encoding="utf-8")
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            is_free = False
    if not comm.bcast(is_free):
        sys.exit(f"run.py: another run in {HERE} has not ended: wait for its end")
    if file:
        file.truncate(0)
        print(os.getpid(), file=file, flush=True)
    return file


def main(n_steps):
    comm = MPI.COMM_WORLD
    lock = locked(comm)
    mesh, _, tags = io.gmshio.read_from_msh(str(HERE / "mesh.msh"), comm, 0, gdim=3)
    groups = CASE["boundaries"]
    P1, P1_3 = (basix.ufl.element("Lagrange", mesh.basix_cell(), 1, shape=shape) for shape in ((), (3,)))
    W = fem.functionspace(mesh, basix.ufl.mixed_element([P1_3, P1]))
    V, Q = fem.functionspace(mesh, P1_3), fem.functionspace(mesh, P1)

    # K and K u_valve are computed at the quadrature points, where riis marks exactly.
    inside = dx(metadata={"quadrature_degree": 2})
    at_points = [basix.ufl.quadrature_element(mesh.basix_cell(), shape, degree=2) for shape in ((), (3,))]
    K, K_u = (fem.Function(fem.functionspace(mesh, element)) for element in at_points)
    valve = Valve(K.function_space.tabulate_dof_coordinates())

    new = fem.Function(W)
    u_old, p_old = fem.Function(V, name="velocity"), fem.Function(Q, name="pressure")
    (u, p), (v, q) = TrialFunctions(W), TestFunctions(W)
    h = CellDiameter(mesh)
    speed2 = inner(u_old, u_old)
    # The stabilisation of an element is limited by the element's largest K. Otherwise the pressure would pass at the edges of the
    # band.
    K_most = fem.Function(fem.functionspace(mesh, ("DG", 0)))
    tau = 1 / sqrt((2 * RHO / DT) ** 2 + (2 * RHO / h) ** 2 * speed2 + (12 * MU / h**2) ** 2 + K_most**2)
    # Every form is linear in (u, p), so the residual gives the matrix and the right-hand side.
    def momentum(u, p):
        return RHO / DT * u + RHO * dot(grad(u), u_old) + grad(p) + K * u
    known = RHO / DT * u_old + K_u
    streamline = RHO * dot(grad(v), u_old) + grad(q)
    a = (inner(RHO / DT * u + RHO * dot(grad(u), u_old) + RHO / 2 * div(u_old) * u + K * u, v)
         + 2 * MU * inner(sym(grad(u)), sym(grad(v))) - p * div(v) + q * div(u)) * inside
    a += (tau * inner(momentum(u, p), streamline) + h**2 / (12 * tau) * div(u) * div(v)) * inside
    L = (inner(known, v) + tau * inner(known, streamline)) * inside

    # A pressure is given at each end. Where blood enters, this pressure is the total pressure, so that a reversed flow stays
    # stable.
    normal, ds = FacetNormal(mesh), Measure("ds", mesh, subdomain_data=tags, metadata={"quadrature_degree": 2})
    pressures = {name: fem.Constant(mesh, 0.0) for name in groups if name != "wall"}
    for name, pressure in pressures.items():
        a -= RHO / 2 * min_value(dot(u_old, normal), 0) * inner(u, v) * ds(groups[name])
        L -= pressure * inner(normal, v) * ds(groups[name])
    still = fem.Function(V)
    at_wall = fem.locate_dofs_topological((W.sub(0), V), 2, tags.find(groups["wall"]))
    lu = {"ksp_type": "preonly", "pc_type": "lu", "pc_factor_mat_solver_type": "mumps", "mat_mumps_icntl_14": 60}
    problem = LinearProblem(a, L, [fem.dirichletbc(still, at_wall, W.sub(0))], new, petsc_options=lu)
    outflows = {name: fem.form(dot(u_old, normal) * ds(groups[name])) for name in pressures}
    resistance, n_cells = fem.form(K * inside), mesh.topology.index_map(3).size_local

    before, behind = (Ball(comm, Q, CASE[name], name) for name in ("upstream", "downstream"))
    driven = {name: curve(keys) for name, keys in CASE["pressures"].items()}
    bodies = {name: Windkessel(one["numbers"], one["pressure"]) for name, one in CASE["windkessels"].items()}
    law = riis.OpeningSwitch(**CASE["law"])
    at = {"opening": 1.0, "progress": 1.0, "phase": "opening"} if not CASE["starts_closed"] else {}
    state, first, flows = riis.OpeningSwitchState(**at), 1, dict.fromkeys(pressures, 0.0)

    fields, restart, rows = {"velocity": (u_old, 3), "pressure": (p_old, 1)}, Restart(mesh, Q), []
    saved = restart.read(fields)
    if saved:
        first, flows, rows = saved["step"] + 1, saved["flows"], saved["rows"]
        state = riis.OpeningSwitchState(**saved["switch"])
        for name, stored in saved["bodies"].items():
            bodies[name].stored = stored
    say = print if comm.rank == 0 else lambda *words, **more: None
    say(f"{comm.allreduce(K.function_space.dofmap.index_map.size_local) // 4:,} tetrahedra, {restart.n:,} nodes; "
        + (f"goes on after step {first - 1}" if saved else f"{n_steps} steps of {DT} s"), flush=True)
    file, begin = io.VTXWriter(comm, HERE / f"flow_{first:03d}.bp", [u_old, p_old]), time.time()
    for step in range(first, n_steps + 1):
        now = step * DT
        for name, pressure in pressures.items():
            pressure.value = driven[name](now) if name in driven else bodies[name].pressure(flows[name])
        # The pressures and the flow of the last step move the valve, so that a step needs no iteration.
        opening_before = state.opening
        if step > 1:
            state = law.advance(state, now, before.mean(p_old) - behind.mean(p_old), -flows["inlet"])
        K.x.array[:], K_u.x.array[:] = 0, 0
        marked = valve.add_resistance(opening_before, state.opening, K.x.array, K_u.x.array.reshape(-1, 3))
        if comm.allreduce(marked) == 0:
            raise ValueError(f"step {step}: no point of mesh.msh is within half_thickness = {EPS} m of the valve")
        K_most.x.array[:] = K.x.array[K.function_space.dofmap.list].max(axis=1)
        problem.solve()
        u_old.interpolate(new.sub(0))
        p_old.interpolate(new.sub(1))
        u_old.x.scatter_forward()
        p_old.x.scatter_forward()
        flows = {name: comm.allreduce(fem.assemble_scalar(form)) for name, form in outflows.items()}
        speed = numpy.linalg.norm(u_old.x.array.reshape(-1, 3), axis=1)
        band = V.dofmap.list[:n_cells][K_most.x.array[:n_cells] > 0].ravel()
        fastest, in_band = (comm.allreduce(speeds.max(initial=0.0), MPI.MAX) for speeds in (speed, speed[band]))
        rows.append([step, now, state.opening, before.mean(p_old), behind.mean(p_old), -flows["inlet"], fastest, in_band,
                     sum(flows.values()), EPS / R * comm.allreduce(fem.assemble_scalar(resistance))])
        if not numpy.isfinite(fastest):
            raise FloatingPointError(f"step {step}: the velocity is not finite; a smaller time_step in case.json may help")
        say(f"{now:.3f} s, opening {state.opening:.3f}, drop {(rows[-1][3] - rows[-1][4]) / MMHG:7.2f} mmHg, "
            f"flow {-1e6 * flows['inlet']:7.2f} ml/s, fastest {fastest:.2f} m/s", flush=True)
        if step == first + 2:
            left = (time.time() - begin) / 3 * (n_steps - step)
            say(f"the other {n_steps - step} steps take about {left / 60:.0f} minutes", flush=True)
        if step % EACH == 0 or step == n_steps:
            file.write(now)
            restart.write(fields, {"step": step, "flows": flows, "rows": rows, "switch": vars(state),
                                   "bodies": {name: body.stored for name, body in bodies.items()}})
            if comm.rank == 0:
                with open(HERE / "valve.csv", "w", newline="", encoding="utf-8") as table:
                    csv.writer(table).writerows([COLUMNS, *rows])
    file.close()
    if comm.rank == 0:
        report.table()
        lock.close()


if __name__ == "__main__":
    if len(sys.argv) > 2 or not all(word.isdigit() and int(word) > 0 for word in sys.argv[1:]):
        sys.exit(f"run.py takes a number of steps or nothing, but got '{' '.join(sys.argv[1:])}'")
    main(int(sys.argv[1]) if len(sys.argv) == 2 else CASE["steps"])
