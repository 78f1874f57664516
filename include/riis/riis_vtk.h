/* SPDX-License-Identifier: Apache-2.0
 *
 * riis_vtk.h - an optional component that reads and writes meshes and surfaces in VTK files, and draws pictures. The component is
 * a separate library, riis_vtk, so that the core needs no VTK.
 *
 * The rules of riis.h also hold here, and riis_last_error() gives the messages. These rules are added:
 *
 * - VTK has global state, so call these functions from one thread at a time.
 * - Messages of VTK are not printed. They become part of the error's message.
 * - A file is refused if its format is not the expected one, if its end is missing, and if it declares more points, cells, values
 *   or bytes than it holds. VTK's own readers can still crash on a .vtu file with damaged bytes. Read files that you do not trust
 *   in a separate process.
 * - The message of RIIS_OUT_OF_MEMORY names the file that was read or written.
 * - If a path cannot be read or written, the status is RIIS_FILE_ERROR, and the message names the file.
 * - A file is written under a temporary name and then renamed, so an error leaves no incomplete file. The new file gets the
 *   permissions of the file that it replaces. If the path is a link, the file that the link points to is replaced, and the link
 *   stays.
 * - The caller's locale has no influence on files, and does not change.
 */
/* clang-format off: as riis.h */
#ifndef RIIS_RIIS_VTK_H
#define RIIS_RIIS_VTK_H

#include <riis/riis.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Volume meshes ------------------------------------------------------------------------------------- */

/* A mesh that was read from a file: an unstructured grid with points in double precision, or the axes of a rectilinear grid. */
typedef struct riis_vtk_mesh riis_vtk_mesh;

/* Reads a mesh, which may have no cells. Nodes and cells keep the order of the file. However, the nodes within a cell of second
 * order get the order of VTK. docs/formats.md lists the limits of each format.
 *   `path`: a file of VTK (.vtu, .vtk, .vti, .vtr, .vts or .vtm), gmsh (.msh), XDMF (.xdmf or .xmf) or Exodus (.e, .exo, .ex2 or
 *     .exii), or a .foam file. Nodes that blocks of a .vtm file share are joined. The path may also be a folder of OpenFOAM: a
 *     case, a time folder of a case, or a polyMesh.
 * HDF5 and VTK's reader of Exodus can crash on damaged files. If you do not trust an .xdmf or Exodus file, read the file in a
 * separate process, as the program riis does.
 * Errors: RIIS_FILE_ERROR if the file is missing, unreadable or truncated, has another format, or has no points. The message
 * names the file. */
RIIS_API riis_status riis_vtk_mesh_read(const char *path, riis_vtk_mesh **mesh);
/* Gives notes about the file in one line, such as "its points have single precision". The text is "" if there are no notes. The
 * text is valid until the mesh is destroyed. */
RIIS_API riis_status riis_vtk_mesh_get_notes(const riis_vtk_mesh *mesh, const char **notes);
/* Replaces the nodes of the mesh by the centres of its cells, in the order of the cells. Use this call for solvers with unknowns
 * at cell centres. The centres are computed as in OpenFOAM. After this call, two nodes are neighbours if their cells share a
 * face. Point arrays that are set later become cell arrays, and riis_vtk_mesh_extract refuses the mesh.
 * Errors: RIIS_INVALID_ARGUMENT if a cell is neither a linear volume cell nor a polyhedron; the message names the cell, and the
 * mesh keeps its nodes. */
RIIS_API riis_status riis_vtk_mesh_use_centers(riis_vtk_mesh *mesh);
/* Destroys the mesh. */
RIIS_API void riis_vtk_mesh_destroy(riis_vtk_mesh **mesh);

/* Gives the numbers of nodes and cells, and the coordinates of the nodes in the file's order as xyz(3, n_nodes). The array is
 * valid until the mesh is destroyed.
 *   `n_nodes`, `n_cells`, `xyz`: NULL if not wanted. */
RIIS_API riis_status riis_vtk_mesh_get_nodes(const riis_vtk_mesh *mesh, int64_t *n_nodes, int64_t *n_cells,
                                             const double **xyz);

/* Gives the axes of a mesh whose nodes form a rectilinear grid, for riis_mesh_create_grid. Such a mesh comes from a .vti or .vtr
 * file, or from a .vtk file with a rectilinear grid. It has two or more nodes along each axis, coordinates that strictly ascend,
 * and hexahedra as cells. To save memory, coordinates and cells are made only when a call needs them, such as
 * riis_vtk_mesh_get_nodes. Calls for arrays, such as riis_vtk_mesh_set_marks, do not need coordinates or cells.
 *   `grid`: its arrays x, y and z are valid until the mesh is destroyed. For a mesh without axes, ni, nj and nk are 0. A mesh
 *     also has no axes after riis_vtk_mesh_use_centers or riis_vtk_mesh_choose_cells. */
RIIS_API riis_status riis_vtk_mesh_get_axes(const riis_vtk_mesh *mesh, riis_grid *grid, int64_t struct_size);

