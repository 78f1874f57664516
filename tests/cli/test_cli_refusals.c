/* SPDX-License-Identifier: Apache-2.0
 *
 * Every refusal has its exit code and one line on stderr that names the fault. No refusal leaves output behind. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

static void test_usage(void **state) {
  (void)state;
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "nothing to do: a MESH is needed", "--quiet");
  RUN_REFUSED(2, "nothing to do: --quiet", mesh, "--quiet");
  RUN_REFUSED(2, "--output needs a MESH", "--output", "a.vtu");
  RUN_REFUSED(2, "--stats needs a MESH", "--stats", "-");
  RUN_REFUSED(2, "--threads needs a MESH", "--surface-output", "a.vtp", "--threads", "2");
  RUN_REFUSED(2, "--search needs a MESH", "--surface-output", "a.vtp", "--search", "auto");
  RUN_REFUSED(2, "--distance-limit needs a MESH", "--surface-output", "a.vtp", "--distance-limit", "2");
  RUN_REFUSED(2, "--far-distance needs a MESH", "--surface-output", "a.vtp", "--far-distance", "-1");
  RUN_REFUSED(2, "MESH has no effect with --print-params", mesh, "--print-params");
  RUN_REFUSED(2, "--output has no effect with --print-params", "--print-params", "--output", "a.vtu");
  RUN_REFUSED(2, "--scale has no effect with --print-params", "--print-params", "--scale", "2");
  RUN_REFUSED(2, "--frobnicate is not an option (riis-mark --help lists the options)", mesh, "--frobnicate");
  RUN_REFUSED(2, "second.vtu is one argument too many", mesh, "second.vtu");
  RUN_REFUSED(2, "--valve", mesh, "--valve", "aortic", "--surface", "a.vtp");
  RUN_REFUSED(2, "--set", mesh, "--surface", "a.vtp", "--set", "root_radius=1");
  RUN_REFUSED(2, "--params", mesh, "--surface", "a.vtp", "--params", "a.json");
  RUN_REFUSED(2, "--tolerance", mesh, "--surface", "a.vtp", "--tolerance", "0.1");
  RUN_REFUSED(2, "--print-params", "--surface", "a.vtp", "--print-params");
  RUN_REFUSED(2, "--skip-zero-area", mesh, "--skip-zero-area");
  RUN_REFUSED(2, "--search", mesh, "--search", "clever");
  RUN_REFUSED(2, "--distance", mesh, "--distance", "far");
  RUN_REFUSED(2, "--distance", mesh, "--surface", "a.vtp", "--distance", "sampling");
  RUN_REFUSED(2, "--distance-tolerance has no effect with --distance triangles", mesh, "--distance-tolerance", "0.1");
  RUN_REFUSED(2, "--distance-tolerance has no effect with --distance triangles", mesh, "--distance", "triangles",
              "--distance-tolerance", "0.1");
  RUN_REFUSED(2, "--distance-tolerance is 2; it must be from 1e-06 to 1", mesh, "--distance", "sampling",
              "--distance-tolerance", "2");
  RUN_REFUSED(2, "--distance-tolerance: -1 is not above 0", mesh, "--distance", "sampling", "--distance-tolerance",
              "-1");
  RUN_REFUSED(2, "--distance needs a MESH", "--surface-output", "a.vtp", "--distance", "sampling");
  RUN_REFUSED(2, "--search is 4, clusters", mesh, "--distance", "sampling", "--search", "clusters");
  RUN_REFUSED(1, "more than 16777216 samples", mesh, "--distance", "sampling", "--distance-tolerance", "1e-4");
  RUN_REFUSED(2, "--view", mesh, "--picture", "a.png", "--view", "below");
  RUN_REFUSED(2, "--view: there are more views than pictures", mesh, "--picture", "a.png", "--view", "top", "--view",
              "side");
  RUN_REFUSED(2, "--output", mesh, "--output", "a.vtu", "--output", "b.vtu");
  RUN_REFUSED(2, "--output", mesh, "--output");
}

/* Refusals suggest the option that may have been meant, and come in the order of typing. */
static void test_unknown_options(void **state) {
  (void)state;
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "--half-thicknes is not an option, did you mean --half-thickness?", mesh, "--half-thicknes", "0.1");
  RUN_REFUSED(2, "--oputput is not an option, did you mean --output?", "--oputput=a.vtu", mesh);
  RUN_REFUSED(2, "--params-opened is not an option, did you mean --params-open?", mesh, "--params-opened", "a.json");
  RUN_REFUSED(2,
              "riis-mark: --zzz is not an option; --scal is not an option, did you mean --scale?; -y is not an option; "
              "--aaa is not an option (",
              "--zzz", "--scal", "2", mesh, "-y", "--aaa=1");
  RUN_REFUSED(2, "riis-mark: z.vtu is one argument too many; a.vtu is one argument too many (", mesh, "z.vtu", "a.vtu");
}

