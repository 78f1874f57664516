/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests motions that are read from files. In every format, the frames move by the closed form. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "calls.h"
#include "expect.h"
#include "moving_sheet.h"
#include "scratch.h"
#include "vtk_shim.h"

enum { n_keys = 4 };
static const double key_times[n_keys] = {0, 0.25, 0.5, 1};

/* Makes the keyframes of a motion. Destroys the motion. */
static riis_keyframes *keyframes_of(riis_vtk_motion *motion, double period, int32_t interpolation) {
  riis_surface_arrays faces;
  riis_keyframe_arrays frames;
  riis_keyframes *keyframes = NULL;
  expect_fine(riis_vtk_motion_get_arrays(motion, &faces, sizeof faces));
  expect_fine(riis_vtk_motion_get_frames(motion, &frames, sizeof frames));
  assert_true(frames.period == 0 && frames.interpolation == RIIS_INTERPOLATION_LINEAR);
  frames.period = period;
  frames.interpolation = interpolation;
  expect_fine(riis_keyframes_create(&faces, &frames, &keyframes));
  riis_vtk_motion_destroy(&motion);
  assert_null(motion);
  return keyframes;
}

static void expect_sheet(const riis_surface *surface, double time, double speed, int32_t one_leaflet) {
  const int64_t n_vertices = triangles_of(surface).n_vertices;
  const double *xyz = triangles_of(surface).xyz;
  const double *velocity = triangles_of(surface).velocity;
  const int64_t n = triangles_of(surface).n_triangles;
  const int64_t *corners = triangles_of(surface).vertex_id;
  const int32_t *leaflet_id = triangles_of(surface).leaflet_id;
  assert_int_equal(n, sheet_n_triangles);
  assert_int_equal(n_vertices, sheet_n_vertices);
  for (int64_t t = 0; t < n; ++t) {
    int64_t expected[3];
    int32_t leaflet;
    sheet_triangle(t, expected, &leaflet);
    assert_int_equal(leaflet_id[t], one_leaflet >= 0 ? one_leaflet : leaflet);
    for (int c = 0; c < 3; ++c) {
      double at[3], by[3];
      sheet_vertex(expected[c], time, at, by);
      for (int k = 0; k < 3; ++k) {
        assert_true(fabs(xyz[3 * corners[3 * t + c] + k] - at[k]) < 1e-14);
        assert_true(fabs(velocity[3 * corners[3 * t + c] + k] - speed * by[k]) < 1e-13);
      }
    }
  }
}

/* Moves a surface by the frames. Compares the surface with the closed form at, between, before and after the times of the
 * frames. */
static void expect_motion(riis_vtk_motion *motion, int32_t one_leaflet) {
  static const double times[] = {0, 0.25, 0.5, 1, 0.1, 0.3, 0.7, 0.99};
  riis_keyframes *keyframes = keyframes_of(motion, 0, RIIS_INTERPOLATION_LINEAR);
  riis_surface *surface = NULL;
  expect_fine(riis_surface_create_from_keyframes(keyframes, -1, 0, NULL, &surface));
  expect_sheet(surface, 0, 0, one_leaflet);
  for (size_t i = 0; i < sizeof times / sizeof *times; ++i) {
    expect_fine(riis_surface_update_from_keyframes(surface, keyframes, times[i], 0, NULL));
    expect_sheet(surface, times[i], times[i] < 1 ? 1 : 0, one_leaflet);
    expect_fine(riis_surface_update_from_keyframes(surface, keyframes, times[i], times[i] - 0.6, NULL));
    expect_sheet(surface, times[i], 1, one_leaflet);
  }
  expect_fine(riis_surface_update_from_keyframes(surface, keyframes, 9, 0, NULL));
  expect_sheet(surface, 1, 0, one_leaflet);
  riis_surface_destroy(&surface);
  riis_keyframes_destroy(&keyframes);
}

