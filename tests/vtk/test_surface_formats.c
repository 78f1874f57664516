/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests surfaces of other programs: .obj, .ply and legacy .vtk. This test writes one surface in each format. The reader must
 * return the surface's vertices and faces bit for bit. Refusals of damaged files name the files. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "scratch.h"
#include "test_support.h"

/* The kinds of files. The first four kinds are text. */
enum { OBJ, PLY_TEXT, VTK_OLD_TEXT, VTK_NEW_TEXT, PLY_LITTLE, PLY_BIG, VTK_OLD_BINARY, VTK_NEW_BINARY, n_kinds };
static const char *const endings[n_kinds] = {"obj", "ply", "vtk", "vtk", "ply", "ply", "vtk", "vtk"};

/* A triangle, a quad, a pentagon and a concave quad, over vertices on a slope. No coordinate is exact in single precision. */
enum { n_vertices = 11, n_faces = 4, n_corners = 16 };
static const int sizes[n_faces] = {3, 4, 5, 4}, corners[n_corners] = {0, 1, 2, 1, 3, 4, 2, 3, 5, 6, 7, 4, 8, 9, 2, 10};
static const double plane[n_vertices][2] = {{0, 0}, {1, 0}, {0, 1},  {2, 0},     {1, 1},   {3, 0},
                                            {4, 1}, {3, 2}, {-2, 1}, {-1, -0.5}, {-1, 0.3}};
static double xyz[n_vertices][3];
/* The triangles that the faces become. The concave quad is cut from its second corner. */
enum { n_triangles = 8 };

static void make_vertices(void) {
  for (int i = 0; i < n_vertices; ++i) {
    xyz[i][0] = plane[i][0] + 0.1 / 3;
    xyz[i][1] = plane[i][1] - 1e-9;
    xyz[i][2] = 0.2 * plane[i][0] + 1.0 / 3;
  }
}

/* ---- Writing ---- */

static char bytes[1 << 16];
static size_t n_bytes;

static void add_text(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  n_bytes += (size_t)vsnprintf(bytes + n_bytes, sizeof bytes - n_bytes, format, arguments);
  va_end(arguments);
}

static void add_number(const void *value, size_t size, int is_big) {
  for (size_t i = 0; i < size; ++i) bytes[n_bytes++] = ((const char *)value)[is_big ? size - 1 - i : i];
}
static void add_byte(int value) { bytes[n_bytes++] = (char)value; }
static void add_int(int32_t value, int is_big) { add_number(&value, sizeof value, is_big); }
static void add_long(int64_t value, int is_big) { add_number(&value, sizeof value, is_big); }

static void add_points(int is_binary, int is_big) {
  for (int i = 0; i < n_vertices; ++i) {
    if (is_binary)
      for (int k = 0; k < 3; ++k) add_number(&xyz[i][k], sizeof xyz[i][k], is_big);
    else
      add_text("%.17g %.17g %.17g\n", xyz[i][0], xyz[i][1], xyz[i][2]);
  }
}

/* Vertices have several texture coordinates and normals, as in a textured model. The numbers of corners count from the start or
 * from the end. The file begins with a byte order mark, and a face has its old keyword fo. */
static void write_obj(void) {
  add_text("\xef\xbb\xbf# a model in C:\\models\\\nmtllib model.mtl\no valve\nvt 0 0\nvt 0.5 1\nvn 0 0 1\n");
  for (int i = 0; i < n_vertices; ++i)
    add_text(i % 2 ? "v %.17g %.17g \\\n  %.17g\n" : "v %.17g %.17g %.17g 1\r\n", xyz[i][0], xyz[i][1], xyz[i][2]);
  const char *const forms[4] = {" %d", " %d/1", " %d/2/1", " %d//1"};
  for (int face = 0, at = 0; face < n_faces; at += sizes[face++]) {
    add_text("g part_%d\nusemtl red\n%s", face, face == 2 ? "fo" : "f");
    for (int k = 0; k < sizes[face]; ++k)
      add_text(forms[(face + k) % 4], face == 1 ? corners[at + k] - n_vertices : corners[at + k] + 1);
    add_text(" # face %d\n", face);
  }
}

