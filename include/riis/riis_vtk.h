/* SPDX-License-Identifier: Apache-2.0
 *
 * riis_vtk.h - optional component: reads and writes meshes and surfaces in VTK files, and draws pictures. The component is a
 * separate library, riis_vtk, so that the core needs no VTK.
 *
 * The rules of riis.h also hold here, and riis_last_error() gives the messages. These rules come in addition:
 *
 * - VTK has global state, so call these functions from one thread at a time.
 * - Messages of VTK are not printed, but become part of the message of the error.
 * - A file is refused if it has another format, if its end is missing, and if it declares more points, cells, values or bytes
 *   than it holds. VTK's own readers can still crash on a .vtu file with damaged bytes. Read files that you do not trust in a
 *   separate process.
 * - The message of RIIS_OUT_OF_MEMORY names the file that was read or written.
 * - If a path cannot be read or written, the status is RIIS_FILE_ERROR, and the message names the file.
 * - A file is written under a temporary name and then renamed, so an error leaves no incomplete file. The new file gets the
 *   permissions of the file that it replaces. If the path is a link, the target of the link is replaced, and the link stays.
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

/* A mesh as it was read from a file: an unstructured grid with points in double precision, or the axes of a rectilinear grid. */
typedef struct riis_vtk_mesh riis_vtk_mesh;

/* Reads a mesh, which may have no cells. Nodes and cells keep the order of the file, but the nodes within a cell of second order
 * get the order of VTK. docs/formats.md lists the limits of each format.
 *   `path`: a file of VTK (.vtu, .vtk, .vti, .vtr, .vts or .vtm), gmsh (.msh), XDMF (.xdmf or .xmf) or Exodus (.e, .exo, .ex2 or
 *     .exii), or a .foam file. Nodes that blocks of a .vtm file share are joined. The path may also be a folder of OpenFOAM: a
 *     case, a time folder of a case, or a polyMesh.
 * HDF5 and VTK's reader of Exodus can crash on damaged files. If you do not trust an .xdmf or Exodus file, read it in a separate
 * process. The program riis does so.
 * Errors: RIIS_FILE_ERROR if the file is missing, unreadable or truncated, has another format, or has no points. The message
 * names the file. */
RIIS_API riis_status riis_vtk_mesh_read(const char *path, riis_vtk_mesh **mesh);
/* Gives notes about the file in one line, such as "its points have single precision", or "" if there are none. The text is valid
 * until the mesh is destroyed. */
RIIS_API riis_status riis_vtk_mesh_get_notes(const riis_vtk_mesh *mesh, const char **notes);
/* Replaces the nodes of the mesh by the centres of its cells, in the order of the cells. Use this call for solvers with unknowns
 * at cell centres. The centres are computed as in OpenFOAM. Two nodes are then neighbours if their cells share a face. Point
 * arrays that are set later become cell arrays. riis_vtk_mesh_extract then refuses the mesh.
 * Errors: RIIS_INVALID_ARGUMENT if a cell is neither a linear volume cell nor a polyhedron; the message names the cell, and the
 * mesh keeps its nodes. */
RIIS_API riis_status riis_vtk_mesh_use_centers(riis_vtk_mesh *mesh);
/* Destroys the mesh. */
RIIS_API void riis_vtk_mesh_destroy(riis_vtk_mesh **mesh);

/* Gives the coordinates of the nodes in the file's order, xyz(3, n_nodes), and the numbers of nodes and cells. The array is valid
 * until the mesh is destroyed.
 *   `n_nodes`, `n_cells`, `xyz`: NULL if not wanted. */
RIIS_API riis_status riis_vtk_mesh_get_nodes(const riis_vtk_mesh *mesh, int64_t *n_nodes, int64_t *n_cells,
                                             const double **xyz);

