/* SPDX-License-Identifier: Apache-2.0
 * The stages behind the public interface, for tests in C. Points are arrays of 3 doubles; what is returned by pointer
 * belongs to the caller (free). A refusal is returned as its status with the text in riis_last_error(). */
#ifndef RIIS_TEST_INTERNALS_H
#define RIIS_TEST_INTERNALS_H

#include <riis/riis.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Bézier curves: degree 2 or 3, control[3 * (degree + 1)]. */
void bezier_evaluate(int degree, const double *control, double t, double *point);
void bezier_derivative(int degree, const double *control, double t, double *vector);
double bezier_arc_length(int degree, const double *control, double t0, double t1);
void bezier_split(int degree, const double *control, double t, double *left, double *right);
double bezier_flatness(int degree, const double *control);
/* t: one a point; errors: one fewer. */
riis_status bezier_flatten(int degree, const double *control, double max_error, int64_t *n_points, double **points,
                           double **t, double **errors);

/* Curves of n cubics that follow each other in the same direction: control[12 * n]. */
riis_status chain_flatten(int64_t n_pieces, const double *control, double max_error, int64_t *n_points, double **points,
                          double **t, double **errors);
double chain_length(int64_t n_pieces, const double *control);
void chain_at(int64_t n_pieces, const double *control, double share, double *point, double *tangent);
/* part has room for 12 * n_pieces; returns how many pieces there are in it. */
int64_t chain_between(int64_t n_pieces, const double *control, double share0, double share1, int reversed,
                      double *part);

/* O(u) of a patch of arcs from a base to an edge, and the bound on how far it is from linear. */
void bulge_at(int64_t n_base, const double *base, int64_t n_edge, const double *edge, double factor, double u,
              double *offset);
double bulge_linear_error(int64_t n_base, const double *base, int64_t n_edge, const double *edge, double factor,
                          double u0, double u1, double enough);

/* Polylines. */
double polyline_make(int64_t n, const double *points, int64_t *n_kept,
                     double *t); /* t has room for n; returns the length */
void polyline_evaluate(int64_t n, const double *points, double t, double *point);

/* Coons patches of four polylines: n[4] points each, sides in the order v0, v1, u0, u1. */
typedef struct quad_grid {
  int64_t n_u, n_v;
  double *u, *v, *points; /* points[3 * (j * n_u + i)] */
} quad_grid;
quad_grid coons_grid(const int64_t *n, const double *const *points, double max_merge_shift);
void coons_evaluate(const int64_t *n, const double *const *points, double u, double v, double *point);
void quad_grid_free(quad_grid *grid);
double quad_kappa(const double *p00, const double *p10, const double *p11, const double *p01);
double quad_split_error(const double *p00, const double *p10, const double *p11, const double *p01);

/* The decision kernel: returns the squared distance. */
double kernel_point_triangle(const double *p, const double *abc, double *point, double *barycentric);

/* The aortic valve's curves and patches at its default parameters, changed by one (name may be NULL). */
typedef struct patch_set {
  int64_t n_curves, n_patches, n_images;
  int32_t *degree;                           /* a curve */
  double *control;                           /* 12 a curve, in the cusp's frame */
  int64_t *sides;                            /* 4 a patch: v0, v1, u0, u1 */
  int64_t *patch;                            /* an image: which patch it is of */
  int32_t *leaflet_id, *patch_id, *mirrored; /* an image */
  double *frame;                             /* 12 an image: rows of its rotation, translation */
} patch_set;
riis_status aortic_patches(const char *name, double value, patch_set *set);
/* Where an image puts a point of the cusp's frame. */
void patch_image_place(const patch_set *set, int64_t image, const double *p, double *placed);
void patch_set_free(patch_set *set);

/* The quads of a valve's patches, placed, with the bound on how far each is from its smooth patch at equal (u, v): those of every
 * patch's first image. The valve is of that kind with those parameters, one value each. */
typedef struct bounded_quad {
  int32_t patch_id;
  double u[2], v[2], error;
  double corners[4][3]; /* at (u0, v0), (u1, v0), (u1, v1), (u0, v1) */
} bounded_quad;
riis_status bounded_quads(const char *kind, int n_parameters, const char *const *names, const double *values,
                          double max_error, int64_t *n_quads, bounded_quad **quads);

/* Asks the Embree scene of the triangles xyz(9, n_triangles) and the loop over all of them with the same kernel for the
 * closest triangle to each point; returns for how many points squared distance (bits) or triangle differ. Points beyond
 * the limit must give none. */
int64_t scene_differs_from_loop(int64_t n_triangles, const double *xyz, int64_t n_points, const double *points,
                                double limit);

/* What the exception wall makes of "error", a riis Error of RIIS_INVALID_MESH with the text "error 7"; "memory",
 * std::bad_alloc; "standard", another standard exception, "boom"; "other", an int; "worker", an Error thrown by a
 * worker thread of a parallel loop; "nothing", none. */
riis_status wall_meets(const char *exception);

#ifdef __cplusplus
}
#endif

#endif
