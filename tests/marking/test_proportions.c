/* SPDX-License-Identifier: Apache-2.0
 *
 * The library warns if the sizes of a mesh, a surface and a half thickness suggest different units. The warning comes once. There
 * is no warning for a distant part of a mesh. The warning depends on the bounding box of the nodes. The box is tested for every
 * layout of the coordinates. */
#include <pthread.h>
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

enum { n_side = 11, n_nodes = n_side * n_side * n_side };

typedef struct heard {
  pthread_mutex_t lock;
  int n;
  char last[512];
} heard;
static heard warnings = {PTHREAD_MUTEX_INITIALIZER, 0, ""};

static void listen(void *user_data, int32_t level, const char *message) {
  heard *to = user_data;
  if (level != RIIS_LOG_WARNING) return;
  pthread_mutex_lock(&to->lock);
  ++to->n;
  snprintf(to->last, sizeof to->last, "%s", message);
  pthread_mutex_unlock(&to->lock);
}

static int start_listening(void **state) {
  (void)state;
  warnings.n = 0;
  warnings.last[0] = 0;
  riis_set_log(listen, &warnings);
  return 0;
}

static int stop_listening(void **state) {
  riis_set_log(NULL, NULL);
  return free_owned(state);
}

static double box[3 * n_nodes];

/* Makes a mesh of nodes in a cube around a point. */
static riis_mesh *cube(double centre, double side) {
  for (int i = 0; i < n_nodes; ++i) {
    const int place[3] = {i % n_side, i / n_side % n_side, i / n_side / n_side};
    for (int k = 0; k < 3; ++k) box[3 * i + k] = centre + side * (place[k] / (double)(n_side - 1) - 0.5);
  }
  return mesh_of(n_nodes, box);
}

static void mark(const riis_surface *surface, const riis_mesh *mesh) {
  riis_mark_options options = mark_options();
  options.n_threads = 1;
  riis_marks *result = new_result();
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  free_one_owned(result);
}

/* Returns the number of warnings when the aortic valve is marked in a new mesh. */
static int n_warnings(double scale, double half_thickness, double centre, double side) {
  const int owned_before = n_owned();
  riis_surface_options options = surface_options();
  options.scale = scale;
  options.half_thickness = half_thickness;
  riis_surface *surface = aortic_surface(&options);
  riis_mesh *mesh = cube(centre, side);
  const int before = warnings.n;
  mark(surface, mesh);
  free_owned_after(owned_before);
  return warnings.n - before;
}

TEST_WITH(sizes_that_fit_are_no_news, start_listening, stop_listening) {
  assert_int_equal(n_warnings(1, RIIS_AUTO, 0, 4), 0);
  assert_int_equal(n_warnings(0.01, RIIS_AUTO, 0, 0.04), 0);
  assert_int_equal(n_warnings(10, RIIS_AUTO, 0, 400), 0);
  /* A mesh far from the valve may be one process's part of a larger mesh. */
  assert_int_equal(n_warnings(1, RIIS_AUTO, 100, 4), 0);
  assert_int_equal(n_warnings(1, RIIS_AUTO, 1e6, 0.2), 0);
  assert_int_equal(n_warnings(0.01, RIIS_AUTO, -3, 1), 0);
}

static void expect_text(const char *a, const char *b, const char *c) {
  const char *const parts[] = {a, b, c, "scale", "half_thickness"};
  for (int i = 0; i < 5; ++i)
    if (!strstr(warnings.last, parts[i])) fail_msg("\"%s\" is not in \"%s\"", parts[i], warnings.last);
  assert_null(strchr(warnings.last, '\n'));
}

TEST_WITH(sizes_that_do_not_fit_are_told, start_listening, stop_listening) {
  /* The valve is in centimetres, and the mesh in metres or micrometres. */
  assert_int_equal(n_warnings(1, 0.001, 0, 0.04), 1);
  expect_text("the surface is more than 50 times as large as the mesh", "0.04 (mesh of 1331 nodes)",
              "half thickness is 0.001");
  assert_int_equal(n_warnings(1, RIIS_AUTO, 0, 4e4), 1);
  expect_text("the mesh is more than 50 times as large as the surface", "40000 (mesh", "half thickness is 0.1");
  /* The half thickness is in centimetres, and the mesh and the surface are in another unit. */
  assert_int_equal(n_warnings(0.01, 0.1, 0, 0.04), 1);
  expect_text("the half thickness is larger than the surface", "0.04 (mesh", "half thickness is 0.1");
  assert_int_equal(n_warnings(0.3, 0.5, 0, 0.4), 1);
  expect_text("the half thickness is larger than the mesh", "0.4 (mesh", "half thickness is 0.5");
  /* If the size does not match, the warning also comes for a mesh far from the valve. */
  assert_int_equal(n_warnings(1, RIIS_AUTO, 1e6, 4e4), 1);
}

TEST_WITH(one_warning_a_mesh_and_surface, start_listening, stop_listening) {
  riis_surface *first = aortic_surface(NULL), *second = aortic_surface(NULL);
  riis_mesh *mesh = cube(0, 0.01);
  for (int step = 0; step < 5; ++step) {
    mark(first, mesh);
    mark(second, mesh);
    CHECK_OK(riis_mesh_update(mesh, n_nodes, box, box + 1, box + 2, 3));
  }
  assert_int_equal(warnings.n, 2);
  riis_mesh *other = mesh_of(n_nodes, box);
  mark(first, other);
  mark(first, other);
  assert_int_equal(warnings.n, 3);
  /* Surfaces are created and destroyed. A surface counts as new even if it has the address of an earlier surface. In the end, the
   * library's list of warned surfaces is full. */
  for (int i = 0; i < 20; ++i) {
    free_one_owned(second);
    second = aortic_surface(NULL);
    mark(second, other);
    assert_int_equal(warnings.n, 3 + (i < 7 ? i + 1 : 7));
  }
}

