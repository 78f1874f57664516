# SPDX-License-Identifier: Apache-2.0
"""Writes the cases of ./run svmultiphysics.

    cases.py tube|elastic EDGE FILE.geo                   # the geometry for gmsh
    cases.py scaffold FILE.vtu                            # a ring at rest between the valve and the wall
    cases.py scale FOLDER FACTOR                          # divides the coordinates of an export by FACTOR, and drops its box
    cases.py fluid|taylor-hood|fsi DUCT.msh FOLDER STEPS PRESSURE PERIOD BLOCK.xml...

The last form makes FOLDER with the meshes and solver.xml. The pressure at the lower end is PRESSURE cos(2 pi t / PERIOD), and 0
at the upper end. Each BLOCK is the output of `riis export`, which was run in the present folder. Units are CGS.
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench/peers"))
import uris_case  # noqa: E402

TIME_STEP = 0.004
LOW, HIGH, RADIUS, OUTER = -1.6, 2.0, 1.25, 1.45  # of the tube and of its wall
EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))  # with a node in the middle, in the order of VTK
FACES = uris_case.ELEMENTS[4][2]


def geometry(kind, edge, path):
    wall = f"""Cylinder(2) = {{0, 0, {LOW}, 0, 0, {HIGH - LOW}, {OUTER}}};
BooleanFragments{{ Volume{{1}}; Delete; }}{{ Volume{{2}}; Delete; }}
""" if kind == "elastic" else ""
    pathlib.Path(path).write_text(f"""SetFactory("OpenCASCADE");
