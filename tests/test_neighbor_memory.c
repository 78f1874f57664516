/* SPDX-License-Identifier: Apache-2.0
 * A step that finds what the last one found allocates nothing, whatever the search. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* dladdr, RTLD_DEFAULT */
#endif
#include <dlfcn.h>
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "sanitized.h"
#include "searches.h"

/* All allocations of the process come by here, because an executable's symbols go before those of the libraries. Those of the
 * object that has riis_mark_nodes are counted. A sanitizer's allocator must be the only one. */
#if defined(__GLIBC__) && defined(__x86_64__) && !defined(IS_SANITIZED)
#define COUNTS_ALLOCATIONS 1
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *p, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static const void *counted_object; /* NULL: nothing is counted */
static int64_t n_counted;

static void *counted(void *p, const void *caller_address) {
  const void *const object = __atomic_load_n(&counted_object, __ATOMIC_ACQUIRE);
  Dl_info info;
  if (object && dladdr(caller_address, &info) && info.dli_fbase == object)
    __atomic_fetch_add(&n_counted, 1, __ATOMIC_RELAXED);
  return p;
}

void *malloc(size_t size) { return counted(__libc_malloc(size), __builtin_return_address(0)); }
void *calloc(size_t n, size_t size) { return counted(__libc_calloc(n, size), __builtin_return_address(0)); }
void *realloc(void *p, size_t size) { return counted(__libc_realloc(p, size), __builtin_return_address(0)); }
void *aligned_alloc(size_t alignment, size_t size) {
  return counted(__libc_memalign(alignment, size), __builtin_return_address(0));
}

/* operator new, new[], and both for aligned types. */
void *new_one(size_t size) __asm__("_Znwm");
void *new_many(size_t size) __asm__("_Znam");
void *new_aligned(size_t size, size_t alignment) __asm__("_ZnwmSt11align_val_t");
void *new_many_aligned(size_t size, size_t alignment) __asm__("_ZnamSt11align_val_t");

static void *or_abort(void *p) { return p ? p : (abort(), p); } /* C cannot throw */
void *new_one(size_t size) { return counted(or_abort(__libc_malloc(size ? size : 1)), __builtin_return_address(0)); }
void *new_many(size_t size) { return counted(or_abort(__libc_malloc(size ? size : 1)), __builtin_return_address(0)); }
void *new_aligned(size_t size, size_t alignment) {
  return counted(or_abort(__libc_memalign(alignment, size ? size : 1)), __builtin_return_address(0));
}
void *new_many_aligned(size_t size, size_t alignment) {
  return counted(or_abort(__libc_memalign(alignment, size ? size : 1)), __builtin_return_address(0));
}

static int64_t allocations_of_a_step(const riis_surface *surface, const riis_mesh *mesh,
                                     const riis_mark_options *options, riis_mark_result *result) {
  Dl_info info;
  void *function = dlsym(RTLD_DEFAULT, "riis_mark_nodes");
  assert_non_null(function);
  assert_true(dladdr(function, &info) != 0);
  n_counted = 0;
  __atomic_store_n(&counted_object, info.dli_fbase, __ATOMIC_RELEASE);
  const riis_status status = riis_mark_nodes(surface, mesh, options, result);
  __atomic_store_n(&counted_object, NULL, __ATOMIC_RELEASE);
  CHECK_OK(status);
  return n_counted;
}
#endif

static void a_steady_step_allocates_nothing(void **state) {
  (void)state;
#if defined(COUNTS_ALLOCATIONS)
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.09, 0.2);
  for (int kind = 0; kind < 4; ++kind)
    for (int32_t search = RIIS_SEARCH_EXHAUSTIVE; search <= RIIS_SEARCH_CLUSTERS; ++search) {
      const int owned_before = n_owned();
      riis_mesh *mesh = mesh_from(&nodes);
      riis_mark_result *result = new_result();
      riis_mark_options options = mark_options();
      options.search = search;
      options.n_threads = 1;
      if (kind % 2) options.distance_limit = 0.2;
      if (kind / 2) options.fields = 255 - RIIS_FIELD_VELOCITY; /* all that the surface has */
      /* The first makes room: it shows that allocations are seen, vectors' and aligned ones. */
      assert_true(allocations_of_a_step(surface, mesh, &options, result) > 5);
      allocations_of_a_step(surface, mesh, &options, result);
      for (int step = 3; step <= 5; ++step) assert_int_equal(allocations_of_a_step(surface, mesh, &options, result), 0);
      assert_true(marked_in(result).n > 1000);
      free_owned_after(owned_before);
    }
#else
  skip();
#endif
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_steady_step_allocates_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
