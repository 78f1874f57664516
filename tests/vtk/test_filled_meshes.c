/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests the demo's meshes, which gmsh makes and which valves fill. The valve's attachment lies on the wall, so a closed valve
 * separates inflow from outflow. A flood fill over unmarked nodes stands for the flow. In a wider cylinder the flow passes around
 * the outside of the valve. */
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
  riis_surface *wall; /* the wall and the two ends of the mesh */
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
  CHECK_OK(riis_vtk_surface_read(path, NULL, &file));
  CHECK_OK(riis_surface_arrays_init(&arrays, sizeof arrays));
  CHECK_OK(riis_vtk_surface_get_arrays(file, &arrays, sizeof arrays));
  riis_surface *surface = surface_from(&arrays, NULL);
  riis_vtk_surface_destroy(&file);
  return surface;
}

/* Makes the mesh of a .geo file, as ./run demo does. `numbers` are options of gmsh. */
static filled_mesh mesh_by_gmsh(const char *path, const char *numbers) {
  char arguments[1024];
  const char *surface = scratch_path("surface.msh"), *skin = scratch_path("skin.stl"),
             *volume = scratch_path("volume.vtk");
  snprintf(arguments, sizeof arguments, "-2 %s -format msh2 -o '%s' '%s'", numbers, surface, path);
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
  CHECK_OK(riis_vtk_mesh_get_nodes(file, &filled.n_nodes, NULL, &filled.xyz));
  CHECK_OK(riis_vtk_mesh_create_adjacency(file, 0, &adjacency));
  own(adjacency);
  CHECK_OK(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
  assert_int_equal(csr.offset_bits, 64);
  assert_int_equal(csr.column_bits, 32);
  filled.offsets = csr.offsets, filled.columns = csr.columns;
  filled.mesh = mesh_of(filled.n_nodes, filled.xyz);
  CHECK_OK(riis_mesh_set_adjacency(filled.mesh, &csr));
  assert_in_range(filled.n_nodes, 50000, 200000);
  return filled;
}

/* --- Valves ------------------------------------------------------------------------------------------------------------ */

/* Returns the vertices at which a valve is attached. */
typedef enum attachment { side_u1, side_v0, housing } attachment;

typedef struct test_valve {
  riis_valve *handle;
  attachment at;
} test_valve;

static test_valve valve_at(const char *kind, double opening, attachment at) {
  test_valve valve = {new_valve(kind), at};
  CHECK_OK(riis_valve_set_scalar(valve.handle, "opening", opening));
  return valve;
}

static test_valve mitral_valve(double opening) { return valve_at("mitral", opening, side_v0); }
static test_valve trileaflet_valve(double opening) { return valve_at("trileaflet", opening, side_u1); }
static test_valve bileaflet_valve(double opening) { return valve_at("bileaflet", opening, housing); }
static test_valve paper_valve(void) { return valve_at("aortic", 0, side_u1); }

/* Returns the inner radius of the default bileaflet valve's housing. */
static double housing_radius(void) {
  riis_valve *valve = new_valve("bileaflet");
  double radius;
  CHECK_OK(riis_valve_get(valve, "radius", 1, &radius));
  free_one_owned(valve);
  return radius;
}

static int is_attached(const riis_triangles *all, int64_t vertex, attachment at) {
  const double *xyz = all->xyz + 3 * vertex, *uv = all->uv + 2 * vertex;
  if (at == housing) return hypot(xyz[0], xyz[1]) > 0.99 * housing_radius();
  return at == side_u1 ? uv[0] == 1 : uv[1] == 0;
}

static double largest_distance_to_wall(const filled_mesh *in, const riis_surface *surface, attachment at) {
  const riis_triangles all = triangles_of(surface);
  double largest = 0;
  int64_t n = 0;
  for (int64_t i = 0; i < all.n_vertices; ++i) {
    if (!is_attached(&all, i, at)) continue;
    largest = fmax(largest, closest_to(in->wall, all.xyz[3 * i], all.xyz[3 * i + 1], all.xyz[3 * i + 2]).distance);
    ++n;
  }
  assert_true(n >= 4);
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

/* Labels each unmarked node with the lowest id of its region. A flood fill finds each region. Marked nodes get -1. */
static void flood_fill(const filled_mesh *in, const uint8_t *marks, int64_t *label) {
  int64_t *stack = own(malloc((size_t)in->n_nodes * sizeof *stack));
  for (int64_t i = 0; i < in->n_nodes; ++i) label[i] = -1;
  for (int64_t first = 0; first < in->n_nodes; ++first) {
    if (marks[first] || label[first] >= 0) continue;
    int64_t n = 0;
    label[first] = first, stack[n++] = first;
    while (n > 0) {
      const int64_t i = stack[--n];
      for (int64_t k = in->offsets[i]; k < in->offsets[i + 1]; ++k) {
        const int64_t j = in->columns[k];
        if (!marks[j] && label[j] < 0) label[j] = first, stack[n++] = j;
      }
    }
  }
}

/* Finds the nodes at a given height. */
static int64_t nodes_at(const filled_mesh *in, double z, int64_t *ids) {
  int64_t n = 0;
  for (int64_t i = 0; i < in->n_nodes; ++i)
    if (fabs(in->xyz[3 * i + 2] - z) < 1e-9) ids[n++] = i;
  assert_true(n > 100);
  return n;
}

/* Returns whether unmarked nodes join the two ends of the mesh, and finds the half thickness that closes the valve. The library's
 * regions and its passage must agree with the flood fill. */
static int is_joined(const filled_mesh *in, const riis_surface *surface, const riis_mark_options *options,
                     const riis_marks *result, const uint8_t *marks, double *closing) {
  const size_t size = (size_t)in->n_nodes * sizeof(int64_t);
  int64_t *label = own(malloc(size)), *regions = own(malloc(size)), *lower = own(malloc(size)),
          *upper = own(malloc(size));
  double lowest, highest;
  range_of_z(in, &lowest, &highest);
  const int64_t n_lower = nodes_at(in, lowest, lower), n_upper = nodes_at(in, highest, upper);
  flood_fill(in, marks, label);
  int joined = 0;
  for (int64_t i = 0; i < n_lower; ++i)
    for (int64_t j = 0; j < n_upper && !joined; ++j)
      joined = label[lower[i]] == label[upper[j]] && label[lower[i]] >= 0;

  int64_t n_regions;
  riis_passage passage;
  CHECK_OK(riis_label_open_regions(in->mesh, result, options, in->n_nodes, regions, &n_regions));
  assert_memory_equal(regions, label, size);
  CHECK_OK(find_passage_between(surface, in->mesh, options, n_lower, lower, n_upper, upper, &passage, sizeof passage));
  assert_int_equal(passage.state, joined ? RIIS_PASSAGE_OPEN : RIIS_PASSAGE_CLOSED);
  *closing = passage.distance;
  return joined;
}

/* Returns the length of the longest edge that has a node near the surface. */
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
  riis_marks *result = new_result();
  riis_mark_options marking = mark_options();
  marking.distance_limit = 2 * half_thickness;
  uint8_t *marks = own(malloc((size_t)in->n_nodes));
  double *distance = own(malloc((size_t)in->n_nodes * sizeof *distance));
  CHECK_OK(riis_mark_nodes(surface, in->mesh, &marking, result));
  CHECK_OK(dense_of(result, in->n_nodes, 1e30, marks, distance, NULL, NULL));
  double closing;
  const flow found = {largest_distance_to_wall(in, surface, valve.at), longest_near(in, distance),
                      is_joined(in, surface, &marking, result, marks, &closing)};
  printf(
      "%s: %lld nodes, longest edge near the valve %.3f, attachment up to %.4f from the wall, flow %s, closed from "
      "%.3f\n",
      name, (long long)in->n_nodes, found.longest_edge, found.to_wall, found.passes ? "passes" : "stops", closing);
  free_owned_after(owned_before);
  free_one_owned(valve.handle);
  return found;
}

/* Checks that the valve fills the mesh, and that edges are short enough for the half thickness to close the gap at the wall. An
 * edge in the gap is at most `to_wall` from the attachment. One node of the edge is therefore at most `to_wall` plus half an edge
 * away from the attachment. */
static void expect_filled(flow found) {
  CHECK_AT_MOST(found.to_wall, 0.5 * half_thickness);
  CHECK_AT_MOST(found.to_wall + 0.5 * found.longest_edge, half_thickness);
}

/* --- Tests ------------------------------------------------------------------------------------------------------------- */

TEST(closed_cusps_seal_their_root) {
  const filled_mesh root = mesh_by_gmsh(RIIS_DEMO "/aortic_root.geo", "");
  const flow closed = flow_through(&root, trileaflet_valve(0), "closed trileaflet valve in its root");
  expect_filled(closed);
  assert_int_equal(closed.passes, 0);
  assert_int_equal(flow_through(&root, trileaflet_valve(0.25), "opening trileaflet valve in its root").passes, 1);
}

TEST(closed_mitral_valve_seals_its_tube) {
  const filled_mesh tube = mesh_by_gmsh(RIIS_DEMO "/mitral_tube.geo", "");
  for (int step = 0; step <= 4; ++step) {
    const flow found = flow_through(&tube, mitral_valve(0.25 * step),
                                    step ? "opening mitral valve in its tube" : "closed mitral valve in its tube");
    expect_filled(found);
    assert_int_equal(found.passes, step > 0);
  }
}

/* The cylinder is as wide as the housing. */
TEST(closed_bileaflet_valve_seals_its_housing) {
  char text[512];
  snprintf(text, sizeof text,
           "SetFactory(\"OpenCASCADE\");\nCylinder(1) = {0, 0, -1, 0, 0, 2.5, %.17g};\n"
           "Mesh.MeshSizeMin = 0.05;\nMesh.MeshSizeMax = 0.05;\nMesh.Binary = 1;\n",
           housing_radius());
  scratch_write_text("housing.geo", text);
  const filled_mesh cylinder = mesh_by_gmsh(scratch_path("housing.geo"), "");
  const flow closed = flow_through(&cylinder, bileaflet_valve(0), "closed bileaflet valve in its housing");
  expect_filled(closed);
  assert_int_equal(closed.passes, 0);
  assert_int_equal(flow_through(&cylinder, bileaflet_valve(0.5), "opening bileaflet valve in its housing").passes, 1);
}

/* The paper's cusps end at different radii, 0.13 apart at a commissure. A wall can therefore not be within 0.05, half of the half
 * thickness, of all ends. Flow passes through the middle. */
TEST(the_papers_valve_leaks_in_its_root) {
  const filled_mesh root = mesh_by_gmsh(RIIS_DEMO "/aortic_root.geo", "-setnumber paper 1");
  flow found = flow_through(&root, paper_valve(), "the paper's aortic valve in its root");
  CHECK_AT_MOST(found.to_wall, 0.08);
  assert_int_equal(found.passes, 1);
  test_valve reaching = paper_valve();
  CHECK_OK(riis_valve_set_scalar(reaching.handle, "leaflet_radius_in", 0.02));
  assert_int_equal(flow_through(&root, reaching, "with cusps that reach the axis").passes, 0);
}

TEST(flow_passes_around_in_cylinders) {
  const filled_mesh wide = mesh_by_gmsh(RIIS_DEMO "/mitral_cylinder.geo", "");
  const flow found = flow_through(&wide, mitral_valve(0), "closed mitral valve in a wider cylinder");
  assert_true(found.to_wall > 2 * half_thickness);
  assert_int_equal(found.passes, 1);
}

#endif

int main(void) {
#ifdef RIIS_GMSH
  return run_cases(scratch_setup, scratch_teardown);
#else
  printf("no gmsh: skipped\n");
  return 77;
#endif
}
