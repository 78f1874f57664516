/* SPDX-License-Identifier: Apache-2.0
 * Measures valves with three cusps from their triangles: the free edges, the orifice, and the sectors in which the cusps stay.
 * Include after handles.h. */
#ifndef RIIS_TEST_CUSP_CHECKS_H
#define RIIS_TEST_CUSP_CHECKS_H

static const double cusp_degree = 3.14159265358979323846 / 180;

static inline riis_valve *valve_at(const char *kind, double opening) {
  riis_valve *valve = new_valve(kind);
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  return valve;
}

/* Adds the lengths of the edges on the sides v = 1 of the top patches. */
static inline void free_edge_lengths(const riis_surface *surface, double *lengths) {
  const riis_triangles all = triangles_of(surface);
  for (int cusp = 0; cusp < 3; ++cusp) lengths[cusp] = 0;
  for (int64_t t = 0; t < all.n_triangles; ++t)
    for (int k = 0; k < 3; ++k) {
      const int64_t a = all.vertex_id[3 * t + k], b = all.vertex_id[3 * t + (k + 1) % 3];
      if (all.patch_id[t] % 2 == 0 || all.uv[2 * a + 1] != 1 || all.uv[2 * b + 1] != 1) continue;
      const double *p = all.xyz + 3 * a, *q = all.xyz + 3 * b;
      lengths[all.leaflet_id[t]] += hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]);
    }
}

/* Returns the area of the opening inside a disc around the axis, seen along the axis. The uncovered area is counted on a grid of
 * n x n squares. */
static inline double orifice_area(const riis_surface *surface, double radius, int n) {
  const riis_triangles all = triangles_of(surface);
  const double h = 2 * radius / n;
  unsigned char *covered = own(calloc((size_t)n * (size_t)n, 1));
  for (int64_t t = 0; t < all.n_triangles; ++t) {
    const double *p[3];
    double low[2] = {1e30, 1e30}, high[2] = {-1e30, -1e30};
    for (int k = 0; k < 3; ++k) {
      p[k] = all.xyz + 3 * all.vertex_id[3 * t + k];
      for (int c = 0; c < 2; ++c) low[c] = fmin(low[c], p[k][c]), high[c] = fmax(high[c], p[k][c]);
    }
    int first[2], last[2];
    for (int c = 0; c < 2; ++c) {
      first[c] = (int)fmax(0, floor((low[c] + radius) / h - 1));
      last[c] = (int)fmin(n - 1, ceil((high[c] + radius) / h + 1));
    }
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) {
        const double x = (i + 0.5) * h - radius, y = (j + 0.5) * h - radius;
        int n_left = 0, n_right = 0;
        for (int k = 0; k < 3; ++k) {
          const double *a = p[k], *b = p[(k + 1) % 3];
          const double side = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
          n_left += side >= -1e-12, n_right += side <= 1e-12;
        }
        if (n_left == 3 || n_right == 3) covered[(size_t)j * (size_t)n + (size_t)i] = 1;
      }
  }
  int64_t n_open = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      n_open += hypot((i + 0.5) * h - radius, (j + 0.5) * h - radius) <= radius &&
                !covered[(size_t)j * (size_t)n + (size_t)i];
  free_one_owned(covered);
  return (double)n_open * h * h;
}

/* Returns how far a cusp extends beyond its sector, which is the wedge between its two commissures. Wedges are convex, so cusps
 * that stay inside their wedges do not cross. */
static inline double reach_out_of_sectors(const riis_surface *surface, const double *turn, const double *half_angle) {
  const riis_triangles all = triangles_of(surface);
  double worst = 0;
  for (int64_t i = 0; i < 3 * all.n_triangles; ++i) {
    const int cusp = all.leaflet_id[i / 3];
    const double *p = all.xyz + 3 * all.vertex_id[i];
    for (int side = -1; side <= 1; side += 2) {
      const double a = (turn[cusp] + side * half_angle[cusp]) * cusp_degree;
      worst = fmax(worst, side * (p[1] * cos(a) - p[0] * sin(a)));
    }
  }
  return worst;
}

/* Returns the least cosine of the angle between a triangle's normal and the direction outwards and up. A fold would reverse a
 * normal. */
static inline double least_uprightness(const riis_surface *surface, const double *turn) {
  const riis_triangles all = triangles_of(surface);
  double least = 1;
  for (int64_t t = 0; t < all.n_triangles; ++t) {
    const double *p[3], a = turn[all.leaflet_id[t]] * cusp_degree;
    double n[3];
    for (int k = 0; k < 3; ++k) p[k] = all.xyz + 3 * all.vertex_id[3 * t + k];
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      n[c] = (p[1][d] - p[0][d]) * (p[2][e] - p[0][e]) - (p[1][e] - p[0][e]) * (p[2][d] - p[0][d]);
    }
    const double up = (n[0] * cos(a) + n[1] * sin(a) + n[2]) / sqrt(2);
    least = fmin(least, up / hypot(hypot(n[0], n[1]), n[2]));
  }
  return least;
}

/* Checks 101 openings. Each free edge must keep the length that it has at opening 0, to within the given fraction. The orifice
 * must grow from each opening to the next. Cusps must not cross or fold. Returns the orifice at opening 1. */