/* Makes the adjacency of the mesh for riis_mesh_set_adjacency. Two nodes are neighbours if an edge of a volume cell joins them.
 * The adjacency borrows nothing from the mesh. Nodes without an edge get empty rows. RIIS_SEARCH_NEIGHBOR finds such nodes, but
 * RIIS_SEARCH_PAPER does not.
 * - Linear cells, prisms with more than three sides and polyhedra have the edges of their faces.
 * - In a quadratic cell, edges lead from each corner to the nodes in the middles of the adjacent sides. If a face has a node in
 *   its middle, edges join this node to all other nodes of the face. In other faces, edges join the middle nodes of neighbouring
 *   sides.
 * - A Lagrange or Bezier tetrahedron, wedge or hexahedron has edges along the lines of its lattice.
 * Two kinds of volume cells have no edges in the adjacency: convex point sets, and Lagrange and Bezier cells with nodes that are
 * not on their lattice. */
RIIS_API riis_status riis_vtk_mesh_create_adjacency(const riis_vtk_mesh *mesh, int32_t n_threads,
                                                    riis_adjacency **adjacency);
/* Counts the volume cells. Leaks cannot be found in a mesh without volume cells, such as a mesh of triangles.
 *   `n_volume_cells`: NULL if not wanted.
 *   `n_cells_left_out`: the number of volume cells without edges in the adjacency (riis_vtk_mesh_create_adjacency). NULL if not
 *     wanted. */
RIIS_API riis_status riis_vtk_mesh_get_volume_cells(const riis_vtk_mesh *mesh, int64_t *n_volume_cells,
                                                    int64_t *n_cells_left_out);

/* Copies the types of the cells and the ids of their nodes, in the order of the file. Call this function twice. The first call,
 * with NULL for node_ids, gives the offsets. The last offset is the number of node ids that the second call copies.
 *   `n_cells`: the number of cells, as riis_vtk_mesh_get_nodes gives it.
 *   `offsets` (n_cells + 1): cell i has the nodes node_ids[offsets[i]] to node_ids[offsets[i + 1] - 1]; NULL if not wanted.
 *   `types` (n_cells): VTK's numbers for the types of the cells, such as 10 for a tetrahedron; NULL if not wanted.
 *   `n_node_ids`: the length of node_ids, which is the last offset; 0 if node_ids is NULL.
 *   `node_ids` (n_node_ids): the ids of the cells' nodes, from 0, in VTK's order; NULL if not wanted. Each point of a polyhedron
 *     is listed once.
 * Errors: RIIS_INVALID_ARGUMENT for a wrong n_cells or n_node_ids, and for a mesh whose nodes are centres of cells. */
RIIS_API riis_status riis_vtk_mesh_copy_cells(const riis_vtk_mesh *mesh, int64_t n_cells, int64_t *offsets,
                                              uint8_t *types, int64_t n_node_ids, int64_t *node_ids);

/* Makes the part of the mesh's adjacency that riis_find_leaks needs, in one pass over the cells. An edge is in this part if it is
 * longer than a given length, and if its bounding box meets the bounding box of the surface. The adjacency borrows nothing from
 * the mesh. Use this part only for riis_find_leaks, because it has too few edges for a search.
 *   `longer_than`: the given length, such as 2 (1 - |o|) half thicknesses of the marking, where o is the offset. After a marking
 *     by RIIS_SEARCH_PAPER, sampling or minimisation, pass 0, which gives all edges near the surface. Edges that are at most a
 *     billionth shorter than longer_than are also included.
 *   `n_cells_left_out`: as in riis_vtk_mesh_get_volume_cells.
 * Errors: RIIS_INVALID_ARGUMENT if longer_than is below 0 or not finite. */
RIIS_API riis_status riis_vtk_mesh_create_long_edges(const riis_vtk_mesh *mesh, const riis_surface *surface,
                                                     double longer_than, int32_t n_threads,
                                                     int64_t *n_cells_left_out, riis_adjacency **adjacency);

/* Sets three point arrays of the mesh from a marking: PREFIX_marked (UInt8, 0 or 1), PREFIX_distance (Float64, far_distance
 * beyond the distance limit) and PREFIX_leaflet (Int32, -1 beyond the distance limit). Earlier arrays of these names are
 * replaced.
 *   `far_distance`: as in riis_dense_arrays.
 *   `prefix`: 1 to 64 letters, digits, "_", "-" and ".". NULL stands for "riis". riis_vtk_draw shows only marks that were set
 *     with the prefix "riis".
 * Errors: RIIS_INVALID_ARGUMENT if the marks and the mesh differ in the number of nodes. */
RIIS_API riis_status riis_vtk_mesh_set_marks(riis_vtk_mesh *mesh, const riis_marks *marks, double far_distance,
                                             const char *prefix);
/* Sets point arrays for the fields of a marking: PREFIX_point, PREFIX_normal, PREFIX_barycentric, PREFIX_uv, PREFIX_velocity
 * (Float64), PREFIX_side, PREFIX_rim, PREFIX_patch (Int32). Beyond the distance limit, PREFIX_patch is -1, and the other arrays
 * are 0.
 *   `fields`: a sum of RIIS_FIELD_*. The marking must have these fields.
 *   `prefix`: as in riis_vtk_mesh_set_marks.
 * Errors: as riis_vtk_mesh_set_marks. RIIS_INVALID_ARGUMENT also if the marks lack a field. */
