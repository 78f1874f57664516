/* SPDX-License-Identifier: Apache-2.0
 *
 * The program replaces a file as a whole, or leaves it as it was, even if a write is interrupted or fails. No input is lost, and
 * no temporary file remains. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* for F_SETSIG, F_NOTIFY */
#endif

#include <fcntl.h>
#include <linux/capability.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

static void expect_text(const char *name, const char *text) {
  char *found = scratch_read(scratch_path(name), NULL);
  assert_string_equal(found, text);
  free(found);
}

TEST(test_same_file_twice) {
  size_t size[2] = {0, 0};
  const char *mesh = scratch_path("in.vtu"), *params = scratch_path("v.json"), *out = scratch_path("z.vtu");
  char *before = scratch_read(mesh, &size[0]);
  scratch_write_text("v.json", "{\"root_radius\": 1.3}");
  RUN_REFUSED(2, "--stats: ", "mark", mesh, "--stats", mesh, "--quiet");
  assert_non_null(strstr(program_err, "is also the file of MESH"));
  RUN_REFUSED(2, "is also the file of --params", "mark", mesh, "--params", params, "--stats", params);
  RUN_REFUSED(2, "is also the file of --surface", "mark", mesh, "--surface", "s.stl", "--stats", "s.stl");
  RUN_REFUSED(2, "is also the file of --surface", "mark", mesh, "--surface", "s.vtu", "--output", "s.vtu");
  RUN_REFUSED(2, "is also the file of --output", "mark", mesh, "--output", out, "--stats", out);
  RUN_REFUSED(2, "is also the file of --picture", "mark", mesh, "--picture", "a.png", "--picture", "./a.png");
  RUN_REFUSED(2, "is also the file of --surface-output", "mark", mesh, "--surface-output", "a.vtp", "--stats", "a.vtp");
  /* The link is a second name of the input. */
  assert_int_equal(symlink("in.vtu", scratch_path("link.vtu")), 0);
  assert_int_equal(link(params, scratch_path("hard.json")), 0);
  RUN_REFUSED(2, "is also the file of MESH", "mark", mesh, "--stats", scratch_path("link.vtu"));
  RUN_REFUSED(2, "is also the file of MESH", "mark", mesh, "--stats", scratch_path("./in.vtu"));
  RUN_REFUSED(2, "is also the file of --params", "mark", mesh, "--params", params, "--stats",
              scratch_path("hard.json"));
  expect_text("v.json", "{\"root_radius\": 1.3}");
  char *after = scratch_read(mesh, &size[1]);
  assert_int_equal(size[0], size[1]);
  assert_memory_equal(before, after, size[0]);
  assert_false(scratch_exists("z.vtu"));
  free(before);
  free(after);
}

/* An output that is also the input is refused, whatever name the user types. The input keeps its bytes. */
static void expect_kept(const char *name, const char *before) { assert_true(scratch_is_same(name, before)); }

static void copy_file(const char *from, const char *to) {
  size_t size = 0;
  char *bytes = scratch_read(scratch_path(from), &size);
  scratch_write(to, bytes, size);
  free(bytes);
}

TEST(test_in_place) {
  const char *const names[] = {"in.vtu", "soft.vtu", "hard.vtu", "folder/in.vtu"};
  copy_file("in.vtu", "kept.vtu");
  assert_int_equal(symlink("in.vtu", scratch_path("soft.vtu")), 0);
  assert_int_equal(link(scratch_path("in.vtu"), scratch_path("hard.vtu")), 0);
  assert_int_equal(symlink(".", scratch_path("folder")), 0);
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k)
      RUN_REFUSED(2, "is also the file of MESH", "mark", scratch_path(names[i]), "--output", scratch_path(names[k]));
    RUN_REFUSED(2, "is also the file of MESH", "mark", scratch_path("in.vtu"), "--stats", scratch_path(names[i]),
                "--quiet");
  }
  expect_kept("in.vtu", "kept.vtu");
  RUN_FINE("surface", "--output", scratch_path("place.vtp"));
  copy_file("place.vtp", "kept.vtp");
  RUN_REFUSED(2, "place.vtp is also the file of --surface", "surface", "--surface", scratch_path("place.vtp"),
              "--scale", "2", "--output", scratch_path("place.vtp"));
  assert_int_equal(link(scratch_path("place.vtp"), scratch_path("other.vtp")), 0);
  RUN_REFUSED(2, "other.vtp is also the file of --surface", "surface", "--surface", scratch_path("place.vtp"),
              "--output", scratch_path("other.vtp"));
  expect_kept("place.vtp", "kept.vtp");
}