/* If there is no log function, a warning does not count as given. */
TEST_WITH(a_late_listener_is_told, start_listening, stop_listening) {
  riis_surface *surface = aortic_surface(NULL);
  riis_mesh *mesh = cube(0, 0.01);
  riis_set_log(NULL, NULL);
  mark(surface, mesh);
  riis_set_log(listen, &warnings);
  assert_int_equal(warnings.n, 0);
  mark(surface, mesh);
  mark(surface, mesh);
  assert_int_equal(warnings.n, 1);
}

typedef struct pair {
  const riis_surface *surface;
  const riis_mesh *mesh;
  riis_status status;
} pair;

static void *mark_by_thread(void *argument) {
  pair *const shared = argument;
  riis_mark_options options;
  riis_marks *result = NULL;
  shared->status = riis_mark_options_init(&options, sizeof options);
  options.n_threads = 1;
  if (!shared->status) shared->status = riis_marks_create(&result);
  for (int step = 0; step < 20 && !shared->status; ++step)
    shared->status = riis_mark_nodes(shared->surface, shared->mesh, &options, result);
  riis_marks_destroy(&result);
  return NULL;
}

TEST_WITH(threads_share_the_one_warning, start_listening, stop_listening) {
  enum { n_threads = 8 };
  riis_surface *surface = aortic_surface(NULL);
  riis_mesh *mesh = cube(0, 0.01);
  pthread_t threads[n_threads];
  pair shared[n_threads];
  for (int i = 0; i < n_threads; ++i) {
    shared[i] = (pair){surface, mesh, RIIS_OK};
    assert_int_equal(pthread_create(&threads[i], NULL, mark_by_thread, &shared[i]), 0);
  }
  for (int i = 0; i < n_threads; ++i) pthread_join(threads[i], NULL);
  for (int i = 0; i < n_threads; ++i) assert_int_equal(shared[i].status, RIIS_OK);
  assert_int_equal(warnings.n, 1);
}

/* A layout of nodes with a stride. The coordinate x is first or last. */
typedef struct layout {
  int64_t stride;
  int first[3]; /* the index of the first x, y and z */
} layout;
enum { n_layouts = 4, most_nodes = 1004, n_doubles = 5 * most_nodes };
static const layout layouts[n_layouts] = {
    {3, {0, 1, 2}}, {3, {2, 1, 0}}, {1, {0, most_nodes, 2 * most_nodes}}, {5, {1, 4, 2}}};
static double coordinates[n_doubles];

static double *coordinate(const layout *lies, int node, int axis) {
  return &coordinates[lies->first[axis] + lies->stride * node];
}

static riis_status create(const layout *lies, int n, riis_mesh **mesh) {
  return riis_mesh_create(n, coordinates + lies->first[0], coordinates + lies->first[1], coordinates + lies->first[2],
                          lies->stride, mesh);
}

/* One node is far from the surface, and all others are within a hundredth of it. The warning is absent only if the box contains
 * the far node. The test puts the far node into every lane of the registers, on every axis and in both directions. */
TEST_WITH(the_box_holds_every_node, start_listening, stop_listening) {
  riis_surface *surface = aortic_surface(NULL);
  for (int l = 0; l < n_layouts; ++l)
    for (int n = 1000; n < most_nodes; ++n)
      for (int node = n - 12; node < n; ++node)
        for (int axis = 0; axis < 3; ++axis)
          for (double far = -4; far <= 4; far += 4) {
            const int owned_before = n_owned();
            riis_mesh *mesh = NULL;
            for (int i = 0; i < n_doubles; ++i) coordinates[i] = 1e-6 * i;
            *coordinate(&layouts[l], node, axis) += far;
            CHECK_OK(create(&layouts[l], n, &mesh));
            own(mesh);
            const int before = warnings.n;
            mark(surface, mesh);
            if (warnings.n - before != (far == 0))
              fail_msg("layout %d, node %d of %d, axis %d at %g: %d warnings", l, node, n, axis, far,
                       warnings.n - before);
            free_owned_after(owned_before);
          }
}

/* Of two bad coordinates, the message names the first, wherever they are. */
TEST_WITH(the_first_bad_coordinate_is_named, start_listening, stop_listening) {
  const double bad[] = {NAN, INFINITY, -INFINITY, 1.1e60, -1.1e60};
  for (int l = 0; l < n_layouts; ++l)
    for (int n = 1; n < 14; ++n)
      for (int node = 0; node < n; ++node)
        for (int axis = 0; axis < 3; ++axis)
          for (int k = 0; k < 5; ++k) {
            riis_mesh *mesh = NULL;
            char text[64];
            for (int i = 0; i < n_doubles; ++i) coordinates[i] = i % 7;
            *coordinate(&layouts[l], node, axis) = bad[k];
            *coordinate(&layouts[l], n - 1, 2) = node == n - 1 && axis == 2 ? bad[k] : bad[(k + 1) % 5];
            snprintf(text, sizeof text, "%c of node %d is ", "xyz"[axis], node);
            CHECK_REFUSED(RIIS_INVALID_MESH, text, create(&layouts[l], n, &mesh));
            assert_null(mesh);
          }
  /* Large coordinates are accepted. */
  for (int i = 0; i < n_doubles; ++i) coordinates[i] = i % 2 ? 1e60 : -1e60;
  riis_mesh *mesh = NULL;
  CHECK_OK(create(&layouts[0], most_nodes, &mesh));
  own(mesh);
}

int main(void) { return run_cases(NULL, NULL); }
