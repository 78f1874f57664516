/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests meshes of other programs: gmsh, VTK's writers of Exodus and .vtm, and XDMF. gmsh or VTK also writes each mesh as .vtk or
 * .vtu. The two files of a mesh are compared bit for bit, but in any order of nodes and cells. test_openfoam_files tests the
 * meshes of OpenFOAM. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "formats_shim.h"
#include "plain_mesh.h"
#include "scratch.h"
#include "vtk_shim.h"

/* Reads a mesh and writes it again. The reader must report the given notes. */
static void rewrite(const char *from, const char *to, const char *notes) {
  riis_vtk_mesh *mesh = NULL;
  const char *text = NULL;
  expect_fine(riis_vtk_mesh_read(scratch_path(from), &mesh));
  expect_fine(riis_vtk_mesh_get_notes(mesh, &text));
  assert_string_equal(text, notes);
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path(to)));
  riis_vtk_mesh_destroy(&mesh);
}

static void expect_same_but(const char *a, const char *b, int how, int64_t n_least, int64_t n_other_cells) {
  int64_t counts[4] = {0, 0, -1, -1};
  assert_true(shim_compare_meshes(scratch_path(a), scratch_path(b), how, counts));
  if (counts[2] != 0 || counts[3] != n_other_cells || counts[0] < n_least || counts[1] < n_least)
    fail_msg("%s and %s: %lld points, %lld cells, of which %lld and %lld differ", a, b, (long long)counts[0],
             (long long)counts[1], (long long)counts[2], (long long)counts[3]);
}

static void expect_same(const char *a, const char *b, int how, int64_t n_least) {
  expect_same_but(a, b, how, n_least, 0);
}

/* Boxes of hexahedra, prisms and tetrahedra. Pyramids stand between hexahedra and tetrahedra. */
static const char geometry[] =
    "Point(1) = {-1.1, -1.2, -1.3}; Point(2) = {1.4, -1.2, -1.3}; Point(3) = {1.4, 1.5, -1.3}; Point(4) = {-1.1, 1.5, "
    "-1.3};\n"
    "For i In {1:4}\n  Line(i) = {i, i % 4 + 1};\nEndFor\n"
    "Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};\n"
    "Transfinite Curve {1:4} = 3; Transfinite Surface {1}; Recombine Surface {1};\n"
    "hex[] = Extrude {0, 0, 1.7} { Surface{1}; Layers{2}; Recombine; };\n"
    "Point(101) = {2.6, 0.1, -1.3}; Line(101) = {2, 101}; Line(102) = {101, 3};\n"
    "Curve Loop(101) = {101, 102, -2}; Plane Surface(101) = {101};\n"
    "prisms[] = Extrude {0, 0, 1.7} { Surface{101}; Layers{2}; Recombine; };\n"
    "Point(201) = {0.2, 0.1, 2.9};\n"
    "top[] = Boundary { Surface{hex[0]}; };\n"
    "For i In {0:3}\n  ends[] = Boundary { Curve{top[i]}; };\n  Line(200 + i) = {Abs(ends[0]), 201};\nEndFor\n"
    "For i In {0:3}\n  j = (i + 1) % 4;\n  Curve Loop(200 + i) = {top[i], 200 + j, -(200 + i)};\n"
    "  Plane Surface(200 + i) = {200 + i};\nEndFor\n"
    "Surface Loop(201) = {hex[0], 200:203}; Volume(201) = {201};\n"
    "Physical Volume(7) = {hex[1]}; Physical Volume(8) = {prisms[1], 201}; Physical Surface(9) = {hex[0], 1};\n"
    "Mesh.MeshSizeMax = 1.2; Mesh.MeshSizeMin = 0.8;\n";

#ifdef RIIS_GMSH
static void run_gmsh(const char *options, const char *output) {
  char command[1024];
  snprintf(command, sizeof command, RIIS_GMSH " -v 1 -nt 1 %s -o %s > %s 2>&1", options, scratch_path(output),
           scratch_path("gmsh.log"));
  if (system(command) != 0) fail_msg("%s\n%s", command, scratch_read(scratch_path("gmsh.log"), NULL));
}

TEST(test_gmsh) {
  scratch_write_text("mix.geo", geometry);
  const char *orders[] = {"-order 1", "-order 2", "-order 2 -setnumber Mesh.SecondOrderIncomplete 1"};
  const char *formats[] = {"msh22", "msh22 -bin", "msh41", "msh41 -bin"};
  /* The volume cells of each order are tetrahedra, hexahedra, prisms and pyramids. */
  const int types[3][4] = {{10, 12, 13, 14}, {24, 29, 32, 27}, {24, 25, 26, 27}};
  for (int order = 0; order < 3; ++order) {
    char options[256];
    snprintf(options, sizeof options, "-3 %s -format msh41 -bin %s", orders[order], scratch_path("mix.geo"));
    run_gmsh(options, "made.msh");
    for (int format = 0; format < 4; ++format) {
      snprintf(options, sizeof options, "-save %s -format %s", scratch_path("made.msh"), formats[format]);
      run_gmsh(options, "mix.msh");
      rewrite("mix.msh", "mix.vtu", "");
      int64_t n_of_type[100];
      const double bend = shim_bend(scratch_path("mix.vtu"), n_of_type);
      assert_true(bend >= 0 && bend < 1e-10);
      for (int i = 0; i < 4; ++i)
        if (n_of_type[types[order][i]] < 2)
          fail_msg("%s, %s: %lld cells of type %d", orders[order], formats[format],
                   (long long)n_of_type[types[order][i]], types[order][i]);
      /* gmsh writes text with 16 digits, so two text files are compared. */
      snprintf(options, sizeof options, "-save %s -format vtk%s", scratch_path("mix.msh"), format % 2 ? " -bin" : "");
      run_gmsh(options, "mix.vtk");
      /* gmsh 4.8 writes linear pyramids instead of quadratic pyramids. gmsh's prisms of second order have their base reversed. */
      if (order == 0) expect_same("mix.vtu", "mix.vtk", SHIM_BITS, 30);
      if (order == 2) expect_same_but("mix.vtu", "mix.vtk", SHIM_SETS, 30, 2 * n_of_type[27]);
      char type[32];
      int64_t n_components = 0, n_cells = 0;
      double groups[4096];
      assert_true(shim_read_array(scratch_path("mix.vtu"), 'c', "gmsh:physical", type, &n_components, &n_cells, NULL));
      assert_true(n_cells > 30 && n_cells < 4096 && n_components == 1);
      shim_read_array(scratch_path("mix.vtu"), 'c', "gmsh:physical", type, &n_components, &n_cells, groups);
      for (int64_t i = 0; i < n_cells; ++i) assert_true(groups[i] >= 7 && groups[i] <= 9);
    }
  }
}
#else
TEST(test_gmsh) {
  (void)geometry;
  skip();
}
#endif

