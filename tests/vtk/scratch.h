/* SPDX-License-Identifier: Apache-2.0
 *
 * Provides a test's own folder below the working directory, files in it, and a watch on the process's output.
 * If the test cannot go on, the functions end the program with a message. */
#ifndef RIIS_TESTS_SCRATCH_H
#define RIIS_TESTS_SCRATCH_H

#include <stddef.h>

/* Make and remove the folder. Only one folder exists at a time. CMocka calls these functions as a group's set-up and
 * tear-down. */
int scratch_setup(void **state);
int scratch_teardown(void **state);

/* Returns "FOLDER/name" in one of a few static buffers. It is valid for the next 15 calls. */
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

/* Between these two calls stdout and stderr go to a file. The second call returns the number of bytes in it. */
void scratch_watch_output(void);
long scratch_end_watch(void);

#endif
