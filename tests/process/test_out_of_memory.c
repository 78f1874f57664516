/* SPDX-License-Identifier: Apache-2.0
 * Every single allocation of the library's code fails once, and so does every request of Embree to its memory monitor. The call
 * must then return RIIS_OUT_OF_MEMORY, change nothing and leak nothing. If the call is repeated, the call must succeed. Some
 * allocations of long calls are skipped without RIIS_TEST_LONG=1. */
#include <riis/riis.h>

#include "test_support.h"

#include "failing_memory.h"
#include "handles.h"
#include "sanitized.h"
#include "searches.h"

/* --- Digests of the content of objects. Equal bits have equal digests. ------------------------------------ */

static riis_surface_options coarse; /* gives few triangles, for speed; must be set before a digest */

static inline uint64_t add_bytes(uint64_t digest, const void *data, size_t n) {
  const unsigned char *bytes = data;
  for (size_t i = 0; i < n; ++i) digest = (digest ^ bytes[i]) * UINT64_C(0x100000001b3);
  return digest;
}

static inline uint64_t add_surface(uint64_t digest, const riis_surface *surface) {
  const riis_triangles all = triangles_of(surface);
  const size_t n_vertices = (size_t)all.n_vertices, n_triangles = (size_t)all.n_triangles;
  const riis_surface_info info = info_of(surface);
  digest = add_bytes(digest, &info, offsetof(riis_surface_info, seconds_triangles));
  digest = add_bytes(digest, all.xyz, n_vertices * 24);
  if (all.uv) digest = add_bytes(digest, all.uv, n_vertices * 16);
  digest = add_bytes(digest, all.vertex_id, n_triangles * 24);
  digest = add_bytes(digest, all.leaflet_id, n_triangles * 4);
  digest = add_bytes(digest, all.patch_id, n_triangles * 4);
  for (int i = -3; i <= 3; ++i) {
    const riis_closest closest = closest_to(surface, 0.4 * i, 0.3, 0.2 * i);
    digest = add_bytes(digest, &closest, sizeof closest);
  }
  return digest;
}

static inline uint64_t add_valve(uint64_t digest, riis_valve *valve) {
  double opening;
  CHECK_OK(riis_valve_get(valve, "opening", 1, &opening));
  for (int half = 0; half <= 2; ++half) {
    riis_surface *surface = NULL;
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5 * half));
    const riis_status status = riis_surface_create(valve, &coarse, &surface);
    own(surface);
    digest = add_bytes(digest, &status, sizeof status); /* without an open state, the status is an error */
    if (!status) digest = add_surface(digest, surface);
    free_one_owned(surface);
  }
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  return add_bytes(digest, &opening, sizeof opening);
}

static inline uint64_t add_list(uint64_t digest, found_nodes found) {
  const size_t n = (size_t)found.n;
  digest = add_bytes(digest, &found.n, sizeof found.n);
  if (n == 0) return digest;
  digest = add_bytes(digest, found.node_id, n * 8);
  digest = add_bytes(digest, found.distance, n * 8);
  digest = add_bytes(digest, found.triangle_id, n * 8);
  return add_bytes(digest, found.leaflet_id, n * 4);
}

static inline uint64_t add_result(uint64_t digest, const riis_marks *result) {
  const riis_mark_stats stats = stats_of(result);
  const int64_t numbers[] = {stats.n_nodes, stats.n_marked, stats.n_within_limit, stats.search, stats.complete};
  digest = add_bytes(digest, numbers, sizeof numbers);
  return add_list(add_list(digest, marked_in(result)), within_in(result));
}

static inline uint64_t add_mesh(uint64_t digest, const riis_mesh *mesh) {
  const int owned_before = n_owned();
  riis_surface *surface = aortic_surface(&coarse);
  riis_mark_options options = mark_options();
  options.n_threads = 1;
  for (int32_t search = RIIS_SEARCH_EXHAUSTIVE; search <= RIIS_SEARCH_CLUSTERS; ++search) {
    riis_marks *result = new_result();
    options.search = search;
    const riis_status status = riis_mark_nodes(surface, mesh, &options, result);
    digest = add_bytes(digest, &status, sizeof status); /* the mesh may lack an adjacency */
    if (!status) digest = add_result(digest, result);
  }
  free_owned_after(owned_before);
  return digest;
}

#include "memory_scenarios.h"

/* --- One failure ----------------------------------------------------------------------------------------------------- */

static random_source rng;

static int64_t n_injected[4], n_calls_failed[4]; /* one for each owner of memory that can fail */

/* The state of all objects before and after the call. */
typedef struct reference {
  uint64_t before, after;
} reference;

typedef struct live {
  int64_t library, embree, embree_bytes;
} live;
static live live_now(void) {
  const live now = {memory_live_of_library(), memory_live_of_embree(), memory_live_bytes_of_embree()};
  return now;
}

static void check_status(const scenario *s, riis_status status, int64_t n) {
  if (status != RIIS_OUT_OF_MEMORY || strcmp(riis_last_error(), "out of memory") != 0)
    fail_msg("%s, allocation %lld: %s (%s)", s->name, (long long)n, riis_status_name(status), riis_last_error());
}