/* Writes a mesh of hexahedra or of quadratic tetrahedra. */
static void write_plain(const char *name, int quadratic) {
  const double lower[3] = {-1.1, -1.2, -1.3}, upper[3] = {1.4, 1.3, 1.7};
  plain_mesh hexahedra = plain_hexahedra(4, lower, upper);
  plain_mesh tetrahedra = plain_quadratic_tetrahedra(&hexahedra);
  plain_write(name, quadratic ? &tetrahedra : &hexahedra, PLAIN_CELLS, 1);
  plain_free(&hexahedra);
  plain_free(&tetrahedra);
}

static const char empty_vtu[] =
    "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid>\n<Piece NumberOfPoints=\"0\" "
    "NumberOfCells=\"0\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\"></DataArray>"
    "</Points>\n<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\"></DataArray>"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\"></DataArray>"
    "<DataArray type=\"UInt8\" Name=\"types\" "
    "format=\"ascii\"></DataArray></Cells>\n</Piece>\n</UnstructuredGrid></VTKFile>\n";
static const char vtm[] =
    "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\"><vtkMultiBlockDataSet>\n"
    "<Block index=\"0\"><DataSet index=\"0\" file=\"plain.vtu\"/></Block>\n</vtkMultiBlockDataSet></VTKFile>\n";

/* A block without points adds nothing to the mesh, but keeps its number. */
TEST(test_vtm) {
  for (int kind = 0; kind < 4; ++kind) {
    write_plain("plain.vtu", kind / 2);
    assert_true(shim_write_vtm(scratch_path("blocks.vtm"), scratch_path("plain.vtu"), kind % 2));
    rewrite("blocks.vtm", "joined.vtu", "");
    expect_same("joined.vtu", "plain.vtu", SHIM_BITS, 27);
  }
  scratch_write_text("empty.vtu", empty_vtu);
  scratch_write_text("with_empty.vtm",
                     "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\"><vtkMultiBlockDataSet>\n"
                     "<DataSet index=\"0\" file=\"empty.vtu\"/>\n<DataSet index=\"1\" file=\"plain.vtu\"/>\n"
                     "<DataSet index=\"2\" file=\"empty.vtu\"/>\n</vtkMultiBlockDataSet></VTKFile>\n");
  rewrite("with_empty.vtm", "joined.vtu", "");
  expect_same("joined.vtu", "plain.vtu", SHIM_BITS, 27);
  char type[32];
  int64_t n_components = 0, n_cells = 0;
  static double blocks[4096];
  assert_true(shim_read_array(scratch_path("joined.vtu"), 'c', "riis_block", type, &n_components, &n_cells, NULL));
  assert_true(n_cells > 20 && n_cells <= 4096 && n_components == 1);
  shim_read_array(scratch_path("joined.vtu"), 'c', "riis_block", type, &n_components, &n_cells, blocks);
  for (int64_t i = 0; i < n_cells; ++i) assert_true(blocks[i] == 1);
}

TEST(test_exodus) {
  for (int quadratic = 0; quadratic < 2; ++quadratic) {
    write_plain("plain.vtu", quadratic);
    if (!shim_write_exodus(scratch_path("blocks.exo"), scratch_path("plain.vtu"))) skip();
    rewrite("blocks.exo", "joined.vtu", "");
    expect_same("joined.vtu", "plain.vtu", SHIM_BITS, 27);
  }
}

/* Writes a mesh as XDMF and reads it again. The mesh has one type of cells, or several. */
TEST(test_xdmf) {
  write_plain("plain.vtu", 0);
  rewrite("plain.vtu", "plain.xdmf", "");
  rewrite("plain.xdmf", "again.vtu", "");
  expect_same("again.vtu", "plain.vtu", SHIM_BITS, 27);
  write_plain("curved.vtu", 1);
  rewrite("curved.vtu", "curved.xdmf", "");
  rewrite("curved.xdmf", "again.vtu", "");
  expect_same("again.vtu", "curved.vtu", SHIM_BITS, 27);
#ifdef RIIS_GMSH
  char options[256];
  scratch_write_text("mix.geo", geometry);
  snprintf(options, sizeof options, "-3 -format msh41 -bin %s", scratch_path("mix.geo"));
  run_gmsh(options, "mix.msh");
  rewrite("mix.msh", "mix.vtu", "");
  rewrite("mix.msh", "mix.xdmf", "");
  rewrite("mix.xdmf", "again.vtu", "");
  expect_same("again.vtu", "mix.vtu", SHIM_BITS, 30);
#endif
}

static const char xdmf[] =
    "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"mesh\" GridType=\"Uniform\">\n"
    "<Topology TopologyType=\"Tetrahedron\" NumberOfElements=\"1\">\n"
    "<DataItem Dimensions=\"1 4\" NumberType=\"Int\" Format=\"XML\">0 1 2 3</DataItem>\n</Topology>\n"
    "<Geometry GeometryType=\"XYZ\"><DataItem Dimensions=\"4 3\" Format=\"XML\">0 0 0 1 0 0 0 1 0 0 0 1</DataItem>\n"
    "</Geometry>\n<Attribute Name=\"p\" Center=\"Node\"><DataItem Dimensions=\"4\" Format=\"XML\">1 2 3 4</DataItem>\n"
    "</Attribute>\n</Grid>\n</Domain>\n</Xdmf>\n";

/* dolfinx 0.9 and ParaView were seen to open files of this form. dolfinx looks for a grid of the name "mesh". dolfinx reads the
 * topology's DataItem as rows of nodes, and compares its dimensions with the dataset. Numbers are in the HDF5 file beside the
 * text. If riis has no HDF5, the numbers are in the text. */