/* --stats replaces a file, even if the given name is a link to it. If the name is a device, the numbers are written to the
 * device. */
TEST(test_stats_places) {
  scratch_write_text("s.json", "before");
  assert_int_equal(symlink("s.json", scratch_path("s_link.json")), 0);
  const int n_files = scratch_n_files();
  RUN_FINE("mark", scratch_path("in.vtu"), "--stats", scratch_path("s_link.json"), "--quiet");
  struct stat status;
  assert_int_equal(lstat(scratch_path("s_link.json"), &status), 0);
  assert_true(S_ISLNK(status.st_mode));
  char *json = scratch_read(scratch_path("s.json"), NULL);
  assert_true(json_number(json, "n_nodes") == n_box);
  free(json);
  RUN_FINE("mark", scratch_path("in.vtu"), "--stats", "/dev/null", "--quiet");
  assert_int_equal(scratch_n_files(), n_files);
}

/* A motion consists of its .pvd list and the listed frames. An output or a step of a series must not replace one of these
 * files. */
TEST(test_motion_in_place) {
  RUN_FINE("surface", "--valve", "mitral", "--output", scratch_path("a.vtp"), "--quiet");
  assert_int_equal(mkdir(scratch_path("beat"), 0700), 0);
  assert_int_equal(mkdir(scratch_path("out"), 0700), 0);
  copy_file("a.vtp", "beat/beat_0001.vtp");
  copy_file("a.vtp", "beat/other.vtp");
  scratch_write_text("beat.pvd",
                     "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\"><Collection>"
                     "<DataSet timestep=\"0\" file=\"beat/other.vtp\"/><DataSet timestep=\"1\" "
                     "file=\"beat/beat_0001.vtp\"/></Collection></VTKFile>\n");
  copy_file("beat.pvd", "kept.pvd");
  char mesh[256];
  snprintf(mesh, sizeof mesh, "%s", scratch_path("in.vtu"));
#define MOTION "--surface", scratch_path("beat.pvd"), "--half-thickness", "0.3"
  RUN_REFUSED(2, "beat.pvd is also the file of --surface", "mark", mesh, MOTION, "--times", "0,1", "--surface-output",
              scratch_path("beat.pvd"));
  RUN_REFUSED(2, "is also the file of --surface", "mark", mesh, MOTION, "--times", "0,1", "--output",
              scratch_path("./beat/../beat.pvd"));
  assert_int_equal(symlink("beat", scratch_path("alias")), 0);
  RUN_REFUSED(2, "--output: the folder of its files, ", "mark", mesh, MOTION, "--times", "0,1", "--output",
              scratch_path("alias.pvd"));
  RUN_REFUSED(2, "is a frame of --surface", "surface", MOTION, "--time", "0.5", "--output",
              scratch_path("beat/other.vtp"));
  RUN_REFUSED(2, "is also the file of --surface", "mark", mesh, MOTION, "--times", "0,1", "--series-table",
              scratch_path("beat.pvd"));
  RUN_REFUSED(2, "is a frame of --surface", "mark", mesh, MOTION, "--times", "0,1", "--series-table",
              scratch_path("beat/other.vtp"));
  /* Either a step's name is a link to an input, or an input is a link to a step. */
  assert_int_equal(symlink("../beat/other.vtp", scratch_path("out/out_0001.vtp")), 0);
  RUN_REFUSED(2, "holds the file of --surface", "mark", mesh, MOTION, "--times", "0,1", "--surface-output",
              scratch_path("out.pvd"));
  assert_int_equal(unlink(scratch_path("out/out_0001.vtp")), 0);
  copy_file("in.vtu", "out/out_0000.vtu");
  assert_int_equal(symlink("out/out_0000.vtu", scratch_path("mesh.vtu")), 0);
  RUN_REFUSED(2, "holds the file of MESH", "mark", scratch_path("mesh.vtu"), MOTION, "--times", "0,1", "--output",
              scratch_path("out.pvd"));
  /* The files of a case are also inputs. */
  scratch_write_text("case.json",
                     "{\"mesh\": \"in.vtu\", \"times\": [0, 1], \"half_thickness\": 0.3,\n"
                     " \"valves\": [{\"surface\": \"beat.pvd\"}]}\n");
#define CASE "--case", scratch_path("case.json")
  RUN_REFUSED(2, "beat.pvd is also the file of --case", "mark", CASE, "--surface-output", scratch_path("beat.pvd"));
  RUN_REFUSED(2, "is also the file of --case", "mark", CASE, "--series-table", scratch_path("case.json"));
  RUN_REFUSED(2, "holds the file of --case", "mark", CASE, "--output", scratch_path("alias.pvd"));
  expect_kept("beat.pvd", "kept.pvd");
  expect_kept("beat/other.vtp", "a.vtp");
  expect_kept("beat/beat_0001.vtp", "a.vtp");
  expect_kept("out/out_0000.vtu", "kept.vtu");
}

