/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests meshes that OpenFOAM's programs make: blockMesh as text, binary and compressed, gmshToFoam with all linear cells,
 * polyDualMesh with polyhedra, and decomposePar. foamToVTK and gmsh write these meshes independently. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "expect.h"
#include "formats_shim.h"
#include "scratch.h"

/* Runs a command in the scratch folder. */
static void run(const char *format, ...) {
  char command[2048], arguments[1024];
  va_list list;
  va_start(list, format);
  vsnprintf(arguments, sizeof arguments, format, list);
  va_end(list);
  snprintf(command, sizeof command, "cd %s && (%s) > log.txt 2>&1", scratch_path("."), arguments);
  if (system(command) != 0) {
    size_t n = 0;
    const char *log = scratch_read(scratch_path("log.txt"), &n);
    fail_msg("%s\n%s", command, log + (n > 800 ? n - 800 : 0));
  }
}

/* ---- A tetrahedron as text, whole and broken ---- */

static const char *const file_names[] = {"points", "faces", "owner", "neighbour"};
static const char *const contents[] = {
    ("FoamFile\n{\n  version 2.0;\n  format ascii;\n  class vectorField;\n  object points;\n}\n// * * //\n4\n(\n"
     "(0 0 0)\n(1 0 0)\n(0 1 0)\n(0 0 1)\n)\n"),
    ("FoamFile { version 2.0; format ascii; class faceList; object faces; }\n4\n(\n3(0 2 1)\n3(0 1 3)\n3(1 2 3)\n"
     "3(0 3 2)\n)\n"),
    "FoamFile { version 2.0; format ascii; class labelList; note \"nPoints:4  nCells:1\"; }\n4{0}\n",
    "FoamFile { version 2.0; format ascii; class labelList; }\n0()\n"};

static void write_tetrahedron(int changed, const char *text) {
  for (int i = 0; i < 4; ++i) {
    char name[64];
    snprintf(name, sizeof name, "tet/constant/polyMesh/%s", file_names[i]);
    scratch_write_text(name, i == changed ? text : contents[i]);
  }
}

typedef struct broken {
  int file;
  const char *from, *to, *text;
} broken;

static const broken faults[] = {
    {0, "FoamFile", "Foam", "points: is not a file of OpenFOAM: it does not begin with FoamFile"},
    {0, "ascii", "text", "points: has the format text; it must be ascii or binary"},
    {0, "}\n//", "\n//", "points: is truncated: it ends within its header"},
    {0, "\n4\n(", "\n1000000000000\n(", "claims 1000000000000 points, but only"},
    {0, "\n4\n(", "\n-4\n(", "claims -4 points"},
    {0, "\n4\n(", "\n5\n(", "\")\" stands where there must be a \"(\""},
    {0, "\n4\n(", "\n3\n(", "\"(\" stands where there must be a \")\""},
    {0, "(1 0 0)", "(1 0)", "\")\" is not a number"},
    {0, "(1 0 0)", "(1 nan 0)", "y of node 1 is nan"},
    {0, "(1 0 0)", "(1 0 x)", "\"x\" is not a number"},
    {0, "format ascii;", "format binary; arch \"LSB;label=32;scalar=16\";",
     "has a scalar of 16 bits; 32 and 64 are read"},
    {0, "format ascii;", "format binary; arch \"LSB;label=32;scalar=64\";", "claims 4 points, but only"},
    {0, "\n4\n(", "\n4{(0 0 0)}\n(", "equal points in {} are not read"},
    {1, "\n4\n(", "\n9\n(", "claims 9 faces, but only"},
    {1, "3(1 2 3)", "3(1 2 4)", "faces: face 2 names point 4 of 4"},
    {1, "3(1 2 3)", "3(1 2 -3)", "faces: face 2 names point -3 of 4"},
    {1, "3(1 2 3)", "2(1 2)", "faces: face 2 has 2 points"},
    {1, "3(1 2 3)", "3000000000000(1 2 3)", "claims 3000000000000 points of a face"},
    {1, "class faceList", "class faceCompactList", "faces: "},
    {1, "format ascii;", "format binary;", "binary faces are read as faceCompactList"},
    {2, "4{0}", "4{7}", "owner: face 0 names cell 7, and there are 4 faces"},
    {2, "4{0}", "4{-1}", "owner: face 0 names cell -1"},
    {2, "4{0}", "3{0}", "owner: has 3 entries for 4 faces"},
    {2, "4{0}", "1000000000000{0}", "claims 1000000000000 equal numbers; at most"},
    {2, "4{0}", "4(0 0 0 1)", "cell 0 has 3 faces; a cell has at least 4"},
    {3, "0()", "5(0 0 0 0 0)", "neighbour: has 5 entries for 4 faces"},
    {3, "0()", "1(9)", "neighbour: face 0 names cell 9"},
    {3, "0()", "1(0", "neighbour: is truncated"},
};