static void write_ply(int is_binary, int is_big) {
  add_text("ply\nformat %s 1.0\ncomment a model\nelement vertex %d\nproperty double x\nproperty float64 y\n",
           is_binary ? is_big ? "binary_big_endian" : "binary_little_endian" : "ascii", n_vertices);
  add_text("property double z\nelement face %d\nproperty uchar part\nproperty list uchar int vertex_indices\n",
           n_faces);
  add_text("property list ushort float texture\nelement edge 1\nproperty int64 a\nproperty uint b\nend_header\n");
  /* In old files, a carriage return alone ends a line. */
  for (size_t i = 0; i < n_bytes && is_big; ++i)
    if (bytes[i] == '\n') bytes[i] = '\r';
  add_points(is_binary, is_big);
  for (int face = 0, at = 0; face < n_faces; at += sizes[face++]) {
    const uint16_t one = 1;
    const float half = 0.5f;
    if (!is_binary) {
      add_text("%d %d", 7 - face, sizes[face]);
      for (int k = 0; k < sizes[face]; ++k) add_text(" %d", corners[at + k]);
      add_text(" 1 0.5\n");
      continue;
    }
    add_byte(7 - face);
    add_byte(sizes[face]);
    for (int k = 0; k < sizes[face]; ++k) add_int(corners[at + k], is_big);
    add_number(&one, sizes[face] ? sizeof one : 0, is_big);
    add_number(&half, sizeof half, is_big);
  }
  if (!is_binary) {
    add_text("1 2\n");
    return;
  }
  add_long(1, is_big);
  add_int(2, is_big);
}

static void write_vtk(int is_new, int is_binary) {
  add_text("# vtk DataFile Version %s\na model\n%s\nDATASET POLYDATA\nPOINTS %d double\n", is_new ? "5.1" : "3.0",
           is_binary ? "BINARY" : "ASCII", n_vertices);
  add_points(is_binary, 1);
  add_text(is_new ? "\nPOLYGONS %d %d\nOFFSETS vtktypeint64\n" : "\nPOLYGONS %d %d\n", n_faces + is_new,
           is_new ? n_corners : n_corners + n_faces);
  if (is_new)
    for (int face = 0, end = 0; face <= n_faces; end += face < n_faces ? sizes[face] : 0, ++face)
      is_binary ? add_long(end, 1) : add_text("%d ", end);
  if (is_new) add_text("\nCONNECTIVITY vtktypeint64\n");
  for (int face = 0, at = 0; face < n_faces; at += sizes[face++]) {
    if (!is_new) is_binary ? add_int(sizes[face], 1) : add_text("%d ", sizes[face]);
    for (int k = 0; k < sizes[face]; ++k) {
      if (!is_binary)
        add_text("%d ", corners[at + k]);
      else
        is_new ? add_long(corners[at + k], 1) : add_int(corners[at + k], 1);
    }
  }
  add_text("\nCELL_DATA %d\nSCALARS part int 1\nLOOKUP_TABLE default\n", n_faces);
  for (int face = 0; face < n_faces; ++face) is_binary ? add_int(7 - face, 1) : add_text("%d ", 7 - face);
  add_text("\n");
}

/* Fills `bytes` with a file of a kind. */
static void write_kind(int kind) {
  n_bytes = 0;
  if (kind == OBJ)
    write_obj();
  else if (!strcmp(endings[kind], "ply"))
    write_ply(kind != PLY_TEXT, kind == PLY_BIG);
  else
    write_vtk(kind == VTK_NEW_TEXT || kind == VTK_NEW_BINARY, kind == VTK_OLD_BINARY || kind == VTK_NEW_BINARY);
}

