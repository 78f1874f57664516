/* SPDX-License-Identifier: Apache-2.0
 * Compares marked nodes with an independent oracle and with analytic shapes. The tests cover lists, dense arrays, limits, masks,
 * threads and reused results. */
#include <riis/riis.h>

#include "oracle.h"
#include "test_support.h"

#include "handles.h"
#include "searches.h"

static random_source rng;

static double *random_nodes(int64_t n, double r, double z0, double z1) {
  double *xyz = own(malloc((size_t)n * 3 * sizeof *xyz));
  for (int64_t i = 0; i < n; ++i) {
    xyz[3 * i] = random_between(&rng, -r, r);
    xyz[3 * i + 1] = random_between(&rng, -r, r);
    xyz[3 * i + 2] = random_between(&rng, z0, z1);
  }
  return xyz;
}

TEST(aortic_marks_equal_the_oracle) {
  enum { n = 4000 };
  riis_surface *surface = aortic_surface(NULL);
  double *xyz = random_nodes(n, 1.6, -1.2, 0.3);
  riis_mesh *mesh = mesh_of(n, xyz);
  riis_marks *result = new_result();
  const double *vertices = triangles_of(surface).xyz;
  const int64_t n_triangles = triangles_of(surface).n_triangles;
  const int64_t *vertex_id = triangles_of(surface).vertex_id;
  const int32_t *leaflet_id = triangles_of(surface).leaflet_id;
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  const found_nodes marked = marked_in(result);
  int64_t at = 0;
  for (int64_t i = 0; i < n; ++i) {
    int64_t triangle;
    const double expected = (double)oracle_distance(xyz + 3 * i, n_triangles, vertex_id, vertices, &triangle);
    if (fabs(expected - 0.1) < 1e-12) continue; /* near the limit, either answer is right */
    const int is_listed = at < marked.n && marked.node_id[at] == i;
    assert_int_equal(is_listed, expected <= 0.1);
    if (!is_listed) continue;
    CHECK_NEAR(marked.distance[at], expected, 1e-13);
    assert_int_equal(marked.leaflet_id[at], leaflet_id[marked.triangle_id[at]]);
    /* Checks that the reported triangle lies at the reported distance. */
    double abc[9];
    for (int k = 0; k < 3; ++k)
      memcpy(abc + 3 * k, vertices + 3 * vertex_id[3 * marked.triangle_id[at] + k], 3 * sizeof *abc);
    CHECK_NEAR((double)oracle_point_triangle(xyz + 3 * i, abc), expected, 1e-13);
    ++at;
  }
  assert_int_equal(at, marked.n);
  assert_true(marked.n > 200);
  const riis_mark_stats stats = stats_of(result);
  assert_int_equal(stats.n_nodes, n);
  assert_int_equal(stats.n_marked, marked.n);
  assert_int_equal(stats.n_within_limit, marked.n);
  assert_int_equal(stats.search, RIIS_SEARCH_EXHAUSTIVE);
  assert_int_equal(stats.complete, 1);
  assert_true(stats.n_queries >= marked.n && stats.n_queries <= n);
  assert_true(stats.seconds > 0);
}

/* The nodes of a lattice around the rectangle [0,4] x [0,2] in z = 0. Arithmetic gives the number of nodes within 1/2, including
 * nodes exactly at 1/2. */
TEST(lattice_around_a_rectangle_is_counted) {
  const double corners[12] = {0, 0, 0, 4, 0, 0, 4, 2, 0, 0, 2, 0};
  const int32_t quad[4] = {0, 1, 2, 3};
  riis_surface_arrays arrays = triangle_arrays(4, corners, 1, quad);
  arrays.corners_per_face = 4;
  riis_surface_options options = surface_options();
  options.half_thickness = 0.5;
  riis_surface *surface = surface_from(&arrays, &options);
  enum { m = 25, n = m * m * m };
  double *xyz = own(malloc(3 * n * sizeof *xyz));
  int64_t expected = 0;
  for (int i = 0; i < n; ++i) { /* spacing 1/4 from -1, so all coordinates are exact */
    double *p = xyz + 3 * i;
    p[0] = -1 + 0.25 * (i % m), p[1] = -1 + 0.25 * (i / m % m), p[2] = -1 + 0.25 * (i / m / m);
    const double dx = fmax(fmax(-p[0], p[0] - 4), 0), dy = fmax(fmax(-p[1], p[1] - 2), 0);
    expected += dx * dx + dy * dy + p[2] * p[2] <= 0.25;
  }
  riis_mesh *mesh = mesh_of(n, xyz);
  riis_marks *result = new_result();
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  assert_int_equal(marked_in(result).n, expected);
  assert_true(expected > 500);
}

