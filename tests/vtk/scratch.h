/* SPDX-License-Identifier: Apache-2.0
 *
 * Provides a test's folder below the working directory, files in this folder, and a watch on the process's output. If the test
 * cannot go on, these functions end the program with a message. */
#ifndef RIIS_TESTS_SCRATCH_H
#define RIIS_TESTS_SCRATCH_H

#include <stddef.h>

/* Make and remove the folder. Only one folder exists at a time. CMocka calls these functions as the set-up and tear-down of a
 * group. */
int scratch_setup(void **state);
int scratch_teardown(void **state);

/* Returns "FOLDER/name" in one of a few static buffers. The text is valid for the next 15 calls. */
const char *scratch_path(const char *name);

void scratch_write(const char *name, const void *bytes, size_t n_bytes);
void scratch_write_text(const char *name, const char *text);
/* Returns the file's bytes, followed by a 0 byte. The caller frees them. */
char *scratch_read(const char *path, size_t *n_bytes);
/* Returns whether two files of the folder have the same bytes. */
int scratch_is_same(const char *a, const char *b);
/* Returns the number of files in the folder, including hidden ones. */
int scratch_n_files(void);
int scratch_exists(const char *name);

/* Between scratch_watch_output and scratch_end_watch, stdout and stderr go to a file. scratch_end_watch returns the number of
 * bytes in this file. */
void scratch_watch_output(void);
long scratch_end_watch(void);

#endif