/* Lets each line of the text end in a single carriage return. */
static void end_lines_in_returns(void) {
  size_t n = 0;
  for (size_t i = 0; i < n_bytes; ++i) {
    const char c = bytes[i] == '\n' ? '\r' : bytes[i];
    if (c != '\r' || n == 0 || bytes[n - 1] != '\r') bytes[n++] = c;
  }
  n_bytes = n;
}

static const char *name_of(int kind) {
  static char name[32];
  snprintf(name, sizeof name, "model_%d.%s", kind, endings[kind]);
  return name;
}

/* ---- Tests ---- */

/* Each triangle's corners are corners of its face. The triangles of a face have the face's area, and all triangles point
 * upwards. */
TEST(test_formats_agree) {
  for (int trial = 0; trial < n_kinds + 2; ++trial) {
    /* At the end come texts whose lines end in a carriage return alone. */
    const int kind = trial < n_kinds ? trial : trial == n_kinds ? OBJ : PLY_TEXT;
    riis_vtk_surface *file = NULL;
    riis_surface_arrays arrays;
    write_kind(kind);
    if (trial >= n_kinds) end_lines_in_returns();
    scratch_write(name_of(kind), bytes, n_bytes);
    expect_fine(riis_vtk_surface_read(scratch_path(name_of(kind)), kind == OBJ ? NULL : "part", &file));
    expect_fine(riis_surface_arrays_init(&arrays, sizeof arrays));
    expect_fine(riis_vtk_surface_get_arrays(file, &arrays, sizeof arrays));
    assert_int_equal(arrays.n_vertices, n_vertices);
    assert_memory_equal(arrays.x, xyz, sizeof xyz);
    assert_int_equal(arrays.n_faces, n_triangles);
    assert_int_equal(arrays.corners_per_face, 3);
    assert_true((arrays.leaflet_id == NULL) == (kind == OBJ));
    const int64_t *ids = arrays.vertex_ids;
    for (int face = 0, at = 0, triangle = 0; face < n_faces; at += sizes[face++]) {
      double wanted = 0, found = 0;
      for (int k = 0; k < sizes[face]; ++k) {
        const double *a = plane[corners[at + k]], *b = plane[corners[at + (k + 1) % sizes[face]]];
        wanted += (a[0] * b[1] - a[1] * b[0]) / 2;
      }
      for (int i = 0; i < sizes[face] - 2; ++i, ++triangle) {
        const int64_t *t = ids + 3 * triangle;
        for (int k = 0; k < 3; ++k) {
          int is_corner = 0;
          for (int c = 0; c < sizes[face]; ++c) is_corner |= corners[at + c] == t[k];
          assert_true(is_corner);
        }
        const double *a = plane[t[0]], *b = plane[t[1]], *c = plane[t[2]];
        const double area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
        assert_true(area * wanted > 0);
        found += area;
        if (arrays.leaflet_id) assert_int_equal(arrays.leaflet_id[triangle], 7 - face);
      }
      assert_true(fabs(found - wanted) < 1e-12);
    }
    riis_vtk_surface_destroy(&file);
  }
}

/* Reads `bytes` as a file of a kind. The call must print nothing, and a refusal must name the file. Returns whether it is
 * read. */
static int is_read(int kind) {
  riis_vtk_surface *file = NULL;
  scratch_write(name_of(kind), bytes, n_bytes);
  scratch_watch_output();
  const riis_status status = riis_vtk_surface_read(scratch_path(name_of(kind)), NULL, &file);
  assert_int_equal(scratch_end_watch(), 0);
  if (status != RIIS_OK) {
    expect_refused(status, RIIS_FILE_ERROR, name_of(kind));
    assert_null(file);
  }
  riis_vtk_surface_destroy(&file);
  return status == RIIS_OK;
}

static void remove_bytes(size_t at, size_t n) {
  memmove(bytes + at, bytes + at + n, n_bytes - at - n);
  n_bytes -= n;
}