/* Writes a collection of the sheet's frames. `place` is a folder before the name of each file. */
static void write_collection(const char *name, const char *place, const char *ending) {
  char text[4096] =
      "<?xml version=\"1.0\"?>\n<!-- <DataSet file=\"no\"/> -->\n<VTKFile type=\"Collection\" version=\"0.1\">"
      "<Collection>\n";
  for (int i = 0; i < n_keys; ++i)
    snprintf(text + strlen(text), sizeof text - strlen(text),
             "<DataSet timestep=\" %g\" group=\"\" part=\"0\" file='%sframe_%d%s'/>\n", key_times[i], place, i, ending);
  strcat(text, "</Collection></VTKFile>\n");
  scratch_write_text(name, text);
}

static void write_frames(const char *folder, const char *ending) {
  char name[64];
  for (int i = 0; i < n_keys; ++i) {
    snprintf(name, sizeof name, "%sframe_%d%s", folder, i, ending);
    sheet_write(name, key_times[i], NULL);
  }
}

static riis_vtk_motion *collection(const char *name) {
  riis_vtk_motion *motion = NULL;
  expect_fine(riis_vtk_motion_read_pvd(scratch_path(name), NULL, &motion));
  return motion;
}

/* Checks that the motion names one file for each frame, and that each file exists. */
static void expect_files(const riis_vtk_motion *motion, int64_t n_expected, const char *last) {
  int64_t n = 0;
  const char *const *paths = NULL;
  expect_fine(riis_vtk_motion_get_files(motion, &n, &paths));
  assert_int_equal(n, n_expected);
  for (int64_t i = 0; i < n; ++i) assert_int_equal(access(paths[i], R_OK), 0);
  assert_string_equal(paths[n - 1], scratch_path(last));
}

TEST(test_collections) {
  char absolute[2048], *here = getcwd(NULL, 0);
  write_frames("", ".vtp");
  write_collection("here.pvd", "", ".vtp");
  expect_motion(collection("here.pvd"), -1);
  assert_int_equal(mkdir(scratch_path("frames"), 0700), 0);
  assert_int_equal(mkdir(scratch_path("other folder"), 0700), 0);
  write_frames("frames/", ".vtu");
  write_collection("below.PVD", "frames/", ".vtu");
  riis_vtk_motion *below = collection("below.PVD");
  expect_files(below, n_keys, "frames/frame_3.vtu");
  expect_motion(below, -1);
  write_collection("other folder/beside.pvd", "../frames/", ".vtu");
  expect_motion(collection("other folder/beside.pvd"), -1);
  snprintf(absolute, sizeof absolute, "%s/%s", here, scratch_path("frames/"));
  write_collection("absolute.pvd", absolute, ".vtu");
  expect_motion(collection("absolute.pvd"), -1);
  free(here);
}

/* Reads a collection in the working directory by its name without a folder. */
TEST(test_collection_in_working_directory) {
  char *here = getcwd(NULL, 0);
  riis_vtk_motion *motion = NULL;
  write_frames("", ".vtp");
  write_collection("here.pvd", "./", ".vtp");
  assert_int_equal(chdir(scratch_path("")), 0);
  const riis_status status = riis_vtk_motion_read_pvd("here.pvd", NULL, &motion);
  assert_int_equal(chdir(here), 0);
  free(here);
  expect_fine(status);
  expect_motion(motion, -1);
}

static riis_vtk_motion *list(const char *const endings[n_keys], const char *leaflets) {
  const char *paths[n_keys];
  riis_vtk_motion *motion = NULL;
  for (int i = 0; i < n_keys; ++i) {
    char name[64];
    snprintf(name, sizeof name, "listed_%d%s", i, endings[i]);
    sheet_write(name, key_times[i], NULL);
    paths[i] = scratch_path(name);
  }
  expect_fine(riis_vtk_motion_read_files(n_keys, paths, key_times, leaflets, &motion));
  return motion;
}

TEST(test_lists) {
  const char *const polydata[n_keys] = {".vtp", ".vtp", ".vtp", ".vtp"};
  const char *const mixed[n_keys] = {".vtu", ".vtp", ".vtu", ".vtp"};
  const char *const stl[n_keys] = {".stl", ".STL", ".stl", ".STL"};
  expect_motion(list(polydata, NULL), -1);
  expect_motion(list(polydata, "riis_leaflet"), -1);
  expect_motion(list(mixed, NULL), -1);
  expect_motion(list(stl, NULL), 0);
  riis_vtk_motion *motion = list(polydata, NULL);
  expect_files(motion, n_keys, "listed_3.vtp");
  expect_fine(riis_vtk_motion_number_pieces(motion));
  expect_motion(motion, 0);
}