RIIS_API riis_status riis_vtk_mesh_set_fields(riis_vtk_mesh *mesh, const riis_marks *marks,
                                              int32_t fields, const char *prefix);
/* Sets a point array to the caller's numbers, such as values of K. An earlier array of this name is replaced.
 *   `name`: 1 to 64 characters, with the characters of the prefix of riis_vtk_mesh_set_marks.
 *   `n_nodes`: the mesh's number of nodes.
 *   `n_components`: the number of components for each node, 1 to 9.
 *   `values` (n_components, n_nodes): the caller's numbers. */
RIIS_API riis_status riis_vtk_mesh_set_point_array(riis_vtk_mesh *mesh, const char *name, int64_t n_nodes,
                                                   int64_t n_components, const double *values);
/* Sets the unit of a point array. In .vtu and .pvtu files the unit is stored as VTK's key UNITS_LABEL, and in XDMF as the
 * attribute Unit.
 *   `name`: the name of an array.
 *   `unit`: 1 to 64 printable characters of ASCII, such as "g/(cm3 s)".
 * Errors: RIIS_INVALID_ARGUMENT if the mesh lacks the array, and if the unit has other characters. */
RIIS_API riis_status riis_vtk_mesh_set_unit(riis_vtk_mesh *mesh, const char *name, const char *unit);
/* Tells whether the mesh has a point array of the given name: *has becomes 1 if it has one, else 0. */
RIIS_API riis_status riis_vtk_mesh_has_point_array(const riis_vtk_mesh *mesh, const char *name, int32_t *has);
/* Gives the median length of the mesh's edges. The call measures the edges of volume cells, as in riis_vtk_mesh_create_adjacency,
 * and of faces except polygons. An edge counts once for each cell that has the edge. If a mesh has more than 20,000 cells, the
 * call measures only the edges of 20,000 cells, which are evenly spaced in the list of cells. The length is 0 if the mesh has no
 * edges. */
RIIS_API riis_status riis_vtk_mesh_get_median_edge(const riis_vtk_mesh *mesh, double *length);

/* Removes all cells except those with given values in a cell array, and all nodes except those of the remaining cells. For
 * example, the call can keep the fluid and remove the wall. Nodes and cells keep their order and their data. As in
 * riis_vtk_mesh_extract, the arrays riis_node_id and riis_cell_id give the ids in the whole mesh. If riis_vtk_mesh_extract later
 * makes a part of the mesh, these arrays of the part still give the ids in the whole mesh.
 *   `where`: NAME=VALUES, such as "region=1,2". NAME is a cell array with one number for each cell. For gmsh's physical groups,
 *     NAME is gmsh:physical, and VALUES may be names of groups. A cell in several groups has the values of all these groups.
 *   `n_chosen`: the number of cells that remain. If the mesh has volume cells, surface cells are not counted. If n_chosen is NULL
 *     and this number would be 0, the call fails.
 * Errors: RIIS_INVALID_ARGUMENT if the mesh lacks the array or a named group. After an error the mesh is unchanged. */
RIIS_API riis_status riis_vtk_mesh_choose_cells(riis_vtk_mesh *mesh, const char *where, int64_t *n_chosen);
/* Finds a cell array that probably numbers the regions of the mesh, such as fluid and wall. In such an array, the volume cells
 * have 2 to 16 different whole numbers. In at least one place, two cells of the same type that share a node have different
 * numbers. Arrays with names such as "rank" mean something else, and are left out.
 *   `array`: the name of the array, valid until the next call or the mesh's destruction. "" if no array was found.
 *   `n_values`: the number of different values; 0 if no array was found.
 *   `values` (n_values): the values, ascending. NULL: not wanted. */
RIIS_API riis_status riis_vtk_mesh_find_regions(riis_vtk_mesh *mesh, const char **array, int64_t *n_values,
                                                const double **values);

/* Tells which points lie outside the mesh, and are farther from all volume cells than a given distance. The edges of cells of
 * higher order count as straight. If a mesh has several pieces, call the function for each piece.
 *   `xyz` (3, n_points), finite.
 *   `distance`: the given distance, in the unit of xyz; finite and >= 0. With 0, the call finds the points that lie in no cell.
 *   `is_outside` (n_points): before the call, 1 for each point to test, and 0 for the others. For each point that is not outside,
 *     the call changes the 1 to 0.
 * Errors: RIIS_INVALID_ARGUMENT for a bad argument; the message names the argument and its value, and is_outside does not
 * change. */
RIIS_API riis_status riis_vtk_mesh_find_outside(const riis_vtk_mesh *mesh, int64_t n_points, const double *xyz,
                                                double distance, uint8_t *is_outside);

/* Makes a new mesh of all cells that have at least one of the given nodes, with all nodes of these cells. Nodes and cells keep
 * their order and their data. Two arrays of the new mesh give the ids in the whole mesh: the point array riis_node_id and the
 * cell array riis_cell_id (Int64). The new mesh borrows nothing.
 *   `n_ids`: the number of given nodes, >= 0.
 *   `node_ids` (n_ids): the ids of the given nodes, 0 to n_nodes - 1, in any order.
 * Errors: RIIS_INVALID_ARGUMENT for a bad id; the message names the id and its position in node_ids. */