TEST(wider_limit_lists_more_and_marks_the_same) {
  enum { n = 20000 };
  riis_surface *surface = aortic_surface(NULL);
  double *xyz = random_nodes(n, 1.6, -1.2, 0.3);
  riis_mesh *mesh = mesh_of(n, xyz);
  riis_marks *narrow = new_result(), *wide = new_result();
  riis_mark_options options = mark_options();
  options.distance_limit = 0.25;
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, narrow));
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, wide));
  const found_nodes a = marked_in(narrow), b = marked_in(wide), c = within_in(wide), d = within_in(narrow);
  assert_int_equal(a.n, b.n);
  assert_int_equal(a.n, d.n);
  assert_true(c.n > b.n);
  assert_memory_equal(a.node_id, b.node_id, (size_t)a.n * sizeof *a.node_id);
  assert_memory_equal(a.distance, b.distance, (size_t)a.n * sizeof *a.distance);
  assert_memory_equal(a.triangle_id, b.triangle_id, (size_t)a.n * sizeof *a.triangle_id);
  assert_memory_equal(a.leaflet_id, b.leaflet_id, (size_t)a.n * sizeof *a.leaflet_id);
  int64_t n_marked = 0;
  for (int64_t i = 0; i < c.n; ++i) {
    assert_true(c.distance[i] <= 0.25);
    if (i > 0) assert_true(c.node_id[i] > c.node_id[i - 1]);
    n_marked += c.distance[i] <= 0.1;
  }
  assert_int_equal(n_marked, b.n);
  assert_int_equal(stats_of(wide).n_within_limit, c.n);

  /* Dense arrays: the call writes every entry. A node beyond the limit gets the far value. */
  static uint8_t mark[n];
  static double distance[n];
  static int64_t triangle_id[n];
  static int32_t leaflet_id[n];
  memset(mark, 77, sizeof mark);
  CHECK_OK(dense_of(wide, n, RIIS_FAR_DISTANCE, mark, distance, triangle_id, leaflet_id));
  for (int64_t i = 0, at = 0; i < n; ++i) {
    const int listed = at < c.n && c.node_id[at] == i;
    CHECK_SAME(distance[i], listed ? c.distance[at] : 1e30);
    assert_int_equal(triangle_id[i], listed ? c.triangle_id[at] : -1);
    assert_int_equal(leaflet_id[i], listed ? c.leaflet_id[at] : -1);
    assert_int_equal(mark[i], listed && c.distance[at] <= 0.1);
    at += listed;
  }
  /* Each array may also be requested alone. A far value is accepted if it could not be a distance within the limit. */
  CHECK_OK(dense_of(wide, n, NAN, NULL, distance, NULL, NULL));
  assert_true(isnan(distance[0]) || within_in(wide).node_id[0] == 0);
  CHECK_OK(dense_of(wide, n, -1, mark, NULL, NULL, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "far_distance is 0.25|limit 0.25",
                dense_of(wide, n, 0.25, mark, NULL, NULL, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_nodes is 19999|20000", dense_of(wide, n - 1, 1e30, mark, NULL, NULL, NULL));
}

TEST(mask_leaves_nodes_out) {
  enum { n = 10000 };
  static uint8_t mask[n];
  riis_surface *surface = aortic_surface(NULL);
  double *xyz = random_nodes(n, 1.6, -1.2, 0.3);
  riis_mesh *mesh = mesh_of(n, xyz);
  riis_marks *all = new_result(), *some = new_result();
  riis_mark_options options = mark_options();
  /* The mask's entries are 0, 1 or 2. An entry above 0 selects its node. */
  for (int i = 0; i < n; ++i) mask[i] = (uint8_t)(random_bits(&rng) % 3);
  options.node_mask = mask;
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, all));
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, some));
  const found_nodes a = marked_in(all), b = marked_in(some);
  int64_t at = 0;
  for (int64_t i = 0; i < a.n; ++i) {
    if (!mask[a.node_id[i]]) continue;
    assert_int_equal(b.node_id[at], a.node_id[i]);
    CHECK_SAME(b.distance[at], a.distance[i]);
    ++at;
  }
  assert_int_equal(b.n, at);
  assert_true(at > 0 && at < a.n);
  memset(mask, 0, sizeof mask); /* an empty mask finds nothing, which is not an error */
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, some));
  const int64_t *node_id = (const int64_t *)&options;
  const int64_t n_marked = marked_list(some).n_nodes;
  node_id = marked_list(some).node_id;
  assert_int_equal(n_marked, 0);
  assert_null(node_id);
}