TEST(test_xdmf_for_others) {
  scratch_write_text("tet.xdmf", xdmf);
  rewrite("tet.xdmf", "out.xdmf", "");
  char *text = scratch_read(scratch_path("out.xdmf"), NULL);
  const int has_hdf5 = scratch_exists("out.h5");
  const char *begin =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\" xmlns:xi=\"https://www.w3.org/2001/XInclude\">\n"
      "<Domain>\n<Grid Name=\"mesh\" GridType=\"Uniform\">\n"
      "<Topology TopologyType=\"Tetrahedron\" NumberOfElements=\"1\">\n"
      "<DataItem NumberType=\"Int\" Precision=\"8\" Dimensions=\"1 4\" ";
  const char *geometry_begin =
      "</DataItem>\n</Topology>\n<Geometry GeometryType=\"XYZ\">\n"
      "<DataItem NumberType=\"Float\" Precision=\"8\" Dimensions=\"4 3\" ";
  const char *attribute_begin =
      "</DataItem>\n</Geometry>\n<Attribute Name=\"p\" AttributeType=\"Scalar\" Center=\"Node\">\n"
      "<DataItem NumberType=\"Float\" Precision=\"8\" Dimensions=\"4\" ";
  const char *end = "</DataItem>\n</Attribute>\n</Grid>\n</Domain>\n</Xdmf>\n";
  const char *in_hdf5[] = {"Format=\"HDF\">out.h5:/topology", "Format=\"HDF\">out.h5:/geometry",
                           "Format=\"HDF\">out.h5:/Node_p"};
  const char *in_text[] = {"Format=\"XML\">\n0 1 2 3\n", "Format=\"XML\">\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n",
                           "Format=\"XML\">\n1\n2\n3\n4\n"};
  const char *const *numbers = has_hdf5 ? in_hdf5 : in_text;
  char wanted[2048];
  snprintf(wanted, sizeof wanted, "%s%s%s%s%s%s%s", begin, numbers[0], geometry_begin, numbers[1], attribute_begin,
           numbers[2], end);
  assert_string_equal(text, wanted);
  free(text);
}

/* meshio and dolfinx write a mesh once, and a series in time refers to it. meshio writes the mesh after the series.
 * FEniCS's checkpoints name datasets without "/". */
TEST(test_xdmf_of_series) {
  scratch_write_text("tet.xdmf", xdmf);
  rewrite("tet.xdmf", "tet.vtu", "");
  const char *const pointers[] = {
      "xpointer(//Grid[@Name=&quot;mesh&quot;]/*[self::Topology or self::Geometry])",
      "xpointer(/Xdmf/Domain/Grid[@GridType='Uniform'][1]/*[self::Topology or self::Geometry])"};
  const char *mesh = strstr(xdmf, "<Grid"), *attribute = strstr(xdmf, "<Attribute");
  for (int i = 0; i < 2; ++i) {
    char text[4096];
    snprintf(text, sizeof text,
             "<Xdmf xmlns:x=\"http://www.w3.org/2003/XInclude\"><Domain><Grid Name=\"s\" GridType=\"Collection\" "
             "CollectionType=\"Temporal\">\n<Grid><x:include xpointer=\"%s\"/><Time Value=\"0\"/>%.*s</Grid>\n"
             "<Grid><x:include xpointer=\"%s\"/><Time Value=\"1\"/></Grid></Grid>%.*s</Grid></Domain></Xdmf>\n",
             pointers[i], (int)(strstr(attribute, "</Grid>") - attribute), attribute, pointers[i],
             (int)(attribute - mesh), mesh);
    scratch_write_text("series.xdmf", text);
    rewrite("series.xdmf", "series.vtu", "");
    expect_same("series.vtu", "tet.vtu", SHIM_BITS, 1);
  }
  rewrite("tet.xdmf", "out.xdmf", "");
  if (!scratch_exists("out.h5")) return;
  char *text = scratch_read(scratch_path("out.xdmf"), NULL);
  for (char *at = text; (at = strstr(at, ".h5:/")); ++at) memmove(at + 4, at + 5, strlen(at + 4));
  scratch_write_text("checkpoint.xdmf", text);
  free(text);
  rewrite("checkpoint.xdmf", "checkpoint.vtu", "");
  expect_same("checkpoint.vtu", "tet.vtu", SHIM_BITS, 1);
}

static void write_xdmf(const char *name, const char *topology, const char *shape) {
  char text[4096];
  snprintf(text, sizeof text,
           "<Xdmf><Domain><Grid Name=\"all\" GridType=\"Collection\" CollectionType=\"Spatial\">"
           "<Information Name=\"one grid\" Value=\"1\"/><Grid>%s%s</Grid></Grid></Domain></Xdmf>",
           topology, shape);
  scratch_write_text(name, text);
}

static const char tetrahedron[] =
    "<Topology TopologyType=\"Tetrahedron\"><DataItem Dimensions=\"1 4\" NumberType=\"Int\">0 1 2 "
    "3</DataItem></Topology>";

/* Coordinates may be in three items, one for each axis. A collection of one grid may hold other elements. */
TEST(test_xdmf_of_three_axes) {
  scratch_write_text("tet.xdmf", xdmf);
  rewrite("tet.xdmf", "tet.vtu", "");
  char text[2048] =
      "<Geometry GeometryType=\"X_Y_Z\"><DataItem Dimensions=\"4\">0 1 0 0</DataItem>"
      "<DataItem Dimensions=\"4\">0 0 1 0</DataItem><DataItem Dimensions=\"4\">0 0 0 1</DataItem></Geometry>"
      "<Attribute Name=\"p\"><DataItem Dimensions=\"4\">1 2 3 4</DataItem></Attribute>";
  write_xdmf("axes.xdmf", tetrahedron, text);
  rewrite("axes.xdmf", "axes.vtu", "");
  expect_same("axes.vtu", "tet.vtu", SHIM_BITS, 1);
  riis_vtk_mesh *mesh = NULL;
  memcpy(strstr(text, "X_Y_Z"), "X_Y_W", 5);
  write_xdmf("axes.xdmf", tetrahedron, text);
  expect_refused(riis_vtk_mesh_read(scratch_path("axes.xdmf"), &mesh), RIIS_FILE_ERROR,
                 "has a Geometry of the type xyw; XYZ, XY and X_Y_Z are read");
  write_xdmf(
      "axes.xdmf", tetrahedron,
      "<Geometry GeometryType=\"X_Y_Z\"><DataItem Dimensions=\"12\">0 1 0 0 0 0 1 0 0 0 0 1</DataItem></Geometry>");
  expect_refused(riis_vtk_mesh_read(scratch_path("axes.xdmf"), &mesh), RIIS_FILE_ERROR,
                 "has a Geometry of the type X_Y_Z; it must have 3 DataItems of equal length");
  write_xdmf("axes.xdmf", tetrahedron, "<Geometry Reference=\"XML\">/Xdmf/Domain/Geometry[1]</Geometry>");
  expect_refused(
      riis_vtk_mesh_read(scratch_path("axes.xdmf"), &mesh), RIIS_FILE_ERROR,
      "has a Geometry that refers to another Geometry; riis reads only numbers that stand in their own place");
}

