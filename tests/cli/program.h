/* SPDX-License-Identifier: Apache-2.0
 *
 * Runs riis as a user would, and keeps the output. */
#ifndef RIIS_TESTS_PROGRAM_H
#define RIIS_TESTS_PROGRAM_H

#include <sys/types.h>

#include "test_cases.h"

enum { longest_output = 65536 };

/* Results of the last run. */
extern int program_exit_code; /* 128 + N if signal N ended the program */
extern char program_out[longest_output], program_err[longest_output];
extern char program_leaks[longest_output];     /* the warning about leaks, not in program_err; "" if none */
extern char program_crossings[longest_output]; /* the warning about crossings; "" if there was none */
extern char program_outside[longest_output];   /* the warning about leaflets outside the mesh; "" if there was none */

/* The path of a file for the program's stdout, or "" to close stdout. With NULL, the default, program_out gets the stdout. */
extern const char *program_stdout;

/* The program to run. NULL, the default, means riis. */
extern const char *program_file;

/* Runs the program with these arguments; the last one is NULL. */
void run_program(const char *argument, ...);
/* Start the program and wait for it. Only one program may run at a time. */
pid_t start_program(const char *argument, ...);
void finish_program(pid_t process);

/* Runs the program, which must succeed and print nothing on stderr. */
#define RUN_FINE(...) (run_program(__VA_ARGS__, NULL), expect_run_fine(__FILE__, __LINE__))
/* Runs the program on a mesh without volume cells. The run must succeed and report leaks as unknown. */
#define RUN_WITHOUT_CELLS(...) (run_program(__VA_ARGS__, NULL), expect_run_without_cells(__FILE__, __LINE__))
/* Runs the program, which must end with this exit code. The program must print nothing on stdout, and one line with this text on
 * stderr. */
#define RUN_REFUSED(exit_code, text, ...) \
  (run_program(__VA_ARGS__, NULL), expect_run_refused(exit_code, text, __FILE__, __LINE__))

void expect_run_fine(const char *file, int line);
void expect_run_without_cells(const char *file, int line);
void expect_run_refused(int exit_code, const char *part_of_text, const char *file, int line);

/* Returns the number that follows "key": in a JSON text. Fails the test if the key is missing. */
double json_number(const char *json, const char *key);
int json_has_text(const char *json, const char *key, const char *value);

/* The text must begin with this point's coordinates and continue with `follows`. The coordinates may be off by a tenth of an
 * edge, and must have no digits below a hundredth of an edge. */
void expect_place(const char *text, const double point[3], double edge, const char *follows);

/* A set-up of CMocka: writes in.vtu, a box around the valve with n_box nodes, into the scratch folder. */
enum { n_box_side = 13, n_box = n_box_side * n_box_side * n_box_side };
int make_box(void **state);
/* Writes the same box with other corners. */
int make_box_of(void **state, const double lower[3], const double upper[3]);

#endif
