/* SPDX-License-Identifier: Apache-2.0
 * Results do not depend on the caller's environment, and the library does not change this environment. The cases are
 * floating-point traps, rounding, flush-to-zero, OpenMP settings, parallel regions, errors and logs of several threads, and
 * standard output and error. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* for feenableexcept */
#endif
#include <fenv.h>
#include <omp.h>
#include <riis/riis.h>
#include <unistd.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "test_support.h"

#include "handles.h"
#include "searches.h"

enum { n = 20000 };
static double nodes[3 * n];

/* Returns a number that depends on every bit of a step's results. */
static uint64_t digest_of_a_step(int threads) {
  const int owned_before = n_owned();
  riis_surface *surface = aortic_surface(NULL);
  riis_mark_options options = mark_options();
  uint64_t digest = 14695981039346656037u;
  options.n_threads = threads;
  options.distance_limit = 0.3;
  riis_mesh *mesh = mesh_of(n, nodes);
  riis_marks *result = new_result();
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  const int64_t n_listed = within_list(result).n_nodes;
  const int64_t *node_id = within_list(result).node_id;
  const double *distance = within_list(result).distance;
  const int64_t *triangle_id = within_list(result).triangle_id;
  for (int64_t i = 0; i < n_listed; ++i) {
    uint64_t bits;
    memcpy(&bits, distance + i, sizeof bits);
    digest = (digest ^ bits) * 1099511628211u;
    digest = (digest ^ (uint64_t)node_id[i] ^ ((uint64_t)triangle_id[i] << 32)) * 1099511628211u;
  }
  free_owned_after(owned_before);
  return digest;
}

static uint64_t expected;

TEST(traps_do_not_fire_and_stay) {
  if (feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW) == -1) skip(); /* most ARM processors have no traps */
  const uint64_t got = digest_of_a_step(2);
  const int traps = fegetexcept();
  fedisableexcept(FE_ALL_EXCEPT);
  assert_true(got == expected);
  assert_int_equal(traps, FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
}

TEST(rounding_mode_does_not_matter_and_stays) {
  fesetround(FE_UPWARD);
  const uint64_t got = digest_of_a_step(2);
  const int mode = fegetround();
  fesetround(FE_TONEAREST);
  assert_true(got == expected);
  assert_int_equal(mode, FE_UPWARD);
}

TEST(flush_to_zero_stays) {
#if defined(__SSE2__)
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040); /* the bits that code compiled with -ffast-math sets */
  const uint64_t got = digest_of_a_step(2);
  const unsigned after = _mm_getcsr();
  _mm_setcsr(before);
  assert_true(got == expected);
  assert_int_equal(after & 0x8040, 0x8040);
#elif defined(__aarch64__)
  const uint64_t bits = UINT64_C(3) << 24; /* flush-to-zero, and default NaN */
  uint64_t before, after;
  __asm__ volatile("mrs %0, fpcr" : "=r"(before));
  __asm__ volatile("msr fpcr, %0" : : "r"(before | bits));
  const uint64_t got = digest_of_a_step(2);
  __asm__ volatile("mrs %0, fpcr" : "=r"(after));
  __asm__ volatile("msr fpcr, %0" : : "r"(before));
  assert_true(got == expected);
  assert_true((after & bits) == bits);
#else
  skip();
#endif
}

TEST(openmp_settings_stay) {
  omp_set_num_threads(3);
  omp_set_dynamic(0);
  omp_set_schedule(omp_sched_guided, 7);
  assert_true(digest_of_a_step(2) == expected);
  omp_sched_t kind;
  int chunk;
  omp_get_schedule(&kind, &chunk);
  assert_int_equal(omp_get_max_threads(), 3);
  assert_int_equal(kind, omp_sched_guided);
  assert_int_equal(chunk, 7);
}