/* Gives the axes of a mesh whose nodes are a rectilinear grid, for riis_mesh_create_grid. Such a mesh comes from a .vti or .vtr
 * file, or from a legacy file with such a grid. It has two or more nodes along each axis, coordinates that strictly ascend, and
 * hexahedra as cells. To save memory, coordinates and cells are stored only after a call that needs them, such as
 * riis_vtk_mesh_get_nodes. Calls for arrays, such as riis_vtk_mesh_set_marks, do not need them.
 *   `grid`: its arrays x, y and z are valid until the mesh is destroyed. For a mesh without axes, ni, nj and nk are 0. A mesh
 *     also has no axes after riis_vtk_mesh_use_centers or riis_vtk_mesh_choose_cells. */
RIIS_API riis_status riis_vtk_mesh_get_axes(const riis_vtk_mesh *mesh, riis_grid *grid, int64_t struct_size);

/* Makes the adjacency of the mesh for riis_mesh_set_adjacency. Two nodes are neighbours if an edge of a volume cell joins them.
 * The adjacency borrows nothing from the mesh. Nodes without an edge get empty rows. RIIS_SEARCH_NEIGHBOR finds such nodes, but
 * RIIS_SEARCH_PAPER does not.
 * - Linear cells, prisms with more than three sides and polyhedra have the edges of their faces.
 * - A quadratic cell has edges from each corner to the middles of the adjacent sides. In a face with a node in its middle, edges
 *   join this node to all other nodes of the face. In other faces, edges join the middles of neighbouring sides.
 * - A Lagrange or Bezier tetrahedron, wedge or hexahedron has edges along the lines of its lattice.
 * Two kinds of volume cells have no edges in the adjacency: convex point sets, and Lagrange and Bezier cells with nodes beyond
 * their lattice. */
RIIS_API riis_status riis_vtk_mesh_create_adjacency(const riis_vtk_mesh *mesh, int32_t n_threads,
                                                    riis_adjacency **adjacency);
/* Counts the volume cells. Leaks cannot be found in a mesh without volume cells, such as a mesh of triangles.
 *   `n_volume_cells`: NULL if not wanted.
 *   `n_cells_left_out`: the number of volume cells without edges in the adjacency (riis_vtk_mesh_create_adjacency). NULL if not
 *     wanted. */
RIIS_API riis_status riis_vtk_mesh_get_volume_cells(const riis_vtk_mesh *mesh, int64_t *n_volume_cells,
                                                    int64_t *n_cells_left_out);

/* Copies the cells in the order of the file. Call this function twice. The first call, with NULL for node_ids, gives the offsets.
 * The last offset is the number of node ids that the second call copies.
 *   `n_cells`: the number of cells, as riis_vtk_mesh_get_nodes gives it.
 *   `offsets` (n_cells + 1): cell i has the nodes node_ids[offsets[i]] to node_ids[offsets[i + 1] - 1]; NULL if not wanted.
 *   `types` (n_cells): VTK's numbers for the types of the cells, such as 10 for a tetrahedron; NULL if not wanted.
 *   `n_node_ids`: the last offset, or 0 if node_ids is NULL.
 *   `node_ids` (n_node_ids): the ids of the cells' nodes, from 0, in VTK's order; NULL if not wanted. Each point of a polyhedron
 *     is listed once.
 * Errors: RIIS_INVALID_ARGUMENT for a wrong n_cells or n_node_ids, and for a mesh whose nodes are centres of cells. */
RIIS_API riis_status riis_vtk_mesh_copy_cells(const riis_vtk_mesh *mesh, int64_t n_cells, int64_t *offsets,
                                              uint8_t *types, int64_t n_node_ids, int64_t *node_ids);

/* Makes the part of the mesh's adjacency that riis_find_leaks needs, in one pass over the cells. This part has the edges that are
 * longer than a given length, if their bounding box meets the bounding box of the surface. The adjacency borrows nothing from the
 * mesh. Use this part only for riis_find_leaks, because it has too few edges for a search.
 *   `longer_than`: the length, such as 2 (1 - |o|) half thicknesses of the marking, where o is the offset. After a marking by
 *     RIIS_SEARCH_PAPER, sampling or minimisation, pass 0, which gives all edges near the surface. Edges that are shorter than
 *     longer_than by at most a billionth are also included.
 *   `n_cells_left_out`: as in riis_vtk_mesh_get_volume_cells.
 * Errors: RIIS_INVALID_ARGUMENT if longer_than is below 0 or not finite. */
