/* SPDX-License-Identifier: Apache-2.0
 * Lets C tests call the stages behind the public interface. Points are arrays of 3 doubles. If a function returns a pointer, the
 * caller frees the result with free(). A refusal is returned as its status, and riis_last_error() has the message. */
#ifndef RIIS_TEST_INTERNALS_H
#define RIIS_TEST_INTERNALS_H

#include <riis/riis.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Bézier curves have degree 2 or 3, and 3 * (degree + 1) numbers in control. */
void bezier_evaluate(int degree, const double *control, double t, double *point);
void bezier_derivative(int degree, const double *control, double t, double *vector);
double bezier_arc_length(int degree, const double *control, double t0, double t1);
void bezier_split(int degree, const double *control, double t, double *left, double *right);
double bezier_flatness(int degree, const double *control);
/* `t` has one entry per point, and `errors` has one entry fewer. */
riis_status bezier_flatten(int degree, const double *control, double max_error, int64_t *n_points, double **points,
                           double **t, double **errors);

/* Curves of n cubics without kinks. Each cubic continues the direction of the cubic before. Control points: control[12 * n]. */
riis_status chain_flatten(int64_t n_pieces, const double *control, double max_error, int64_t *n_points, double **points,
                          double **t, double **errors);
double chain_length(int64_t n_pieces, const double *control);
void chain_at(int64_t n_pieces, const double *control, double share, double *point, double *tangent);
/* `part` has room for 12 * n_pieces numbers. Returns the number of cubics in `part`. */
int64_t chain_between(int64_t n_pieces, const double *control, double share0, double share1, int reversed,
                      double *part);

/* Gives the offset O(u) of a patch of arcs between a base and an edge. Also bounds the offset's deviation from a linear
 * function. */
void bulge_at(int64_t n_base, const double *base, int64_t n_edge, const double *edge, double factor, double u,
              double *offset);
double bulge_linear_error(int64_t n_base, const double *base, int64_t n_edge, const double *edge, double factor,
                          double u0, double u1, double enough);

/* Polylines. */
double polyline_make(int64_t n, const double *points, int64_t *n_kept,
                     double *t); /* t has room for n; returns the length of the polyline */
void polyline_evaluate(int64_t n, const double *points, double t, double *point);

/* A Coons patch of four polylines with n[4] points, on the sides v0, v1, u0 and u1. */
typedef struct quad_grid {
  int64_t n_u, n_v;
  double *u, *v, *points; /* points[3 * (j * n_u + i)] */
} quad_grid;
quad_grid coons_grid(const int64_t *n, const double *const *points, double max_merge_shift);
void coons_evaluate(const int64_t *n, const double *const *points, double u, double v, double *point);
void quad_grid_free(quad_grid *grid);
double quad_kappa(const double *p00, const double *p10, const double *p11, const double *p01);
double quad_split_error(const double *p00, const double *p10, const double *p11, const double *p01);

/* The decision kernel. The kernel returns the squared distance from a point to a triangle. */
double kernel_point_triangle(const double *p, const double *abc, double *point, double *barycentric);

/* Returns 1 if the segment from a to b and the triangle have a point in common. */
int segment_triangle_meet(const double *a, const double *b, const double *abc);

/* The aortic valve's curves and patches at its default parameters. The caller may change one parameter, or pass NULL as its
 * name. */
typedef struct patch_set {
  int64_t n_curves, n_patches, n_images;
  int32_t *degree;                           /* one entry per curve */
  double *control;                           /* 12 numbers per curve, in the cusp's frame */
  int64_t *sides;                            /* 4 curves per patch: v0, v1, u0, u1 */
  int64_t *patch;                            /* the patch of each image */
  int32_t *leaflet_id, *patch_id, *mirrored; /* one entry per image */
  double *frame;                             /* 12 numbers per image: rows of its rotation, then its translation */
} patch_set;
riis_status aortic_patches(const char *name, double value, patch_set *set);
/* Maps a point from the cusp's frame to an image of the cusp's patch. */
void patch_image_place(const patch_set *set, int64_t image, const double *p, double *placed);
void patch_set_free(patch_set *set);

