/* SPDX-License-Identifier: Apache-2.0
 *
 * riis_vtk.h - optional component: meshes and surfaces from and to VTK files, pictures. A library of its own
 * (riis_vtk), so that the core never links VTK. Conventions as in riis.h; errors come through riis_last_error() too.
 *
 * VTK keeps process-wide state: call these functions from one thread at a time. What VTK would print while a function
 * runs is caught and becomes the error text. Files that are cut short or of another kind are refused; VTK's own readers can
 * still crash on a .vtu whose bytes were damaged, so do not read what you do not trust in a process you cannot lose. The
 * caller's locale does not matter and is the same afterwards.
 */
/* clang-format off: as riis.h */
#ifndef RIIS_RIIS_VTK_H
#define RIIS_RIIS_VTK_H

#include <riis/riis.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------------------------ *
 * Volume meshes
 * ------------------------------------------------------------------------------------------------------------------ */

/* An unstructured grid as it was in the file, its points as doubles. */
typedef struct riis_vtk_mesh riis_vtk_mesh;

/* Reads an unstructured grid, .vtu (XML) or .vtk (legacy), chosen by the file's ending. A mesh may have no cells; a legacy
 * file must then say so (CELLS 0 0, CELL_TYPES 0), since without these it may be cut short.
 * Errors: RIIS_FILE_ERROR naming the file: missing, unreadable, another data set, truncated, no points. */
RIIS_API riis_status riis_vtk_mesh_read(const char *path, riis_vtk_mesh **mesh);
/* Destroys the mesh; pointers got from it end. */
RIIS_API void riis_vtk_mesh_destroy(riis_vtk_mesh **mesh);

/* The nodes in the file's order, xyz(3, n_nodes), for riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, ...). Any pointer
 * may be NULL. Owned by the mesh, valid until its destruction. */
RIIS_API riis_status riis_vtk_mesh_nodes(const riis_vtk_mesh *mesh, int64_t *n_nodes, int64_t *n_cells, const double **xyz);

/* Makes the adjacency of the nodes for riis_mesh_set_adjacency: neighbours are nodes that an edge of a tetrahedron, pyramid, wedge,
 * hexahedron or voxel joins. Other cells are left out: those of a boundary say nothing more; of polyhedra, prisms of more sides
 * and cells of higher order no edges are known here. Nodes of these alone get empty rows, as all do in a mesh without any
 * of the above: RIIS_SEARCH_NEIGHBOR finds the same nodes all the same, by its proof, RIIS_SEARCH_PAPER does not.
 *   n_threads  1 to 1024, or 0: the processors the calling thread may use
 *   adjacency  for riis_adjacency_destroy; it borrows nothing from the mesh
 * Errors: RIIS_INVALID_ARGUMENT for n_threads. */
RIIS_API riis_status riis_vtk_mesh_adjacency(const riis_vtk_mesh *mesh, int32_t n_threads, riis_adjacency **adjacency);

/* Makes the part of that adjacency that riis_find_leaks needs, in one pass over the cells, which takes less time than all rows do:
 * the edges that are longer than a length and whose bounding box meets that of the surface. It is for riis_find_leaks alone: a
 * search that walks along it stays where it started.
 *   surface           read
 *   longer_than       twice the half thickness that was marked with, since shorter edges do not leak; 0 for all edges near the
 *                     surface, which a marking by RIIS_SEARCH_PAPER or by other distances than the triangles' needs. Edges up to
 *                     a billionth shorter are taken as well
 *   n_threads         1 to 1024, or 0: the processors the calling thread may use
 *   n_cells_left_out  how many cells of volume there are whose edges are not known here: polyhedra, prisms of more sides, cells
 *                     of higher order; NULL if not wanted
 *   adjacency         for riis_adjacency_destroy; it borrows nothing
 * Errors: RIIS_INVALID_ARGUMENT for longer_than below 0 or not finite, or n_threads. */
RIIS_API riis_status riis_vtk_mesh_long_edges(const riis_vtk_mesh *mesh, const riis_surface *surface, double longer_than,
                                              int32_t n_threads, int64_t *n_cells_left_out, riis_adjacency **adjacency);

/* Adds, or replaces, the point arrays of a marking: riis_marked (UInt8, 0 or 1), riis_distance (Float64, far_distance beyond
 * the limit), riis_leaflet (Int32, -1 beyond the limit). far_distance as in riis_mark_result_dense.
 * Errors: RIIS_INVALID_ARGUMENT if the result is not of a mesh with as many nodes. */
