/* SPDX-License-Identifier: Apache-2.0
 * If a step finds the nodes of the last step again, it allocates nothing, whatever the search. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* for dladdr, RTLD_DEFAULT */
#endif
#include <dlfcn.h>
#include <execinfo.h>
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "sanitized.h"
#include "searches.h"

/* All allocations of the process call these functions, because symbols of an executable come before those of libraries. The
 * functions count the allocations of the object that contains riis_mark_nodes. Allocations that the C++ library makes for this
 * object also count. With a sanitizer the functions are not replaced, because the sanitizer's allocator must be the only one. */
#if defined(__GLIBC__) && defined(__x86_64__) && !defined(IS_SANITIZED)
#define COUNTS_ALLOCATIONS 1
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *p, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static const void *counted_object; /* the object whose allocations count, or NULL to count nothing */
static const void *cxx_library;
static int64_t n_counted;

static const void *object_at(const void *address) {
  Dl_info info;
  return dladdr(address, &info) ? info.dli_fbase : NULL;
}

/* Returns the object on the call stack that called the C++ library, or NULL if there is none. */
static const void *object_behind_cxx(void) {
  void *frames[16];
  const int n = backtrace(frames, 16);
  int i = 0;
  while (i < n && object_at(frames[i]) != cxx_library) ++i;
  while (i < n && object_at(frames[i]) == cxx_library) ++i;
  return i < n ? object_at(frames[i]) : NULL;
}

static void *counted(void *p, const void *caller_address) {
  const void *const object = __atomic_load_n(&counted_object, __ATOMIC_ACQUIRE);
  if (!object) return p;
  const void *caller = object_at(caller_address);
  if (caller == cxx_library) caller = object_behind_cxx();
  if (caller == object) __atomic_fetch_add(&n_counted, 1, __ATOMIC_RELAXED);
  return p;
}

void *malloc(size_t size) { return counted(__libc_malloc(size), __builtin_return_address(0)); }
void *calloc(size_t n, size_t size) { return counted(__libc_calloc(n, size), __builtin_return_address(0)); }
void *realloc(void *p, size_t size) { return counted(__libc_realloc(p, size), __builtin_return_address(0)); }
void *aligned_alloc(size_t alignment, size_t size) {
  return counted(__libc_memalign(alignment, size), __builtin_return_address(0));
}

/* The C++ operators new and new[], plain and for aligned types. */
void *new_one(size_t size) __asm__("_Znwm");
void *new_many(size_t size) __asm__("_Znam");
void *new_aligned(size_t size, size_t alignment) __asm__("_ZnwmSt11align_val_t");
void *new_many_aligned(size_t size, size_t alignment) __asm__("_ZnamSt11align_val_t");

static void *or_abort(void *p) { return p ? p : (abort(), p); } /* C cannot throw, so this aborts */
void *new_one(size_t size) { return counted(or_abort(__libc_malloc(size ? size : 1)), __builtin_return_address(0)); }
void *new_many(size_t size) { return counted(or_abort(__libc_malloc(size ? size : 1)), __builtin_return_address(0)); }
void *new_aligned(size_t size, size_t alignment) {
  return counted(or_abort(__libc_memalign(alignment, size ? size : 1)), __builtin_return_address(0));
}
void *new_many_aligned(size_t size, size_t alignment) {
  return counted(or_abort(__libc_memalign(alignment, size ? size : 1)), __builtin_return_address(0));
}

/* Returns the object that contains the function. If the library is static, the name is not found. A function without a name
 * belongs to the object of this code. */
static const void *object_of(const char *name) {
  const void *function = dlsym(RTLD_DEFAULT, name);
  return object_at(function ? function : (const void *)(intptr_t)object_of);
}

static void begin_to_count(void) {
  n_counted = 0;
  cxx_library = object_of("_ZSt9terminatev");
  object_behind_cxx(); /* the first call allocates, so it is made before the count */
  __atomic_store_n(&counted_object, object_of("riis_mark_nodes"), __ATOMIC_RELEASE);
}

static int64_t end_to_count(void) {
  __atomic_store_n(&counted_object, NULL, __ATOMIC_RELEASE);
  return n_counted;
}

static int64_t allocations_of_a_step(const riis_surface *surface, const riis_mesh *mesh,
                                     const riis_mark_options *options, riis_marks *result) {
  begin_to_count();
  const riis_status status = riis_mark_nodes(surface, mesh, options, result);
  const int64_t n = end_to_count();
  CHECK_OK(status);
  return n;
}

