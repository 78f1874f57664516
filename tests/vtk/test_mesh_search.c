/* SPDX-License-Identifier: Apache-2.0
 *
 * Compares the neighbour search with the exhaustive search, bit for bit. The unstructured meshes come from files of VTK's
 * Delaunay filter and of gmsh. */
#include <riis/riis_vtk.h>

#include "../support/test_support.h"

#include "../support/handles.h"
#include "../support/searches.h"
#include "scratch.h"
#include "vtk_shim.h"

static random_source rng;

static riis_surface *surface_of(const char *kind, double opening, double half_thickness) {
  riis_surface_options options = surface_options();
  if (half_thickness > 0) options.half_thickness = half_thickness;
  riis_valve *valve = new_valve(kind);
  if (strcmp(kind, "aortic") == 0) { /* the aortic valve has no open state of its own */
    riis_valve *open = new_valve(kind);
    CHECK_OK(riis_valve_set_scalar(open, "leaflet_angle", 50));
    CHECK_OK(riis_valve_set_open_state(valve, open));
    free_one_owned(open);
  }
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  riis_surface *surface = new_surface(valve, &options);
  free_one_owned(valve);
  return surface;
}

/* Marks with both searches, with new and used results, with several limits, and with several numbers of threads. Returns the
 * number of nodes that the first run marks. */
static int64_t expect_same(const riis_surface *surface, const riis_mesh *mesh, riis_marks *warm) {
  const int owned_before = n_owned();
  riis_marks *expected = new_result(), *cold = new_result();
  const double wide = 0.3;
  int64_t n_marked = 0;
  for (int k = 0; k < 2; ++k) {
    riis_mark_options options = mark_options();
    if (k) options.distance_limit = wide;
    options.search = RIIS_SEARCH_EXHAUSTIVE;
    CHECK_OK(riis_mark_nodes(surface, mesh, &options, expected));
    if (k == 0) n_marked = stats_of(expected).n_marked;
    options.search = RIIS_SEARCH_NEIGHBOR;
    options.n_threads = 1 + (int32_t)(random_bits(&rng) % 4);
    riis_marks *mine[2] = {cold, warm};
    for (int i = 0; i < 2; ++i) {
      CHECK_OK(riis_mark_nodes(surface, mesh, &options, mine[i]));
      const riis_mark_stats stats = stats_of(mine[i]);
      if (!same_results(mine[i], expected))
        fail_msg("%lld nodes within the limit instead of %lld; or not the same bits", (long long)stats.n_within_limit,
                 (long long)stats_of(expected).n_within_limit);
      assert_int_equal(stats.search, RIIS_SEARCH_NEIGHBOR);
      assert_int_equal(stats.complete, 1);
    }
    free_one_owned(cold);
    cold = new_result();
  }
  free_owned_after(owned_before);
  return n_marked;
}

static void destroy_file(void *object) {
  riis_vtk_mesh *file = object;
  riis_vtk_mesh_destroy(&file);
}