static void insert_text(size_t at, const char *text) {
  memmove(bytes + at + strlen(text), bytes + at, n_bytes - at);
  memcpy(bytes + at, text, strlen(text));
  n_bytes += strlen(text);
}

static size_t random_below(random_source *random, size_t n) { return (size_t)(random_bits(random) % n); }

/* Chooses a number in the text after `from`. Returns the number's position and length. */
static size_t random_number(random_source *random, size_t from, size_t *length) {
  for (;;) {
    size_t at = from + random_below(random, n_bytes - from);
    if (!strchr("0123456789", bytes[at])) continue;
    while (!strchr(" \n", bytes[at - 1])) --at;
    *length = strcspn(bytes + at, " \n");
    return at;
  }
}

/* A file to be damaged, which contains only the data that riis reads. Returns where its numbers begin. */
static size_t write_for_damage(int kind) {
  write_kind(kind);
  if (kind == OBJ) {
    n_bytes = 0;
    for (int i = 0; i < n_vertices; ++i) add_text("v %.17g %.17g %.17g\n", xyz[i][0], xyz[i][1], xyz[i][2]);
    for (int i = 0; i < 5; ++i) add_text("f %d %d %d\n", i + 1, i + 2, i + 3);
    return 0;
  }
  bytes[n_bytes] = 0;
  const int is_vtk = !strcmp(endings[kind], "vtk");
  if (is_vtk) n_bytes = (size_t)(strstr(bytes, "\nCELL_DATA") - bytes);
  const char *const begin = strstr(bytes, is_vtk ? "double\n" : "end_header\n");
  return (size_t)(strchr(begin, '\n') + 1 - bytes);
}

/* No reader may overlook these faults: a letter in a number, a missing number, a missing vertex, a cut file, and a line of other
 * content. */
TEST(test_damaged_texts) {
  random_source random = random_start("damaged texts");
  for (int kind = OBJ; kind <= VTK_NEW_TEXT; ++kind) {
    for (int trial = 0; trial < (is_long_test() ? 300 : 20); ++trial) {
      const size_t begin = write_for_damage(kind);
      size_t length;
      size_t at = random_number(&random, begin, &length);
      switch (trial % 5) {
        case 0:
          bytes[at + random_below(&random, length)] = 'x';
          break;
        case 1:
          remove_bytes(at, length);
          break;
        case 2: /* the last corner of the last face is a vertex far away */
          bytes[n_bytes] = 0;
          insert_text(kind == PLY_TEXT ? (size_t)(strstr(bytes, " 1 0.5\n1 2") - bytes) : n_bytes - 1, "99999");
          break;
        case 3: /* a cut before the last number; a cut .obj file has only vertices */
          if (kind == OBJ) {
            bytes[n_bytes] = 0;
            n_bytes = 1 + random_below(&random, (size_t)(strstr(bytes, "f ") - bytes));
          } else {
            n_bytes = 1 + random_below(&random, n_bytes - 4);
          }
          break;
        default:
          while (at > begin && bytes[at - 1] != '\n') --at;
          insert_text(at, "nonsense 1 2 3\n");
      }
      if (is_read(kind)) fail_msg("trial %d of kind %d is read:\n%.*s", trial, kind, (int)n_bytes, bytes);
    }
  }
}

/* Changes random bytes of any file. The file must be read or refused, without a crash. */
TEST(test_random_bytes) {
  random_source random = random_start("random bytes");
  for (int kind = 0; kind < n_kinds; ++kind) {
    for (int trial = 0; trial < (is_long_test() ? 300 : 20); ++trial) {
      write_kind(kind);
      for (int i = 1 + (int)random_below(&random, 4); i > 0; --i)
        bytes[random_below(&random, n_bytes)] = (char)random_bits(&random);
      if (trial % 4 == 0) n_bytes = 1 + random_below(&random, n_bytes);
      is_read(kind);
    }
  }
}