static void test_new_usage(void **state) {
  (void)state;
  const char *mesh = scratch_path("in.vtu"), *out = scratch_path("a.vtu");
  RUN_REFUSED(2, "--leaflets", mesh, "--leaflets", "connected");
  RUN_REFUSED(2, "--prefix requires --output", mesh, "--prefix", "left");
  RUN_REFUSED(2, "--replace requires --output", mesh, "--replace");
  RUN_REFUSED(2, "--allow-none needs a MESH", "--surface-output", "a.vtp", "--allow-none");
  RUN_REFUSED(2, "--prefix: 'a b' must be 1 to 64 letters, digits", mesh, "--output", out, "--prefix", "a b");
  RUN_REFUSED(2, "--prefix: the value is empty", mesh, "--output", out, "--prefix=", "--quiet");
  RUN_REFUSED(2, "--unit", mesh, "--unit", "km");
  RUN_REFUSED(2, "--scale excludes --unit", mesh, "--unit", "m", "--scale", "0.01");
  RUN_REFUSED(2, "--surface-unit needs --unit", mesh, "--surface", "a.stl", "--surface-unit", "mm");
  RUN_REFUSED(2, "--unit needs --surface-unit, the unit of a.stl", mesh, "--surface", "a.stl", "--unit", "mm");
  RUN_REFUSED(2, "--unit needs --surface-unit, the unit of a.json", mesh, "--valve", "a.json", "--unit", "mm");
  RUN_REFUSED(2, "--surface-unit: the parameters of the aortic valve are in centimetres, not in metres", mesh, "--unit",
              "m", "--surface-unit", "m");
  RUN_REFUSED(2, "of the mitral valve are in centimetres, not in millimetres", mesh, "--valve", "mitral", "--unit", "m",
              "--surface-unit", "mm");
  RUN_REFUSED(2, "--unit has no effect with --print-params", "--print-params", "--unit", "m");
  RUN_REFUSED(2, "MESH has no effect with --describe-params", mesh, "--describe-params");
  RUN_REFUSED(2, "--describe-params", "--describe-params", "--print-params");
  RUN_REFUSED(2, "--describe-params", "--surface", "a.vtp", "--describe-params");
  assert_int_equal(scratch_exists("a.vtu"), 0);
}

static void test_empty_values(void **state) {
  (void)state;
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
    RUN_REFUSED(2, text, scratch_path("in.vtu"), options[i], "");
  }
  RUN_REFUSED(2, "MESH: the value is empty", "");
  RUN_REFUSED(2, "--output: the value is empty", "--output=", scratch_path("in.vtu"), "--quiet");
}

/* A value in several words. */
static void test_hints(void **state) {
  (void)state;
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "--set takes NAME=VALUE", mesh, "--set", "root_radius", "1.3");
  RUN_REFUSED(2, "--set takes NAME=VALUE", "--set", "root_radius", "1.3", mesh);
  RUN_REFUSED(2, "--rotate takes X,Y,Z,DEG", mesh, "--rotate", "0", "0", "1", "90");
  RUN_REFUSED(2, "--rotate takes X,Y,Z,DEG", "--rotate", "0,", "0,", "1,", "90", mesh);
  RUN_REFUSED(2, "--translate takes X,Y,Z", mesh, "--translate", "0", "0", "-1");
  RUN_REFUSED(2, "--help lists the options", mesh, "second.vtu", "--set", "root_radius=1.3", "--rotate", "0,0,1,90");
}

