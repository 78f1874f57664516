/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests meshes of two domains: a fluid and the wall around it. With --cells-where, the results equal those of a mesh of the fluid
 * alone. The test writes that mesh without riis. */
#include <math.h>
#include <riis/riis_vtk.h>

#include "brick_meshes.h"
#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

enum { n_pieces = 5, n_side = 10, n_bricks = n_side * n_side * n_side };

static mesh whole;
static int is_fluid[n_bricks];

/* Writes the cells of one or both domains as a legacy file. The file has only the nodes of these cells. */
static void write_part(const char *name, int has_wall) {
  static int place[most_nodes];
  int n_nodes = 0, n_cells = 0;
  memset(place, -1, sizeof place);
  for (int cell = 0; cell < whole.n_cells; ++cell) {
    if (!has_wall && !is_fluid[cell]) continue;
    ++n_cells;
    for (int a = 0; a < 8; ++a) place[whole.node[8 * cell + a]] = 0;
  }
  for (int i = 0; i < whole.n_nodes; ++i)
    if (place[i] == 0) place[i] = n_nodes++;
  FILE *file = fopen(scratch_path(name), "w");
  assert_non_null(file);
  fprintf(file, "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS %d double\n", n_nodes);
  for (int i = 0; i < whole.n_nodes; ++i)
    if (place[i] >= 0)
      fprintf(file, "%.17g %.17g %.17g\n", whole.xyz[3 * i], whole.xyz[3 * i + 1], whole.xyz[3 * i + 2]);
  fprintf(file, "CELLS %d %d\n", n_cells, 9 * n_cells);
  for (int cell = 0; cell < whole.n_cells; ++cell) {
    if (!has_wall && !is_fluid[cell]) continue;
    fprintf(file, "8");
    for (int a = 0; a < 8; ++a) fprintf(file, " %d", place[whole.node[8 * cell + a]]);
    fprintf(file, "\n");
  }
  fprintf(file, "CELL_TYPES %d\n", n_cells);
  for (int cell = 0; cell < n_cells; ++cell) fprintf(file, "12\n");
  if (has_wall) {
    fprintf(file, "CELL_DATA %d\nSCALARS rank int 1\nLOOKUP_TABLE default\n", n_cells);
    for (int cell = 0; cell < n_cells; ++cell) fprintf(file, "%d\n", cell * n_pieces / n_cells);
    fprintf(file, "SCALARS domain int 1\nLOOKUP_TABLE default\n");
    for (int cell = 0; cell < n_cells; ++cell) fprintf(file, "%d\n", is_fluid[cell] ? 3 : 7);
  }
  assert_int_equal(fclose(file), 0);
}

/* The fluid has |x| and |y| up to 1.2, and the wall up to 2. A sheet crosses the fluid and ends in the wall. */
static int make_files(void **state) {
  double side[3][3] = {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  if (scratch_setup(state)) return -1;
  whole = make_mesh(&elements[2], (const int[3]){n_side, n_side, n_side}, (const double[3]){-2, -2, -2}, side);
  for (int cell = 0; cell < whole.n_cells; ++cell) {
    double middle[2] = {0, 0};
    for (int a = 0; a < 8; ++a)
      for (int k = 0; k < 2; ++k) middle[k] += whole.xyz[3 * whole.node[8 * cell + a] + k] / 8;
    is_fluid[cell] = fabs(middle[0]) < 1.2 && fabs(middle[1]) < 1.2;
  }
  write_part("both.vtk", 1);
  write_part("fluid.vtk", 0);
  scratch_write_text("sheet.obj",
                     "v -1.25 -1.25 0.05\nv 1.25 -1.25 0.05\nv 1.25 1.25 0.05\nv -1.25 1.25 0.05\nf 1 2 3\nf 1 3 4\n");
  return 0;
}

static int forget_files(void **state) {
  free_mesh(&whole);
  return scratch_teardown(state);
}

#define SHEET "--surface", scratch_path("sheet.obj"), "--half-thickness", "0.22"

static char *stats_of(const char *name, const char *option, const char *value) {
  run_program("check", "leaks", scratch_path(name), SHEET, "--between", "0,0,-1.5", "0,0,1.5", "--stats",
              scratch_path("stats.json"), option, value, NULL);
  assert_int_equal(program_exit_code, 0);
  return scratch_read(scratch_path("stats.json"), NULL);
}

static void expect_same_stats(const char *a, const char *b) {
  static const char *const keys[] = {"n_nodes",        "n_cells",        "n_marked", "n_leaking_edges",
                                     "n_open_regions", "n_volume_cells", "mean_edge"};
  for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i)
    CHECK_NEAR(json_number(a, keys[i]), json_number(b, keys[i]), 1e-12);
  CHECK_NEAR(json_number(strstr(a, "\"outside\""), "share"), json_number(strstr(b, "\"outside\""), "share"), 1e-12);
}