/* Tests a kind of valve in the mesh of a file, at every opening, with a thin half thickness and with the default. */
static void expect_same_in_file(const char *path, const char *kind, int64_t least_nodes) {
  riis_vtk_mesh *file = NULL;
  riis_adjacency *adjacency = NULL;
  riis_csr csr;
  int64_t n_nodes, n_cells;
  const double *xyz;
  CHECK_OK(riis_vtk_mesh_read(path, &file));
  own_object(file, destroy_file);
  CHECK_OK(riis_vtk_mesh_get_nodes(file, &n_nodes, &n_cells, &xyz));
  CHECK_OK(riis_vtk_mesh_create_adjacency(file, 2, &adjacency));
  own(adjacency);
  CHECK_OK(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
  assert_in_range(n_nodes, least_nodes, 50000);
  /* A mesh of tetrahedra has about 14 neighbours per node. */
  assert_true(((const int64_t *)csr.offsets)[n_nodes] > 10 * n_nodes);
  riis_mesh *mesh = mesh_of(n_nodes, xyz);
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  const double half_thickness[2] = {0.03, -1};
  for (int k = 0; k < 2; ++k) {
    const int owned_before = n_owned();
    riis_marks *warm = new_result();
    for (int step = 0; step <= 2; ++step) {
      const int n_outside = n_owned();
      riis_surface *surface = surface_of(kind, 0.5 * step, half_thickness[k]);
      const int64_t n_marked = expect_same(surface, mesh, warm);
      printf("%s: %s, opening %g, half thickness %g: %lld of %lld nodes marked\n", path, kind, 0.5 * step,
             info_of(surface).half_thickness, (long long)n_marked, (long long)n_nodes);
      assert_true(n_marked > (k ? 50 : 5));
      free_owned_after(n_outside);
    }
    free_owned_after(owned_before);
  }
}

/* Gives the corners of a box that contains the valve at every opening. */
static void box_around(const char *kind, double margin, double *lower, double *upper) {
  for (int step = 0; step <= 2; ++step) {
    const int owned_before = n_owned();
    riis_surface *surface = surface_of(kind, 0.5 * step, -1);
    const riis_surface_info info = info_of(surface);
    for (int c = 0; c < 3; ++c) {
      lower[c] = step ? fmin(lower[c], info.lower[c] - margin) : info.lower[c] - margin;
      upper[c] = step ? fmax(upper[c], info.upper[c] + margin) : info.upper[c] + margin;
    }
    free_owned_after(owned_before);
  }
}

static void delaunay(const char *kind) {
  enum { n = 6000 };
  double *xyz = own(malloc((size_t)n * 3 * sizeof *xyz)), lower[3], upper[3];
  box_around(kind, 0.3, lower, upper);
  for (int i = 0; i < 3 * n; ++i) xyz[i] = random_between(&rng, lower[i % 3], upper[i % 3]);
  assert_int_equal(shim_write_delaunay(scratch_path("delaunay.vtu"), n, xyz), 1);
  expect_same_in_file(scratch_path("delaunay.vtu"), kind, n);
}

TEST(aortic_in_a_delaunay_mesh) { delaunay("aortic"); }

TEST(mitral_in_a_delaunay_mesh) { delaunay("mitral"); }

#ifdef RIIS_GMSH
/* Makes a cylinder around the valve. The mesh is fine near one point, and coarser elsewhere. */
static void graded_by_gmsh(const char *kind) {
  double lower[3], upper[3], fine[3];
  char text[2048], command[2048];
  box_around(kind, 0.2, lower, upper);
  riis_surface *surface = surface_of(kind, 1, -1);
  const int64_t n_vertices = triangles_of(surface).n_vertices;
  const double *vertices = triangles_of(surface).xyz;
  memcpy(fine, vertices + 3 * (random_bits(&rng) % (uint64_t)n_vertices), sizeof fine);
  free_one_owned(surface);
  const double x = 0.5 * (lower[0] + upper[0]), y = 0.5 * (lower[1] + upper[1]);
  const double radius = 0.5 * hypot(upper[0] - lower[0], upper[1] - lower[1]);
  snprintf(text, sizeof text,
           "SetFactory(\"OpenCASCADE\");\n"
           "Cylinder(1) = {%.17g, %.17g, %.17g, 0, 0, %.17g, %.17g};\n"
           "Physical Volume(\"fluid\") = {1};\n"
           "Field[1] = MathEval;\n"
           "Field[1].F = \"0.05 + 0.08 * Sqrt((x - (%.17g))^2 + (y - (%.17g))^2 + (z - (%.17g))^2)\";\n"
           "Background Field = 1;\n"
           "Mesh.MeshSizeExtendFromBoundary = 0;\nMesh.MeshSizeFromPoints = 0;\nMesh.MeshSizeFromCurvature = 0;\n"
           "Mesh.MeshSizeMin = 0.05;\nMesh.Algorithm3D = 10;\nMesh.Binary = 1;\n",
           x, y, lower[2], upper[2] - lower[2], radius, fine[0], fine[1], fine[2]);
  scratch_write_text("graded.geo", text);
  snprintf(command, sizeof command, "'%s' -3 -nt 1 -v 2 -format vtk -o '%s' '%s'", RIIS_GMSH,
           scratch_path("graded.vtk"), scratch_path("graded.geo"));
  fflush(stdout);
  assert_int_equal(system(command), 0);
  expect_same_in_file(scratch_path("graded.vtk"), kind, 2000);
}
#endif

TEST(aortic_in_a_gmsh_mesh) {
#ifdef RIIS_GMSH
  graded_by_gmsh("aortic");
#endif
}

TEST(mitral_in_a_gmsh_mesh) {
#ifdef RIIS_GMSH
  graded_by_gmsh("mitral");
#endif
}

int main(void) {
  rng = random_start("test_mesh_search");
  const int failed = run_cases(scratch_setup, scratch_teardown);
#ifndef RIIS_GMSH
  if (!failed) {
    printf("no gmsh: its part was skipped\n");
    return 77;
  }
#endif
  return failed;
}
