// SPDX-License-Identifier: Apache-2.0
// Loops over a fixed number of blocks. The exhaustive search and the loops of a time step run on OpenMP's threads. If a loop has
// waited long for one of these threads, the loops of a time step run on a team for some time instead. Only parallel_for.cpp uses
// OpenMP.
#pragma once

#include <cstdint>

#include "parallel/team.hpp"
#include "parallel/threads.hpp"

namespace riis {

// Returns the number of processors in the affinity mask of the calling thread. With the default n_threads = 0, a call never uses
// more threads than this number. If OpenMP binds threads to places, the mask is the one that the process had at its start.
int default_thread_count() noexcept;

// Returns the number of the machine's processors, including processors outside the calling thread's affinity mask.
int processors_of_machine() noexcept;

// By default a call uses one more thread for each 4096 triangles, 2048 points or 16,384 nodes. This amount of work takes half a
// millisecond or more. On a quiet machine, waking a thread and waiting for it takes a hundredth of this time. On a busy machine,
// the wait may last as long as another process keeps the processor.
constexpr std::int64_t triangles_per_thread = 4096, points_per_thread = 2048;
constexpr std::int64_t nodes_per_thread = 16384;  // nodes of a mesh, or cells or faces

// Returns the number of threads that the caller requests. If the caller requests 0, returns how many threads n_items items of
// work can keep busy.
inline Threads threads_for(std::int32_t n_threads, std::int64_t n_items, std::int64_t per_thread) {
  return n_threads > 0 ? Threads(n_threads)
                       : Threads::by_default(n_items, per_thread, has_lost_threads() ? 1 : default_thread_count());
}

// Refers to a function object body(block, thread) of any type. The object must live as long as the loop. The loops take this
// reference, so that they are compiled once, and not once for each body. Each block costs one call through a pointer.
class LoopBody {
 public:
  template <class Body>
  LoopBody(const Body &body)  // NOLINT(google-explicit-constructor): callers pass a lambda
      : body_(&body),
        call_([](const void *of, std::int64_t block, int thread) { (*static_cast<const Body *>(of))(block, thread); }) {
  }
  void operator()(std::int64_t block, int thread) const { call_(body_, block, thread); }

 private:
  const void *body_;
  void (*call_)(const void *of, std::int64_t block, int thread);
};

// Returns the time of a steady clock in nanoseconds, for a LoopChoice.
std::int64_t nanoseconds() noexcept;

// The times at which the calling thread begins its work in a loop, and ends it.
struct TimesOfCaller {
  std::int64_t begins, has_worked;
};

// Runs body(block, thread) once for every block in [0, n_blocks) on up to n_threads threads of OpenMP, and returns how many
// threads ran. If a body throws, the exception that a single thread would meet is rethrown after the loop. The caller's OpenMP
// settings do not change. In a caller's parallel region, the loop uses as many threads as nested parallelism allows. If
// `of_caller` is not null and OpenMP runs the loop, the times of the calling thread are written to it.
int openmp_for(std::int64_t n_blocks, int n_threads, LoopBody body, TimesOfCaller *of_caller = nullptr);

// Runs a loop as openmp_for does, but on a team (team.hpp), without waiting for a thread that another process delays. The calling
// thread first works alone, for as long as `choice` says. Even if the loop ends within this time, the function returns n_threads.
int team_for(std::int64_t n_blocks, int n_threads, LoopBody body, LoopChoice &choice);

// Runs a loop as openmp_for does, but on the threads that loop_choice chooses. In two cases OpenMP's threads are always chosen:
// the call is inside a caller's parallel region, or the user binds OpenMP's threads to places.
int parallel_for(std::int64_t n_blocks, int n_threads, LoopBody body);

// Calls body(range, thread) for the ranges of per_block numbers in [0, n). The last range may be shorter.
template <class Body>
auto by_ranges(std::int64_t n, std::int64_t per_block, const Body &body) {
  return [n, per_block, &body](std::int64_t block, int thread) {
    const std::int64_t begin = block * per_block;
    body(Range{begin, begin + per_block < n ? begin + per_block : n}, thread);
  };
}

// The next two functions call parallel_for and openmp_for with blocks that are ranges of per_block numbers in [0, n).
template <class Body>
int parallel_for_ranges(std::int64_t n, std::int64_t per_block, int n_threads, const Body &body) {
  return parallel_for((n + per_block - 1) / per_block, n_threads, by_ranges(n, per_block, body));
}
template <class Body>
int openmp_for_ranges(std::int64_t n, std::int64_t per_block, int n_threads, const Body &body) {
  return openmp_for((n + per_block - 1) / per_block, n_threads, by_ranges(n, per_block, body));
}

}  // namespace riis
