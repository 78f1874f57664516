// SPDX-License-Identifier: Apache-2.0
// ./run bench proof, its third part: every search marks a small mesh many times, and the memory of the process must not grow.
// Each search runs with 1, 2 and 4 threads, on processors that other processes keep busy. A search takes less than a millisecond,
// so some threads join it only near its end. TBB keeps the memory that it allocated for late threads. The program prints a table
// and fails if memory grows. OpenMP's threads should sleep while they wait (OMP_WAIT_POLICY=passive). Otherwise the run takes
// many times as long.
//   argv[1]  the number of markings, 5,000 by default
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "shared/cylinder.hpp"
#include "shared/memory.hpp"

namespace {

using namespace bench;

// Processes that keep the processors busy, one for each processor that this process may use. The processes end when this object
// is destroyed. If this process ends earlier (by exit or a signal), the system kills the busy processes.
class BusyProcessors {
 public:
  BusyProcessors() {
    cpu_set_t usable;
    const int n = sched_getaffinity(0, sizeof usable, &usable) == 0 ? CPU_COUNT(&usable) : 1;
    const pid_t parent = getpid();
    for (int i = 0; i < n; ++i) {
      const pid_t process = fork();
      if (process < 0) {
        std::perror("fork");
        end();
        std::exit(1);
      }
      if (process == 0) compute_for(parent);
      processes_.push_back(process);
    }
  }
  ~BusyProcessors() { end(); }
  BusyProcessors(const BusyProcessors &) = delete;
  BusyProcessors &operator=(const BusyProcessors &) = delete;

 private:
  [[noreturn]] static void compute_for(pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(0);  // the parent ended before the system was asked to end this process with it
    for (volatile unsigned step = 0;; step = step + 1) {
    }
  }
  void end() {
    for (const pid_t process : processes_) {
      kill(process, SIGKILL);
      waitpid(process, nullptr, 0);
    }
  }

  std::vector<pid_t> processes_;
};

// Says when a case makes the handles of a marking. The value "before" stands for a solver that keeps all handles. A solver whose
// mesh moves may make a new mesh for each marking. A subroutine that keeps nothing between calls makes all handles for each
// marking.
enum class Made { before, mesh_each_time, all_each_time };

struct Case {
  const char *name;
  std::int32_t search;
  Made made;
};
constexpr Case cases[] = {{"exhaustive", RIIS_SEARCH_EXHAUSTIVE, Made::before},
                          {"clusters", RIIS_SEARCH_CLUSTERS, Made::before},
                          {"paper", RIIS_SEARCH_PAPER, Made::before},
                          {"neighbor", RIIS_SEARCH_NEIGHBOR, Made::before},
                          {"neighbor, a new mesh each time", RIIS_SEARCH_NEIGHBOR, Made::mesh_each_time},
                          {"neighbor, all new each time", RIIS_SEARCH_NEIGHBOR, Made::all_each_time}};

Surface aortic_surface() {
  const Valve valve = make_valve("aortic");
  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  options.tolerance = 0.1;
  options.half_thickness = 0.1;
  options.n_threads = 1;
  return make_surface(valve.get(), &options);
}

// The handles of a marking. The case decides when the handles are made.
class Marking {
 public:
  Marking(const Case &of, int n_threads) : made_(of.made), nodes_(cylinders[0], 3000), rows_(nodes_.rows()) {
    check(riis_mark_options_init(&options_, sizeof options_));
    options_.search = of.search;
    options_.n_threads = n_threads;
  }

  void mark() {
    if (made_ != Made::before) mesh_.reset();
    if (made_ == Made::all_each_time) surface_.reset(), result_.reset();
    if (!surface_) surface_ = aortic_surface();
    if (!result_) result_ = make_result();
    if (!mesh_) {
      mesh_ = mesh_over(nodes_);
      check(riis_mesh_set_adjacency(mesh_.get(), &rows_));
    }
    check(riis_mark_nodes(surface_.get(), mesh_.get(), &options_, result_.get()));
  }

 private:
  Made made_;
  CylinderMesh nodes_;
  riis_csr rows_;
  riis_mark_options options_;
  Surface surface_;
  Mesh mesh_;
  Result result_;
};

// The number of bytes that the markings may add to the memory of the process. If a thread first takes part during the
// measurement, its stack and the first pages of its allocator are added. If the proof runs only 300 markings, this limit is 1 kB
// per marking. For comparison, TBB's arena of two threads takes 7 kB.
constexpr double most_growth = 3e5;

// A leak adds memory in every round, but an allocation that happens only once does not.
bool stays(const Case &of, int n_threads, int n_markings) {
  Marking marking(of, n_threads);
  for (int i = 0; i < 60; ++i) marking.mark();
  for (int round = 1;; ++round) {
    const double before = resident();
    for (int i = 0; i < n_markings; ++i) marking.mark();
    const double growth = resident() - before;
    std::printf("| %s | %d | %d | %.3f | %.0f |\n", of.name, n_threads, round, 1e-6 * growth, growth / n_markings);
    std::fflush(stdout);
    if (growth <= most_growth) return true;
    if (round == 3) return false;
  }
}

}  // namespace

int main(int argc, char **argv) {
  const int n_markings = argc > 1 ? std::atoi(argv[1]) : 5000;
  if (n_markings < 300) {
    std::fprintf(stderr, "%s: %s is not a number of markings, 300 or more\n", argv[0], argv[1]);
    return 2;
  }
  const BusyProcessors busy;  // its constructor forks, so it comes before the first thread
  std::printf("| search | threads | round of %d markings | growth, MB | bytes a marking |\n|---|---|---|---|---|\n",
              n_markings);
  bool all_stay = true;
  for (const Case &of : cases)
    for (const int n_threads : {1, 2, 4}) all_stay = stays(of, n_threads, n_markings) && all_stay;
  std::printf("\nmemory %s\n", all_stay ? "stays" : "does NOT stay");
  return all_stay ? 0 : 1;
}
