/* SPDX-License-Identifier: Apache-2.0
 *
 * A bad series (--times) is refused before any file is written. The tests check status and message. Other tests interrupt a
 * series. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

static void write_cycle(const char *text) { scratch_write_text("cycle.csv", text); }

#define REFUSED_SERIES(exit_code, text, ...)                                                   \
  RUN_REFUSED(exit_code, text, "mark", scratch_path("in.vtu"), "--valve", "mitral", "--cycle", \
              scratch_path("cycle.csv"), "--output", scratch_path("s.pvd"), __VA_ARGS__)
#define REFUSED_TIMES(text, times) REFUSED_SERIES(2, text, "--times", times)

TEST(test_times) {
  write_cycle("0 0\n1 1\n");
  REFUSED_TIMES("--times: 100001 times are too many; a series has at most 100000", "0:100000:1");
  REFUSED_TIMES("times are too many", "0:1:1e-300");
  REFUSED_TIMES("--times: the step 0 is not above 0", "0:1:0");
  REFUSED_TIMES("--times: the step -0.1 is not above 0", "0:1:-0.1");
  REFUSED_TIMES("--times: the stop 0 is before the start 1", "1:0:0.1");
  REFUSED_TIMES("--times: nan is not finite", "0:nan:0.1");
  REFUSED_TIMES("--times: nan is not finite", "0,nan");
  REFUSED_TIMES("--times: inf is not finite", "0:inf:1");
  REFUSED_TIMES("--times: '0:1' is neither START:STOP:STEP nor a list of times", "0:1");
  REFUSED_TIMES("--times: 'x' is not a number", "0:x:1");
  REFUSED_TIMES("--times: the time 0.1 is not above the time before it, 0.2", "0.2,0.1");
  REFUSED_TIMES("--times: the step 1 is beyond the stop 0.1", "0:0.1:1");
  assert_false(scratch_exists("s.pvd"));
}

/* The largest number of times is accepted, and the last time is exact. */
TEST(test_many_times) {
  write_cycle("0 0\n1 2\n");
  REFUSED_SERIES(1, "cycle.csv: line 2: the opening 2 is not from 0 to 1", "--times", "0:99999:1");
}

static void expect_cycle(const char *text, const char *file) {
  write_cycle(file);
  REFUSED_SERIES(1, text, "--times", "0:1:0.5");
}

TEST(test_cycle_files) {
  expect_cycle("cycle.csv: line 3: the time 1 is not above the time before it", "0,0\n1,1\n1,0\n");
  expect_cycle("cycle.csv: line 2: the opening 1.5 is not from 0 to 1", "0,0\n1,1.5\n");
  expect_cycle("cycle.csv: line 2: the opening -0.1 is not from 0 to 1", "0,0\n1,-0.1\n");
  expect_cycle("cycle.csv: line 3: the opening 'nan' is not a finite number", "t,opening\n0,0\n1,nan\n");
  expect_cycle("cycle.csv: line 2: the time 'now' is not a finite number", "0,0\nnow,1\n");
  expect_cycle("cycle.csv: line 2: has 3 columns: '1,1,1'; it must have 2", "0,0\n1,1,1\n");
  expect_cycle("cycle.csv: line 1: has 1 columns", "0\n");
  expect_cycle("cycle.csv: holds no times and openings", "time,opening\n");
  expect_cycle("cycle.csv: is empty", "");
  unlink(scratch_path("cycle.csv"));
  REFUSED_SERIES(1, "cycle.csv: cannot be read", "--times", "0:1:0.5");
  write_cycle("0,0\n1,1\n");
  REFUSED_SERIES(1, "cycle.csv: table.time of key 1 is 1, beyond the period of 0.5", "--times", "0:1:0.5", "--period",
                 "0.5");
  REFUSED_SERIES(2, "--period: 0 is not above 0", "--times", "0:1:0.5", "--period", "0");
  /* Tables from other programs have blanks, semicolons, or Windows line ends. */
  write_cycle("Zeit;Oeffnung\r\n0; 0\r\n+1;\t1\r\n");
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--cycle",
           scratch_path("cycle.csv"), "--times", "0:1:0.5", "--series-table", scratch_path("t.csv"), "--quiet");
}

