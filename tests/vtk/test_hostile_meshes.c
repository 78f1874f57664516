/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests files of meshes that cannot be read. Each file that cannot be read causes an error, and the message names the file. The
 * call prints and returns nothing. A truncated file is never read as a smaller mesh. */
#include <riis/riis_vtk.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "expect.h"
#include "scratch.h"
#include "vtk_shim.h"

static const double lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};

static riis_status read_mesh(const char *name, riis_vtk_mesh **mesh) {
  *mesh = NULL;
  return riis_vtk_mesh_read(scratch_path(name), mesh);
}

static void expect_file_error(const char *name, const char *part_of_text) {
  riis_vtk_mesh *mesh = NULL;
  scratch_watch_output();
  const riis_status status = read_mesh(name, &mesh);
  const long n_printed = scratch_end_watch();
  expect_refused(status, RIIS_FILE_ERROR, part_of_text);
  expect_refused(status, RIIS_FILE_ERROR, name);
  assert_null(mesh);
  assert_int_equal(n_printed, 0);
}

/* If `error` is NULL, the file must be read. Otherwise the file must be refused with the message `error`. */
static void expect_file(const char *name, const char *error) {
  if (error) {
    expect_file_error(name, error);
    return;
  }
  riis_vtk_mesh *mesh = NULL;
  expect_fine(read_mesh(name, &mesh));
  riis_vtk_mesh_destroy(&mesh);
}

TEST(test_not_files) {
  expect_file_error("missing.vtu", "No such file or directory");
  assert_int_equal(mkdir(scratch_path("folder.vtu"), 0700), 0);
  expect_file_error("folder.vtu", "is a directory");
  assert_int_equal(mkfifo(scratch_path("pipe.vtu"), 0600), 0);
  expect_file_error("pipe.vtu", "is not a regular file");
  scratch_write_text("empty.vtu", "");
  expect_file_error("empty.vtu", "is empty");
  scratch_write_text("empty.vtk", "");
  expect_file_error("empty.vtk", "is empty");
  scratch_write_text("mesh.obj", "v 0 0 0\n");
  expect_file_error(
      "mesh.obj",
      "a mesh must be a .vtu, .vtk, .vti, .vtr, .vts, .vtm, .msh, .xdmf or .exo file, or a case of OpenFOAM");
  scratch_write_text("no_ending", "v 0 0 0\n");
  expect_file_error(
      "no_ending",
      "a mesh must be a .vtu, .vtk, .vti, .vtr, .vts, .vtm, .msh, .xdmf or .exo file, or a case of OpenFOAM");
}

TEST(test_unreadable) {
  if (geteuid() == 0) skip(); /* root may read every file, so the test is skipped */
  scratch_write_text("locked.vtu", "<VTKFile type=\"UnstructuredGrid\"></VTKFile>");
  assert_int_equal(chmod(scratch_path("locked.vtu"), 0), 0);
  expect_file_error("locked.vtu", "Permission denied");
}

TEST(test_other_content) {
  scratch_write_text("garbage.vtu", "\x01\x02 not a mesh at all \xff\xfe");
  expect_file_error("garbage.vtu", "is not a VTK XML file");
  scratch_write_text("garbage.vtk", "\x01\x02 not a mesh at all \xff\xfe");
  expect_file_error("garbage.vtk", "is not a legacy VTK file");
  scratch_write_text("html.vtu", "<html><body>404</body></html>");
  expect_file_error("html.vtu", "is not a VTK XML file");
  scratch_write_text(
      "image.vtu",
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "<ImageData WholeExtent=\"0 1 0 1 0 1\" Origin=\"0 0 0\" Spacing=\"1 1 1\">"
      "<Piece Extent=\"0 1 0 1 0 1\"/></ImageData></VTKFile>\n");
  expect_file_error("image.vtu", "holds ImageData, not UnstructuredGrid");
  scratch_write_text("polydata.vtk",
                     "# vtk DataFile Version 3.0\npoly\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\n"
                     "POLYGONS 1 4\n3 0 1 2\n");
  expect_file_error("polydata.vtk", "holds polydata, not unstructured_grid");
  /* If VTK cannot read the version, VTK assumes an old version. */
  static const char *const versions[] = {"4294967300.1",       "6.0", "-5.1", "0.9", "5", "5.1x", "5.100",
                                         "00000000000000005.1"};
  for (size_t i = 0; i < sizeof versions / sizeof *versions; ++i) {
    char text[256], reason[64];
    snprintf(text, sizeof text,
             "# vtk DataFile Version %s\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
             "CELLS 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 1 2\nCELL_TYPES 1\n5\n",
             versions[i]);
    scratch_write_text("version.vtk", text);
    snprintf(reason, sizeof reason, "has the version '%s'", versions[i]);
    expect_file_error("version.vtk", reason);
  }
  scratch_write_text("not_closed.vtu", "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>\n</VTKFile>\n");
  expect_file_error("not_closed.vtu", "mismatched tag");
}