/* Frames from files and from arrays give the same bits, for every interpolation and period. */
TEST(test_same_as_arrays) {
  const char *const endings[n_keys] = {".vtp", ".vtp", ".vtp", ".vtp"};
  static double xyz[n_keys][sheet_n_vertices][3];
  static int64_t corners[sheet_n_triangles][3];
  riis_surface_arrays faces;
  riis_keyframe_arrays frames;
  riis_keyframes *arrays = NULL;
  for (int i = 0; i < n_keys; ++i)
    for (int v = 0; v < sheet_n_vertices; ++v) sheet_vertex(v, key_times[i], xyz[i][v], NULL);
  for (int64_t t = 0; t < sheet_n_triangles; ++t) sheet_triangle(t, corners[t], &(int32_t){0});
  expect_fine(riis_surface_arrays_init(&faces, sizeof faces));
  expect_fine(riis_keyframe_arrays_init(&frames, sizeof frames));
  faces.n_vertices = frames.n_vertices = sheet_n_vertices;
  faces.n_faces = sheet_n_triangles;
  faces.vertex_ids = corners;
  faces.id_bits = 64;
  frames.n_keys = n_keys;
  frames.time = key_times;
  frames.xyz = xyz[0][0];
  frames.period = 1.25;
  frames.interpolation = RIIS_INTERPOLATION_CUBIC;
  expect_fine(riis_keyframes_create(&faces, &frames, &arrays));
  riis_keyframes *files = keyframes_of(list(endings, NULL), 1.25, RIIS_INTERPOLATION_CUBIC);
  riis_surface *a = NULL, *b = NULL;
  expect_fine(riis_surface_create_from_keyframes(arrays, 0, 0, NULL, &a));
  expect_fine(riis_surface_create_from_keyframes(files, 0, 0, NULL, &b));
  for (int i = -20; i < 40; ++i) {
    expect_fine(riis_surface_update_from_keyframes(a, arrays, 0.07 * i, 0.07 * i - 0.06 * i, NULL));
    expect_fine(riis_surface_update_from_keyframes(b, files, 0.07 * i, 0.07 * i - 0.06 * i, NULL));
    const double *one = triangles_of(a).xyz;
    const double *other = triangles_of(b).xyz;
    assert_memory_equal(one, other, sizeof xyz[0]);
    one = triangles_of(a).velocity;
    other = triangles_of(b).velocity;
    assert_memory_equal(one, other, sizeof xyz[0]);
  }
  riis_surface_destroy(&a);
  riis_surface_destroy(&b);
  riis_keyframes_destroy(&arrays);
  riis_keyframes_destroy(&files);
}

#define FIELD(name, values) \
  "<DataArray type=\"Float64\" Name=\"" name "\" NumberOfTuples=\"4\" format=\"ascii\">" values "</DataArray>"

static void write_displaced(const char *name, const char *const arrays[n_keys], const char *field) {
  static char text[65536];
  char *end = text;
  /* The file has the displacements in reverse order, mixed with other arrays. */
  for (int i = n_keys; i-- > 0;) end = sheet_displacement(end, arrays[i], key_times[i]);
  end = sheet_displacement(end, "displacement_mean", 7);
  sheet_displacement(end, "displacement_-1", 7);
  const sheet_extras extras = {text, field};
  sheet_write(name, 0, &extras);
}