static void expect_file_error(const char *name, const char *text, const char *part) {
  riis_vtk_surface *file = NULL;
  scratch_write_text(name, text);
  expect_refused(riis_vtk_surface_read(scratch_path(name), NULL, &file), RIIS_FILE_ERROR, part);
}

#define OBJ_START "v 0 0 0\nv 1 0 0\n\nv 0 1 0\n"
#define PLY_START                                                                                                   \
  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n" \
  "property list uchar int vertex_index\nend_header\n"
#define VTK_START "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"

TEST(test_messages) {
  expect_file_error("a.obj", OBJ_START "f 1 2 4\n", "a.obj: line 5: a face names vertex 4; the file has 3");
  expect_file_error("b.obj", OBJ_START "f 1 2 0\n", "b.obj: line 5: a face names vertex 0; 3 come before it");
  expect_file_error("c.obj", OBJ_START "f 1 2 -4\n", "line 5: a face names vertex -4");
  expect_file_error("d.obj", OBJ_START "f 1 2 3/x\n", "line 5: \"x\" is not a whole number");
  expect_file_error("e.obj", OBJ_START "f 1 2\n", "line 5: a face has 2 corners");
  expect_file_error("f.obj", OBJ_START "curv 0 1 1 2\nf 1 2 3\n", "line 5: the keyword 'curv' is not read");
  expect_file_error("g.obj", OBJ_START "l 1 2\nf 1 2 3\n", "line 5: 'l' is not a face; a surface has faces only");
  expect_file_error("h.obj", "v 0 0\n", "line 1: a vertex has 2 numbers; it needs x, y and z");
  expect_file_error("i.obj", OBJ_START "f 1 2 \\\n 3/1/1/1\n", "line 5: the corner '3/1/1/1' has more than 3 numbers");
  expect_file_error("j.obj", OBJ_START, "j.obj: holds no faces");
  expect_file_error("k.obj", OBJ_START "v nan 0 0\nf 1 2 3\n", "x of node 3 is nan");
  expect_file_error("a.ply", PLY_START "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a.ply: cell 0 names point 3 of 3");
  expect_file_error("b.ply", PLY_START "0 0 0\n1 0 0\n0 1\n3 0 1 2\n",
                    "line 13: a line has more or fewer numbers than");
  expect_file_error("c.ply", PLY_START "0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "line 13: face 0 has 2 corners");
  expect_file_error("d.ply", PLY_START "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n7\n", "holds more data than its header states");
  expect_file_error("e.ply", "ply\nformat ascii 1.0\nelement vertex 900\nproperty float x\nend_header\n0\n",
                    "claims 900 elements vertex, but only 2 bytes follow");
  expect_file_error("f.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\nend_header\n0\n",
                    "f.ply: line 4: 'real' is not a type of numbers");
  expect_file_error("g.ply", "ply\nformat ascii 1.0\nelement vertex 1\n", "is truncated: its header has no end_header");
  expect_file_error("h.ply", "solid x\n", "is not a PLY file");
  expect_file_error("a.vtk", VTK_START "POLYGONS 1 4\n3 0 1 3\n", "a.vtk: cell 0 names point 3 of 3");
  expect_file_error("b.vtk", VTK_START "POLYGONS 1 4\n3 0 1 2\nPOLYGONS 1 4\n3 0 1 2\n", "has POLYGONS twice");
  expect_file_error("c.vtk", VTK_START "POLYGONS 1 9\n3 0 1 2\n", "POLYGONS with 5 numbers too many");
  expect_file_error("d.vtk", VTK_START "LINES 1 3\n2 0 1\n", "holds 0 vertices and 1 lines; a surface has faces only");
  expect_file_error("e.vtk", VTK_START, "holds no cells (is it truncated?)");
}

static int set_up(void **state) {
  make_vertices();
  return scratch_setup(state);
}

int main(void) { return run_cases(set_up, scratch_teardown); }