RIIS_API riis_status riis_vtk_mesh_extract(const riis_vtk_mesh *mesh, int64_t n_ids, const int64_t *node_ids,
                                           riis_vtk_mesh **part);
/* Gives the size in bytes of the file that riis_vtk_mesh_write would write. The true size is larger by a few kilobytes of
 * text. */
RIIS_API riis_status riis_vtk_mesh_get_file_size(const riis_vtk_mesh *mesh, int64_t *n_bytes);

/* Writes the mesh with all its arrays to a file. The points are Float64.
 *   `path`: ends in .vtu or .xdmf. A mesh with axes (riis_vtk_mesh_get_axes) can also go to a .vtr file, or to a .vti file if its
 *     axes are evenly spaced. .vtr and .vti files store no cells. The numbers of NAME.xdmf are in NAME.h5 in the same folder, or
 *     in NAME.xdmf itself if riis was built without HDF5. An .xdmf file cannot hold polyhedra or text. If the nodes of the mesh
 *     are the cell centres of an OpenFOAM case, the path may also be a time folder of this case, such as CASE/0. The cell arrays
 *     then become fields in this folder, with the boundary condition zeroGradient at patches: riis_K becomes K, and
 *     riis_K_u_surface becomes Ku. After an error, some of these fields may already be written. */
RIIS_API riis_status riis_vtk_mesh_write(const riis_vtk_mesh *mesh, const char *path);

/* ---- Meshes in pieces ---------------------------------------------------------------------------------- */

/* A list of .vtu files that are pieces of one mesh, as in a .pvtu file. The pieces are read one by one, so a mesh may be larger
 * than the memory. */
typedef struct riis_vtk_pieces riis_vtk_pieces;
/* Reads a list of pieces from a file, but not the pieces themselves.
 *   `path`: ends in .pvtu. Names of pieces are absolute, or relative to the folder of the .pvtu file.
 * Errors: as riis_vtk_mesh_read. RIIS_FILE_ERROR also if the list is empty, and if a piece is missing, is listed twice or is not
 * a .vtu file. The message names the piece. */
RIIS_API riis_status riis_vtk_pieces_read(const char *path, riis_vtk_pieces **pieces);
/* Makes a list of pieces for riis_vtk_pieces_write. The list says that every piece has the same arrays as `mesh`. The list
 * borrows nothing.
 *   `n_files`: 1 to 1,000,000.
 *   `files` (n_files): the paths of the pieces. The files need not exist yet. */
RIIS_API riis_status riis_vtk_pieces_create(const riis_vtk_mesh *mesh, int64_t n_files, const char *const *files,
                                            riis_vtk_pieces **pieces);
/* Replaces the paths in the list, and keeps the names of the arrays.
 *   `n_files`, `files`: as in riis_vtk_pieces_create. */
RIIS_API riis_status riis_vtk_pieces_set_files(riis_vtk_pieces *pieces, int64_t n_files, const char *const *files);
/* Destroys the list. */
RIIS_API void riis_vtk_pieces_destroy(riis_vtk_pieces **pieces);
/* Gives the paths of the pieces.
 *   `paths` (n_files): the paths of the pieces, which include the folder of the .pvtu file. They are valid until the list is
 *     destroyed. */
RIIS_API riis_status riis_vtk_pieces_get_files(const riis_vtk_pieces *pieces, int64_t *n_files,
                                               const char *const **paths);
/* Reads a piece, which may have no points.
 *   `piece`: 0 to n_files - 1.
 * Errors: as riis_vtk_mesh_read. RIIS_FILE_ERROR also if the .pvtu file lists other point or cell arrays than the piece has. Only
 * the array vtkGhostType need not be listed in the .pvtu file. */
RIIS_API riis_status riis_vtk_pieces_read_mesh(const riis_vtk_pieces *pieces, int64_t piece, riis_vtk_mesh **mesh);
/* Writes the list to a file. Relative paths of pieces become relative to the file's folder. Absolute paths stay absolute.
 *   `path`: ends in .pvtu. */
RIIS_API riis_status riis_vtk_pieces_write(const riis_vtk_pieces *pieces, const char *path);

/* The roles of a node in a piece: whether other pieces of the mesh may also have the node. */
enum {
  RIIS_VTK_NODE_INSIDE = 0, /* no other piece has the node, except as a ghost */
  RIIS_VTK_NODE_SHARED = 1, /* other pieces may also have the node, because it is on a face that belongs to only one cell, or on
                               no volume cell */
  RIIS_VTK_NODE_GHOST = 2,  /* the node belongs only to ghost cells, which are copies of another piece's cells */
  RIIS_VTK_NODE_LOOSE = 3   /* the node belongs to no cell of the piece */
};
/* The numbers of cells in a piece, without ghost cells. A cell is a ghost if bit 1 is set in the cell's entry of the array
 * vtkGhostType. */