/* A grid of one tetrahedron, in parts that a test can damage. */
static void write_tetrahedron(const char *name, const char *counts, const char *points, const char *corners,
                              const char *offsets, const char *types, const char *point_data) {
  char text[2048];
  snprintf(text, sizeof text,
           "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
           "<UnstructuredGrid><Piece %s>\n<PointData>%s</PointData>\n"
           "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">%s</DataArray></Points>\n"
           "<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">%s</DataArray>\n"
           "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">%s</DataArray>\n"
           "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">%s</DataArray></Cells>\n"
           "</Piece></UnstructuredGrid></VTKFile>\n",
           counts, point_data, points, corners, offsets, types);
  scratch_write_text(name, text);
}

static const char *const counts = "NumberOfPoints=\"4\" NumberOfCells=\"1\"";
static const char *const points = "0 0 0  1 0 0  0 1 0  0 0 1";

TEST(test_promises) {
  riis_vtk_mesh *mesh = NULL;
  write_tetrahedron("good.vtu", counts, points, "0 1 2 3", "4", "10", "");
  expect_fine(read_mesh("good.vtu", &mesh));
  riis_vtk_mesh_destroy(&mesh);
  assert_null(mesh);

  write_tetrahedron("no_points.vtu", "NumberOfPoints=\"0\" NumberOfCells=\"0\"", "", "", "", "", "");
  expect_file_error("no_points.vtu", "holds no points");
  write_tetrahedron("few_points.vtu", counts, "0 0 0  1 0 0  0 1 0", "0 1 2 3", "4", "10", "");
  expect_file_error("few_points.vtu", "few_points.vtu: ");
  write_tetrahedron("few_corners.vtu", counts, points, "0 1 2", "4", "10", "");
  expect_file_error("few_corners.vtu", "few_corners.vtu: ");
  write_tetrahedron("few_types.vtu", counts, points, "0 1 2 3", "4", "", "");
  expect_file_error("few_types.vtu", "few_types.vtu: ");
  write_tetrahedron("short_array.vtu", counts, points, "0 1 2 3", "4", "10",
                    "<DataArray type=\"Float64\" Name=\"p\" format=\"ascii\">1 2 3</DataArray>");
  expect_file_error("short_array.vtu", "short_array.vtu: ");
  write_tetrahedron("huge.vtu", "NumberOfPoints=\"999999999999999999\" NumberOfCells=\"1\"", points, "0 1 2 3", "4",
                    "10", "");
  riis_status status = read_mesh("huge.vtu", &mesh);
  assert_true(status == RIIS_FILE_ERROR || status == RIIS_OUT_OF_MEMORY);
  write_tetrahedron("negative.vtu", "NumberOfPoints=\"-4\" NumberOfCells=\"1\"", points, "0 1 2 3", "4", "10", "");
  status = read_mesh("negative.vtu", &mesh);
  assert_true(status == RIIS_FILE_ERROR || status == RIIS_OUT_OF_MEMORY);
}

TEST(test_broken_cells) {
  write_tetrahedron("corner.vtu", counts, points, "0 1 2 4", "4", "10", "");
  expect_file_error("corner.vtu", "cell 0 names point 4 of 4");
  write_tetrahedron("negative_corner.vtu", counts, points, "0 1 2 -1", "4", "10", "");
  expect_file_error("negative_corner.vtu", "cell 0 names point -1 of 4");
  write_tetrahedron("wrong_size.vtu", counts, points, "0 1 2 3", "4", "12", "");
  expect_file_error("wrong_size.vtu", "cell 0 is a vtkHexahedron with 4 points");
  write_tetrahedron("unknown_type.vtu", counts, points, "0 1 2 3", "4", "200", "");
  expect_file_error("unknown_type.vtu", "cell 0 has the unknown type 200");
  write_tetrahedron("offset.vtu", counts, points, "0 1 2 3", "-4", "10", "");
  expect_file_error("offset.vtu", "offset.vtu: ");
  write_tetrahedron("polyhedron.vtu", counts, points, "0 1 2 3", "4", "42", "");
  expect_file_error("polyhedron.vtu", "polyhedron.vtu: ");
  scratch_write_text("cells.vtk",
                     "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
                     "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 9\nCELL_TYPES 1\n10\n");
  expect_file_error("cells.vtk", "cell 0 names point 9 of 4");
  scratch_write_text("sizes.vtk",
                     "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
                     "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n9 0 1 2 3\nCELL_TYPES 1\n10\n");
  expect_file_error("sizes.vtk", "cell 0 has 9 points");
  scratch_write_text("types.vtk",
                     "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
                     "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 0 0\n");
  expect_file_error("types.vtk", "has 0 types for 0 cells (is it truncated?)");
  scratch_write_text("types.vtk",
                     "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
                     "0 0 0 1 0 0 0 1 0 0 0 1\n");
  expect_file_error("types.vtk", "holds no cells (is it truncated?)");
}