Cylinder(1) = {{0, 0, {LOW}, 0, 0, {HIGH - LOW}, {RADIUS}}};
{wall}Mesh.MeshSizeMin = {edge};
Mesh.MeshSizeMax = {edge};
""", encoding="ascii")


def scaffold(path):
    count, radii = 36, (0.95, RADIUS)
    angles = [2 * math.pi * i / count for i in range(count)]
    places = [(r * math.cos(angle), r * math.sin(angle), -0.35) for r in radii for angle in angles]
    cells = []
    for i in range(count):
        j = (i + 1) % count
        cells += [[i, i + count, j + count], [i, j + count, j]]
    uris_case.write_vtk(pathlib.Path(path), places, range(1, len(places) + 1), cells, range(1, len(cells) + 1), 5)


def scale(folder, factor):
    """With Mesh_scale_factor, the solver multiplies the coordinates again. The face box needs exact sums, so it is left out."""
    for path in sorted(pathlib.Path(folder).iterdir()):
        if path.stem.startswith("box"):
            path.unlink()
        elif path.suffix == ".dat" and path.name != "normal.dat":
            head, *rows = path.read_text(encoding="ascii").splitlines()
            rows = [" ".join(f"{float(word) / float(factor):.17g}" for word in row.split()) for row in rows]
            path.write_text("\n".join([head, *rows]) + "\n", encoding="ascii")


# ---- Meshes ----


def add_middles(nodes, cells):
    """Makes elements of ten nodes."""
    middles = {}
    for corners in cells:
        for a, b in EDGES:
            key = frozenset((corners[a], corners[b]))
            if key not in middles:
                middles[key] = max(nodes) + 1
                nodes[middles[key]] = [(p + q) / 2 for p, q in zip(nodes[corners[a]], nodes[corners[b]])]
    return middles


def write_part(folder, nodes, cells, middles, name_of):
    """Writes a mesh and its faces. name_of gives the name of the face that has these corners."""
    folder.mkdir(parents=True)

    def all_nodes(corners, pairs):
        return corners + [middles[frozenset((corners[a], corners[b]))] for a, b in pairs] if middles else corners

    full = [all_nodes(corners, EDGES) for corners in cells]
    numbers = {node: i for i, node in enumerate(sorted({node for cell in full for node in cell}))}
    uris_case.write_vtk(folder / "mesh.vtu", [nodes[n] for n in numbers], range(1, len(numbers) + 1),
                        [[numbers[n] for n in cell] for cell in full], range(1, len(full) + 1), 24 if middles else 10)
    parts = {}
    for corners, number in uris_case.outer_faces([(4, corners) for corners in cells]):
        parts.setdefault(name_of([nodes[n] for n in corners]), []).append((all_nodes(corners, EDGES[:3]), number))
    for name, faces in parts.items():
        used = {node: i for i, node in enumerate(sorted({n for face, _ in faces for n in face}))}
        uris_case.write_vtk(folder / f"{name}.vtp", [nodes[n] for n in used], [numbers[n] + 1 for n in used],
                            [[used[n] for n in face] for face, _ in faces], [number for _, number in faces])
    print(f"{folder}: {len(numbers)} nodes, {len(full)} elements")


def radius(place):
    return math.hypot(place[0], place[1])


def end_of(places):
    """Returns the name of the end of the tube that has these corners, or None."""
    for name, height in (("low", LOW), ("high", HIGH)):
        if all(abs(place[2] - height) < 1e-6 for place in places):
            return name
    return None


# ---- solver.xml ----

SOLVER = """<LS type="{kind}"> <Linear_algebra type="fsils"> <Preconditioner> fsils </Preconditioner> </Linear_algebra>
<Tolerance> {tolerance} </Tolerance> <Krylov_space_dimension> 250 </Krylov_space_dimension>
<Max_iterations> {most} </Max_iterations> </LS>
"""
FLUID = """<Density> 1.06 </Density> <Viscosity model="Constant"> <Value> 0.04 </Value> </Viscosity>
<Backflow_stabilization_coefficient> 0.2 </Backflow_stabilization_coefficient>
"""
SOLID = """<Constitutive_model type="neoHookean"> </Constitutive_model> <Dilational_penalty_model> M94 </Dilational_penalty_model>
<Density> 1.0 </Density> <Elasticity_modulus> 5.0e7 </Elasticity_modulus> <Poisson_ratio> 0.3 </Poisson_ratio>
"""
MEANS = '<Output type="{kind}"> <Pressure> true </Pressure> <Velocity> true </Velocity> </Output>\n'
DRIVE = """<Type> Neu </Type> <Time_dependence> Unsteady </Time_dependence>
<Temporal_values_file_path> pressure.dat </Temporal_values_file_path>"""
STEADY = "<Type> {kind} </Type> <Time_dependence> Steady </Time_dependence> <Value> 0 </Value>"


def condition(name, text):
    return f'<Add_BC name="{name}"> {text} </Add_BC>\n'


def mesh(name, folder, faces, domain=None):
    lines = "".join(f'<Add_face name="{label}"> <Face_file_path> {folder}/{face}.vtp </Face_file_path> </Add_face>\n'
                    for label, face in faces)
    more = "" if domain is None else f"<Domain> {domain} </Domain>\n"
    return f'<Add_mesh name="{name}">\n<Mesh_file_path> {folder}/mesh.vtu </Mesh_file_path>\n{lines}{more}</Add_mesh>\n'


def equation(kind, settings, conditions, tolerance, most_iterations):
    return (f'<Add_equation type="{kind}">\n<Coupled> true </Coupled> <Min_iterations> 2 </Min_iterations>\n'
            f"<Max_iterations> {most_iterations} </Max_iterations> <Tolerance> {tolerance} </Tolerance>\n"
            f"{settings}{conditions}</Add_equation>\n")


def fluid_equations(kind):
    flow = SOLVER.format(kind="GMRES", tolerance=1e-4, most=20)
    basis = "<Use_taylor_hood_type_basis> true </Use_taylor_hood_type_basis>\n" if kind == "taylor-hood" else ""
    ends = condition("wall", STEADY.format(kind="Dir")) + condition("low", DRIVE) + condition("high", STEADY.format(kind="Neu"))
    return equation("fluid", basis + FLUID + MEANS.format(kind="Boundary_integral") + flow, ends, 1e-6, 6)


def elastic_equations():
    flow = SOLVER.format(kind="GMRES", tolerance=1e-4, most=20)
    domains = (f'<Domain id="0"> <Equation> fluid </Equation> {FLUID}</Domain>\n'
               f'<Domain id="1"> <Equation> struct </Equation> {SOLID}</Domain>\n')
    ends = (condition("pipe_low", DRIVE) + condition("pipe_high", STEADY.format(kind="Neu"))
            + condition("wall_low", STEADY.format(kind="Dir")) + condition("wall_high", STEADY.format(kind="Dir")))
    moves = "".join(condition(f"pipe_{end}", STEADY.format(kind="Dir")) for end in ("low", "high"))
    outputs = ('<Output type="Spatial"> <Displacement> true </Displacement> <Velocity> true </Velocity>'
               ' <Pressure> true </Pressure> </Output>\n'
               '<Output type="Alias"> <Displacement> FS_Displacement </Displacement> </Output>\n')
    poisson = ("<Poisson_ratio> 0.3 </Poisson_ratio>\n" + SOLVER.format(kind="CG", tolerance=1e-6, most=1000)
               + '<Output type="Spatial"> <Displacement> true </Displacement> </Output>\n')
    return (equation("FSI", domains + flow + outputs + MEANS.format(kind="B_INT"), ends, 1e-6, 4)
            + equation("mesh", poisson, moves, 1e-6, 4))


def write(kind, msh, folder, steps, pressure, period, *blocks):
    folder = pathlib.Path(folder)
    nodes, elements = uris_case.read_msh(pathlib.Path(msh))
    cells = [corners for _, corners in elements]
    if kind == "fsi":
        fluid = [cell for cell in cells if max(radius(nodes[n]) for n in cell) < RADIUS + 1e-6]
        solid = [cell for cell in cells if max(radius(nodes[n]) for n in cell) >= RADIUS + 1e-6]
        write_part(folder / "pipe", nodes, fluid, None, lambda places: end_of(places) or "side")
        write_part(folder / "wall", nodes, solid, None, lambda places: end_of(places) or (
            "inner" if max(map(radius, places)) < RADIUS + 1e-6 else "outer"))
        meshes = (mesh("pipe", "pipe", [(f"pipe_{face}", face) for face in ("side", "low", "high")], 0)
                  + mesh("wall", "wall", [(f"wall_{face}", face) for face in ("inner", "outer", "low", "high")], 1)
                  + '<Add_projection name="wall_inner"> <Project_from_face> pipe_side </Project_from_face> </Add_projection>\n')
        equations = elastic_equations()
    else:
        middles = add_middles(nodes, cells) if kind == "taylor-hood" else None
        write_part(folder / "tube", nodes, cells, middles, lambda places: end_of(places) or "wall")
        meshes = mesh("tube", "tube", [(face, face) for face in ("wall", "low", "high")])
        equations = fluid_equations(kind)
    valves = "".join(uris_case.valve_of(block) for block in blocks)
    # A flow that starts suddenly oscillates if the spectral radius is not 0. With 0, the solver's equations for solids give no
    # numbers.
    damping = 0.5 if kind == "fsi" else 0
    count = 65
    shares = [i / (count - 1) for i in range(count)]
    rows = [f"{share * float(period):.9g} {float(pressure) * math.cos(2 * math.pi * share):.9g}" for share in shares]
    (folder / "pressure.dat").write_text("\n".join([f"{count} 4", *rows]) + "\n", encoding="ascii")
    (folder / "solver.xml").write_text(f"""<?xml version="1.0" encoding="UTF-8" ?>