typedef struct riis_vtk_sharing {
  int64_t n_cells;          /* the number of cells that are not ghosts */
  int64_t n_volume_cells;   /* the number of volume cells that are not ghosts */
  int64_t n_cells_left_out; /* the number of these volume cells that have no edges in the adjacency, as in
                               riis_vtk_mesh_get_volume_cells */
  int32_t has_global_ids;   /* 1 if the nodes of the mesh have global ids, else 0 */
  int32_t reserved;         /* 0 */
} riis_vtk_sharing;
/* Tells which nodes of a piece may also be in other pieces, and gives the global ids of the nodes. The global ids are in the
 * point array with VTK's attribute GlobalIds. If no array has this attribute, they are in the array vtkGlobalIds, GlobalNodeId or
 * GlobalPointIds.
 *   `n_nodes`: the mesh's number of nodes.
 *   `role` (n_nodes): RIIS_VTK_NODE_* for each node.
 *   `global_id` (n_nodes): the global ids, written only if the mesh has them; NULL if not wanted.
 * Errors: RIIS_FILE_ERROR for global ids that are not whole numbers, and for a vtkGhostType that is not UInt8. */
RIIS_API riis_status riis_vtk_mesh_get_sharing(const riis_vtk_mesh *mesh, int64_t n_nodes, uint8_t *role,
                                               int64_t *global_id, riis_vtk_sharing *sharing, int64_t struct_size);

/* ---- Surfaces ------------------------------------------------------------------------------------------ */

/* A surface of triangles or quads that was read from a file. */
typedef struct riis_vtk_surface riis_vtk_surface;

/* Reads a surface. Polygons, strips and quadratic faces are cut into triangles. If the file has only quads, they stay quads.
 *   `path`: ends in .vtp, .vtk, .vtu (also with quadratic faces), .stl, .obj or .ply. All cells must be faces.
 *   `leaflets`: the name of the cell array with the leaflet ids, one whole number >= 0 for each cell. The file must have the
 *     named array. NULL stands for the array riis_leaflet, which the file may lack.
 * If the file has the point array riis_attached, with one number for each point, this array becomes riis_surface_arrays.attached.
 * If quads become triangles, each quad is cut from its first to its third corner. If this line runs outside a concave quad, the
 * cut leads from the second to the fourth corner.
 * Errors: RIIS_FILE_ERROR for a bad file; the message names the file, the bad cell and its value. If the array of leaflet ids is
 * missing, the message names the arrays that exist. */
RIIS_API riis_status riis_vtk_surface_read(const char *path, const char *leaflets, riis_vtk_surface **surface);
/* Makes a surface from the boundary of a mesh, such as the wall around the blood. Each face of the boundary belongs to only one
 * volume cell, and the face's normal points outwards. Faces of cells of higher order get straight edges. The surface borrows
 * nothing from the mesh. riis_vtk_surface_destroy destroys the surface.
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without volume cells. */
RIIS_API riis_status riis_vtk_mesh_get_boundary(const riis_vtk_mesh *mesh, riis_vtk_surface **boundary);
/* Turns every connected piece of the surface into a leaflet. The leaflets are numbered from 0 in the order of their first faces.
 * Faces are connected if they share a vertex, or if they have vertices with exactly the same coordinates, as in an .stl file.
 * Arrays from earlier calls become invalid. */
RIIS_API riis_status riis_vtk_surface_number_pieces(riis_vtk_surface *surface);
/* Adds the faces of the surface `other` to a surface, for a valve with one file for each leaflet. At the first call, the faces of
 * `surface` become leaflet 0. At each call, the faces of `other` become the next leaflet. The leaflet ids in the files are lost.
 * If only one of the two surfaces consists of quads, its quads are cut into triangles. `other` does not change. Arrays from
 * earlier calls become invalid. */
RIIS_API riis_status riis_vtk_surface_append(riis_vtk_surface *surface, const riis_vtk_surface *other);
/* Destroys the surface. Its arrays become invalid. A riis_surface that was made from these arrays stays. */
RIIS_API void riis_vtk_surface_destroy(riis_vtk_surface **surface);
/* Gives the vertices and faces of the surface in a struct for riis_surface_create_from_arrays. The arrays are valid until the
 * surface is destroyed. */
RIIS_API riis_status riis_vtk_surface_get_arrays(const riis_vtk_surface *surface, riis_surface_arrays *arrays,
                                                 int64_t struct_size);

/* Writes the triangles of a surface, after placement, to a file. These are exactly the triangles that answer queries. Points are
 * Float64. The cell arrays are riis_leaflet, riis_patch (Int32) and riis_triangle (Int64). For a valve, the file also has the
 * point array riis_uv (2 x Float64). If the last update gave velocities, the file has the point array riis_velocity (3 x
 * Float64). If the surface has an attachment, the point array riis_attached (UInt8) is 1 at its vertices and 0 elsewhere.
 *   `path`: ends in .vtp. */
RIIS_API riis_status riis_vtk_surface_write(const riis_surface *surface, const char *path);

/* ---- Motion -------------------------------------------------------------------------------------------- */

