/* SPDX-License-Identifier: Apache-2.0
 *
 * Every allocation by riis_vtk's own code fails once. The call must then return RIIS_OUT_OF_MEMORY, leave no half-written file
 * and leak no memory. If the call is repeated, the call must succeed. Allocations by VTK do not fail here. */
#include <riis/riis_vtk.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "failing_memory.h"
#include "moving_sheet.h"
#include "scratch.h"
#include "vtk_shim.h"

/* The objects of the scenarios. Only one of these objects exists at a time. The tested call makes this object, or the object is
 * made before the call. */
static riis_vtk_mesh *mesh;
static riis_vtk_surface *read_surface;
static riis_adjacency *adjacency;
static riis_vtk_motion *motion;
/* The surface is made once for all scenarios. */
static riis_surface *surface;
static riis_marks *result;

static void nothing(void) {}
static void mesh_read(void) { expect_fine(riis_vtk_mesh_read(scratch_path("box.vtu"), &mesh)); }
static void marks_set(void) {
  mesh_read();
  expect_fine(riis_vtk_mesh_set_marks(mesh, result, RIIS_FAR_DISTANCE, NULL));
}

static riis_status read_vtu(void) { return riis_vtk_mesh_read(scratch_path("box.vtu"), &mesh); }
static riis_status read_vtk(void) { return riis_vtk_mesh_read(scratch_path("box.vtk"), &mesh); }
static riis_status make_adjacency(void) { return riis_vtk_mesh_create_adjacency(mesh, 1, &adjacency); }
static riis_status set_marks(void) { return riis_vtk_mesh_set_marks(mesh, result, RIIS_FAR_DISTANCE, NULL); }
static riis_status write_mesh(void) { return riis_vtk_mesh_write(mesh, scratch_path("written.vtu")); }
static riis_status write_surface(void) { return riis_vtk_surface_write(surface, scratch_path("written.vtp")); }
static riis_status read_vtp(void) { return riis_vtk_surface_read(scratch_path("surface.vtp"), NULL, &read_surface); }
static riis_status read_stl(void) { return riis_vtk_surface_read(scratch_path("surface.stl"), NULL, &read_surface); }
static riis_status read_obj(void) { return riis_vtk_surface_read(scratch_path("surface.obj"), NULL, &read_surface); }
static riis_status read_ply(void) { return riis_vtk_surface_read(scratch_path("surface.ply"), NULL, &read_surface); }
static riis_status read_frames(void) {
  return riis_vtk_motion_read_frames(scratch_path("flap_open.dat"), 1, NULL, &motion);
}
static void surface_read(void) { expect_fine(read_obj()); }
static riis_status append(void) { return riis_vtk_surface_append(read_surface, read_surface); }
static void frames_read(void) { expect_fine(read_frames()); }
static riis_status append_motion(void) { return riis_vtk_motion_append(motion, motion); }
static riis_status read_pvd(void) { return riis_vtk_motion_read_pvd(scratch_path("motion.pvd"), NULL, &motion); }
static riis_status read_stls(void) {
  static const double times[2] = {0, 1};
  const char *const paths[2] = {scratch_path("surface.stl"), scratch_path("surface.stl")};
  return riis_vtk_motion_read_files(2, paths, times, NULL, &motion);
}
static riis_status read_displacements(void) {
  return riis_vtk_motion_read_displacements(scratch_path("displaced.vtp"), "d", 0, NULL, NULL, &motion);
}
static void motion_read(void) { expect_fine(read_pvd()); }
static riis_status number_pieces(void) { return riis_vtk_motion_number_pieces(motion); }

static const struct {
  const char *name;
  void (*make)(void);
  riis_status (*call)(void);
  const char *file; /* the file that the message must name; "" if there is none */
} scenarios[] = {
    {"read .vtu", nothing, read_vtu, "box.vtu"},
    {"read .vtk", nothing, read_vtk, "box.vtk"},
    {"adjacency", mesh_read, make_adjacency, ""},
    {"marks", mesh_read, set_marks, ""},
    {"write .vtu", marks_set, write_mesh, "written.vtu"},
    {"write .vtp", nothing, write_surface, "written.vtp"},
    {"read .vtp", nothing, read_vtp, "surface.vtp"},
    {"read .stl", nothing, read_stl, "surface.stl"},
    {"read .obj", nothing, read_obj, "surface.obj"},
    {"read .ply", nothing, read_ply, "surface.ply"},
    {"append", surface_read, append, ""},
    {"read .dat", nothing, read_frames, "flap_open.dat"},
    {"append motion", frames_read, append_motion, ""},
    {"read .pvd", nothing, read_pvd, "motion.pvd"},
    {"read .stl files", nothing, read_stls, "surface.stl"},
    {"displacements", nothing, read_displacements, "displaced.vtp"},
    {"pieces", motion_read, number_pieces, ""},
};

static void destroy(void) {
  riis_adjacency_destroy(&adjacency);
  riis_vtk_mesh_destroy(&mesh);
  riis_vtk_surface_destroy(&read_surface);
  riis_vtk_motion_destroy(&motion);
  remove(scratch_path("written.vtu"));
  remove(scratch_path("written.vtp"));
}

