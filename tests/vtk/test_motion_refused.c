/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests files of motions that cannot be read. Each refusal names the file or argument and the value. The call prints and returns
 * nothing. Damaged collections never crash the process. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "moving_sheet.h"
#include "scratch.h"

enum { n_files = 2 };
static const double times[n_files] = {0, 1};

#define COLLECTION(data_sets) \
  "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>" data_sets "</Collection></VTKFile>\n"
#define DATA_SET(timestep, file) "<DataSet timestep=\"" timestep "\" part=\"0\" file=\"" file "\"/>"

static void expect_collection(const char *name, const char *text, const char *file, const char *part_of_text) {
  riis_vtk_motion *motion = NULL;
  if (text) scratch_write_text(name, text);
  scratch_watch_output();
  const riis_status status = riis_vtk_motion_read_pvd(scratch_path(name), NULL, &motion);
  const long n_printed = scratch_end_watch();
  expect_refused(status, RIIS_FILE_ERROR, part_of_text);
  expect_refused(status, RIIS_FILE_ERROR, file);
  assert_null(motion);
  assert_int_equal(n_printed, 0);
}

TEST(test_not_collections) {
  expect_collection("missing.pvd", NULL, "missing.pvd: ", "No such file or directory");
  expect_collection("frames.xml", COLLECTION(""), "frames.xml: ", "a collection of files in time must be a .pvd file");
  expect_collection("empty.pvd", "", "empty.pvd: ", "is empty");
  expect_collection("garbage.pvd", "garbage", "garbage.pvd: ", "is not a VTK XML file");
  expect_collection("surface.pvd", "<VTKFile type=\"PolyData\"><PolyData/></VTKFile>",
                    "surface.pvd: ", "holds PolyData, not Collection");
  expect_collection("cut.pvd", "<VTKFile type=\"Collection\"><Collection>" DATA_SET("0", "a.vtp"),
                    "cut.pvd: ", "is truncated: </VTKFile> is missing");
  expect_collection("open.pvd", "<VTKFile type=\"Collection\"><Collection></VTKFile>", "open.pvd: ", "mismatched tag");
  expect_collection("twice.pvd", COLLECTION("<DataSet file=\"a\" file=\"b\"/>"), "twice.pvd: ", "duplicate attribute");
}

TEST(test_no_data_sets) {
  const char *const none = "names no files: it has no DataSet in a Collection";
  expect_collection("none.pvd", COLLECTION(""), "none.pvd: ", none);
  expect_collection("comment.pvd", COLLECTION("<!--" DATA_SET("0", "a.vtp") "-->"), "comment.pvd: ", none);
  expect_collection("outside.pvd", "<VTKFile type=\"Collection\">" DATA_SET("0", "a.vtp") "</VTKFile>",
                    "outside.pvd: ", none);
  expect_collection("inside.pvd", COLLECTION("<Part>" DATA_SET("0", "a.vtp") "</Part>"), "inside.pvd: ", none);
  expect_collection("other.pvd",
                    "<a><VTKFile type=\"Collection\"><Collection>" DATA_SET("0", "a.vtp") "</Collection></VTKFile></a>"
                    "<!-- </VTKFile> -->",
                    "other.pvd: ", none);
}

