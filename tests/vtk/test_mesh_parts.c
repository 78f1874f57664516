/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests parts of a mesh, fields as arrays, and the size of a file. VTK reads the written files. */
#include <riis/riis_vtk.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "calls.h"
#include "expect.h"
#include "scratch.h"
#include "vtk_shim.h"

enum { n_side = 9, n_box = n_side * n_side * n_side, most_values = 60000 };

static int make_files(void **state) {
  const double lower[3] = {-1.7, -1.6, -1.3}, upper[3] = {1.5, 1.6, 0.4};
  scratch_setup(state);
  return shim_write_box(scratch_path("box.vtu"), SHIM_RAW, n_side, lower, upper, 0) &&
                 shim_write_zoo(scratch_path("zoo.vtu"))
             ? 0
             : -1;
}

/* Writes the part of a mesh with the wanted nodes. Returns the path of the file. */
static const char *part_of(const char *name, int64_t n_ids, const int64_t *ids) {
  riis_vtk_mesh *mesh = NULL, *part = NULL;
  const char *path = scratch_path("part.vtu");
  expect_fine(riis_vtk_mesh_read(scratch_path(name), &mesh));
  expect_fine(riis_vtk_mesh_extract(mesh, n_ids, ids, &part));
  riis_vtk_mesh_destroy(&mesh); /* the part must not borrow from the mesh */
  expect_fine(riis_vtk_mesh_write(part, path));
  riis_vtk_mesh_destroy(&part);
  return path;
}

static int64_t read_ids(const char *path, char where, const char *name, double *ids) {
  int64_t n = 0;
  char type[32];
  assert_int_equal(shim_read_array(path, where, name, type, NULL, &n, NULL), 1);
  assert_true(strcmp(type, "vtktypeint64") == 0 || strcmp(type, "long long") == 0 || strcmp(type, "long") == 0);
  shim_read_array(path, where, name, NULL, NULL, NULL, ids);
  return n;
}

/* Each cell of the part has the points of the whole mesh's cell with this id. The coordinates of corners are compared. */
static void expect_cells(const char *whole, const char *part, int corners_per_cell) {
  static double xyz[2][3 * n_box], node_ids[n_box], cell_ids[most_values];
  static int64_t corners[2][most_values];
  assert_int_equal(shim_read_points(whole, NULL, NULL, NULL, xyz[0]), 1);
  assert_int_equal(shim_read_points(part, NULL, NULL, NULL, xyz[1]), 1);
  const int64_t n_nodes = read_ids(part, 'p', "riis_node_id", node_ids);
  const int64_t n_cells = read_ids(part, 'c', "riis_cell_id", cell_ids);
  for (int64_t i = 0; i < n_nodes; ++i) {
    assert_true(i == 0 || node_ids[i] > node_ids[i - 1]);
    assert_memory_equal(xyz[1] + 3 * i, xyz[0] + 3 * (int64_t)node_ids[i], 3 * sizeof(double));
  }
  shim_read_corners(whole, corners[0]);
  assert_int_equal(shim_read_corners(part, corners[1]), corners_per_cell * n_cells);
  for (int64_t i = 0; i < corners_per_cell * n_cells; ++i) {
    const int64_t cell = (int64_t)cell_ids[i / corners_per_cell];
    assert_int_equal((int64_t)node_ids[corners[1][i]], corners[0][corners_per_cell * cell + i % corners_per_cell]);
  }
}