/* Whole numbers in binary files may have 1, 2, 4 or 8 bytes, with and without a sign. meshio writes such files. */
TEST(test_xdmf_of_short_numbers) {
  enum { n_points = 200 };
  for (int n_bytes = 1; n_bytes <= 8; n_bytes *= 2)
    for (int is_unsigned = 0; is_unsigned < 2; ++is_unsigned)
      for (int is_big = 0; is_big < 2; ++is_big) {
        unsigned char numbers[8 * 4];
        const int ids[4] = {is_unsigned || n_bytes > 1 ? 199 : 100, 1, 2, 3};
        for (int i = 0; i < 4; ++i)
          for (int k = 0; k < n_bytes; ++k)
            numbers[n_bytes * i + (is_big ? n_bytes - 1 - k : k)] = (unsigned char)(k == 0 ? ids[i] : 0);
        scratch_write("ids.bin", numbers, (size_t)(4 * n_bytes));
        char topology[512], shape[8192], text[16384];
        snprintf(
            topology, sizeof topology,
            "<Topology TopologyType=\"Tetrahedron\"><DataItem Dimensions=\"1 4\" NumberType=\"%s\" Precision=\"%d\" "
            "Format=\"Binary\" Endian=\"%s\">ids.bin</DataItem></Topology>",
            is_unsigned ? "UInt" : "Int", n_bytes, is_big ? "Big" : "Little");
        int n =
            snprintf(shape, sizeof shape, "<Geometry GeometryType=\"XYZ\"><DataItem Dimensions=\"%d 3\">", n_points);
        for (int i = 0; i < n_points; ++i)
          n += snprintf(shape + n, sizeof shape - (size_t)n, "%d %d %d ", i % 2, i / 2 % 2, i / 4);
        snprintf(shape + n, sizeof shape - (size_t)n, "</DataItem></Geometry>");
        snprintf(text, sizeof text, "<Xdmf><Domain><Grid>%s%s</Grid></Domain></Xdmf>", topology, shape);
        scratch_write_text("short.xdmf", text);
        rewrite("short.xdmf", "short.vtu", "");
        snprintf(
            topology, sizeof topology,
            "<Topology TopologyType=\"Tetrahedron\"><DataItem Dimensions=\"1 4\" NumberType=\"Int\">%d 1 2 3</DataItem>"
            "</Topology>",
            ids[0]);
        snprintf(text, sizeof text, "<Xdmf><Domain><Grid>%s%s</Grid></Domain></Xdmf>", topology, shape);
        scratch_write_text("long.xdmf", text);
        rewrite("long.xdmf", "long.vtu", "");
        expect_same("short.vtu", "long.vtu", SHIM_BITS, 1);
      }
}

/* dolfinx's cells of order 3, which have VTK's order of nodes. XDMF has no number for these types in a mixed list of cells. */
TEST(test_xdmf_of_order_3) {
  static const struct {
    const char *name;
    int n_nodes, vtk_type;
  } cells[] = {{"Triangle_10", 10, 69}, {"Quadrilateral_16", 16, 70}, {"Tetrahedron_20", 20, 71}};
  for (size_t i = 0; i < sizeof cells / sizeof cells[0]; ++i) {
    char text[4096], ids[128] = "", points[1024] = "";
    for (int node = 0; node < cells[i].n_nodes; ++node) {
      snprintf(ids + strlen(ids), sizeof ids - strlen(ids), "%d ", (7 * node + 3) % cells[i].n_nodes);
      snprintf(points + strlen(points), sizeof points - strlen(points), "%d %d %g\n", node, node * node, node / 7.0);
    }
    snprintf(text, sizeof text,
             "<Xdmf><Domain><Grid><Topology TopologyType=\"%s\" NodesPerElement=\"%d\"><DataItem Dimensions=\"1 %d\" "
             "NumberType=\"Int\" Format=\"XML\">%s</DataItem></Topology><Geometry GeometryType=\"XYZ\"><DataItem "
             "Dimensions=\"%d 3\" Format=\"XML\">%s</DataItem></Geometry></Grid></Domain></Xdmf>",
             cells[i].name, cells[i].n_nodes, cells[i].n_nodes, ids, cells[i].n_nodes, points);
    scratch_write_text("three.xdmf", text);
    riis_vtk_mesh *mesh = NULL;
    int64_t offsets[2], node_ids[20];
    uint8_t type = 0;
    expect_fine(riis_vtk_mesh_read(scratch_path("three.xdmf"), &mesh));
    expect_fine(riis_vtk_mesh_copy_cells(mesh, 1, offsets, &type, cells[i].n_nodes, node_ids));
    riis_vtk_mesh_destroy(&mesh);
    assert_int_equal(type, cells[i].vtk_type);
    assert_int_equal(offsets[1], cells[i].n_nodes);
    for (int node = 0; node < cells[i].n_nodes; ++node)
      assert_int_equal(node_ids[node], (7 * node + 3) % cells[i].n_nodes);
    rewrite("three.xdmf", "three.vtu", "");
    rewrite("three.vtu", "again.xdmf", "");
    rewrite("again.xdmf", "again.vtu", "");
    expect_same("again.vtu", "three.vtu", SHIM_BITS, 1);
  }
  scratch_write_text(
      "three.xdmf",
      "<Xdmf><Domain><Grid><Topology TopologyType=\"Mixed\"><DataItem Dimensions=\"3\" NumberType=\"Int\" "
      "Format=\"XML\">0 0 0</DataItem></Topology><Geometry GeometryType=\"XYZ\"><DataItem "
      "Dimensions=\"1 3\" Format=\"XML\">0 0 0</DataItem></Geometry></Grid></Domain></Xdmf>");
  riis_vtk_mesh *mesh = NULL;
  expect_refused(riis_vtk_mesh_read(scratch_path("three.xdmf"), &mesh), RIIS_FILE_ERROR,
                 "cell 0 is of XDMF's type 0, which is not read");
}