TEST(test_touching_domains_are_told) {
  char *both = stats_of("both.vtk", NULL, NULL);
  assert_non_null(strstr(program_err,
                         "both.vtk has the regions 3 and 7 of the cell array domain, and they touch: "
                         "--cells-where domain=3 takes only the cells of one region\n"));
  assert_true(json_has_text(both, "state", "\"open\"")); /* through the wall */
  free(both);
  run_program("mark", scratch_path("both.vtk"), SHEET, "--strict", "--quiet", "--stats", scratch_path("stats.json"),
              NULL);
  assert_int_equal(program_exit_code, 4);
  free(stats_of("fluid.vtk", NULL, NULL));
  assert_string_equal(program_err, "");
}

/* Cuts the mesh into layers of cells. All cells of a layer have one rank. */
static void write_pieces(void) {
  riis_vtk_mesh *file = NULL;
  riis_vtk_pieces *pieces = NULL;
  const char *paths[n_pieces];
  for (int i = 0; i < n_pieces; ++i) {
    char name[32], where[32];
    snprintf(name, sizeof name, "both_%d.vtu", i);
    snprintf(where, sizeof where, "rank=%d", i);
    paths[i] = scratch_path(name);
    riis_vtk_mesh_destroy(&file);
    expect_fine(riis_vtk_mesh_read(scratch_path("both.vtk"), &file));
    expect_fine(riis_vtk_mesh_choose_cells(file, where, NULL));
    expect_fine(riis_vtk_mesh_write(file, paths[i]));
  }
  expect_fine(riis_vtk_pieces_create(file, n_pieces, paths, &pieces));
  expect_fine(riis_vtk_pieces_write(pieces, scratch_path("both.pvtu")));
  riis_vtk_pieces_destroy(&pieces);
  riis_vtk_mesh_destroy(&file);
}

TEST(test_chosen_cells_are_the_mesh) {
  char *fluid = stats_of("fluid.vtk", NULL, NULL);
  assert_true(json_has_text(fluid, "state", "\"closed\""));
  assert_true(json_number(fluid, "n_marked") > 30);
  char *chosen = stats_of("both.vtk", "--cells-where", "domain=3");
  assert_string_equal(program_err, "");
  assert_true(json_has_text(chosen, "state", "\"closed\""));
  expect_same_stats(chosen, fluid);
  free(chosen);
  chosen = stats_of("both.vtk", "--cells-where", "domain=7,3,-1");
  assert_true(json_has_text(chosen, "state", "\"open\""));
  CHECK_NEAR(json_number(chosen, "n_cells"), n_bricks, 0);
  free(chosen);
  /* The results also agree if the mesh is in pieces. */
  write_pieces();
  chosen = stats_of("both.pvtu", "--cells-where", "domain=3");
  assert_string_equal(program_err, "");
  expect_same_stats(chosen, fluid);
  free(chosen);
  free(stats_of("both.pvtu", NULL, NULL));
  assert_non_null(strstr(program_err, "has the regions 3 and 7 of the cell array domain"));
  free(fluid);
}

/* Checks that riis_node_id has the ids that the nodes have in the whole mesh. */
static void expect_ids(const char *path) {
  static double ids[most_nodes], xyz[3 * most_nodes];
  int64_t n_points = 0, n_cells = 0, n = 0, n_components = 0;
  assert_int_equal(shim_read_points(path, &n_points, &n_cells, NULL, NULL), 1);
  assert_true(n_points > 100 && n_points < whole.n_nodes);
  assert_int_equal(shim_read_points(path, NULL, NULL, NULL, xyz), 1);
  assert_int_equal(shim_read_array(path, 'p', "riis_node_id", NULL, &n_components, &n, ids), 1);
  assert_int_equal(n, n_points);
  for (int64_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) CHECK_SAME(xyz[3 * i + k], whole.xyz[3 * (int)ids[i] + k]);
}

