/* SPDX-License-Identifier: Apache-2.0
 *
 * If a mesh file has an unsupported format, the refusal gives a command that converts the file, with the user's file names. If
 * the command's program is installed, the test runs the command and reads the converted file. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

TEST(test_texts) {
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(1, "; gmsh converts it: gmsh -save heart.UNV -format vtk -o heart.vtk\n", "mark", "heart.UNV");
  RUN_REFUSED(1, "; meshio converts it: meshio convert heart.inp heart.vtu\n", "mark", "heart.inp");
  RUN_REFUSED(1, "; meshio converts it: meshio convert heart.med heart.xdmf\n", "mark", "heart.med");
  const char *by_meshio[] = {"mesh", "meshb", "avs",  "dat", "f3grid", "h5m",
                             "mdpa", "vol",   "node", "ele", "xml",    "post"};
  for (int i = 0; i < 12; ++i) {
    char name[32], wanted[96];
    snprintf(name, sizeof name, "heart.%s", by_meshio[i]);
    snprintf(wanted, sizeof wanted, "; meshio converts it: meshio convert %s heart.vtu\n", name);
    RUN_REFUSED(1, wanted, "mark", name);
  }
  RUN_REFUSED(1, "; a .pvd is a list of files: give one of its meshes\n", "mark", "heart.pvd");
  scratch_write_text(
      "list.pvd",
      "<VTKFile type=\"Collection\"><Collection>\n<DataSet timestep=\"0\" part=\"0\" file=\"a b000000.pvtu\"/>\n"
      "<DataSet timestep=\"1\" file=\"a b000001.pvtu\"/></Collection></VTKFile>");
  char first[512];
  snprintf(first, sizeof first, ": give one of its meshes, such as '%s'\n", scratch_path("a b000000.pvtu"));
  RUN_REFUSED(1, first, "mark", scratch_path("list.pvd"));
  RUN_REFUSED(1, "; in dolfinx, write with io.XDMFFile or io.VTKFile in place of io.VTXWriter\n", "mark", "heart.bp");
  const char *endings[] = {"cgns", "case", "encas", "vtkhdf", "pvti", "pvts", "tec", "vtmb", "vtpc", "vtpd"};
  for (int i = 0; i < 10; ++i) {
    char name[32];
    snprintf(name, sizeof name, "heart.%s", endings[i]);
    RUN_REFUSED(1,
                "; ParaView converts it: the filters Merge Blocks and Append Datasets, then File > Save Data..., "
                "heart.vtu\n",
                "mark", name);
  }
  RUN_REFUSED(1, "; OpenFOAM converts it: fluentMeshToFoam heart.cas\n", "mark", "heart.cas");
  RUN_REFUSED(1, "; give the .xdmf file that names it\n", "mark", "heart.h5");
  RUN_REFUSED(1, "; gmsh meshes it: gmsh -3 heart.step -format vtk -o heart.vtk\n", "mark", "heart.step");
  RUN_REFUSED(1, "; gmsh meshes it: gmsh -2 v.IGES -format stl -o v.stl\n", "mark", mesh, "--surface", "v.IGES");
  RUN_REFUSED(1, "; FEBio Studio converts it: File > Export FE Model..., heart.vtk\n", "mark", "heart.feb");
  RUN_REFUSED(1, "open CASE.nek5000 in ParaView, then File > Save Data..., heart.vtu\n", "mark", "heart.re2");
  scratch_write_text("heart.msh", "<?xml version=\"1.0\"?>\n<mesh type=\"TetGen\"/>\n");
  RUN_REFUSED(1, "it is SimVascular's description of a mesh: give the mesh, which is beside it, ", "mark",
              scratch_path("heart.msh"));
  scratch_write_text("grid.vtk",
                     "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\nORIGIN 0 0 0\n"
                     "SPACING 1 1 1\n");
  RUN_REFUSED(1, "grid.vtk: holds structured_points, not unstructured_grid\n", "surface", "--surface",
              scratch_path("grid.vtk"), "--output", scratch_path("no.vtp"));
  /* A pointer of Git LFS has the name of the file that it stands for. */
  const char *const pointers[] = {"p.vtu", "p.vtk", "p.msh", "p.vtm", "p.xdmf", "p.exo"};
  const char *const surfaces[] = {"p.stl", "p.vtp", "p.obj", "p.ply", "p.vtu", "p.vtk"};
  for (int i = 0; i < 12; ++i) {
    const char *const name = i < 6 ? pointers[i] : surfaces[i - 6];
    scratch_write_text(name,
                       "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a214614ab2935c943f9e0ff69d22e\nsize "
                       "132735\n");
    char path[256];
    snprintf(path, sizeof path, "%s", scratch_path(name));
    RUN_REFUSED(1, ": is a pointer of Git LFS, not the file itself: git lfs pull fetches the file\n",
                i < 6 ? "mark" : "surface", i < 6 ? path : "--surface", i < 6 ? "--allow-none" : path,
                i < 6 ? NULL : "--output", scratch_path("no.vtp"));
  }
  scratch_write_text("p.json", "version https://git-lfs.github.com/spec/v1\n");
  RUN_REFUSED(1, "p.json: is a pointer of Git LFS", "place", scratch_path("p.json"), "--valve", "mitral");
  scratch_write_text("fluent.msh", "(0 \"Fluent\")\n");
  RUN_REFUSED(1, "does not begin with $MeshFormat; meshio converts it: meshio convert ", "mark",
              scratch_path("fluent.msh"));
  scratch_write_text("cut.msh", "$MeshFormat\n4.1 0 8\n");
  RUN_REFUSED(1, "cut.msh: is truncated: it ends before $EndMeshFormat\n", "mark", scratch_path("cut.msh"));
  RUN_REFUSED(1, "gmsh -save 'my heart.unv' -format vtk -o 'my heart.vtk'\n", "mark", "my heart.unv");
  RUN_REFUSED(1, "gmsh -save 'it'\\''s.unv' -format vtk -o 'it'\\''s.vtk'\n", "mark", "it's.unv");
  RUN_REFUSED(1, "gmsh -save ./-x.unv -format vtk -o ./-x.vtk\n", "mark", "--", "-x.unv");
  RUN_REFUSED(1,
              "valve.stl: a mesh must be a .vtu, .vtk, .vti, .vtr, .vts, .vtm, .msh, .xdmf or .exo file, or a case of "
              "OpenFOAM; "
              "--surface takes a surface\n",
              "mark", "valve.stl");
  RUN_REFUSED(1,
              "a mesh must be a .vtu, .vtk, .vti, .vtr, .vts, .vtm, .msh, .xdmf or .exo file, or a case of OpenFOAM\n",
              "mark", "heart.doc");
  RUN_REFUSED(1,
              "a mesh must be a .vtu, .vtk, .vti, .vtr, .vts, .vtm, .msh, .xdmf or .exo file, or a case of OpenFOAM\n",
              "mark", "he\nart.unv");
  RUN_REFUSED(1,
              "valve.unv: a surface must be a .vtp, .vtu, .vtk, .stl, .obj or .ply file; gmsh converts it: gmsh -save "
              "valve.unv -format stl -o valve.stl\n",
              "mark", mesh, "--surface", "valve.unv");
  RUN_REFUSED(1, "; meshio converts it: meshio convert valve.off valve.stl\n", "mark", mesh, "--surface", "valve.off");
  RUN_REFUSED(1, "; meshio converts it: meshio convert valve.xdmf valve.vtu\n", "mark", mesh, "--surface",
              "valve.xdmf");
  RUN_REFUSED(1, "; ParaView converts it: ", "mark", mesh, "--surface", "valve.vtkhdf");
  RUN_REFUSED(1, "valve.obj: cannot be read: No such file or directory\n", "mark", mesh, "--surface", "valve.obj");
  scratch_write_text("leaflet.vtk",
                     "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
                     "POLYGONS 1 4\n3 0 1 2\n");
  RUN_REFUSED(1, "leaflet.vtk: holds polydata, not unstructured_grid; --surface takes a surface\n", "mark",
              scratch_path("leaflet.vtk"));
  RUN_REFUSED(1, "a surface must be a .vtp, .vtu, .vtk, .stl, .obj or .ply file\n", "mark", mesh, "--surface",
              "valve.doc");
}

