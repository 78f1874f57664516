/* SPDX-License-Identifier: Apache-2.0
 * Tests surfaces from the caller's arrays: layouts, ids, triangles without area, and winding. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

/* Two triangles are a unit square in z = 0. A third triangle lies 5 above this square. */
static const double xyz[21] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 5, 1, 0, 5, 0, 1, 5};
static const int32_t ids[9] = {0, 1, 2, 0, 2, 3, 4, 5, 6};
static const int32_t leaflets[3] = {7, 8, 9};

TEST(every_layout_gives_the_same_surface) {
  double x[7], y[7], z[7];
  int32_t ids32[9];
  int64_t ids64[9];
  for (int i = 0; i < 7; ++i) x[i] = xyz[3 * i], y[i] = xyz[3 * i + 1], z[i] = xyz[3 * i + 2];
  for (int layout = 0; layout < 8; ++layout) {
    const int owned_before = n_owned();
    const int one_based = layout & 1, wide = layout & 2, separate = layout & 4;
    riis_surface_arrays arrays = triangle_arrays(7, xyz, 3, ids);
    for (int i = 0; i < 9; ++i) ids32[i] = ids[i] + one_based, ids64[i] = ids[i] + one_based;
    arrays.index_base = one_based;
    arrays.id_bits = wide ? 64 : 32;
    arrays.vertex_ids = wide ? (const void *)ids64 : ids32;
    arrays.leaflet_id = leaflets;
    if (separate) arrays.x = x, arrays.y = y, arrays.z = z, arrays.stride = 1;
    riis_surface *surface = surface_from(&arrays, NULL);
    memset(ids32, -1, sizeof ids32); /* the library must have copied the arrays */
    memset(ids64, -1, sizeof ids64);
    CHECK_NEAR(info_of(surface).area, 1.5, 1e-15);
    const riis_closest a = closest_to(surface, 0.9, 0.1, 1), b = closest_to(surface, 0.1, 0.9, -1),
                       c = closest_to(surface, 0.1, 0.1, 7);
    assert_int_equal(a.triangle_id, 0);
    assert_int_equal(a.leaflet_id, 7);
    assert_int_equal(a.side, 1);
    assert_int_equal(b.triangle_id, 1);
    assert_int_equal(b.leaflet_id, 8);
    assert_int_equal(b.side, -1);
    assert_int_equal(c.triangle_id, 2);
    assert_int_equal(c.leaflet_id, 9);
    CHECK_NEAR(c.distance, 2, 1e-15);
    free_owned_after(owned_before);
  }
}

TEST(quads_are_cut_along_the_first_diagonal) {
  static const int32_t quad[4] = {0, 1, 2, 3};
  riis_surface_arrays arrays = triangle_arrays(7, xyz, 1, quad);
  arrays.corners_per_face = 4;
  riis_surface *surface = surface_from(&arrays, NULL);
  assert_int_equal(info_of(surface).n_triangles, 2);
  assert_int_equal(closest_to(surface, 0.9, 0.1, 1).triangle_id, 0);
  assert_int_equal(closest_to(surface, 0.1, 0.9, 1).triangle_id, 1);
  assert_int_equal(closest_to(surface, 0.1, 0.9, 1).leaflet_id, 0);
  const double *uv = triangles_of(surface).uv;
  assert_null(uv);
}

typedef struct {
  int warnings;
  char last[256];
} heard;

static void listen(void *user_data, int32_t level, const char *message) {
  heard *to = user_data;
  if (level == RIIS_LOG_WARNING) ++to->warnings, snprintf(to->last, sizeof to->last, "%s", message);
}