TEST(test_displacements) {
  const char *const plain[n_keys] = {"displacement_0", "displacement_1", "displacement_2", "displacement_3"};
  const char *const steps[n_keys] = {"displacement_0050", "displacement100", "displacement_0900", "displacement_1000"};
  riis_vtk_motion *motion = NULL;
  for (int is_grid = 0; is_grid < 2; ++is_grid) {
    const char *name = is_grid ? "displaced.vtu" : "displaced.vtp";
    write_displaced(name, plain, NULL);
    expect_fine(
        riis_vtk_motion_read_displacements(scratch_path(name), "displacement", n_keys, key_times, NULL, &motion));
    expect_files(motion, 1, name);
    expect_motion(motion, -1);
    write_displaced(name, steps, FIELD("TimeValue", "0 0.25 0.5 1"));
    expect_fine(riis_vtk_motion_read_displacements(scratch_path(name), "displacement", 0, NULL, NULL, &motion));
    expect_motion(motion, -1);
  }
  write_displaced("displaced.vtp", plain, NULL);
  expect_fine(riis_vtk_motion_read_displacements(scratch_path("displaced.vtp"), "displacement_", n_keys, key_times,
                                                 "riis_leaflet", &motion));
  expect_motion(motion, -1);
}

/* A quad lies beside a triangle. During the motion, one diagonal of the quad becomes shorter than the other diagonal. The quad
 * must nevertheless stay cut as in the first file. */
TEST(test_quads_are_cut_once) {
  const char *const fourth[2] = {"1 1 0", "0.2 0.2 0"}, *const names[2] = {"convex.vtp", "concave.vtp"};
  const char *paths[2];
  riis_vtk_motion *motion = NULL;
  for (int first = 0; first < 2; ++first) {
    for (int i = 0; i < 2; ++i) {
      char text[2048];
      snprintf(text, sizeof text,
               "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>\n"
               "<Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\"><Points><DataArray type=\"Float64\" "
               "NumberOfComponents=\"3\" format=\"ascii\">0 0 0  1 0 0  %s  0 1 0</DataArray></Points><Polys>"
               "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">1 2 3 0 0 1 3</DataArray>"
               "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4 7</DataArray></Polys>"
               "</Piece></PolyData></VTKFile>\n",
               fourth[(i + first) % 2]);
      scratch_write_text(names[i], text);
      paths[i] = scratch_path(names[i]);
    }
    expect_fine(riis_vtk_motion_read_files(2, paths, key_times, NULL, &motion));
    riis_surface_arrays faces;
    riis_keyframe_arrays frames;
    expect_fine(riis_vtk_motion_get_arrays(motion, &faces, sizeof faces));
    expect_fine(riis_vtk_motion_get_frames(motion, &frames, sizeof frames));
    const int64_t convex[9] = {1, 2, 3, 1, 3, 0, 0, 1, 3}, concave[9] = {2, 3, 0, 2, 0, 1, 0, 1, 3};
    assert_int_equal(faces.n_faces, 3);
    assert_memory_equal(faces.vertex_ids, first ? concave : convex, sizeof convex);
    assert_true(((const double *)frames.xyz)[6] == (first ? 0.2 : 1) &&
                ((const double *)frames.xyz)[12 + 6] == (first ? 1 : 0.2));
    riis_vtk_motion_destroy(&motion);
  }
}

/* Writes the frames of the sheet as svMultiPhysics reads them. */
static void write_dat(const char *name, int n_frames) {
  static char text[1 << 20];
  char *end = text + sprintf(text, "%d %d\n", n_frames, sheet_n_vertices);
  for (int frame = 0; frame < n_frames; ++frame)
    for (int64_t i = 0; i < sheet_n_vertices; ++i) {
      double at[3], by[3];
      sheet_vertex(i, 0.5 * frame, at, by);
      end += sprintf(end, "%.17g %.17g %.17g\n", at[0], at[1], at[2]);
    }
  scratch_write_text(name, text);
}

