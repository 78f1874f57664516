/* SPDX-License-Identifier: Apache-2.0
 *
 * Files are replaced as a whole or left as they were, even if the write is interrupted or fails. No input is lost, and nothing
 * is left beside the files. */
#include <linux/capability.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

static void expect_text(const char *name, const char *text) {
  char *found = scratch_read(scratch_path(name), NULL);
  assert_string_equal(found, text);
  free(found);
}

static void test_same_file_twice(void **state) {
  (void)state;
  size_t size[2] = {0, 0};
  const char *mesh = scratch_path("in.vtu"), *params = scratch_path("v.json"), *out = scratch_path("z.vtu");
  char *before = scratch_read(mesh, &size[0]);
  scratch_write_text("v.json", "{\"root_radius\": 1.3}");
  RUN_REFUSED(2, "--stats: ", mesh, "--stats", mesh, "--quiet");
  assert_non_null(strstr(program_err, "is also the file of MESH"));
  RUN_REFUSED(2, "is also the file of --params", mesh, "--params", params, "--stats", params);
  RUN_REFUSED(2, "is also the file of --surface", mesh, "--surface", "s.stl", "--stats", "s.stl");
  RUN_REFUSED(2, "is also the file of --surface", mesh, "--surface", "s.vtu", "--output", "s.vtu");
  RUN_REFUSED(2, "is also the file of --output", mesh, "--output", out, "--stats", out);
  RUN_REFUSED(2, "is also the file of --picture", mesh, "--picture", "a.png", "--picture", "./a.png");
  RUN_REFUSED(2, "is also the file of --surface-output", mesh, "--surface-output", "a.vtp", "--stats", "a.vtp");
  /* The file has another name here. */
  assert_int_equal(symlink("in.vtu", scratch_path("link.vtu")), 0);
  assert_int_equal(link(params, scratch_path("hard.json")), 0);
  RUN_REFUSED(2, "is also the file of MESH", mesh, "--stats", scratch_path("link.vtu"));
  RUN_REFUSED(2, "is also the file of MESH", mesh, "--stats", scratch_path("./in.vtu"));
  RUN_REFUSED(2, "is also the file of --params", mesh, "--params", params, "--stats", scratch_path("hard.json"));
  expect_text("v.json", "{\"root_radius\": 1.3}");
  char *after = scratch_read(mesh, &size[1]);
  assert_int_equal(size[0], size[1]);
  assert_memory_equal(before, after, size[0]);
  assert_false(scratch_exists("z.vtu"));
  free(before);
  free(after);
}

/* An output may be the input itself: the user can only have meant that. */
static void test_in_place(void **state) {
  (void)state;
  assert_true(shim_write_box(scratch_path("place.vtu"), SHIM_RAW, 5, (double[3]){-1.7, -1.6, -1.3},
                             (double[3]){1.5, 1.6, 0.4}, 1));
  RUN_FINE(scratch_path("place.vtu"), "--output", scratch_path("place.vtu"), "--half-thickness", "0.6", "--stats", "-");
  assert_int_equal(shim_read_array(scratch_path("place.vtu"), 'p', "riis_marked", NULL, NULL, NULL, NULL), 1);
  RUN_FINE("--surface-output", scratch_path("place.vtp"));
  RUN_FINE("--surface", scratch_path("place.vtp"), "--scale", "2", "--surface-output", scratch_path("place.vtp"));
}

/* Stats replace a file, also through a link, but are written into a device. */
static void test_stats_places(void **state) {
  (void)state;
  scratch_write_text("s.json", "before");
  assert_int_equal(symlink("s.json", scratch_path("s_link.json")), 0);
  const int n_files = scratch_n_files();
  RUN_FINE(scratch_path("in.vtu"), "--stats", scratch_path("s_link.json"), "--quiet");
  struct stat status;
  assert_int_equal(lstat(scratch_path("s_link.json"), &status), 0);
  assert_true(S_ISLNK(status.st_mode));
  char *json = scratch_read(scratch_path("s.json"), NULL);
  assert_true(json_number(json, "n_nodes") == n_box);
  free(json);
  RUN_FINE(scratch_path("in.vtu"), "--stats", "/dev/null", "--quiet");
  assert_int_equal(scratch_n_files(), n_files);
}