TEST(test_outputs_have_the_numbers_of_the_whole_mesh) {
  RUN_FINE("mark", scratch_path("both.vtk"), SHEET, "--cells-where", "domain=3", "--output", scratch_path("out.vtu"),
           "--quiet");
  expect_ids(scratch_path("out.vtu"));
  scratch_write_text("cycle.csv", "0,0\n1,1\n");
  RUN_FINE("mark", scratch_path("both.vtk"), "--valve", "coapting", "--cells-where", "domain=3", "--cycle",
           scratch_path("cycle.csv"), "--times", "0,0.2", "--half-thickness", "0.3", "--output",
           scratch_path("beat.pvd"), "--quiet");
  expect_ids(scratch_path("beat/beat_0001.vtu"));
  scratch_write_text("case.json",
                     "{\"mesh\": \"both.vtk\", \"cells_where\": \"domain=3\", \"half_thickness\": 0.3,"
                     " \"valves\": [{\"valve\": \"coapting\"}]}");
  RUN_FINE("mark", "--case", scratch_path("case.json"), "--output", scratch_path("case.vtu"), "--quiet");
  expect_ids(scratch_path("case.vtu"));
  RUN_FINE("mark", scratch_path("both.vtk"), SHEET, "--cells-where", "domain=3", "--cells", "--output",
           scratch_path("cells.vtu"), "--quiet");
}

TEST(test_refusals) {
  static const char *const wrong[][2] = {
      {"domain", "--cells-where is \"domain\"; it must be NAME=VALUES, such as region=1,2"},
      {"=3", "it must be NAME=VALUES"},
      {"domain=", "it must be NAME=VALUES"},
      {"domain=3,,7", "it must be NAME=VALUES"},
      {"domain=fluid", "--cells-where: fluid is not a number"},
      {"region=3", "--cells-where: the mesh has no cell array region of single numbers"},
      {"domain=4", "--cells-where: no volume cell has such a value of domain; they have 3, 7"}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i)
    RUN_REFUSED(2, wrong[i][1], "mark", scratch_path("both.vtk"), SHEET, "--cells-where", wrong[i][0], "--output",
                scratch_path("no.vtu"));
  assert_false(scratch_exists("no.vtu"));
  RUN_REFUSED(2, "--cells-where: no cell of ", "mark", scratch_path("both.pvtu"), SHEET, "--cells-where", "domain=4",
              "--output", scratch_path("no.pvtu"));
}

/* Writes two cubes in each version of the file's format. Both cubes are in group 1. One cube is also in the group "lumen", and
 * one in group 3. */
static const char *const cubes[2] = {
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 2 \"wall of 2\"\n3 2 \"lumen\"\n3 1 "
    "\"all\"\n$EndPhysicalNames\n"
    "$Nodes\n12\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n9 0 0 2\n10 1 0 2\n11 1 1 "
    "2\n12 0 1 2\n"
    "$EndNodes\n$Elements\n4\n1 5 2 1 1 1 2 3 4 5 6 7 8\n2 5 2 1 2 5 6 7 8 9 10 11 12\n3 5 2 2 1 1 2 3 4 5 6 7 8\n"
    "4 5 2 3 2 5 6 7 8 9 10 11 12\n$EndElements\n",
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"all\"\n3 2 \"lumen\"\n$EndPhysicalNames\n"
    "$Entities\n0 0 0 2\n1 0 0 0 1 1 1 2 1 2 0\n2 0 0 1 1 1 2 2 1 3 0\n$EndEntities\n"
    "$Nodes\n1 12 1 12\n3 1 0 12\n1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 "
    "1\n0 1 1\n"
    "0 0 2\n1 0 2\n1 1 2\n0 1 2\n$EndNodes\n$Elements\n2 2 1 2\n3 1 5 1\n1 1 2 3 4 5 6 7 8\n3 2 5 1\n2 5 6 7 8 9 10 11 "
    "12\n"
    "$EndElements\n"};

TEST(test_groups_of_gmsh) {
  static const struct {
    const char *where;
    int64_t n;
    double lower_z;
  } choices[] = {{"gmsh:physical=1", 2, 0}, {"gmsh:physical=all", 2, 0}, {"gmsh:physical=lumen", 1, 0},
                 {"gmsh:physical=2", 1, 0}, {"gmsh:physical=3", 1, 1},   {"gmsh:physical=3,lumen", 2, 0}};
  for (int version = 0; version < 2; ++version) {
    scratch_write_text("cubes.msh", cubes[version]);
    for (size_t i = 0; i < sizeof choices / sizeof *choices; ++i) {
      riis_vtk_mesh *file = NULL;
      int64_t n_nodes = 0, n_cells = 0;
      const double *xyz = NULL;
      double least = 9;
      expect_fine(riis_vtk_mesh_read(scratch_path("cubes.msh"), &file));
      expect_fine(riis_vtk_mesh_get_nodes(file, NULL, &n_cells, NULL));
      assert_int_equal(n_cells, 2);
      expect_fine(riis_vtk_mesh_choose_cells(file, choices[i].where, NULL));
      expect_fine(riis_vtk_mesh_get_nodes(file, &n_nodes, &n_cells, &xyz));
      assert_int_equal(n_cells, choices[i].n);
      for (int64_t k = 0; k < n_nodes; ++k) least = fmin(least, xyz[3 * k + 2]);
      CHECK_NEAR(least, choices[i].lower_z, 0);
      riis_vtk_mesh_destroy(&file);
    }
    RUN_REFUSED(
        2, "--cells-where: wall is not a number, nor the name of a physical group of volumes: those are all, lumen",
        "mark", scratch_path("cubes.msh"), SHEET, "--cells-where", "gmsh:physical=wall", "--output",
        scratch_path("no.vtu"));
  }
}