TEST(zero_area_is_refused_or_skipped_with_ids_kept) {
  /* Triangle 1 repeats a vertex, triangle 2 is collinear, and triangle 3 is a needle of height 1e-13. */
  const double points[27] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 0.5, 1e-13, 0, 0, 0, 5, 1, 0, 5, 0, 1, 5};
  const int32_t with_bad[15] = {0, 1, 2, 0, 0, 3, 0, 1, 4, 0, 1, 5, 6, 7, 8};
  riis_surface_arrays arrays = triangle_arrays(9, points, 5, with_bad);
  riis_surface_options options = surface_options();
  riis_surface *surface = NULL;
  heard log = {0, ""};
  CHECK_REFUSED(RIIS_INVALID_SURFACE, "face 1|0, 0, 3|zero area",
                riis_surface_create_from_arrays(&arrays, &options, &surface));
  assert_null(surface);
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  riis_set_log(listen, &log);
  surface = surface_from(&arrays, &options);
  riis_set_log(NULL, NULL);
  assert_int_equal(log.warnings, 1);
  assert_non_null(strstr(log.last, "3 of 5 triangles"));
  assert_int_equal(info_of(surface).n_triangles, 2);
  assert_int_equal(info_of(surface).n_zero_area, 3);
  const int64_t *triangle_id = triangles_of(surface).triangle_id;
  assert_int_equal(triangle_id[0], 0);
  assert_int_equal(triangle_id[1], 4);
  assert_int_equal(closest_to(surface, 0.1, 0.1, 7).triangle_id,
                   4); /* the caller's number of the triangle, not its position among the remaining triangles */
  free_one_owned(surface);

  arrays.n_faces = 3;
  arrays.vertex_ids = with_bad + 3; /* only triangles without area */
  CHECK_REFUSED(RIIS_INVALID_SURFACE, "none of the 3 faces",
                riis_surface_create_from_arrays(&arrays, &options, &surface));
}

TEST(tiny_and_huge_surfaces_have_area) {
  for (int power = -50; power <= 50; power += 10) {
    const int owned_before = n_owned();
    const double s = pow(10, power), points[9] = {0, 0, 0, s, 0, 0, 0, s, 0};
    const int32_t one[3] = {0, 1, 2};
    riis_surface_arrays arrays = triangle_arrays(3, points, 1, one);
    riis_surface *surface = surface_from(&arrays, NULL);
    const riis_closest closest = closest_to(surface, 0.25 * s, 0.25 * s, -2 * s);
    CHECK_NEAR(closest.distance / s, 2, 1e-14);
    CHECK_NEAR(closest.normal[2], 1, 1e-15);
    assert_int_equal(closest.side, -1);
    free_owned_after(owned_before);
  }
}

TEST(winding_is_the_callers_unless_flipped) {
  riis_surface_arrays arrays = triangle_arrays(7, xyz, 3, ids);
  riis_surface_options options = surface_options();
  options.flip_normals = 1;
  riis_surface *kept = surface_from(&arrays, NULL), *flipped = surface_from(&arrays, &options);
  CHECK_NEAR(closest_to(kept, 0.9, 0.1, 1).normal[2], 1, 0);
  CHECK_NEAR(closest_to(flipped, 0.9, 0.1, 1).normal[2], -1, 0);
  assert_int_equal(closest_to(kept, 0.9, 0.1, 1).side, 1);
  assert_int_equal(closest_to(flipped, 0.9, 0.1, 1).side, -1);
}

/* Two triangles lie back to back. At the common edges, the triangles' normals add up to 0 except for rounding. The side of a
 * point therefore follows from the reported triangle alone. */
TEST(side_of_folded_faces_is_the_triangles_own) {
  const double points[9] = {0.1, 0.2, 0.3, 1.7, 0.4, 0.1, 0.3, 1.9, 0.7};
  const int32_t faces[6] = {0, 1, 2, 1, 0, 2};
  riis_surface_arrays arrays = triangle_arrays(3, points, 2, faces);
  riis_surface *surface = surface_from(&arrays, NULL);
  for (int i = 1; i <= 20; ++i)
    for (int sign = -1; sign <= 1; sign += 2) {
      const riis_closest closest = closest_to(surface, points[0], points[1], points[2] + sign * 0.05 * i);
      double height = 0;
      const double difference[3] = {0 - (closest.point[0] - points[0]), 0 - (closest.point[1] - points[1]),
                                    points[2] + sign * 0.05 * i - closest.point[2]};
      for (int c = 0; c < 3; ++c) height += difference[c] * closest.normal[c];
      assert_int_equal(closest.side, height > 0 ? 1 : -1);
    }
}