RIIS_API riis_status riis_vtk_mesh_set_marks(riis_vtk_mesh *mesh, const riis_mark_result *result, double far_distance);
/* The same with other names, for the marks of more than one valve: PREFIX_marked, PREFIX_distance, PREFIX_leaflet.
 * riis_vtk_draw shows the marks of riis_vtk_mesh_set_marks only.
 *   prefix  1 to 64 letters, digits, "_", "-" and "."; "riis" is that of riis_vtk_mesh_set_marks
 * Errors: RIIS_INVALID_ARGUMENT for a prefix that is none, or a result of a mesh with another number of nodes. */
RIIS_API riis_status riis_vtk_mesh_set_named_marks(riis_vtk_mesh *mesh, const riis_mark_result *result, double far_distance,
                                                   const char *prefix);
/* Sets a point array of the caller's numbers, such as a resistance; an array of that name is replaced.
 *   name          as a prefix of riis_vtk_mesh_set_named_marks
 *   n_nodes       of the mesh
 *   n_components  1 to 9 a node
 *   values        (n_components, n_nodes), copied
 * Errors: RIIS_INVALID_ARGUMENT for a name that is none, another n_nodes, or n_components out of range. */
RIIS_API riis_status riis_vtk_mesh_set_point_array(riis_vtk_mesh *mesh, const char *name, int64_t n_nodes,
                                                   int64_t n_components, const double *values);
/* Tells whether the mesh has a point array of that name: *has is 1 or 0. */
RIIS_API riis_status riis_vtk_mesh_has_point_array(const riis_vtk_mesh *mesh, const char *name, int32_t *has);
/* Gives the median length of the edges of linear cells (triangle, quad, pixel, tetrahedron, pyramid, wedge, hexahedron,
 * voxel), to compare a half thickness with. An edge counts once for each of its cells. At most 20,000 cells are
 * looked at, evenly spaced in their order. *length is 0 for a mesh without such cells. */
RIIS_API riis_status riis_vtk_mesh_median_edge(const riis_vtk_mesh *mesh, double *length);

/* Writes the mesh with all its arrays to a .vtu file, points as Float64. The file is complete or not there: it is written
 * beside its place and then moved. Where the path is a link, the file it points to is replaced or made and the link stays.
 * A file that is replaced leaves its permissions to the new one.
 * Errors: RIIS_FILE_ERROR naming the file. */
RIIS_API riis_status riis_vtk_mesh_write(const riis_vtk_mesh *mesh, const char *path);

/* ------------------------------------------------------------------------------------------------------------------ *
 * Surfaces
 * ------------------------------------------------------------------------------------------------------------------ */

/* Triangles or quads read from a file. */
typedef struct riis_vtk_surface riis_vtk_surface;

/* Reads a surface, by the file's ending: .vtp (faces only), .vtu (triangles, quads, polygons, strips; another cell is an
 * error naming it) or .stl. Polygons and strips are cut into triangles; a file of quads only keeps its quads. A cell array
 * riis_leaflet of whole numbers >= 0 gives the leaflet ids. A quad is cut from its first corner to its third; the corners
 * of a concave quad move on by one, the winding kept, where that line would run outside it.
 * Errors: RIIS_FILE_ERROR naming the file. */
RIIS_API riis_status riis_vtk_surface_read(const char *path, riis_vtk_surface **surface);
/* The same with leaflet ids from another cell array, which must be there.
 *   leaflets  the array's name; it has one whole number >= 0 a cell
 * Errors: RIIS_FILE_ERROR naming the file, and the cell with its value or the arrays that there are. */
RIIS_API riis_status riis_vtk_surface_read_with_leaflets(const char *path, const char *leaflets, riis_vtk_surface **surface);
/* Makes every connected piece of the surface a leaflet, in place of the ids that it has: 0 for the piece of the first
 * face, then in the order of the pieces' first faces. Faces are connected that have a vertex in common, or vertices
 * with exactly the same coordinates, as in an .stl file. Arrays got from the surface before end. */
RIIS_API riis_status riis_vtk_surface_number_pieces(riis_vtk_surface *surface);
/* Destroys the surface; arrays that point into it end, surfaces made from it stay. */
RIIS_API void riis_vtk_surface_destroy(riis_vtk_surface **surface);
/* Points *arrays, which its init function has filled, at the arrays of the surface, for riis_surface_create_from_arrays.
 * They are owned by the surface, valid until its destruction. */