TEST(test_options) {
  const char *mesh = scratch_path("in.vtu"), *cycle = scratch_path("cycle.csv");
  write_cycle("0,0\n1,1\n");
  RUN_REFUSED(2, "--movie needs --times", "mark", mesh, "--movie", "a.mp4");
  RUN_REFUSED(2, "--series-table needs --times", "mark", mesh, "--series-table", "a.csv");
  RUN_REFUSED(2, "--all-cells needs --times", "mark", mesh, "--all-cells");
  RUN_REFUSED(2, "--cycle needs --times", "mark", mesh, "--cycle", cycle);
  RUN_REFUSED(2, "--times needs --cycle", "mark", mesh, "--times", "0,1");
  RUN_REFUSED(2, "nothing to do: a MESH is needed", "mark", "--cycle", cycle, "--times", "0,1");
  RUN_REFUSED(2, "--period needs a motion that repeats: --surface FILE.pvd, --surface FILE.dat or --cycle", "mark",
              mesh, "--period", "1");
  RUN_REFUSED(2, "--frame-rate requires --movie", "mark", mesh, "--times", "0,1", "--frame-rate", "1");
  RUN_REFUSED(2, "--opening excludes --times", "mark", mesh, "--cycle", cycle, "--times", "0,1", "--opening", "1");
  RUN_REFUSED(2, "--set opening has no effect with --times", "mark", mesh, "--cycle", cycle, "--times", "0,1", "--set",
              "opening=1");
  RUN_REFUSED(2, "--steps has no effect with --times", "mark", mesh, "--cycle", cycle, "--times", "0,1", "--steps",
              "2");
  RUN_REFUSED(2, "--times has no effect with --surface a.stl: a motion is a .pvd or .dat file", "mark", mesh, "--times",
              "0,1", "--surface", "a.stl");
  RUN_REFUSED(2, "--cycle has no effect with --surface", "mark", mesh, "--times", "0,1", "--surface", "a.pvd",
              "--cycle", cycle);
  RUN_REFUSED(2, "--time excludes --times", "mark", mesh, "--times", "0,1", "--surface", "a.pvd", "--time", "0");
  RUN_REFUSED(2, "must end in .pvd", "mark", mesh, "--cycle", cycle, "--times", "0,1", "--output", "a.vtu");
  RUN_REFUSED(2, "must end in .pvd", "mark", mesh, "--cycle", cycle, "--times", "0,1", "--surface-output", "a.vtp");
  RUN_REFUSED(2, "--output: a.pvd must end in .vtu", "mark", mesh, "--output", "a.pvd");
  RUN_REFUSED(2, "--movie: a.avi must end in .mp4 or .gif", "mark", mesh, "--cycle", cycle, "--times", "0,1", "--movie",
              "a.avi");
  RUN_REFUSED(2, "is also the file of --cycle", "mark", mesh, "--cycle", cycle, "--times", "0,1", "--series-table",
              cycle);
}

/* A valve that cannot reach the opening is refused before the mesh is read. */
TEST(test_valves) {
  write_cycle("0,0\n1,0.5\n");
  scratch_write_text(
      "patch.json",
      "{\"curves\": {\"a\": [[0,0,0],[1,0,0]], \"b\": [[0,1,0],[1,1,0]], \"c\": [[0,0,0],[0,1,0]],"
      "\"d\": [[1,0,0],[1,1,0]]}, \"patches\": [{\"v0\": \"a\", \"v1\": \"b\", \"u0\": \"c\", \"u1\": \"d\"}]}");
  RUN_REFUSED(1, "opening is 0.5, but the file has no \"open\" state", "mark", "missing.vtu", "--valve",
              scratch_path("patch.json"), "--cycle", scratch_path("cycle.csv"), "--times", "0,1", "--output",
              scratch_path("s.pvd"));
}