RIIS_API riis_status riis_vtk_mesh_create_long_edges(const riis_vtk_mesh *mesh, const riis_surface *surface,
                                                     double longer_than, int32_t n_threads,
                                                     int64_t *n_cells_left_out, riis_adjacency **adjacency);

/* Sets three point arrays from a marking: PREFIX_marked (UInt8, 0 or 1), PREFIX_distance (Float64, far_distance beyond the
 * distance limit) and PREFIX_leaflet (Int32, -1 beyond the distance limit). Arrays of the same names are replaced.
 *   `far_distance`: as in riis_dense_arrays.
 *   `prefix`: 1 to 64 letters, digits, "_", "-" and ".". NULL stands for "riis". riis_vtk_draw shows the marks with the prefix
 *     "riis".
 * Errors: RIIS_INVALID_ARGUMENT if the marks have another number of nodes than the mesh. */
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
/* Sets a point array to the caller's numbers, such as a resistance. An array of the same name is replaced.
 *   `name`: the name may have the same characters as the prefix of riis_vtk_mesh_set_marks.
 *   `n_nodes`: the mesh's number of nodes.
 *   `n_components`: the number of components for each node, 1 to 9.
 *   `values` (n_components, n_nodes). */
RIIS_API riis_status riis_vtk_mesh_set_point_array(riis_vtk_mesh *mesh, const char *name, int64_t n_nodes,
                                                   int64_t n_components, const double *values);
/* Sets the unit of a point array. Files .vtu and .pvtu store the unit as VTK's key UNITS_LABEL, and XDMF stores it as the
 * attribute Unit.
 *   `name`: the name of an array.
 *   `unit`: 1 to 64 printable characters of ASCII, such as "g/(cm3 s)".
 * Errors: RIIS_INVALID_ARGUMENT if the mesh lacks the array, and if the unit has other characters. */
RIIS_API riis_status riis_vtk_mesh_set_unit(riis_vtk_mesh *mesh, const char *name, const char *unit);
/* Tells whether the mesh has a point array of this name: *has becomes 1 if it has one, else 0. */
RIIS_API riis_status riis_vtk_mesh_has_point_array(const riis_vtk_mesh *mesh, const char *name, int32_t *has);
/* Gives the median length of the mesh's edges. The call measures the edges of volume cells, as in riis_vtk_mesh_create_adjacency,
 * and of faces except polygons. An edge counts once for each of its cells. If a mesh has more than 20,000 cells, the call
 * measures only the edges of 20,000 cells, evenly spaced in the list of cells. The length is 0 if the mesh has no edges. */
RIIS_API riis_status riis_vtk_mesh_get_median_edge(const riis_vtk_mesh *mesh, double *length);

/* Keeps only the cells with certain values in a cell array, and the nodes of these cells. For example, the call can keep the
 * fluid and remove the wall. Nodes and cells keep their order and their data. As in riis_vtk_mesh_extract, the arrays
 * riis_node_id and riis_cell_id have the ids in the whole mesh. If riis_vtk_mesh_extract later makes a part of this mesh, the two
 * arrays still have the ids in the whole mesh.
 *   `where`: NAME=VALUES, such as "region=1,2". NAME is a cell array of single numbers. For gmsh's physical groups, NAME is
 *     gmsh:physical, and VALUES may be names of groups. A cell that is in several groups has the values of all these groups.
 *   `n_chosen`: the number of chosen cells, without surface cells if the mesh has volume cells. With NULL the call fails if no
 *     cell is chosen.
 * Errors: RIIS_INVALID_ARGUMENT if the mesh lacks the array or the named group. After an error the mesh is unchanged. */
RIIS_API riis_status riis_vtk_mesh_choose_cells(riis_vtk_mesh *mesh, const char *where, int64_t *n_chosen);
/* Finds a cell array that probably numbers the domains of the mesh, such as fluid and wall. In such an array, the volume cells
 * have 2 to 16 different whole numbers. Somewhere, two cells of the same type that share a node have different numbers. Arrays
 * with names such as "rank" mean something else, and are left out.
 *   `array`: the name of the array, valid until the next call or the mesh's destruction. "" if no array was found.
 *   `n_values`: the number of different values; 0 if no array was found.
 *   `values` (n_values): the values, ascending. NULL: not wanted. */