#if defined(RIIS_GMSH) || defined(RIIS_MESHIO)
/* Runs the command that the last refusal suggests, with the full path of its program. Returns the file that the command
 * writes. */
static const char *meshed_by(const char *tool, const char *path, const char *verb) {
  static char command[2048], made[256];
  char marker[64];
  snprintf(marker, sizeof marker, "%s%s ", verb, tool);
  const char *arguments = strstr(program_err, marker);
  if (!arguments) fail_msg("no command in %s", program_err);
  arguments += strlen(marker);
  snprintf(command, sizeof command, "%s %.*s > %s 2>&1", path, (int)strcspn(arguments, "\n"), arguments,
           scratch_path("log.txt"));
  if (system(command) != 0) fail_msg("%s\n%s", command, scratch_read(scratch_path("log.txt"), NULL));
  snprintf(made, sizeof made, "%.*s", (int)strcspn(arguments, "\n"), arguments);
  return strrchr(made, ' ') + 1;
}

static const char *convert(const char *tool, const char *path) { return meshed_by(tool, path, " converts it: "); }
#endif

#ifdef RIIS_GMSH
/* Lets gmsh make a cube of tetrahedra, or the cube's surface, in one of gmsh's formats. */
static void make_by_gmsh(int dimension, const char *format, const char *path) {
  char command[1024];
  scratch_write_text(
      "cube.geo",
      "SetFactory(\"OpenCASCADE\");\nBox(1) = {-2, -2, -2, 4, 4, 4};\nMesh.MeshSizeMax = 1;\nMesh.MeshSizeMin = 1;\n");
  snprintf(command, sizeof command, RIIS_GMSH " -v 1 -nt 1 -%d %s -format %s -o %s > /dev/null 2>&1", dimension,
           scratch_path("cube.geo"), format, path);
  if (system(command) != 0) fail_msg("%s", command);
}