/* Each of the caller's threads marks separately. All threads read one surface and one mesh. */
TEST(works_inside_a_parallel_region) {
  int n_wrong = 0;
#pragma omp parallel for num_threads(3) reduction(+ : n_wrong)
  for (int i = 0; i < 6; ++i) n_wrong += digest_of_a_step(i % 3) != expected;
  assert_int_equal(n_wrong, 0);

  riis_surface *surface = aortic_surface(NULL);
  riis_mesh *mesh = mesh_of(n, nodes);
  int64_t counts[8];
#pragma omp parallel for num_threads(4)
  for (int i = 0; i < 8; ++i) {
    riis_marks *result = NULL;
    counts[i] = -1;
    if (riis_marks_create(&result) == RIIS_OK && riis_mark_nodes(surface, mesh, NULL, result) == RIIS_OK)
      counts[i] = marked_list(result).n_nodes;
    riis_marks_destroy(&result);
    /* The first query with a side makes the data for sides, on whichever thread the query runs. */
    riis_closest closest;
    if (riis_closest_point(surface, nodes + 3 * i, &closest, sizeof closest) != RIIS_OK) counts[i] = -2;
  }
  for (int i = 1; i < 8; ++i) assert_int_equal(counts[i], counts[0]);
  assert_true(counts[0] > 0);
}

TEST(errors_belong_to_their_thread) {
  char texts[4][64];
#pragma omp parallel num_threads(4)
  {
    const int t = omp_get_thread_num();
    riis_mesh *mesh = NULL;
    for (int i = 0; i < 1000; ++i) riis_mesh_create(-1 - t, nodes, nodes, nodes, 1, &mesh);
    snprintf(texts[t], sizeof texts[t], "%s", riis_last_error());
  }
  for (int t = 0; t < 4; ++t) {
    char part[32];
    snprintf(part, sizeof part, "n_nodes is %d;", -1 - t);
    assert_non_null(strstr(texts[t], part));
  }
  /* A successful call does not change the message. */
  riis_valve *valve = NULL;
  assert_true(riis_valve_create("none", &valve) != RIIS_OK);
  valve = new_valve("aortic");
  free_one_owned(valve);
  assert_non_null(strstr(riis_last_error(), "'none'"));
}

static void log_line(void *user_data, int32_t level, const char *message) {
  char *to = user_data;
  if (level == RIIS_LOG_INFO && strstr(message, "triangles")) snprintf(to, 256, "%s", message);
}

TEST(log_goes_to_the_callers_function_only) {
  char line[256] = "";
  riis_set_log(log_line, line);
  riis_surface *surface = aortic_surface(NULL);
  assert_non_null(strstr(line, "surface: "));
  assert_null(strchr(line, '\n'));
  riis_set_log(NULL, NULL);
  line[0] = 0;
  free_one_owned(surface);
  surface = aortic_surface(NULL);
  free_one_owned(surface);
  assert_string_equal(line, "");
}

/* Both standard streams are redirected to a file during a step and a refusal. The file must stay empty. */
TEST(nothing_is_printed) {
  FILE *file = tmpfile();
  assert_non_null(file);
  fflush(stdout);
  fflush(stderr);
  const int out = dup(1), err = dup(2);
  dup2(fileno(file), 1);
  dup2(fileno(file), 2);
  const uint64_t got = digest_of_a_step(2);
  riis_valve *valve = NULL;
  const riis_status refused = riis_valve_create("none", &valve);
  fflush(stdout);
  fflush(stderr);
  dup2(out, 1);
  dup2(err, 2);
  close(out);
  close(err);
  fseek(file, 0, SEEK_END);
  const long size = ftell(file);
  fclose(file);
  assert_true(got == expected);
  assert_int_equal(refused, RIIS_INVALID_PARAMETER);
  assert_int_equal(size, 0);
}

int main(void) {
  random_source rng = random_start("test_environment");
  for (int i = 0; i < n; ++i) {
    nodes[3 * i] = random_between(&rng, -1.6, 1.6);
    nodes[3 * i + 1] = random_between(&rng, -1.6, 1.6);
    nodes[3 * i + 2] = random_between(&rng, -1.2, 0.3);
  }
  expected = digest_of_a_step(1);
  return run_cases(NULL, NULL);
}