/* A motion: the frames of a moving surface, such as a patient's valve. The frames come from files that have the same faces at
 * several times. The caller makes keyframes from the frames, and may set a period and an interpolation:
 *
 *   riis_vtk_motion_read_pvd("valve.pvd", NULL, &motion);
 *   riis_vtk_motion_get_arrays(motion, &arrays, sizeof arrays);
 *   riis_vtk_motion_get_frames(motion, &frames, sizeof frames);
 *   frames.period = 0.8;
 *   riis_keyframes_create(&arrays, &frames, &keyframes);
 *   riis_vtk_motion_destroy(&motion);
 *
 * These rules hold for all functions that read a motion:
 * - The formats are those of riis_vtk_surface_read. There are at most 1,000,000 files. All files have the same points and cells
 *   in the same order. Polygons and quads are cut into triangles in the first file, and in all other files along the same lines.
 * - Leaflet ids and riis_attached come from the first file. `leaflets` names the cell array of leaflet ids, as in
 *   riis_vtk_surface_read.
 * - An .stl file has triangles without numbered vertices. The triangles must have the same order in all files. Corners at exactly
 *   the same position in the first file become one vertex, so these corners must also be at one position in every other file. If
 *   leaflets touch at corners in the first file and separate later, use .vtp files, which have numbered points.
 * - Times ascend strictly, and coordinates are finite, as in riis_keyframe_arrays.
 * Errors: RIIS_FILE_ERROR if a file does not fit the first file; the message names the file and the difference. */
typedef struct riis_vtk_motion riis_vtk_motion;

/* Reads a motion from a ParaView collection (.pvd). Each DataSet in it has a timestep and the path of a file, which is absolute
 * or relative to the folder of the .pvd file. Other attributes of a DataSet are ignored. Two DataSets with the same timestep,
 * such as two parts of a surface, are refused.
 * Errors: RIIS_FILE_ERROR for a bad DataSet, and if there is no DataSet. The message names the .pvd file and the DataSet. */
RIIS_API riis_status riis_vtk_motion_read_pvd(const char *path, const char *leaflets,
                                              riis_vtk_motion **motion);
/* Reads a motion from a list of files.
 *   `n_files`: 1 to 1,000,000.
 *   `paths` (n_files): the paths of the files, one file for each frame.
 *   `times` (n_files): the times of the frames.
 * Errors: RIIS_INVALID_ARGUMENT for a bad entry of paths or times; the message names the entry. */
RIIS_API riis_status riis_vtk_motion_read_files(int64_t n_files, const char *const *paths,
                                                const double *times, const char *leaflets,
                                                riis_vtk_motion **motion);
/* Reads a motion from one .vtp or .vtu file with displacements. For each frame, the displacements in one point array of 3
 * components are added to the points. The points without displacements are not a frame.
 *   `prefix`: the beginning of the names of these arrays. The prefix is followed by "_" or nothing, and then by a whole number,
 *     as in displacement_0 and displacement_10. Frames are in the order of these numbers, which may have gaps.
 *   `n_times`: the length of `times`, which is the number of displacement arrays; 0 if `times` is NULL.
 *   `times` (n_times): the times of the frames. NULL: the times are those of the file's field array TimeValue.
 * Errors: RIIS_INVALID_ARGUMENT if n_times is not the number of arrays, and for a bad entry of times. The message names the
 * entry. */
RIIS_API riis_status riis_vtk_motion_read_displacements(const char *path, const char *prefix, int64_t n_times,
                                                        const double *times, const char *leaflets,
                                                        riis_vtk_motion **motion);
/* Reads a motion from a file that `riis export` wrote for svMultiPhysics. The file has the positions of all nodes, frame by
 * frame. The faces are in a .vtu or .vtp file in the same folder. For NAME_motion_open.dat, the file of the faces is called
 * NAME_motion_open, NAME_motion or NAME, or one of these names with _mesh or _face appended, and then .vtu or .vtp.
 *   `path`: ends in .dat.
 *   `time_step`: the time from one frame to the next, above 0. The first frame is at time 0.
 * Errors: RIIS_INVALID_ARGUMENT for a bad time_step. */
RIIS_API riis_status riis_vtk_motion_read_frames(const char *path, double time_step, const char *leaflets,
                                                 riis_vtk_motion **motion);
/* Adds the faces of the motion `other`, which has the same times, to a motion. Each motion becomes one leaflet, as in
 * riis_vtk_surface_append. riis_vtk_motion_get_files then gives the files of both motions. `other` does not change.
 * Errors: RIIS_INVALID_ARGUMENT if the times differ; the message names the first frame whose time differs. */
RIIS_API riis_status riis_vtk_motion_append(riis_vtk_motion *motion, const riis_vtk_motion *other);
/* Gives the paths of the files from which a motion was read: one file for each frame, or the one file with displacements.
 *   `paths` (n_files): the paths, valid until the motion is destroyed. A relative path in a .pvd file is given with the folder of
 *     the .pvd file in front. */
RIIS_API riis_status riis_vtk_motion_get_files(const riis_vtk_motion *motion, int64_t *n_files,
                                               const char *const **paths);
/* Turns every connected piece of the first frame into a leaflet, as riis_vtk_surface_number_pieces does. */
RIIS_API riis_status riis_vtk_motion_number_pieces(riis_vtk_motion *motion);
/* Destroys the motion. Its arrays become invalid. Keyframes that were made from these arrays stay. */
RIIS_API void riis_vtk_motion_destroy(riis_vtk_motion **motion);
/* Gives the faces of all frames, and the vertices of the first frame, for riis_keyframes_create. The arrays are valid until the
 * motion is destroyed or riis_vtk_motion_number_pieces is called. */
