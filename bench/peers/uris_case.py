# SPDX-License-Identifier: Apache-2.0
"""Writes a case of svMultiPhysics for ./run uris solver, and reads its drop.

    uris_case.py write DUCT.msh BLOCK.xml FOLDER TIME_STEP   # makes FOLDER; the working folder is that of `riis export`
    uris_case.py drop FOLDER AREA FORECAST                   # prints the drop over (R/eps) u; AREA is the area of the leaflets

duct_of_edge of uris.sh makes the duct. Blood enters at the top and flows down, so the valve stays closed. Units are CGS. The drop
is refused if it changed by more than a thousandth in the last step. A drop is also refused if it differs from the forecast by
more than 3 %.
"""
import collections
import pathlib
import re
import sys

FLOW = 2.0  # ml/s
STEPS = 14
# For each of gmsh's types of elements: its number of nodes, VTK's type, and the nodes of its faces.
ELEMENTS = {
    4: (4, 10, ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))),
    5: (8, 12, ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))),
}


def read_msh(path):
    """Returns the nodes, and the elements with their types."""
    lines = iter(path.read_text(encoding="ascii").splitlines())
    nodes, elements = {}, []
    for line in lines:
        if line == "$Nodes":
            for _ in range(int(next(lines))):
                number, *place = next(lines).split()
                nodes[int(number)] = [float(word) for word in place]
        elif line == "$Elements":
            for _ in range(int(next(lines))):
                words = [int(word) for word in next(lines).split()]
                if words[1] in ELEMENTS:
                    elements.append((words[1], words[3 + words[2]:]))
    if not elements:
        sys.exit(f"uris_case.py: {path} has no tetrahedra and no hexahedra")
    return nodes, elements


def array(kind, name, values, components=1):
    # The solver reads coordinates from text, so the text has all digits.
    text = " ".join(f"{value:.17g}" if kind == "Float64" else str(value) for value in values)
    return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">{text}</DataArray>\n'


def ends(cells):
    total, found = 0, []
    for cell in cells:
        total += len(cell)
        found.append(total)
    return found


def write_vtk(path, places, node_ids, cells, element_ids, cell_type=None):
    """Writes a mesh if a type of cells is given, otherwise a face. The ids belong to the whole mesh and count from 1."""
    kind, part = ("UnstructuredGrid", "Cells") if cell_type else ("PolyData", "Polys")
    count = "NumberOfCells" if cell_type else "NumberOfPolys"
    path.write_text(
        f'<?xml version="1.0"?>\n<VTKFile type="{kind}" version="0.1" byte_order="LittleEndian">\n<{kind}>\n'
        f'<Piece NumberOfPoints="{len(places)}" {count}="{len(cells)}">\n'
        f'<PointData>\n{array("Int32", "GlobalNodeID", node_ids)}</PointData>\n'
        f'<CellData>\n{array("Int32", "GlobalElementID", element_ids)}</CellData>\n'
        f'<Points>\n{array("Float64", "Points", (x for place in places for x in place), 3)}</Points>\n'
        f'<{part}>\n{array("Int64", "connectivity", (node for cell in cells for node in cell))}'
        f'{array("Int64", "offsets", ends(cells))}'
        + (array("UInt8", "types", [cell_type] * len(cells)) if cell_type else "")
        + f"</{part}>\n</Piece>\n</{kind}>\n</VTKFile>\n",
        encoding="ascii",
    )


def outer_faces(elements):
    """Returns the faces that belong to only one element. For each face, returns its nodes and the number of its element."""
    seen = collections.defaultdict(list)
    for number, (kind, corners) in enumerate(elements, 1):
        for face in ELEMENTS[kind][2]:
            corner = [corners[i] for i in face]
            seen[tuple(sorted(corner))].append((corner, number))
    return [found[0] for found in seen.values() if len(found) == 1]


def write_mesh(msh, folder):
    nodes, elements = read_msh(msh)
    numbers = {node: i for i, node in enumerate(sorted({corner for _, corners in elements for corner in corners}))}
    places = [nodes[node] for node in numbers]
    write_vtk(folder / "mesh.vtu", places, range(1, len(places) + 1), [[numbers[n] for n in corners] for _, corners in elements],
              range(1, len(elements) + 1), ELEMENTS[elements[0][0]][1])
    bottom, top = min(z for _, _, z in places), max(z for _, _, z in places)
    parts = {"inlet": [], "outlet": [], "wall": []}
    for corners, number in outer_faces(elements):
        heights = {round(nodes[n][2], 9) for n in corners}
        part = "inlet" if heights == {round(top, 9)} else "outlet" if heights == {round(bottom, 9)} else "wall"
        parts[part].append((corners, number))
    for name, faces in parts.items():
        used = {node: i for i, node in enumerate(sorted({n for corners, _ in faces for n in corners}))}
        write_vtk(folder / f"{name}.vtp", [nodes[n] for n in used], [numbers[n] + 1 for n in used],
                  [[used[n] for n in corners] for corners, _ in faces], [number for _, number in faces])