TEST(test_tetrahedron) {
  run("mkdir -p tet/constant/polyMesh");
  write_tetrahedron(-1, NULL);
  const char *paths[] = {"tet", "tet/", "tet/constant/polyMesh", "tet/case.foam"};
  scratch_write_text("tet/case.foam", "");
  for (int i = 0; i < 4; ++i) {
    riis_vtk_mesh *mesh = NULL;
    int64_t n_nodes = 0, n_cells = 0, n_volumes = 0;
    expect_fine(riis_vtk_mesh_read(scratch_path(paths[i]), &mesh));
    expect_fine(riis_vtk_mesh_get_nodes(mesh, &n_nodes, &n_cells, NULL));
    expect_fine(riis_vtk_mesh_get_volume_cells(mesh, &n_volumes, NULL));
    assert_true(n_nodes == 4 && n_cells == 1 && n_volumes == 1);
    riis_vtk_mesh_destroy(&mesh);
  }
}

TEST(test_broken) {
  run("mkdir -p tet/constant/polyMesh");
  riis_vtk_mesh *mesh = NULL;
  for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i) {
    const char *whole = contents[faults[i].file], *at = strstr(whole, faults[i].from);
    char text[1024];
    if (!at) fail_msg("no \"%s\" in %s", faults[i].from, file_names[faults[i].file]);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - whole), whole, faults[i].to, at + strlen(faults[i].from));
    write_tetrahedron(faults[i].file, text);
    expect_refused(riis_vtk_mesh_read(scratch_path("tet"), &mesh), RIIS_FILE_ERROR, faults[i].text);
    expect_refused(riis_vtk_mesh_read(scratch_path("tet"), &mesh), RIIS_FILE_ERROR, "tet");
    assert_null(mesh);
  }
  for (int file = 0; file < 4; ++file)
    for (size_t length = 0; length + 2 < strlen(contents[file]); ++length) {
      char text[1024];
      snprintf(text, sizeof text, "%.*s", (int)length, contents[file]);
      write_tetrahedron(file, text);
      const riis_status status = riis_vtk_mesh_read(scratch_path("tet"), &mesh);
      /* "0" without its parentheses is a complete list. */
      if (status == RIIS_OK && file == 3 && length > 56) {
        riis_vtk_mesh_destroy(&mesh);
        continue;
      }
      expect_refused(status, RIIS_FILE_ERROR, file_names[file]);
    }
  write_tetrahedron(-1, NULL);
  run("gzip -k tet/constant/polyMesh/points && head -c 60 tet/constant/polyMesh/points.gz > cut && "
      "rm tet/constant/polyMesh/points tet/constant/polyMesh/points.gz && cp cut tet/constant/polyMesh/points.gz");
  expect_refused(riis_vtk_mesh_read(scratch_path("tet"), &mesh), RIIS_FILE_ERROR,
                 "points.gz: is truncated: its compressed data ends too early");
  run("mkdir -p none par/processor0/constant/polyMesh && cp tet/constant/polyMesh/[fon]* "
      "par/processor0/constant/polyMesh");
  scratch_write_text("par/processor0/constant/polyMesh/points", contents[0]);
  expect_refused(riis_vtk_mesh_read(scratch_path("none"), &mesh), RIIS_FILE_ERROR,
                 "none: is a directory, but not a case of OpenFOAM: it lacks constant/polyMesh");
  run("mkdir mesh.bp && touch mesh.bp/md.idx");
  expect_refused(riis_vtk_mesh_read(scratch_path("mesh.bp"), &mesh), RIIS_FILE_ERROR,
                 "mesh.bp: is a folder of ADIOS2, which riis cannot read");
  expect_refused(riis_vtk_mesh_read(scratch_path("par"), &mesh), RIIS_FILE_ERROR,
                 "has no file pointProcAddressing; reconstructParMesh -constant joins the parts");
  run("mkdir -p collated/processors4");
  expect_refused(riis_vtk_mesh_read(scratch_path("collated"), &mesh), RIIS_FILE_ERROR, "reconstructParMesh -constant");
  expect_refused(riis_vtk_mesh_read(scratch_path("missing.foam"), &mesh), RIIS_FILE_ERROR, "lacks constant/polyMesh");
}