/* The placed quads of every patch's first image, for a valve with this kind and these parameters. Each parameter has one value.
 * Each quad has a bound on its distance from the smooth patch at equal (u, v). */
typedef struct bounded_quad {
  int32_t patch_id;
  double u[2], v[2], error;
  double corners[4][3]; /* at (u0, v0), (u1, v0), (u1, v1), (u0, v1) */
} bounded_quad;
riis_status bounded_quads(const char *kind, int n_parameters, const char *const *names, const double *values,
                          double max_error, int64_t *n_quads, bounded_quad **quads);

/* The number of triangles and the error bound of a valve whose curves deviate from their shape by `deviation`. A fixed
 * triangulation is planned for this state alone. bound_of_patches is the error bound of the searches by sampling and
 * minimisation, which use patches. */
typedef struct deviating {
  int64_t n_triangles;
  double bound, bound_of_patches;
  int is_within; /* 1 if the planned triangulation keeps its bound, or if there is no plan */
} deviating;
riis_status triangulate_deviating(const char *kind, double deviation, double max_error, int is_fixed, deviating *made);

/* Finds the closest triangle to each point by the library and by a loop. The library queries the Embree scene of the triangles
 * xyz(9, n_triangles) with every available instruction set. The loop goes over all triangles with the same kernel. Returns how
 * often the triangles or the bits of the squared distances differ. A point beyond the limit must get no triangle. */
int64_t scene_differs_from_loop(int64_t n_triangles, const double *xyz, int64_t n_points, const double *points,
                                double limit);

/* Sorts found nodes on up to n_threads threads. List i of n_lists has the nodes from end[i - 1] to end[i] - 1. Every node is less
 * than n_nodes. Writes the nodes of all lists to within_*. If the limit is wider than the half thickness, writes the marked nodes
 * to marked_* and returns their number. Otherwise returns -1. Each call reuses the memory of the last call. */
int64_t order_found_nodes(const riis_surface *surface, int64_t n_nodes, int n_threads, int limit_is_wider, int n_lists,
                          const int64_t *end, const int64_t *node, const double *distance, const int64_t *triangle,
                          int64_t *within_node, double *within_distance, int64_t *within_triangle, int64_t *marked_node,
                          double *marked_distance);

/* The kernels compiled for each instruction set (kernels/kernels.hpp): 0 is the baseline, 1 AVX2, 2 AVX-512. Number 3 is portable
 * code, which runs on any processor. */
enum { baseline_set = 0, portable_set = 3, n_kernel_sets = 4 };
int kernels_there(int set);
/* Returns whether the baseline lacks fused multiply-add instructions. NEON has fused multiply-add instructions, and flags of the
 * build can switch such instructions on. */
int kernels_baseline_rounds_twice(void);
const char *kernels_name(int set);

/* Computes the squared distances from points to triangles. Each pair of a point and a triangle is given by positions in the
 * arrays. distance_sq must have room for n + 7 numbers. */
void kernels_decide(int set, int32_t n, const int32_t *point, const int32_t *triangle, const double *points,
                    const double *corners, double *distance_sq);

/* Computes the squared distances of at most 8 pairs. Also gives the closest points (3, n) and their barycentric coordinates (3,
 * n).
 */
void kernels_locate(int set, int32_t n, const int32_t *point, const int32_t *triangle, const double *points,
                    const double *corners, double *distance_sq, double *closest, double *barycentric);

/* Collects the corners (9, n) of triangles that are given by vertex ids (3, n). Also computes the triangles' bounds. */
void kernels_take_corners(int set, const double *vertices, const int64_t *vertex_id, int64_t n, double *corners,
                          double *lower, double *upper);
/* Transforms up to 16 triangles into a frame: framed(16, 9). */
void kernels_frame_group(int set, const double *centre, double scale, const double *corners, const int32_t *triangle,
                         int32_t n, double *framed);