TEST(update_replaces_the_content) {
  riis_surface_arrays arrays = triangle_arrays(7, xyz, 3, ids);
  riis_surface_options options = surface_options();
  options.half_thickness = 0.25;
  riis_surface *surface = surface_from(&arrays, &options);
  arrays.n_faces = 2;
  CHECK_OK(riis_surface_update_from_arrays(surface, &arrays, NULL));
  assert_int_equal(info_of(surface).n_triangles, 2);
  CHECK_SAME(info_of(surface).half_thickness, 0.25);
  double moved[21];
  memcpy(moved, xyz, sizeof xyz);
  moved[4] = NAN;
  arrays.x = moved, arrays.y = moved + 1, arrays.z = moved + 2;
  CHECK_REFUSED(RIIS_INVALID_SURFACE, "y of vertex 1 is nan", riis_surface_update_from_arrays(surface, &arrays, NULL));
  assert_int_equal(info_of(surface).n_triangles, 2);
  CHECK_NEAR(closest_to(surface, 0.9, 0.1, 1).distance, 1, 0);
}

/* An update with vertices alone keeps the faces of the last arrays. Such an update equals an update with faces and vertices. */
TEST(vertices_alone_keep_the_faces) {
  enum { n = 30 };
  random_source rng = random_start("test_user_surface");
  double *soup, moved[9 * n], velocity[9 * n];
  int32_t *soup_ids, leaflet_id[n];
  random_soup(&rng, n, 0.5, &soup, &soup_ids);
  for (int i = 0; i < n; ++i) leaflet_id[i] = i % 3;
  riis_surface_arrays arrays = triangle_arrays(3 * n, soup, n, soup_ids);
  arrays.leaflet_id = leaflet_id;
  riis_surface_options options = surface_options();
  options.flip_normals = 1;
  riis_surface *surface = surface_from(&arrays, &options);
  for (int step = 0; step < 5; ++step) {
    for (int i = 0; i < 9 * n; ++i) {
      moved[i] = soup[i] + 0.1 * random_between(&rng, -1, 1);
      velocity[i] = random_between(&rng, -1, 1);
    }
    riis_surface_arrays vertices = triangle_arrays(3 * n, moved, 0, NULL);
    vertices.vx = velocity, vertices.vy = velocity + 1, vertices.vz = velocity + 2;
    vertices.velocity_stride = 3;
    CHECK_OK(riis_surface_update_from_arrays(surface, &vertices, NULL));
    vertices.n_faces = n, vertices.vertex_ids = soup_ids, vertices.leaflet_id = leaflet_id;
    riis_surface *whole = surface_from(&vertices, &options);
    const riis_triangles a = triangles_of(surface), b = triangles_of(whole);
    assert_int_equal(a.n_triangles, b.n_triangles);
    assert_memory_equal(a.xyz, b.xyz, 9 * n * sizeof *a.xyz);
    assert_memory_equal(a.vertex_id, b.vertex_id, 3 * n * sizeof *a.vertex_id);
    assert_memory_equal(a.leaflet_id, b.leaflet_id, n * sizeof *a.leaflet_id);
    assert_memory_equal(velocity_of(surface), velocity_of(whole), 9 * n * sizeof *velocity);
    for (int i = 0; i < 50; ++i) {
      const double p[3] = {random_between(&rng, -2, 2), random_between(&rng, -2, 2), random_between(&rng, -2, 2)};
      CHECK_SAME(closest_to(surface, p[0], p[1], p[2]).distance, closest_to(whole, p[0], p[1], p[2]).distance);
    }
    free_one_owned(whole);
  }
}

