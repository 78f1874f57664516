/* SPDX-License-Identifier: Apache-2.0
 *
 * Runs the program with meshes of other programs. The cases are: a note on single precision, damaged files (which a child process
 * reads), .xdmf as output, and fields of OpenFOAM for one time and for a series. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "formats_shim.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

static const double lower[3] = {-2, -2, -2}, upper[3] = {2, 2, 2};

TEST(test_notes) {
  assert_true(shim_write_box(scratch_path("single.vtu"), SHIM_RAW, 9, lower, upper, 1));
  char line[256];
  snprintf(line, sizeof line, "note      %s: its points have single precision\n", scratch_path("single.vtu"));
  RUN_FINE("mark", scratch_path("single.vtu"), "--half-thickness", "0.3");
  assert_true(strncmp(program_out, line, strlen(line)) == 0);
  assert_null(strstr(program_out + strlen(line), "note "));
  assert_true(shim_write_box(scratch_path("double.vtu"), SHIM_RAW, 9, lower, upper, 0));
  RUN_FINE("mark", scratch_path("double.vtu"), "--half-thickness", "0.3");
  assert_null(strstr(program_out, "note "));
  RUN_FINE("mark", scratch_path("single.vtu"), "--half-thickness", "0.3", "--stats", "-");
  assert_null(strstr(program_out, "note "));
  RUN_FINE("mark", scratch_path("single.vtu"), "--half-thickness", "0.3", "--quiet", "--output", scratch_path("o.vtu"));
}

/* A mesh keeps its marks when it is written to .xdmf and read again. A child process reads the .xdmf. */
TEST(test_xdmf) {
  RUN_FINE("mark", scratch_path("in.vtu"), "--half-thickness", "0.3", "--resistance", "2", "--output",
           scratch_path("marked.xdmf"));
  RUN_FINE("mark", scratch_path("in.vtu"), "--half-thickness", "0.3", "--resistance", "2", "--output",
           scratch_path("marked.vtu"));
  RUN_FINE("mark", scratch_path("marked.xdmf"), "--half-thickness", "0.3", "--prefix", "again", "--output",
           scratch_path("again.vtu"));
  static double K[2][n_box];
  char type[32];
  int64_t n_components = 0, n = 0;
  const char *names[] = {"marked.vtu", "again.vtu"};
  for (int i = 0; i < 2; ++i)
    assert_true(shim_read_array(scratch_path(names[i]), 'p', "riis_K", type, &n_components, &n, K[i]) && n == n_box);
  assert_memory_equal(K[0], K[1], sizeof K[0]);
  int64_t counts[4];
  assert_true(shim_compare_meshes(scratch_path("marked.vtu"), scratch_path("again.vtu"), SHIM_BITS, counts));
  assert_true(counts[0] == n_box && counts[2] == 0 && counts[3] == 0);
  RUN_REFUSED(2, "marked.xdmf already has an array riis_marked", "mark", scratch_path("marked.xdmf"), "--output",
              scratch_path("o.vtu"));
  RUN_REFUSED(2, "o.doc must end in .vtu", "mark", scratch_path("in.vtu"), "--output", scratch_path("o.doc"));
}

