/* SPDX-License-Identifier: Apache-2.0
 * Makes allocations fail when a test requests it. An executable with failing_memory.cpp replaces operator new for all C++ code of
 * the process. The return address distinguishes the library's allocations from others. The executable also replaces rtcNewDevice,
 * in order to give Embree a memory monitor. */
#ifndef RIIS_TEST_FAILING_MEMORY_H
#define RIIS_TEST_FAILING_MEMORY_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
  MEMORY_OF_LIBRARY = 0, /* operator new called by the library's code, on any thread */
  MEMORY_OF_WORKERS = 1, /* the same, but on all threads except the thread that calls memory_fail */
  MEMORY_OF_EMBREE = 2,  /* requests of Embree to its memory monitor */
  MEMORY_OF_ALL = 3 /* all of the above, and malloc of any caller; not with sanitizers, which have their own malloc */
};

/* Chooses which object counts as the library: the object with this function. The default is the core. */
void memory_library_is_that_of(const char *function);

/* From now on allocation number n (1, 2, ...) fails. If and_all_after is not 0, all later allocations also fail. */
void memory_fail(int whose, int64_t n, int and_all_after);
/* From now on no allocation fails. Returns how many allocations have failed. */
int64_t memory_stop_failing(void);
/* Returns 1 if MEMORY_OF_ALL can fail. */
int memory_of_all_can_fail(void);

/* Returns the number of allocations that the library's own code has made and not yet freed. */
int64_t memory_live_of_library(void);
/* Returns the memory that Embree has taken and not yet freed: its C++ allocations plus the bytes that its memory monitor counts.
 * */
int64_t memory_live_of_embree(void);
int64_t memory_live_bytes_of_embree(void);

#ifdef __cplusplus
}
#endif

#endif
