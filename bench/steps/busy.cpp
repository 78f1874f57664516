// SPDX-License-Identifier: Apache-2.0
// ./run bench busy: measures time steps on two processors that two other processes keep busy, with 1 and with 2 threads. These
// steps are also measured while the two processes are stopped, and after a loop on the caller's own OpenMP threads. The program
// prints times and bars, which are required ratios of times. While the processes are busy, the mean time of the calls counts. A
// few waits of several milliseconds dominate this mean, so blocks of calls with 1 and with 2 threads take turns for a long time.
// The table gives the ratio of the mean times with 1 and with 2 threads, and its standard error.
//   argv[1]  the number of nodes in thousands, 1000 by default
#include <riis/riis.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "shared/contest.hpp"
#include "shared/cylinder.hpp"
#include "shared/handles.hpp"
#include "shared/time_steps.hpp"

namespace {

using namespace bench;

constexpr int most_turns = 400;
constexpr std::chrono::seconds longest{5};       // for all turns of a subject
constexpr std::chrono::seconds beside_busy{24};  // for all blocks of a subject while other processes are busy
// A block of calls with 1 thread takes about this time. The system gives processor time to processes in slices that are a tenth
// as long.
constexpr double block_milliseconds = 40;

[[noreturn]] void fail(const char *what) {
  std::perror(what);
  std::exit(1);
}

// Restricts this process and its later children to two processors.
void keep_two_processors() {
  cpu_set_t all, two;
  if (sched_getaffinity(0, sizeof all, &all) != 0) fail("sched_getaffinity");
  CPU_ZERO(&two);
  for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&two) < 2; ++i)
    if (CPU_ISSET(i, &all)) CPU_SET(i, &two);
  if (CPU_COUNT(&two) < 2) {
    std::fprintf(stderr, "this process may use only one processor\n");
    std::exit(1);
  }
  if (sched_setaffinity(0, sizeof two, &two) != 0) fail("sched_setaffinity");
}

// Two processes that compute until this process ends. They are stopped at first.
class BusyProcesses {
 public:
  BusyProcesses() {
    for (pid_t &process : processes_) {
      process = fork();
      if (process < 0) fail("fork");
      if (process > 0) continue;
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      for (volatile unsigned i = 0;;) i = i + 1;
    }
    send(SIGSTOP);
  }
  ~BusyProcesses() {
    send(SIGKILL);
    for (const pid_t process : processes_) waitpid(process, nullptr, 0);
  }
  BusyProcesses(const BusyProcesses &) = delete;
  BusyProcesses &operator=(const BusyProcesses &) = delete;

  void send(int signal) const {
    for (const pid_t process : processes_) kill(process, signal);
  }

 private:
  std::array<pid_t, 2> processes_{};
};

struct Times {
  double least, mean;  // milliseconds
};

// A call to be measured with 1 and with 2 threads.
struct Subject {
  std::string name;
  std::array<std::function<void()>, 2> calls;
};

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Measures a call with 1 and with 2 threads in turns. before() is not timed.
std::array<Times, 2> measure(const Subject &subject, const std::function<void()> &before) {
  std::array<std::vector<double>, 2> times;
  const auto first_start = std::chrono::steady_clock::now();
  for (int turn = 0; turn < most_turns && std::chrono::steady_clock::now() - first_start < longest; ++turn)
    for (std::size_t i = 0; i < 2; ++i) {
      before();
      const auto start = std::chrono::steady_clock::now();
      subject.calls[i]();
      times[i].push_back(milliseconds_since(start));
    }
  std::array<Times, 2> made{};
  for (std::size_t i = 0; i < 2; ++i) {
    double sum = 0;
    for (const double time : times[i]) sum += time;
    made[i] = {*std::min_element(times[i].begin(), times[i].end()), sum / static_cast<double>(times[i].size())};
  }
  return made;
}

// The mean times of a call in milliseconds, with 1 and with 2 threads. `error` is the standard error of the ratio of these times.
struct Means {
  std::array<double, 2> mean;
  double error;
  double ratio() const { return mean[1] / mean[0]; }
};