/* Transforms the 32 nodes (3, 32) of a leaf into a frame, framed(32, 3). Also finds the box around the nodes. */
void kernels_frame_leaf(int set, const double *centre, double scale, const double *nodes, float *framed, float *lower,
                        float *upper);
/* For fields: interpolates 8 numbers per vertex, (8, n_vertices), at points of 8 triangles. The triangles have the vertices (3,
 * 8), and the points have the weights (3, 8). The result is mixed(8, 8). */
void kernels_mix_at_vertices(int set, int64_t n_vertices, const double *numbers, const int64_t *vertex_id,
                             const double *barycentric, double *mixed);
/* For fields: computes the rates (n_directions, n_points) at which the distances of up to 8 points (3, 8) change. The closest
 * points have the weights (3, 8) on triangles with the vertices (3, 8). The vertices move at the rates (3, n_vertices,
 * n_directions). */
void kernels_differentiate(int set, const double *points, const double *on, const double *barycentric,
                           const int64_t *vertex_id, int64_t n_vertices, int64_t n_directions, const double *rates,
                           int32_t n_points, double *derivatives);
/* Ranks keys by their size. `key` and `n_less` have room for 64 entries. */
void kernels_rank(int set, const int32_t *key, int32_t n, int32_t *n_less);
/* Copies the numbers whose marks contain the bit, and returns how many were copied. `to` has room for n numbers. */
int32_t kernels_select(int set, const int32_t *numbers, const uint16_t *marks, int32_t n, int32_t bit, int32_t *to);
/* For fields: computes on which side of planes 8 points (3, 8) lie. The planes go through points (3, 8) and have normals (3,
 * 8). */
void kernels_find_sides(int set, const double *points, const double *on, const double *normals, int32_t *side);
/* Measures up to 8 triangles. measures(6, n) has the normal, twice the area, and the products of the edges at the first and the
 * second corner. */
void kernels_measure_triangles(int set, const double *vertices, const int64_t *vertex_id, int32_t n, double *measures);
/* Maps n points (3, n) by two affine maps. A map (3, 4) has the columns of its matrix and an offset. The points are scaled before
 * the second offset is added. */
void kernels_place_points(int set, const double *first, const double *second, double scale, int64_t n,
                          const double *points, double *placed);
/* Returns 0 if one of up to 8 triangles may have no area. The corners may move by up to an eighth of `shift`. */
int kernels_have_area(int set, const double *vertices, const int64_t *vertex_id, int32_t n, double shift);

/* Sums weight |at - source|^3 and its derivatives over n sources, n a multiple of 8. sources(n, 3) and weights(n, 3) are stored
 * coordinate by coordinate. Writes the sum, and then a third of its derivatives by x, y and z. The first three numbers of `sums`
 * are followed by a second copy, which comes from the function without derivatives. */
void kernels_sum_cubes(int set, int64_t n, const double *sources, const double *weights, const double *at,
                       double *sums);

/* Makes a group of n <= 16 triangles, corners(9, n), in the surface's frame, with one instruction set. The caller frees the
 * group. */
typedef struct kernel_group kernel_group;
kernel_group *kernels_group(int set, int n, const double *corners);
void kernels_group_free(kernel_group *group);
/* Returns 1 if two groups and their bounds are equal in all bits. */
int kernels_groups_equal(const kernel_group *a, const kernel_group *b);
/* Gives the squared distances from a point to the group's 16 lanes, in single precision. */
void kernels_group_distances(int set, const kernel_group *group, const float *point, double margin, float *distance_sq);

/* Returns the library's bound on the error of distances in single precision. Points are scaled by `ratio`, moved by `shift`,
 * and are at most `reach` from the surface. */
double kernels_error(double ratio, double shift, double reach, double longest_edge);

/* The work of a search on one leaf. The leaf has up to 32 nodes (3, n_nodes) in the mesh's frame, and the groups of triangles
 * near them. The limit is in the surface's frame. */