RIIS_API riis_status riis_vtk_mesh_find_regions(riis_vtk_mesh *mesh, const char **array, int64_t *n_values,
                                                const double **values);

/* Tells which points lie outside the mesh and farther from all volume cells than a given distance. The edges of cells of higher
 * order count as straight. If a mesh has several pieces, call the function for each piece.
 *   `xyz` (3, n_points), finite.
 *   `distance`: the given distance, in the unit of xyz; finite and >= 0. With 0, the call finds the points that lie in no cell.
 *   `is_outside` (n_points): before the call, 1 for each point to test, and 0 for the others. For each point that is not outside,
 *     the call changes the 1 to 0.
 * Errors: RIIS_INVALID_ARGUMENT for a bad argument; the message names the argument and its value, and is_outside does not
 * change. */
RIIS_API riis_status riis_vtk_mesh_find_outside(const riis_vtk_mesh *mesh, int64_t n_points, const double *xyz,
                                                double distance, uint8_t *is_outside);

/* Makes a mesh of all cells that have one of the given nodes, with all nodes of these cells. Nodes and cells keep their order and
 * their data. Two new arrays give the ids in the whole mesh: the point array riis_node_id and the cell array riis_cell_id
 * (Int64). The new mesh borrows nothing.
 *   `n_ids`: >= 0.
 *   `node_ids` (n_ids): the ids of the given nodes, 0 to n_nodes - 1, in any order.
 * Errors: RIIS_INVALID_ARGUMENT for a bad id; the message names the id and its position in node_ids. */
RIIS_API riis_status riis_vtk_mesh_extract(const riis_vtk_mesh *mesh, int64_t n_ids, const int64_t *node_ids,
                                           riis_vtk_mesh **part);
/* Gives the size of the file that riis_vtk_mesh_write would write, in bytes, without a few kilobytes of text. */
RIIS_API riis_status riis_vtk_mesh_get_file_size(const riis_vtk_mesh *mesh, int64_t *n_bytes);

/* Writes the mesh with all its arrays to a file. The points are Float64.
 *   `path`: ends in .vtu or .xdmf. A mesh with axes (riis_vtk_mesh_get_axes) can also go to a .vtr file, or to a .vti file if its
 *     axes are evenly spaced. Files .vtr and .vti store no cells. The numbers of NAME.xdmf are in NAME.h5 beside it, or in
 *     NAME.xdmf itself if riis was built without HDF5. An .xdmf file cannot hold polyhedra or text. If the mesh has the cell
 *     centres of a case of OpenFOAM as nodes, the path may also be a time folder of this case, such as CASE/0. The cell arrays
 *     then become fields in this folder, with zeroGradient at patches: riis_K becomes K, and riis_K_u_surface becomes Ku. An
 *     error may leave some of these fields written. */
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
/* Makes a list of pieces for riis_vtk_pieces_write. The pieces have the same arrays as `mesh`. The list borrows nothing.
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
 * vtkGhostType need not be listed there. */
RIIS_API riis_status riis_vtk_pieces_read_mesh(const riis_vtk_pieces *pieces, int64_t piece, riis_vtk_mesh **mesh);
/* Writes the list to a file. Relative paths of pieces become relative to the file's folder. Absolute paths stay absolute.
 *   `path`: ends in .pvtu. */
RIIS_API riis_status riis_vtk_pieces_write(const riis_vtk_pieces *pieces, const char *path);

