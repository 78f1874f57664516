/* SPDX-License-Identifier: Apache-2.0 */
#include "program.h"

#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "scratch.h"
#include "vtk_shim.h"

int program_exit_code;
char program_out[longest_output], program_err[longest_output], program_leaks[longest_output],
    program_crossings[longest_output], program_outside[longest_output];
const char *program_file = NULL;
const char *program_stdout;
static int out, err; /* streams of the running process */

static void give_up(const char *what) {
  perror(what);
  exit(1);
}

/* Both streams go to files, because an unread pipe could fill up. */
static int temporary_file(void) {
  char name[] = "output-XXXXXX";
  const int file = mkstemp(name);
  if (file < 0) give_up("mkstemp");
  unlink(name);
  return file;
}

static void take_text(int file, char text[longest_output]) {
  const ssize_t n = pread(file, text, longest_output - 1, 0);
  if (n < 0) give_up("pread");
  text[n] = 0;
  close(file);
}

/* Returns whether the line is a line of progress, which the program prints on slow machines (test_progress). A message that is
 * cut off also ends in dots, but is longer. */
static int is_progress(const char *line, const char *next) {
  enum { longest_progress = 200 };
  return next - line > 5 && next - line < longest_progress &&
         (strncmp(next - 5, " ...\n", 5) == 0 || (strncmp(next - 5, "left\n", 5) == 0 && strstr(line, ": step ")));
}

/* Removes the lines of progress from program_err. Moves the warnings about leaks, crossings and leaflets outside the mesh to
 * separate buffers. Most meshes of the tests are so coarse that the valve leaks. Some meshes are smaller than the valve, and
 * leaflets of unusual sizes cross. */
static void take_common_warnings(void) {
  program_leaks[0] = program_crossings[0] = program_outside[0] = 0;
  for (char *line = program_err; *line;) {
    char *const end = strchr(line, '\n'), *const next = end ? end + 1 : line + strlen(line);
    const size_t length = (size_t)(next - line);
    const char *const leaks = strstr(line, " leaks: "), *const cross = strstr(line, " go through each other");
    const char *const stands = strstr(line, " stands through the wall"), *const outside =
                                                                             stands
                                                                                 ? stands
                                                                                 : strstr(line,
                                                                                          " reaches through the wall");
    const int is_leak = (strncmp(line, "riis: the surface", 17) == 0 && leaks && leaks < next) ||
                        strncmp(line, "riis: the valve is open", 23) == 0;
    const int is_outside = outside && outside < next;
    if (is_progress(line, next)) {
      memmove(line, next, strlen(next) + 1);
    } else if (is_leak || is_outside || (cross && cross < next)) {
      strncat(is_leak ? program_leaks : is_outside ? program_outside : program_crossings, line, length);
      memmove(line, next, strlen(next) + 1);
    } else {
      line = next;
    }
  }
}

static pid_t start(const char *argument, va_list rest) {
  const char *const file = program_file ? program_file : RIIS_PROGRAM;
  const char *arguments[64] = {file};
  int n = 1;
  for (const char *next = argument; next; next = va_arg(rest, const char *)) arguments[n++] = next;
  out = temporary_file();
  err = temporary_file();
  fflush(NULL);
  const pid_t process = fork();
  if (process < 0) give_up("fork");
  if (process == 0) {
    signal(SIGINT, SIG_DFL); /* a job in a shell's background ignores it, and so would the program */
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    if (program_stdout) close(STDOUT_FILENO);
    if (program_stdout && *program_stdout)
      open(program_stdout, O_WRONLY); /* open returns the lowest free file number, which stdout had */
    execv(file, (char *const *)(uintptr_t)arguments);
    _exit(127);
  }
  return process;
}

pid_t start_program(const char *argument, ...) {
  va_list rest;
  va_start(rest, argument);
  const pid_t process = start(argument, rest);
  va_end(rest);
  return process;
}

void finish_program(pid_t process) {
  int status = 0;
  if (waitpid(process, &status, 0) != process) give_up("waitpid");
  program_exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  take_text(out, program_out);
  take_text(err, program_err);
  take_common_warnings();
}

void run_program(const char *argument, ...) {
  va_list rest;
  va_start(rest, argument);
  const pid_t process = start(argument, rest);
  va_end(rest);
  finish_program(process);
}

void expect_run_fine(const char *file, int line) {
  if (program_exit_code != 0 || program_err[0]) {
    print_error("%s:%d: exit code %d, stderr: %s\n", file, line, program_exit_code, program_err);
    fail();
  }
}

void expect_run_without_cells(const char *file, int line) {
  const char *const said = strstr(program_err, "riis: leaks of the surface are unknown: ");
  if (said != program_err || !strstr(program_err, " has no volume cells\n")) {
    print_error("%s:%d: stderr: %s\n", file, line, program_err);
    fail();
  }
  program_err[0] = 0;
  expect_run_fine(file, line);
}

void expect_run_refused(int exit_code, const char *part_of_text, const char *file, int line) {
  const char *end = strchr(program_err, '\n');
  const int one_line = end && end[1] == 0;
  const int named = strncmp(program_err, "riis: ", 6) == 0;
  if (program_exit_code != exit_code || !one_line || !named || !strstr(program_err, part_of_text) || program_out[0]) {
    print_error("%s:%d: exit code %d for %d, wanted one line with \"%s\"\nstderr: %s\nstdout: %s\n", file, line,
                program_exit_code, exit_code, part_of_text, program_err, program_out);
    fail();
  }
}

static const char *value_of(const char *json, const char *key) {
  char quoted[64];
  snprintf(quoted, sizeof quoted, "\"%s\": ", key);
  const char *found = strstr(json, quoted);
  if (!found) fail_msg("no \"%s\" in %s", key, json);
  return found + strlen(quoted);
}

double json_number(const char *json, const char *key) {
  const char *text = value_of(json, key);
  char *end = NULL;
  const double number = strtod(text, &end);
  if (end == text) fail_msg("\"%s\" is not a number in %s", key, json);
  return number;
}

int json_has_text(const char *json, const char *key, const char *value) {
  return strncmp(value_of(json, key), value, strlen(value)) == 0;
}

void expect_place(const char *text, const double point[3], double edge, const char *follows) {
  const int most_decimals = edge < 10 ? 1 + (int)ceil(-log10(edge)) : 0;
  for (int i = 0; i < 3; ++i) {
    char *end = NULL;
    const double x = strtod(text, &end);
    const char *const decimals = memchr(text, '.', (size_t)(end - text));
    if (!(fabs(x - point[i]) <= 0.1 * edge) || (decimals && end - decimals - 1 > most_decimals))
      fail_msg("\"%.80s\" for %.17g %.17g %.17g", text, point[0], point[1], point[2]);
    text = end;
  }
  if (strncmp(text, follows, strlen(follows)) != 0) fail_msg("\"%.40s\" and not \"%s\"", text, follows);
}

int make_box_of(void **state, const double lower[3], const double upper[3]) {
  scratch_setup(state);
  return shim_write_box(scratch_path("in.vtu"), SHIM_RAW, n_box_side, lower, upper, 1) ? 0 : -1;
}

int make_box(void **state) { return make_box_of(state, (double[3]){-1.7, -1.6, -1.3}, (double[3]){1.5, 1.6, 0.4}); }
