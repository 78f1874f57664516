/* SPDX-License-Identifier: Apache-2.0
 * Makes allocations fail when a test requests it. In an executable with failing_memory.cpp, all C++ code of the process uses a
 * replaced operator new. The return address shows whether the library or other code allocates. Embree gets a memory monitor
 * through a replaced rtcNewDevice. */
#ifndef RIIS_TEST_FAILING_MEMORY_H
#define RIIS_TEST_FAILING_MEMORY_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
  MEMORY_OF_LIBRARY = 0, /* calls of operator new by the library's code, on any thread */
  MEMORY_OF_WORKERS = 1, /* the same calls, but on all threads except the caller of memory_fail */
  MEMORY_OF_EMBREE = 2,  /* requests of Embree to its memory monitor */
  MEMORY_OF_ALL = 3 /* all of the above, and malloc of any caller; not with sanitizers, which have their own malloc */
};

/* Chooses the library or executable whose allocations fail. The chosen object contains this function. The default is the core
 * library. */
void memory_library_is_that_of(const char *function);

/* After this call, allocation number n (1, 2, ...) fails. If and_all_after is not 0, all later allocations also fail. */
void memory_fail(int whose, int64_t n, int and_all_after);
/* Lets all allocations succeed again. Returns how many allocations have failed. */
int64_t memory_stop_failing(void);
/* Returns 1 if allocations of MEMORY_OF_ALL can fail. */
int memory_of_all_can_fail(void);

/* Returns the number of allocations that the library's own code has made and not yet freed. */
int64_t memory_live_of_library(void);
/* Returns the memory that Embree holds now: its C++ allocations plus the bytes that its memory monitor counts.
 */
int64_t memory_live_of_embree(void);
int64_t memory_live_bytes_of_embree(void);

#ifdef __cplusplus
}
#endif

#endif