/* The .h5 file of an .xdmf output is also an output. It is also an input of each .xdmf that names it. */
TEST(test_numbers_of_xdmf) {
  RUN_REFUSED(2, "o.h5 is also the file of --output", "mark", scratch_path("in.vtu"), "--half-thickness", "0.3",
              "--output", scratch_path("o.xdmf"), "--stats", scratch_path("o.h5"));
  RUN_FINE("mark", scratch_path("in.vtu"), "--half-thickness", "0.3", "--output", scratch_path("whole.xdmf"));
  if (scratch_exists("whole.h5")) {
    size_t n = 0;
    char *text = scratch_read(scratch_path("whole.xdmf"), &n);
    scratch_write("other.xdmf", text, n);
    free(text);
    RUN_REFUSED(2, "whole.h5 is also the file of MESH", "mark", scratch_path("other.xdmf"), "--half-thickness", "0.3",
                "--prefix", "again", "--output", scratch_path("whole.xdmf"));
    RUN_FINE("mark", scratch_path("other.xdmf"), "--half-thickness", "0.3");
  }
  scratch_write_text("empty.xdmf",
                     "<Xdmf><Domain><Grid><Topology TopologyType=\"Tetrahedron\" NumberOfElements=\"1\">"
                     "<DataItem Dimensions=\"1 4\" Format=\"XML\"/></Topology><Geometry GeometryType=\"XYZ\">"
                     "<DataItem Dimensions=\"4 3\" Format=\"XML\"/></Geometry></Grid></Domain></Xdmf>");
  RUN_REFUSED(1, "empty.xdmf: ", "mark", scratch_path("empty.xdmf"), "--half-thickness", "0.3");
  assert_null(strstr(program_err, "signal"));
}

/* Damages bytes of a file. The program must read the file or refuse it in one line, and no signal may end the program. */
static void damage(const char *name, const char *mesh, int n_trials) {
  size_t n = 0;
  char *whole = scratch_read(scratch_path(name), &n);
  uint64_t random = 20261125 + (uint64_t)n;
  for (int trial = 0; trial < n_trials; ++trial) {
    char *bytes = malloc(n);
    memcpy(bytes, whole, n);
    size_t length = n;
    for (int k = 0; k < 1 + trial % 6; ++k) {
      random = random * 6364136223846793005u + 1442695040888963407u;
      /* Headers are at the beginning of the file. */
      const size_t range = trial % 2 ? n : n < 4096 ? n : 4096;
      bytes[(random >> 24) % range] = (char)(random >> 16);
    }
    if (trial % 5 == 4) length = (size_t)(random >> 24) % n;
    scratch_write(name, bytes, length);
    run_program("mark", scratch_path(mesh), "--half-thickness", "0.3", "--allow-none", "--quiet", "--replace",
                "--output", scratch_path("o.vtu"), NULL);
    if (program_exit_code > 1)
      fail_msg("trial %d of %s: exit code %d: %s", trial, name, program_exit_code, program_err);
    if (program_exit_code == 1) {
      const char *end = strchr(program_err, '\n');
      if (strncmp(program_err, "riis: ", 6) != 0 || !end || end[1] != 0)
        fail_msg("trial %d of %s: %s", trial, name, program_err);
    }
    free(bytes);
  }
  scratch_write(name, whole, n);
  free(whole);
}

TEST(test_damaged) {
  RUN_FINE("mark", scratch_path("in.vtu"), "--half-thickness", "0.3", "--output", scratch_path("marked.xdmf"));
  if (scratch_exists("marked.h5")) damage("marked.h5", "marked.xdmf", 15);
  if (shim_write_exodus(scratch_path("box.exo"), scratch_path("in.vtu"))) {
    damage("box.exo", "box.exo", 15);
    run_program("mark", scratch_path("box.exo"), "--half-thickness", "0.3", NULL);
    assert_int_equal(program_exit_code, 0);
    /* Tetrahedra alternate between two blocks. */
    assert_non_null(strstr(program_err, "box.exo has the regions 100 and 101 of the cell array ObjectId"));
  }
}

/* ---- A case of OpenFOAM: a box of n x n x n cells ---- */

enum { n_side = 12, n_foam_cells = n_side * n_side * n_side };

static int cell_at(int i, int j, int k) { return i + n_side * (j + n_side * k); }

static void write_list(const char *name, const char *kind, const char *text) {
  char *all = malloc(strlen(text) + 256), path[128];
  sprintf(all, "FoamFile { version 2.0; format ascii; class %s; }\n%s", kind, text);
  snprintf(path, sizeof path, "box/constant/polyMesh/%s", name);
  scratch_write_text(path, all);
  free(all);
}