/* svMultiPhysics has frames in a text file, and their faces in a second file. Several motions become one. */
TEST(test_frames) {
  const char *const names[] = {"flap.vtu", "flap_mesh.vtu", "flap_motion.vtu", "flap_motion_open.vtp"};
  write_dat("flap_motion_open.dat", 3);
  riis_vtk_motion *motion = NULL, *other = NULL;
  expect_refused(riis_vtk_motion_read_frames(scratch_path("flap_motion_open.dat"), 0.5, NULL, &motion), RIIS_FILE_ERROR,
                 "no file beside it has their faces: flap.vtu is missing");
  for (int i = 0; i < 4; ++i) {
    sheet_write(names[i], 0.3, NULL);
    expect_fine(riis_vtk_motion_read_frames(scratch_path("flap_motion_open.dat"), 0.5, NULL, &motion));
    riis_keyframes *keyframes = keyframes_of(motion, 0, RIIS_INTERPOLATION_LINEAR);
    riis_surface *surface = NULL;
    expect_fine(riis_surface_create_from_keyframes(keyframes, 0.25, 0, NULL, &surface));
    expect_sheet(surface, 0.25, 1, -1);
    riis_surface_destroy(&surface);
    riis_keyframes_destroy(&keyframes);
    assert_int_equal(unlink(scratch_path(names[i])), 0);
  }
  sheet_write("flap.vtu", 0, NULL);
  expect_fine(riis_vtk_motion_read_frames(scratch_path("flap_motion_open.dat"), 0.5, NULL, &motion));
  expect_fine(riis_vtk_motion_read_frames(scratch_path("flap_motion_open.dat"), 0.5, NULL, &other));
  expect_fine(riis_vtk_motion_append(motion, other));
  riis_vtk_motion_destroy(&other);
  riis_surface_arrays faces;
  riis_keyframe_arrays frames;
  int64_t n_files = 0;
  expect_fine(riis_vtk_motion_get_arrays(motion, &faces, sizeof faces));
  expect_fine(riis_vtk_motion_get_frames(motion, &frames, sizeof frames));
  expect_fine(riis_vtk_motion_get_files(motion, &n_files, NULL));
  assert_int_equal(n_files, 2);
  assert_int_equal(frames.n_keys, 3);
  assert_int_equal(frames.n_vertices, 2 * sheet_n_vertices);
  assert_int_equal(faces.leaflet_id[0], 0);
  assert_int_equal(faces.leaflet_id[faces.n_faces - 1], 1);
  for (int64_t i = 0; i < 3 * 2 * sheet_n_vertices; ++i) {
    double at[3], by[3];
    sheet_vertex(i % sheet_n_vertices, 0.5 * (double)(i / (2 * sheet_n_vertices)), at, by);
    for (int k = 0; k < 3; ++k) assert_true(((const double *)frames.xyz)[3 * i + k] == at[k]);
  }
  expect_fine(riis_vtk_motion_read_frames(scratch_path("flap_motion_open.dat"), 0.25, NULL, &other));
  expect_refused(riis_vtk_motion_append(motion, other), RIIS_INVALID_ARGUMENT,
                 "frame 1 is at the time 0.5 in one motion and at 0.25 in the other");
  riis_vtk_motion_destroy(&other);
  write_dat("flap_two.dat", 2);
  expect_fine(riis_vtk_motion_read_frames(scratch_path("flap_two.dat"), 0.5, NULL, &other));
  expect_refused(riis_vtk_motion_append(motion, other), RIIS_INVALID_ARGUMENT, "the motions have 3 and 2 frames");
  riis_vtk_motion_destroy(&other);
  riis_vtk_motion_destroy(&motion);
}

TEST(test_frames_are_refused) {
  static const struct {
    const char *text, *part;
  } bad[] = {{"1 3\n0 0 0 1 0 0 0 1 0\n7\n", "line 3: the file holds more than 1 frames of 3 nodes"},
             {"2 3\n0 0 0 1 0 0 0 1 0\n", "claims 3 nodes in each frame, but only"},
             {"1 3\n0 0 0 1 0 0 0 1 x\n", "line 2: \"x\" is not a number"},
             {"1 3\n0 0 0 1 0 0 0 inf 0\n", "y of point 2 of frame 0 is inf"},
             {"0 3\n", "line 1: there are 0 frames; 1 to 1000000 are read"},
             {"1 4\n0 0 0 1 0 0 0 1 0 1 1 1\n", "has 4 nodes; "},
             {"1 99999999999999\n0 0 0\n", "claims 99999999999999 nodes in each frame"},
             {"1\n", "is truncated"}};
  riis_vtk_motion *motion = NULL;
  scratch_write_text("bad.vtp",
                     "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>\n"
                     "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points><DataArray type=\"Float64\" "
                     "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>"
                     "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
                     "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys>"
                     "</Piece></PolyData></VTKFile>\n");
  for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
    scratch_write_text("bad_open.dat", bad[i].text);
    expect_refused(riis_vtk_motion_read_frames(scratch_path("bad_open.dat"), 1, NULL, &motion), RIIS_FILE_ERROR,
                   bad[i].part);
    assert_null(motion);
  }
  expect_refused(riis_vtk_motion_read_frames(scratch_path("bad_open.dat"), 0, NULL, &motion), RIIS_INVALID_ARGUMENT,
                 "time_step is 0; it must be above 0");
  expect_refused(riis_vtk_motion_read_frames(scratch_path("bad.vtp"), 1, NULL, &motion), RIIS_FILE_ERROR,
                 "frames of svMultiPhysics must be in a .dat file");
}