TEST(test_box) {
  static int64_t corners[most_values];
  static unsigned char is_wanted[n_box];
  static double ids[n_box], values[3 * n_box], of_part[3 * n_box];
  const int64_t wanted[] = {100, 3, 3, 700};
  const char *whole = scratch_path("box.vtu"), *part = part_of("box.vtu", 4, wanted);
  expect_cells(whole, part, 4);
  /* The part has the nodes of all cells with a wanted node. */
  memset(is_wanted, 0, sizeof is_wanted);
  const int64_t n_corners = shim_read_corners(whole, corners);
  int64_t n_cells = 0, n_expected = 0, n_found = 0;
  for (int64_t cell = 0; cell < n_corners; cell += 4) {
    int has = 0;
    for (int k = 0; k < 4; ++k) has |= corners[cell + k] == 100 || corners[cell + k] == 3 || corners[cell + k] == 700;
    for (int k = 0; has && k < 4; ++k) is_wanted[corners[cell + k]] = 1;
    n_cells += has;
  }
  for (int i = 0; i < n_box; ++i) n_expected += is_wanted[i];
  assert_int_equal(shim_read_points(part, &n_found, NULL, NULL, NULL), 1);
  assert_int_equal(n_found, n_expected);
  assert_int_equal(shim_read_array(part, 'c', "region", NULL, NULL, &n_found, NULL), 1);
  assert_int_equal(n_found, n_cells);
  /* The part has data of every kind. */
  read_ids(part, 'p', "riis_node_id", ids);
  assert_int_equal(shim_read_array(whole, 'p', "velocity", NULL, NULL, NULL, values), 1);
  assert_int_equal(shim_read_array(part, 'p', "velocity", NULL, NULL, NULL, of_part), 1);
  for (int64_t i = 0; i < n_expected; ++i)
    assert_memory_equal(of_part + 3 * i, values + 3 * (int64_t)ids[i], 3 * sizeof *values);
  assert_int_equal(shim_read_array(part, 'p', "name", NULL, NULL, NULL, NULL), 1);
  assert_int_equal(shim_read_array(part, 'f', "time", NULL, NULL, NULL, NULL), 1);
}

/* The mesh has cells of many kinds, including polyhedra. In the part, VTK finds the same faces as riis. */
TEST(test_kinds) {
  int64_t ids[n_shim_zoo], n_points = 0, n_cells = 0, n_all = 0, n_faces[2] = {0, 0}, n_inwards = 0;
  for (int i = 0; i < n_shim_zoo; ++i) ids[i] = i;
  const char *part = part_of("zoo.vtu", n_shim_zoo, ids);
  assert_int_equal(shim_read_points(scratch_path("zoo.vtu"), NULL, &n_all, NULL, NULL), 1);
  assert_int_equal(shim_read_points(part, &n_points, &n_cells, NULL, NULL), 1);
  assert_true(n_points == n_shim_zoo && n_cells == n_all);
  assert_int_equal(shim_compare_outside(scratch_path("zoo.vtu"), &n_faces[0], &n_inwards), 0);
  assert_int_equal(shim_compare_outside(part, &n_faces[1], &n_inwards), 0);
  assert_true(n_faces[0] > 10 && n_faces[0] == n_faces[1]);
  /* The part has fewer nodes, so the ids of nodes in its faces have changed. riis checks the faces of every polyhedron when it
   * reads the file. */
  riis_vtk_mesh *read = NULL;
  part = part_of("zoo.vtu", 2, ids);
  expect_fine(riis_vtk_mesh_read(part, &read));
  riis_vtk_mesh_destroy(&read);
  assert_int_equal(shim_compare_outside(part, &n_faces[1], &n_inwards), 0);
}

