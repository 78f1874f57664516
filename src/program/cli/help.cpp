// SPDX-License-Identifier: Apache-2.0
#include "program/cli/command_line.hpp"

#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/valve_file.hpp"

namespace riis::program {
namespace {

struct Footer {
  const char *command, *text;
};

const Footer footers[] = {
    {"mark", R"(Examples:
  riis mark mesh.vtu --output marked.vtu --picture valve.png
  riis mark mesh.vtu --unit m --rotate 0,0,1,90 --set right.leaflet_angle=60 --stats -
  riis mark mesh.vtu --unit mm --surface valve.stl --surface-unit mm --leaflets connected --output marked.vtu
  riis mark mesh.vtu --params-closed closed.json --params-open open.json --opening 0.5 --output half_open.vtu
  riis mark mesh.vtu --surface patient.pvd --time 0.3 --period 0.8 --output marked.vtu
  riis mark mesh.vtu --valve mitral --cycle beat.csv --period 0.8 --times 0:0.8:0.01 --output beat.pvd --movie beat.mp4
  riis mark --case beating_valves.json --output beat.pvd --series-table beat.csv
riis help explains: mesh, units, parameters, opening, patches, series, cases, motion, warnings, leaks, searches,
distances, status.)"},
    {"surface", R"(Examples:
  riis surface --valve mitral --opening 0.5 --output half_open.vtp --picture half_open.png --view top
  riis surface --surface patient.pvd --time 0.3 --output moved.vtp
riis help explains: units, parameters, opening, patches, motion.)"},
    {"size-field", R"(Examples:
  riis size-field valve.dat --unit mm --valve trileaflet --translate 0,0,40
  riis size-field valve.dat --case beating_valves.json --largest-edge 0.4
riis help meshing explains the field.)"},
    {"states", R"(Examples:
  riis states states.csv --valve mitral
  riis states - --valve prosthesis.json --count 11
riis help states explains the table.)"},
    {"from-area", R"(Examples:
  riis from-area --area '2.5 cm2' --valve mitral
  riis from-area --area 1.1 --effective --solve annulus --valve trileaflet
  riis from-area --areas echo.csv --area-unit cm2 --period 0.8 --valve mitral --output beat.csv
riis help areas explains the search.)"},
    {"crossings", R"(Examples:
  riis check crossings --valve prosthesis.json
riis help crossings explains what counts.)"},
    {"leaks", R"(Examples:
  riis check leaks mesh.vtu --valve mitral --opening 0 --between 0,0,2 0,0,-2
  riis check leaks --case beating_valves.json
riis help leaks explains what counts.)"},
    {"check", R"(Examples:
  riis check crossings --valve prosthesis.json
  riis check leaks mesh.vtu --between 0,0,2 0,0,-2)"},
    {"export", R"(Examples:
  riis export mitral_valve --valve mitral --time-step 0.001 --opening-seconds 0.05 --closing-seconds 0.04 \
    --unit cm --resistance 1e4
  riis export valve mesh.vtu --unit mm --valve trileaflet --time-step 0.002 --opening-seconds 0.04 --closing-seconds 0.04 \
    --resistance 1e4
riis help export explains the files.)"},
    {"params", R"(Examples:
  riis params > valve.json
  riis params --describe --valve mitral
riis help parameters explains the names.)"},
    {"place", R"(Examples:
  riis place landmarks.json --valve trileaflet
  riis place root.mrk.json --valve aortic --mesh root.vtu --axes RAS --output placed.json
  riis mark root.vtu --valve placed.json --opening 0.3 --output marked.vtu
  riis place annulus.csv --valve mitral --flow 0,0,-1 --set anterior_length=2.4 --c lines.c
riis help landmarks explains the files and the report.)"},
    {"patient", R"(Examples:
  riis patient root.stl landmarks.mrk.json --output case
  riis patient root.stl landmarks.mrk.json --output case --solver openfoam
  riis patient ventricle.stl landmarks.json --valve mitral --output case --half-thickness '1.2 mm' --inlet 12,-40,85
riis help patient explains the steps. The program gmsh makes the mesh.)"},
    {"view", R"(Examples:
  riis view root.vtu
  riis view root.vtu --unit mm --folder results --no-browser
  riis view --wall root.stl --landmarks landmarks.mrk.json
  riis view root.vtu --valve placed.json --wall root.stl
  riis view --open valve.view.json
A page in the browser shows the mesh, the wall, the valve, and sliders for the valve's sizes. Landmarks that you pick on the
wall place the valve. Other options: --port N, and --cells-where NAME=VALUES as in riis mark. RIIS_PYTHON names the Python that
has the package riis. The default is python3.)"},
    {"help", R"(Examples:
  riis help units)"},
    {"riis", R"(Examples:
  riis mark mesh.vtu --output marked.vtu
  riis mark mesh.vtu --unit m --valve mitral --output marked.vtu
  riis params --describe --valve mitral
riis COMMAND --help lists the options of a command. riis help lists the topics that it explains.)"},
};

struct Topic {
  const char *name, *subject, *text;
};

// clang-format off
const Topic topics[] = {
    {"mesh", "the marked mesh and its arrays",
     R"(
The marked mesh is a copy of the input. Its nodes keep the input's order. It has the point arrays riis_marked (UInt8: 0 or
1), riis_distance (Float64) and riis_leaflet (Int32: -1 for none). --prefix NAME names them NAME_marked and so on, so a mesh
can have the marks of several valves. An array that the mesh already has is replaced only with --replace.
A .vti or .vtr is read as three axes, and --output may have the same ending. The nodes of such a grid are its points, and inside
the grid each node has six neighbours. Other structured grids, such as .vts files or turned images, become points and hexahedra.
--cells-where NAME=VALUES takes only the cells with these values of a cell array. For example, --cells-where region=1,2 may take
the fluid of a mesh that also has the wall. All other cells of the file are ignored, and are not written. The arrays
riis_node_id and riis_cell_id then have the ids in the whole mesh, counted from 0. The physical groups of gmsh are in the array
gmsh:physical, and VALUES may be names of groups. If the mesh has several domains that touch, and --cells-where chooses none, a
line on stderr says so.
)"},
    {"pieces", "meshes larger than memory, and MPI",
     R"(
A .pvtu file lists the pieces of a mesh, .vtu files. The pieces are read, marked and written one by one. Counts, leaks and
passages are those of the whole mesh. Nodes of two pieces are the same node if their global ids are equal (the point array with
VTK's attribute GlobalIds, vtkGlobalIds, GlobalNodeId or GlobalPointIds). Without global ids, nodes with equal coordinates are
the same node. Ghost cells (vtkGhostType 1) do not count. --output marked.pvtu writes the pieces to the folder marked.
A series reads each piece once. Pictures, movies, --cells, --steps and --search paper need the whole mesh.
A program that was built with RIIS_PROGRAM_MPI distributes the pieces among processes:
mpirun -n 8 riis mark mesh.pvtu --threads 1 --output marked.pvtu
)"},
    {"units", "units of lengths, and the scale",
     R"(
Lengths are in the mesh's unit. --unit names this unit, and the scale follows from the unit. The parameters of the kinds of
valves are in centimetres. If a file holds the surface or the patches, --unit needs --surface-unit, the unit of that file. With
--unit the default half thickness is the paper's, 0.1 cm. Without --unit the program knows no units, and --scale is the factor
from the surface's unit to the mesh's.
If --unit, a placed valve or a case names the unit of the mesh, --resistance is in kg/(m s), --density in kg/m3, --viscosity in
Pa s and --drop in Pa. A number may also have a unit: --resistance '1e5 g/(cm s)'. riis_K is then in kg/(m3 s) for m, g/(cm3 s)
for cm and g/(mm3 s) for mm, or in the unit of --k-unit. The file and the report name the unit of K. If the unit of the mesh is
not known, plain numbers and K are in the units of the mesh. OpenFOAM's fields of K are divided by --density.
)"},
    {"valves", "the kinds of valves, and their diseases",
     R"(
aortic           the paper's three cusps, which do not close
trileaflet       three equal cusps that close in straight lines
coapting         three cusps with a zone of coaptation
bicuspid         two such cusps; quadricuspid has four
mitral           the paper's two leaflets
mitral_coapting  two leaflets with a zone of coaptation
tricuspid        three leaflets with a zone of coaptation: anterior, septal, posterior
bileaflet        a mechanical prosthesis
FILE.json        a valve of your own (riis help patches)
Cusps and commissures have sizes of their own: cusp_0.sector, cusp_0.effective_height, commissure_0.height. Sectors are angles,
and are scaled to a sum of 360 degrees. commissure_0.fusion is the share of the meeting line over which two cusps are fused.
Cusps, leaflets and commissures count from 0, counter-clockwise seen from +z. Commissure 0 is between the leaflets 0 and 1.
A bump changes one place of a free edge. bump_0.leaflet and bump_0.u choose the place, or bump_0.commissure chooses a commissure.
u is 0 at the commissure before the leaflet, and 1 at the commissure after it. bump_0.closed is the opening of this place in the
closed valve, and bump_0.open is its opening in the open valve. Both are from 0 to 1. bump_0.width is the bump's reach as a
share of the edge. bump_0.lift lifts the closed place of a leaflet of mitral_coapting and tricuspid. A valve has six bumps,
bump_0 to bump_5. Kinds with sectors or with a zone of coaptation have bumps.
riis from-area --solve bump_0.closed finds the bump that makes a gap of a given area (riis help areas). The band closes gaps
that are narrower than two half thicknesses. With --offset O, it closes gaps narrower than 2 (1 - O) half thicknesses. A line on
stderr warns of such a gap.
)"},
    {"diseases", "diseased valves by the names of diagnoses",
     R"(
--valve takes these names in all commands, and in a case. Each name is a kind of valve with parameters, and riis params --valve
NAME prints them. --params and --set change these parameters, and riis place takes the sizes from landmarks.
riis params --valve NAME > sick.json makes a file for --params, with the kind in the second column.
The area in cm2 is the orifice of the open valve, or the gap that the closed valve leaves. Both areas are seen along the axis,
so they do not show the gap that a lifted leaflet makes. docs/diseases.md has the sources. riis from-area finds other areas
(riis help areas).
)"},
    {"parameters", "names and files of parameters",
     R"(
A name with a part (right.leaflet_angle, bump_0.open) is a parameter of that part. A name without a part (leaflet_angle) is a
parameter of the valve. If the valve has no such parameter, the name stands for the parameter of all parts. A JSON file sets the
names without a part first, whatever their order in the file is. A part may be an object:
{"cusp_0": {"sector": 140}, "bump_0": {"leaflet": 1}}. After the file, each --set changes a value, from left to right. --opening
comes last, and cannot be combined with --set opening.

annulus and stj are diameters, and effective_height is the height of the free edges above the annulus. These names set sizes of
valves with cusps. annulus also sets the size of a bileaflet valve. riis params --describe shows which parameters they set.

Some parameters follow from others unless they are set. riis params --describe prints these rules after "unless set", and one
line for parts that are alike. riis params prints the present values of all parameters. Bumps without a place do nothing, and
riis params prints only bump_0 of them.
A file with the output of riis params sets all parameters, so that none of them follows from others.
)"},
    {"opening", "closed and open states",
     R"(
The parameters of a kind of valve make it closed and open. By default the mitral valve has opening 1, and all other valves have
opening 0. With --params-open FILE, the other options give the closed state. The parameters of FILE and the defaults give the
open state. An opening in FILE has no effect. The paper's aortic valve, at opening 0 with the default parameters, is not closed.
Seen along the valve's axis, 19 % of a disc of radius 1.2 cm stay open. All other kinds close.
)"},
    {"skirt", "a strip that closes the gap to the wall",
     R"(
--skirt L gives a valve a strip of the length L, in the mesh's unit. The strip leads outwards from the attachment and closes the
gap to the wall. The parameter skirt_length is the same length in the valve's own unit. With --wall FILE, the skirt ends at the
wall in FILE, which is a surface in the mesh's coordinates and unit. FILE may also be a volume mesh, whose boundary is the wall.
L is then the largest length that is accepted. The program prints the gap. A wall is refused if the skirt misses it, or if it is
farther away than L at any opening.
With --surface FILE, the skirt leads from the points whose point array riis_attached is not 0. Without this array, it leads from
the closed line of open edges that encloses the largest area. In a case, "skirt" and "wall" are keys of a valve.
riis place --foam writes a skirt for OpenFOAM, which ends at the patch wall of the mesh. In riis place, --skirt is the largest
length of this skirt.
)"},
    {"warp", "a valve that meets a patient's landmarks",
     R"(
riis place LANDMARKS --warp exact writes a warp into the placed valve, and every command that takes this valve as --valve uses
it. With --warp smoothed the warp misses the landmarks by about their noise, so an error of a landmark bends the valve less.
Points of the attachment among the landmarks (riis help landmarks) make the valve fit between its commissures and nadirs. The
sizes and the placement do not depend on these points. A warp that folds is refused. A bileaflet valve is rigid and takes no
warp. With --foam, OpenFOAM's dictionary also has the warp.
In every command, --warp FILE warps the valve. FILE has landmarks on the valve and their places in the patient, in the mesh's
unit. FILE.json has the keys of "warp" in a case (riis help cases). FILE.csv has a line SX,SY,SZ,TX,TY,TZ for each landmark, and
perhaps lines # noise = 0.3 and # coordinates = valve.
)"},
    {"patches", "a file of curves for a valve of your own",
     R"(
--valve FILE.json is a valve that consists of patches. Curves bound each patch:
{"curves":  {"hinge": [[0,0,0], [1,0,0]], "edge": [[0,1,0], [0.5,1,0.3], [1,1,0]],
             "left": [[0,0,0], [0,1,0]], "right": [[1,1,0], [1,0,0]]},
 "patches": [{"v0": "hinge", "v1": "edge", "u0": "left", "u1": "-right", "leaflet": 0}]}
2, 3 or 4 points control a curve of degree 1, 2 or 3. One point stands for a side that collapses to a point. A minus reverses a
curve. v0 and v1 run from u0 to u1; u0 and u1 run from v0 to v1. The default of "leaflet" is 0. "open": {"curves": {...}} beside
"patches" holds all curves at --opening 1. Without these curves the valve stays at opening 0. The valve's parameters are opening
and skirt_length.
)"},
    {"landmarks", "files of riis place, and its report",
     R"(
{"valve": "aortic", "unit": "mm", "axes": "LPS",
 "landmarks": {"nadir_right": [1,2,3], "nadir_left": [...], "nadir_non_coronary": [...],
               "commissure_left_right": [...], "commissure_left_non": [...], "commissure_right_non": [...]}}
coapting    3 commissures and 3 nadirs, with names as above or as lists: "nadir": [[1,2,3], ...]; perhaps coaptation, and
            for a warp up to 900 points of the attachment, as attachment_1 or, with the cusp, attachment_left_1
trileaflet  the same
bicuspid    nadir_cusp_0, nadir_cusp_1, commissure_1 and commissure_2
quadricuspid  4 commissures and 4 nadirs, with names as in nadir_cusp_0 and commissure_cusp_0_cusp_1
aortic      the same as coapting; the names must say which cusp is which
mitral      "annulus": 4 points or more in their order around it, anterior_horn; perhaps posterior_horn, 2 trigone,
            posteromedial_commissure and anterolateral_commissure. 16 annulus points determine the sizes, 8 do not
mitral_coapting  the same without trigone; both commissures and the flow may stand for the anterior horn
tricuspid   "annulus": 4 points or more in their order around it; commissure_anterior_septal, commissure_posterior_septal and
            commissure_anterior_posterior
bileaflet   "annulus": 3 points or more of the housing's circle, 2 or 4 "hinge" ends, and the flow
Other keys: "flow": [x,y,z], or the points flow_from and flow_to; "noise"; "parameters", sizes in cm that are known.
In 3D Slicer, the labels of points are the names, as in annulus-1. A CSV has lines NAME,X,Y,Z, and must state # unit = mm and #
axes = LPS.
LPS and RAS differ by half a turn about z, which landmarks cannot show; "mesh" stands for the mesh's own axes. With --mesh,
landmarks that are far from the mesh are refused. The message says whether other axes or another unit would bring them to the
mesh.
Sizes from "proportion" have no landmark: they keep the proportions of --params or of the defaults. A size is NOT DETERMINED if
a change by its standard error moves the valve by more than a fifteenth of the valve's radius. The proportion then largely
determines the size.
Landmarks are those of the closed valve. The report's residuals are distances from landmarks to the valve.
)"},
    {"patient", "from a wall and landmarks to a mesh with a valve",
     R"(
riis patient WALL LANDMARKS --output FOLDER makes all files for a patient's valve: an aortic valve in its root, or a mitral
valve in a ventricle with the ends of the atrium and of the aorta. The command finds the sizes and the place of the valve, warps
it to the landmarks, adds a skirt to the wall, makes a mesh by gmsh, and marks the mesh. Each of these steps is a command. The
file commands.sh in FOLDER has them, and you can also run them one by one in FOLDER. The unit and the axes of WALL are those
with which the landmarks lie at the wall. If several units or axes fit, riis patient stops, and you must choose them by options.
The flat ends of the wall become the boundaries inlet, outlet, outlet_2 and so on, and the rest becomes wall. --inlet and
--outlet name ends by points near them.
The command stops, and says what to do, if WALL has a fault or is not within --skirt of the valve, if leaflets go through each
other, if an edge leaks at one of 11 openings, or if the closed valve does not seal. If an edge leaks, riis patient first makes
another mesh with shorter edges. FOLDER has the file UNFINISHED.txt until all steps are done. A diseased valve that never closes
need not seal.
--replace removes what riis patient wrote to FOLDER before, and also what a solver computed in the case there. A line on stdout
says so. While a solver runs there, nothing is removed.
--solver writes a case into FOLDER, and the last line on stdout is the command that runs the case.
)"},
    {"pictures", "views, sizes, backgrounds, captions",
     R"(
--picture draws the valve in its wall, and beside it the marked cells. The wall is the boundary of the mesh. riis surface has no
mesh, and takes the wall of --wall. Flat ends of the wall, such as an inlet, are left out. These options hold for all pictures and
for the movie of a run:
  --picture-size 3840x2160        width and height in pixels, 64 to 8192. Letters and lines grow with them
  --picture-background COLOUR     white, black, transparent (not for a movie), or six hexadecimal digits: red, green, blue
  --picture-captions scale|none   only the scale bar, or no text at all
  --picture-panels valve|marks    only one of the two panels
  --picture-velocity U            in place of the marked cells, the speed in a plane through the valve, with the wall and the
                                  leaflets cut by the plane. The velocity is an array of the mesh, or a field of a time of
                                  OpenFOAM: riis mark CASE/0.2 --valve placed.json ... --view valve-long
--view and --movie-view choose the direction of view. side, top, oblique and three use the mesh's axes, and valve-side and so on
use the valve's axes. valve-long is valve-side, turned about the valve's z until the plane cuts two leaflets. Captions give the
opening, the orifice in cm2, the half thickness in mm, the number of marked nodes, and leaking edges.
A picture needs no screen. If DISPLAY is not set or cannot be used, riis starts Xvfb, of Debian's package xvfb, for as long as
it draws. With an empty DISPLAY, riis always starts Xvfb: DISPLAY= riis mark ...
)"},
    {"series", "many times: .pvd, movies, tables",
     R"(
--times marks the nodes at each time, and --cycle names a file of openings. This file has a line for each key, with a time and
an opening from 0 to 1. Times ascend. The first line may name the columns. --output beat.pvd writes beat/beat_0000.vtu and so
on, and beat.pvd, which ParaView plays. --surface-output writes the triangles in the same way. With --triangulation fixed all
times have the same triangles, so changes of the triangles cause no jumps of K.
Each mesh has the point arrays of a marked mesh, and riis_normal, riis_side and riis_velocity of the closest point. With
--resistance, each mesh also has riis_K, and riis_K_u_surface, which is K times riis_velocity. Velocities are means over the
step from the previous time. At the first time, they are means over an earlier step of the length of the first step. A series of
one time has no velocities. Without --all-cells the meshes have only the cells near the valve's whole motion. The arrays
riis_node_id and riis_cell_id of these meshes have the ids of the input, counted from 0. All times have the same cells.
A line on stderr gives the size of all files before they are written. Ctrl-C ends a series after the present step. A line then
gives the number of steps written, and the .pvd lists these steps. If the process is killed, the list lacks at most one file. If
an earlier run of riis wrote further steps under the same name, the files of these steps are removed. If no list names such a
file, or only a list that riis did not write, the run is refused. --series-table has a line for each time: opening, marked
nodes, the largest speed of the surface, and the seconds for surface and marks. --picture draws the first time. --movie draws
all times with one camera, and needs the program ffmpeg. The check for leaks runs at the time when the valve is least open. With
--surface the check runs at the first time. The numbers of --stats belong to the time of this check, and "times" has the
openings, marks and speeds of all times. Orifices are measured at the largest opening.
)"},
    {"cases", "several valves in one mesh, from a file",
     R"(
--case FILE.json describes several valves, and takes the place of the options for surface, placement and marking:
{"mesh": "heart.vtu", "unit": "cm", "half_thickness": 0.1, "distance_limit": 0.2, "resistance": 1e4,
 "times": "0:0.8:0.01",
 "valves": [{"name": "mitral", "valve": "mitral", "opening": {"file": "beat.csv", "period": 0.8}},
            {"name": "aortic", "valve": "coapting",
             "rotate": [1,0,0,-30], "translate": [0,3.8,1], "opening": 0.3, "half_thickness": 0.08}]}
Paths are relative to the file. A MESH, --times, --distance-limit, --resistance and --between on the command line replace those
in the file. The "resistance" of a single valve in the file stays. riis check leaks, riis check crossings and riis size-field
also take a case.
A valve has the key "valve", whose value is a kind or a file of patches. Or it has the key "surface", whose value is a file, or
a list of files with one for each leaflet. Only the surface of a .pvd or a .dat moves. It may have a "period", and a .dat also a
"time_step". A valve may have "parameters" and "open_parameters", each an object or a file, and "scale", "surface_unit",
"rotate", "translate", "half_thickness", "offset", "resistance", "tolerance", "triangulation", "flip_normals", "leaflets",
"skip_zero_area", "skirt" and "wall", as the options of these names. A resistance is a number or a text such as '1e5 g/(cm s)'
(riis help units). "opening" is a number or one of
  {"file": "beat.csv", "period": 0.8, "interpolation": "cubic"}
  {"times": [0, 0.1, 0.4], "openings": [0, 1, 0], "period": 0.8, "interpolation": "linear"}
  {"opening_start": 0.4, "opening_duration": 0.05, "closing_start": 0.7, "closing_duration": 0.05, "closed": 0, "open": 1,
   "period": 0.8}
A "warp" takes landmarks on the valve to landmarks in the patient, exactly or smoothed by their noise:
  {"sources": [[1,0,0], [0,1,0], ...], "targets": [[1.1,0,0], [0,1.2,0], ...], "noise": 0.03, "coordinates": "mesh"}
With "times", and perhaps "period" and "interpolation", "targets" has an array of points for each time. The key "open" may have
the "sources" and "targets" of the open state. With "coordinates": "valve", landmarks are in the coordinates of the valve before
its placement.
"check_leaks": [x,y,z, x,y,z] has two points, as riis check leaks --between (riis help leaks). "cells_where": "region=1" chooses
cells of the mesh, as --cells-where.
If there are several valves, each valve has its own arrays, NAME_marked and so on. riis_K and riis_K_u_surface are sums over the
valves. Without times, --output names one mesh, such as marked.vtu. With --stats, "valves" has an object for each of several
valves, with the keys that a single valve has.
)"},
    {"motion", "a surface from a file that moves",
     R"(
--surface FILE.pvd is a ParaView collection of surface files, each with a time. All files have the same points and faces, and
only the points move. --surface FILE.dat has the frames that riis export writes for svMultiPhysics. The faces of these frames
are in a .vtu file in the same folder, and --time-step is the time between two frames. Several files are one valve, with a file
for each leaflet. --time T moves the surface to a time, linearly between two frames. --times moves the surface to each of
several times. --surface-output then has the velocities of the points, riis_velocity, in the mesh's unit over the unit of T.
Triangles in .stl files must have the same order in all files.
)"},
    {"warnings", "what warnings mean, and which comes first",
     R"(
A line on stderr names a suspicious result and the options to write instead. Such a warning is printed if no node, all nodes or
hardly any nodes are marked. It is also printed if the half thickness does not fit the surface or the edges of the mesh, or if
the valve does not fit its vessel. --quiet does not silence warnings, because wrong marks look like right ones. --allow-none is
for valves that are sometimes near no node.
A warning is also printed if more than 2 % of the leaflets' area is farther than the half thickness outside the mesh. Skirts and
the housing of a bileaflet valve do not count. A series is judged where each valve is least and most open.
One fault may cause other faults, so the warnings have an order: units, half thickness, places, leaks. Only the first warning in
this order has advice. Correct this fault and run the program again. A unit that you name by --unit or --scale counts as known,
if the sizes allow it. If the sizes allow two units, the advice names both. The next run says how many nodes each unit marks.
With --strict the status is 4 after a warning of any kind. Coordinates in warnings are in the unit of --unit. They have enough
digits to find an edge of the mesh.
)"},
    {"leaks", "edges and passages through the band",
     R"(
The surface leaks if an edge of the mesh crosses it between two unmarked nodes. A line on stderr and --stats give the number of
leaking edges, and the half thickness that closes them. Edges of at most two half thicknesses do not leak. With --offset O,
edges of at most 2 (1 - |O|) half thicknesses do not leak. Beside rims, edges of at most 2 sqrt(1 - O^2) half thicknesses seldom
leak. Leaks are unknown in a mesh without volume cells, if no node is marked, and at cells whose edges are not known. Leaking
edges do not show gaps between leaflets, and they do not show ways round the valve. riis check leaks MESH --between FROM TO
finds such passages. FROM and TO are points of the mesh on either side of the valve, each as X,Y,Z.
The program says whether unmarked nodes join the points. It also gives the place of the widest passage, and the half thickness
that closes it. The distance of the points from the valve must be larger than the width of the passage. A case has the points as
"check_leaks": [x,y,z, x,y,z]. The check uses all valves of the case together, each at its least opening. For each valve the
table has the number of mesh edges across its band, and the orifice at its largest opening.
riis check leaks also prints how many mesh edges lie across the band, and the orifice with its effective area. With
--first-passage it tries openings and prints the first at which unmarked nodes join the points. With --resistance and --drop it
prints the flow through an ideal closed valve. A leak does not change the exit status, because the valve may be open. With
--demand-sealed the status is 4 if the points are joined, or if this is unknown. Without points, the status is 4 if an edge
leaks, or if leaks are unknown.
)"},
    {"crossings", "leaflets that go through each other",
     R"(
riis check crossings checks a valve's triangles at 101 openings from 0 to 1. The check ends with status 4 at the first opening
at which two triangles go through each other. A line on stderr gives this opening, the number of pairs, the length of their
intersections, and the depth and place of the deepest pair. The depth is the distance by which one triangle must move so that
the two triangles only touch. Pairs with a depth up to 1e-6 half thicknesses count as touching. A valve that does not open, a
surface from a file and a valve with --opening are checked in one state only. With --case each valve of a case is checked. The
command needs no MESH. riis mark checks only openings 0, 0.5 and 1, and only a valve whose shape is set by --set, --params,
--params-open or a file. This check ignores contacts between leaflets, and contacts between a housing and its hinges.
)"},
    {"states", "what the table of riis states has",
     R"(
riis states measures the valve in its own coordinates at 101 openings, or at the number of --count. It needs no MESH. The table
has a line for each opening. A line has the length of each free edge and the area of each leaflet, also as shares of their
closed values, and the area of the orifice. The summary on stdout names the free edges whose length differs by more than 10 %
from the closed length. Free edges are the sides v = 1 of the patches on a leaflet's rim. The orifice is the part of an outline
that the leaflets leave uncovered, seen along the outline's axis. effective_area is the part of the orifice that the band around
the leaflets leaves to the flow. It is computed from the half thickness, for a round rim. The outline is the leaflets' farthest
edges in all directions, such as the annulus. Straight lines join leaflets that do not touch. The outline of a bileaflet valve
is a disc with the housing's radius. If the leaflets of --surface do not reach the wall, --wall FILE, a ring or a straight tube,
gives the outline. The table has no columns for measures that a valve lacks. The default tolerance is 0.01. A valve without an
open state has one line, at opening 0.
)"},
    {"areas", "how riis from-area finds an opening or a size",
     R"(
riis from-area finds the opening at which the orifice has an area, such as an area from echocardiography. Areas are measured as
in riis states. With --effective they are effective areas, as in the column effective_area of riis states. A plain number is in
the mesh's unit squared; '2.5 cm2' has a unit. --solve scale finds the factor for --scale, and --solve NAME finds a parameter
that is one number, such as cusp_0.open_radius_ratio, commissure_0.fusion or bump_0.open. If a size is searched, the valve is
open, unless --opening gives another opening. With --opening 0 the area is the gap of the closed valve, which bump_0.closed
changes. The area is first measured at 33 openings or sizes, from --from to --to: by default from 0 to 1 for the opening, a
tenth to ten times the present scale, and half to twice a parameter. If a parameter that is a share is 0 at present, its whole
range is searched. If no value gives the area, the area is refused, and the message has the range of areas. If the area grows in
one part of the range and falls in another, a line on stderr says where it turns. Of several solutions, the least opening is
taken, or the size nearest to the present size.
--areas FILE has the columns time and area. --output writes a file of openings for --cycle, with the columns time and opening.
The area 0 stands for the closed valve. With --period the first and the last area must be equal if they are a period apart.
Adapted triangles are the default, and with them the area jumps by up to 1e-4 of the largest area. --triangulation fixed has no
jumps.
)"},
    {"export", "what riis export writes",
     R"(
riis export FOLDER writes the files that the solver's Add_URIS_mesh reads: for each leaflet NAME.vtu, NAME_open.dat and
NAME_close.dat. A face "box" has the same three files, which widen the box in which the solver looks for nodes. normal.dat is
the direction of flow. The folder must be new or empty. The block for the solver's input goes to stdout, and needs --resistance.
The solver plays a frame in each of its time steps, so --time-step must be the solver's step. The valve opens from 0 to 1 in
--opening-seconds by a ramp of fifth degree, and closes in --closing-seconds. With --cycle the valve opens from the last key of
its least opening to the next key of its largest opening. It closes from the last key of its largest opening to the next key of
its least opening. --opening-span and --closing-span set other times. The solver measures distances to the middles of triangles.
With a --largest-edge of 0.15 half thicknesses its sum of K is within 1 % of the exact sum. Triangles without area in some frame
are left out, and a line on stderr says so. The files are in cm and R is in g/(cm s): lengths of --unit m or mm are converted.
Without --unit, lengths and R are not converted. The valve's name in the solver is the name of the folder, or --name. The solver
starts with the closed valve, or with the state of --cycle at time 0. --starts chooses another state. The ring of a bileaflet
valve is a face beside the leaflets, so that no point has the K of both the ring and a leaflet. --ring none leaves the ring out.

riis export FOLDER MESH also computes what the solver will do in MESH, by the solver's own rules: its box, its distances, their
interpolation to Gauss points, and the bands in which it takes pressures. The comment in the block has the expected drop of the
closed valve divided by (R/eps) u, and the numbers of nodes before and behind the valve. If the drop is below 0.9, a line on
stderr names the half thickness that the mesh needs. FOLDER/forecast.csv has the numbers of each frame. A valve that the solver
could never open or never close is refused. The drop depends a little on --density and --viscosity. A Python with NumPy and
SciPy computes the drop: python3, or the Python that RIIS_PYTHON names. Without these packages only the drop is missing, and a
line on stderr says so.
)"},
    {"meshing", "the edge lengths of riis size-field",
     R"(
A mesh whose edges are at most two half thicknesses long does not leak. With --offset O it seldom leaks if edges beside rims are
at most 2 sqrt(1 - O^2) half thicknesses long (riis help leaks). riis size-field writes edge lengths that are small near the
valve only: --band-edge half thicknesses in the band of every state of the valve, and larger outside it. With --offset O the
lengths beside rims are shorter by the factor sqrt(1 - O^2). The states are openings from 0 to 1, whose number is --count, or
the times of --times or of a case. The file is a grid, which gmsh's field "Structured" reads with TextFormat = 1. The lines for
the .geo file go to stdout. gmsh makes some edges longer than the grid requires, so --band-edge should stay below 1. The lengths
of gmsh's default algorithm in space, Delaunay, are closer to the grid than those of HXT. The number of nodes grows with the
cube of 1 / --band-edge. For riis size-field, a case needs no mesh. Check the mesh by riis check leaks, or by riis mark at
several openings.
)"},
    {"searches", "how nodes are found",
     R"(
exhaustive  queries the distance of every node near the valve
neighbor    walks from marked nodes to their neighbours and then queries all other nodes that may be near
clusters    handles nearby nodes together
paper       the published search, for comparison: from one start, through marked nodes only
exhaustive, neighbor and clusters give the same marks. neighbor needs the mesh's adjacency, which lists the neighbours; clusters
needs sorted nodes. For a single marking, each of these preparations costs more time than it saves, so auto is exhaustive.
paper misses nodes that are not connected to its start, so it is never complete, and a line on stderr says so. Neighbours are
nodes joined by an edge of a volume cell.
)"},
    {"distances", "how distances are measured",
     R"(
--distance sampling measures to the nearest of many points on the valve's patches. --distance-tolerance sets the number of
points. --distance minimization applies Powell's method to every patch, and this may miss the closest point. Both methods come
from the paper. They are slow, and serve only for comparison.
)"},
    {"running", "progress, Ctrl-C, locks",
     R"(
On a terminal, a line on stderr announces a stage that takes longer than a second, and counts the steps of a series. If stderr
is a file or a pipe, such a line comes after half a minute, and steps are counted each half minute. --quiet silences both kinds
of lines.
While a file is written, the first Ctrl-C waits until the file is complete; the second does not wait.
During a run, an empty file .riis-NAME.lock beside each output NAME keeps other runs from writing that output. A run that is
killed leaves the lock behind, and the next run takes it over.
)"},
    {"status", "exit statuses",
     R"(
0  fine
1  bad data: a file that cannot be read or written, or has bad content; a valve's kind; a parameter's name or value (in a
   file or by --set); an output that another run is writing; no display and no Xvfb for a picture, no ffmpeg for a movie,
   no memory
2  wrong usage: an option that is unknown, malformed, out of range, without effect, or at odds with another; an output
   that would replace an input, another output, or arrays of the mesh
3  no node is marked at any time, without --allow-none; the outputs are written all the same
4  riis check crossings found a crossing; riis check leaks --demand-sealed found a leak, or cannot tell; with --strict, a
   warning that none of the above covers; the outputs are written all the same
)"},
};
// clang-format on

std::string list_of_topics() {
  std::string text = "riis help TOPIC explains one of these:\n";
  for (const Topic &topic : topics) {
    const std::string name = topic.name;
    text += "  " + name + std::string(12 - name.size(), ' ') + topic.subject + "\n";
  }
  return text;
}

}  // namespace

const char *const description =
    "Marks the mesh nodes whose distance to the surface of a heart valve is at most the half thickness.";

std::string help_of(const std::string &command) {
  for (const Footer &footer : footers)
    if (command == footer.command) return footer.text;
  return "";
}

std::string text_of_topic(const std::string &name) {
  if (name.empty()) return list_of_topics();
  std::vector<std::string> names;
  for (const Topic &topic : topics) {
    // The text begins with a line break.
    if (name == topic.name) return topic.text + 1 + (name == "diseases" ? table_of_diseases() : "");
    names.emplace_back(topic.name);
  }
  refuse_usage("'" + name.substr(0, 64) + "' is not a topic" + did_you_mean(name, names) +
               " (riis help lists the topics)");
}

std::string short_help() {
  return R"(riis marks the nodes of a mesh that lie near a heart valve.
  riis mark MESH.vtu --output MARKED.vtu                     the aortic valve, in a mesh in centimetres
  riis mark MESH.vtu --unit m --valve mitral --output MARKED.vtu            the mitral valve, in metres
  riis mark MESH.vtu --unit mm --surface VALVE.stl --surface-unit mm --output MARKED.vtu
riis --help lists the commands, riis params --describe the parameters of the valve.
)";
}

}  // namespace riis::program