TEST(test_bad_data_sets) {
  sheet_write("a.vtp", 0, NULL);
  const struct {
    const char *data_sets, *text;
  } cases[] = {{DATA_SET("0", "a.vtp") "<DataSet timestep=\"1\"/>", "DataSet 1 names no file"},
               {DATA_SET("0", ""), "DataSet 0 names no file"},
               {"<DataSet file=\"a.vtp\"/>", "DataSet 0 has no timestep"},
               {DATA_SET("", "a.vtp"), "DataSet 0 has the timestep '', which is not a number from -1e30 to 1e30"},
               {DATA_SET(" ", "a.vtp"), "DataSet 0 has the timestep ' ', which is not a number"},
               {DATA_SET("one", "a.vtp"), "DataSet 0 has the timestep 'one', which is not a number"},
               {DATA_SET("0 1", "a.vtp"), "DataSet 0 has the timestep '0 1', which is not a number"},
               {DATA_SET("0,5", "a.vtp"), "DataSet 0 has the timestep '0,5', which is not a number"},
               {DATA_SET("nan", "a.vtp"), "DataSet 0 has the timestep 'nan', which is not a number"},
               {DATA_SET("1.1e30", "a.vtp"), "DataSet 0 has the timestep '1.1e30', which is not a number"},
               {DATA_SET("1e999", "a.vtp"), "DataSet 0 has the timestep '1e999', which is not a number"},
               {DATA_SET("0", "a.vtp") DATA_SET("0.5", "a.vtp") DATA_SET("0.25", "a.vtp"),
                "DataSet 2 has the timestep 0.25, which is not above the timestep before it, 0.5"},
               {DATA_SET("0", "a.vtp") "<DataSet timestep=\"0\" part=\"1\" file=\"a.vtp\"/>",
                "DataSet 1 has the timestep 0, which is not above the timestep before it, 0"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    char text[1024];
    snprintf(text, sizeof text, COLLECTION("%s"), cases[i].data_sets);
    expect_collection("bad.pvd", text, "bad.pvd: ", cases[i].text);
  }
  expect_collection("lost.pvd", COLLECTION(DATA_SET("0", "a.vtp") DATA_SET("1", "sub/b.vtp")),
                    "sub/b.vtp: ", "No such file or directory");
  expect_collection("self.pvd", COLLECTION(DATA_SET("0", "self.pvd")),
                    "self.pvd: ", "a surface must be a .vtp, .vtu, .vtk, .stl, .obj or .ply file");
}

TEST(test_too_many_data_sets) {
  const char *const data_set = "<DataSet timestep='0' file='a'/>";
  const size_t n = 1000001, size = strlen(data_set);
  char *text = malloc(200 + n * size), *end = text;
  assert_non_null(text);
  end += sprintf(end, "<VTKFile type=\"Collection\"><Collection>");
  for (size_t i = 0; i < n; ++i, end += size) memcpy(end, data_set, size);
  sprintf(end, "</Collection></VTKFile>");
  scratch_write_text("many.pvd", text);
  free(text);
  expect_collection("many.pvd", NULL, "many.pvd: ", "names 1000001 files, more than 1000000");
}

/* Writes one quad or two triangles. The values that tests change are arguments. */
static void write_square(const char *name, const char *points, const char *corners, const char *offsets, int n_points,
                         int n_polys) {
  char text[2048];
  snprintf(text, sizeof text,
           "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>\n"
           "<Piece NumberOfPoints=\"%d\" NumberOfPolys=\"%d\"><Points><DataArray type=\"Float64\" "
           "NumberOfComponents=\"3\" format=\"ascii\">%s</DataArray></Points><Polys>"
           "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">%s</DataArray>"
           "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">%s</DataArray></Polys>"
           "</Piece></PolyData></VTKFile>\n",
           n_points, n_polys, points, corners, offsets);
  scratch_write_text(name, text);
}

static void expect_second(const char *second, const char *part_of_text) {
  const char *const paths[n_files] = {scratch_path("first.vtp"), scratch_path(second)};
  riis_vtk_motion *motion = NULL;
  scratch_watch_output();
  const riis_status status = riis_vtk_motion_read_files(n_files, paths, times, NULL, &motion);
  const long n_printed = scratch_end_watch();
  expect_refused(status, RIIS_FILE_ERROR, part_of_text);
  expect_refused(status, RIIS_FILE_ERROR, second);
  assert_null(motion);
  assert_int_equal(n_printed, 0);
}

TEST(test_other_cells) {
  const char *const points = "0 0 0  1 0 0  1 1 0  0 1 0", *const two = "0 1 2 0 2 3";
  write_square("first.vtp", points, two, "3 6", 4, 2);
  expect_second("missing.vtp", "No such file or directory");
  write_square("points.vtp", "0 0 0  1 0 0  1 1 0  0 1 0  5 5 5", two, "3 6", 5, 2);
  expect_second("points.vtp", "has 5 points, the first file 4; all files of a motion have the same points and cells");
  write_square("cells.vtp", points, "0 1 2", "3", 4, 1);
  expect_second("cells.vtp", "has 1 cells, the first file 2; all files");
  write_square("corner.vtp", points, "0 1 2 0 2 1", "3 6", 4, 2);
  expect_second("corner.vtp", "corner 2 of cell 1 is point 1; in the first file it is point 3");
  write_square("order.vtp", points, "0 2 3 0 1 2", "3 6", 4, 2);
  expect_second("order.vtp", "corner 1 of cell 0 is point 2; in the first file it is point 1");
  write_square("quad.vtp", points, "0 1 2 0 1 2 3", "3 7", 4, 2);
  expect_second("quad.vtp", "cell 1 is a vtkQuad with 4 points; in the first file it is a vtkTriangle with 3");
  write_square("spoilt.vtp", points, "0 1 7 0 2 3", "3 6", 4, 2);
  expect_second("spoilt.vtp", "cell 0 names point 7 of 4");
}

TEST(test_bad_coordinates) {
  const struct {
    const char *points, *text;
  } cases[] = {
      {"0 0 0  1 0 0  1 nan 0  0 1 0", "y of point 2 is nan; it must be finite and at most 1e+60 in magnitude"},
      {"0 0 0  1 0 0  1 1 0  inf 1 0", "x of point 3 is inf; it must be finite"},
      {"0 0 -2e60  1 0 0  1 1 0  0 1 0", "z of point 0 is -2e+60; it must be finite"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    write_square("first.vtp", "0 0 0  1 0 0  1 1 0  0 1 0", "0 1 2 0 2 3", "3 6", 4, 2);
    write_square("second.vtp", cases[i].points, "0 1 2 0 2 3", "3 6", 4, 2);
    expect_second("second.vtp", cases[i].text);
    write_square("first.vtp", cases[i].points, "0 1 2 0 2 3", "3 6", 4, 2);
    const char *const paths[1] = {scratch_path("first.vtp")};
    riis_vtk_motion *motion = NULL;
    expect_refused(riis_vtk_motion_read_files(1, paths, times, NULL, &motion), RIIS_FILE_ERROR, cases[i].text);
  }
}

TEST(test_bad_lists) {
  sheet_write("a.vtp", 0, NULL);
  const char *const path = scratch_path("a.vtp"), *const paths[3] = {path, path, path}, *const hole[2] = {path, NULL};
  const double equal[3] = {0, 0.5, 0.5}, odd[2] = {0, NAN}, large[2] = {0, 2e30};
  riis_vtk_motion *motion = NULL;
#define REFUSED(text, n, the_paths, the_times)                                                                     \
  expect_refused(riis_vtk_motion_read_files(n, the_paths, the_times, NULL, &motion), RIIS_INVALID_ARGUMENT, text); \
  assert_null(motion)
  REFUSED("n_files is 0; it must be from 1 to 1000000", 0, paths, equal);
  REFUSED("n_files is -1; it must be from 1 to 1000000", -1, paths, equal);
  REFUSED("n_files is 1000001; it must be from 1 to 1000000", 1000001, paths, equal);
  REFUSED("paths is NULL", 2, NULL, equal);
  REFUSED("paths[1] is NULL", 2, hole, equal);
  REFUSED("times is NULL", 2, paths, NULL);
  REFUSED("times[2] is 0.5; it must be above the time before it, 0.5", 3, paths, equal);
  REFUSED("times[1] is nan; it must be finite and at most 1e30 in magnitude", 2, paths, odd);
  REFUSED("times[1] is 2e+30; it must be finite and at most 1e30 in magnitude", 2, paths, large);
#undef REFUSED
  expect_refused(riis_vtk_motion_read_files(2, paths, equal, NULL, NULL), RIIS_INVALID_ARGUMENT, "motion is NULL");
  expect_refused(riis_vtk_motion_read_files(2, paths, equal, "part", &motion), RIIS_FILE_ERROR,
                 "a.vtp: has no cell array part; there are: riis_leaflet");
  expect_refused(riis_vtk_motion_read_pvd(NULL, NULL, &motion), RIIS_INVALID_ARGUMENT, "path is NULL");
  expect_refused(riis_vtk_motion_read_pvd(path, NULL, NULL), RIIS_INVALID_ARGUMENT, "motion is NULL");
}

static void expect_displacements(const char *arrays, const char *field, int64_t n_times, riis_status status,
                                 const char *part_of_text) {
  const sheet_extras extras = {arrays, field};
  const double given[2] = {0, 1};
  riis_vtk_motion *motion = NULL;
  sheet_write("moved.vtp", 0, &extras);
  expect_refused(riis_vtk_motion_read_displacements(scratch_path("moved.vtp"), "d", n_times, n_times ? given : NULL,
                                                    NULL, &motion),
                 status, part_of_text);
  if (status == RIIS_FILE_ERROR) expect_refused(status, RIIS_FILE_ERROR, "moved.vtp: ");
  assert_null(motion);
}

TEST(test_bad_displacements) {
  static char two[16384], text[16384];
  sheet_displacement(sheet_displacement(two, "d_0", 0), "d_1", 1);
  expect_displacements(NULL, NULL, 2, RIIS_FILE_ERROR, "has no point array d_0, d_1, ...; there is none");
  sheet_displacement(text, "move_0", 0);
  expect_displacements(text, NULL, 2, RIIS_FILE_ERROR, "has no point array d_0, d_1, ...; there are: move_0");
  sheet_displacement(sheet_displacement(text, "d_1", 0), "d_01", 1);
  expect_displacements(text, NULL, 2, RIIS_FILE_ERROR, "has the point arrays d_1 and d_01 with the same number");
  char numbers[600] = "", words[600] = "";
  for (int i = 0; i < 40; ++i) strcat(numbers, "0 ");
  for (int i = 0; i < 20; ++i) strcat(words, "97 0 ");
  snprintf(text, sizeof text,
           "<DataArray type=\"Float64\" Name=\"d_0\" NumberOfComponents=\"2\" format=\"ascii\">%s</DataArray>",
           numbers);
  expect_displacements(text, NULL, 1, RIIS_FILE_ERROR, "point array d_0 has 2 components; displacements have 3");
  snprintf(text, sizeof text, "<Array type=\"String\" Name=\"d_0\" format=\"ascii\">%s</Array>", words);
  expect_displacements(text, NULL, 1, RIIS_FILE_ERROR, "point array d_0 holds no numbers");
  expect_displacements(two, NULL, 1, RIIS_INVALID_ARGUMENT, "n_times is 1; the file has 2 point arrays d_*");
  /* One component of the last displacement becomes infinite. */
  char *last = sheet_displacement(sheet_displacement(text, "d_0", 0), "d_1", 1);
  last -= strlen("</DataArray>\n") + 1;
  while (last[-1] != ' ') --last;
  strcpy(last, "inf\n</DataArray>");
  expect_displacements(text, NULL, 2, RIIS_FILE_ERROR, "z of point 19, displaced by d_1, is inf; it must be finite");
}

#define TIME_VALUE(n, values) \
  "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"" n "\" format=\"ascii\">" values "</DataArray>"

TEST(test_bad_times_of_displacements) {
  static char two[16384];
  const double descending[2] = {1, 0};
  riis_vtk_motion *motion = NULL;
  sheet_displacement(sheet_displacement(two, "d_0", 0), "d_1", 1);
  expect_displacements(two, NULL, 0, RIIS_FILE_ERROR,
                       "has no field array TimeValue, and no times are given; there is none");
  expect_displacements(two, TIME_VALUE("1", "0"), 0, RIIS_FILE_ERROR,
                       "field array TimeValue has 1 numbers, for 2 point arrays d_*");
  expect_displacements(two, TIME_VALUE("2", "1 1"), 0, RIIS_FILE_ERROR,
                       "value 1 of field array TimeValue is 1, which is not above the value before it, 1");
  expect_displacements(two, TIME_VALUE("2", "nan 1"), 0, RIIS_FILE_ERROR,
                       "value 0 of field array TimeValue is nan; it must be finite and at most 1e30 in magnitude");
  const sheet_extras extras = {two, NULL};
  sheet_write("moved.vtp", 0, &extras);
  sheet_write("moved.stl", 0, NULL);
  const char *path = scratch_path("moved.vtp");
#define REFUSED(text, ...) \
  expect_refused(riis_vtk_motion_read_displacements(__VA_ARGS__, NULL, &motion), RIIS_INVALID_ARGUMENT, text)
  REFUSED("path is NULL", NULL, "d", 2, times);
  REFUSED("prefix is NULL", path, NULL, 2, times);
  REFUSED("prefix is \"\"", path, "", 2, times);
  REFUSED("times is NULL", path, "d", 2, NULL);
  REFUSED("n_times is 0; it must be from 1 to 1000000", path, "d", 0, times);
  REFUSED("times[1] is 0; it must be above the time before it, 1", path, "d", 2, descending);
#undef REFUSED
  expect_refused(riis_vtk_motion_read_displacements(path, "d", 2, times, NULL, NULL), RIIS_INVALID_ARGUMENT,
                 "motion is NULL");
  expect_refused(riis_vtk_motion_read_displacements(scratch_path("moved.stl"), "d", 2, times, NULL, &motion),
                 RIIS_FILE_ERROR, "moved.stl: displacements must be in a .vtp or .vtu file");
  assert_null(motion);
}

TEST(test_arguments_of_arrays) {
  riis_vtk_motion *motion = NULL;
  riis_surface_arrays faces;
  riis_keyframe_arrays frames;
  sheet_write("a.vtp", 0, NULL);
  const char *const paths[1] = {scratch_path("a.vtp")};
  expect_fine(riis_vtk_motion_read_files(1, paths, times, NULL, &motion));
  expect_refused(riis_vtk_motion_get_arrays(NULL, &faces, sizeof faces), RIIS_INVALID_ARGUMENT, "motion is NULL");
  expect_refused(riis_vtk_motion_get_arrays(motion, NULL, sizeof faces), RIIS_INVALID_ARGUMENT, "arrays is NULL");
  expect_refused(riis_vtk_motion_get_arrays(motion, &faces, sizeof faces + 1), RIIS_INVALID_STRUCT_SIZE,
                 "the struct size of arrays is ");
  expect_refused(riis_vtk_motion_get_frames(NULL, &frames, sizeof frames), RIIS_INVALID_ARGUMENT, "motion is NULL");
  expect_refused(riis_vtk_motion_get_frames(motion, NULL, sizeof frames), RIIS_INVALID_ARGUMENT, "frames is NULL");
  expect_refused(riis_vtk_motion_get_frames(motion, &frames, 0), RIIS_INVALID_STRUCT_SIZE,
                 "the struct size of frames is 0; ");
  expect_refused(riis_vtk_motion_get_files(NULL, NULL, NULL), RIIS_INVALID_ARGUMENT, "motion is NULL");
  expect_fine(riis_vtk_motion_get_files(motion, NULL, NULL));
  expect_refused(riis_vtk_motion_number_pieces(NULL), RIIS_INVALID_ARGUMENT, "motion is NULL");
  riis_vtk_motion_destroy(&motion);
  riis_vtk_motion_destroy(&motion);
  riis_vtk_motion_destroy(NULL);
}

/* Returns true if the collection was read completely. Otherwise the message of the refusal must name the collection. */
static int is_read_or_refused(const char *name) {
  riis_vtk_motion *motion = NULL;
  const riis_status status = riis_vtk_motion_read_pvd(scratch_path(name), NULL, &motion);
  const int read = status == RIIS_OK && motion;
  riis_vtk_motion_destroy(&motion);
  return read || (status == RIIS_FILE_ERROR && strstr(riis_last_error(), ": "));
}

/* A collection is cut off after each of its bytes. Each byte is also replaced by other bytes. */
TEST(test_damaged_collections) {
  static const unsigned char others[] = {0, '<', '"', '&', 0xff};
  char text[] = "<?xml version=\"1.0\"?>\n" COLLECTION("\n" DATA_SET("0", "a.vtp") "\n" DATA_SET("0.5", "a.vtp"));
  const size_t size = strlen(text);
  sheet_write("a.vtp", 0, NULL);
  scratch_write_text("damaged.pvd", text);
  assert_true(is_read_or_refused("damaged.pvd"));
  scratch_watch_output();
  for (size_t i = 0; i < size; ++i) {
    scratch_write("damaged.pvd", text, i);
    riis_vtk_motion *motion = NULL;
    const riis_status status = riis_vtk_motion_read_pvd(scratch_path("damaged.pvd"), NULL, &motion);
    /* Only the last byte, a line break, may be missing. */
    if ((status == RIIS_OK) != (i == size - 1)) fail_msg("cut to %zu bytes: %s", i, riis_status_name(status));
    riis_vtk_motion_destroy(&motion);
    for (size_t k = 0; k < sizeof others; ++k) {
      const char kept = text[i];
      text[i] = (char)others[k];
      scratch_write("damaged.pvd", text, size);
      text[i] = kept;
      if (!is_read_or_refused("damaged.pvd")) fail_msg("byte %zu became %d: %s", i, others[k], riis_last_error());
    }
  }
  assert_int_equal(scratch_end_watch(), 0);
}

/* A million nested elements would overflow the stack of a recursive reader. XML entities that refer to other entities would fill
 * the memory of a reader that expands them. */
TEST(test_hostile_collections) {
  const size_t n = 1000000;
  char *text = malloc(200 + 7 * n), *end = text;
  assert_non_null(text);
  end += sprintf(end, "<VTKFile type=\"Collection\"><Collection>");
  for (size_t i = 0; i < n; ++i, end += 3) memcpy(end, "<a>", 3);
  for (size_t i = 0; i < n; ++i, end += 4) memcpy(end, "</a>", 4);
  sprintf(end, "</Collection></VTKFile>");
  scratch_write_text("deep.pvd", text);
  expect_collection("deep.pvd", NULL, "deep.pvd: ", "names no files");
  end = text + sprintf(text, "<!DOCTYPE VTKFile [<!ENTITY a0 \"laughs \">");
  for (int i = 1; i < 10; ++i) {
    end += sprintf(end, "<!ENTITY a%d \"", i);
    for (int k = 0; k < 10; ++k) end += sprintf(end, "&a%d;", i - 1);
    end += sprintf(end, "\">");
  }
  sprintf(end, "]>" COLLECTION("<DataSet timestep=\"0\" file=\"&a9;\"/>"));
  scratch_write_text("laughs.pvd", text);
  free(text);
  expect_collection("laughs.pvd", NULL, "laughs.pvd: ", "amplification");
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