TEST(any_number_of_threads_gives_the_same_bits) {
  enum { n = 60000 };
  riis_surface *surface = aortic_surface(NULL);
  double *xyz = random_nodes(n, 1.6, -1.2, 0.3);
  riis_mesh *mesh = mesh_of(n, xyz);
  riis_marks *one = new_result(), *many = new_result();
  riis_mark_options options = mark_options();
  options.distance_limit = 0.2;
  options.n_threads = 1;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, one));
  assert_int_equal(stats_of(one).n_threads, 1);
  const found_nodes a = within_in(one);
  for (int threads = 2; threads <= 5; ++threads)
    for (int repeat = 0; repeat < 3; ++repeat) {
      options.n_threads = threads;
      CHECK_OK(riis_mark_nodes(surface, mesh, &options, many));
      assert_int_equal(stats_of(many).n_threads, threads); /* the threads must really have run */
      const found_nodes b = within_in(many);
      assert_int_equal(a.n, b.n);
      assert_memory_equal(a.node_id, b.node_id, (size_t)a.n * sizeof *a.node_id);
      assert_memory_equal(a.distance, b.distance, (size_t)a.n * sizeof *a.distance);
      assert_memory_equal(a.triangle_id, b.triangle_id, (size_t)a.n * sizeof *a.triangle_id);
    }
}

TEST(coordinates_may_move_and_results_are_reused) {
  enum { n = 5000 };
  riis_surface *surface = aortic_surface(NULL);
  double *xyz = random_nodes(n, 1.6, -1.2, 0.3);
  riis_mesh *mesh = mesh_of(n, xyz);
  riis_marks *result = new_result();
  assert_int_equal(marked_in(result).n, 0); /* an update leaves no marks */
  assert_int_equal(stats_of(result).n_nodes, 0);
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  const int64_t n_before = marked_in(result).n;
  for (int i = 0; i < n; ++i) xyz[3 * i + 2] += 10; /* moves the nodes away from the valve */
  CHECK_OK(riis_mesh_update(mesh, n, xyz, xyz + 1, xyz + 2, 3));
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  assert_int_equal(marked_in(result).n, 0);
  assert_int_equal(stats_of(result).n_queries, 0);
  for (int i = 0; i < n; ++i) xyz[3 * i + 2] -= 10;
  CHECK_OK(riis_mesh_update(mesh, n, xyz, xyz + 1, xyz + 2, 3));
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  assert_true(llabs(marked_in(result).n - n_before) <= 2); /* z + 10 - 10 rounds, so a few marks may differ */
  /* A coordinate becomes infinite or NaN without an update of the handle. A search that reads the coordinate names it in a
   * refusal, and the result stays as it was. The search over clusters uses the coordinates that it copied earlier. */
  const found_nodes kept = marked_in(result);
  const int64_t spoilt = kept.node_id[kept.n / 2];
  char text[64];
  snprintf(text, sizeof text, "y of node %lld is nan", (long long)spoilt);
  xyz[3 * spoilt + 1] = NAN;
  riis_mark_options options = mark_options();
  for (options.search = RIIS_SEARCH_AUTO; options.search <= RIIS_SEARCH_CLUSTERS; ++options.search) {
    if (options.search == RIIS_SEARCH_NEIGHBOR || options.search == RIIS_SEARCH_PAPER) continue;
    if (options.search == RIIS_SEARCH_EXHAUSTIVE)
      CHECK_REFUSED(RIIS_INVALID_MESH, text, riis_mark_nodes(surface, mesh, &options, result));
    else
      CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
    assert_int_equal(marked_in(result).n, kept.n);
  }
  CHECK_REFUSED(RIIS_INVALID_MESH, text, riis_mesh_update(mesh, n, xyz, xyz + 1, xyz + 2, 3));
}