TEST(test_meshes_by_gmsh) {
  const char *formats[] = {"msh40", "unv", "bdf", "msh1", "bdf"}, *endings[] = {"msh", "unv", "bdf", "msh", "nas"};
  for (int i = 0; i < 5; ++i) {
    char name[32], path[256];
    snprintf(name, sizeof name, "cube_%d.%s", i, endings[i]);
    snprintf(path, sizeof path, "%s", scratch_path(name));
    make_by_gmsh(3, formats[i], path);
    RUN_REFUSED(1, "gmsh converts it", "mark", path);
    run_program("mark", convert("gmsh", RIIS_GMSH), "--half-thickness", "0.6", "--stats", "-", NULL);
    assert_int_equal(program_exit_code, 0);
    assert_true(json_number(program_out, "n_nodes") > 100 && json_number(program_out, "n_marked") > 5);
  }
}

/* Elements of order 3 are refused with a command for the shell. */
TEST(test_orders_by_gmsh) {
  static char command[2048];
  char path[256];
  snprintf(path, sizeof path, "%s", scratch_path("cubic.msh"));
  make_by_gmsh(3, "msh41 -order 3", path);
  RUN_REFUSED(1, "elements of orders 1 and 2 are read; gmsh lowers the order: echo ", "mark", path);
  const char *const line = strstr(program_err, "echo ");
  snprintf(command, sizeof command, "PATH=$(dirname " RIIS_GMSH "):$PATH && %.*s > %s 2>&1", (int)strcspn(line, "\n"),
           line, scratch_path("log.txt"));
  assert_int_equal(system(command), 0);
  assert_int_equal(remove("order2.geo"), 0);
  run_program("mark", scratch_path("cubic_order2.msh"), "--half-thickness", "0.6", "--stats", "-", NULL);
  assert_int_equal(program_exit_code, 0);
  assert_true(json_number(program_out, "n_nodes") > 100 && json_number(program_out, "n_marked") > 5);
}

/* gmsh writes a cube as CAD. The advised commands mesh its volume and its surface. */
TEST(test_cad_by_gmsh) {
  char path[256];
  snprintf(path, sizeof path, "%s", scratch_path("cube.brep"));
  make_by_gmsh(0, "brep", path);
  RUN_REFUSED(1, "gmsh meshes it", "mark", path);
  run_program("mark", meshed_by("gmsh", RIIS_GMSH, " meshes it: "), "--half-thickness", "0.6", "--stats", "-", NULL);
  assert_int_equal(program_exit_code, 0);
  assert_true(json_number(program_out, "n_nodes") > 8);
  RUN_REFUSED(1, "gmsh meshes it", "surface", "--surface", path, "--output", scratch_path("skin.vtp"));
  run_program("mark", scratch_path("in.vtu"), "--surface", meshed_by("gmsh", RIIS_GMSH, " meshes it: "),
              "--half-thickness", "0.4", "--stats", "-", "--allow-none", NULL);
  const double area = json_number(program_out, "area");
  assert_true(area > 95.99 && area < 96.01);
}

