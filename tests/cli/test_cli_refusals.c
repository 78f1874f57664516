/* SPDX-License-Identifier: Apache-2.0
 *
 * Every refusal has its exit code and one line on stderr that names the fault. A refusal leaves no output behind. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

TEST(test_usage) {
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "nothing to do: a MESH is needed", "mark", "--quiet");
  RUN_REFUSED(2, "nothing to do: --quiet", "mark", mesh, "--quiet");
  RUN_REFUSED(2, "nothing to do: a MESH is needed", "mark", "--output", "a.vtu");
  RUN_REFUSED(2, "nothing to do: --output or --picture is needed", "surface", "--valve", "mitral");
  const char *const of_meshes[] = {"--threads=2",         "--search=auto", "--distance-limit=2", "--far-distance=-1",
                                   "--distance=sampling", "--stats=-",     "--allow-none"};
  for (size_t i = 0; i < sizeof of_meshes / sizeof of_meshes[0]; ++i)
    RUN_REFUSED(2, " is not an option", "surface", "--output", "a.vtp", of_meshes[i]);
  RUN_REFUSED(2, "in.vtu is one argument too many (riis params --help lists the options)", "params", mesh);
  const char *const not_of_params[] = {"--output=a.vtu", "--scale=2", "--unit=m", "--surface=a.vtp",
                                       "--params-open=a.json"};
  for (size_t i = 0; i < sizeof not_of_params / sizeof not_of_params[0]; ++i)
    RUN_REFUSED(2, " is not an option", "params", not_of_params[i]);
  RUN_REFUSED(2, "--frobnicate is not an option (riis mark --help lists the options)", "mark", mesh, "--frobnicate");
  RUN_REFUSED(2, "second.vtu is one argument too many", "mark", mesh, "second.vtu");
  RUN_REFUSED(2, "--valve", "mark", mesh, "--valve", "aortic", "--surface", "a.vtp");
  RUN_REFUSED(2, "--set", "mark", mesh, "--surface", "a.vtp", "--set", "root_radius=1");
  RUN_REFUSED(2, "--params", "mark", mesh, "--surface", "a.vtp", "--params", "a.json");
  RUN_REFUSED(2, "--tolerance", "mark", mesh, "--surface", "a.vtp", "--tolerance", "0.1");
  RUN_REFUSED(2, "--skip-zero-area", "mark", mesh, "--skip-zero-area");
  RUN_REFUSED(2, "--search", "mark", mesh, "--search", "clever");
  RUN_REFUSED(2, "--distance", "mark", mesh, "--distance", "far");
  RUN_REFUSED(2, "--distance", "mark", mesh, "--surface", "a.vtp", "--distance", "sampling");
  RUN_REFUSED(2, "--distance-tolerance has no effect with --distance triangles", "mark", mesh, "--distance-tolerance",
              "0.1");
  RUN_REFUSED(2, "--distance-tolerance has no effect with --distance triangles", "mark", mesh, "--distance",
              "triangles", "--distance-tolerance", "0.1");
  RUN_REFUSED(2, "--distance-tolerance is 2; it must be from 1e-06 to 1", "mark", mesh, "--distance", "sampling",
              "--distance-tolerance", "2");
  RUN_REFUSED(2, "--distance-tolerance: -1 is not above 0", "mark", mesh, "--distance", "sampling",
              "--distance-tolerance", "-1");
  RUN_REFUSED(2, "--search is 4, clusters", "mark", mesh, "--distance", "sampling", "--search", "clusters");
  RUN_REFUSED(1, "more than 16777216 samples", "mark", mesh, "--distance", "sampling", "--distance-tolerance", "1e-4");
  RUN_REFUSED(2, "--view", "mark", mesh, "--picture", "a.png", "--view", "below");
  RUN_REFUSED(2, "--view valve-top: patient.stl has triangles, but no axes of a valve; top looks by the mesh's axes",
              "surface", "--surface", "patient.stl", "--picture", "a.png", "--view", "valve-top");
  RUN_REFUSED(2, "--view: there are more views than pictures", "mark", mesh, "--picture", "a.png", "--view", "top",
              "--view", "side");
  RUN_REFUSED(2, "--output", "mark", mesh, "--output", "a.vtu", "--output", "b.vtu");
  RUN_REFUSED(2, "--output", "mark", mesh, "--output");
}

TEST(test_numbers) {
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "--rotate: '0,0,1' has 3 numbers; it takes X,Y,Z,DEG", "mark", mesh, "--rotate", "0,0,1");
  RUN_REFUSED(2, "--rotate: 'z' is not a number", "mark", mesh, "--rotate", "0,0,z,90");
  RUN_REFUSED(2, "--translate: '1,2,3,4' has 4 numbers; it takes X,Y,Z", "mark", mesh, "--translate", "1,2,3,4");
  RUN_REFUSED(2, "--scale: 'big' is not a number", "mark", mesh, "--scale", "big");
  RUN_REFUSED(2, "--scale: '1,5' is not a number", "mark", mesh, "--scale", "1,5");
  RUN_REFUSED(2, "--scale: '1e999' is not a number that fits", "mark", mesh, "--scale", "1e999");
  RUN_REFUSED(2, "--threads: 'two' is not a whole number", "mark", mesh, "--threads", "two");
  RUN_REFUSED(2, "--threads: '2.5' is not a whole number", "mark", mesh, "--threads", "2.5");
  RUN_REFUSED(2, "--threads: '99999999999' is not a whole number", "mark", mesh, "--threads", "99999999999");
  /* A user must not be able to pass RIIS_AUTO, whose value is -1. */
  RUN_REFUSED(2, "--half-thickness: -1 is not above 0", "mark", mesh, "--half-thickness", "-1");
  RUN_REFUSED(2, "--half-thickness: nan is not above 0", "mark", mesh, "--half-thickness", "nan");
  RUN_REFUSED(2, "--distance-limit: -1 is not above 0", "mark", mesh, "--distance-limit", "-1");
}