static void check_digest(const scenario *s, const world *w, uint64_t expected, const char *when, int64_t n) {
  if (digest_of(w) != expected) fail_msg("%s, allocation %lld: something else %s", s->name, (long long)n, when);
}

static int n_grown; /* how many calls have kept memory because they were the first of their kind */

/* Makes allocation n of the call fail, on new objects. Returns how many allocations failed, or 0 if the call makes fewer than
 * n. */
static int64_t try_one(const scenario *s, const reference *expected, int whose, int64_t n, int and_all_after,
                       int attempt) {
  const live before = live_now();
  world w = {.scenario = s};
  s->make(&w);
  /* A refused call sets another message first, so the test sees whether the failing call writes its own message. */
  assert_int_equal(riis_marks_create(NULL), RIIS_INVALID_ARGUMENT);
  memory_fail(whose, n, and_all_after);
  riis_status status = s->call(&w);
  const int64_t n_failed = memory_stop_failing();
  if (n_failed > 0) {
    n_injected[whose] += n_failed;
  }
  /* A call that went on without the memory is checked below. */
  if (n_failed > 0 && !((s->flags & MAY_GO_ON) && status == RIIS_OK)) {
    ++n_calls_failed[whose];
    check_status(s, status, n);
    /* A failure at allocation n has two variants. The first variant checks everything and then repeats the call. The second
     * variant repeats the call immediately. */
    if ((n + and_all_after) % 2 == 0 || (s->flags & IS_FIRST))
      check_digest(s, &w, expected->before, "after the failure", n);
    if (!(s->flags & IS_FIRST)) status = s->call(&w);
  }
  if (n_failed == 0 || !(s->flags & IS_FIRST)) {
    if (status) fail_msg("%s: %s", s->name, riis_last_error());
    if (expected->after) check_digest(s, &w, expected->after, "after the call", n);
  }
  destroy(&w);
  const live after = live_now();
  /* When a thread first works for Embree, Embree allocates memory for this thread and keeps it. TBB's threads may begin such work
   * at any time. Memory therefore counts as a leak only if it remains after each of several attempts. */
  if (after.embree == before.embree + 1 && after.library == before.library &&
      after.embree_bytes == before.embree_bytes && attempt < 5)
    return try_one(s, expected, whose, n, and_all_after, attempt + 1);
  const int grew = memcmp(&before, &after, sizeof before) != 0;
  /* A first call of its kind may allocate memory and keep it. The test accepts memory that stays only for one call of each
   * kind. */
  if (grew && (!(s->flags & IS_FIRST) || n_grown++ > 0))
    fail_msg("%s, allocation %lld: leaks %lld of the library's, %lld of Embree's, %lld bytes of Embree's", s->name,
             (long long)n, (long long)(after.library - before.library), (long long)(after.embree - before.embree),
             (long long)(after.embree_bytes - before.embree_bytes));
  return n_failed;
}

static reference reference_of(const scenario *s) {
  reference made;
  world w = {.scenario = s};
  s->make(&w);
  made.before = digest_of(&w);
  destroy(&w);
  made.after = 0;
  if (s->flags & IS_FIRST) return made; /* this scenario needs the first call of its kind, so there is no second call */
  s->make(&w);
  CHECK_OK(s->call(&w));
  made.after = digest_of(&w);
  destroy(&w);
  return made;
}

/* Each of the first allocations of a call fails, and then some random allocations fail. After allocation n, at most n / share
 * allocations are skipped. A call that samples a surface makes more than a thousand allocations, and each trial is slow with a
 * sanitizer. */
#if defined(IS_SANITIZED)
enum { n_first = 4, share = 1, n_of_workers = 1 };
#else
enum { n_first = 64, share = 16, n_of_workers = 3 };
#endif

/* Makes allocations 1, 2, ... fail until the call makes no more allocations. Returns the last number that failed. */
static int64_t try_all(const scenario *s, int whose) {
  const reference expected = reference_of(s);
  const int is_whole = is_long_test();
  n_grown = 0;
  for (int64_t n = 1, last = 0;;
       last = n, n += is_whole || n <= n_first ? 1 : 1 + (int64_t)(random_bits(&rng) % (uint64_t)(n / share)))
    if (try_one(s, &expected, whose, n, 1, 1) == 0 || try_one(s, &expected, whose, n, 0, 1) == 0) return last;
}

/* --- The tests ------------------------------------------------------------------------------------------------------- */

TEST(the_librarys_memory_runs_out) {
  for (int i = 0; i < n_scenarios; ++i) {
    const int64_t n = try_all(scenarios + i, MEMORY_OF_LIBRARY);
    printf("%s: allocations to the %lld. failed\n", scenarios[i].name, (long long)n);
    if ((n == 0) != ((scenarios[i].flags & ALLOCATES_NONE) != 0)) fail_msg("%s: %lld", scenarios[i].name, (long long)n);
  }
}

