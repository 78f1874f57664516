/* SPDX-License-Identifier: Apache-2.0
 * Wraps calls of riis. Some functions take plain arguments instead of structs, and return riis's status. Other functions return
 * the content of a handle as a struct. */
#ifndef RIIS_TEST_CALLS_H
#define RIIS_TEST_CALLS_H

#include <riis/riis.h>

#include <stddef.h>
#include <string.h>

static inline riis_points points_of(int64_t n, const double *x, const double *y, const double *z, int64_t stride) {
  riis_points points;
  riis_points_init(&points, sizeof points);
  points.n_points = n;
  points.x = x, points.y = y, points.z = z;
  points.stride = stride;
  return points;
}

static inline riis_status closest_points_of(const riis_surface *surface, int64_t n, const double *x, const double *y,
                                            const double *z, int64_t stride, const riis_closest_options *options,
                                            const riis_closest_arrays *arrays) {
  const riis_points points = points_of(n, x, y, z, stride);
  return riis_closest_points(surface, &points, options, arrays);
}

static inline riis_status dense_of(const riis_marks *marks, int64_t n_nodes, double far_distance, uint8_t *mark,
                                   double *distance, int64_t *triangle_id, int32_t *leaflet_id) {
  riis_dense_arrays arrays;
  riis_dense_arrays_init(&arrays, sizeof arrays);
  arrays.n_nodes = n_nodes;
  arrays.far_distance = far_distance;
  arrays.mark = mark;
  arrays.distance = distance;
  arrays.triangle_id = triangle_id;
  arrays.leaflet_id = leaflet_id;
  return riis_marks_get_dense(marks, &arrays);
}

/* K (n_nodes) and K_u_surface (3, n_nodes) may be NULL. */
static inline riis_status add_resistance_to(const riis_marks *marks, const riis_resistance *resistance, int64_t n_nodes,
                                            double *K, double *K_u_surface) {
  riis_resistance_arrays arrays;
  riis_resistance_arrays_init(&arrays, sizeof arrays);
  arrays.n_nodes = n_nodes;
  arrays.K = K;
  for (int c = 0; K_u_surface && c < 3; ++c) arrays.K_u_surface[c] = K_u_surface + c;
  arrays.K_u_surface_stride = 3;
  return riis_marks_add_resistance(marks, resistance, &arrays);
}

/* velocity (3, n_nodes), weight (n_nodes). */
static inline riis_status add_reaction_to(const riis_marks *marks, const riis_resistance *resistance, int64_t n_nodes,
                                          const double *velocity, const double *weight, double *force) {
  riis_flow_arrays flow;
  riis_flow_arrays_init(&flow, sizeof flow);
  flow.n_nodes = n_nodes;
  for (int c = 0; velocity && c < 3; ++c) flow.velocity[c] = velocity + c;
  flow.velocity_stride = 3;
  flow.weight = weight;
  riis_reaction reaction;
  riis_reaction_init(&reaction, sizeof reaction);
  reaction.force = force;
  return riis_marks_add_reaction(marks, resistance, &flow, &reaction);
}

static inline riis_status band_sums_of(const riis_marks *marks, double inner, double outer, int64_t n_nodes,
                                       const double *value, const double *weight, riis_band_sums *sums,
                                       int64_t struct_size) {
  riis_band band;
  riis_band_init(&band, sizeof band);
  band.inner = inner;
  band.outer = outer;
  band.n_nodes = n_nodes;
  band.value = value;
  band.weight = weight;
  return riis_marks_get_band_sums(marks, &band, sums, struct_size);
}

static inline riis_status find_passage_between(const riis_surface *surface, const riis_mesh *mesh,
                                               const riis_mark_options *options, int64_t n_from, const int64_t *from,
                                               int64_t n_to, const int64_t *to, riis_passage *passage,
                                               int64_t struct_size) {
  riis_passage_ends ends;
  riis_passage_ends_init(&ends, sizeof ends);
  ends.n_from = n_from;
  ends.from = from;
  ends.n_to = n_to;
  ends.to = to;
  return riis_find_passage(surface, mesh, &ends, options, passage, struct_size);
}

/* Finds crossings, and returns the list without its arrays. */
static inline riis_status find_crossings_in(const riis_surface *surface, const riis_crossing_options *options,
                                            riis_crossing_list *list) {
  riis_crossings *crossings = NULL;
  riis_status status = riis_crossings_create(&crossings);
  if (status == RIIS_OK) status = riis_find_crossings(surface, options, crossings);
  if (status == RIIS_OK) status = riis_crossings_get_list(crossings, list, sizeof *list);
  if (status == RIIS_OK) list->triangle_id = NULL, list->point = list->depth = list->length = NULL;
  riis_crossings_destroy(&crossings);
  return status;
}

/* Finds leaks, and returns the list without its arrays. */
static inline riis_status find_leaks_in(const riis_surface *surface, const riis_mesh *mesh, const riis_marks *marks,
                                        const riis_mark_options *options, riis_leak_list *list) {
  riis_leaks *leaks = NULL;
  riis_status status = riis_leaks_create(&leaks);
  if (status == RIIS_OK) status = riis_find_leaks(surface, mesh, marks, options, leaks);
  if (status == RIIS_OK) status = riis_leaks_get_list(leaks, list, sizeof *list);
  if (status == RIIS_OK) list->node_id = NULL, list->length = list->distance = NULL;
  riis_leaks_destroy(&leaks);
  return status;
}

/* Returns the triangles of a surface, or none if riis refuses to give them. */
static inline riis_triangles triangles_of(const riis_surface *surface) {
  riis_triangles triangles;
  memset(&triangles, 0, sizeof triangles);
  (void)riis_surface_get_triangles(surface, &triangles, sizeof triangles);
  return triangles;
}

/* Returns a list of the marks. The list's n_nodes is -1 if riis refuses the call. */
static inline riis_mark_list list_of(const riis_marks *marks, int32_t which) {
  riis_mark_list list;
  memset(&list, 0, sizeof list);
  if (riis_marks_get_list(marks, which, &list, sizeof list) != RIIS_OK) list.n_nodes = -1;
  return list;
}
static inline riis_mark_list marked_list(const riis_marks *marks) { return list_of(marks, RIIS_LIST_MARKED); }
static inline riis_mark_list within_list(const riis_marks *marks) { return list_of(marks, RIIS_LIST_WITHIN_LIMIT); }

#endif
