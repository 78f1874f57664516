/* SPDX-License-Identifier: Apache-2.0 Lets test_cpp_header.c call code that uses riis.hpp. */
#ifndef RIIS_TEST_CPP_HEADER_H
#define RIIS_TEST_CPP_HEADER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Marks the nodes xyz (3, n) around a mitral valve. Returns the number of marked nodes and writes their ids (n). Returns -1 after
 * an exception. */
int64_t cpp_mark(int64_t n, const double *xyz, double half_thickness, int64_t *node_id);
/* Makes a valve. Returns 0, or the status of an exception. Writes the message of the exception to `text`. */
int32_t cpp_refusal(const char *kind, char *text, size_t length);
/* Each check cpp_wrong_* returns "" or the description of a fault. */
const char *cpp_wrong_with_handles(void);
const char *cpp_wrong_with_defaults(void);
const char *cpp_wrong_with_spans(void);

#ifdef __cplusplus
}
#endif

#endif