// Measures blocks of equally many calls with 1 and with 2 threads. The pairs of blocks begin with 1 thread and with 2 threads in
// turn.
Means measure_in_blocks(const Subject &subject, double estimate) {
  const int n_calls = std::max(1, static_cast<int>(block_milliseconds / estimate));
  const auto block = [&](std::size_t i) {
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < n_calls; ++k) subject.calls[i]();
    return milliseconds_since(start);
  };
  std::vector<std::array<double, 2>> pairs;
  const auto first_start = std::chrono::steady_clock::now();
  while (pairs.size() < 10 || std::chrono::steady_clock::now() - first_start < beside_busy) {
    std::array<double, 2> times{};
    const std::size_t first = pairs.size() % 2;
    times[first] = block(first);
    times[1 - first] = block(1 - first);
    pairs.push_back(times);
  }
  std::array<double, 2> sum{};
  for (const auto &pair : pairs) sum[0] += pair[0], sum[1] += pair[1];
  double squares = 0;
  for (const auto &pair : pairs) {
    const double off = pair[1] - sum[1] / sum[0] * pair[0];
    squares += off * off;
  }
  const auto n = static_cast<double>(pairs.size());
  return {{sum[0] / (n * n_calls), sum[1] / (n * n_calls)}, std::sqrt(squares * n / (n - 1)) / sum[0]};
}

// A caller's loop of about 0.2 ms on two threads of OpenMP.
void openmp_loop() {
#pragma omp parallel num_threads(2)
  {
    const auto start = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - start < std::chrono::microseconds(200)) {
    }
  }
}

// Time steps on 1 and on 2 threads, with one mesh.
struct Steps {
  explicit Steps(const riis_mesh *mesh) {
    for (int i = 0; i < 2; ++i) {
      StepOptions options;
      options.n_threads = 1 + i;
      steps.push_back(std::make_unique<TimeSteps>(mesh, options));
    }
  }
  template <class Call>
  Subject subject(const std::string &name, const Call &call) {
    return {name, {[this, call] { call(*steps[0]); }, [this, call] { call(*steps[1]); }}};
  }
  std::vector<std::unique_ptr<TimeSteps>> steps;
};

}  // namespace

int main(int argc, char **argv) {
  keep_two_processors();
  const std::int64_t n_nodes = n_nodes_given(argc, argv, 1, 10);
  const BusyProcesses busy;
  const CylinderNodes few(wide_cylinder, 10'000), many(wide_cylinder, n_nodes);
  const Mesh mesh_of_few = mesh_over(few), mesh_of_many = mesh_over(many);
  for (const Mesh *mesh : {&mesh_of_few, &mesh_of_many}) check(riis_mesh_prepare(mesh->get(), 2));
  Steps with_few(mesh_of_few.get()), with_many(mesh_of_many.get());
  const std::string n_few = std::to_string(few.n_nodes()), n_many = std::to_string(many.n_nodes());
  const auto step = [](TimeSteps &steps) {
    steps.move();
    steps.step();
  };
  const std::vector<Subject> subjects = {
      with_few.subject("update of the surface",
                       [](TimeSteps &steps) {
                         steps.move();
                         steps.update();
                       }),
      with_few.subject("marking, " + n_few + " nodes", [](TimeSteps &steps) { steps.mark(); }),
      with_few.subject("step, " + n_few + " nodes", step), with_many.subject("step, " + n_many + " nodes", step)};

  Bars bars;
  std::printf(
      "Milliseconds on two processors, with 1 and with 2 threads, in turns.\n\n"
      "| | idle: least, 1 | 2 | after an OpenMP loop: least, 1 | 2 | mean, 1 | 2 | busy: mean, 1 | 2 | 2 / 1 |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Subject &subject : subjects) {
    const auto nothing = [] {};
    measure(subject, nothing);
    const std::array<Times, 2> idle = measure(subject, nothing), after_loop = measure(subject, openmp_loop);
    busy.send(SIGCONT);
    const Means beside = measure_in_blocks(subject, idle[0].least);
    busy.send(SIGSTOP);
    std::printf("| %s | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.2f ± %.2f |\n", subject.name.c_str(),
                idle[0].least, idle[1].least, after_loop[0].least, after_loop[1].least, after_loop[0].mean,
                after_loop[1].mean, beside.mean[0], beside.mean[1], beside.ratio(), beside.error);
    std::fflush(stdout);
    bars.add(subject.name + ", busy: 2 threads / 1", beside.ratio(), Wanted::at_most, 2);
  }
  std::printf("\n");
  bars.print();
  return 0;
}
