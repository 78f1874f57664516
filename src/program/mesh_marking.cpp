// SPDX-License-Identifier: Apache-2.0
#include "program/mesh_marking.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "program/handles.hpp"
#include "program/mesh_reading.hpp"
#include "program/progress.hpp"
#include "program/refusal.hpp"
#include "program/valve_source.hpp"
#include "program/warnings.hpp"

namespace riis::program {

MeshFile read_mesh(const MarkOptions &options, Seconds &seconds) {
  const Stage stage("reading " + options.mesh, options.quiet);
  MeshFile mesh = read_mesh_file(options.mesh);
  if (options.at_cells) check(riis_vtk_mesh_use_centers(mesh.get()), options.mesh);
  seconds.read += stage.seconds();
  return mesh;
}

Mesh borrow_nodes(const riis_vtk_mesh *file, const std::string &path) {
  int64_t n_nodes = 0;
  const double *xyz = nullptr;
  check(riis_vtk_mesh_get_nodes(file, &n_nodes, nullptr, &xyz));
  riis_mesh *mesh = nullptr;
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh), path);
  return Mesh(mesh);
}

Marks new_result() {
  riis_marks *result = nullptr;
  check(riis_marks_create(&result));
  return Marks(result);
}

namespace {

// Gives the mesh an adjacency. The mesh borrows it, so the caller must keep the returned object.
Adjacency give_adjacency(const MarkOptions &options, const riis_vtk_mesh *file, riis_mesh *mesh, Seconds &seconds) {
  const Stage stage("finding the nodes' neighbours", options.quiet);
  riis_adjacency *handle = nullptr;
  check(riis_vtk_mesh_create_adjacency(file, options.mark_options.n_threads, &handle), options.mesh);
  Adjacency adjacency(handle);
  riis_csr rows;
  check(riis_adjacency_get_csr(adjacency.get(), &rows, sizeof rows));
  check(riis_mesh_set_adjacency(mesh, &rows), options.mesh);
  seconds.adjacency += stage.seconds();
  return adjacency;
}

}  // namespace

MarkedFile mark_file(const MarkOptions &options, const riis_surface *surface, riis_vtk_mesh *file, Seconds &seconds) {
  MarkedFile marked;
  {
    const Stage stage("checking the nodes", options.quiet);
    marked.mesh = borrow_nodes(file, options.mesh);
    seconds.mesh += stage.seconds();
  }
  if (needs_adjacency(options.mark_options.search))
    marked.adjacency = give_adjacency(options, file, marked.mesh.get(), seconds);
  marked.marks = new_result();
  {
    const Stage stage("marking", options.quiet);
    check(riis_mark_nodes(surface, marked.mesh.get(), &options.mark_options, marked.marks.get()), options.mesh);
    seconds.search += stage.seconds();
  }
  check(riis_marks_get_stats(marked.marks.get(), &marked.stats, sizeof marked.stats));
  set_marks(options, marked.marks.get(), 0, file);
  ResistanceSum resistance(marked.stats.n_nodes, ResistanceSum::WithVelocity::no);
  resistance.add(options, marked.marks.get());
  resistance.set_arrays(options.prefix, file);
  return marked;
}

NodeEdges::NodeEdges(const riis_vtk_mesh *file, int32_t n_threads) {
  riis_adjacency *handle = nullptr;
  check(riis_vtk_mesh_create_adjacency(file, n_threads, &handle));
  adjacency_.reset(handle);
  check(riis_adjacency_get_csr(adjacency_.get(), &rows_, sizeof rows_));
}

bool needs_adjacency(int32_t search) { return search == RIIS_SEARCH_NEIGHBOR || search == RIIS_SEARCH_PAPER; }

void rehearse_marking(const MarkOptions &options, const riis_surface *surface) {
  const double origin[3] = {0, 0, 0};
  riis_mesh *mesh_handle = nullptr;
  check(riis_mesh_create(1, origin, origin + 1, origin + 2, 3, &mesh_handle));
  const Mesh mesh(mesh_handle);
  const Marks result = new_result();
  riis_mark_options mark_options = options.mark_options;
  if (needs_adjacency(mark_options.search)) mark_options.search = RIIS_SEARCH_EXHAUSTIVE;
  check(riis_mark_nodes(surface, mesh.get(), &mark_options, result.get()));
  riis_dense_arrays dense;
  check(riis_dense_arrays_init(&dense, sizeof dense));
  dense.n_nodes = 1;
  dense.far_distance = options.far_distance;
  check(riis_marks_get_dense(result.get(), &dense));
  ResistanceSum(1, ResistanceSum::WithVelocity::no).add(options, result.get());
}

void warn_of_incomplete_marks() {
  warn(
      "the marks may be incomplete: --search paper misses nodes that are not connected to its one start; --search "
      "neighbor finds them");
}