/* A node without cells stays in the part. A part without nodes is an empty mesh. */
TEST(test_few_nodes) {
  const int64_t last = n_shim_zoo - 1;
  int64_t n_points = 0;
  riis_vtk_mesh *mesh = NULL, *part = NULL;
  expect_fine(riis_vtk_mesh_read(scratch_path("zoo.vtu"), &mesh));
  expect_fine(riis_vtk_mesh_extract(mesh, 1, &last, &part));
  expect_fine(riis_vtk_mesh_get_nodes(part, &n_points, NULL, NULL));
  assert_true(n_points >= 1);
  riis_vtk_mesh_destroy(&part);
  expect_fine(riis_vtk_mesh_extract(mesh, 0, NULL, &part));
  expect_fine(riis_vtk_mesh_get_nodes(part, &n_points, NULL, NULL));
  assert_int_equal(n_points, 0);
  riis_vtk_mesh_destroy(&part);
  const int64_t bad[] = {0, n_shim_zoo};
  expect_refused(riis_vtk_mesh_extract(mesh, 2, bad, &part), RIIS_INVALID_ARGUMENT,
                 "node_ids[1] is 60; the mesh has 60 nodes");
  expect_refused(riis_vtk_mesh_extract(mesh, -1, bad, &part), RIIS_INVALID_ARGUMENT, "n_ids is -1");
  expect_refused(riis_vtk_mesh_extract(mesh, 1, NULL, &part), RIIS_INVALID_ARGUMENT, "node_ids is NULL");
  expect_refused(riis_vtk_mesh_extract(NULL, 0, NULL, &part), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_refused(riis_vtk_mesh_extract(mesh, 0, NULL, NULL), RIIS_INVALID_ARGUMENT, "part is NULL");
  assert_null(part);
  riis_vtk_mesh_destroy(&mesh);
}

static void expect_size(const char *name) {
  riis_vtk_mesh *mesh = NULL;
  struct stat status;
  int64_t n_bytes = 0;
  expect_fine(riis_vtk_mesh_read(scratch_path(name), &mesh));
  expect_fine(riis_vtk_mesh_get_file_size(mesh, &n_bytes));
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("size.vtu")));
  assert_int_equal(stat(scratch_path("size.vtu"), &status), 0);
  if (status.st_size < n_bytes || status.st_size > n_bytes + 8192)
    fail_msg("%s: %lld bytes promised, %lld there", name, (long long)n_bytes, (long long)status.st_size);
  expect_refused(riis_vtk_mesh_get_file_size(NULL, &n_bytes), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_refused(riis_vtk_mesh_get_file_size(mesh, NULL), RIIS_INVALID_ARGUMENT, "n_bytes is NULL");
  riis_vtk_mesh_destroy(&mesh);
}

TEST(test_size) {
  expect_size("box.vtu");
  expect_size("zoo.vtu");
}

typedef struct marking {
  riis_vtk_mesh *file;
  riis_mesh *mesh;
  riis_marks *result;
} marking;

/* Marks the box with all fields that the surface has. The valve opens from 0 to 0.1 in 2 seconds. */
static marking marked_box(const char *kind, double z, int32_t fields) {
  marking m = {NULL, NULL, NULL};
  riis_valve *now = NULL, *before = NULL;
  riis_surface *surface = NULL;
  riis_surface_options placement;
  riis_mark_options how;
  int64_t n = 0;
  const double *xyz = NULL;
  expect_fine(riis_valve_create(kind, &now));
  expect_fine(riis_valve_create(kind, &before));
  expect_fine(riis_valve_set_scalar(now, "opening", 0.1));
  expect_fine(riis_valve_set_scalar(before, "opening", 0));
  expect_fine(riis_surface_options_init(&placement, sizeof placement));
  placement.half_thickness = 0.3;
  placement.translation[2] = z;
  expect_fine(riis_surface_create(now, &placement, &surface));
  expect_fine(riis_surface_update_moving(surface, now, before, 2, NULL, NULL));
  expect_fine(riis_vtk_mesh_read(scratch_path("box.vtu"), &m.file));
  expect_fine(riis_vtk_mesh_get_nodes(m.file, &n, NULL, &xyz));
  expect_fine(riis_mesh_create(n, xyz, xyz + 1, xyz + 2, 3, &m.mesh));
  expect_fine(riis_marks_create(&m.result));
  expect_fine(riis_mark_options_init(&how, sizeof how));
  how.fields = fields;
  expect_fine(riis_mark_nodes(surface, m.mesh, &how, m.result));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&now);
  riis_valve_destroy(&before);
  return m;
}

static void forget(marking *m) {
  riis_marks_destroy(&m->result);
  riis_mesh_destroy(&m->mesh);
  riis_vtk_mesh_destroy(&m->file);
}

static void expect_doubles(const char *name, const marking *m, int n_components, const double *values) {
  static double found[3 * n_box];
  int64_t n_found = 0;
  const int64_t n = within_list(m->result).n_nodes;
  const int64_t *node_id = within_list(m->result).node_id;
  assert_int_equal(shim_read_array(scratch_path("fields.vtu"), 'p', name, NULL, &n_found, NULL, found), 1);
  assert_int_equal(n_found, n_components);
  for (int64_t i = 0; i < n; ++i) {
    double *const at = found + n_components * node_id[i];
    assert_memory_equal(at, values + n_components * i, (size_t)n_components * sizeof *at);
    memset(at, 0, (size_t)n_components * sizeof *at);
  }
  for (int i = 0; i < n_components * n_box; ++i) assert_true(found[i] == 0);
}