/* Writes the case, and also the centres of its cells as a mesh without cells. */
static void write_case(void) {
  enum { room = 1 << 20 };
  char *points = malloc(room), *centers = malloc(room), *faces = malloc(room), *owner = malloc(room),
       *neighbor = malloc(room);
  char *p = points, *c = centers, *f = faces, *o = owner, *b = neighbor;
  const int n_points = n_side + 1, n_inner = 3 * n_side * n_side * (n_side - 1),
            n_faces = n_inner + 6 * n_side * n_side;
  const double step = 4.0 / n_side;
  p += sprintf(p, "%d\n(\n", n_points * n_points * n_points);
  for (int k = 0; k < n_points; ++k)
    for (int j = 0; j < n_points; ++j)
      for (int i = 0; i < n_points; ++i)
        p += sprintf(p, "(%.17g %.17g %.17g)\n", -2 + step * i, -2 + step * j, -2 + step * k);
  p += sprintf(p, ")\n");
  c += sprintf(c, "# vtk DataFile Version 2.0\ncenters\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS %d double\n",
               n_foam_cells);
  for (int k = 0; k < n_side; ++k)
    for (int j = 0; j < n_side; ++j)
      for (int i = 0; i < n_side; ++i)
        c += sprintf(c, "%.17g %.17g %.17g\n", -2 + step * (i + 0.5), -2 + step * (j + 0.5), -2 + step * (k + 0.5));
  c += sprintf(c, "CELLS 0 0\nCELL_TYPES 0\n");
  f += sprintf(f, "%d\n(\n", n_faces);
  o += sprintf(o, "%d\n(\n", n_faces);
  b += sprintf(b, "%d\n(\n", n_inner);
  for (int outside = 0; outside < 2; ++outside)
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k <= n_side; ++k)
        for (int j = 0; j <= n_side; ++j)
          for (int i = 0; i <= n_side; ++i) {
            const int at[3] = {i, j, k}, u = (axis + 1) % 3, v = (axis + 2) % 3;
            if (at[u] == n_side || at[v] == n_side) continue;
            if ((at[axis] == 0 || at[axis] == n_side) != outside) continue;
            /* The normal points from the cell below to the cell above, or out of the box. */
            int corners[4];
            for (int corner = 0; corner < 4; ++corner) {
              int node[3] = {i, j, k};
              node[u] += corner == 1 || corner == 2;
              node[v] += corner == 2 || corner == 3;
              corners[corner] = node[0] + n_points * (node[1] + n_points * node[2]);
            }
            const int flip = at[axis] == 0;
            f += sprintf(f, "4(%d %d %d %d)\n", corners[0], corners[flip ? 3 : 1], corners[2], corners[flip ? 1 : 3]);
            int below[3] = {i, j, k};
            if (at[axis] > 0) --below[axis];
            o += sprintf(o, "%d\n", cell_at(below[0], below[1], below[2]));
            if (!outside) b += sprintf(b, "%d\n", cell_at(i, j, k));
          }
  sprintf(f, ")\n");
  sprintf(o, ")\n");
  sprintf(b, ")\n");
  const char *folders[] = {"box", "box/constant", "box/constant/polyMesh"};
  for (int i = 0; i < 3; ++i) mkdir(scratch_path(folders[i]), 0700);
  write_list("points", "vectorField", points);
  write_list("faces", "faceList", faces);
  write_list("owner", "labelList", owner);
  write_list("neighbour", "labelList", neighbor);
  write_list("boundary", "polyBoundaryMesh",
             "2\n(\n  walls { type wall; coupling { type cyclic; } nFaces 864; startFace 4752; }\n"
             "  side { inGroups 2 (type sides); type symmetryPlane; nFaces 0; startFace 5616; }\n)\n");
  scratch_write_text("centers.vtk", centers);
  char *all[] = {points, centers, faces, owner, neighbor};
  for (int i = 0; i < 5; ++i) free(all[i]);
}