#ifdef RIIS_BLOCKMESH
static void rewrite(const char *from, const char *to) {
  riis_vtk_mesh *mesh = NULL;
  const char *notes = NULL;
  expect_fine(riis_vtk_mesh_read(scratch_path(from), &mesh));
  expect_fine(riis_vtk_mesh_get_notes(mesh, &notes));
  assert_string_equal(notes, "");
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path(to)));
  riis_vtk_mesh_destroy(&mesh);
}

static void write_case(const char *name, const char *format, const char *compression) {
  char path[128], text[1024];
  run("mkdir -p %s/system %s/constant", name, name);
  snprintf(path, sizeof path, "%s/system/controlDict", name);
  snprintf(
      text, sizeof text,
      "FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }\napplication icoFoam;\n"
      "startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1; writeControl timeStep; writeInterval 1;\n"
      "writeFormat %s; writePrecision 17; writeCompression %s; timeFormat general; timePrecision 6;\n",
      format, compression);
  scratch_write_text(path, text);
  snprintf(path, sizeof path, "%s/system/fvSchemes", name);
  scratch_write_text(
      path,
      "FoamFile { version 2.0; format ascii; class dictionary; object fvSchemes; }\nddtSchemes {default "
      "Euler;}\ngradSchemes {default Gauss linear;}\ndivSchemes {default none;}\nlaplacianSchemes {default "
      "Gauss linear corrected;}\ninterpolationSchemes {default linear;}\nsnGradSchemes {default corrected;}\n");
  snprintf(path, sizeof path, "%s/system/fvSolution", name);
  scratch_write_text(path, "FoamFile { version 2.0; format ascii; class dictionary; object fvSolution; }\n");
  snprintf(path, sizeof path, "%s/system/decomposeParDict", name);
  scratch_write_text(path,
                     "FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }\n"
                     "numberOfSubdomains 3; method simple; simpleCoeffs { n (3 1 1); delta 0.001; }\n");
  snprintf(path, sizeof path, "%s/system/blockMeshDict", name);
  scratch_write_text(
      path,
      "FoamFile { version 2.0; format ascii; class dictionary; object blockMeshDict; }\nconvertToMeters 1;\n"
      "vertices ((-1.5 -1.4 -2) (1.5 -1.3 -2) (1.5 1.4 -2.1) (-1.5 1.3 -2) (-1.5 -1.4 2) (1.6 -1.3 2) (1.5 1.4 2.2) "
      "(-1.5 1.35 2));\nblocks (hex (0 1 2 3 4 5 6 7) (5 6 7) simpleGrading (1 1.3 1));\nedges ();\n"
      "boundary (inlet {type patch; faces ((0 3 2 1));} outlet {type patch; faces ((4 5 6 7));}\n"
      "  sides {type wall; faces ((0 1 5 4) (1 2 6 5) (2 3 7 6));} slip {type symmetryPlane; faces ((3 0 4 7));});\n"
      "mergePatchPairs ();\n");
}