/* Whether other pieces of the mesh may also have a node of a piece. */
enum {
  RIIS_VTK_NODE_INSIDE = 0, /* no other piece has the node, except as a ghost */
  RIIS_VTK_NODE_SHARED = 1, /* other pieces may also have the node, because it is on a face of only one cell or on no volume
                               cell */
  RIIS_VTK_NODE_GHOST = 2,  /* the node belongs only to ghost cells, which are copies of another piece's cells */
  RIIS_VTK_NODE_LOOSE = 3   /* the node belongs to no cell of the piece */
};
/* Numbers of cells in a piece, without ghosts. A cell is a ghost if bit 1 is set in its entry of the cell array vtkGhostType. */
typedef struct riis_vtk_sharing {
  int64_t n_cells;          /* cells that are not ghosts */
  int64_t n_volume_cells;   /* the number of volume cells that are not ghosts */
  int64_t n_cells_left_out; /* of these volume cells, the number of those without edges in the adjacency, as in
                               riis_vtk_mesh_get_volume_cells */
  int32_t has_global_ids;   /* 1 if the mesh has global ids */
  int32_t reserved;         /* 0 */
} riis_vtk_sharing;
/* Tells which nodes of a piece may also be in other pieces. If a point array has VTK's attribute GlobalIds, it contains the
 * global ids. Otherwise they are in the array vtkGlobalIds, GlobalNodeId or GlobalPointIds.
 *   `n_nodes`: the mesh's number of nodes.
 *   `role` (n_nodes), RIIS_VTK_NODE_*.
 *   `global_id` (n_nodes): the global ids, written only if the mesh has them; NULL if not wanted.
 * Errors: RIIS_FILE_ERROR for global ids that are not whole numbers, and for a vtkGhostType that is not UInt8. */
RIIS_API riis_status riis_vtk_mesh_get_sharing(const riis_vtk_mesh *mesh, int64_t n_nodes, uint8_t *role,
                                               int64_t *global_id, riis_vtk_sharing *sharing, int64_t struct_size);

/* ---- Surfaces ------------------------------------------------------------------------------------------ */

/* A surface of triangles or quads that was read from a file. */
typedef struct riis_vtk_surface riis_vtk_surface;

/* Reads a surface. Polygons, strips and quadratic faces are cut into triangles. Quads stay quads if the file has only quads.
 *   `path`: ends in .vtp, .vtk, .vtu (also with quadratic faces), .stl, .obj or .ply. All cells must be faces.
 *   `leaflets`: the name of the cell array with the leaflet ids, one whole number >= 0 for each cell. The file must have this
 *     array. NULL stands for riis_leaflet, which the file may lack.
 * If the file has the point array riis_attached, with one number for each point, it becomes riis_surface_arrays.attached. Quads
 * that become triangles are cut from their first corner to their third. If this line runs outside a concave quad, the cut goes
 * from the second corner to the fourth.
 * Errors: RIIS_FILE_ERROR for a bad file; the message names the file, the bad cell and its value. If the array of leaflet ids is
 * missing, the message names the arrays that exist. */
RIIS_API riis_status riis_vtk_surface_read(const char *path, const char *leaflets, riis_vtk_surface **surface);
/* Makes a surface of the mesh's boundary, such as the wall around the blood. Each face of the boundary belongs to only one volume
 * cell, and its normal points outwards. Faces of cells of higher order get straight edges. The surface borrows nothing from the
 * mesh, and riis_vtk_surface_destroy destroys it.
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without volume cells. */
RIIS_API riis_status riis_vtk_mesh_get_boundary(const riis_vtk_mesh *mesh, riis_vtk_surface **boundary);
/* Makes every connected piece of the surface a leaflet. The leaflets are numbered from 0 in the order of their first faces. Faces
 * are connected if they share a vertex, or if they have vertices with exactly the same coordinates, as in an .stl file. Arrays
 * from earlier calls become invalid. */
RIIS_API riis_status riis_vtk_surface_number_pieces(riis_vtk_surface *surface);
/* Adds the faces of another surface, for a valve with one file for each leaflet. The faces of `surface` become leaflet 0, and the
 * faces of each added surface become the next leaflet. The leaflet ids in the files are lost. If only one of the two surfaces
 * consists of quads, its quads are cut into triangles. `other` does not change. Arrays from earlier calls become invalid. */
RIIS_API riis_status riis_vtk_surface_append(riis_vtk_surface *surface, const riis_vtk_surface *other);
/* Destroys the surface. Its arrays become invalid. Surfaces made from it stay. */
RIIS_API void riis_vtk_surface_destroy(riis_vtk_surface **surface);
/* Gives the vertices and faces of the surface in a struct for riis_surface_create_from_arrays. The arrays are valid until the
 * surface is destroyed. */