/* A valve that opens and closes, with velocity, all fields and K. */
typedef struct moving_valve {
  riis_valve *now, *before;
  riis_surface *surface;
  riis_mesh *mesh;
  riis_marks *result;
  riis_mark_options options;
  double *k, *k_u;
  int64_t n_nodes;
} moving_valve;

/* Makes a moving valve. Without velocities, riis_surface_update updates the surface. */
static moving_valve moving_valve_of(const char *kind, int has_open_state, int32_t triangulation, int has_velocity,
                                    int32_t n_threads) {
  moving_valve made = {.now = new_valve(kind), .result = new_result(), .options = mark_options()};
  if (has_open_state) {
    riis_valve *open = new_valve(kind);
    CHECK_OK(riis_valve_set_scalar(open, "leaflet_radius_in", 1));
    CHECK_OK(riis_valve_set_scalar(open, "bending_radius_in", 1.1));
    CHECK_OK(riis_valve_set_open_state(made.now, open));
  }
  CHECK_OK(riis_valve_copy(made.now, &made.before));
  own(made.before);
  riis_surface_options options = surface_options();
  options.triangulation = triangulation;
  options.n_threads = n_threads;
  made.surface = new_surface(made.now, &options);
  test_mesh nodes = lattice_around(made.surface, 0.15, 0.5);
  made.mesh = mesh_from(&nodes);
  made.n_nodes = nodes.n;
  made.options.n_threads = n_threads;
  made.options.fields = has_velocity ? 255 : 255 - RIIS_FIELD_VELOCITY;
  made.k = own(calloc((size_t)nodes.n, sizeof *made.k));
  made.k_u = own(calloc(3 * (size_t)nodes.n, sizeof *made.k_u));
  return made;
}

/* Opens and closes the valve in 40 steps, and counts all allocations. */
static int64_t allocations_of_a_cycle(moving_valve *valve) {
  riis_resistance resistance;
  int64_t n = 0;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 1e4;
  for (int i = 0; i < 40; ++i) {
    CHECK_OK(riis_valve_set_scalar(valve->before, "opening", fabs(1 - 0.05 * i)));
    CHECK_OK(riis_valve_set_scalar(valve->now, "opening", fabs(1 - 0.05 * (i + 1))));
    begin_to_count();
    const int has_velocity = (valve->options.fields & RIIS_FIELD_VELOCITY) != 0;
    const riis_status moved =
        has_velocity ? riis_surface_update_moving(valve->surface, valve->now, valve->before, 0.02, NULL, NULL)
                     : riis_surface_update(valve->surface, valve->now, NULL);
    const riis_status marked = riis_mark_nodes(valve->surface, valve->mesh, &valve->options, valve->result);
    const riis_status added =
        add_resistance_to(valve->result, &resistance, valve->n_nodes, valve->k, has_velocity ? valve->k_u : NULL);
    n += end_to_count();
    CHECK_OK(moved);
    CHECK_OK(marked);
    CHECK_OK(added);
  }
  return n;
}
#endif