static void expect_same(const char *a, const char *b, int how, int64_t n_least) {
  int64_t counts[4] = {0, 0, -1, -1};
  assert_true(shim_compare_meshes(scratch_path(a), scratch_path(b), how, counts));
  if (counts[2] != 0 || counts[3] != 0 || counts[0] < n_least || counts[1] < n_least)
    fail_msg("%s and %s: %lld points, %lld cells, of which %lld and %lld differ", a, b, (long long)counts[0],
             (long long)counts[1], (long long)counts[2], (long long)counts[3]);
}

/* The nodes have the same bits and order, and the cells have the same centres. */
static void expect_same_order(const char *a, const char *b) {
  riis_vtk_mesh *meshes[2] = {NULL, NULL};
  const double *xyz[2];
  int64_t n[2];
  const char *names[] = {a, b};
  for (int i = 0; i < 2; ++i) {
    expect_fine(riis_vtk_mesh_read(scratch_path(names[i]), &meshes[i]));
    expect_fine(riis_vtk_mesh_get_nodes(meshes[i], &n[i], NULL, &xyz[i]));
  }
  assert_true(n[0] == n[1] && memcmp(xyz[0], xyz[1], 3 * sizeof(double) * (size_t)n[0]) == 0);
  for (int i = 0; i < 2; ++i) {
    expect_fine(riis_vtk_mesh_use_centers(meshes[i]));
    expect_fine(riis_vtk_mesh_get_nodes(meshes[i], &n[i], NULL, &xyz[i]));
  }
  assert_true(n[0] == n[1]);
  for (int64_t i = 0; i < 3 * n[0]; ++i) assert_true(fabs(xyz[0][i] - xyz[1][i]) < 1e-14);
  for (int i = 0; i < 2; ++i) riis_vtk_mesh_destroy(&meshes[i]);
}

TEST(test_block_mesh) {
  write_case("text", "ascii", "off");
  write_case("binary", "binary", "off");
  write_case("packed", "ascii", "on");
  run("(cd text && %s) && (cd binary && %s) && (cd packed && %s)", RIIS_BLOCKMESH, RIIS_BLOCKMESH, RIIS_BLOCKMESH);
  assert_true(scratch_exists("packed/constant/polyMesh/points.gz"));
  rewrite("text", "text.vtu");
  rewrite("binary", "binary.vtu");
  rewrite("packed", "packed.vtu");
  assert_true(scratch_is_same("text.vtu", "binary.vtu") && scratch_is_same("text.vtu", "packed.vtu"));
  /* foamToVTK rounds to single precision. */
  run("cd text && foamToVTK -constant -no-boundary && cp VTK/*/internal.vtu ../other.vtu");
  expect_same("text.vtu", "other.vtu", SHIM_FLOATS, 200);
  int64_t n_of_type[100];
  assert_true(shim_bend(scratch_path("text.vtu"), n_of_type) == 0 && n_of_type[12] == 5 * 6 * 7);
  /* A decomposed case has the same nodes and cells in the same order. */
  run("cp -r text parts && cd parts && decomposePar && rm -r constant");
  rewrite("parts", "parts.vtu");
  expect_same("text.vtu", "parts.vtu", SHIM_SETS, 200);
  expect_same_order("text", "parts");
  rewrite("parts/processor1", "part.vtu");
  /* Moved points come from the latest folder of points that is not later than the requested time. */
  run("mkdir -p text/0.5/polyMesh text/2 && sed 's/^(\\(.*\\) \\(.*\\) \\(.*\\))$/(\\1 \\2 9)/' "
      "text/constant/polyMesh/points > text/0.5/polyMesh/points");
  rewrite("text/0.5", "moved.vtu");
  rewrite("text/2", "later.vtu");
  assert_true(scratch_is_same("moved.vtu", "later.vtu") && !scratch_is_same("moved.vtu", "text.vtu"));
  riis_vtk_mesh *mesh = NULL;
  const double *xyz = NULL;
  int64_t n = 0;
  expect_fine(riis_vtk_mesh_read(scratch_path("text/0.5"), &mesh));
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, NULL, &xyz));
  for (int64_t i = 0; i < n; ++i) assert_true(xyz[3 * i + 2] == 9);
  riis_vtk_mesh_destroy(&mesh);
}