RIIS_API riis_status riis_vtk_surface_get_arrays(const riis_vtk_surface *surface, riis_surface_arrays *arrays,
                                                 int64_t struct_size);

/* Writes the triangles of a surface to a file, after placement. They are exactly the triangles that answer queries. Points are
 * Float64. The cell arrays are riis_leaflet, riis_patch (Int32) and riis_triangle (Int64). A valve also has the point array
 * riis_uv (2 x Float64). If the last update gave velocities, there is the point array riis_velocity (3 x Float64). If the surface
 * has an attachment, the point array riis_attached (UInt8) is 1 at its vertices and 0 elsewhere.
 *   `path`: ends in .vtp. */
RIIS_API riis_status riis_vtk_surface_write(const riis_surface *surface, const char *path);

/* ---- Motion -------------------------------------------------------------------------------------------- */

/* The frames of a moving surface, such as a patient's valve. They come from files that have the same faces at several times. The
 * caller makes keyframes from the frames, and may set a period and an interpolation:
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
 *   in the same order. Polygons and quads are cut into triangles in the same way in all files, as the first file requires.
 * - Leaflet ids and riis_attached come from the first file. `leaflets` names the cell array of leaflet ids, as in
 *   riis_vtk_surface_read.
 * - An .stl file has triangles without numbered vertices. The triangles must have the same order in all files. Corners at exactly
 *   the same position in the first file become one vertex, so they must also share one position in every other file. If leaflets
 *   touch at corners in the first file and separate later, use .vtp files, which have numbered points.
 * - Times ascend strictly, and coordinates are finite, as in riis_keyframe_arrays.
 * Errors: RIIS_FILE_ERROR if a file does not fit the first file; the message names the file and the difference. */
typedef struct riis_vtk_motion riis_vtk_motion;

/* Reads a motion from a ParaView collection. Each DataSet has a timestep and the path of a file, which is absolute or relative to
 * the folder of the .pvd file. Other attributes of a DataSet are ignored. Two DataSets with the same timestep, such as two parts,
 * are refused.
 * Errors: RIIS_FILE_ERROR for a bad DataSet, and if there is no DataSet. The message names the .pvd file and the DataSet. */
RIIS_API riis_status riis_vtk_motion_read_pvd(const char *path, const char *leaflets,
                                              riis_vtk_motion **motion);
/* Reads a motion from a list of files.
 *   `n_files`: 1 to 1,000,000.
 *   `paths` (n_files).
 *   `times` (n_files).
 * Errors: RIIS_INVALID_ARGUMENT for a bad entry of paths or times; the message names the entry. */
RIIS_API riis_status riis_vtk_motion_read_files(int64_t n_files, const char *const *paths,
                                                const double *times, const char *leaflets,
                                                riis_vtk_motion **motion);
/* Reads a motion from one .vtp or .vtu file with displacements. Each frame is the points plus the displacements in a point array
 * of 3 components. The points without displacements are not a frame.
 *   `prefix`: the name of each array is the prefix, then "_" or nothing, then a whole number, as in displacement_0 and
 *     displacement_10. Frames are in the order of the numbers, which may have gaps.
 *   `n_times`: the number of arrays of displacements, or 0.
 *   `times` (n_times): the times of the frames. NULL, with n_times 0: the times are those of the field array TimeValue.
 * Errors: RIIS_INVALID_ARGUMENT if n_times is not the number of arrays, and for a bad entry of times, which the message names. */
RIIS_API riis_status riis_vtk_motion_read_displacements(const char *path, const char *prefix, int64_t n_times,
                                                        const double *times, const char *leaflets,
                                                        riis_vtk_motion **motion);
/* Reads a motion from a file that `riis export` wrote for svMultiPhysics. The file has the positions of all nodes, frame by
 * frame. The faces are in a .vtu or .vtp file in the same folder. For NAME_motion_open.dat, the name of this file without its
 * ending is NAME_motion_open, NAME_motion or NAME, or one of these names followed by _mesh or _face.
 *   `path`: ends in .dat.
 *   `time_step`: the time from one frame to the next, above 0. The first frame is at time 0.
 * Errors: RIIS_INVALID_ARGUMENT for a bad time_step. */