TEST(separate_coordinate_arrays_are_the_same_mesh) {
  enum { n = 5000 };
  riis_surface *surface = aortic_surface(NULL);
  double *xyz = random_nodes(n, 1.6, -1.2, 0.3);
  static double x[n], y[n], z[n];
  for (int i = 0; i < n; ++i) x[i] = xyz[3 * i], y[i] = xyz[3 * i + 1], z[i] = xyz[3 * i + 2];
  riis_mesh *a = mesh_of(n, xyz), *b = NULL;
  CHECK_OK(riis_mesh_create(n, x, y, z, 1, &b));
  own(b);
  riis_marks *of_a = new_result(), *of_b = new_result();
  CHECK_OK(riis_mark_nodes(surface, a, NULL, of_a));
  CHECK_OK(riis_mark_nodes(surface, b, NULL, of_b));
  const found_nodes l = marked_in(of_a), m = marked_in(of_b);
  assert_int_equal(l.n, m.n);
  assert_memory_equal(l.node_id, m.node_id, (size_t)l.n * sizeof *l.node_id);
}

/* The test passes coordinates as doubles and as floats. The coordinates are exact in single precision. */
enum { n_exact = 5000 };
static double exact[3 * n_exact];
static float single[3 * n_exact];

static void make_exact(double shift) {
  for (int i = 0; i < 3 * n_exact; ++i) {
    single[i] = (float)(i % 3 < 2 ? random_between(&rng, -1.6, 1.6) : random_between(&rng, -1.2, 0.3) + shift);
    exact[i] = single[i];
  }
}

static riis_points exact_points(int real_bits) {
  riis_points points = points_of(n_exact, exact, exact + 1, exact + 2, 3);
  if (real_bits == 32) points.x = single, points.y = single + 1, points.z = single + 2, points.real_bits = 32;
  return points;
}

static riis_marks *marks_of(const riis_surface *surface, const riis_mesh *mesh) {
  riis_marks *marks = new_result();
  riis_mark_options options = mark_options();
  options.distance_limit = 0.2;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, marks));
  return marks;
}

/* A mesh of copied coordinates gets the marks of a mesh that borrows them, even after the caller's arrays have changed. A mesh
 * may change from copying to borrowing and back. */
TEST(copies_and_single_precision_are_the_same_mesh) {
  riis_surface *surface = aortic_surface(NULL);
  for (int real_bits = 32; real_bits <= 64; real_bits += 32) {
    const int owned_before = n_owned();
    make_exact(0);
    riis_mesh *borrowed = mesh_of(n_exact, exact), *copied = NULL;
    riis_points points = exact_points(real_bits);
    CHECK_OK(riis_mesh_create_copy(&points, &copied));
    own(copied);
    riis_marks *expected = marks_of(surface, borrowed);
    memset(exact, -1, sizeof exact);
    memset(single, -1, sizeof single);
    assert_true(marked_in(expected).n > 100 && same_results(expected, marks_of(surface, copied)));

    make_exact(0.1);
    CHECK_OK(riis_mesh_update_copy(copied, &points));
    CHECK_OK(riis_mesh_update(borrowed, n_exact, exact, exact + 1, exact + 2, 3));
    expected = marks_of(surface, borrowed);
    assert_true(same_results(expected, marks_of(surface, copied)));
    CHECK_OK(riis_mesh_update(copied, n_exact, exact, exact + 1, exact + 2, 3)); /* borrows */
    make_exact(0.2);
    CHECK_OK(riis_mesh_update(copied, n_exact, exact, exact + 1, exact + 2, 3));
    CHECK_OK(riis_mesh_update_copy(borrowed, &points)); /* copies */
    expected = marks_of(surface, copied);
    memset(exact, -1, sizeof exact);
    assert_true(same_results(expected, marks_of(surface, borrowed)));
    free_owned_after(owned_before);
  }

  /* A refused call leaves the mesh as it was. */
  make_exact(0);
  riis_points points = exact_points(32);
  riis_mesh *mesh = NULL;
  CHECK_OK(riis_mesh_create_copy(&points, &mesh));
  own(mesh);
  riis_marks *expected = marks_of(surface, mesh);
  single[3 * 77 + 1] = NAN;
  CHECK_REFUSED(RIIS_INVALID_MESH, "y of node 77 is nan", riis_mesh_update_copy(mesh, &points));
  points.real_bits = 16;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "nodes.real_bits is 16;", riis_mesh_update_copy(mesh, &points));
  points = exact_points(64);
  points.stride = 0;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "nodes.stride is 0;", riis_mesh_update_copy(mesh, &points));
  points.stride = 3, points.n_points = -1;
  CHECK_REFUSED(RIIS_INVALID_MESH, "nodes.n_points is -1;", riis_mesh_update_copy(mesh, &points));
  points.n_points = 1, points.z = NULL;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "z is NULL", riis_mesh_update_copy(mesh, &points));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "nodes is NULL", riis_mesh_update_copy(mesh, NULL));
  assert_true(same_results(expected, marks_of(surface, mesh)));
}