TEST(test_places) {
  const char *mesh = scratch_path("in.vtu"), *cycle = scratch_path("cycle.csv");
  write_cycle("0,0\n1,1\n");
  RUN_REFUSED(1, "the folder /nowhere does not exist", "mark", mesh, "--cycle", cycle, "--times", "0,1", "--output",
              "/nowhere/s.pvd");
  RUN_REFUSED(1, "the folder /nowhere does not exist", "mark", mesh, "--cycle", cycle, "--times", "0,1",
              "--series-table", "/nowhere/s.csv");
  /* A file has the name of the output folder, so the folder cannot be made. */
  scratch_write_text("full", "text");
  RUN_REFUSED(1, "full: the folder cannot be made", "mark", mesh, "--valve", "mitral", "--half-thickness", "0.3",
              "--cycle", cycle, "--times", "0,1", "--output", scratch_path("full.pvd"), "--quiet");
  /* A step would replace the input. */
  assert_int_equal(mkdir(scratch_path("in"), 0700), 0);
  assert_int_equal(symlink("../in.vtu", scratch_path("in/in_0000.vtu")), 0);
  RUN_REFUSED(2, "holds the file of MESH", "mark", scratch_path("in/in_0000.vtu"), "--cycle", cycle, "--times", "0,1",
              "--output", scratch_path("in.pvd"));
  /* The mesh already has arrays that are named like the marks. */
  RUN_FINE("mark", mesh, "--valve", "mitral", "--half-thickness", "0.3", "--output", scratch_path("marked.vtu"));
  RUN_REFUSED(2, "already has an array riis_marked", "mark", scratch_path("marked.vtu"), "--valve", "mitral",
              "--half-thickness", "0.3", "--cycle", cycle, "--times", "0,1", "--output", scratch_path("s.pvd"));
  assert_false(scratch_exists("s.pvd"));
}

/* If ffmpeg is not in PATH, the refusal comes before any work. The mesh is also missing, but the message names only ffmpeg. */
TEST(test_no_ffmpeg) {
  char *before = strdup(getenv("PATH"));
  write_cycle("0,0\n1,1\n");
  setenv("PATH", "/nowhere", 1);
  RUN_REFUSED(1, "--movie needs the program ffmpeg, which is not on the PATH; on Debian the package ffmpeg has it",
              "mark", "missing.vtu", "--cycle", scratch_path("cycle.csv"), "--times", "0,1", "--movie",
              scratch_path("a.mp4"));
  setenv("PATH", before, 1);
  free(before);
  assert_false(scratch_exists("a.mp4"));
}

/* If no node is near the valve at any time, the status is 3. The files are complete, and there is a warning. */
TEST(test_none_marked) {
  write_cycle("0,0\n1,1\n");
  run_program("mark", scratch_path("in.vtu"), "--valve", "mitral", "--translate", "50,0,0", "--half-thickness", "0.3",
              "--cycle", scratch_path("cycle.csv"), "--times", "0,1", "--output", scratch_path("none.pvd"), "--quiet",
              NULL);
  assert_int_equal(program_exit_code, 3);
  assert_non_null(strstr(program_err, "no node is marked"));
  assert_true(scratch_exists("none/none_0001.vtu"));
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--translate", "50,0,0", "--half-thickness", "0.3",
           "--cycle", scratch_path("cycle.csv"), "--times", "0,1", "--output", scratch_path("none.pvd"), "--quiet",
           "--allow-none");
}

/* The program prints the size of the output before it writes the files, but not with --quiet. */
TEST(test_announcement) {
  struct stat status;
  write_cycle("0,0\n1,1\n");
  run_program("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--cycle",
              scratch_path("cycle.csv"), "--times", "0:1:0.25", "--output", scratch_path("size.pvd"), "--all-cells",
              NULL);
  assert_int_equal(program_exit_code, 0);
  double announced = 0;
  const char *found = strstr(program_err, "riis: writing 5 files with 2,197 of 2,197 nodes, ");
  assert_non_null(found);
  assert_int_equal(sscanf(strstr(found, "nodes, "), "nodes, %lf MB in all", &announced), 1);
  double size = 0;
  for (int i = 0; i < 5; ++i) {
    char name[64];
    snprintf(name, sizeof name, "size/size_%04d.vtu", i);
    assert_int_equal(stat(scratch_path(name), &status), 0);
    size += (double)status.st_size;
  }
  if (!(announced > 0.98e-6 * size && announced < 1.02e-6 * size))
    fail_msg("%g MB announced, %g there", announced, 1e-6 * size);
}

