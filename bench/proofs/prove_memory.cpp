// SPDX-License-Identifier: Apache-2.0
// ./run bench proof, its second part: both valves open and close for 10,000 time steps, with 100,000 nodes and 2 threads. At the
// end, the memory of the process must equal the memory at step 100 to within 1 MB. With one thread, no marking may call malloc
// after the valve has been in all positions. The program prints a table and fails if one of these claims does not hold.
//   argv[1]  the number of steps, a multiple of 100; 10,000 by default
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "shared/cylinder.hpp"
#include "shared/memory.hpp"
#include "shared/time_steps.hpp"

namespace {

std::atomic<bool> is_counting{false};
std::atomic<std::int64_t> n_allocations{0};

void count() {
  if (is_counting.load(std::memory_order_relaxed)) n_allocations.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

// If an executable and a library define the same function, the executable's function is called. All allocations of the process,
// including those of operator new, therefore call the functions below.
extern "C" {
void *__libc_malloc(std::size_t size);
void *__libc_calloc(std::size_t n, std::size_t size);
void *__libc_realloc(void *p, std::size_t size);
void *__libc_memalign(std::size_t alignment, std::size_t size);

void *malloc(std::size_t size) noexcept { return count(), __libc_malloc(size); }
void *calloc(std::size_t n, std::size_t size) noexcept { return count(), __libc_calloc(n, size); }
void *realloc(void *p, std::size_t size) noexcept { return count(), __libc_realloc(p, size); }
void *memalign(std::size_t alignment, std::size_t size) noexcept { return count(), __libc_memalign(alignment, size); }
void *aligned_alloc(std::size_t alignment, std::size_t size) noexcept { return memalign(alignment, size); }
int posix_memalign(void **p, std::size_t alignment, std::size_t size) noexcept {
  void *const made = memalign(alignment, size);
  if (!made) return ENOMEM;
  *p = made;
  return 0;
}
}

namespace {

using namespace bench;

template <class Work>
std::int64_t allocations_of(const Work &work) {
  n_allocations = 0;
  is_counting = true;
  work();
  is_counting = false;
  return n_allocations;
}

constexpr int period = 50;         // steps from closed to open and back; steps in the same position are compared
constexpr int n_warm_steps = 100;  // two periods
constexpr double most_growth = 1e6;

struct Case {
  const char *kind;
  const Cylinder &cylinder;
  int n_threads;
  int n_steps;
  // The limit on allocations of all markings after the warm-up. Chance decides how the work is divided between threads. If a
  // thread gets more work than ever before, its memory doubles. After some steps, the memory grows no further.
  std::int64_t most_allocations;
};

// Returns true if the memory stays the same.
bool prove(const Case &of) {
  const CylinderNodes nodes(of.cylinder, 100000);
  const Mesh mesh = mesh_over(nodes);
  check(riis_mesh_prepare(mesh.get(), 2));
  StepOptions options;
  options.kind = of.kind;
  options.n_threads = of.n_threads;
  TimeSteps steps(mesh.get(), options);
  double allocated_first = 0, resident_first = 0;
  std::int64_t by_markings = 0, by_updates = 0;
  bool stays = true;
  for (int step = 1; step <= of.n_steps; ++step) {
    steps.move_to(0.5 - 0.5 * std::cos(2 * M_PI * step / period));
    const std::int64_t by_update = allocations_of([&] { steps.update(); });
    const std::int64_t by_marking = allocations_of([&] { steps.mark(); });
    if (step == 1 && (by_update == 0 || by_marking == 0)) {
      std::fprintf(stderr, "the first step's allocations were not seen\n");
      std::exit(1);
    }
    if (step > n_warm_steps) by_updates += by_update, by_markings += by_marking;
    if (step != n_warm_steps && step != 1000 && step != of.n_steps) continue;
    const double now_allocated = allocated(), now_resident = resident();
    if (step == n_warm_steps) allocated_first = now_allocated, resident_first = now_resident;
    stays = stays && now_allocated - allocated_first <= most_growth && now_resident - resident_first <= most_growth;
    std::printf("| %s | %d | %d | %.3f | %.3f | %lld | %lld | %.0f |\n", of.kind, of.n_threads, step,
                1e-6 * now_resident, 1e-6 * now_allocated, static_cast<long long>(marked_in(steps.result()).n_nodes),
                static_cast<long long>(by_markings),
                static_cast<double>(by_updates) / std::max(1, step - n_warm_steps));
    std::fflush(stdout);
  }
  return stays && by_markings <= of.most_allocations;
}

}  // namespace

int main(int argc, char **argv) {
  const int n_steps = argc > 1 ? std::atoi(argv[1]) : 10000;
  if (n_steps <= n_warm_steps || n_steps % n_warm_steps != 0) {
    std::fprintf(stderr, "%s: not a number of steps, a multiple of %d above it: %s\n", argv[0], n_warm_steps, argv[1]);
    return 2;
  }
  std::printf(
      "| valve | threads | step | resident, MB | malloc, MB | marked | allocations by all markings since step %d | by "
      "each "
      "update of the surface |\n|---|---|---|---|---|---|---|---|\n",
      n_warm_steps);
  const int n_short = std::min(n_steps, 1000);
  bool stays = true;
  for (const Case &of : {Case{"aortic", cylinders[0], 1, n_short, 0}, Case{"mitral", cylinders[1], 1, n_short, 0},
                         Case{"aortic", cylinders[0], 2, n_steps, 50}, Case{"mitral", cylinders[1], 2, n_steps, 50}})
    stays = prove(of) && stays;
  std::printf("\nmemory %s\n", stays ? "stays" : "does NOT stay");
  return stays ? 0 : 1;
}
