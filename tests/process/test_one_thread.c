/* SPDX-License-Identifier: Apache-2.0
 * n_threads = 1 starts no thread: the process always has as many threads as before the first call. With little work, the default,
 * 0, starts no thread either. If 2 threads are requested, the process has more threads, which shows that the test counts
 * correctly. Calls on one thread come first, because OpenMP and TBB keep the threads that they start. */
#include <riis/riis.h>

#include "test_support.h"

#include <dirent.h>

#include "handles.h"
#include "searches.h"

static int n_threads_at_first; /* 1, or more with the threads of a sanitizer */
static int32_t n_threads_asked;

/* Returns the number of threads of this process. */
static int n_threads_now(void) {
  DIR *tasks = opendir("/proc/self/task");
  assert_non_null(tasks);
  int n = 0;
  for (const struct dirent *entry = readdir(tasks); entry; entry = readdir(tasks)) n += entry->d_name[0] != '.';
  assert_int_equal(closedir(tasks), 0);
  return n;
}

#define CALL_ALONE(call)                                                                                     \
  do {                                                                                                       \
    CHECK_OK(call);                                                                                          \
    const int call_n = n_threads_now();                                                                      \
    if (call_n != n_threads_at_first) fail_msg("%s started %d threads", #call, call_n - n_threads_at_first); \
  } while (0)

enum { most_side = 40, most_nodes = most_side * most_side * most_side };

static int64_t n_side, n_nodes, n_faces;
static double xyz[3 * most_nodes];
static int64_t owner[most_nodes], neighbor[most_nodes], corners_of_cells[8 * most_nodes], label[most_nodes];

static void fill_arrays(int64_t side) {
  n_side = side, n_nodes = side * side * side, n_faces = n_nodes - 1;
  for (int64_t i = 0; i < n_nodes; ++i) {
    const int64_t at[3] = {i % n_side, i / n_side % n_side, i / (n_side * n_side)};
    for (int c = 0; c < 3; ++c) xyz[3 * i + c] = -2.5 + 5.0 * (double)at[c] / (double)(n_side - 1);
  }
  for (int64_t i = 0; i < n_faces; ++i) owner[i] = i, neighbor[i] = i + 1;
}

/* Returns the number of hexahedra of the lattice. */
static int64_t fill_cells(void) {
  const int64_t step[8] = {0,
                           1,
                           1 + n_side,
                           n_side,
                           n_side * n_side,
                           n_side * n_side + 1,
                           n_side * n_side + n_side + 1,
                           n_side * n_side + n_side};
  int64_t n = 0;
  for (int64_t i = 0; i < n_nodes; ++i) {
    if (i % n_side == n_side - 1 || i / n_side % n_side == n_side - 1 || i / (n_side * n_side) == n_side - 1) continue;
    for (int k = 0; k < 8; ++k) corners_of_cells[8 * n + k] = i + step[k];
    ++n;
  }
  return n;
}

static riis_surface_options options_with(int32_t n_threads, int32_t triangulation, double tolerance) {
  riis_surface_options options = surface_options();
  options.n_threads = n_threads;
  options.triangulation = triangulation;
  options.tolerance = tolerance;
  return options;
}

/* The open mitral valve has so many triangles that threads may start by default. */
static void close_valve(riis_valve *valve) { CHECK_OK(riis_valve_set_scalar(valve, "opening", 0)); }

static void check_surfaces(int32_t triangulation, double tolerance) {
  static const char *const kinds[] = {"aortic", "trileaflet", "mitral", "bileaflet", "coapting"};
  const riis_surface_options options = options_with(n_threads_asked, triangulation, tolerance);
  riis_crossing_options of_crossings;
  CHECK_OK(riis_crossing_options_init(&of_crossings, sizeof of_crossings));
  of_crossings.n_threads = n_threads_asked;
  const int n_kinds = n_threads_asked == 1 ? 5 : 4; /* the coapting valve may start threads by default */
  for (int k = 0; k < n_kinds; ++k) {
    riis_valve *valve = new_valve(kinds[k]), *before = new_valve(kinds[k]);
    riis_surface *surface = NULL;
    riis_crossing_list crossings;
    if (n_threads_asked == 0) close_valve(valve);
    CALL_ALONE(riis_surface_create(valve, &options, &surface));
    own(surface);
    for (int step = 1; step < 4; ++step) {
      CALL_ALONE(riis_valve_set_scalar(valve, "opening", 0.1 * step));
      CALL_ALONE(riis_surface_update(surface, valve, NULL));
      CALL_ALONE(riis_surface_update_moving(surface, valve, before, 0.1, NULL, NULL));
      CALL_ALONE(find_crossings_in(surface, &of_crossings, &crossings));
      closest_to(surface, 0.3, 0.2, 0.1);
      assert_int_equal(n_threads_now(), n_threads_at_first);
    }
  }
}

TEST(surfaces_of_valves) {
  check_surfaces(RIIS_TRIANGULATION_ADAPTED, 0.05);
  check_surfaces(RIIS_TRIANGULATION_FIXED, 0.05);
  if (is_short_test()) return; /* on one thread, a larger mesh would run the same code */
  check_surfaces(RIIS_TRIANGULATION_ADAPTED, 0.005);
  check_surfaces(RIIS_TRIANGULATION_FIXED, 0.01);
}

TEST(other_distances) {
  const double point[3] = {0.3, 0.2, 0.1};
  for (int32_t distance = RIIS_MEASURE_SAMPLING; distance <= RIIS_MEASURE_MINIMIZATION; ++distance) {
    riis_surface_options options = options_with(n_threads_asked, RIIS_TRIANGULATION_ADAPTED, 0.05);
    options.measure = distance;
    options.measure_tolerance = 0.5;
    riis_surface *surface = NULL;
    riis_closest closest;
    CALL_ALONE(riis_surface_create(new_valve("aortic"), &options, &surface));
    own(surface);
    CALL_ALONE(riis_closest_point(surface, point, &closest, sizeof closest));
  }
}

TEST(surfaces_from_arrays) {
  enum { n_triangles = 3000 };
  random_source random = random_start("one thread");
  double *corners;
  int32_t *ids;
  random_soup(&random, n_triangles, 0.1, &corners, &ids);
  const riis_surface_arrays arrays = triangle_arrays(3 * n_triangles, corners, n_triangles, ids);
  const riis_surface_options options = options_with(n_threads_asked, RIIS_TRIANGULATION_ADAPTED, 0.05);
  riis_surface *surface = NULL;
  CALL_ALONE(riis_surface_create_from_arrays(&arrays, &options, &surface));
  own(surface);
  CALL_ALONE(riis_surface_update_from_arrays(surface, &arrays, NULL));

  const double time = 0;
  riis_keyframe_arrays frames;
  riis_keyframes *keyframes = NULL;
  CHECK_OK(riis_keyframe_arrays_init(&frames, sizeof frames));
  frames.n_keys = 1, frames.n_vertices = 3 * n_triangles, frames.time = &time, frames.xyz = corners;
  CALL_ALONE(riis_keyframes_create(&arrays, &frames, &keyframes));
  const riis_status updated = riis_surface_update_from_keyframes(surface, keyframes, 0, 0, NULL);
  riis_keyframes_destroy(&keyframes);
  CALL_ALONE(updated);
}

/* Makes adjacencies of all kinds. The last adjacency in the list is that of the lattice. */
static riis_adjacency *make_adjacencies(void) {
  riis_mesh_cells cells;
  riis_mesh_faces faces;
  riis_adjacency *made[3] = {NULL, NULL, NULL};
  CHECK_OK(riis_mesh_faces_init(&faces, sizeof faces));
  faces.n_cells = n_nodes, faces.n_faces = n_faces, faces.owner = owner, faces.neighbor = neighbor;
  faces.id_bits = 64, faces.n_threads = n_threads_asked;
  CALL_ALONE(riis_adjacency_create_from_faces(&faces, made));
  own(made[0]);
  CHECK_OK(riis_mesh_cells_init(&cells, sizeof cells));
  cells.n_nodes = n_nodes, cells.n_cells = fill_cells(), cells.node_ids = corners_of_cells, cells.nodes_per_cell = 8;
  cells.id_bits = 64, cells.n_threads = n_threads_asked;
  CALL_ALONE(riis_adjacency_create_from_cells(&cells, made + 1));
  own(made[1]);
  CALL_ALONE(riis_adjacency_create_from_grid(n_side, n_side, n_side, n_threads_asked, made + 2));
  return own(made[2]);
}

static void check_markings(int64_t side) {
  fill_arrays(side);
  const riis_surface_options of_surface = options_with(n_threads_asked, RIIS_TRIANGULATION_ADAPTED, 0.05);
  riis_valve *valve = new_valve("mitral");
  close_valve(valve);
  riis_surface *surface = new_surface(valve, &of_surface);
  CALL_ALONE(riis_surface_update_moving(surface, valve, valve, 1, NULL, NULL));
  riis_mesh *mesh = NULL;
  CALL_ALONE(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));
  own(mesh);
  riis_csr csr;
  CHECK_OK(riis_adjacency_get_csr(make_adjacencies(), &csr, sizeof csr));
  CALL_ALONE(riis_mesh_set_adjacency(mesh, &csr));
  CALL_ALONE(riis_mesh_prepare(mesh, n_threads_asked));
  CALL_ALONE(riis_mesh_update(mesh, n_nodes, xyz, xyz + 1, xyz + 2, 3));

  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  options.n_threads = n_threads_asked;
  options.fields = 255;
  for (options.search = RIIS_SEARCH_AUTO; options.search <= RIIS_SEARCH_CLUSTERS; ++options.search)
    for (int step = 0; step < 3; ++step) {
      CALL_ALONE(riis_mark_nodes(surface, mesh, &options, result));
      assert_int_equal(stats_of(result).n_threads, 1);
    }
  assert_true(stats_of(result).n_marked > 100);

  static double k[most_nodes], k_u[3 * most_nodes], distance[most_nodes];
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 1;
  CALL_ALONE(add_resistance_to(result, &resistance, n_nodes, k, k_u));
  CALL_ALONE(dense_of(result, n_nodes, RIIS_FAR_DISTANCE, NULL, distance, NULL, NULL));

  options.search = RIIS_SEARCH_AUTO;
  options.fields = 0;
  riis_leak_list leaks;
  riis_passage passage;
  const int64_t first = 0, last = n_nodes - 1;
  CALL_ALONE(find_leaks_in(surface, mesh, result, &options, &leaks));
  CALL_ALONE(riis_label_open_regions(mesh, result, &options, n_nodes, label, NULL));
  CALL_ALONE(find_passage_between(surface, mesh, &options, 1, &first, 1, &last, &passage, sizeof passage));

  riis_closest_options of_points;
  riis_closest_arrays found;
  CHECK_OK(riis_closest_options_init(&of_points, sizeof of_points));
  CHECK_OK(riis_closest_arrays_init(&found, sizeof found));
  of_points.n_threads = n_threads_asked;
  found.distance = distance;
  const int64_t n_points = n_threads_asked ? n_nodes : 2000;
  CALL_ALONE(closest_points_of(surface, n_points, xyz, xyz + 1, xyz + 2, 3, &of_points, &found));
}

TEST(markings) { check_markings(is_short_test() ? 25 : most_side); }

/* On a machine with one processor, the default never starts a thread. */
TEST(little_work_by_default) {
  n_threads_asked = 0;
  check_surfaces(RIIS_TRIANGULATION_ADAPTED, 0.05);
  check_surfaces(RIIS_TRIANGULATION_FIXED, 0.05);
  check_markings(25);
}

/* OpenMP and TBB each start at most one more thread. After a long wait for OpenMP's thread, the library starts a thread
 * itself. */
TEST(two_threads_are_more) {
  const riis_surface_options options = options_with(2, RIIS_TRIANGULATION_ADAPTED, 0.005);
  new_surface(new_valve("aortic"), &options);
  assert_in_range(n_threads_now(), n_threads_at_first + 1, n_threads_at_first + 3);
}

int main(void) {
  n_threads_at_first = n_threads_now();
  n_threads_asked = 1;
  return run_cases(NULL, NULL);
}