#ifdef RIIS_MESHIO_PYTHON
static void run_python(const char *script) {
  char command[1024];
  snprintf(command, sizeof command, RIIS_MESHIO_PYTHON " %s %s > %s 2>&1", scratch_path(script), scratch_path("."),
           scratch_path("log.txt"));
  if (system(command) != 0) fail_msg("%s\n%s", command, scratch_read(scratch_path("log.txt"), NULL));
}

/* Lets meshio write every format and read the files of riis. */
TEST(test_meshio) {
  write_plain("plain.vtu", 0);
  scratch_write_text("convert.py",
                     "import os, sys, meshio, numpy\n"
                     "def same(a, b):\n"
                     "    assert numpy.array_equal(a.points, b.points)\n"
                     "    assert [c.type for c in a.cells] == [c.type for c in b.cells]\n"
                     "    assert all(numpy.array_equal(c.data, d.data) for c, d in zip(a.cells, b.cells))\n"
                     "os.chdir(sys.argv[1])\n"
                     "mesh = meshio.read('plain.vtu')\n"
                     "mesh.point_data = {'p': mesh.points[:, 0].copy(), 'v': 2 * mesh.points}\n"
                     "for how in ['HDF', 'XML', 'Binary']:\n"
                     "    mesh.write(how + '.xdmf', data_format=how)\n"
                     "mesh.write('meshio.e')\n"
                     "mesh.write('meshio22.msh', file_format='gmsh22')\n"
                     "mesh.write('meshio41.msh', file_format='gmsh')\n"
                     "same(mesh, meshio.read('plain.xdmf'))\n"
                     "single = meshio.Mesh(mesh.points.astype('f4'), mesh.cells)\n"
                     "single.write('single.xdmf')\n"
                     "mesh.point_data = {n: i + mesh.points[:, 0] for i, n in enumerate(['a/b', 'a_b', 'a_b_'])}\n"
                     "mesh.write('named.vtu')\n");
  rewrite("plain.vtu", "plain.xdmf", "");
  run_python("convert.py");
  const char *names[] = {"HDF.xdmf", "XML.xdmf", "Binary.xdmf", "meshio.e", "meshio22.msh", "meshio41.msh"};
  for (int i = 0; i < 6; ++i) {
    rewrite(names[i], "again.vtu", "");
    expect_same("again.vtu", "plain.vtu", SHIM_BITS, 27);
  }
  rewrite("single.xdmf", "again.vtu", "its points have single precision");
  expect_same("again.vtu", "plain.vtu", SHIM_FLOATS, 27);
  /* A slash separates HDF5's groups, so the datasets of arrays with a slash in their names need other names. */
  scratch_write_text("named.py",
                     "import os, sys, meshio, numpy\n"
                     "os.chdir(sys.argv[1])\n"
                     "a, b = (meshio.read(name).point_data for name in ['named.vtu', 'named.xdmf'])\n"
                     "assert list(a) == list(b) == ['a/b', 'a_b', 'a_b_'], (list(a), list(b))\n"
                     "assert all(numpy.array_equal(a[n], b[n]) for n in a)\n");
  rewrite("named.vtu", "named.xdmf", "");
  run_python("named.py");
}
#else
TEST(test_meshio) { skip(); }
#endif

/* ---- Files that cannot be read ---- */

/* With Mesh.SaveParametric, nodes of version 2 also have their entity, and their parameters on curves and surfaces. When gmsh
 * appends a view, it writes the mesh a second time. */
