/* SPDX-License-Identifier: Apache-2.0
 * Memory that runs out when a test says so. An executable with failing_memory.cpp in it has its own operator new, and with it all
 * C++ code of the process; what the library's own code allocates is told from what others do by the return address. Embree asks
 * through its memory monitor, which a rtcNewDevice of the executable's own sets. */
#ifndef RIIS_TEST_FAILING_MEMORY_H
#define RIIS_TEST_FAILING_MEMORY_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
  MEMORY_OF_LIBRARY = 0, /* operator new called by the library's code, on any thread */
  MEMORY_OF_WORKERS = 1, /* the same on all threads but the one that calls memory_fail */
  MEMORY_OF_EMBREE = 2,  /* what Embree asks its memory monitor for */
  MEMORY_OF_ALL = 3      /* malloc, too, whoever calls it; not with sanitizers, which have their own */
};

/* Whose the library's own code is: that of the object with this function. The core's, by default. */
void memory_library_is_that_of(const char *function);

/* From now on allocation number n (1, 2, ...) fails, and if and_all_after is not 0 those that follow it, too. */
void memory_fail(int whose, int64_t n, int and_all_after);
/* From now on none fails. Returns how many have failed. */
int64_t memory_stop_failing(void);
/* 1 if MEMORY_OF_ALL can fail. */
int memory_of_all_can_fail(void);

/* What the library's own code has allocated and not yet freed: the number of allocations. */
int64_t memory_live_of_library(void);
/* The same of Embree: C++ allocations, and bytes by its memory monitor. */
int64_t memory_live_of_embree(void);
int64_t memory_live_bytes_of_embree(void);

#ifdef __cplusplus
}
#endif

#endif
