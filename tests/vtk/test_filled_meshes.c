/* SPDX-License-Identifier: Apache-2.0
 *
 * The demo's meshes that valves fill, made by gmsh: the attachment lies on the wall, so closed valves part inflow from outflow.
 * Flow is a flood fill over unmarked nodes. In the cylinders, which are wider, it passes around the outside. */
#include <riis/riis_vtk.h>

#include "../support/test_support.h"

#include "../support/handles.h"
#include "../support/searches.h"
#include "scratch.h"

#ifdef RIIS_GMSH

static const double half_thickness = 0.1;

typedef struct filled_mesh {
  int64_t n_nodes;
  const double *xyz;
  const int64_t *offsets;
  const int32_t *columns;
  riis_mesh *mesh;
  riis_surface *wall; /* with its two ends */
} filled_mesh;

/* --- Meshes ------------------------------------------------------------------------------------------------------------ */

static void run_gmsh(const char *arguments) {
  char command[2048];
  snprintf(command, sizeof command, "'%s' -nt 1 -v 2 %s", RIIS_GMSH, arguments);
  fflush(stdout);
  if (system(command) != 0) fail_msg("%s", command);
}

static void destroy_file(void *object) {
  riis_vtk_mesh *file = object;
  riis_vtk_mesh_destroy(&file);
}

static riis_surface *surface_in_file(const char *path) {
  riis_vtk_surface *file = NULL;
  riis_surface_arrays arrays;
  CHECK_OK(riis_vtk_surface_read(path, &file));
  CHECK_OK(riis_surface_arrays_init(&arrays, sizeof arrays));
  CHECK_OK(riis_vtk_surface_arrays(file, &arrays));
  riis_surface *surface = surface_from(&arrays, NULL);
  riis_vtk_surface_destroy(&file);
  return surface;
}

/* As ./run demo makes it. `numbers` are options of gmsh. */
static filled_mesh mesh_by_gmsh(const char *name, const char *numbers) {
  char arguments[1024];
  const char *surface = scratch_path("surface.msh"), *skin = scratch_path("skin.stl"),
             *volume = scratch_path("volume.vtk");
  snprintf(arguments, sizeof arguments, "-2 %s -format msh2 -o '%s' '%s/%s.geo'", numbers, surface, RIIS_DEMO, name);
  run_gmsh(arguments);
  snprintf(arguments, sizeof arguments, "-save -format stl -o '%s' '%s'", skin, surface);
  run_gmsh(arguments);
  snprintf(arguments, sizeof arguments, "-3 -format vtk -o '%s' '%s' '%s/fill.geo'", volume, surface, RIIS_DEMO);
  run_gmsh(arguments);

  filled_mesh filled = {.wall = surface_in_file(skin)};
  riis_vtk_mesh *file = NULL;
  riis_adjacency *adjacency = NULL;
  riis_csr csr;
  CHECK_OK(riis_vtk_mesh_read(volume, &file));
  own_object(file, destroy_file);
  CHECK_OK(riis_vtk_mesh_nodes(file, &filled.n_nodes, NULL, &filled.xyz));
  CHECK_OK(riis_vtk_mesh_adjacency(file, 0, &adjacency));
  own(adjacency);
  CHECK_OK(riis_adjacency_csr(adjacency, &csr, sizeof csr));
  assert_int_equal(csr.offset_bits, 64);
  assert_int_equal(csr.column_bits, 32);
  filled.offsets = csr.offsets, filled.columns = csr.columns;
  filled.mesh = mesh_of(filled.n_nodes, filled.xyz);
  CHECK_OK(riis_mesh_set_adjacency(filled.mesh, &csr));
  assert_in_range(filled.n_nodes, 50000, 200000);
  return filled;
}

/* --- Valves ------------------------------------------------------------------------------------------------------------ */

typedef struct test_valve {
  riis_valve *handle;
  int has_cusps;
} test_valve;

static test_valve mitral_valve(double opening) {
  test_valve valve = {new_valve("mitral"), 0};
  CHECK_OK(riis_valve_set_scalar(valve.handle, "opening", opening));
  return valve;
}

static test_valve paper_valve(void) { return (test_valve){new_valve("aortic"), 1}; }