TEST(test_gmsh_sections) {
  static const char *const format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  static const char *const mesh =
      "$ParametricNodes\n4\n1 0 0 0 0 7\n2 1 0 0 1 3 0.25\n3 0 1 0 2 5 0.5 0.75\n4 0 0 1 3 1\n$EndParametricNodes\n"
      "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";
  const double points[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  char text[2048];
  for (int n_copies = 1; n_copies < 3; ++n_copies) {
    snprintf(text, sizeof text, "%s%s%s%s$NodeData\n0\n$EndNodeData\n", format, mesh, n_copies > 1 ? format : "",
             n_copies > 1 ? mesh : "");
    scratch_write_text("view.msh", text);
    rewrite("view.msh", "view.vtu", "");
    int64_t n_points = 0, n_cells = 0;
    double found[12];
    assert_int_equal(shim_read_points(scratch_path("view.vtu"), &n_points, &n_cells, NULL, NULL), 1);
    assert_true(n_points == 4 && n_cells == 1);
    shim_read_points(scratch_path("view.vtu"), &n_points, &n_cells, NULL, found);
    assert_memory_equal(found, points, sizeof points);
  }
  /* Another mesh is refused. */
  strstr(strstr(text, "$EndElements"), "1 0 0 1")[2] = '2';
  scratch_write_text("other.msh", text);
  riis_vtk_mesh *other = NULL;
  expect_refused(riis_vtk_mesh_read(scratch_path("other.msh"), &other), RIIS_FILE_ERROR,
                 "has a second section $ParametricNodes, which differs from the first");
}

/* Version 2 writes a cell of two physical groups twice, with separate numbers. */
TEST(test_gmsh_groups) {
  char text[2048] =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n"
      "$EndNodes\n$Elements\n6\n";
  const char *once = "1 4 2 1 1 1 2 3 4\n2 4 2 1 1 2 3 4 5\n";
  char *const end = text + strlen(text);
  /* In the third group the first cell is reversed, as gmsh writes a group with a negative number. The last cell occurs twice in
   * one group, and both copies stay. */
  sprintf(end, "%s3 4 2 2 1 1 2 3 4\n4 4 2 2 1 2 3 4 5\n5 4 2 3 1 2 1 3 4\n6 4 2 1 1 2 3 4 5\n$EndElements\n", once);
  scratch_write_text("twice.msh", text);
  rewrite("twice.msh", "twice.vtu",
          "3 elements of further physical groups are the same cells as those of the first groups");
  int64_t n_points = 0, n_cells = 0;
  assert_int_equal(shim_read_points(scratch_path("twice.vtu"), &n_points, &n_cells, NULL, NULL), 1);
  assert_int_equal(n_points, 5);
  assert_int_equal(n_cells, 3);
  const int64_t corners[12] = {0, 1, 2, 3, 1, 2, 3, 4, 1, 2, 3, 4};
  int64_t found[12];
  assert_int_equal(shim_read_corners(scratch_path("twice.vtu"), NULL), 12);
  shim_read_corners(scratch_path("twice.vtu"), found);
  assert_memory_equal(found, corners, sizeof corners);
  /* In a partitioned mesh of version 4.1, the elements belong to parts of the volumes. The parts state which groups they belong
   * to. */
  scratch_write_text(
      "parts.msh",
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 0 0 1\n1 0 0 0 0\n1 0 0 0 1 1 1 2 5 6 0\n$EndEntities\n"
      "$PartitionedEntities\n2\n1\n9 2\n1 0 0 2\n2 0 1 2 1 2 0 0 0 0\n3 3 1 1 1 0 0 0 1 1 1 2 5 6 0\n"
      "4 3 1 1 2 0 0 0 1 1 1 1 7 2 8 -9\n$EndPartitionedEntities\n"
      "$Nodes\n1 5 1 5\n3 3 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n"
      "$Elements\n2 2 1 2\n3 3 4 1\n1 1 2 3 4\n3 4 4 1\n2 2 3 4 5\n$EndElements\n"
      "$GhostElements\n1\n1 1 1 2\n$EndGhostElements\n");
  const char *const wheres[4] = {"gmsh:physical=5", "gmsh:physical=6", "gmsh:physical=7", "gmsh:physical=5,7"};
  for (int i = 0; i < 4; ++i) {
    riis_vtk_mesh *mesh = NULL;
    int64_t n_chosen = 0;
    expect_fine(riis_vtk_mesh_read(scratch_path("parts.msh"), &mesh));
    expect_fine(riis_vtk_mesh_choose_cells(mesh, wheres[i], &n_chosen));
    assert_int_equal(n_chosen, i == 3 ? 2 : 1);
    riis_vtk_mesh_destroy(&mesh);
  }
#ifdef RIIS_GMSH
  char geo[4096], options[256];
  snprintf(geo, sizeof geo, "%sPhysical Volume(11) = {hex[1], 201};\n", geometry);
  scratch_write_text("groups.geo", geo);
  snprintf(options, sizeof options, "-3 -format msh41 -bin %s", scratch_path("groups.geo"));
  run_gmsh(options, "once.msh");
  rewrite("once.msh", "once.vtu", "");
  for (int is_binary = 0; is_binary < 2; ++is_binary) {
    snprintf(options, sizeof options, "-save %s -format msh22 %s", scratch_path("once.msh"), is_binary ? "-bin" : "");
    run_gmsh(options, "twice.msh");
    riis_vtk_mesh *mesh = NULL;
    expect_fine(riis_vtk_mesh_read(scratch_path("twice.msh"), &mesh));
    expect_fine(riis_vtk_mesh_write(mesh, scratch_path("twice.vtu")));
    riis_vtk_mesh_destroy(&mesh);
    expect_same("twice.vtu", "once.vtu", SHIM_FLOATS, 30);
  }
#endif
}

static const char msh22[] =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
    "$Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n";
static const char msh41[] =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 1 5 0\n$EndEntities\n"
    "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
    "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

/* A file with one fault: `to` replaces the first `from`. */
typedef struct broken {
  const char *name, *whole, *from, *to, *text;
} broken;

static const broken faults[] = {
    {"a.msh", msh22, "$MeshFormat", "(0 \"Fluent\")", "is not a mesh of gmsh: it does not begin with $MeshFormat"},
    {"a.msh", msh22, "2.2 0 8", "1.0 0 8", "is of version 1.0 of gmsh's format; versions 2 and 4.1 are read"},
    {"a.msh", msh41, "4.1 0 8", "4.0 0 8", "is of version 4.0 of gmsh's format"},
    {"a.msh", msh22, "2.2 0 8", "2.2 7 8", "line 2: the file type is 7; it must be 0 or 1"},
    {"a.msh", msh22, "2.2 0 8", "2.2 0 4", "line 2: the data size is 4; only 8 is read"},
    {"a.msh", msh22, "2.2 0 8", "2.2 1 8", "byte 24: the number that tells the byte order is"},
    {"a.msh", msh22, "$Nodes\n4", "$Nodes\n1000000000000", "line 5: claims 1000000000000 nodes, but only"},
    {"a.msh", msh22, "$Nodes\n4", "$Nodes\n-4", "claims -4 nodes"},
    {"a.msh", msh22, "$Nodes\n4", "$Nodes\n99999999999999999999999",
     "\"99999999999999999999999\" is not a whole number"},
    {"a.msh", msh22, "$Nodes\n4", "$Nodes\n5", "line 10: \"$EndNodes\" is not a whole number"},
    {"a.msh", msh22, "$Nodes\n4", "$Nodes\n3", "line 9: holds more than $Nodes claims; $EndNodes must be here"},
    {"a.msh", msh22, "2 1 0 0", "2 nan 0 0", "x of node 1 is nan"},
    {"a.msh", msh22, "2 1 0 0", "2 1 -inf 0", "y of node 1 is -inf"},
    {"a.msh", msh22, "2 1 0 0", "2 1 0 1e999", "\"1e999\" is not a number"},
    {"a.msh", msh22, "2 1 0 0", "2 1 0,5 0", "line 7: \"0,5\" is not a number"},
    {"a.msh", msh22, "2 1 0 0", "3 1 0 0", "has two nodes with the tag 3"},
    {"a.msh", msh22, "1 2 3 4\n", "1 2 3 5\n", "element 1 has the node 5, which $Nodes lacks"},
    {"a.msh", msh22, "1 2 3 4\n", "1 2 3 -9\n", "element 1 has the node -9, which $Nodes lacks"},
    {"a.msh", msh22, "1 4 2 0 1", "1 29 2 0 1", "element 1 is of gmsh's type 29; elements of orders 1 and 2 are read"},
    {"a.msh", msh22, "1 4 2 0 1", "1 4 1000000000000 0 1", "claims 1000000000000 tags of an element"},
    {"a.msh", msh22, "$Elements\n1", "$Elements\n800000000000", "claims 800000000000 elements"},
    {"a.msh", msh22, "$Nodes", "$Other", "is truncated: it ends before $EndOther"},
    {"a.msh", msh22, "$EndNodes", "$EndNode", "$EndNodes must be here"},
    {"a.msh", msh41, "1 4 1 4", "1 4000000000000 1 4", "claims 4000000000000 nodes"},
    {"a.msh", msh41, "3 1 0 4", "3 1 0 1000000000000", "a block has 1000000000000 nodes; 4 are left"},
    {"a.msh", msh41, "1 4 1 4", "0 4 1 4", "$Nodes has 0 of the 4 nodes that it claims"},
    {"a.msh", msh41, "3 1 4 1", "3 1 4 77", "a block has 77 elements; 1 are left"},
    {"a.msh", msh41, "0 0 0 1", "0 0 0 1000000000", "claims 1000000000 entities"},
    {"a.xdmf", xdmf, "</Xdmf>", "", "is truncated: its XML has no end"},
    {"a.xdmf", xdmf, "</Domain>", "</Grid>", "</Grid> stands where there must be </Domain>"},
    {"a.xdmf", xdmf, "Dimensions=\"4 3\"", "Dimensions=\"1000000000000 3\"", "claims 3000000000000 numbers"},
    {"a.xdmf", xdmf, "Dimensions=\"4 3\"", "Dimensions=\"99999999999 99999999999\"", "has a DataItem with"},
    {"a.xdmf", xdmf, "Dimensions=\"4 3\"", "Dimensions=\"-4 3\"", "has a DataItem with the dimensions \"-4 3\""},
    {"a.xdmf", xdmf, "Dimensions=\"4 3\"", "Dimensions=\"6 2\"", "has a Geometry of 6 x 2 numbers; a node has 3"},
    {"a.xdmf", xdmf, "0 0 0 1 0", "0 0 nan 1 0", "z of node 0 is nan"},
    {"a.xdmf", xdmf, "0 1 2 3<", "0 1 2 4<", "cell 0 names point 4 of 4"},
    {"a.xdmf", xdmf, "0 1 2 3<", "0 1 2 -1<", "cell 0 names point -1 of 4"},
    {"a.xdmf", xdmf, "0 1 2 3<", "0 1 2<", "a DataItem has 3 of its 4 numbers"},
    {"a.xdmf", xdmf, "0 1 2 3<", "0 1 2 3 4<", "more than 4 numbers are in a DataItem"},
    {"a.xdmf", xdmf, "Tetrahedron", "Dodecahedron", "has a Topology of the type Dodecahedron, which is not read"},
    {"a.xdmf", xdmf, "Tetrahedron", "Mixed", "cell 0 is of XDMF's type 0, which is not read"},
    {"a.xdmf", xdmf, "Format=\"XML\">0 0", "Format=\"HDF\">none.h5:/x</DataItem><DataItem Dimensions=\"1\">0 0",
     "none.h5: cannot be read"},
    {"a.xdmf", xdmf, "Format=\"XML\">0 0", "Format=\"HDF\">a.xdmf:/x</DataItem><DataItem Dimensions=\"1\">0 0", "HDF5"},
    {"a.xdmf", xdmf, "Format=\"XML\">0 0",
     "Format=\"Binary\" Seek=\"9999\">a.xdmf</DataItem><DataItem Dimensions=\"1\">0 0",
     "has a DataItem with Seek=\"9999\""},
    {"a.xdmf", xdmf, "Dimensions=\"4\"", "Dimensions=\"5\"", "attribute p has 5 x 1 values for 4 nodes"},
    {"a.vtm", vtm, "vtkMultiBlockDataSet\"", "Collection\"", "is not a list of blocks"},
    {"a.vtm", vtm, "plain.vtu", "missing.vtu", "missing.vtu: cannot be read: No such file"},
    {"a.vtm", vtm, "plain.vtu", "a.vtp", "lists no .vtu file"},
    {"a.vtm", vtm, "plain.vtu", "empty.vtu", "lists only blocks without points"},
    {"a.exo", xdmf, "", "", "is not an Exodus file: it is neither NetCDF nor HDF5"},
};

static void write_broken(const broken *fault) {
  char text[4096];
  const char *at = strstr(fault->whole, fault->from);
  if (!at) fail_msg("no \"%s\" in %s", fault->from, fault->name);
  snprintf(text, sizeof text, "%.*s%s%s", (int)(at - fault->whole), fault->whole, fault->to, at + strlen(fault->from));
  scratch_write_text(fault->name, text);
}

TEST(test_broken) {
  write_plain("plain.vtu", 0);
  scratch_write_text("empty.vtu", empty_vtu);
  for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i) {
    riis_vtk_mesh *mesh = NULL;
    write_broken(&faults[i]);
    scratch_watch_output();
    const riis_status status = riis_vtk_mesh_read(scratch_path(faults[i].name), &mesh);
    const long n_printed = scratch_end_watch();
    expect_refused(status, RIIS_FILE_ERROR, faults[i].text);
    assert_null(mesh);
    assert_int_equal(n_printed, 0);
  }
}