typedef struct kernel_pair {
  int32_t node, triangle; /* triangle: 16 * group + position in the group */
} kernel_pair;
enum { kernel_leaves = 2 };
typedef struct kernel_filter {
  double ratio, shift[3], limit;
  uint32_t wanted[kernel_leaves]; /* for each leaf, one bit for each node that takes part */
  int n_groups;
  const kernel_group *const *groups;
  int n_nodes;
  const float *nodes;
} kernel_filter;
/* Filters a cluster that has the nodes in two leaves. In the second leaf, the numbers of the nodes are larger by 32, the limit is
 * half, and the groups are in reverse order. Between these two leaves stand a leaf without wanted nodes and a leaf without
 * groups. Returns all pairs that the filter keeps. The filter's buffer has room for `room` pairs. *n_calls gets the number of
 * calls that the filter needed. The caller frees the pairs. */
int64_t kernels_filter(int set, const kernel_filter *filter, int32_t room, kernel_pair **pairs, int64_t *n_calls);
/* Gives the squared lower bounds of the distances to groups, lower_sq(32, n_groups). */
void kernels_lower_bounds(int set, const kernel_filter *filter, float *lower_sq);
/* Each of up to 16 boxes contains one node. near(n_groups) gets one bit per group and box, which is 1 if the group may be near
 * the box. Returns the kernel's result. */
int kernels_near_boxes(int set, const kernel_filter *filter, uint16_t *near);
/* Box k contains the nodes 2 k and 2 k + 1. Uses the groups' own boxes to clear bits of near(n_groups). Returns the kernel's
 * result. */
int kernels_near_own_boxes(int set, const kernel_filter *filter, uint16_t *near);

/* Returns the number n of samples of a surface that measures distances by sampling. The surface owns the samples xyz(3, n). If
 * several samples are equally near, the first counts. */
int64_t samples_of(const riis_surface *surface, const double **xyz);

/* Runs Powell's method from (0.5, 0.5) on [0,1]^2, with line searches that are accurate to `step`. Returns the final value, whose
 * position goes to `uv`. */
double powell_minimum(double (*f)(double u, double v), double enough, double step, double *uv);

/* Returns the status that the library's boundary makes of an exception:
 *   "error"     a riis Error of RIIS_INVALID_MESH with the message "error 7"
 *   "memory"    std::bad_alloc
 *   "standard"  another standard exception, "boom"
 *   "other"     an int
 *   "worker"    an Error thrown by a worker thread of a parallel loop
 *   "workers"   two such errors; the error of the second block comes first
 *   "nothing"   no exception */
riis_status wall_meets(const char *exception);

/* Compressed sparse rows with 64-bit integers. */
typedef struct wide_rows {
  int64_t n_rows;
  int64_t *offsets, *columns;
  int column_bits; /* number of bits of a column in the original rows */
} wide_rows;
void wide_rows_free(wide_rows *rows);
/* Returns 1 if the rows are equal, whatever the widths of their integers. */
int wide_rows_same(const wide_rows *a, const wide_rows *b);

/* Holds both directions of each edge in a std::set. An edge from a node to itself is left out. */
typedef struct edge_set edge_set;
edge_set *edge_set_make(void);
void edge_set_add(edge_set *set, int64_t a, int64_t b);
wide_rows edge_set_rows(const edge_set *set, int64_t n_nodes);
void edge_set_free(edge_set **set);

/* Makes rows as riis_adjacency_create_from_cells does, but with other limits for the use of 32-bit integers. n_entries limits the
 * entries, which are the nodes of all cells together. n_nodes limits the nodes. A negative argument keeps the library's limit.
 * Pass complete structs only. */
riis_status rows_with_limits(const riis_mesh_cells *cells, int n_threads, int64_t n_entries, int64_t n_nodes,
                             wide_rows *rows);

#ifdef __cplusplus
}
#endif

#endif