static void expect_integers(const char *name, const marking *m, const int32_t *values, double elsewhere) {
  static double found[n_box];
  char type[32];
  const int64_t n = within_list(m->result).n_nodes;
  const int64_t *node_id = within_list(m->result).node_id;
  assert_int_equal(shim_read_array(scratch_path("fields.vtu"), 'p', name, type, NULL, NULL, found), 1);
  assert_string_equal(type, "int");
  for (int64_t i = 0; i < n; ++i) {
    assert_true(found[node_id[i]] == values[i]);
    found[node_id[i]] = elsewhere;
  }
  for (int i = 0; i < n_box; ++i) assert_true(found[i] == elsewhere);
}

TEST(test_fields) {
  const int32_t all = 2 * RIIS_FIELD_PATCH - 1;
  riis_mark_list fields;
  marking m = marked_box("mitral", -0.6, all);
  expect_fine(riis_vtk_mesh_set_fields(m.file, m.result, all, "m"));
  expect_fine(riis_vtk_mesh_write(m.file, scratch_path("fields.vtu")));
  expect_fine(riis_marks_get_list(m.result, RIIS_LIST_WITHIN_LIMIT, &fields, sizeof fields));
  assert_true(fields.n_nodes > 20);
  expect_doubles("m_point", &m, 3, fields.point);
  expect_doubles("m_normal", &m, 3, fields.normal);
  expect_doubles("m_barycentric", &m, 3, fields.barycentric);
  expect_doubles("m_uv", &m, 2, fields.uv);
  expect_doubles("m_velocity", &m, 3, fields.velocity);
  expect_integers("m_side", &m, fields.side, 0);
  expect_integers("m_rim", &m, fields.rim, 0);
  expect_integers("m_patch", &m, fields.patch_id, -1);
  expect_refused(riis_vtk_mesh_set_fields(m.file, m.result, 256, "m"), RIIS_INVALID_ARGUMENT,
                 "fields is 256; it must be a sum of RIIS_FIELD_*");
  expect_refused(riis_vtk_mesh_set_fields(m.file, m.result, -1, "m"), RIIS_INVALID_ARGUMENT, "fields is -1");
  expect_refused(riis_vtk_mesh_set_fields(m.file, m.result, all, "a b"), RIIS_INVALID_ARGUMENT, "prefix is \"a b\"");
  expect_refused(riis_vtk_mesh_set_fields(NULL, m.result, all, "m"), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_refused(riis_vtk_mesh_set_fields(m.file, NULL, all, "m"), RIIS_INVALID_ARGUMENT, "marks is NULL");
  expect_refused(riis_vtk_mesh_set_fields(m.file, m.result, all, NULL), RIIS_INVALID_ARGUMENT, "prefix is NULL");
  forget(&m);
}

/* Only fields that the marking computed are available. If the mesh is far from the valve, all arrays exist, but they contain no
 * values. */
TEST(test_fields_that_lack) {
  marking m = marked_box("mitral", -0.6, RIIS_FIELD_SIDE);
  expect_refused(riis_vtk_mesh_set_fields(m.file, m.result, RIIS_FIELD_NORMAL, "m"), RIIS_INVALID_ARGUMENT,
                 "marks lack the field of m_normal");
  expect_fine(riis_vtk_mesh_set_fields(m.file, m.result, 0, "m"));
  forget(&m);
  m = marked_box("mitral", 50, RIIS_FIELD_VELOCITY | RIIS_FIELD_PATCH);
  expect_fine(riis_vtk_mesh_set_fields(m.file, m.result, RIIS_FIELD_VELOCITY | RIIS_FIELD_PATCH, "m"));
  expect_fine(riis_vtk_mesh_write(m.file, scratch_path("fields.vtu")));
  expect_doubles("m_velocity", &m, 3, NULL);
  expect_integers("m_patch", &m, NULL, -1);
  forget(&m);
}

int main(void) { return run_cases(make_files, scratch_teardown); }