TEST(test_surfaces_by_gmsh) {
  const char *formats[] = {"msh", "unv", "bdf", "mesh", "bdf", "ply2", "vtk"};
  const char *endings[] = {"msh", "unv", "bdf", "mesh", "nas", "ply2", "vtk"};
  for (int i = 0; i < 7; ++i) {
    char name[32], path[256];
    snprintf(name, sizeof name, "skin_%d.%s", i, endings[i]);
    snprintf(path, sizeof path, "%s", scratch_path(name));
    make_by_gmsh(2, formats[i], path);
    RUN_REFUSED(1, "gmsh converts it", "surface", "--surface", path, "--output", scratch_path("skin.vtp"));
    run_program("mark", scratch_path("in.vtu"), "--surface", convert("gmsh", RIIS_GMSH), "--half-thickness", "0.4",
                "--stats", "-", "--allow-none", NULL);
    assert_int_equal(program_exit_code, 0);
    assert_non_null(strstr(program_err, "1 piece is closed"));
    const double area = json_number(program_out, "area");
    assert_true(area > 95.99 && area < 96.01);
  }
}
#endif

#ifdef RIIS_MESHIO
TEST(test_meshio) {
  scratch_write_text("tet.inp",
                     "*HEADING\ntet\n*NODE\n1, -1, -1, -1\n2, 1, -1, -1\n3, 0, 1, -1\n4, 0, 0, 1\n*ELEMENT, "
                     "TYPE=C3D4\n1, 1, 2, 3, 4\n");
  scratch_write_text(
      "tet.su2", "NDIME= 3\nNELEM= 1\n10 0 1 2 3 0\nNPOIN= 4\n-1 -1 -1 0\n1 -1 -1 1\n0 1 -1 2\n0 0 1 3\nNMARK= 0\n");
  scratch_write_text("skin.off", "OFF\n3 1 0\n-1 -1 -1\n1 -1 -1\n0 1 -1\n3 0 1 2\n");
  /* meshio writes the format of Ansys, and also MED if it has h5py. */
  const char *meshes[] = {"tet.inp", "tet.su2", "tet.msh", "tet.med", "tet.mesh", "tet.avs", "tet.dat", "tet.vol"};
  const char *to[] = {"--output-format ansys", "", "", "", "", ""};
  for (int i = 0; i < 8; ++i) {
    char path[256], command[1024];
    snprintf(path, sizeof path, "%s", scratch_path(meshes[i]));
    snprintf(command, sizeof command, RIIS_MESHIO " convert %s %s %s > /dev/null 2>&1", to[i < 2 ? 0 : i - 2],
             scratch_path("tet.su2"), path);
    if (i >= 2 && system(command) != 0) continue;
    RUN_REFUSED(1, "meshio converts it", "mark", path);
    run_program("mark", convert("meshio", RIIS_MESHIO), "--half-thickness", "0.6", "--stats", "-", NULL);
    assert_int_equal(program_exit_code, 0);
    assert_true(json_number(program_out, "n_nodes") == 4 && json_number(program_out, "n_cells") == 1);
  }
  RUN_REFUSED(1, "meshio converts it", "surface", "--surface", scratch_path("skin.off"), "--output",
              scratch_path("skin.vtp"));
  RUN_FINE("surface", "--surface", convert("meshio", RIIS_MESHIO), "--output", scratch_path("skin.vtp"));
  assert_non_null(strstr(program_out, "1 triangle, area 2\n"));
  scratch_write_text(
      "faces.inp",
      "*HEADING\nquad\n*NODE\n1, 0, 0, 0\n2, 2, 0, 0\n3, 2, 1, 0\n4, 0, 1, 0\n*ELEMENT, TYPE=S4\n1, 1, 2, "
      "3, 4\n");
  RUN_REFUSED(1, "meshio converts it", "surface", "--surface", scratch_path("faces.inp"), "--output",
              scratch_path("faces.vtp"));
  RUN_FINE("surface", "--surface", convert("meshio", RIIS_MESHIO), "--output", scratch_path("faces.vtp"));
  assert_non_null(strstr(program_out, "area 2\n"));
}
#endif

int main(void) { return run_cases(make_box, scratch_teardown); }