/* Reads n numbers of a field's internal values, and checks that its patches follow. */
static void read_field(const char *name, const char *kind, int n, double *values) {
  char *text = scratch_read(scratch_path(name), NULL);
  assert_non_null(strstr(text, kind));
  const char *at = strchr(strstr(text, "nonuniform List<"), '(') + 1;
  for (int i = 0; i < n; ++i) {
    char *end = NULL;
    while (strchr("()\n", *at)) ++at;
    values[i] = strtod(at, &end);
    assert_true(end != at);
    at = end;
  }
  assert_non_null(strstr(at, "walls\n    {\n        type            zeroGradient;"));
  assert_non_null(strstr(at, "side\n    {\n        type            symmetryPlane;"));
  free(text);
}

TEST(test_foam) {
  write_case();
  static double K[n_foam_cells], expected[n_foam_cells], Ku[3 * n_foam_cells];
  char type[32];
  int64_t n_components = 0, n = 0;
  /* The centres of the cells also form a mesh of nodes without cells. */
  RUN_WITHOUT_CELLS("mark", scratch_path("centers.vtk"), "--half-thickness", "0.3", "--resistance", "2", "--output",
                    scratch_path("centers.vtu"));
  assert_true(shim_read_array(scratch_path("centers.vtu"), 'p', "riis_K", type, &n_components, &n, expected));
  assert_true(n == n_foam_cells);
  RUN_FINE("mark", scratch_path("box"), "--cells", "--half-thickness", "0.3", "--resistance", "2", "--density", "1.06",
           "--output", scratch_path("box/0"));
  read_field("box/0/K", "volScalarField", n_foam_cells, K);
  int n_marked = 0;
  for (int i = 0; i < n_foam_cells; ++i) {
    assert_true(fabs(K[i] - expected[i] / 1.06) <= 1e-11 * (1 + expected[i]));
    n_marked += K[i] > 0;
  }
  assert_true(n_marked > 20);
  assert_true(scratch_exists("box/0/marked") && scratch_exists("box/0/distance"));
  /* A series writes a folder for each time, with the valve's velocity. */
  scratch_write_text("beat.csv", "0,0\n0.5,1\n1,0\n");
  RUN_FINE("mark", scratch_path("box"), "--cells", "--half-thickness", "0.3", "--resistance", "2", "--density", "1060",
           "--cycle", scratch_path("beat.csv"), "--times", "0.1:0.3:0.1", "--quiet", "--output", scratch_path("box"));
  const char *times[] = {"0.1", "0.2"};
  for (int i = 0; i < 2; ++i) {
    char name[64];
    snprintf(name, sizeof name, "box/%s/K", times[i]);
    read_field(name, "volScalarField", n_foam_cells, K);
    snprintf(name, sizeof name, "box/%s/Ku", times[i]);
    read_field(name, "volVectorField", 3 * n_foam_cells, Ku);
    int n_moving = 0;
    for (int cell = 0; cell < n_foam_cells; ++cell) {
      const double speed = fabs(Ku[3 * cell]) + fabs(Ku[3 * cell + 1]) + fabs(Ku[3 * cell + 2]);
      assert_true(K[cell] > 0 || speed == 0);
      n_moving += speed > 0;
    }
    assert_true(n_moving > 20);
  }
  scratch_write_text("skin.vtk",
                     "# vtk DataFile Version 2.0\nskin\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n"
                     "0 0 0 1 0 0 0 1 0\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n");
  const char *box = scratch_path("box"), *time = scratch_path("box/7");
  RUN_REFUSED(2,
              "box/7: OpenFOAM's K is divided by the density: write --density RHO, and R in kg/(m s) as --resistance",
              "mark", box, "--cells", "--resistance", "2", "--output", time);
  RUN_REFUSED(2, "--k-unit has no effect on the fields of OpenFOAM, because their K has the unit 1/s", "mark", box,
              "--cells", "--resistance", "2", "--density", "1060", "--k-unit", "1/s", "--output", time);
  RUN_REFUSED(2, "--density has no effect: K is divided by the density only in the fields of an OpenFOAM case", "mark",
              box, "--cells", "--resistance", "2", "--density", "1060", "--output", scratch_path("out.vtu"));
  RUN_REFUSED(2, "box/7 takes fields of cells: write --cells", "mark", box, "--output", time);
  RUN_REFUSED(2, "--cells: --picture shows marks of nodes", "mark", box, "--cells", "--picture", "a.png");
  RUN_REFUSED(2, "--cells: --steps marks nodes, not centres", "mark", box, "--cells", "--steps", "3");
  RUN_REFUSED(1, "box/7: is a time folder of a case, but the mesh was not read from this case", "mark",
              scratch_path("in.vtu"), "--half-thickness", "0.3", "--cells", "--output", time);
  RUN_REFUSED(2, "cell 0 is a vtkTriangle; centres are those of linear volume cells and polyhedra", "mark",
              scratch_path("skin.vtk"), "--cells");
}

