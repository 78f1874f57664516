// SPDX-License-Identifier: Apache-2.0
// Google Benchmark's own main program, and after the searches a table of them beside the paper's.
#include <benchmark/benchmark.h>

#include <cstring>
#include <iostream>
#include <memory>
#include <vector>

#include "search_table.hpp"

namespace {

// Whether a run ended early: Google Benchmark calls it error_occurred before its version 1.8, skipped since.
template <class Run>
auto ended_early(const Run &run, int) -> decltype(run.error_occurred) {
  return run.error_occurred;
}
template <class Run>
bool ended_early(const Run &run, long) {
  return static_cast<bool>(run.skipped);
}

// Passes everything on to the reporter that the command line asks for.
class Reporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context &context) override { return own_->ReportContext(context); }

  void ReportRuns(const std::vector<Run> &runs) override {
    own_->ReportRuns(runs);
    for (const Run &run : runs) {
      const bool least = run.run_type == Run::RT_Aggregate && run.aggregate_name == "least";
      if (ended_early(run, 0) || (run.run_type == Run::RT_Aggregate && !least)) continue;
      table_.add(run.run_name.function_name, run.run_name.args, run.counters);
    }
  }

  void Finalize() override { own_->Finalize(); }

  const bench::SearchTable &table() const { return table_; }

 private:
  std::unique_ptr<benchmark::BenchmarkReporter> own_{benchmark::CreateDefaultDisplayReporter()};
  bench::SearchTable table_;
};

bool is_for_people(int argc, char **argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::strncmp(argv[i], "--benchmark_format=", 19) == 0) return std::strcmp(argv[i] + 19, "console") == 0;
  }
  return true;
}

}  // namespace

int main(int argc, char **argv) {
  const bool with_table = is_for_people(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  if (with_table) reporter.table().print(std::cout);
  return 0;
}