/* One line, whatever the names hold. */
static void test_control_characters(void **state) {
  (void)state;
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(1, "no?such?.vtu: cannot be read", scratch_path("no\nsuch\t.vtu"));
  RUN_REFUSED(1, "no?such?.json: cannot be read", mesh, "--params", scratch_path("no\nsuch\r.json"));
  RUN_REFUSED(1, "no??folder", mesh, "--output", scratch_path("no\n\033folder/a.vtu"));
  RUN_REFUSED(2, "--scale: '1?2' is not", mesh, "--scale", "1\n2");
  RUN_REFUSED(2, "more?things", mesh, "more\nthings");
  RUN_REFUSED(1, "root?radius", mesh, "--set", "root\nradius=1");
  RUN_REFUSED(1, "mit?ral", mesh, "--valve", "mit\nral");
}

static void test_numbers(void **state) {
  (void)state;
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "--rotate: '0,0,1' has 3 numbers; it takes X,Y,Z,DEG", mesh, "--rotate", "0,0,1");
  RUN_REFUSED(2, "--rotate: 'z' is not a number", mesh, "--rotate", "0,0,z,90");
  RUN_REFUSED(2, "--translate: '1,2,3,4' has 4 numbers; it takes X,Y,Z", mesh, "--translate", "1,2,3,4");
  RUN_REFUSED(2, "--scale: 'big' is not a number", mesh, "--scale", "big");
  RUN_REFUSED(2, "--scale: '1,5' is not a number", mesh, "--scale", "1,5");
  RUN_REFUSED(2, "--scale: '1e999' is not a number that fits", mesh, "--scale", "1e999");
  RUN_REFUSED(2, "--threads: 'two' is not a whole number", mesh, "--threads", "two");
  RUN_REFUSED(2, "--threads: '2.5' is not a whole number", mesh, "--threads", "2.5");
  RUN_REFUSED(2, "--threads: '99999999999' is not a whole number", mesh, "--threads", "99999999999");
  /* A user must not be able to pass RIIS_AUTO, which is -1. */
  RUN_REFUSED(2, "--half-thickness: -1 is not above 0", mesh, "--half-thickness", "-1");
  RUN_REFUSED(2, "--half-thickness: nan is not above 0", mesh, "--half-thickness", "nan");
  RUN_REFUSED(2, "--distance-limit: -1 is not above 0", mesh, "--distance-limit", "-1");
}

/* Values of the right form that the library refuses. */
static void test_values(void **state) {
  (void)state;
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "riis-mark: --scale is 0; ", mesh, "--scale", "0");
  RUN_REFUSED(2, "riis-mark: --scale is -1; ", mesh, "--scale", "-1");
  RUN_REFUSED(2, "riis-mark: --rotate: the axis is (0, 0, 0); ", mesh, "--rotate", "0,0,0,90");
  RUN_REFUSED(2, "riis-mark: --rotate: the angle is 1e+07; ", mesh, "--rotate", "0,0,1,1e7");
  RUN_REFUSED(2, "riis-mark: --translate ", mesh, "--translate", "1e60,0,0");
  RUN_REFUSED(2, "riis-mark: --translate moves the valve ", mesh, "--translate", "1e30,0,0");
  RUN_REFUSED(2, "riis-mark: --tolerance is 0; ", mesh, "--tolerance", "0");
  RUN_REFUSED(2, "riis-mark: --tolerance is -1; ", mesh, "--tolerance", "-1");
  RUN_REFUSED(2, "riis-mark: --half-thickness is inf; ", mesh, "--half-thickness", "inf");
  /* These refusals come before the mesh is read: it is also missing. */
  mesh = scratch_path("missing.vtu");
  RUN_REFUSED(2, "riis-mark: --distance-limit is 0.05; ", mesh, "--distance-limit", "0.05");
  RUN_REFUSED(2, "riis-mark: --threads is -2; ", mesh, "--threads", "-2");
  RUN_REFUSED(2, "riis-mark: --threads is 1025; ", mesh, "--threads", "1025");
  RUN_REFUSED(2, "riis-mark: --far-distance is 0.05; ", mesh, "--far-distance", "0.05", "--output",
              scratch_path("a.vtu"));
  mesh = scratch_path("in.vtu");
  RUN_REFUSED(1, "mitre", mesh, "--valve", "mitre");
  assert_int_equal(scratch_exists("a.vtu"), 0);
}