RIIS_API riis_status riis_vtk_motion_get_arrays(const riis_vtk_motion *motion, riis_surface_arrays *arrays,
                                                int64_t struct_size);
/* Gives the frames, for riis_keyframes_create. The frames are valid until the motion is destroyed. */
RIIS_API riis_status riis_vtk_motion_get_frames(const riis_vtk_motion *motion, riis_keyframe_arrays *frames,
                                                int64_t struct_size);

/* ---- Pictures ------------------------------------------------------------------------------------------ */

/* The direction of view in a picture, along the axes of the mesh or of the valve. */
enum {
  RIIS_VTK_VIEW_SIDE = 0,          /* along +y, z up */
  RIIS_VTK_VIEW_TOP = 1,           /* along -z, y up */
  RIIS_VTK_VIEW_OBLIQUE = 2,       /* from above one side, z up */
  RIIS_VTK_VIEW_THREE = 3,         /* the three views above, side by side and at the same scale */
  RIIS_VTK_VIEW_VALVE_SIDE = 4,    /* as RIIS_VTK_VIEW_SIDE, but with the axes of the valve. These are the mesh's axes, turned by
                                      rotation_axis and rotation_angle of riis_vtk_picture_options */
  RIIS_VTK_VIEW_VALVE_TOP = 5,     /* as RIIS_VTK_VIEW_TOP, but with the axes of the valve */
  RIIS_VTK_VIEW_VALVE_OBLIQUE = 6, /* as RIIS_VTK_VIEW_OBLIQUE, but with the axes of the valve */
  RIIS_VTK_VIEW_VALVE_THREE = 7,   /* as RIIS_VTK_VIEW_THREE, but with the axes of the valve */
  RIIS_VTK_VIEW_VALVE_LONG = 8     /* as RIIS_VTK_VIEW_VALVE_SIDE, but turned about the valve's z axis by a multiple of 15
                                      degrees. The plane of the view then passes near the centres of two leaflets */
};

/* Which texts, axes and bars a picture shows. */
enum {
  RIIS_VTK_CAPTIONS_ALL = 0,   /* captions, the key of the colours, axes and a scale bar */
  RIIS_VTK_CAPTIONS_SCALE = 1, /* only the scale bar */
  RIIS_VTK_CAPTIONS_NONE = 2   /* no text, axes or bar */
};

/* Which panels a picture has. */
enum {
  RIIS_VTK_PANELS_BOTH = 0,  /* the surface, and if there is a mesh, also the marked cells */
  RIIS_VTK_PANELS_VALVE = 1, /* only the surface */
  RIIS_VTK_PANELS_MARKS = 2  /* only the marked cells. The picture must have a mesh */
};

/* The contents and the view of a picture. Texts are in ASCII; each character outside ASCII is drawn as "?". */
typedef struct riis_vtk_picture_options {
  int64_t struct_size;    /* set by the init function */
  const char *title;      /* the caption of the surface, which may have one line break. Default NULL: "Surface" */
  const char *unit;       /* the unit after the number at the scale bar, such as "mm". If the unit is "m" and the bar is shorter
                             than 0.1 m, the number is in mm. NULL, the default, and "" stand for "mesh units". Without a mesh and
                             a wall, they stand for "units" */
  int64_t n_leaflet_names;/* >= 0, default 0 */
  const char *const *leaflet_names; /* (n_leaflet_names): the names of the leaflets in the key of the colours, in the order of
                                       leaflet_id. A leaflet without a name is called "leaflet 0", "leaflet 1" and so on. Default
                                       NULL: no names */
  int64_t n_leaking_edges;/* >= 0, default 0 */
  const int64_t *leaking_edges; /* (2, n_leaking_edges): the node ids of leaking mesh edges, which are drawn in dark red in front
                                   of everything else. Default NULL: the picture shows nothing about leaks. With n_leaking_edges 0
                                   and any pointer other than NULL, the picture says that no edge leaks */
  int32_t view;           /* RIIS_VTK_VIEW_*. Default RIIS_VTK_VIEW_OBLIQUE */
  int32_t width, height;  /* pixels, 64 to 8192. Default 1600 x 800 */
  int32_t reserved;       /* 0 */
  double rotation_axis[3]; /* the rotation axis of the valve's placement, for RIIS_VTK_VIEW_VALVE_*. Its range is that in
                              riis_surface_options. Default (0, 0, 1) */
  double rotation_angle;  /* degrees. Default 0: the valve has the mesh's axes */
  const riis_surface *wall; /* the wall that is drawn around the surface. If there is a mesh, the mesh's boundary is drawn
                               instead. Default NULL: none */
  double background[4];   /* the background: red, green and blue, 0 to 1, then the opacity, 0 or 1. Texts are dark on a bright
                             background, and bright on a dark background. With the opacity 0 the background is transparent, but
                             its colour still decides whether texts are dark. Default (1, 1, 1, 1): white */
  int32_t captions;       /* RIIS_VTK_CAPTIONS_*. Default RIIS_VTK_CAPTIONS_ALL */
  int32_t panels;         /* RIIS_VTK_PANELS_*. Default RIIS_VTK_PANELS_BOTH */
  const char *velocity;   /* the name of the velocity: a point array or cell array of the mesh with three components. If the mesh
                             was read from a time folder of OpenFOAM, the velocity may also be a field in this folder, such as
                             "U". The panel of the marked cells then shows the speed in a plane through the middle of the surface,
                             at right angles to the direction of view. Default NULL: no velocity */
} riis_vtk_picture_options;
/* Fills *options with the defaults. */
RIIS_API riis_status riis_vtk_picture_options_init(riis_vtk_picture_options *options, int64_t struct_size);