/* The trileaflet valve's closed state, by the parameters of the paper's valve. */
static test_valve closing_valve(void) {
  static const struct {
    const char *name;
    double value;
  } of_cusps[] = {
      {"root_radius", 1.25}, {"leaflet_height", 1},         {"bending_height", 0.5}, {"leaflet_radius_in", 0},
      {"leaflet_angle", 60}, {"leaflet_radius_out", 1.25},  {"leaflet_power", 1},    {"bending_radius_in", 0.4},
      {"bending_angle", 36}, {"bending_radius_out", 1.255}, {"bending_power", 1.8},  {"xq", -0.22},
      {"zq", -0.35}};
  const double left[3] = {0, 0, 120}, non_coronary[3] = {0, 0, -120};
  test_valve valve = {new_valve("aortic"), 1};
  for (size_t i = 0; i < sizeof of_cusps / sizeof *of_cusps; ++i)
    CHECK_OK(riis_valve_set_scalar(valve.handle, of_cusps[i].name, of_cusps[i].value));
  CHECK_OK(riis_valve_set(valve.handle, "left.rotation", 3, left));
  CHECK_OK(riis_valve_set(valve.handle, "non_coronary.rotation", 3, non_coronary));
  return valve;
}

/* The vertices at which the valve is attached, (3, n): the sides u = 1 of cusps, the sides v = 0 of mitral patches. */
static int64_t attachment_of(const riis_surface *surface, int has_cusps, double *xyz) {
  const surface_content all = surface_content_of(surface);
  int64_t n = 0;
  for (int64_t i = 0; i < all.n_vertices; ++i) {
    if (has_cusps ? all.uv[2 * i] != 1 : all.uv[2 * i + 1] != 0) continue;
    memcpy(xyz + 3 * n++, all.xyz + 3 * i, 3 * sizeof *xyz);
  }
  return n;
}

static double largest_distance_to_wall(const filled_mesh *in, const riis_surface *surface, int has_cusps) {
  double *xyz = own(malloc((size_t)info_of(surface).n_vertices * 3 * sizeof *xyz)), largest = 0;
  const int64_t n = attachment_of(surface, has_cusps, xyz);
  assert_true(n > 50);
  for (int64_t i = 0; i < n; ++i)
    largest = fmax(largest, closest_to(in->wall, xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]).distance);
  return largest;
}

/* --- Flow -------------------------------------------------------------------------------------------------------------- */

static void range_of_z(const filled_mesh *in, double *lowest, double *highest) {
  *lowest = INFINITY, *highest = -INFINITY;
  for (int64_t i = 0; i < in->n_nodes; ++i) {
    *lowest = fmin(*lowest, in->xyz[3 * i + 2]);
    *highest = fmax(*highest, in->xyz[3 * i + 2]);
  }
}

/* Tells whether unmarked nodes join the two ends of the mesh, none of which may be marked. */
static int is_joined(const filled_mesh *in, const uint8_t *marks) {
  double lowest, highest;
  int64_t *stack = own(malloc((size_t)in->n_nodes * sizeof *stack)), n = 0, n_last = 0;
  uint8_t *seen = own(calloc((size_t)in->n_nodes, 1));
  range_of_z(in, &lowest, &highest);
  for (int64_t i = 0; i < in->n_nodes; ++i) {
    const double z = in->xyz[3 * i + 2];
    if (z > lowest + 1e-9 && z < highest - 1e-9) continue;
    assert_int_equal(marks[i], 0);
    if (z < lowest + 1e-9)
      seen[i] = 1, stack[n++] = i;
    else
      ++n_last;
  }
  assert_true(n > 100 && n_last > 100);
  while (n > 0) {
    const int64_t i = stack[--n];
    if (in->xyz[3 * i + 2] >= highest - 1e-9) return 1;
    for (int64_t k = in->offsets[i]; k < in->offsets[i + 1]; ++k) {
      const int64_t j = in->columns[k];
      if (!marks[j] && !seen[j]) seen[j] = 1, stack[n++] = j;
    }
  }
  return 0;
}

/* The longest edge with a node near the surface. */
static double longest_near(const filled_mesh *in, const double *distance) {
  double longest = 0;
  for (int64_t i = 0; i < in->n_nodes; ++i)
    for (int64_t k = in->offsets[i]; k < in->offsets[i + 1] && distance[i] <= 2 * half_thickness; ++k) {
      const double *a = in->xyz + 3 * i, *b = in->xyz + 3 * in->columns[k];
      longest = fmax(
          longest, sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2])));
    }
  return longest;
}

typedef struct flow {
  double to_wall, longest_edge;
  int passes;
} flow;