static void test_input_files(void **state) {
  (void)state;
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(1, "missing.vtu: cannot be read: No such file", scratch_path("missing.vtu"));
  RUN_REFUSED(1, "a mesh must be a .vtu or .vtk file", "mesh.msh");
  RUN_REFUSED(1, "missing.vtp: cannot be read: No such file", mesh, "--surface", scratch_path("missing.vtp"));
  scratch_write_text("garbage.vtu", "garbage");
  RUN_REFUSED(1, "garbage.vtu: is not a VTK XML file", scratch_path("garbage.vtu"));
  size_t size = 0;
  char *bytes = scratch_read(mesh, &size);
  scratch_write("cut.vtu", bytes, size / 2);
  free(bytes);
  RUN_REFUSED(1, "cut.vtu: is truncated", scratch_path("cut.vtu"), "--output", scratch_path("a.vtu"));
  assert_int_equal(scratch_exists("a.vtu"), 0);
}

/* A refusal of data that only the core can check names the file. */
static void test_bad_data(void **state) {
  (void)state;
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
  RUN_REFUSED(1, "nan.vtu: ", scratch_path("nan.vtu"));
  assert_non_null(strstr(program_err, "node 2"));
  scratch_write_text("nan.stl",
                     "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 2 0 "
                     "0\nendloop\nendfacet\nendsolid\n");
  RUN_REFUSED(1, "nan.stl: ", scratch_path("in.vtu"), "--surface", scratch_path("nan.stl"));
}

static void test_outputs(void **state) {
  (void)state;
  const char *mesh = scratch_path("in.vtu");
  RUN_REFUSED(2, "--output: ", mesh, "--output", scratch_path("a.vtk"));
  RUN_REFUSED(2, "--surface-output: ", mesh, "--surface-output", scratch_path("a.stl"));
  RUN_REFUSED(2, "--picture: ", mesh, "--picture", scratch_path("a.jpg"));
  RUN_REFUSED(1, "a.vtu: cannot be written: the folder", mesh, "--output", scratch_path("no_folder/a.vtu"));
  RUN_REFUSED(1, "a.vtp: cannot be written: the folder", mesh, "--surface-output", scratch_path("no_folder/a.vtp"));
  RUN_REFUSED(1, "a.png: cannot be written: the folder", mesh, "--picture", scratch_path("no_folder/a.png"));
  RUN_REFUSED(1, "a.json: cannot be written: the folder", mesh, "--stats", scratch_path("no_folder/a.json"));
  assert_int_equal(mkdir(scratch_path("folder.vtu"), 0700), 0);
  RUN_REFUSED(1, "folder.vtu: is a directory", mesh, "--stats", scratch_path("folder.vtu"));
  RUN_REFUSED(1, "folder.vtu: is a directory", mesh, "--output", scratch_path("folder.vtu"));
  RUN_REFUSED(1, "/dev/full: cannot be written: No space left", mesh, "--stats", "/dev/full", "--quiet");
}

/* An impossible output is refused before the mesh is read: the mesh is also missing, but is not named. */
static void test_outputs_first(void **state) {
  (void)state;
  RUN_REFUSED(1, "a.vtu: cannot be written", scratch_path("missing.vtu"), "--output", scratch_path("no_folder/a.vtu"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_usage),           cmocka_unit_test(test_numbers),
      cmocka_unit_test(test_values),          cmocka_unit_test(test_input_files),
      cmocka_unit_test(test_bad_data),        cmocka_unit_test(test_outputs),
      cmocka_unit_test(test_outputs_first),   cmocka_unit_test(test_empty_values),
      cmocka_unit_test(test_unknown_options), cmocka_unit_test(test_new_usage),
      cmocka_unit_test(test_hints),           cmocka_unit_test(test_control_characters),
  };
  return cmocka_run_group_tests(tests, make_box, scratch_teardown);
}