static int n_listed(const char *pvd) {
  char *text = scratch_read(scratch_path(pvd), NULL);
  int n = 0;
  for (const char *at = text; (at = strstr(at, "<DataSet ")) != NULL; ++at) ++n;
  assert_non_null(strstr(text, "</VTKFile>\n"));
  free(text);
  return n;
}

/* After a signal, the series completes the current step and ends. Every listed file can be read, and no other file exists. */
static void interrupt_series(int signal_number) {
  static const char *const files[] = {"long/long_0000.vtu", "long/long_0001.vtu"};
  const pid_t process =
      start_program("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--cycle",
                    scratch_path("cycle.csv"), "--times", "0:1:0.0005", "--output", scratch_path("long.pvd"),
                    "--series-table", scratch_path("long.csv"), "--quiet", NULL);
  for (int n_tries = 0; !scratch_exists(files[1]) && n_tries < 100000; ++n_tries) usleep(500);
  kill(process, signal_number);
  finish_program(process);
}

static int n_files_of_dead(void) {
  int n_files = 0;
  for (char name[64] = "dead/dead_0000.vtu"; scratch_exists(name); ++n_files)
    snprintf(name, sizeof name, "dead/dead_%04d.vtu", n_files + 1);
  return n_files;
}

TEST(test_interruption) {
  write_cycle("0,0\n1,1\n");
  const int signals[] = {SIGINT, SIGTERM};
  for (int i = 0; i < 2; ++i) {
    interrupt_series(signals[i]);
    assert_int_equal(program_exit_code, 128 + signals[i]);
    const int n = n_listed("long.pvd");
    char said[64];
    snprintf(said, sizeof said, "riis: interrupted: %d of 2001 written\n", n);
    assert_string_equal(program_err, said);
    assert_true(n >= 2 && n < 2001);
    for (int step = 0; step <= n; ++step) {
      char name[64];
      int64_t n_points = 0;
      snprintf(name, sizeof name, "long/long_%04d.vtu", step);
      assert_int_equal(scratch_exists(name), step < n);
      if (step < n) assert_int_equal(shim_read_points(scratch_path(name), &n_points, NULL, NULL, NULL), 1);
    }
    char *table = scratch_read(scratch_path("long.csv"), NULL);
    int n_lines = 0;
    for (const char *at = table; (at = strchr(at, '\n')) != NULL; ++at) ++n_lines;
    assert_int_equal(n_lines, n + 1);
    free(table);
    char command[256];
    snprintf(command, sizeof command, "rm -rf %s", scratch_path("long"));
    assert_int_equal(system(command), 0);
  }
}

/* A process is stopped at any place and then killed. Its list then has all complete files. Only the last file may be missing, if
 * the process stopped after it wrote this file and before it listed the file. */
TEST(test_killed) {
  write_cycle("0,0\n1,1\n");
  const pid_t process = start_program("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3",
                                      "--cycle", scratch_path("cycle.csv"), "--times", "0:1:0.0005", "--output",
                                      scratch_path("dead.pvd"), "--quiet", NULL);
  for (int n_tries = 0; !scratch_exists("dead/dead_0011.vtu") && n_tries < 100000; ++n_tries) usleep(500);
  int status = 0;
  kill(process, SIGSTOP);
  assert_int_equal(waitpid(process, &status, WUNTRACED), process);
  assert_true(WIFSTOPPED(status));
  const int n_files = n_files_of_dead(), n = n_listed("dead.pvd");
  kill(process, SIGKILL);
  finish_program(process);
  assert_int_equal(program_exit_code, 128 + SIGKILL);
  assert_true(n_files >= 12 && n_files < 2001);
  assert_true(n == n_files || n == n_files - 1);
}

static int make_mitral_box(void **state) { return make_box_of(state, (double[3]){-3, -3, -2}, (double[3]){3, 3, 2}); }

int main(void) { return run_cases(make_mitral_box, scratch_teardown); }
