/* SPDX-License-Identifier: Apache-2.0
 * Computes digests of the content of objects. Contents with equal bits have equal digests. Include after searches.h. */
#ifndef RIIS_TEST_DIGESTS_H
#define RIIS_TEST_DIGESTS_H

static riis_surface_options coarse; /* gives few triangles, for speed; set it before making a digest */

static inline uint64_t add_bytes(uint64_t digest, const void *data, size_t n) {
  const unsigned char *bytes = data;
  for (size_t i = 0; i < n; ++i) digest = (digest ^ bytes[i]) * UINT64_C(0x100000001b3);
  return digest;
}

static inline uint64_t add_surface(uint64_t digest, const riis_surface *surface) {
  const riis_triangles all = triangles_of(surface);
  const size_t n_vertices = (size_t)all.n_vertices, n_triangles = (size_t)all.n_triangles;
  const riis_surface_info info = info_of(surface);
  digest = add_bytes(digest, &info, offsetof(riis_surface_info, seconds_triangles));
  digest = add_bytes(digest, all.xyz, n_vertices * 24);
  if (all.uv) digest = add_bytes(digest, all.uv, n_vertices * 16);
  digest = add_bytes(digest, all.vertex_id, n_triangles * 24);
  digest = add_bytes(digest, all.leaflet_id, n_triangles * 4);
  digest = add_bytes(digest, all.patch_id, n_triangles * 4);
  for (int i = -3; i <= 3; ++i) {
    const riis_closest closest = closest_to(surface, 0.4 * i, 0.3, 0.2 * i);
    digest = add_bytes(digest, &closest, sizeof closest);
  }
  return digest;
}

static inline uint64_t add_valve(uint64_t digest, riis_valve *valve) {
  double opening;
  CHECK_OK(riis_valve_get(valve, "opening", 1, &opening));
  for (int half = 0; half <= 2; ++half) {
    riis_surface *surface = NULL;
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5 * half));
    const riis_status status = riis_surface_create(valve, &coarse, &surface);
    own(surface);
    digest = add_bytes(digest, &status, sizeof status); /* without an open state, the status is an error */
    if (!status) digest = add_surface(digest, surface);
    free_one_owned(surface);
  }
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  return add_bytes(digest, &opening, sizeof opening);
}

static inline uint64_t add_list(uint64_t digest, found_nodes found) {
  const size_t n = (size_t)found.n;
  digest = add_bytes(digest, &found.n, sizeof found.n);
  if (n == 0) return digest;
  digest = add_bytes(digest, found.node_id, n * 8);
  digest = add_bytes(digest, found.distance, n * 8);
  digest = add_bytes(digest, found.triangle_id, n * 8);
  return add_bytes(digest, found.leaflet_id, n * 4);
}

static inline uint64_t add_result(uint64_t digest, const riis_marks *result) {
  const riis_mark_stats stats = stats_of(result);
  const int64_t numbers[] = {stats.n_nodes, stats.n_marked, stats.n_within_limit, stats.search, stats.complete};
  digest = add_bytes(digest, numbers, sizeof numbers);
  return add_list(add_list(digest, marked_in(result)), within_in(result));
}

static inline uint64_t add_mesh(uint64_t digest, const riis_mesh *mesh) {
  const int owned_before = n_owned();
  riis_surface *surface = aortic_surface(&coarse);
  riis_mark_options options = mark_options();
  options.n_threads = 1;
  for (int32_t search = RIIS_SEARCH_EXHAUSTIVE; search <= RIIS_SEARCH_CLUSTERS; ++search) {
    riis_marks *result = new_result();
    options.search = search;
    const riis_status status = riis_mark_nodes(surface, mesh, &options, result);
    digest = add_bytes(digest, &status, sizeof status); /* the mesh may lack an adjacency */
    if (!status) digest = add_result(digest, result);
  }
  free_owned_after(owned_before);
  return digest;
}

#endif