/* Every truncated file is refused. A file with a wrong byte may be read or refused, but must not crash the reader. */
TEST(test_cut_and_changed) {
  const char *wholes[] = {msh22, msh41, xdmf, vtm}, *names[] = {"a.msh", "a.msh", "a.xdmf", "a.vtm"};
  const char *seed_text = getenv("RIIS_TEST_SEED");
  uint64_t random = seed_text ? strtoull(seed_text, NULL, 10) : 20261125;
  printf("seed %llu\n", (unsigned long long)random);
  write_plain("plain.vtu", 0);
  for (int kind = 0; kind < 4; ++kind) {
    const size_t n = strlen(wholes[kind]);
    char text[4096];
    riis_vtk_mesh *mesh = NULL;
    scratch_write(names[kind], wholes[kind], n);
    expect_fine(riis_vtk_mesh_read(scratch_path(names[kind]), &mesh));
    riis_vtk_mesh_destroy(&mesh);
    for (size_t length = 0; length + 1 < n; ++length) {
      scratch_write(names[kind], wholes[kind], length);
      expect_refused(riis_vtk_mesh_read(scratch_path(names[kind]), &mesh), RIIS_FILE_ERROR, names[kind]);
    }
    if (kind >= 2) {
      memcpy(text, wholes[kind], n);
      text[n / 2] = 0;
      scratch_write(names[kind], text, n);
      expect_refused(riis_vtk_mesh_read(scratch_path(names[kind]), &mesh), RIIS_FILE_ERROR, "a byte of value 0");
    }
    for (int trial = 0; trial < 300; ++trial) {
      memcpy(text, wholes[kind], n);
      for (int k = 0; k < 1 + trial % 3; ++k) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        const char letters[] = "0123456789-.e <>/\"$\n\0x";
        text[(random >> 33) % n] = letters[(random >> 20) % sizeof letters];
      }
      scratch_write(names[kind], text, n);
      const riis_status status = riis_vtk_mesh_read(scratch_path(names[kind]), &mesh);
      if (status != RIIS_OK) expect_refused(status, RIIS_FILE_ERROR, ": ");
      riis_vtk_mesh_destroy(&mesh);
    }
  }
}