/* Appends big-endian numbers of `size` bytes, or numbers as text. */
static size_t put_all(char *bytes, const int *numbers, int n, int size, int is_binary) {
  size_t at = 0;
  for (int i = 0; i < n; ++i) {
    if (!is_binary) at += (size_t)sprintf(bytes + at, "%d ", numbers[i]);
    for (int k = size - 1; is_binary && k >= 0; --k) bytes[at++] = (char)((int64_t)numbers[i] >> (8 * k) & 255);
  }
  bytes[at++] = '\n';
  return at;
}

/* meshio names the types of arrays in its own way. Three tetrahedra have three values of each type, and one is chosen. */
TEST(test_types_of_meshio) {
  static const struct {
    const char *name;
    int size, values[3];
    const char *where;
  } types[] = {{"vtktypeint8", 1, {1, -7, 3}, "v=-7"},          {"vtktypeuint8", 1, {1, 200, 3}, "v=200"},
               {"vtktypeint16", 2, {1, -700, 3}, "v=-700"},     {"vtktypeuint16", 2, {1, 40000, 3}, "v=40000"},
               {"VTKTYPEINT32", 4, {1, -70000, 3}, "v=-70000"}, {"vtktypeuint32", 4, {1, 70000, 3}, "v=70000"},
               {"vtktypeint64", 8, {1, -70000, 3}, "v=-70000"}};
  static const int points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 2, 2, 3}, offsets[] = {0, 4, 8, 12},
                   corners[] = {0, 1, 2, 3, 1, 2, 3, 4, 2, 3, 4, 5}, tetrahedra[] = {10, 10, 10};
  for (size_t i = 0; i < sizeof types / sizeof *types; ++i)
    for (int is_binary = 0; is_binary < 2; ++is_binary) {
      char bytes[1024];
      const char *const ids = types[i].size == 8 ? "vtktypeint64" : "vtktypeint32";
      const int size_of_id = types[i].size == 8 ? 8 : 4;
      size_t n = (size_t)sprintf(bytes, "# vtk DataFile Version 5.1\nx\n%s\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 %s\n",
                                 is_binary ? "BINARY" : "ASCII", "vtktypeint16");
      n += put_all(bytes + n, points, 18, 2, is_binary);
      n += (size_t)sprintf(bytes + n, "CELLS 4 12\nOFFSETS %s\n", ids);
      n += put_all(bytes + n, offsets, 4, size_of_id, is_binary);
      n += (size_t)sprintf(bytes + n, "CONNECTIVITY %s\n", ids);
      n += put_all(bytes + n, corners, 12, size_of_id, is_binary);
      n += (size_t)sprintf(bytes + n, "CELL_TYPES 3\n");
      n += put_all(bytes + n, tetrahedra, 3, 4, is_binary);
      n += (size_t)sprintf(bytes + n, "CELL_DATA 3\nFIELD FieldData 1\nv 1 3 %s\n", types[i].name);
      n += put_all(bytes + n, types[i].values, 3, types[i].size, is_binary);
      scratch_write("meshio.vtk", bytes, n);
      riis_vtk_mesh *file = NULL;
      int64_t n_nodes = 0, n_cells = 0;
      const double *xyz = NULL;
      expect_fine(riis_vtk_mesh_read(scratch_path("meshio.vtk"), &file));
      expect_fine(riis_vtk_mesh_choose_cells(file, types[i].where, NULL));
      expect_fine(riis_vtk_mesh_get_nodes(file, &n_nodes, &n_cells, &xyz));
      assert_int_equal(n_cells, 1);
      assert_int_equal(n_nodes, 4);
      for (int k = 0; k < 12; ++k) CHECK_NEAR(xyz[k], points[3 + k], 0);
      riis_vtk_mesh_destroy(&file);
    }
}

int main(void) { return run_cases(make_files, forget_files); }