TEST(embrees_memory_runs_out) {
  for (int i = 0; i < n_scenarios; ++i) {
    if (!(scenarios[i].flags & MAKES_A_SCENE)) continue;
    const int64_t n = try_all(scenarios + i, MEMORY_OF_EMBREE);
    printf("%s: %lld times asked\n", scenarios[i].name, (long long)n);
    assert_true(n > 0);
  }
  assert_int_equal(memory_live_bytes_of_embree(), 0);
}

/* Chance decides which thread does which work. The test therefore repeats the call until another thread allocates. The mesh is
 * large enough to give work to all threads. */
TEST(memory_of_other_threads_runs_out) {
  set_nodes(is_short_test() ? 32 : 45);
  for (int i = 0; i < n_scenarios; ++i) {
    const scenario *s = scenarios + i;
    if (!(s->flags & ON_WORKERS)) continue;
    const reference expected = reference_of(s);
    int64_t n_failed = 0, n_tries = 0;
    for (; n_failed < n_of_workers && n_tries < 2000; ++n_tries)
      n_failed += try_one(s, &expected, MEMORY_OF_WORKERS, 1 + n_tries % 3, 0, 1);
    printf("%s: %lld failures in %lld tries\n", s->name, (long long)n_failed, (long long)n_tries);
    /* The calling thread may end a short loop before other threads begin. A walk of the paper's search is also short. */
    const int is_short = (s->flags & IS_SHORT) || s->search == RIIS_SEARCH_PAPER;
    if (n_failed < 1 && !is_short) fail_msg("%s: no other thread allocated", s->name);
  }
}

/* All allocations fail, including those for the C++ library's exceptions and for the message. */
TEST(all_memory_runs_out) {
  if (!memory_of_all_can_fail()) skip();
  for (int i = 0; i < n_scenarios; ++i) {
    const scenario *s = scenarios + i;
    if (s->n_threads > 1 || (s->flags & (ALLOCATES_NONE | IS_FIRST))) continue;
    const reference expected = reference_of(s);
    if (try_one(s, &expected, MEMORY_OF_ALL, 1, 1, 1) == 0) fail_msg("%s: nothing failed", s->name);
  }
  riis_valve *valve = NULL;
  CHECK_OK(riis_valve_create("aortic", &valve));
  memory_fail(MEMORY_OF_ALL, 1, 1);
  const riis_status status = riis_valve_set_scalar(valve, "leaflet_angle", 1e9);
  assert_true(memory_stop_failing() > 0);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'leaflet_angle' is 1e+09", status);
  riis_valve_destroy(&valve);
}

/* The requests are valid, but no machine has enough memory for them. */
TEST(requests_beyond_any_memory_are_refused) {
  const int64_t n = INT64_C(1) << 56;
  const int32_t ids[4] = {0, 1, 2, 3};
  riis_adjacency *adjacency = NULL;
  riis_mesh_cells cells;
  riis_mesh_faces between;
  CHECK_REFUSED(RIIS_OUT_OF_MEMORY, "out of memory", riis_adjacency_create_from_grid(n, 1, 1, 2, &adjacency));
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "more than memory can hold",
                riis_adjacency_create_from_grid(INT64_C(1) << 30, INT64_C(1) << 30, 4, 2, &adjacency));
  CHECK_OK(riis_mesh_cells_init(&cells, sizeof cells));
  cells.n_nodes = n;
  cells.n_cells = 1;
  cells.node_ids = ids;
  CHECK_REFUSED(RIIS_OUT_OF_MEMORY, "out of memory", riis_adjacency_create_from_cells(&cells, &adjacency));
  CHECK_OK(riis_mesh_faces_init(&between, sizeof between));
  between.n_cells = n;
  between.n_faces = 1;
  between.owner = ids;
  between.neighbor = ids + 1;
  CHECK_REFUSED(RIIS_OUT_OF_MEMORY, "out of memory", riis_adjacency_create_from_faces(&between, &adjacency));
  assert_null(adjacency);
}

static int set_up(void **state) {
  (void)state;
  coarse = surface_options();
  coarse.tolerance = 1;
  set_nodes(is_short_test() ? 12 : 18);
  fewer_nodes = lattice_of(9);
  keep_owned_for_group();
  strip = malloc(4 * n_cells * sizeof *strip);
  for (int32_t i = 0; i < 4 * n_cells; ++i) strip[i] = i / 4 + i % 4;
  return 0;
}

static int tear_down(void **state) {
  free(mask), free(labels), free(marks), free(side);
  free(strip);
  printf(
      "%d scenarios; failures injected: %lld of the library's own allocations, %lld of those on other threads, %lld of "
      "Embree's; calls that failed of it: %lld, %lld, %lld, all with RIIS_OUT_OF_MEMORY\n",
      n_scenarios, (long long)n_injected[0], (long long)n_injected[1], (long long)n_injected[2],
      (long long)n_calls_failed[0], (long long)n_calls_failed[1], (long long)n_calls_failed[2]);
  return free_owned_of_group(state);
}

int main(void) {
  rng = random_start("test_out_of_memory");
  return run_cases(set_up, tear_down);
}