/* Writes a field U of the time 9. */
static void write_velocity(const char *field_class, const char *values) {
  char *text = malloc(strlen(values) + 256);
  sprintf(text,
          "FoamFile { version 2.0; format ascii; class %s; }\ndimensions [0 1 -1 0 0 0 0];\n"
          "internalField %s;\nboundaryField { }\n",
          field_class, values);
  scratch_write_text("box/9/U", text);
  free(text);
}

static const char *const flow_words[] = {"--valve",        "aortic",  "--half-thickness",   "0.3",
                                         "--picture-size", "300x200", "--picture-velocity", "U"};
#define FLOW(picture)                                                                                       \
  "mark", scratch_path("box/9"), flow_words[0], flow_words[1], flow_words[2], flow_words[3], flow_words[4], \
      flow_words[5], flow_words[6], flow_words[7], "--view", "valve-side", "--picture", scratch_path(picture)

/* A velocity of OpenFOAM is drawn. A uniform field and a list of equal values give the same picture. */
TEST(test_foam_flow) {
  write_case();
  mkdir(scratch_path("box/9"), 0700);
  write_velocity("volVectorField", "uniform (0 3 4)");
  RUN_FINE(FLOW("uniform.png"));
  char *list = malloc(16 * n_foam_cells + 64),
       *at = list + sprintf(list, "nonuniform List<vector>\n%d\n(\n", n_foam_cells);
  char *const first = at;
  for (int i = 0; i < n_foam_cells; ++i) at += sprintf(at, "(0 3 4)\n");
  sprintf(at, ")\n");
  write_velocity("volVectorField", list);
  RUN_FINE(FLOW("list.png"));
  assert_true(scratch_is_same("uniform.png", "list.png"));
  for (int i = 0; i < n_foam_cells / 2; ++i) first[8 * i + 5] = '0'; /* half of the box is slower */
  write_velocity("volVectorField", list);
  RUN_FINE(FLOW("half.png"));
  assert_false(scratch_is_same("list.png", "half.png"));
  RUN_REFUSED(1, "box/8: there is no such time of the case; written are ", "mark", scratch_path("box/8"));
  RUN_REFUSED(2, "is not an array of the mesh; for a field of OpenFOAM, name a time in place of the case: ", "mark",
              scratch_path("box"), "--valve", "aortic", "--half-thickness", "0.3", "--picture", scratch_path("no.png"),
              "--picture-velocity", "U");
  write_velocity("volScalarField", "uniform 3");
  RUN_REFUSED(1, "box/9/U: has the class volScalarField; a velocity is a volVectorField", FLOW("no.png"));
  write_velocity("volVectorField", "nonuniform List<vector> 2((0 3 4)(0 3 4))");
  RUN_REFUSED(1, "box/9/U: has 2 values, and the mesh has 1728 cells", FLOW("no.png"));
  write_velocity("volVectorField", "$start");
  RUN_REFUSED(1, "internalField begins with \"$start\", not uniform or nonuniform", FLOW("no.png"));
  RUN_REFUSED(2, "--picture-velocity is \"U\", which is not an array of the mesh", "mark", scratch_path("in.vtu"),
              "--valve", "aortic", "--half-thickness", "0.3", "--picture", scratch_path("no.png"), "--picture-velocity",
              "U");
  free(list);
}

int main(void) { return run_cases(make_box, scratch_teardown); }
