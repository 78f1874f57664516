/* SPDX-License-Identifier: Apache-2.0
 * Tests failures inside the library that a caller cannot cause. Exceptions become a status and a message. If memory runs out, all
 * objects stay as they were. */
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "internals.h"
#include "test_support.h"

#include "handles.h"
#include "sanitized.h"

enum { limit_is_ignored = 77 };

/* Returns whether a child process can exceed its limit of address space. Emulators ignore the limit, because they need memory
 * themselves. */
static int exceeds_limit(const struct rlimit *limit) {
  const size_t size = (size_t)limit->rlim_cur;
  void *memory = mmap(NULL, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) return 0;
  munmap(memory, size);
  return 1;
}

/* Updates a surface in a child process with little address space left. An update that needs much more space is refused, and the
 * surface stays as it was. Returns 0 if this holds. */
static int update_without_memory(void) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_surface_info before, after;
  riis_surface_options options;
  struct rlimit limit;
  long pages = 0;
  FILE *statm = fopen("/proc/self/statm", "r");
  if (!statm || fscanf(statm, "%ld", &pages) != 1) return 1;
  fclose(statm);
  if (riis_valve_create("aortic", &valve) || riis_surface_create(valve, NULL, &surface)) return 2;
  if (riis_surface_options_init(&options, sizeof options)) return 3;
  riis_surface_get_info(surface, &before, sizeof before);
  options.tolerance = 1e-4; /* makes 3.5 million triangles */
  getrlimit(RLIMIT_AS, &limit);
  const rlim_t unlimited = limit.rlim_cur;
  limit.rlim_cur = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE) + ((rlim_t)160 << 20);
  setrlimit(RLIMIT_AS, &limit);
  if (exceeds_limit(&limit)) return limit_is_ignored;
  if (riis_surface_update(surface, valve, &options) != RIIS_OUT_OF_MEMORY) return 4;
  if (strcmp(riis_last_error(), "out of memory") != 0) return 5;
  limit.rlim_cur = unlimited; /* the checks below may need memory that other threads have taken meanwhile */
  setrlimit(RLIMIT_AS, &limit);
  riis_surface_get_info(surface, &after, sizeof after);
  if (memcmp(&before, &after, sizeof before) != 0) return 6;
  const double origin[3] = {0, 0, 0};
  riis_closest closest;
  if (riis_closest_point(surface, origin, &closest, sizeof closest)) return 7;
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return 0;
}

/* This check also runs in a child process. The valve has many patches, and the first patch already has too many quads. The
 * library makes the curves of a few patches before it counts the quads. The curves of all patches would need a gigabyte. Returns
 * 0 if the library makes only a few. */
static int refusal_with_little_memory(void) {
  enum { n_patches = 200, n_curves = 4 * n_patches };
  static const double ends[4][4] = {{0, 0, 1, 0}, {0, 1, 1, 1}, {0, 0, 0, 1}, {1, 0, 1, 1}};
  static int32_t degree[n_curves], curve_id[n_curves];
  static double control[12 * n_curves];
  riis_patches patches;
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_surface_options options;
  struct rlimit limit;
  long pages = 0;
  for (int i = 0; i < n_curves; ++i) {
    degree[i] = 3, curve_id[i] = i;
    for (int k = 0; k < 4; ++k) {
      control[12 * i + 3 * k] = ends[i % 4][0] + (ends[i % 4][2] - ends[i % 4][0]) * k / 3;
      control[12 * i + 3 * k + 1] = ends[i % 4][1] + (ends[i % 4][3] - ends[i % 4][1]) * k / 3;
      control[12 * i + 3 * k + 2] = k == 1 || k == 2 ? 0.5 : 0;
    }
  }
  if (riis_patches_init(&patches, sizeof patches) || riis_surface_options_init(&options, sizeof options)) return 1;
  patches.n_curves = n_curves, patches.degree = degree, patches.control = control;
  patches.n_patches = n_patches, patches.curve_id = curve_id;
  if (riis_valve_create_from_patches(&patches, &valve) || riis_surface_create(valve, NULL, &surface)) return 2;
  FILE *statm = fopen("/proc/self/statm", "r");
  if (!statm || fscanf(statm, "%ld", &pages) != 1) return 3;
  fclose(statm);
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE) + ((rlim_t)320 << 20);
  setrlimit(RLIMIT_AS, &limit);
  if (exceeds_limit(&limit)) return limit_is_ignored;
  options.n_threads = 1;
  options.half_thickness = 1e-3;
  options.tolerance = 1e-5;
  if (riis_surface_update(surface, valve, &options) != RIIS_LIMIT_EXCEEDED) return 4;
  return strstr(riis_last_error(), "more than 16777216 triangles") ? 0 : 5;
}

static void check_in_child(int (*returns_0)(void)) {
#if defined(IS_SANITIZED)
  skip(); /* sanitizers reserve the address space that this test would limit */
#endif
  fflush(NULL);
  const pid_t child = fork();
  if (child == 0) _exit(returns_0());
  int status = -1;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFEXITED(status));
  if (WEXITSTATUS(status) == limit_is_ignored) skip();
  assert_int_equal(WEXITSTATUS(status), 0);
}

/* The test that forks must be first, because OpenMP cannot survive a fork after it has started threads. */
TEST(memory_that_runs_out_changes_nothing) { check_in_child(update_without_memory); }

TEST(what_is_too_much_is_not_made) { check_in_child(refusal_with_little_memory); }

TEST(every_exception_becomes_a_status) {
  CHECK_OK(wall_meets("nothing"));
  CHECK_REFUSED(RIIS_INVALID_MESH, "error 7", wall_meets("error"));
  CHECK_REFUSED(RIIS_OUT_OF_MEMORY, "out of memory", wall_meets("memory"));
  CHECK_REFUSED(RIIS_INTERNAL_ERROR, "internal error: boom", wall_meets("standard"));
  CHECK_REFUSED(RIIS_INTERNAL_ERROR, "internal error: unknown exception", wall_meets("other"));
  CHECK_REFUSED(RIIS_INVALID_MESH, "a worker's error", wall_meets("worker"));
  CHECK_REFUSED(RIIS_INVALID_MESH, "error of block 0", wall_meets("workers"));
}

int main(void) { return run_cases(NULL, NULL); }