/* Some values have the right form, but the library refuses them. */
TEST(test_values) {
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "riis: --scale is 0; ", "mark", mesh, "--scale", "0");
  RUN_REFUSED(2, "riis: --scale is -1; ", "mark", mesh, "--scale", "-1");
  RUN_REFUSED(2, "riis: --rotate: the axis is (0, 0, 0); ", "mark", mesh, "--rotate", "0,0,0,90");
  RUN_REFUSED(2, "riis: --rotate: the angle is 1e+07; ", "mark", mesh, "--rotate", "0,0,1,1e7");
  RUN_REFUSED(2, "riis: --translate ", "mark", mesh, "--translate", "1e60,0,0");
  RUN_REFUSED(2, "riis: --translate moves the valve ", "mark", mesh, "--translate", "1e30,0,0");
  RUN_REFUSED(2, "riis: --tolerance is 0; ", "mark", mesh, "--tolerance", "0");
  RUN_REFUSED(2, "riis: --tolerance is -1; ", "mark", mesh, "--tolerance", "-1");
  RUN_REFUSED(2, "riis: --half-thickness is inf; ", "mark", mesh, "--half-thickness", "inf");
  /* Some wrong values of options are refused before the program reads the mesh. The mesh is missing here, but the message names
   * only the value. */
  mesh = scratch_path("missing.vtu");
  RUN_REFUSED(2, "riis: --distance-limit is 0.05; ", "mark", mesh, "--distance-limit", "0.05");
  RUN_REFUSED(2, "riis: --threads is -2; ", "mark", mesh, "--threads", "-2");
  RUN_REFUSED(2, "riis: --threads is 1025; ", "mark", mesh, "--threads", "1025");
  RUN_REFUSED(2, "riis: --far-distance is 0.05; ", "mark", mesh, "--far-distance", "0.05", "--output",
              scratch_path("a.vtu"));
  mesh = scratch_path("in.vtu");
  RUN_REFUSED(1, "mitre", "mark", mesh, "--valve", "mitre");
  assert_int_equal(scratch_exists("a.vtu"), 0);
}

TEST(test_input_files) {
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(1, "missing.vtu: cannot be read: No such file", "mark", scratch_path("missing.vtu"));
  RUN_REFUSED(1, "a mesh must be a .vtu, .vtk, .vti, .vtr, .vts, .vtm, .msh, .xdmf or .exo file, or a case of OpenFOAM",
              "mark", "mesh.doc");
  RUN_REFUSED(1, "missing.vtp: cannot be read: No such file", "mark", mesh, "--surface", scratch_path("missing.vtp"));
  scratch_write_text("garbage.vtu", "garbage");
  RUN_REFUSED(1, "garbage.vtu: is not a VTK XML file", "mark", scratch_path("garbage.vtu"));
  size_t size = 0;
  char *bytes = scratch_read(mesh, &size);
  scratch_write("cut.vtu", bytes, size / 2);
  free(bytes);
  RUN_REFUSED(1, "cut.vtu: is truncated", "mark", scratch_path("cut.vtu"), "--output", scratch_path("a.vtu"));
  assert_int_equal(scratch_exists("a.vtu"), 0);
}

/* Some faults of the data are found only by the library. The refusal then also names the file. */
TEST(test_bad_data) {
  scratch_write_text(
      "nan.vtu",
      "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"4\" NumberOfCells=\"0\"><Points>\n"
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 nan 0 0 0 "
      "1</DataArray></Points>\n"
      "<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\"></DataArray>"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\"></DataArray>"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\"></DataArray></Cells>\n"
      "</Piece></UnstructuredGrid></VTKFile>\n");
  RUN_REFUSED(1, "nan.vtu: ", "mark", scratch_path("nan.vtu"));
  assert_non_null(strstr(program_err, "node 2"));
  scratch_write_text("nan.stl",
                     "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 2 0 "
                     "0\nendloop\nendfacet\nendsolid\n");
  RUN_REFUSED(1, "nan.stl: ", "mark", scratch_path("in.vtu"), "--surface", scratch_path("nan.stl"));
}