TEST(the_components_memory_runs_out) {
  int64_t n_injected = 0;
  for (size_t i = 0; i < sizeof scenarios / sizeof scenarios[0]; ++i) {
    const char *name = scenarios[i].name;
    int64_t n_failed = 1, n = 0, n_named = 0;
    scenarios[i].make(); /* VTK makes some objects only once, so this first call makes them, and must succeed */
    expect_fine(scenarios[i].call());
    destroy();
    const int n_files = scratch_n_files();
    while (n_failed > 0) {
      ++n;
      for (int and_all_after = 0; and_all_after < 2; ++and_all_after) {
        const int64_t live = memory_live_of_library();
        scenarios[i].make();
        const riis_adjacency *const no_adjacency = adjacency;
        const riis_vtk_surface *const no_surface = read_surface;
        const riis_vtk_mesh *const mesh_before = mesh;
        const riis_vtk_motion *const motion_before = motion;
        memory_fail(MEMORY_OF_LIBRARY, n, and_all_after);
        const riis_status status = scenarios[i].call();
        n_failed = memory_stop_failing();
        n_injected += n_failed;
        if (n_failed > 0) {
          const char *const text = riis_last_error(), *const end = strstr(text, "out of memory");
          n_named +=
              strstr(text, scenarios[i].file) != NULL && end && end > text && strcmp(end - 2, ": out of memory") == 0;
          if (status != RIIS_OUT_OF_MEMORY || !end || strlen(end) != 13)
            fail_msg("%s, allocation %d: %s (%s)", name, (int)n, riis_status_name(status), riis_last_error());
          if (adjacency != no_adjacency || read_surface != no_surface || mesh != mesh_before || motion != motion_before)
            fail_msg("%s, allocation %d: a handle was written", name, (int)n);
          if (scratch_n_files() != n_files) fail_msg("%s, allocation %d: leaves a file", name, (int)n);
          expect_fine(scenarios[i].call());
        } else {
          expect_fine(status);
        }
        destroy();
        if (memory_live_of_library() != live)
          fail_msg("%s, allocation %d: leaks %d", name, (int)n, (int)(memory_live_of_library() - live));
      }
    }
    printf("%s: %d allocations, %d of %d failures name the file\n", name, (int)n - 1, (int)n_named, 2 * ((int)n - 1));
    assert_true(n > 1);
    if (scenarios[i].file[0]) assert_in_range(n_named, 1, INT64_MAX);
  }
  printf("%d failures injected\n", (int)n_injected);
}

static int set_up(void **state) {
  const double lower[3] = {-1.5, -1.5, -1.2}, upper[3] = {1.5, 1.5, 1.6};
  static const char triangle[] =
      "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid one\n";
  riis_surface_options options;
  riis_valve *valve = NULL;
  riis_mesh *nodes = NULL;
  const double *xyz = NULL;
  int64_t n_nodes = 0;
  if (scratch_setup(state)) return 1;
  memory_library_is_that_of("riis_vtk_mesh_read");
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.tolerance = 1;
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_create(valve, &options, &surface));
  riis_valve_destroy(&valve);
  assert_int_equal(shim_write_box(scratch_path("box.vtu"), SHIM_RAW, 6, lower, upper, 1), 1);
  assert_int_equal(shim_write_box(scratch_path("box.vtk"), SHIM_LEGACY_BINARY, 6, lower, upper, 0), 1);
  scratch_write_text("surface.stl", triangle);
  char frame[4096], *end = frame + sprintf(frame, "1 %d\n", sheet_n_vertices);
  for (int64_t i = 0; i < sheet_n_vertices; ++i) {
    double at[3];
    sheet_vertex(i, 0, at, NULL);
    end += sprintf(end, "%g %g %g\n", at[0], at[1], at[2]);
  }
  scratch_write_text("flap_open.dat", frame);
  sheet_write("flap.vtp", 0, NULL);
  scratch_write_text("surface.obj", "v 0 0 0\nv 1 0 0\nv 0 1 \\\n0\nf 1 2 3\n");
  scratch_write_text(
      "surface.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty uchar part\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
      "0\n0 1 0\n7 3 0 1 2\n");
  static char displacements[16384];
  sheet_displacement(sheet_displacement(displacements, "d_0", 0), "d_1", 1);
  const sheet_extras extras = {
      displacements,
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"2\" format=\"ascii\">0 1</DataArray>"};
  sheet_write("displaced.vtp", 0, &extras);
  scratch_write_text("motion.pvd",
                     "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"displaced.vtp\"/>"
                     "<DataSet timestep=\"1\" file=\"displaced.vtp\"/></Collection></VTKFile>\n");
  expect_fine(riis_vtk_surface_write(surface, scratch_path("surface.vtp")));
  mesh_read();
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n_nodes, NULL, &xyz));
  expect_fine(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &nodes));
  expect_fine(riis_marks_create(&result));
  expect_fine(riis_mark_nodes(surface, nodes, NULL, result));
  riis_mesh_destroy(&nodes);
  riis_vtk_mesh_destroy(&mesh);
  return 0;
}

static int tear_down(void **state) {
  riis_marks_destroy(&result);
  riis_surface_destroy(&surface);
  return scratch_teardown(state);
}

int main(void) { return run_cases(set_up, tear_down); }