TEST(a_steady_step_allocates_nothing) {
#if defined(COUNTS_ALLOCATIONS)
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.09, 0.2);
  for (int kind = 0; kind < 4; ++kind)
    for (int32_t search = RIIS_SEARCH_EXHAUSTIVE; search <= RIIS_SEARCH_CLUSTERS; ++search) {
      const int owned_before = n_owned();
      riis_mesh *mesh = mesh_from(&nodes);
      riis_marks *result = new_result();
      riis_mark_options options = mark_options();
      options.search = search;
      options.n_threads = 1;
      if (kind % 2) options.distance_limit = 0.2;
      if (kind / 2) options.fields = 255 - RIIS_FIELD_VELOCITY; /* all fields that the surface has: no velocity */
      /* The first step allocates memory, which shows that allocations are counted, also those of vectors and of aligned
       * memory. */
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

/* After the first cycles, the library holds all the memory that it needs. Embree's own allocations do not count. */
TEST(a_steady_moving_step_allocates_nothing) {
#if defined(COUNTS_ALLOCATIONS)
  static const char *const kinds[6] = {"aortic", "trileaflet", "mitral", "bileaflet", "aortic", "coapting"};
  for (int kind = 0; kind < 6; ++kind)
    for (int32_t triangulation = RIIS_TRIANGULATION_ADAPTED; triangulation <= RIIS_TRIANGULATION_FIXED; ++triangulation)
      for (int has_velocity = 0; has_velocity < 2; ++has_velocity) {
        const int owned_before = n_owned();
        moving_valve valve = moving_valve_of(kinds[kind], kind == 4, triangulation, has_velocity, 1);
        assert_true(allocations_of_a_cycle(&valve) > 40);
        for (int cycle = 2; cycle <= 3; ++cycle) allocations_of_a_cycle(&valve);
        for (int cycle = 4; cycle <= 5; ++cycle) assert_int_equal(allocations_of_a_cycle(&valve), 0);
        free_owned_after(owned_before);
      }
#else
  skip();
#endif
}

/* In each step, the moving annulus gives new targets for 200 landmarks, for two valves in turn. After two steps, each valve has
 * allocated all the memory that it needs. The adapted triangulation needs most triangles at some time of the beat, so its surface
 * has all memory only after one beat. */
TEST(a_steady_warped_step_allocates_nothing) {
#if defined(COUNTS_ALLOCATIONS)
  static const char *const kinds[4] = {"trileaflet", "aortic", "mitral", "coapting"};
  enum { n = 200, n_of_beat = 40 };
  for (int kind = 0; kind < 4; ++kind)
    for (int32_t triangulation = RIIS_TRIANGULATION_ADAPTED; triangulation <= RIIS_TRIANGULATION_FIXED;
         ++triangulation) {
      const int owned_before = n_owned();
      riis_valve *valves[2] = {new_valve(kinds[kind]), new_valve(kinds[kind])};
      riis_surface_options options = surface_options();
      options.triangulation = triangulation;
      options.n_threads = 1;
      double sources[3 * n], targets[3 * n];
      for (int i = 0; i < n; ++i) {
        const double angle = 0.7 * i, height = -1 + 2.0 * i / n;
        sources[3 * i] = 1.5 * cos(angle), sources[3 * i + 1] = 1.5 * sin(angle), sources[3 * i + 2] = height;
      }
      riis_points points;
      CHECK_OK(riis_points_init(&points, sizeof points));
      points.n_points = n, points.stride = 3;
      points.x = sources, points.y = sources + 1, points.z = sources + 2;
      riis_warp *warp = NULL;
      riis_warp_options of_warp;
      CHECK_OK(riis_warp_options_init(&of_warp, sizeof of_warp));
      of_warp.noise = kind == 0 ? 0 : 0.01;
      CHECK_OK(riis_warp_create(&points, &of_warp, &warp));
      own(warp);
      for (int k = 0; k < 2; ++k) CHECK_OK(riis_valve_set_warp(valves[k], warp, NULL));
      riis_surface *surface = new_surface(valves[0], &options);
      points.x = targets, points.y = targets + 1, points.z = targets + 2;
      for (int step = 0; step < 3 * n_of_beat; ++step) {
        const double swing = 0.05 * sin(2 * acos(-1) * step / n_of_beat);
        for (int i = 0; i < n; ++i)
          for (int c = 0; c < 3; ++c)
            targets[3 * i + c] =
                sources[3 * i + c] * (1 + swing * (c == 0)) + 0.2 * swing * sources[3 * i] * sources[3 * i];
        riis_valve *now = valves[step % 2], *before = valves[1 - step % 2];
        begin_to_count();
        const riis_status targeted = riis_warp_set_targets(warp, &points);
        const riis_status warped = riis_valve_set_warp(now, warp, NULL);
        const riis_status moved = riis_surface_update_moving(surface, now, before, 0.02, NULL, NULL);
        const int64_t n_allocations = end_to_count();
        CHECK_OK(targeted);
        CHECK_OK(warped);
        CHECK_OK(moved);
        if (step >= (triangulation == RIIS_TRIANGULATION_FIXED ? 4 : n_of_beat)) assert_int_equal(n_allocations, 0);
      }
      free_owned_after(owned_before);
    }
#else
  skip();
#endif
}

/* Threads may at some moment need more blocks at once than before, but the number of blocks is limited. */
TEST(allocations_of_several_threads_do_not_grow) {
#if defined(COUNTS_ALLOCATIONS)
  for (int32_t n_threads = 2; n_threads <= 4; n_threads += 2) {
    const int owned_before = n_owned();
    moving_valve valve = moving_valve_of("mitral", 0, RIIS_TRIANGULATION_ADAPTED, 1, n_threads);
    int64_t n = 0;
    for (int cycle = 1; cycle <= 3; ++cycle) allocations_of_a_cycle(&valve);
    for (int cycle = 4; cycle <= 6; ++cycle) n += allocations_of_a_cycle(&valve);
    printf("%d threads: %lld allocations in 120 steps\n", (int)n_threads, (long long)n);
    CHECK_AT_MOST((double)n, 120);
    free_owned_after(owned_before);
  }
#else
  skip();
#endif
}

int main(void) { return run_cases(NULL, NULL); }