TEST(test_outputs) {
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "--output: ", "mark", mesh, "--output", scratch_path("a.vtk"));
  RUN_REFUSED(2, "--surface-output: ", "mark", mesh, "--surface-output", scratch_path("a.stl"));
  RUN_REFUSED(2, "--picture: ", "mark", mesh, "--picture", scratch_path("a.jpg"));
  RUN_REFUSED(1, "a.vtu: cannot be written: the folder", "mark", mesh, "--output", scratch_path("no_folder/a.vtu"));
  RUN_REFUSED(1, "a.vtp: cannot be written: the folder", "mark", mesh, "--surface-output",
              scratch_path("no_folder/a.vtp"));
  RUN_REFUSED(1, "a.png: cannot be written: the folder", "mark", mesh, "--picture", scratch_path("no_folder/a.png"));
  RUN_REFUSED(1, "a.json: cannot be written: the folder", "mark", mesh, "--stats", scratch_path("no_folder/a.json"));
  assert_int_equal(mkdir(scratch_path("folder.vtu"), 0700), 0);
  RUN_REFUSED(1, "folder.vtu: is a directory", "mark", mesh, "--stats", scratch_path("folder.vtu"));
  RUN_REFUSED(1, "folder.vtu: is a directory", "mark", mesh, "--output", scratch_path("folder.vtu"));
  RUN_REFUSED(1, "/dev/full: cannot be written: No space left", "mark", mesh, "--stats", "/dev/full", "--quiet");
}

/* An impossible output is refused before the program reads the mesh. The mesh is missing here, but the message names only the
 * output. */
TEST(test_outputs_first) {
  RUN_REFUSED(1, "a.vtu: cannot be written", "mark", scratch_path("missing.vtu"), "--output",
              scratch_path("no_folder/a.vtu"));
}

TEST(test_empty_values) {
  const char *options[] = {"--surface",
                           "--valve",
                           "--params",
                           "--set",
                           "--tolerance",
                           "--scale",
                           "--rotate",
                           "--translate",
                           "--threads",
                           "--half-thickness",
                           "--distance-limit",
                           "--far-distance",
                           "--output",
                           "--picture",
                           "--stats",
                           "--surface-output",
                           "--opening",
                           "--params-open",
                           "--distance-tolerance"};
  for (size_t i = 0; i < sizeof options / sizeof options[0]; ++i) {
    char text[64];
    snprintf(text, sizeof text, "%s: the value is empty", options[i]);
    RUN_REFUSED(2, text, "mark", scratch_path("in.vtu"), options[i], "");
  }
  RUN_REFUSED(2, "MESH: the value is empty", "mark", "");
  RUN_REFUSED(2, "--output: the value is empty", "mark", "--output=", scratch_path("in.vtu"), "--quiet");
}

/* A refusal suggests the option that the user probably meant. Of several wrong arguments, the first is refused. */
TEST(test_unknown_options) {
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "--half-thicknes is not an option, did you mean --half-thickness?", "mark", mesh, "--half-thicknes",
              "0.1");
  RUN_REFUSED(2, "--oputput is not an option, did you mean --output?", "mark", "--oputput=a.vtu", mesh);
  RUN_REFUSED(2, "--params-opened is not an option, did you mean --params-open?", "mark", mesh, "--params-opened",
              "a.json");
  RUN_REFUSED(2,
              "riis: --zzz is not an option; --scal is not an option, did you mean --scale?; -y is not an option; "
              "--aaa is not an option (",
              "mark", "--zzz", "--scal", "2", mesh, "-y", "--aaa=1");
  RUN_REFUSED(2, "riis: z.vtu is one argument too many; a.vtu is one argument too many (", "mark", mesh, "z.vtu",
              "a.vtu");
}

TEST(test_commands) {
  RUN_REFUSED(2, "'mrak' is not a command, did you mean mark? (riis --help lists the commands)", "mrak", "a.vtu");
  RUN_REFUSED(2, "'mesh.vtu' is not a command (riis --help lists the commands)", "mesh.vtu", "--output", "a.vtu");
  RUN_REFUSED(2, "--output stands before a command (riis --help lists", "--output", "a.vtu", "mark", "mesh.vtu");
  RUN_REFUSED(2, "riis check needs a command: crossings or leaks", "check");
  RUN_REFUSED(2, "'crossing' is not a command, did you mean crossings? (riis check --help", "check", "crossing");
  RUN_REFUSED(2, "'unit' is not a topic, did you mean units? (riis help lists the topics)", "help", "unit");
  RUN_REFUSED(2, "more is one argument too many", "help", "units", "more");
}