/* Numbers in single precision give the same bits as equal numbers in double precision. The test covers points, vertices,
 * velocities and frames. */
TEST(single_precision_is_double_precision) {
  make_exact(0);
  riis_surface *surface = aortic_surface(NULL);
  static double distance[2][n_exact];
  riis_closest_arrays arrays;
  CHECK_OK(riis_closest_arrays_init(&arrays, sizeof arrays));
  for (int i = 0; i < 2; ++i) {
    const riis_points points = exact_points(i ? 32 : 64);
    arrays.distance = distance[i];
    CHECK_OK(riis_closest_points(surface, &points, NULL, &arrays));
  }
  assert_memory_equal(distance[0], distance[1], sizeof distance[0]);

  enum { n_faces = n_exact / 3, n_frames = 5, n_corners = n_exact / n_frames };
  static int32_t ids[3 * n_faces];
  for (int i = 0; i < 3 * n_faces; ++i) ids[i] = i;
  riis_surface_arrays faces = triangle_arrays(3 * n_faces, exact, n_faces, ids);
  faces.vx = exact + 1, faces.vy = exact + 2, faces.vz = exact, faces.velocity_stride = 3;
  riis_surface *wide = surface_from(&faces, NULL);
  faces.x = single, faces.y = single + 1, faces.z = single + 2;
  faces.vx = single + 1, faces.vy = single + 2, faces.vz = single;
  faces.real_bits = 32;
  riis_surface *narrow = surface_from(&faces, NULL);
  assert_true(is_same_content(wide, narrow));
  assert_memory_equal(velocity_of(wide), velocity_of(narrow), 9 * n_faces * sizeof(double));

  riis_keyframe_arrays frames;
  CHECK_OK(riis_keyframe_arrays_init(&frames, sizeof frames));
  static const double time[n_frames] = {0, 1, 2.5, 3, 4};
  frames.n_keys = n_frames, frames.n_vertices = n_corners, frames.time = time;
  frames.interpolation = RIIS_INTERPOLATION_CUBIC;
  riis_surface_arrays frame_faces = triangle_arrays(n_corners, NULL, n_corners / 3, ids);
  riis_surface *moved[2];
  for (int i = 0; i < 2; ++i) {
    frames.xyz = i ? (const void *)single : exact;
    frames.real_bits = i ? 32 : 64;
    riis_keyframes *keyframes = NULL;
    CHECK_OK(riis_keyframes_create(&frame_faces, &frames, &keyframes));
    CHECK_OK(riis_surface_create_from_keyframes(keyframes, 1.7, 0.2, NULL, &moved[i]));
    own(moved[i]);
    riis_keyframes_destroy(&keyframes);
  }
  assert_true(is_same_content(moved[0], moved[1]));
  assert_memory_equal(velocity_of(moved[0]), velocity_of(moved[1]), 3 * n_corners * sizeof(double));
}

int main(void) {
  rng = random_start("test_marking");
  return run_cases(NULL, NULL);
}