/* Starts a run and waits until it holds its locks. The run's stats go to a pipe, so it then waits for a reader. */
static pid_t start_held_run(const char *output) {
  const pid_t process = start_program("mark", scratch_path("in.vtu"), "--output", output, "--stats",
                                      scratch_path("pipe"), "--half-thickness", "0.6", "--quiet", NULL);
  for (int n_tries = 0; !scratch_exists(".riis-held.vtu.lock") && n_tries < 100000; ++n_tries) usleep(500);
  assert_true(scratch_exists(".riis-held.vtu.lock"));
  return process;
}

/* Runs a second program through a shell, because run_program and start_program handle only one run at a time. */
static void expect_locked(const char *mesh, const char *option, const char *output) {
  char command[1024];
  snprintf(command, sizeof command, "%s mark %s %s %s --quiet 2>%s", RIIS_PROGRAM, mesh, option, scratch_path(output),
           scratch_path("second.txt"));
  const int status = system(command);
  assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 1);
  char *text = scratch_read(scratch_path("second.txt"), NULL);
  if (!strstr(text, ".vtu: another run of riis is writing it, and holds ")) fail_msg("%s", text);
  free(text);
}

/* A second run with the same output is refused, for every option and every name of the file. Runs that have ended or were killed
 * do not block later runs with the same output. */
TEST(test_second_run) {
  char mesh[256], held[256];
  snprintf(mesh, sizeof mesh, "%s", scratch_path("in.vtu"));
  snprintf(held, sizeof held, "%s", scratch_path("held.vtu"));
  assert_int_equal(mkfifo(scratch_path("pipe"), 0600), 0);
  assert_int_equal(symlink("held.vtu", scratch_path("also.vtu")), 0);
  scratch_write_text("held.vtu", "before");
  const pid_t first = start_held_run(held);
  expect_locked(mesh, "--output", "held.vtu");
  expect_locked(mesh, "--stats", "held.vtu");
  expect_locked(mesh, "--output", "also.vtu");
  kill(first, SIGKILL);
  finish_program(first);
  assert_int_equal(program_exit_code, 128 + SIGKILL);
  assert_true(scratch_exists(".riis-held.vtu.lock"));
  RUN_FINE("mark", mesh, "--output", held, "--half-thickness", "0.6", "--quiet");
  assert_false(scratch_exists(".riis-held.vtu.lock"));
  /* Ctrl-C also removes the lock. */
  const pid_t interrupted = start_held_run(held);
  kill(interrupted, SIGINT);
  finish_program(interrupted);
  assert_int_equal(program_exit_code, 128 + SIGINT);
  assert_false(scratch_exists(".riis-held.vtu.lock"));
}
/* The program replaces a file by a new file in its folder. The folder must therefore be writable, not only the file. */
TEST(test_closed_folder) {
  /* Root may write everywhere, so the child processes must give up root's rights. */
  if (prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE) != 0 && geteuid() == 0) skip();
  const char *mesh = scratch_path("missing.vtu");
  assert_int_equal(mkdir(scratch_path("closed"), 0700), 0);
  scratch_write_text("closed/a.vtu", "before");
  scratch_write_text("closed/a.json", "before");
  assert_int_equal(symlink("closed/a.json", scratch_path("open.json")), 0);
  assert_int_equal(chmod(scratch_path("closed"), 0500), 0);
  RUN_REFUSED(1, "a.vtu: cannot be written: the folder", "mark", mesh, "--output", scratch_path("closed/a.vtu"));
  RUN_REFUSED(1, "a.json: cannot be written: the folder", "mark", mesh, "--stats", scratch_path("closed/a.json"));
  RUN_REFUSED(1, "open.json: cannot be written: the folder", "mark", mesh, "--stats", scratch_path("open.json"));
  assert_int_equal(chmod(scratch_path("closed"), 0700), 0);
  assert_int_equal(chmod(scratch_path("closed/a.json"), 0400), 0);
  RUN_REFUSED(1, "a.json: cannot be written: Permission denied", "mark", mesh, "--stats",
              scratch_path("closed/a.json"));
  expect_text("closed/a.vtu", "before");
  expect_text("closed/a.json", "before");
}