/* The reader accepts NaN and infinite coordinates, because the core checks coordinates. */
TEST(test_not_a_number_passes) {
  write_tetrahedron("nan.vtu", counts, "0 0 0  nan 0 0  0 1 0  0 0 1", "0 1 2 3", "4", "10", "");
  riis_vtk_mesh *mesh = NULL;
  expect_fine(read_mesh("nan.vtu", &mesh));
  int64_t n = 0;
  const double *xyz = NULL;
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, NULL, &xyz));
  assert_true(xyz[3] != xyz[3]);
  riis_mesh *nodes = NULL;
  expect_refused(riis_mesh_create(n, xyz, xyz + 1, xyz + 2, 3, &nodes), RIIS_INVALID_MESH, "node 1");
  riis_vtk_mesh_destroy(&mesh);
}

/* Returns whether a file may be read without its last n bytes. These bytes may be blanks. A legacy file has no end mark, so
 * digits of its last number or whole sections after the cells may also be missing. */
static int may_be_missing(const char *bytes, size_t n, int encoding) {
  size_t i = 0;
  if (encoding == SHIM_LEGACY_ASCII) i += strspn(bytes, "0123456789.e+-");
  i += strspn(bytes + i, " \n");
  const int legacy = encoding == SHIM_LEGACY_ASCII || encoding == SHIM_LEGACY_BINARY;
  const int section = legacy && (!strncmp(bytes + i, "CELL_DATA", 9) || !strncmp(bytes + i, "POINT_DATA", 10) ||
                                 !strncmp(bytes + i, "FIELD", 5));
  return i == n || section;
}

/* Cuts off a valid file after each of its bytes. The cut file must be refused, or give the whole mesh. */
static void cut_everywhere(const char *whole, const char *cut, int encoding) {
  assert_int_equal(shim_write_box(scratch_path(whole), encoding, 2, lower, upper, 0), 1);
  size_t size = 0;
  char *bytes = scratch_read(scratch_path(whole), &size);
  int n_refused = 0;
  scratch_write(cut, bytes, size);
  scratch_watch_output();
  for (size_t kept = size + 1; kept-- > 0;) {
    assert_int_equal(truncate(scratch_path(cut), (off_t)kept), 0);
    riis_vtk_mesh *mesh = NULL;
    int64_t n_nodes = -1, n_cells = -1;
    const riis_status status = read_mesh(cut, &mesh);
    if (mesh) riis_vtk_mesh_get_nodes(mesh, &n_nodes, &n_cells, NULL);
    riis_vtk_mesh_destroy(&mesh);
    const int whole_mesh =
        status == RIIS_OK && n_nodes == 8 && n_cells == 6 && may_be_missing(bytes + kept, size - kept, encoding);
    const int refused = status == RIIS_FILE_ERROR && n_nodes == -1 && strstr(riis_last_error(), cut);
    n_refused += refused;
    if (!whole_mesh && !refused) {
      scratch_end_watch();
      fail_msg("%s cut to %zu of %zu bytes: %s, %d nodes, %d cells, %s", cut, kept, size, riis_status_name(status),
               (int)n_nodes, (int)n_cells, riis_last_error());
    }
  }
  assert_int_equal(scratch_end_watch(), 0);
  free(bytes);
  assert_true(n_refused > (int)(size / 2));
}

/* Writes the whole numbers of a text to a file: as text, or as four bytes each with the high byte first. Returns the number of
 * bytes. */
static size_t put_numbers(unsigned char *to, const char *numbers, int is_binary) {
  if (!is_binary) return (size_t)sprintf((char *)to, "%s\n", numbers);
  size_t n = 0;
  for (char *rest; *numbers; numbers = rest) {
    const uint32_t value = (uint32_t)strtol(numbers, &rest, 10);
    for (int byte = 3; byte >= 0; --byte) to[n++] = (unsigned char)(value >> (8 * byte));
  }
  to[n++] = '\n';
  return n;
}