RIIS_API riis_status riis_vtk_surface_arrays(const riis_vtk_surface *surface, riis_surface_arrays *arrays);

/* Writes exactly the triangles that are queried, after placement, to a .vtp file: points Float64; cell arrays riis_leaflet,
 * riis_patch (Int32), riis_triangle (Int64); point array riis_uv (2 x Float64) for generated valves. Complete or not there.
 * Errors: RIIS_FILE_ERROR naming the file. */
RIIS_API riis_status riis_vtk_surface_write(const riis_surface *surface, const char *path);

/* ------------------------------------------------------------------------------------------------------------------ *
 * Pictures
 * ------------------------------------------------------------------------------------------------------------------ */

/* Where a picture is looked at from. */
enum {
  RIIS_VTK_VIEW_SIDE = 0,   /* along +y, z up */
  RIIS_VTK_VIEW_TOP = 1,    /* along -z, y up */
  RIIS_VTK_VIEW_OBLIQUE = 2 /* from above one side, z up */
};

/* What a picture shows and how. */
typedef struct riis_vtk_picture_options {
  int64_t struct_size;    /* sizeof(riis_vtk_picture_options) of the caller, as its init function had it */
  int32_t view;           /* RIIS_VTK_VIEW_*. Default RIIS_VTK_VIEW_OBLIQUE */
  int32_t width, height;  /* pixels, 64 to 8192. Default 1600 x 800 */
  int32_t reserved;       /* 0 */
  const char *title;      /* says what the surface is, before the number of its triangles; NULL, the default: "Surface" */
  const char *const *leaflet_names; /* (n_leaflet_names): by leaflet_id, for the key of the colours; NULL, the default, and
                             leaflets beyond: "leaflet 0", ... */
  int64_t n_leaflet_names;/* >= 0, default 0. Texts are ASCII; what is not is drawn as ? */
  int64_t n_leaking_edges;/* >= 0, default 0 */
  const int64_t *leaking_edges; /* (2, n_leaking_edges): the ends of mesh edges that are drawn red, in front of all else, as
                             node ids from 0. Default NULL: the picture does not mention leaks. Not NULL, with
                             n_leaking_edges 0: the picture says that no edge leaks */
} riis_vtk_picture_options;
/* Fills *options with the defaults; struct_size is sizeof(riis_vtk_picture_options) of the caller. */
RIIS_API riis_status riis_vtk_picture_options_init(riis_vtk_picture_options *options, int64_t struct_size);

/* Draws two panels into a .png file, both to the same scale. The left panel shows the surface, each leaflet in a colour of
 * its own. The right panel shows marked cells in the faint outline of the mesh. A cell is whole if all its nodes are marked:
 * it has the colour of the leaflet that is nearest to one of its nodes. A cell of which only some nodes are marked is pale.
 * Only its far side is drawn, so that pale cells show around whole ones and in gaps between them. Captions count nodes and
 * cells; if the mesh has volumes, the picture and the counts leave flat cells out. Axes and a scale bar stand below the panels.
 * A mesh much longer than the surface is cut at dashed lines. Pictures lower than 120 pixels have no texts, axes or bar.
 *   mesh  with marks set; NULL draws the surface alone, in one panel
 * Errors: RIIS_UNAVAILABLE without a usable X display (VTK itself would abort the process), after trying for about half a
 * second; RIIS_FILE_ERROR naming the file; RIIS_INVALID_ARGUMENT for leaking_edges without a mesh, or outside of it. */
RIIS_API riis_status riis_vtk_draw(const riis_surface *surface, const riis_vtk_mesh *mesh,
                                   const riis_vtk_picture_options *options, const char *path);

/* Draws one picture for each view, as riis_vtk_draw does, but makes the geometry and opens the window only once.
 *   n_views  >= 0
 *   views    (n_views) RIIS_VTK_VIEW_*; options->view is not used
 *   paths    (n_views) the files; pictures that were finished before an error stay
 * Errors: as riis_vtk_draw. */
RIIS_API riis_status riis_vtk_draw_views(const riis_surface *surface, const riis_vtk_mesh *mesh,
                                         const riis_vtk_picture_options *options, int64_t n_views,
                                         const int32_t *views, const char *const *paths);

#ifdef __cplusplus
}
#endif

#endif