RIIS_API riis_status riis_vtk_motion_read_frames(const char *path, double time_step, const char *leaflets,
                                                 riis_vtk_motion **motion);
/* Adds the faces of another motion with the same times. Each motion becomes one leaflet, as in riis_vtk_surface_append.
 * riis_vtk_motion_get_files then gives the files of both motions. `other` does not change.
 * Errors: RIIS_INVALID_ARGUMENT if the times differ; the message names the first frame whose time differs. */
RIIS_API riis_status riis_vtk_motion_append(riis_vtk_motion *motion, const riis_vtk_motion *other);
/* Gives the paths of the files that were read: one file for each frame, or the one file with displacements.
 *   `paths` (n_files): the paths, valid until the motion is destroyed. Relative paths in a .pvd file get its folder in front. */
RIIS_API riis_status riis_vtk_motion_get_files(const riis_vtk_motion *motion, int64_t *n_files,
                                               const char *const **paths);
/* Makes every connected piece of the first frame a leaflet, as riis_vtk_surface_number_pieces does. */
RIIS_API riis_status riis_vtk_motion_number_pieces(riis_vtk_motion *motion);
/* Destroys the motion. Its arrays become invalid. Keyframes made from it stay. */
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

/* Which texts a picture shows. */
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

/* The contents and the view of a picture. Texts are in ASCII; any other character is drawn as "?". */
typedef struct riis_vtk_picture_options {
  int64_t struct_size;    /* set by the init function */
  const char *title;      /* the caption of the surface, which may have one line break. Default NULL: "Surface" */
  const char *unit;       /* the text after the number at the scale bar, such as "mm". If the unit is "m", and the bar is shorter
                             than 0.1 m, its length is given in mm. NULL, the default, and "" stand for "mesh units", or if there
                             is neither mesh nor wall for "units" */
  int64_t n_leaflet_names;/* >= 0, default 0 */
  const char *const *leaflet_names; /* (n_leaflet_names): the name of each leaflet_id in the key of the colours. A leaflet without
                                       a name is called "leaflet 0", and so on. Default NULL: no names */
  int64_t n_leaking_edges;/* >= 0, default 0 */
  const int64_t *leaking_edges; /* (2, n_leaking_edges): the node ids of leaking mesh edges, which are drawn in dark red in front
                                   of everything else. Default NULL: the picture shows nothing about leaks. With n_leaking_edges 0
                                   and any pointer other than NULL, the picture says that no edge leaks */
  int32_t view;           /* RIIS_VTK_VIEW_*. Default RIIS_VTK_VIEW_OBLIQUE */
  int32_t width, height;  /* pixels, 64 to 8192. Default 1600 x 800 */
  int32_t reserved;       /* 0 */
  double rotation_axis[3]; /* the rotation axis of the valve's placement, for RIIS_VTK_VIEW_VALVE_*, with the range of
                              riis_surface_options. Default (0, 0, 1) */
  double rotation_angle;  /* degrees. Default 0: the valve has the mesh's axes */
  const riis_surface *wall; /* the wall that is drawn around the surface. If there is a mesh, the mesh's boundary is drawn
                               instead. Default NULL: none */
  double background[4];   /* the background: red, green and blue, 0 to 1, then the opacity, 0 or 1. Texts are dark on a bright
                             background, and bright on a dark background. With the opacity 0 the background is transparent, but
                             its colour still decides whether texts are dark. Default (1, 1, 1, 1): white */
  int32_t captions;       /* RIIS_VTK_CAPTIONS_*. Default RIIS_VTK_CAPTIONS_ALL */
  int32_t panels;         /* RIIS_VTK_PANELS_*. Default RIIS_VTK_PANELS_BOTH */
  const char *velocity;   /* the name of the velocity: a point array or cell array of the mesh with three components. For a mesh
                             that was read from a time folder of OpenFOAM, it may also be a field in this folder, such as "U". The
                             panel of the marked cells then shows the speed in a plane through the middle of the surface, at right
                             angles to the direction of view. Default NULL: no velocity */
} riis_vtk_picture_options;
/* Fills *options with the defaults. */
RIIS_API riis_status riis_vtk_picture_options_init(riis_vtk_picture_options *options, int64_t struct_size);