def valve_of(block):
    """Returns the valve of a block that `riis export` printed. The valve's paths become absolute, because the solver runs in
    another folder."""
    valve = re.search("<Add_URIS_mesh.*</Add_URIS_mesh>", pathlib.Path(block).read_text(encoding="utf-8"), re.S)
    if not valve:
        sys.exit(f"uris_case.py: {block} has no Add_URIS_mesh")
    paths = r"(<\w*[Ff]ile_path> *)([^ <]+)"
    return re.sub(paths, lambda found: found[1] + str(pathlib.Path(found[2]).resolve()), valve[0]) + "\n"


def write(msh, block, folder, time_step):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True)
    write_mesh(pathlib.Path(msh), folder)
    valve = valve_of(block)
    faces = "".join(f'<Add_face name="{name}"> <Face_file_path> {name}.vtp </Face_file_path> </Add_face>\n'
                    for name in ("wall", "inlet", "outlet"))
    (folder / "solver.xml").write_text(f"""<?xml version="1.0" encoding="UTF-8" ?>
<svMultiPhysicsFile version="0.1">
<GeneralSimulationParameters>
  <Continue_previous_simulation> false </Continue_previous_simulation>
  <Number_of_spatial_dimensions> 3 </Number_of_spatial_dimensions>
  <Number_of_time_steps> {STEPS} </Number_of_time_steps>
  <Time_step_size> {time_step} </Time_step_size>
  <Spectral_radius_of_infinite_time_step> 0 </Spectral_radius_of_infinite_time_step>
  <Save_results_to_VTK_format> false </Save_results_to_VTK_format>
  <Start_saving_after_time_step> {STEPS} </Start_saving_after_time_step>
  <Increment_in_saving_VTK_files> {STEPS} </Increment_in_saving_VTK_files>
  <Increment_in_saving_restart_files> {STEPS} </Increment_in_saving_restart_files>
</GeneralSimulationParameters>
<Add_mesh name="duct">
<Mesh_file_path> mesh.vtu </Mesh_file_path>
{faces}</Add_mesh>
{valve}<Add_equation type="fluid">
  <Coupled> true </Coupled>
  <Min_iterations> 2 </Min_iterations>
  <Max_iterations> 8 </Max_iterations>
  <Tolerance> 1e-7 </Tolerance>
  <Density> 1.06 </Density>
  <Viscosity model="Constant"> <Value> 0.04 </Value> </Viscosity>
  <Output type="Boundary_integral"> <Pressure> true </Pressure> <Velocity> true </Velocity> </Output>
  <LS type="GMRES">
    <Linear_algebra type="fsils"> <Preconditioner> fsils </Preconditioner> </Linear_algebra>
    <Tolerance> 1e-4 </Tolerance>
    <Krylov_space_dimension> 250 </Krylov_space_dimension>
    <Max_iterations> 20 </Max_iterations>
  </LS>
  <Add_BC name="wall"> <Type> Dir </Type> <Time_dependence> Steady </Time_dependence> <Value> 0 </Value> </Add_BC>
  <Add_BC name="inlet"> <Type> Dir </Type> <Time_dependence> Steady </Time_dependence> <Value> {-FLOW} </Value>
    <Profile> Flat </Profile> <Impose_flux> true </Impose_flux> </Add_BC>
  <Add_BC name="outlet"> <Type> Neu </Type> <Time_dependence> Steady </Time_dependence> <Value> 0 </Value> </Add_BC>
</Add_equation>
</svMultiPhysicsFile>
""", encoding="utf-8")


def last_rows(path):
    """Returns the values of the last two steps in a table of face averages. The values are listed by the names of the faces."""
    lines = [line.split() for line in path.read_text(encoding="ascii").splitlines() if line.strip() and line[0] != "#"]
    (names,) = [line[2:] for line in lines if line[:2] == ["step", "time"]]
    if int(lines[-1][0]) != STEPS:
        sys.exit(f"uris_case.py: {path} ends with step {lines[-1][0]}, and must end with {STEPS}")
    return [dict(zip(names, map(float, line[2:]))) for line in lines[-2:]]


def drop(folder, area, forecast):
    """Prints the drop divided by (R/eps) u. The drop is the difference of the mean pressures at both ends. The outlet's flow
    gives u."""
    folder = pathlib.Path(folder)
    case = (folder / "solver.xml").read_text(encoding="utf-8")
    resistance, half_thickness = (float(re.search(rf"<{name}>([^<]*)<", case)[1]) for name in ("Resistance", "Closed_thickness"))
    (results,) = folder.glob("*-procs")
    before, last = (
        (pressure["inlet"] - pressure["outlet"]) / (resistance / half_thickness * abs(flux["outlet"]) / float(area))
        for pressure, flux in zip(last_rows(results / "B_NS_Pressure_average.txt"), last_rows(results / "B_NS_Velocity_flux.txt"))
    )
    if not abs(last - before) <= 1e-3 * last:
        sys.exit(f"uris_case.py: {results} is not steady: the drop was {before:.4f}, and then {last:.4f}")
    if not abs(float(forecast) / last - 1) <= 0.03:
        sys.exit(f"uris_case.py: the forecast is {forecast}, and differs by more than 3 % from the drop in {results}, {last:.4f}")
    print(f"{last:.4f}")


if __name__ == "__main__":
    if len(sys.argv) == 6 and sys.argv[1] == "write":
        write(*sys.argv[2:])
    elif len(sys.argv) == 5 and sys.argv[1] == "drop":
        drop(*sys.argv[2:])
    else:
        sys.exit(__doc__)