/* In .stl files, corners may come together during the motion, but may not separate. */
TEST(test_corners_of_stl) {
  const char *facets =
      "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "facet normal 0 0 1\nouter loop\nvertex %s 0 0\nvertex 1 1 0\nvertex 0 1 -0\nendloop\nendfacet\n"
      "endsolid x\n";
  char together[1024], apart[1024];
  riis_vtk_motion *motion = NULL;
  snprintf(together, sizeof together, facets, "1");
  snprintf(apart, sizeof apart, facets, "1.5");
  scratch_write_text("together.stl", together);
  scratch_write_text("apart.stl", apart);
  const char *const part[2] = {scratch_path("together.stl"), scratch_path("apart.stl")}, *const meet[2] = {part[1],
                                                                                                           part[0]};
  expect_refused(riis_vtk_motion_read_files(2, part, key_times, NULL, &motion), RIIS_FILE_ERROR,
                 "apart.stl: corner 1 of triangle 0 is at 1 0 0, corner 0 of triangle 1 at 1.5 0 0; in the first file "
                 "they are at one place: are the triangles in another order?");
  assert_null(motion);
  riis_surface_arrays faces;
  riis_keyframe_arrays frames;
  expect_fine(riis_vtk_motion_read_files(2, meet, key_times, NULL, &motion));
  expect_fine(riis_vtk_motion_get_arrays(motion, &faces, sizeof faces));
  expect_fine(riis_vtk_motion_get_frames(motion, &frames, sizeof frames));
  const int64_t ids[6] = {0, 1, 2, 3, 4, 2};
  assert_int_equal(faces.n_vertices, 5);
  assert_int_equal(frames.n_vertices, 5);
  assert_memory_equal(faces.vertex_ids, ids, sizeof ids);
  assert_true(((const double *)frames.xyz)[3 * 3] == 1.5 && ((const double *)frames.xyz)[15 + 3 * 3] == 1);
  riis_vtk_motion_destroy(&motion);
}

/* A surface is written with its velocities. */
TEST(test_velocity_is_written) {
  const char *const endings[n_keys] = {".vtp", ".vtp", ".vtp", ".vtp"};
  riis_keyframes *keyframes = keyframes_of(list(endings, NULL), 0, RIIS_INTERPOLATION_LINEAR);
  riis_surface *surface = NULL;
  riis_surface_options options;
  double velocity[3 * sheet_n_vertices];
  int64_t n_components = 0;
  char type[32];
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.scale = 2;
  expect_fine(riis_surface_create_from_keyframes(keyframes, 0.3, 0, &options, &surface));
  expect_fine(riis_vtk_surface_write(surface, scratch_path("moving.vtp")));
  assert_int_equal(
      shim_read_array(scratch_path("moving.vtp"), 'p', "riis_velocity", type, &n_components, NULL, velocity), 1);
  assert_string_equal(type, "double");
  assert_int_equal(n_components, 3);
  for (int v = 0; v < sheet_n_vertices; ++v) {
    double by[3];
    sheet_vertex(v, 0, NULL, by);
    for (int k = 0; k < 3; ++k) assert_true(fabs(velocity[3 * v + k] - 2 * by[k]) < 1e-13);
  }
  riis_surface_destroy(&surface);
  riis_keyframes_destroy(&keyframes);
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