TEST(test_truncated) {
  cut_everywhere("ascii.vtu", "cut.vtu", SHIM_ASCII);
  cut_everywhere("binary.vtu", "cut.vtu", SHIM_BINARY);
  cut_everywhere("compressed.vtu", "cut.vtu", SHIM_COMPRESSED);
  cut_everywhere("raw.vtu", "cut.vtu", SHIM_RAW);
  cut_everywhere("ascii.vtk", "cut.vtk", SHIM_LEGACY_ASCII);
  cut_everywhere("binary.vtk", "cut.vtk", SHIM_LEGACY_BINARY);
}

/* VTK searches for as many keys as INFORMATION announces. VTK does not stop this search at a word that is not a number. VTK
 * compares only the beginning of a keyword. */
TEST(test_endless_information) {
  const struct {
    const char *keys, *data, *text;
  } cases[] = {
      {"METADATA\nINFORMATION 1", "DATA 2 1 2", NULL},
      {"METADATA\nINFORMATION 2", "DATA 2 1 2", "has INFORMATION of 2 keys and gives 1"},
      {"METADATA\nINFORMATION 1", "DATA 2 ; 2", "has ';' for a number of type double"},
      {"METADATA\nINFORMATION 1", "DATA 2 1 nan", "has 'nan' for a number of type double"},
      {"METADATA\nINFORMATION 1", "DATA 2 1", "has '' for a number of type double"},
      {"METADATA\nINFORMATION 1", "DATA -1", "has metadata with the count -1"},
      {"METADATA\nINFORMATION 1", "1 2", "has metadata with '1' in the place of DATA"},
      {"METADATA\nINFORMATION1", "DATA 2 1 2", NULL},
      {"METADATA\ninformation8 1", "DATA 3 1 2", "has '' for a number of type double"},
      {"METADATA\ninformation8 1", "DATA 2 1 2", "has INFORMATION of 8 keys and gives 1"},
      {"MetaData_x\nINFORMATION 2", "DATA 2 1 2", "has INFORMATION of 2 keys and gives 1"},
      {"METADATA\nINFORMATION", "DATA 2 1 2", "has '' for a number"},
      {"METADATA\nCOMPONENT_NAMES2\nINFORMATION\n2\nINFORMATION 1", "DATA 2 1 2", NULL},
      {"METADATA\nINFORMATION 1", "DATA 2 1 2\nInformation9", "has metadata with 'Information9' behind INFORMATION"},
      {"METADATA\nINFORMATION 1", "DATA 2 1 2\nCOMPONENT_NAMES",
       "has metadata with 'COMPONENT_NAMES' behind INFORMATION"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    char text[1024];
    snprintf(text, sizeof text,
             "# vtk DataFile Version 4.2\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 double\n0 0 0\nCELLS 0 0\n"
             "CELL_TYPES 0\nPOINT_DATA 1\nFIELD FieldData 1\na 2 1 int\n1 2\n%s\n"
             "NAME L2_NORM_RANGE LOCATION vtkDataArray\n%s\n\n",
             cases[i].keys, cases[i].data);
    scratch_write_text("information.vtk", text);
    expect_file("information.vtk", cases[i].text);
  }
}

/* The library reads names as VTK does. NULL_ARRAY, in capitals, stands for a missing array. A name of more than 255 characters
 * counts as two words. */
TEST(test_names_of_arrays) {
  char longest[256], too_long[257];
  memset(longest, 'n', sizeof longest);
  memset(too_long, 'n', sizeof too_long);
  longest[255] = too_long[256] = '\0';
  const struct {
    const char *name, *text;
  } cases[] = {{"NULL_ARRAY b", NULL},
               {"Null_Array", NULL},
               {"NULL_ARRAY", "has 'int' for a number"},
               {longest, NULL},
               {too_long, "has a word of 256 characters, more than 255"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    char text[1024];
    snprintf(text, sizeof text,
             "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n0 0 0\nCELLS 1 2\n1 0\n"
             "CELL_TYPES 1\n1\nPOINT_DATA 1\nFIELD FieldData %d\n%s 1 1 int\n7\n",
             i == 0 || i == 2 ? 2 : 1, cases[i].name);
    scratch_write_text("names.vtk", text);
    expect_file("names.vtk", cases[i].text);
  }
}

/* VTK reads the faces of polyhedra without checks of their numbers. The files are text of version 3, binary of version 3, or text
 * of version 5, which has offsets instead of counts. The type of a polyhedron is 42. The type 298 becomes 42 if only its low byte
 * is kept. */
TEST(test_polyhedra) {
  const char tetrahedron[] = "4 3 0 1 2 3 0 1 3 3 0 2 3 3 1 2 3";
  const struct {
    const char *faces;
    int type;
    const char *text;
  } cases[] = {{tetrahedron, 42, NULL},
               {tetrahedron, 298, NULL},
               {"4 3 0 1 2 3 0 1 3 3 0 2 3 3 1 2 4", 42, "cell 1 names point 4 of 4"},
               {"4 3 0 1 2 3 0 1 3 3 0 2 3 3 1 2 -1", 42, "cell 1 names point -1 of 4"},
               {"4 3 0 1 2 3 0 1 3 3 0 2 3 4 1 2 3", 42, "cell 1 has broken polyhedron faces"},
               {"4 3 0 1 2 3 0 1 3 3 0 2 3 2 1 2 3", 42, "cell 1 has broken polyhedron faces"},
               {"5 3 0 1 2 3 0 1 3 3 0 2 3 3 1 2 3", 42, "cell 1 has broken polyhedron faces"},
               {"3 3 0 1 2 3 0 1 3 3 0 2 3 3 1 2 3", 298, "cell 1 has broken polyhedron faces"},
               {"-1 3 0 1 2 3 0 1 3 3 0 2 3 3 1 2 3", 42, "cell 1 has broken polyhedron faces"},
               {"2147483647 3 0 1 2 3 0 1 3 3 0 2 3 3 1 2 3", 42, "cell 1 has broken polyhedron faces"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    for (int form = 0; form < 3; ++form) {
      const int is_binary = form == 1, has_offsets = form == 2;
      unsigned char bytes[2048];
      size_t n =
          (size_t)sprintf((char *)bytes, "# vtk DataFile Version %s\nx\n%s\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 int\n",
                          has_offsets ? "5.1" : "3.0", is_binary ? "BINARY" : "ASCII");
      const char *numbers = "0 0 0 1 0 0 0 1 0 0 0 1";
      char cells[256], types[32];
      snprintf(cells, sizeof cells, has_offsets ? "0 1 2 3 %s" : "4 0 1 2 3 17 %s", cases[i].faces);
      snprintf(types, sizeof types, "10 %d", cases[i].type);
      n += put_numbers(bytes + n, numbers, is_binary);
      if (has_offsets)
        n +=
            (size_t)sprintf((char *)bytes + n, "CELLS 3 21\nOFFSETS vtktypeint64\n0 4 21\nCONNECTIVITY vtktypeint64\n");
      else
        n += (size_t)sprintf((char *)bytes + n, "CELLS 2 23\n");
      n += put_numbers(bytes + n, cells, is_binary);
      n += (size_t)sprintf((char *)bytes + n, "CELL_TYPES 2\n");
      n += put_numbers(bytes + n, types, is_binary);
      scratch_write("polyhedra.vtk", bytes, n);
      expect_file("polyhedra.vtk", cases[i].text);
    }
}

TEST(test_cells_of_polyhedra) {
  const struct {
    const char *cells, *text;
  } cases[] = {
      {"CELLS 3 21\nOFFSETS vtktypeint64\n0 22 21\nCONNECTIVITY vtktypeint64\n", "has broken cell offsets"},
      {"CELLS 3 21\nOFFSETS vtktypeint64\n1 4 21\nCONNECTIVITY vtktypeint64\n", "has broken cell offsets"},
      {"CELLS 3 21\nOFFSETS vtktypeint64\n0 4 22\nCONNECTIVITY vtktypeint64\n", "has broken cell offsets"},
      {"CELLS 3 21\nOFFSETS double\n0 4 21\nCONNECTIVITY vtktypeint64\n", "has polyhedra, and cells of type double"},
      {"CELLS 0 0\nCELLS 3 21\nOFFSETS vtktypeint64\n0 4 21\nCONNECTIVITY vtktypeint64\n", "has CELLS twice"},
      {"CELL_TYPES 1\n1\nCELLS 3 21\nOFFSETS vtktypeint64\n0 4 21\nCONNECTIVITY vtktypeint64\n",
       "has CELL_TYPES twice"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    char text[1024];
    snprintf(
        text, sizeof text,
        "# vtk DataFile Version 5.1\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 int\n0 0 0 1 0 0 0 1 0 0 0 1\n%s"
        "0 1 2 3 4 3 0 1 2 3 0 1 3 3 0 2 3 3 1 2 3\nCELL_TYPES 2\n10 42\n",
        cases[i].cells);
    scratch_write_text("cells.vtk", text);
    expect_file_error("cells.vtk", cases[i].text);
  }
}

/* If VTK meets a word that is not a number of the array's type, it closes the file and goes on. */
TEST(test_words_for_numbers) {
  const struct {
    const char *point, *cell, *text;
  } cases[] = {{"0 0 +1.5e-400", "1 0", NULL},
               {"0 0 CELLS", "1 0", "has 'CELLS' for a number of type float"},
               {"0 0 nan", "1 0", "has 'nan' for a number of type float"},
               {"0 0 1e39", "1 0", "has '1e39' for a number of type float"},
               {"0 0 1.5.5", "1 0", "has '1.5.5' for a number of type float"},
               {"0 0 0", "1 0.5", "has '0.5' for a number of type int"},
               {"0 0 0", "2 0", "cell 0 has 2 points, more than CELLS has"},
               {"0 0 0", "9223372036854775807 0", "cell 0 has 9223372036854775807 points, more than CELLS has"},
               {"0 0 0", "1 2147483648", "has '2147483648' for a number of type int"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    char text[512];
    snprintf(text, sizeof text,
             "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n%s\nCELLS 1 2\n%s\n"
             "CELL_TYPES 1\n1\n",
             cases[i].point, cases[i].cell);
    scratch_write_text("words.vtk", text);
    expect_file("words.vtk", cases[i].text);
  }
}

/* Two polyhedra are tetrahedra that share a face. The faces of both are in one list, as VTK writes since 9.4. */
TEST(test_lists_of_faces) {
  static const char *const corners = "0 1 2 0 1 3 0 2 3 1 2 3 1 2 4 1 3 4 2 3 4";
  const struct {
    const char *corners, *ends, *faces, *face_ends, *text;
  } cases[] = {{corners, "3 6 9 12 15 18 21", "0 1 2 3 3 4 5 6", "4 8 8", NULL},
               {corners, "3 6 9 12 15 18 21", "0 1 2 3", "4 4 4", "cell 1 has broken polyhedron faces"},
               {corners, "3 6 9 12 15 18 21", "0 1 2 3 3 4 5 6", "4 3 8", "has broken polyhedron_offsets"},
               {corners, "3 6 9 12 15 18 21", "0 1 2 3 3 4 5 6", "-1 8 8", "has broken polyhedron_offsets"},
               {corners, "3 6 9 12 15 18 21", "0 1 2 3 3 4 5 6", "4 80000000 80000000",
                "array polyhedron_to_faces must have 80000000 values and has at most 8"},
               {corners, "3 6 9 12 15 18 21", "0 1 2 3 3 4 5 6", "4 8",
                "array polyhedron_offsets must have 3 values and has at most 2"},
               {corners, "3 6 9 12 15 18 21", "0 1 2 3 3 4 5 -6", "4 8 8", "cell 1 has broken polyhedron faces"},
               {corners, "3 6 9 12 15 18 21", "0 1 2 3 3 4 5 70", "4 8 8",
                "array face_offsets must have 71 values and has at most "},
               {corners, "3 6 9 12 15 18 17", "0 1 2 3 3 4 5 6", "4 8 8", "has broken face_offsets"},
               {corners, "3 6 9 12 15 18 99", "0 1 2 3 3 4 5 6", "4 8 8",
                "array face_connectivity must have 99 values and has at most "},
               {"0 1 2 0 1 3 0 2 3 1 2 3 1 2 4 1 3 4 2 3 5", "3 6 9 12 15 18 21", "0 1 2 3 3 4 5 6", "4 8 8",
                "cell 1 names point 5 of 5"},
               {"0 1 2 0 1 3 0 2 3 1 2 3 1 2 4 1 3 4 2 3 -1", "3 6 9 12 15 18 21", "0 1 2 3 3 4 5 6", "4 8 8",
                "cell 1 names point -1 of 5"},
               {NULL, "3 6 9 12 15 18 21", "0 1 2 3 3 4 5 6", "4 8 8", "has polyhedra without face_connectivity"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    char text[2048];
    snprintf(text, sizeof text,
             "<VTKFile type=\"UnstructuredGrid\" version=\"2.3\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>"
             "<Piece NumberOfPoints=\"5\" NumberOfCells=\"3\">\n<Points><DataArray type=\"Float64\" "
             "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataArray></Points>\n<Cells>"
             "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 1 2 3 4 0 1 2 3</DataArray>\n"
             "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4 8 12</DataArray>\n"
             "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">42 42 10</DataArray>\n"
             "<DataArray type=\"Int64\" Name=\"%s\" format=\"ascii\">%s</DataArray>\n"
             "<DataArray type=\"Int64\" Name=\"face_offsets\" format=\"ascii\">%s</DataArray>\n"
             "<DataArray type=\"Int64\" Name=\"polyhedron_to_faces\" format=\"ascii\">%s</DataArray>\n"
             "<DataArray type=\"Int64\" Name=\"polyhedron_offsets\" format=\"ascii\">%s</DataArray></Cells>\n"
             "</Piece></UnstructuredGrid></VTKFile>\n",
             cases[i].corners ? "face_connectivity" : "faces_connected", cases[i].corners ? cases[i].corners : corners,
             cases[i].ends, cases[i].faces, cases[i].face_ends);
    scratch_write_text("lists.vtu", text);
    expect_file("lists.vtu", cases[i].text);
  }
}

/* Structured grids in legacy files. The sections after the encoding replace %s. */
TEST(test_structured_legacy) {
  static const struct {
    const char *sections, *error;
  } files[] = {
#define IMAGE "STRUCTURED_POINTS\nDIMENSIONS 2 2 2\nORIGIN 0 0 0\nSPACING 1 1 1\n"
#define AXES "RECTILINEAR_GRID\nDIMENSIONS 2 2 2\nX_COORDINATES 2 double\n0 1\nY_COORDINATES 2 double\n0 1\n"
#define CURVED "STRUCTURED_GRID\nDIMENSIONS 2 2 1\nPOINTS 4 double\n0 0 0 1 0 0 0 1 0 1 1 0\n"
      {IMAGE, NULL},
      {IMAGE "POINT_DATA 8\nSCALARS a double 1\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8\n", NULL},
      {IMAGE "CELL_DATA 1\nVECTORS a float\n1 2 3\n", NULL},
      {AXES "Z_COORDINATES 2 float\n0 1\n", NULL},
      {CURVED, NULL},
      {"STRUCTURED_POINTS\nORIGIN 0 0 0\nSPACING 1 1 1\n", "has no DIMENSIONS (is it truncated?)"},
      {"STRUCTURED_POINTS\nDIMENSIONS 0 2 2\n", "holds no points"},
      {"STRUCTURED_POINTS\nDIMENSIONS -3 2 2\n", "holds no points"},
      {"STRUCTURED_POINTS\nDIMENSIONS 2147483648 1 1\n", "has the count 2147483648"},
      {"STRUCTURED_POINTS\nDIMENSIONS 2147483647 2147483647 2147483647\n",
       "claims 2147483647 times 2147483647 times 2147483647 points, more than the 1099511627776 of a mesh"},
      {"STRUCTURED_POINTS\nDIMENSIONS 2147483647 2 2\nORIGIN 0 0 0\nSPACING 1 1 1\n",
       "claims 2147483647 times 2 times 2 points, which need memory of "},
      {"STRUCTURED_POINTS\nDIMENSIONS 1 30000 30000\nORIGIN 0 0 0\nSPACING 1 1 1\n",
       "claims 1 times 30000 times 30000 points, which need memory of "},
      {IMAGE "DIMENSIONS 2 2 2\n", "has DIMENSIONS twice"},
      {IMAGE "POINT_DATA 9\nSCALARS a double 1\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8 9\n", "has POINT_DATA 9 for 8"},
      {IMAGE "CELL_DATA 8\nSCALARS a double 1\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8\n", "has CELL_DATA 8 for 1"},
      {IMAGE "POINT_DATA 8\nSCALARS a double 1\nLOOKUP_TABLE default\n1 2 3 4 5 6 7\n", "is truncated"},
      {IMAGE "CELLS 0 0\n", "has the unknown keyword 'cells'"},
      {IMAGE "POINTS 8 double\n", "has the unknown keyword 'points'"},
      {"STRUCTURED_POINTS\nPOINT_DATA 1\n", "has data before DIMENSIONS"},
      {"STRUCTURED_POINTS\nDIMENSIONS 2 2 2\nSPACING 1 x 1\n", "has 'x' for a number of type double"},
      {AXES, "has 0 Z_COORDINATES for 2 points along the axis"},
      {AXES "Z_COORDINATES 3 double\n0 1 2\n", "has 3 Z_COORDINATES for 2 points along the axis"},
      {AXES "Z_COORDINATES 2000000000 double\n0 1 2\n", "is truncated"},
      {CURVED "X_COORDINATES 2 double\n0 1\n", "has the unknown keyword 'x_coordinates'"},
      {"STRUCTURED_GRID\nDIMENSIONS 2 2 2\nPOINTS 4 double\n0 0 0 1 0 0 0 1 0 1 1 0\n",
       "has 4 points, and DIMENSIONS of 8"},
      {"STRUCTURED_GRID\nDIMENSIONS 2 2 2\n", "has 0 points, and DIMENSIONS of 8"},
#undef IMAGE
#undef AXES
#undef CURVED
  };
  for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
    char text[1024];
    snprintf(text, sizeof text, "# vtk DataFile Version 3.0\nx\nASCII\nDATASET %s", files[i].sections);
    scratch_write_text("structured.vtk", text);
    expect_file("structured.vtk", files[i].error);
  }
}

/* Structured grids in XML files. */
TEST(test_structured_xml) {
  static const struct {
    const char *name, *type, *content, *error;
  } files[] = {
#define IMAGE(whole, piece) "WholeExtent=\"" whole "\" Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"" piece "\">"
#define ARRAY(name, text) "<DataArray type=\"Float64\" Name=\"" name "\" format=\"ascii\">" text "</DataArray>"
#define AXES(x) "WholeExtent=\"0 1 0 1 0 1\"><Piece Extent=\"0 1 0 1 0 1\"><Coordinates>" x "</Coordinates></Piece>"
      {"s.vti", "ImageData", IMAGE("0 1 0 1 0 1", "0 1 0 1 0 1") "</Piece>", NULL},
      {"s.vti", "ImageData",
       IMAGE("0 1 0 1 0 1", "0 1 0 1 0 1") "<PointData>" ARRAY("a", "1 2 3 4 5 6 7 8") "</PointData></Piece>", NULL},
      {"s.vti", "ImageData",
       IMAGE("0 1 0 1 0 1", "0 1 0 1 0 1") "<PointData>" ARRAY("a", "1 2 3") "</PointData></Piece>",
       "array a must have 8 values and has at most 3"},
      {"s.vti", "ImageData", IMAGE("0 1 0 1 0 2", "0 1 0 1 0 1") "</Piece>",
       "has a piece whose Extent is not the WholeExtent"},
      {"s.vti", "ImageData", IMAGE("0 1 0 1 0 1", "0 1 0 1 0 1") "</Piece><Piece Extent=\"0 1 0 1 0 1\"></Piece>",
       "has 2 pieces; a structured grid must have one"},
      {"s.vti", "ImageData", "WholeExtent=\"0 1 0 1 0 1\">", "has 0 pieces; a structured grid must have one"},
      {"s.vti", "ImageData", IMAGE("0 1 0 1", "0 1 0 1") "</Piece>", "ImageData element has no WholeExtent"},
      {"s.vti", "ImageData", IMAGE("0 1 0 1 1 0", "0 1 0 1 1 0") "</Piece>", "holds no points"},
      {"s.vti", "ImageData", IMAGE("0 2147483646 0 1 0 1", "0 2147483646 0 1 0 1") "</Piece>",
       "claims 2147483647 times 2 times 2 points, which need memory of "},
      {"s.vti", "ImageData",
       IMAGE("0 2147483646 0 2147483646 0 2147483646", "0 2147483646 0 2147483646 0 2147483646") "</Piece>",
       "points, more than the 1099511627776 of a mesh"},
      {"s.vti", "ImageData", IMAGE("0 0 0 99999 0 99999", "0 0 0 99999 0 99999") "</Piece>",
       "claims 1 times 100000 times 100000 points, which need memory of "},
      {"s.vtr", "RectilinearGrid", AXES(ARRAY("x", "0 1") ARRAY("y", "0 1") ARRAY("z", "0 1")), NULL},
      {"s.vtr", "RectilinearGrid", AXES(ARRAY("x", "0 1") ARRAY("y", "0") ARRAY("z", "0 1")),
       "array y must have 2 values and has at most 1"},
      {"s.vtr", "RectilinearGrid", AXES(ARRAY("x", "0 1") ARRAY("y", "0 1")), ""},
      {"s.vts", "StructuredGrid",
       "WholeExtent=\"0 1 0 1 0 0\"><Piece Extent=\"0 1 0 1 0 0\"><Points><DataArray type=\"Float64\" "
       "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 1 1 0</DataArray></Points></Piece>",
       NULL},
      {"s.vts", "StructuredGrid",
       "WholeExtent=\"0 1 0 1 0 9\"><Piece Extent=\"0 1 0 1 0 9\"><Points><DataArray type=\"Float64\" "
       "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 1 1 0</DataArray></Points></Piece>",
       "must have 120 values and has at most 12"},
      {"s.vts", "StructuredGrid", "WholeExtent=\"0 1 0 1 0 9\"><Piece Extent=\"0 1 0 1 0 9\"></Piece>", ""},
      {"s.vtr", "ImageData", IMAGE("0 1 0 1 0 1", "0 1 0 1 0 1") "</Piece>", "holds ImageData, not RectilinearGrid"},
#undef IMAGE
#undef ARRAY
#undef AXES
  };
  for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
    char text[2048];
    snprintf(text, sizeof text,
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"%s\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
             "<%s %s</%s></VTKFile>\n",
             files[i].type, files[i].type, files[i].content, files[i].type);
    scratch_write_text(files[i].name, text);
    expect_file(files[i].name, files[i].error);
  }
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