<svMultiPhysicsFile version="0.1">
<GeneralSimulationParameters>
  <Continue_previous_simulation> false </Continue_previous_simulation>
  <Number_of_spatial_dimensions> 3 </Number_of_spatial_dimensions>
  <Number_of_time_steps> {steps} </Number_of_time_steps>
  <Time_step_size> {TIME_STEP} </Time_step_size>
  <Spectral_radius_of_infinite_time_step> {damping} </Spectral_radius_of_infinite_time_step>
  <Save_results_to_VTK_format> false </Save_results_to_VTK_format>
  <Name_prefix_of_saved_VTK_files> result </Name_prefix_of_saved_VTK_files>
  <Start_saving_after_time_step> 1 </Start_saving_after_time_step>
  <Increment_in_saving_VTK_files> {steps} </Increment_in_saving_VTK_files>
  <Increment_in_saving_restart_files> {steps} </Increment_in_saving_restart_files>
</GeneralSimulationParameters>
{meshes}{valves}{equations}</svMultiPhysicsFile>
""", encoding="utf-8")


if __name__ == "__main__":
    words = sys.argv[1:]
    if len(words) == 3 and words[0] in ("tube", "elastic"):
        geometry(*words)
    elif len(words) == 2 and words[0] == "scaffold":
        scaffold(words[1])
    elif len(words) == 3 and words[0] == "scale":
        scale(*words[1:])
    elif len(words) >= 7 and words[0] in ("fluid", "taylor-hood", "fsi"):
        write(*words)
    else:
        sys.exit(__doc__)