/* A file is replaced by a new one from the same folder, so a writable file in a closed folder is not enough. */
static void test_closed_folder(void **state) {
  (void)state;
  /* Root may write everywhere, unless the programs that it starts lose that right. */
  if (prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE) != 0 && geteuid() == 0) skip();
  const char *mesh = scratch_path("missing.vtu");
  assert_int_equal(mkdir(scratch_path("closed"), 0700), 0);
  scratch_write_text("closed/a.vtu", "before");
  scratch_write_text("closed/a.json", "before");
  assert_int_equal(symlink("closed/a.json", scratch_path("open.json")), 0);
  assert_int_equal(chmod(scratch_path("closed"), 0500), 0);
  RUN_REFUSED(1, "a.vtu: cannot be written: the folder", mesh, "--output", scratch_path("closed/a.vtu"));
  RUN_REFUSED(1, "a.json: cannot be written: the folder", mesh, "--stats", scratch_path("closed/a.json"));
  RUN_REFUSED(1, "open.json: cannot be written: the folder", mesh, "--stats", scratch_path("open.json"));
  assert_int_equal(chmod(scratch_path("closed"), 0700), 0);
  assert_int_equal(chmod(scratch_path("closed/a.json"), 0400), 0);
  RUN_REFUSED(1, "a.json: cannot be written: Permission denied", mesh, "--stats", scratch_path("closed/a.json"));
  expect_text("closed/a.vtu", "before");
  expect_text("closed/a.json", "before");
}

/* If a file may not grow to its full size, that is an error like any other. */
static void test_limited_size(void **state) {
  (void)state;
  scratch_write_text("limit.vtu", "before");
  scratch_write_text("limit.json", "before");
  const int n_files = scratch_n_files();
  struct rlimit before, small;
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
  small = before;
  small.rlim_cur = 512;
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
  run_program(scratch_path("in.vtu"), "--output", scratch_path("limit.vtu"), "--quiet", NULL);
  setrlimit(RLIMIT_FSIZE, &before);
  expect_run_refused(1, "limit.vtu: ", __FILE__, __LINE__);
  small.rlim_cur = 200;
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
  run_program(scratch_path("in.vtu"), "--stats", scratch_path("limit.json"), "--quiet", "--half-thickness", "0.5",
              NULL); /* nothing leaks here: a warning would go to a stderr with the same limit */
  setrlimit(RLIMIT_FSIZE, &before);
  expect_run_refused(1, "limit.json: cannot be written: File too large", __FILE__, __LINE__);
  expect_text("limit.vtu", "before");
  expect_text("limit.json", "before");
  assert_int_equal(scratch_n_files(), n_files);
}

/* Runs the program and sends it the signal as soon as it is writing a file. */
static void run_and_interrupt(int signal_number) {
  unlink(scratch_path("marked.vtu"));
  unlink(scratch_path("late.json"));
  const int n_files = scratch_n_files();
  const pid_t process = start_program(scratch_path("large.vtu"), "--output", scratch_path("marked.vtu"), "--stats",
                                      scratch_path("late.json"), NULL);
  for (int n_tries = 0; scratch_n_files() == n_files && n_tries < 100000; ++n_tries) usleep(500);
  kill(process, signal_number);
  finish_program(process);
}

/* A signal waits for the end of the file that is being written, then it ends the process, so --stats is not written. On a busy
 * machine the program may end before this process sees the file. Then the test tries again. */
static void test_interruption(void **state) {
  (void)state;
  assert_true(shim_write_box(scratch_path("large.vtu"), SHIM_RAW, 60, (double[3]){-1.7, -1.6, -1.3},
                             (double[3]){1.5, 1.6, 0.4}, 1));
  const int signals[] = {SIGINT, SIGTERM};
  for (int i = 0; i < 2; ++i) {
    run_and_interrupt(signals[i]);
    for (int n_tries = 0; program_exit_code == 0 && n_tries < 100; ++n_tries) run_and_interrupt(signals[i]);
    assert_int_equal(program_exit_code, 128 + signals[i]);
    assert_true(scratch_exists("marked.vtu"));
    assert_false(scratch_exists("late.json"));
    assert_int_equal(shim_read_array(scratch_path("marked.vtu"), 'p', "riis_marked", NULL, NULL, NULL, NULL), 1);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_same_file_twice), cmocka_unit_test(test_in_place),     cmocka_unit_test(test_stats_places),
      cmocka_unit_test(test_closed_folder),   cmocka_unit_test(test_limited_size), cmocka_unit_test(test_interruption),
  };
  return cmocka_run_group_tests(tests, make_box, scratch_teardown);
}