static inline double check_opening(riis_valve *valve, double radius, const double *turn, const double *half_angle,
                                   double share, const char *name) {
  double at_rest[3] = {0, 0, 0}, least[3] = {1, 1, 1}, most[3] = {1, 1, 1}, orifice = -1;
  for (int i = 0; i <= 100; ++i) {
    double lengths[3];
    CHECK_OK(riis_valve_set_scalar(valve, "opening", i / 100.0));
    riis_surface *surface = new_surface(valve, NULL);
    free_edge_lengths(surface, i == 0 ? at_rest : lengths);
    if (i == 0) memcpy(lengths, at_rest, sizeof lengths);
    for (int cusp = 0; cusp < 3; ++cusp) {
      least[cusp] = fmin(least[cusp], lengths[cusp] / at_rest[cusp]);
      most[cusp] = fmax(most[cusp], lengths[cusp] / at_rest[cusp]);
    }
    CHECK_AT_MOST(reach_out_of_sectors(surface, turn, half_angle), 1e-14);
    assert_true(least_uprightness(surface, turn) > 0.2);
    if (i % 10 == 0) {
      const double wider = orifice_area(surface, radius, 300);
      assert_true(wider > orifice);
      orifice = wider;
    }
    free_one_owned(surface);
  }
  for (int cusp = 0; cusp < 3; ++cusp) {
    printf("%s, cusp %d: free edge %.3f, from %.3f to %.3f of it\n", name, cusp, at_rest[cusp], least[cusp],
           most[cusp]);
    assert_true(least[cusp] >= 1 - share && most[cusp] <= 1 + share);
  }
  printf("%s: orifice %.2f\n", name, orifice);
  return orifice;
}

/* Describes the nodes of a grid around the axis. */
enum { n_across = 67, n_up = 76, n_nodes = n_across * n_across * n_up };

/* Returns the coordinate of a grid node across the axis, from -radius to radius. */
static inline double grid_place(int i, double radius) { return radius * (2.0 * i / (n_across - 1) - 1); }

/* Marks the nodes near the surface in a grid of height 3, then fills the grid from below through all 26 neighbours. Where
 * `is_wall` (n_across, n_across) is set, the whole column of nodes is closed. Returns whether the fill reaches the top. */
static inline int leaks_between(const riis_surface *surface, const uint8_t *is_wall, double radius, double bottom) {
  double *nodes = own(malloc(3 * n_nodes * sizeof *nodes));
  uint8_t *is_closed = own(malloc(n_nodes * sizeof *is_closed));
  int32_t *queue = own(malloc(n_nodes * sizeof *queue));
  for (int32_t i = 0; i < n_nodes; ++i) {
    nodes[3 * i] = grid_place(i % n_across, radius);
    nodes[3 * i + 1] = grid_place(i / n_across % n_across, radius);
    nodes[3 * i + 2] = bottom + 3.0 * (double)(i / n_across / n_across) / (n_up - 1);
  }
  riis_mesh *mesh = mesh_of(n_nodes, nodes);
  riis_marks *result = NULL;
  CHECK_OK(riis_marks_create(&result));
  own(result);
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  CHECK_OK(dense_of(result, n_nodes, 1e30, is_closed, NULL, NULL, NULL));
  free_one_owned(result);
  free_one_owned(mesh);
  for (int64_t i = 0; i < n_nodes; ++i)
    if (is_wall[i % (n_across * n_across)]) is_closed[i] = 1;
  int64_t n = 0;
  for (int32_t i = 0; i < n_across * n_across; ++i)
    if (!is_closed[i]) is_closed[i] = 1, queue[n++] = i;
  assert_true(n > 1000);
  int leaks = 0;
  for (int64_t done = 0; done < n && !leaks; ++done) {
    const int at[3] = {queue[done] % n_across, queue[done] / n_across % n_across, queue[done] / n_across / n_across};
    leaks = at[2] == n_up - 1;
    for (int k = 0; k < 27; ++k) {
      const int x = at[0] + k % 3 - 1, y = at[1] + k / 3 % 3 - 1, z = at[2] + k / 9 - 1;
      if (x < 0 || x >= n_across || y < 0 || y >= n_across || z < 0 || z >= n_up) continue;
      const int32_t next = (z * n_across + y) * n_across + x;
      if (!is_closed[next]) is_closed[next] = 1, queue[n++] = next;
    }
  }
  free_one_owned(queue);
  free_one_owned(is_closed);
  free_one_owned(nodes);
  return leaks;
}

/* Fills a cylinder around the axis. */
static inline int leaks_through(riis_valve *valve, double radius, double bottom, double half_thickness) {
  uint8_t is_wall[n_across * n_across];
  riis_surface_options options = surface_options();
  options.half_thickness = half_thickness;
  for (int i = 0; i < n_across * n_across; ++i)
    is_wall[i] = hypot(grid_place(i % n_across, radius), grid_place(i / n_across, radius)) > radius;
  riis_surface *surface = new_surface(valve, &options);
  const int leaks = leaks_between(surface, is_wall, radius, bottom);
  free_one_owned(surface);
  return leaks;
}

#endif