/* Draws the surface and the marked cells of the mesh to a .png file, in two panels with the same scale.
 * - The left panel shows the surface with a colour for each leaflet. There are six colours, which repeat. The key below the left
 *   panel names as many leaflets as fit, and dots replace the others. A leaflet seen edge-on appears as a line.
 * - The right panel shows the cells with marked nodes. If all nodes of a cell are marked, it has the colour of the leaflet
 *   nearest to one of these nodes. If only some nodes are marked, only the far side of the cell is drawn, in a pale colour. If
 *   the mesh has volume cells, flat cells are not drawn.
 * - The wall is a translucent shell in both panels. Flat ends of the wall, such as an inlet, are not drawn. A wall that has only
 *   flat parts, such as a box, is drawn whole.
 * - The captions give the half thickness and the number of marked nodes.
 * - With a velocity, the right panel shows the speed in a plane through the centre of the surface's area, at right angles to the
 *   direction of view. Lines show the wall and the leaflets where the plane cuts them. The bar of colours has the unit of the
 *   array. If the array has no unit, the bar has `unit` followed by "/s".
 * - Axes and a scale bar are below the panels. A mesh that is much longer than the surface is cut off at dashed lines, which
 *   captions explain. Pictures lower than 120 pixels have no texts, axes or scale bar.
 * - RIIS_VTK_VIEW_THREE and RIIS_VTK_VIEW_VALVE_THREE draw one column for each view, with one panel above the other. All columns
 *   have the same scale.
 *
 *   `mesh`: must have marks set. NULL draws the surface alone, in one panel.
 *   `path`: ends in .png.
 * Errors: RIIS_UNAVAILABLE without a usable X display, after about half a second. Without a mesh, RIIS_INVALID_ARGUMENT for
 * leaking_edges, RIIS_VTK_PANELS_MARKS and a velocity. With a mesh, RIIS_INVALID_ARGUMENT if it lacks a node of leaking_edges or
 * the array of the velocity. */
RIIS_API riis_status riis_vtk_draw(const riis_surface *surface, const riis_vtk_mesh *mesh,
                                   const riis_vtk_picture_options *options, const char *path);

/* Draws a picture for each of several views. One such call is faster than several calls of riis_vtk_draw, because it makes the
 * geometry and the window only once.
 *   `n_views`: >= 0.
 *   `views` (n_views): the views, RIIS_VTK_VIEW_*. The call ignores options->view.
 *   `paths` (n_views): the files. After an error, the finished pictures stay.
 * Errors: as riis_vtk_draw. */
RIIS_API riis_status riis_vtk_draw_views(const riis_surface *surface, const riis_vtk_mesh *mesh,
                                         const riis_vtk_picture_options *options, int64_t n_views,
                                         const int32_t *views, const char *const *paths);

/* A film: pictures of a moving valve in one mesh, all from the same camera, such as the frames of a movie. */
typedef struct riis_vtk_film riis_vtk_film;
/* Makes a film, with the window and the outline of the mesh for all pictures.
 *   `mesh`: nodes and cells must stay the same, but the marks may change. NULL draws the surface alone. The film shares the
 *     mesh's data, so the caller may destroy the mesh before the film.
 *   `lower`, `upper` (3): the corners of a box along the mesh's axes, in which the surface lies at all times. The box determines
 *     the camera.
 *   `options`: as in riis_vtk_draw, except that title and leaking edges are ignored, and a velocity is refused.
 * Errors: RIIS_UNAVAILABLE without a usable X display, after about half a second. RIIS_INVALID_ARGUMENT for
 * bounds that are not finite or do not ascend. */
RIIS_API riis_status riis_vtk_film_create(const riis_vtk_mesh *mesh, const double *lower, const double *upper,
                                          const riis_vtk_picture_options *options, riis_vtk_film **film);
/* Draws the surface and the present marks of the mesh into a .png file, as riis_vtk_draw does.
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
