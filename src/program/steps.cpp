// SPDX-License-Identifier: Apache-2.0
#include "program/steps.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "program/handles.hpp"
#include "program/progress.hpp"
#include "program/refusal.hpp"

namespace riis::program {
namespace {

// The first steps sort the mesh's nodes, and allocate memory that later steps reuse.
constexpr int n_first_steps = 2;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void set_opening(riis_valve *valve, double opening) {
  check(riis_valve_set_scalar(valve, "opening", opening), "--steps");
}

// The opening goes up to 1 and down to 0 again, wherever it begins.
class Swing {
 public:
  explicit Swing(riis_valve *valve) { check(riis_valve_get(valve, "opening", 1, &opening_)); }
  double opening() const { return opening_; }
  double next() {
    if (opening_ + change_ > 1 || opening_ + change_ < 0) change_ = -change_;
    return opening_ = std::clamp(opening_ + change_, 0.0, 1.0);
  }

 private:
  double opening_ = 0, change_ = opening_of_step;
};

// Puts the valve's opening back, however the steps end.
class KeptOpening {
 public:
  explicit KeptOpening(riis_valve *valve) : valve_(valve), opening_(Swing(valve).opening()) {}
  ~KeptOpening() { riis_valve_set_scalar(valve_, "opening", opening_); }
  KeptOpening(const KeptOpening &) = delete;
  KeptOpening &operator=(const KeptOpening &) = delete;

 private:
  riis_valve *valve_;
  double opening_;
};

// A mesh with the data that the search needs.
struct Steps {
  Adjacency adjacency;  // outlives the mesh, which borrows it
  Mesh mesh;
  Surface surface;
  Marks result;
};

Steps prepared(const Options &options, const riis_valve *valve, const riis_vtk_mesh *file) {
  Steps steps;
  int64_t n_nodes = 0;
  const double *xyz = nullptr;
  check(riis_vtk_mesh_get_nodes(file, &n_nodes, nullptr, &xyz));
  riis_mesh *mesh = nullptr;
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh), options.mesh);
  steps.mesh.reset(mesh);
  const int32_t search = options.mark_options.search;
  if (search == RIIS_SEARCH_NEIGHBOR || search == RIIS_SEARCH_PAPER) {
    riis_adjacency *adjacency = nullptr;
    check(riis_vtk_mesh_create_adjacency(file, options.mark_options.n_threads, &adjacency), options.mesh);
    steps.adjacency.reset(adjacency);
    riis_csr rows;
    check(riis_adjacency_get_csr(adjacency, &rows, sizeof rows));
    check(riis_mesh_set_adjacency(mesh, &rows), options.mesh);
  }
  riis_surface *surface = nullptr;
  check(riis_surface_create(valve, &options.surface_options, &surface));
  steps.surface.reset(surface);
  riis_marks *result = nullptr;
  check(riis_marks_create(&result));
  steps.result.reset(result);
  return steps;
}

}  // namespace

StepTimes time_steps(const Options &options, riis_valve *valve, const riis_vtk_mesh *file) {
  const Stage stage("timing " + std::to_string(options.n_steps) + " steps", options.quiet);
  const Steps steps = prepared(options, valve, file);
  const KeptOpening kept(valve);
  Swing swing(valve);
  std::vector<double> of_surface, of_marking;
  for (int i = 0; i < n_first_steps + options.n_steps; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    set_opening(valve, swing.next());
    check(riis_surface_update(steps.surface.get(), valve, nullptr), "--steps");
    const double updated = seconds_since(begin);
    check(riis_mark_nodes(steps.surface.get(), steps.mesh.get(), &options.mark_options, steps.result.get()),
          options.mesh);
    const double marked = seconds_since(begin);
    if (i < n_first_steps) continue;
    of_surface.push_back(updated);
    of_marking.push_back(marked - updated);
  }
  riis_mark_stats stats{};
  check(riis_marks_get_stats(steps.result.get(), &stats, sizeof stats));
  return {options.n_steps, stats.search, median(of_surface), median(of_marking)};
}

}  // namespace riis::program