/* Draws the surface and the marked cells of the mesh to a .png file, in two panels with the same scale.
 * - The left panel shows the surface with a colour for each leaflet. There are six colours; further leaflets repeat them. The key
 *   below the left panel names as many leaflets as fit, and dots stand for the others. A leaflet seen edge-on appears as a line.
 * - The right panel shows the cells with marked nodes. If all nodes of a cell are marked, the cell has the colour of the leaflet
 *   that is nearest to one of its nodes. If only some nodes of a cell are marked, only the far side of the cell is drawn, in a
 *   pale colour. If the mesh has volume cells, flat cells are not drawn.
 * - The wall is a translucent shell in both panels. Flat ends of the wall, such as an inlet, are not drawn. A wall that has only
 *   flat parts, such as a box, is drawn whole.
 * - The captions give the half thickness and the number of marked nodes.
 * - With a velocity, the right panel shows the speed in a plane through the centre of the surface's area, at right angles to the
 *   direction of view. Lines show the wall and the leaflets where the plane cuts them. The numbers at the bar of colours have the
 *   unit of the array. If the array has no unit, they have `unit` followed by "/s".
 * - Axes and a scale bar are below the panels. A mesh that is much longer than the surface is cut off at dashed lines, which
 *   captions explain. A picture with a height below 120 pixels has no texts, axes or scale bar.
 * - RIIS_VTK_VIEW_THREE and RIIS_VTK_VIEW_VALVE_THREE draw one column for each view, with one panel above the other. All columns
 *   have the same scale.
 *
 *   `mesh`: a mesh with marks (riis_vtk_mesh_set_marks). NULL: the surface is drawn alone, in one panel.
 *   `path`: ends in .png.
 * Errors: RIIS_UNAVAILABLE if no X display can be used; the call then returns after about half a second. Without a mesh,
 * RIIS_INVALID_ARGUMENT for leaking_edges, RIIS_VTK_PANELS_MARKS and a velocity. With a mesh, RIIS_INVALID_ARGUMENT if the mesh
 * lacks a node of leaking_edges or the array of the velocity. */
RIIS_API riis_status riis_vtk_draw(const riis_surface *surface, const riis_vtk_mesh *mesh,
                                   const riis_vtk_picture_options *options, const char *path);

/* Draws a picture for each of several views. A call for several views is faster than several calls of riis_vtk_draw, because it
 * makes the geometry and the window only once.
 *   `n_views`: >= 0.
 *   `views` (n_views): the views, RIIS_VTK_VIEW_*. The call ignores options->view.
 *   `paths` (n_views): the files. After an error, the finished pictures stay.
 * Errors: as riis_vtk_draw. */
RIIS_API riis_status riis_vtk_draw_views(const riis_surface *surface, const riis_vtk_mesh *mesh,
                                         const riis_vtk_picture_options *options, int64_t n_views,
                                         const int32_t *views, const char *const *paths);

/* A film: pictures of a moving valve in one mesh, all from the same camera, for example for a movie. */
typedef struct riis_vtk_film riis_vtk_film;
/* Makes a film, with the window and the outline of the mesh for all pictures.
 *   `mesh`: the mesh of all pictures. Its nodes and cells must stay the same, but the marks may change. NULL: the surface is
 *     drawn alone. The film shares the mesh's data, so the caller may destroy the mesh before the film.
 *   `lower`, `upper` (3): two opposite corners of a box along the mesh's axes that contains the surface at all times. The camera
 *     is set so that it shows this box.
 *   `options`: as in riis_vtk_draw, except that title and leaking edges are ignored, and a velocity is refused.
 * Errors: RIIS_UNAVAILABLE if no X display can be used; the call then returns after about half a second. RIIS_INVALID_ARGUMENT
 * for corners that are not finite, or if `lower` is not below `upper`. */
RIIS_API riis_status riis_vtk_film_create(const riis_vtk_mesh *mesh, const double *lower, const double *upper,
                                          const riis_vtk_picture_options *options, riis_vtk_film **film);
/* Draws one picture of a film, with the surface and the present marks of the mesh, to a .png file as riis_vtk_draw does.
 *   `title`: as in riis_vtk_picture_options.
 * Errors: as riis_vtk_draw. */
RIIS_API riis_status riis_vtk_film_draw(riis_vtk_film *film, const riis_surface *surface, const char *title,
                                        const char *path);
/* Destroys the film. The pictures stay. */
RIIS_API void riis_vtk_film_destroy(riis_vtk_film **film);

#ifdef __cplusplus
}
#endif

#endif
