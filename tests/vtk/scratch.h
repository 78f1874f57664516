/* SPDX-License-Identifier: Apache-2.0
 *
 * A folder of the test's own below the working directory, files in it, and a watch on what the process prints.
 * Functions end the program with a message where the test cannot go on. */
#ifndef RIIS_TESTS_SCRATCH_H
#define RIIS_TESTS_SCRATCH_H

#include <stddef.h>

/* Makes the folder and remembers it; one at a time. CMocka group set-up and tear-down. */
int scratch_setup(void **state);
int scratch_teardown(void **state);

/* "FOLDER/name", in one of a few static buffers: valid for the next 15 calls. */
const char *scratch_path(const char *name);

void scratch_write(const char *name, const void *bytes, size_t n_bytes);
void scratch_write_text(const char *name, const char *text);
/* The file's bytes, for free(); a 0 byte follows them. */
char *scratch_read(const char *path, size_t *n_bytes);
/* Files in the folder, hidden ones too. */
int scratch_n_files(void);
int scratch_exists(const char *name);

/* Between the two calls stdout and stderr go to a file; the second returns how many bytes it got. */
void scratch_watch_output(void);
long scratch_end_watch(void);

#endif
