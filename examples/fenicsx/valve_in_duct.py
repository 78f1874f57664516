# SPDX-License-Identifier: Apache-2.0
"""Blood flows through a duct while a mechanical heart valve opens in it: riis in dolfinx 0.9, on any number of ranks.

    mpirun -n 2 python3 -m mpi4py valve_in_duct.py        # writes flow.bp for ParaView
"""
import pathlib
import sys
from types import SimpleNamespace

import basix.ufl
import gmsh
import numpy
import riis
from dolfinx import fem, io
from dolfinx.fem.petsc import LinearProblem
from mpi4py import MPI
from ufl import FacetNormal, Measure, TestFunctions, TrialFunctions, div, dot, dx, grad, inner, max_value, split, sym

RADIUS, MEAN_SPEED, RHO, MU = 0.011, 0.1, 1060.0, 0.0035  # the duct's radius in m; the flow in m/s, kg/m3 and Pa s
R = 20.0  # the valve's resistance in kg/(m s)
GRAD_DIV = 2.0  # in Pa s, about R h / eps / 10


def duct(comm, size):
    """Returns the mesh and the tags of its inlet (1), outlet (2) and wall (3). Edges at the valve have the given size."""
    if not 2e-4 <= size <= 1e-2:
        raise ValueError(f"size is {size}; it must be from 2e-4 to 1e-2, in m")
    gmsh.initialize(["gmsh", "-setnumber", "size", str(size)])
    gmsh.option.setNumber("General.Verbosity", 2)
    if comm.rank == 0:
        gmsh.open(str(pathlib.Path(__file__).with_name("duct.geo")))
        gmsh.model.mesh.generate(3)
    mesh, _, tags = io.gmshio.model_to_mesh(gmsh.model, comm, 0)
    gmsh.finalize()
    return mesh, tags


def flow(comm, law, dt, n_steps, size=2e-3, eps=2e-3, kind="bileaflet", speed=MEAN_SPEED, **parameters):
    """Yields the state after each time step. `law` gives the opening at a time, and `parameters` belong to the valve.

    Blood flows in with the mean speed `speed`. If it is None, no stress acts at the inlet, so both pressures are equal."""
    mesh, tags = duct(comm, size)
    P1 = basix.ufl.element("Lagrange", mesh.basix_cell(), 1)
    P2 = basix.ufl.element("Lagrange", mesh.basix_cell(), 2, shape=(3,))
    W, V = fem.functionspace(mesh, basix.ufl.mixed_element([P2, P1])), fem.functionspace(mesh, P2)

    # K and K u_valve are functions with values at the points of the velocity, which riis marks.
    K, K_u = fem.Function(fem.functionspace(mesh, ("Lagrange", 2))), fem.Function(V)
    xyz = V.tabulate_dof_coordinates()
    assert numpy.array_equal(xyz, K.function_space.tabulate_dof_coordinates())
    points, marks = riis.Mesh(xyz), riis.Marks()
    valve = riis.Valve(kind, **parameters)
    before = valve.copy()
    surface = riis.Surface(valve, scale=0.01, half_thickness=eps)  # the valve's tables are in cm

    # The equations of one time step balance momentum and mass. K is in the matrix, and K u_valve on the right-hand side.
    new, u_old = fem.Function(W), fem.Function(V, name="velocity")
    (u, p), (v, q) = TrialFunctions(W), TestFunctions(W)
    rho_dt, drag = RHO / fem.Constant(mesh, dt), max_value(K, 0)  # K falls below 0 at some places between its points
    a = (rho_dt * inner(u, v) + RHO * inner(dot(grad(u), u_old), v) + RHO / 2 * div(u_old) * inner(u, v)) * dx
    a += (2 * MU * inner(sym(grad(u)), sym(grad(v))) + drag * inner(u, v) - p * div(v) - q * div(u)) * dx
    a += fem.Constant(mesh, GRAD_DIV) * div(u) * div(v) * dx  # limits how much the error of p in the band disturbs div u
    L = (rho_dt * inner(u_old, v) + inner(K_u, v)) * dx

    # The inflow is a parabola, blood rests at the wall, and no stress acts at the outlet.
    still, inflow = fem.Function(V), fem.Function(V)
    inflow.interpolate(lambda x: numpy.outer([0, 0, 2 * (speed or 0)], 1 - (x[0] ** 2 + x[1] ** 2) / RADIUS**2))
    bcs = [fem.dirichletbc(value, fem.locate_dofs_topological((W.sub(0), V), 2, tags.find(tag)), W.sub(0))
           for value, tag in ((inflow, 1), (still, 3)) if speed is not None or tag == 3]
    lu = {"ksp_type": "preonly", "pc_type": "lu", "pc_factor_mat_solver_type": "mumps"}
    problem = LinearProblem(a, L, bcs, new, petsc_options=lu)
    inlet = Measure("ds", mesh, subdomain_data=tags)(1)
    sums = [fem.form(f * inlet) for f in (1.0, -dot(split(new)[0], FacetNormal(mesh)), split(new)[1])]
    sums += [fem.form((drag * split(new)[0][axis] - K_u[axis]) * dx) for axis in range(3)]  # the force on the valve

    for step in range(1, n_steps + 1):
        before["opening"], valve["opening"] = law((step - 1) * dt), law(step * dt)
        surface.update_moving(valve, before, dt)
        riis.mark(surface, points, into=marks, fields="velocity", n_threads=1, allow_none=True)
        if comm.allreduce(len(marks.ids)) == 0:
            raise ValueError(f"step {step}: no point of the mesh is within eps = {eps} m of the valve")
        K.x.array[:], K_u.x.array[:] = 0, 0
        marks.add_resistance(K.x.array, K_u.x.array.reshape(-1, 3), R=R)
        problem.solve()
        u_old.interpolate(new.sub(0))
        area, rate, push, *force = (comm.allreduce(fem.assemble_scalar(form)) for form in sums)
        yield SimpleNamespace(time=step * dt, opening=valve["opening"], drop=push / area, rate=rate, velocity=u_old,
                              force=force, K=K, K_u=K_u, marks=marks, surface=surface)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        sys.exit(f"valve_in_duct.py takes no arguments, but got '{' '.join(sys.argv[1:])}'; its numbers are in the file")
    opens, file = riis.OpeningTimes(0.04, 0.08, 0.5, 0.08, period=1.0), None  # it opens from 0.04 s to 0.12 s
    for state in flow(MPI.COMM_WORLD, opens, dt=0.02, n_steps=10, hinge_offset=0.45):
        file = file or io.VTXWriter(MPI.COMM_WORLD, "flow.bp", [state.velocity])
        file.write(state.time)
        if MPI.COMM_WORLD.rank == 0:
            print(f"{state.time:.3f} s, opening {state.opening:.3f}, drop {state.drop:6.1f} Pa, flow {1e6 * state.rate:.2f} ml/s")
    file.close()