static flow flow_through(const filled_mesh *in, test_valve valve, const char *name) {
  const int owned_before = n_owned();
  riis_surface_options options = surface_options();
  options.half_thickness = half_thickness;
  riis_surface *surface = new_surface(valve.handle, &options);
  riis_mark_result *result = new_result();
  riis_mark_options marking = mark_options();
  marking.distance_limit = 2 * half_thickness;
  uint8_t *marks = own(malloc((size_t)in->n_nodes));
  double *distance = own(malloc((size_t)in->n_nodes * sizeof *distance));
  CHECK_OK(riis_mark_nodes(surface, in->mesh, &marking, result));
  CHECK_OK(riis_mark_result_dense(result, in->n_nodes, 1e30, marks, distance, NULL, NULL));
  const flow found = {largest_distance_to_wall(in, surface, valve.has_cusps), longest_near(in, distance),
                      is_joined(in, marks)};
  printf("%s: %lld nodes, attachment at most %.4f from the wall, longest edge near the valve %.4f, flow %s\n", name,
         (long long)in->n_nodes, found.to_wall, found.longest_edge, found.passes ? "passes" : "does not pass");
  free_owned_after(owned_before);
  free_one_owned(valve.handle);
  return found;
}

/* The valve fills the mesh, and the edges are short enough for the half thickness to close what is left at the wall: an edge that
 * passes there is at most `to_wall` from the attachment, so one of its nodes is at most to_wall and half an edge away. */
static void expect_filled(flow found) {
  CHECK_AT_MOST(found.to_wall, 0.5 * half_thickness);
  CHECK_AT_MOST(found.to_wall + 0.5 * found.longest_edge, half_thickness);
}

/* --- Tests ------------------------------------------------------------------------------------------------------------- */

static void closed_cusps_seal_their_root(void **state) {
  (void)state;
  const filled_mesh root = mesh_by_gmsh("aortic_root", "");
  const flow found = flow_through(&root, closing_valve(), "closed aortic valve in its root");
  expect_filled(found);
  assert_int_equal(found.passes, 0);
  /* Without one cusp there is flow. */
  test_valve torn = closing_valve();
  CHECK_OK(riis_valve_set_scalar(torn.handle, "left.leaflet_radius_in", 0.5));
  assert_int_equal(flow_through(&root, torn, "with a cusp that does not reach the axis").passes, 1);
}

static void closed_mitral_valve_seals_its_tube(void **state) {
  (void)state;
  const filled_mesh tube = mesh_by_gmsh("mitral_tube", "");
  for (int step = 0; step <= 4; ++step) {
    const flow found = flow_through(&tube, mitral_valve(0.25 * step),
                                    step ? "opening mitral valve in its tube" : "closed mitral valve in its tube");
    expect_filled(found);
    assert_int_equal(found.passes, step > 0);
  }
}

/* Its cusps end at different radii, 0.13 apart at a commissure. So no wall is within half a half thickness of all ends. Flow passes
 * through the middle. */
static void the_papers_valve_leaks_in_its_root(void **state) {
  (void)state;
  const filled_mesh root = mesh_by_gmsh("aortic_root", "-setnumber paper 1");
  flow found = flow_through(&root, paper_valve(), "the paper's aortic valve in its root");
  CHECK_AT_MOST(found.to_wall, 0.08);
  assert_int_equal(found.passes, 1);
  test_valve reaching = paper_valve();
  CHECK_OK(riis_valve_set_scalar(reaching.handle, "leaflet_radius_in", 0.02));
  assert_int_equal(flow_through(&root, reaching, "with cusps that reach the axis").passes, 0);
}

static void flow_passes_around_in_cylinders(void **state) {
  (void)state;
  const filled_mesh wide = mesh_by_gmsh("mitral_cylinder", "");
  const flow found = flow_through(&wide, mitral_valve(0), "closed mitral valve in a wider cylinder");
  assert_true(found.to_wall > 2 * half_thickness);
  assert_int_equal(found.passes, 1);
}

#endif

int main(void) {
#ifdef RIIS_GMSH
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(closed_cusps_seal_their_root),
      cmocka_unit_test(closed_mitral_valve_seals_its_tube),
      cmocka_unit_test(the_papers_valve_leaks_in_its_root),
      cmocka_unit_test(flow_passes_around_in_cylinders),
  };
  return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
#else
  printf("no gmsh: skipped\n");
  return 77;
#endif
}