TEST(test_new_usage) {
  const char *mesh = scratch_path("in.vtu"), *out = scratch_path("a.vtu");
  RUN_REFUSED(2, "--leaflets", "mark", mesh, "--leaflets", "connected");
  RUN_REFUSED(2, "--prefix requires --output", "mark", mesh, "--prefix", "left");
  RUN_REFUSED(2, "--replace requires --output", "mark", mesh, "--replace");
  RUN_REFUSED(2, "--prefix: 'a b' must have 1 to 64 characters: letters, digits", "mark", mesh, "--output", out,
              "--prefix", "a b");
  RUN_REFUSED(2, "--prefix: the value is empty", "mark", mesh, "--output", out, "--prefix=", "--quiet");
  RUN_REFUSED(2, "--unit", "mark", mesh, "--unit", "km");
  RUN_REFUSED(2, "--scale excludes --unit", "mark", mesh, "--unit", "m", "--scale", "0.01");
  RUN_REFUSED(2, "--surface-unit needs --unit", "mark", mesh, "--surface", "a.stl", "--surface-unit", "mm");
  RUN_REFUSED(2, "--unit needs --surface-unit, the unit of a.stl", "mark", mesh, "--surface", "a.stl", "--unit", "mm");
  RUN_REFUSED(2, "--unit needs --surface-unit, the unit of a.json", "mark", mesh, "--valve", "a.json", "--unit", "mm");
  RUN_REFUSED(2, "--surface-unit: the parameters of the aortic valve are in centimetres, not in metres", "mark", mesh,
              "--unit", "m", "--surface-unit", "m");
  RUN_REFUSED(2, "of the mitral valve are in centimetres, not in millimetres", "mark", mesh, "--valve", "mitral",
              "--unit", "m", "--surface-unit", "mm");
  assert_int_equal(scratch_exists("a.vtu"), 0);
}

/* Tests the range of --offset, and the measures and commands that cannot have an offset. */
TEST(test_offset) {
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "--offset is 1; it must be above -1 and below 1", "mark", mesh, "--offset", "1");
  RUN_REFUSED(2, "--offset: 'aside' is not a number", "mark", mesh, "--offset", "aside");
  RUN_REFUSED(2, "--offset is 0.5, but options.measure is 1, which does not tell the sides of a surface apart", "mark",
              mesh, "--offset", "0.5", "--distance", "sampling");
  RUN_REFUSED(2, "--offset: svMultiPhysics interpolates distances, so it cannot use an offset", "export",
              scratch_path("uris"), "--valve", "trileaflet", "--resistance", "1", "--time-step", "0.001",
              "--opening-seconds", "0.1", "--closing-seconds", "0.1", "--offset", "0.5");
}

/* If the user split a value into several arguments, the refusal gives a hint. */
TEST(test_hints) {
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "--set takes NAME=VALUE", "mark", mesh, "--set", "root_radius", "1.3");
  RUN_REFUSED(2, "--set takes NAME=VALUE", "mark", "--set", "root_radius", "1.3", mesh);
  RUN_REFUSED(2, "--rotate: '0' has 1 numbers; it takes X,Y,Z,DEG", "mark", mesh, "--rotate", "0", "0", "1", "90");
  RUN_REFUSED(2, "--rotate", "mark", "--rotate", "0,", "0,", "1,", "90", mesh);
  RUN_REFUSED(2, "--translate: '0' has 1 numbers; it takes X,Y,Z", "mark", mesh, "--translate", "0", "0", "-1");
  RUN_REFUSED(2, "--help lists the options", "mark", mesh, "second.vtu", "--set", "root_radius=1.3", "--rotate",
              "0,0,1,90");
}

/* A refusal is one line, even if a name in it contains line breaks. */
TEST(test_control_characters) {
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(1, "no?such?.vtu: cannot be read", "mark", scratch_path("no\nsuch\t.vtu"));
  RUN_REFUSED(1, "no?such?.json: cannot be read", "mark", mesh, "--params", scratch_path("no\nsuch\r.json"));
  RUN_REFUSED(1, "no??folder", "mark", mesh, "--output", scratch_path("no\n\033folder/a.vtu"));
  RUN_REFUSED(2, "--scale: '1?2' is not", "mark", mesh, "--scale", "1\n2");
  RUN_REFUSED(2, "more?things", "mark", mesh, "more\nthings");
  RUN_REFUSED(1, "root?radius", "mark", mesh, "--set", "root\nradius=1");
  RUN_REFUSED(1, "mit?ral", "mark", mesh, "--valve", "mit\nral");
}

int main(void) { return run_cases(make_box, scratch_teardown); }