/* A refusal suggests commands, and these commands give the same mesh. The refused cases are parts without their places in the
 * whole mesh, collated parts, and a mesh of Fluent. */
TEST(test_advised_commands) {
  write_case("whole", "ascii", "off");
  run("cd whole && %s", RIIS_BLOCKMESH);
  rewrite("whole", "whole.vtu");
  run("cp -r whole lone && cd lone && decomposePar && rm -r constant processor*/constant/polyMesh/*ProcAddressing");
  run("cp -r whole packs && cd packs && decomposePar -fileHandler collated && rm -r constant");
  const char *const parts[] = {"lone", "packs"};
  for (int i = 0; i < 2; ++i) {
    riis_vtk_mesh *mesh = NULL;
    expect_refused(riis_vtk_mesh_read(scratch_path(parts[i]), &mesh), RIIS_FILE_ERROR,
                   "reconstructParMesh -constant joins ");
    run("cd %s && reconstructParMesh -constant", parts[i]);
    rewrite(parts[i], "joined.vtu");
    expect_same("whole.vtu", "joined.vtu", SHIM_SETS, 200);
  }
  run("cp -r whole fluent && cd fluent && foamMeshToFluent && cp fluentInterface/fluent.msh heart.cas && rm -r "
      "constant && "
      "fluentMeshToFoam heart.cas");
  /* Fluent's file has ten digits, and another order. */
  int64_t n_nodes[2], n_cells[2];
  double sum[2] = {0, 0};
  for (int i = 0; i < 2; ++i) {
    riis_vtk_mesh *mesh = NULL;
    const double *xyz = NULL;
    expect_fine(riis_vtk_mesh_read(scratch_path(i ? "fluent" : "whole"), &mesh));
    expect_fine(riis_vtk_mesh_get_nodes(mesh, &n_nodes[i], &n_cells[i], &xyz));
    for (int64_t k = 0; k < 3 * n_nodes[i]; ++k) sum[i] += xyz[k] * xyz[k];
    riis_vtk_mesh_destroy(&mesh);
  }
  assert_true(n_nodes[0] == n_nodes[1] && n_cells[0] == n_cells[1] && n_nodes[0] > 300);
  assert_true(fabs(sum[0] - sum[1]) < 1e-6 * sum[0]);
}

/* Returns the n internal values of a field. */
static double *field(const char *name, int64_t n) {
  char *text = scratch_read(scratch_path(name), NULL);
  const char *at = strstr(text, "nonuniform List<");
  if (!at) fail_msg("%s has no list", name);
  at = strchr(strchr(at, '\n'), '(') + 1;
  double *values = malloc((size_t)n * sizeof *values);
  for (int64_t i = 0; i < n; ++i) {
    char *end = NULL;
    while (*at == '(' || *at == ')' || *at == '\n') ++at;
    values[i] = strtod(at, &end);
    if (end == at) fail_msg("%s ends after %lld numbers", name, (long long)i);
    at = end;
  }
  free(text);
  return values;
}