/* If a file may not grow to its full size, the program reports an error and ends normally. */
TEST(test_limited_size) {
  scratch_write_text("limit.vtu", "before");
  scratch_write_text("limit.json", "before");
  const int n_files = scratch_n_files();
  struct rlimit before, small;
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
  small = before;
  small.rlim_cur = 512;
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
  run_program("mark", scratch_path("in.vtu"), "--output", scratch_path("limit.vtu"), "--quiet", NULL);
  setrlimit(RLIMIT_FSIZE, &before);
  expect_run_refused(1, "limit.vtu: ", __FILE__, __LINE__);
  small.rlim_cur = 200;
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
  run_program("mark", scratch_path("in.vtu"), "--stats", scratch_path("limit.json"), "--quiet", "--half-thickness",
              "0.5", NULL); /* no edge leaks, because the limit also applies to stderr, which gets the warning */
  setrlimit(RLIMIT_FSIZE, &before);
  expect_run_refused(1, "limit.json: cannot be written: File too large", __FILE__, __LINE__);
  expect_text("limit.vtu", "before");
  expect_text("limit.json", "before");
  assert_int_equal(scratch_n_files(), n_files);
}

/* The table of a series grows by lines. If it may not grow further, it keeps its complete lines. */
TEST(test_limited_table) {
  struct rlimit before, small;
  scratch_write_text("cycle.csv", "time,opening\n0,0\n1,1\n");
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
  small = before;
  small.rlim_cur = 250;
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
  run_program("mark", scratch_path("in.vtu"), "--times", "0:1:0.05", "--cycle", scratch_path("cycle.csv"),
              "--series-table", scratch_path("limit.csv"), "--quiet", "--half-thickness", "0.5", NULL);
  setrlimit(RLIMIT_FSIZE, &before);
  expect_run_refused(1, "limit.csv: cannot be written: File too large", __FILE__, __LINE__);
  char *text = scratch_read(scratch_path("limit.csv"), NULL);
  int n_lines = 0, n_commas = 0;
  for (const char *at = text; *at; ++at) n_lines += *at == '\n', n_commas += *at == ',';
  assert_true(n_lines >= 3 && n_lines < 22 && n_commas == 4 * n_lines && text[strlen(text) - 1] == '\n');
  free(text);
}

/* Runs the program. The kernel sends it the signal when the program first writes into a file of the folder. This file is
 * marked.vtu under its temporary name, because the locks of both outputs stay empty. */
static void run_and_interrupt(int signal_number) {
  unlink(scratch_path("marked.vtu"));
  const int folder = open(scratch_path("."), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  assert_int_equal(fcntl(folder, F_SETSIG, signal_number), 0);
  const pid_t process = start_program("mark", scratch_path("in.vtu"), "--output", scratch_path("marked.vtu"), "--stats",
                                      scratch_path("late.json"), NULL);
  const int is_set = fcntl(folder, F_SETOWN, process) == 0 && fcntl(folder, F_NOTIFY, DN_MODIFY) == 0;
  finish_program(process);
  close(folder);
  if (!is_set) skip(); /* a kernel without dnotify */
}

/* After a signal, the process first completes the current file. It does not write --stats, and leaves no temporary file. */
TEST(test_interruption) {
  const int signals[] = {SIGINT, SIGTERM};
  const int n_files = scratch_n_files();
  for (int i = 0; i < 2; ++i) {
    run_and_interrupt(signals[i]);
    assert_int_equal(program_exit_code, 128 + signals[i]);
    assert_true(scratch_exists("marked.vtu"));
    assert_false(scratch_exists("late.json"));
    assert_int_equal(scratch_n_files(), n_files + 1);
    assert_int_equal(shim_read_array(scratch_path("marked.vtu"), 'p', "riis_marked", NULL, NULL, NULL, NULL), 1);
  }
}

int main(void) { return run_cases(make_box, scratch_teardown); }