void check_new_arrays(const MarkOptions &options, const std::vector<std::string> &names, const riis_vtk_mesh *mesh) {
  if (options.output.empty() || options.replace) return;
  for (const std::string &name : names) {
    int32_t has = 0;
    check(riis_vtk_mesh_has_point_array(mesh, name.c_str(), &has));
    if (!has) continue;
    throw Refusal{exit_wrong_usage, options.mesh + " already has an array " + name +
                                        ": write --replace to replace it, or --prefix NAME for other arrays beside it"};
  }
}

std::vector<std::string> names_of_marks(const std::string &prefix, int32_t fields) {
  std::vector<std::string> names = {prefix + "_marked", prefix + "_distance", prefix + "_leaflet"};
  if (fields & RIIS_FIELD_NORMAL) names.push_back(prefix + "_normal");
  if (fields & RIIS_FIELD_SIDE) names.push_back(prefix + "_side");
  if (fields & RIIS_FIELD_VELOCITY) names.push_back(prefix + "_velocity");
  return names;
}

void set_marks(const MarkOptions &options, const riis_marks *result, int32_t fields, riis_vtk_mesh *file) {
  check(riis_vtk_mesh_set_marks(file, result, options.far_distance, options.prefix.c_str()));
  check(riis_vtk_mesh_set_fields(file, result, fields, options.prefix.c_str()));
}

ResistanceSum::ResistanceSum(int64_t n_nodes, WithVelocity with_velocity)
    : n_nodes_(n_nodes),
      K_(static_cast<std::size_t>(n_nodes), 0.0),
      K_u_surface_(with_velocity == WithVelocity::yes ? 3 * static_cast<std::size_t>(n_nodes) : 0, 0.0) {}

void ResistanceSum::add(const MarkOptions &options, const riis_marks *result) {
  if (!options.resistance) return;
  has_any_ = true;
  riis_resistance how;
  check(riis_resistance_init(&how, sizeof how));
  how.R = *options.resistance;
  riis_resistance_arrays to;
  check(riis_resistance_arrays_init(&to, sizeof to));
  to.n_nodes = n_nodes_;
  to.K = K_.data();
  for (int c = 0; c < 3 && !K_u_surface_.empty(); ++c) to.K_u_surface[c] = K_u_surface_.data() + c;
  to.K_u_surface_stride = 3;
  check(riis_marks_add_resistance(result, &how, &to), "--resistance");
}

void ResistanceSum::set_arrays(const std::string &prefix, riis_vtk_mesh *file) const {
  if (!has_any_) return;
  const std::string K = prefix + "_K", K_u_surface = prefix + "_K_u_surface";
  check(riis_vtk_mesh_set_point_array(file, K.c_str(), n_nodes_, 1, K_.data()));
  if (!K_u_surface_.empty())
    check(riis_vtk_mesh_set_point_array(file, K_u_surface.c_str(), n_nodes_, 3, K_u_surface_.data()));
}

// ---- Steps ----

namespace {

// The times of the first steps do not count, because these steps sort the mesh's nodes and allocate memory that later steps
// reuse.
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

// A sequence of openings that goes up to 1, then down to 0, and so on. It may begin anywhere.
class OpeningSteps {
 public:
  explicit OpeningSteps(riis_valve *valve) { check(riis_valve_get(valve, "opening", 1, &opening_)); }
  double opening() const { return opening_; }
  double next() {
    if (opening_ + change_ > 1 || opening_ + change_ < 0) change_ = -change_;
    return opening_ = std::clamp(opening_ + change_, 0.0, 1.0);
  }

 private:
  double opening_ = 0, change_ = opening_of_step;
};

// Restores the valve's opening at the end, even if the steps end with an exception.
class KeptOpening {
 public:
  explicit KeptOpening(riis_valve *valve) : valve_(valve), opening_(OpeningSteps(valve).opening()) {}
  ~KeptOpening() { riis_valve_set_scalar(valve_, "opening", opening_); }
  KeptOpening(const KeptOpening &) = delete;
  KeptOpening &operator=(const KeptOpening &) = delete;

 private:
  riis_valve *valve_;
  double opening_;
};

// A mesh with the data that the search needs.
struct Steps {
  Adjacency adjacency;  // declared first, so that it outlives the mesh that borrows it
  Mesh mesh;
  Surface surface;
  Marks result;
};

Steps prepared(const MarkOptions &options, const riis_valve *valve, const riis_vtk_mesh *file) {
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

StepTimes time_steps(const MarkOptions &options, riis_valve *valve, const riis_vtk_mesh *file) {
  const Stage stage("timing " + std::to_string(options.n_steps) + " steps", options.quiet);
  const Steps steps = prepared(options, valve, file);
  const KeptOpening kept(valve);
  OpeningSteps steps_of_opening(valve);
  std::vector<double> of_surface, of_marking;
  for (int i = 0; i < n_first_steps + options.n_steps; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    set_opening(valve, steps_of_opening.next());
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
