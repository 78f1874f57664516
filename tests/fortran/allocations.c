/* SPDX-License-Identifier: Apache-2.0
 * Counts the allocations of Fortran code. The caller of such an allocation is gfortran's run-time library or the program, which
 * contains the Fortran modules. All allocations of the process call these functions, because symbols of a program come before
 * those of libraries. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* for dladdr, RTLD_DEFAULT */
#endif
#include <dlfcn.h>
#include <stdint.h>
#include <stdlib.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *p, size_t size);

void allocations_begin(void);
int64_t allocations_end(void);

static const void *program, *run_time; /* base addresses of the counted callers; NULL counts nothing */
static int64_t n_counted;

static void *counted(void *p, const void *caller_address) {
  const void *const begun = __atomic_load_n(&program, __ATOMIC_ACQUIRE);
  Dl_info info;
  if (begun && dladdr(caller_address, &info) && (info.dli_fbase == begun || info.dli_fbase == run_time))
    __atomic_fetch_add(&n_counted, 1, __ATOMIC_RELAXED);
  return p;
}

void *malloc(size_t size) { return counted(__libc_malloc(size), __builtin_return_address(0)); }
void *calloc(size_t n, size_t size) { return counted(__libc_calloc(n, size), __builtin_return_address(0)); }
void *realloc(void *p, size_t size) { return counted(__libc_realloc(p, size), __builtin_return_address(0)); }

static const void *object_of(const void *address) {
  Dl_info info;
  return address && dladdr(address, &info) ? info.dli_fbase : NULL;
}

void allocations_begin(void) {
  void *(*volatile here)(size_t) = malloc;
  run_time = object_of(dlsym(RTLD_DEFAULT, "_gfortran_internal_pack"));
  n_counted = 0;
  __atomic_store_n(&program, object_of((const void *)(uintptr_t)here), __ATOMIC_RELEASE);
}

/* Returns the number of allocations, or -1 if gfortran's library was not found. */
int64_t allocations_end(void) {
  __atomic_store_n(&program, NULL, __ATOMIC_RELEASE);
  return run_time ? n_counted : -1;
}