/* A triangle that temporarily had no area is used again. */
TEST(a_skipped_triangle_comes_back) {
  const double open[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, shut[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0};
  const int32_t faces[6] = {0, 1, 2, 1, 3, 2};
  const riis_surface_arrays arrays = triangle_arrays(4, open, 2, faces);
  riis_surface_options options = surface_options();
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  riis_surface *surface = surface_from(&arrays, &options);
  riis_surface_arrays vertices = triangle_arrays(4, shut, 0, NULL);
  CHECK_OK(riis_surface_update_from_arrays(surface, &vertices, NULL));
  assert_int_equal(info_of(surface).n_triangles, 1);
  assert_int_equal(info_of(surface).n_zero_area, 1);
  vertices.x = open, vertices.y = open + 1, vertices.z = open + 2;
  CHECK_OK(riis_surface_update_from_arrays(surface, &vertices, NULL));
  assert_int_equal(info_of(surface).n_triangles, 2);
  assert_int_equal(closest_to(surface, 0.9, 0.9, 1).triangle_id, 1);
}

TEST(vertices_alone_are_refused_without_their_faces) {
  const double square[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const int32_t faces[3] = {0, 1, 2}, leaflet_id[1] = {0};
  const riis_surface_arrays arrays = triangle_arrays(3, square, 1, faces);
  riis_surface_arrays vertices = triangle_arrays(4, square, 0, NULL);
  riis_surface *surface = surface_from(&arrays, NULL), *none = NULL;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays.n_vertices is 4|faces are for 3 vertices",
                riis_surface_update_from_arrays(surface, &vertices, NULL));
  vertices.n_vertices = 3;
  vertices.leaflet_id = leaflet_id;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays.leaflet_id|without faces",
                riis_surface_update_from_arrays(surface, &vertices, NULL));
  vertices.leaflet_id = NULL;
  vertices.n_faces = 1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays.vertex_ids is NULL",
                riis_surface_update_from_arrays(surface, &vertices, NULL));
  vertices.n_faces = 0;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays.vertex_ids is NULL",
                riis_surface_create_from_arrays(&vertices, NULL, &none));
  CHECK_OK(riis_surface_update_from_arrays(surface, &vertices, NULL));
  riis_valve *valve = new_valve("mitral");
  CHECK_OK(riis_surface_update(surface, valve, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays.vertex_ids is NULL|no faces to keep",
                riis_surface_update_from_arrays(surface, &vertices, NULL));
}

/* A closed body with sharp edges. Points inside are recognised even if the closest point is on an edge or a corner. On an edge or
 * a corner, the normal of a single face would give the wrong side. */
TEST(side_at_edges_and_corners_of_a_wedge) {
  /* A thin tetrahedron. The dihedral angles are far below and far above 90 degrees. */
  const double points[12] = {0, 0, 0, 4, 0, 0, 2, 0.5, 0, 2, 0.25, 0.3};
  const int32_t faces[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
  riis_surface_arrays arrays = triangle_arrays(4, points, 4, faces);
  riis_surface *surface = surface_from(&arrays, NULL);
  random_source rng = random_start("side_at_edges_and_corners_of_a_wedge");
  int n_inside = 0, n_edge = 0;
  for (int trial = 0; trial < 50000; ++trial) {
    const double p[3] = {random_between(&rng, -1, 5), random_between(&rng, -0.5, 1), random_between(&rng, -0.5, 0.8)};
    /* Returns whether the point is inside all four planes. */
    int inside = 1;
    for (int f = 0; f < 4; ++f) {
      const double *a = points + 3 * faces[3 * f], *b = points + 3 * faces[3 * f + 1],
                   *c = points + 3 * faces[3 * f + 2];
      const double n[3] = {(b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]),
                           (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]),
                           (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])};
      if (n[0] * (p[0] - a[0]) + n[1] * (p[1] - a[1]) + n[2] * (p[2] - a[2]) > 0) inside = 0;
    }
    const riis_closest closest = closest_to(surface, p[0], p[1], p[2]);
    if (closest.distance < 1e-9) continue;
    assert_int_equal(closest.side, inside ? -1 : 1);
    n_inside += inside;
    n_edge += closest.barycentric[0] == 0 || closest.barycentric[1] == 0 || closest.barycentric[2] == 0;
  }
  assert_true(n_inside > 100 && n_edge > 10000);
}

int main(void) { return run_cases(NULL, NULL); }