static int64_t number_at(const void *numbers, int32_t n_bits, int64_t i) {
  return n_bits == 32 ? ((const int32_t *)numbers)[i] : ((const int64_t *)numbers)[i];
}

/* The centres are the means of the corners of boxes. Cells that share a face are neighbours, and arrays belong to cells. */
TEST(test_centers) {
  riis_vtk_mesh *mesh = NULL;
  int64_t n = 0, n_cells = 0;
  const double *xyz = NULL;
  const double lower[3] = {-1, -2, -3}, upper[3] = {1, 2, 3};
  plain_mesh hexahedra = plain_hexahedra(4, lower, upper);
  for (int layout = PLAIN_CELLS; layout <= PLAIN_LISTS; ++layout) {
    plain_write("plain.vtu", &hexahedra, (enum plain_layout)layout, 1);
    expect_fine(riis_vtk_mesh_read(scratch_path("plain.vtu"), &mesh));
    expect_fine(riis_vtk_mesh_use_centers(mesh));
    expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, &n_cells, &xyz));
    assert_true(n == 27 && n_cells == 27);
    for (int64_t cell = 0; cell < n; ++cell)
      for (int c = 0; c < 3; ++c) {
        double mean = 0;
        for (int i = 0; i < 8; ++i) mean += hexahedra.xyz[3 * hexahedra.ids[8 * cell + i] + c] / 8;
        assert_true(fabs(xyz[3 * cell + c] - mean) < 1e-14);
      }
    /* Cells that share a face are neighbours. A box of 3 x 3 x 3 cells has 3 x 2 x 9 faces inside. */
    riis_adjacency *adjacency = NULL;
    riis_csr rows;
    expect_fine(riis_vtk_mesh_create_adjacency(mesh, 1, &adjacency));
    expect_fine(riis_adjacency_get_csr(adjacency, &rows, sizeof rows));
    assert_true(rows.n_rows == 27);
    assert_int_equal(number_at(rows.offsets, rows.offset_bits, 27) - rows.index_base, 2 * 3 * 2 * 9);
    for (int64_t a = 0; a < n; ++a) {
      const int64_t begin = number_at(rows.offsets, rows.offset_bits, a) - rows.index_base;
      const int64_t end = number_at(rows.offsets, rows.offset_bits, a + 1) - rows.index_base;
      for (int64_t i = begin; i < end; ++i) {
        const int64_t b = number_at(rows.columns, rows.column_bits, i) - rows.index_base;
        double steps = 0;
        for (int c = 0; c < 3; ++c) steps += fabs(xyz[3 * a + c] - xyz[3 * b + c]) / ((upper[c] - lower[c]) / 3);
        assert_true(steps > 0.99 && steps < 1.01);
      }
    }
    riis_adjacency_destroy(&adjacency);
    double length = 0;
    expect_fine(riis_vtk_mesh_get_median_edge(mesh, &length));
    assert_true(length > 0.66 && length < 2.01);
    double values[27];
    for (int i = 0; i < 27; ++i) values[i] = i;
    expect_fine(riis_vtk_mesh_set_point_array(mesh, "of_cells", 27, 1, values));
    expect_fine(riis_vtk_mesh_write(mesh, scratch_path("out.vtu")));
    char type[32];
    int64_t n_components = 0, n_tuples = 0;
    double found[27];
    assert_true(shim_read_array(scratch_path("out.vtu"), 'c', "of_cells", type, &n_components, &n_tuples, found));
    assert_true(n_tuples == 27 && found[26] == 26);
    riis_vtk_mesh *part = NULL;
    const int64_t first = 0;
    expect_refused(riis_vtk_mesh_extract(mesh, 1, &first, &part), RIIS_INVALID_ARGUMENT, "centres of cells");
    riis_vtk_mesh_destroy(&mesh);
  }
  plain_free(&hexahedra);
  scratch_write_text(
      "voxel.vtk",
      "# vtk DataFile Version 2.0\nvoxel\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
      "0 0 0 2 0 0 0 4 0 2 4 0 0 0 6 2 0 6 0 4 6 2 4 6\nCELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n11\n");
  expect_fine(riis_vtk_mesh_read(scratch_path("voxel.vtk"), &mesh));
  expect_fine(riis_vtk_mesh_use_centers(mesh));
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, NULL, &xyz));
  for (int c = 0; c < 3; ++c) assert_true(n == 1 && fabs(xyz[c] - (c + 1)) < 1e-14);
  riis_vtk_mesh_destroy(&mesh);
  write_plain("curved.vtu", 1);
  expect_fine(riis_vtk_mesh_read(scratch_path("curved.vtu"), &mesh));
  expect_refused(riis_vtk_mesh_use_centers(mesh), RIIS_INVALID_ARGUMENT, "cell 0 is a vtkQuadraticTetra");
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, NULL, NULL));
  assert_true(n > 100);
  riis_vtk_mesh_destroy(&mesh);
  expect_refused(riis_vtk_mesh_use_centers(NULL), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_refused(riis_vtk_mesh_get_notes(NULL, NULL), RIIS_INVALID_ARGUMENT, "mesh is NULL");
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