/* The centres equal those that OpenFOAM writes. OpenFOAM reads the fields that riis writes. */
static void test_centers(const char *name) {
  char path[128];
  riis_vtk_mesh *mesh = NULL;
  const double *xyz = NULL;
  int64_t n = 0;
  run("cd %s && sed -i s/binary/ascii/ system/controlDict && rm -rf 0 0.5 2 && mkdir 0 && postProcess -constant -func "
      "writeCellCentres && mv constant/C 0/C",
      name);
  expect_fine(riis_vtk_mesh_read(scratch_path(name), &mesh));
  expect_fine(riis_vtk_mesh_use_centers(mesh));
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, NULL, &xyz));
  snprintf(path, sizeof path, "%s/0/C", name);
  double *centers = field(path, 3 * n);
  for (int64_t i = 0; i < 3 * n; ++i)
    if (!(fabs(xyz[i] - centers[i]) <= 1e-13)) fail_msg("%s: %.17g is %.17g", name, centers[i], xyz[i]);
  double *K = malloc((size_t)n * 3 * sizeof *K);
  for (int64_t i = 0; i < 3 * n; ++i) K[i] = sqrt((double)i) / 3;
  snprintf(path, sizeof path, "%s/1", name);
  expect_refused(riis_vtk_mesh_write(mesh, scratch_path("tet/1")), RIIS_FILE_ERROR,
                 "tet/1: is a time folder of a case, but the mesh");
  expect_fine(riis_vtk_mesh_set_point_array(mesh, "riis_K", n, 1, K));
  expect_fine(riis_vtk_mesh_set_point_array(mesh, "riis_K_u_surface", n, 3, K));
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path(path)));
  /* OpenFOAM reads both fields. */
  run("cd %s && postProcess -time 1 -func 'mag(Ku)' && postProcess -time 1 -func 'grad(K)'", name);
  snprintf(path, sizeof path, "%s/1/mag(Ku)", name);
  double *magnitude = field(path, n);
  snprintf(path, sizeof path, "%s/1/K", name);
  double *again = field(path, n);
  for (int64_t i = 0; i < n; ++i) {
    assert_true(again[i] == K[i]);
    assert_true(fabs(magnitude[i] -
                     sqrt(K[3 * i] * K[3 * i] + K[3 * i + 1] * K[3 * i + 1] + K[3 * i + 2] * K[3 * i + 2])) < 1e-12);
  }
  snprintf(path, sizeof path, "%s/1/grad(K)", name);
  assert_true(scratch_exists(path));
  free(centers);
  free(K);
  free(magnitude);
  free(again);
  riis_vtk_mesh_destroy(&mesh);
  expect_fine(riis_vtk_mesh_read(scratch_path(name), &mesh));
  snprintf(path, sizeof path, "%s/1", name);
  expect_refused(riis_vtk_mesh_write(mesh, scratch_path(path)), RIIS_FILE_ERROR,
                 "holds only fields of cells, but the nodes of the mesh are not centres of cells");
  riis_vtk_mesh_destroy(&mesh);
}

TEST(test_block_centers) { test_centers("text"); }

#ifdef RIIS_GMSH
/* The cases of OpenFOAM have gmsh's tetrahedra, these tetrahedra with a layer of prisms and hexahedra, and the dual polyhedra. */
TEST(test_other_cells) {
  scratch_write_text("mix.geo",
                     "SetFactory(\"OpenCASCADE\");\nBox(1) = {-1, -1.1, -1.2, 2, 2.2, 2.4};\nMesh.MeshSizeMax = 0.9;\n"
                     "Extrude {0, 0, 1} { Surface{6}; Layers{2}; Recombine; }\nPhysical Volume(1) = {1, 2};\n");
  write_case("mix", "binary", "off");
  run("%s -v 1 -nt 1 -3 mix.geo -format msh22 -o mix.msh && cd mix && gmshToFoam ../mix.msh", RIIS_GMSH);
  rewrite("mix", "mix.vtu");
  rewrite("mix.msh", "mix_gmsh.vtu");
  expect_same("mix.vtu", "mix_gmsh.vtu", SHIM_SETS, 50);
  int64_t n_of_type[100];
  assert_true(shim_bend(scratch_path("mix.vtu"), n_of_type) == 0 && n_of_type[10] > 20 && n_of_type[13] > 10);
  test_centers("mix");
  write_case("dual", "ascii", "off");
  run("cp -r mix/constant dual && rm dual/constant/C* && cd dual && polyDualMesh 60 -overwrite && "
      "foamToVTK -constant -no-boundary && "
      "cp VTK/*/internal.vtu ../other.vtu");
  rewrite("dual", "dual.vtu");
  assert_true(shim_bend(scratch_path("dual.vtu"), n_of_type) == 0 && n_of_type[42] > 20);
  expect_same("dual.vtu", "other.vtu", SHIM_FLOATS, 20);
  test_centers("dual");
}
#endif
#endif

int main(void) {
  /* Debian's package needs this folder, but its programs do not know it. */
  setenv("WM_PROJECT_DIR", "/usr/share/openfoam", 0);
#ifndef RIIS_BLOCKMESH
  printf("without OpenFOAM: only text that the test wrote\n");
#endif
  return run_cases(scratch_setup, scratch_teardown);
}
