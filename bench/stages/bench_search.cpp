// SPDX-License-Identifier: Apache-2.0
// Measures the times of the searches on cylinders with room around the valves, as in the paper's tables (4.2.3). The valve moves
// between markings. The arguments are the valve (0 aortic, 1 mitral), thousands of nodes, and threads. report.py makes tables of
// the times.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "../../tests/support/brute_force.hpp"
#include "api/handles.hpp"
#include "counters.hpp"
#include "shared/cylinder.hpp"
#include "shared/references.hpp"

namespace {

using namespace bench;

const CylinderMesh &mesh_of(const benchmark::State &state) {
  static std::map<std::pair<std::int64_t, std::int64_t>, std::unique_ptr<CylinderMesh>> made;
  std::unique_ptr<CylinderMesh> &mesh = made[{state.range(0), state.range(1)}];
  if (!mesh) mesh = std::make_unique<CylinderMesh>(cylinders[state.range(0)], 1000 * state.range(1));
  return *mesh;
}

// A valve that moves back and forth by a hundredth of the way between its states. The tolerance is 5 %, as in the paper.
class MovingValve {
 public:
  explicit MovingValve(std::int64_t kind) {
    const Valve valve = make_valve(kind == 0 ? "aortic" : "mitral");
    for (int i = 0; i < n_states; ++i) {
      if (kind == 0) {
        check(riis_valve_set_scalar(valve.get(), "leaflet_angle", 45 + 0.5 * i));
      } else {
        check(riis_valve_set_scalar(valve.get(), "opening", 0.5 + 0.01 * i));
      }
      states_[i] = make_surface(valve.get());
    }
  }

  const riis_surface *first() const { return states_[0].get(); }
  const riis_surface *next() {
    step_ = (step_ + 1) % (2 * n_states - 2);
    return states_[step_ < n_states ? step_ : 2 * n_states - 2 - step_].get();
  }

 private:
  static constexpr int n_states = 6;
  Surface states_[n_states];
  int step_ = 0;
};

MovingValve &valve_of(const benchmark::State &state) {
  static MovingValve valves[2] = {MovingValve(0), MovingValve(1)};
  return valves[state.range(0)];
}

int threads_of(const benchmark::State &state) { return static_cast<int>(state.range(2)); }

riis_mark_options options_for(const benchmark::State &state, std::int32_t search) {
  riis_mark_options options;
  check(riis_mark_options_init(&options, sizeof options));
  options.search = search;
  options.n_threads = threads_of(state);
  return options;
}

// Keeps the shortest of many markings, because other work on the machine makes markings longer.
class Shortest {
 public:
  template <class Work>
  void time(const Work &work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    milliseconds_ = std::min(milliseconds_, elapsed.count());
  }
  void count(benchmark::State &state) const { state.counters["least_ms"] = milliseconds_; }
  double milliseconds() const { return milliseconds_; }

 private:
  double milliseconds_ = std::numeric_limits<double>::infinity();
};

void count(benchmark::State &state, const riis_marks *result) {
  const riis_mark_stats stats = stats_of(result);
  count_marking(state, stats);
  count_time_per(state, "time/node", static_cast<double>(stats.n_nodes));
}

// Marks repeatedly into one result while the valve moves.
void mark_repeatedly(benchmark::State &state, std::int32_t search) {
  const riis_mesh *mesh = mesh_of(state).mesh();
  MovingValve &valve = valve_of(state);
  const riis_mark_options options = options_for(state, search);
  const Result result = make_result();
  check(riis_mark_nodes(valve.next(), mesh, &options, result.get()));
  Shortest shortest;
  for (auto _ : state) {
    const riis_surface *surface = valve.next();
    shortest.time([&] { check(riis_mark_nodes(surface, mesh, &options, result.get())); });
  }
  shortest.count(state);
  count(state, result.get());
}

void search_clusters(benchmark::State &state) { mark_repeatedly(state, RIIS_SEARCH_CLUSTERS); }
void search_exhaustive(benchmark::State &state) { mark_repeatedly(state, RIIS_SEARCH_EXHAUSTIVE); }
void search_neighbor_warm(benchmark::State &state) { mark_repeatedly(state, RIIS_SEARCH_NEIGHBOR); }
void search_paper(benchmark::State &state) { mark_repeatedly(state, RIIS_SEARCH_PAPER); }

// Marks into a new result every time. The search therefore cannot start from an earlier marking, and has no memory to reuse. The
// mesh's nodes are already sorted into balls.
void search_neighbor_cold(benchmark::State &state) {
  const riis_mesh *mesh = mesh_of(state).mesh();
  MovingValve &valve = valve_of(state);
  const riis_mark_options options = options_for(state, RIIS_SEARCH_NEIGHBOR);
  Result result = make_result();
  check(riis_mark_nodes(valve.next(), mesh, &options, result.get()));
  Shortest shortest;
  for (auto _ : state) {
    const riis_surface *surface = valve.next();
    shortest.time([&] {
      result = make_result();
      check(riis_mark_nodes(surface, mesh, &options, result.get()));
    });
  }
  shortest.count(state);
  count(state, result.get());
}

// Computes the full distance of every node with the scene. The paper's exhaustive search also computes these distances.
void search_all_distances(benchmark::State &state) {
  const CylinderMesh &mesh = mesh_of(state);
  MovingValve &valve = valve_of(state);
  std::vector<double> distance(static_cast<std::size_t>(mesh.n_nodes()));
  riis_closest_options options;
  check(riis_closest_options_init(&options, sizeof options));
  options.n_threads = threads_of(state);
  riis_closest_arrays arrays;
  check(riis_closest_arrays_init(&arrays, sizeof arrays));
  arrays.distance = distance.data();
  const riis_points points = points_of(mesh.n_nodes(), mesh.xyz().data());
  std::int64_t n_marked = 0;
  Shortest shortest;
  for (auto _ : state) {
    const riis_surface *surface = valve.next();
    shortest.time([&] { check(riis_closest_points(surface, &points, &options, &arrays)); });
    n_marked = 0;
    for (const double d : distance) n_marked += d <= 0.1;
  }
  shortest.count(state);
  state.counters["nodes"] = static_cast<double>(mesh.n_nodes());
  state.counters["marked"] = static_cast<double>(n_marked);
  count_time_per(state, "time/node", static_cast<double>(mesh.n_nodes()));
}

// Runs the paper's exhaustive search with the library's kernel, on one thread. The search measures every node against every
// triangle. This benchmark measures only every 50th node. Each node takes the same time, so the measured time is extrapolated to
// all nodes ("all_nodes_s").
void search_every_triangle(benchmark::State &state) {
  const CylinderMesh &mesh = mesh_of(state);
  const riis_surface *surface = valve_of(state).first();
  const riis::TriangleSet &triangles = riis::content_of(surface).triangles();
  constexpr std::int64_t every = 50;
  const double *xyz = mesh.xyz().data();
  std::int64_t n_marked = 0, n_sample = 0;
  for (auto _ : state) {
    n_marked = n_sample = 0;
    for (std::int64_t i = 0; i < mesh.n_nodes(); i += every, ++n_sample) {
      const double *p = xyz + 3 * i;
      n_marked += std::sqrt(riis::closest_by_brute_force(triangles, {p[0], p[1], p[2]}).distance_sq) <= 0.1;
    }
  }
  const double share = static_cast<double>(n_sample) / static_cast<double>(mesh.n_nodes());
  state.counters["nodes"] = static_cast<double>(n_sample);
  state.counters["marked"] = static_cast<double>(n_marked);
  state.counters["triangles"] = n_triangles_of(surface);
  count_time_per(state, "all_nodes_s", share);
  count_time_per(state, "time/pair", static_cast<double>(n_sample) * n_triangles_of(surface));
}

// Runs the first of the paper's two searches, in plain code (references.hpp). The search measures an evenly spaced sample of
// about 2,000 nodes against every triangle. Each node takes the same time, so the measured time is extrapolated to all nodes
// ("all_nodes_ms").
void search_paper_exhaustive(benchmark::State &state) {
  const CylinderMesh &mesh = mesh_of(state);
  const Triangles triangles(valve_of(state).first());
  const EveryTriangle distance(triangles);
  const std::int64_t every = std::max<std::int64_t>(1, mesh.n_nodes() / 2000);
  const std::int64_t n_sample = (mesh.n_nodes() + every - 1) / every;
  const double *xyz = mesh.xyz().data();
  const int n_threads = threads_of(state);
  std::int64_t n_marked = 0;
  Shortest shortest;
  for (auto _ : state) {
    shortest.time([&] {
      n_marked = 0;
#pragma omp parallel for num_threads(n_threads) schedule(static) reduction(+ : n_marked) if (n_threads > 1)
      for (std::int64_t i = 0; i < n_sample; ++i) n_marked += distance(xyz + 3 * every * i, 0.1) <= 0.1;
    });
  }
  state.counters["nodes"] = static_cast<double>(mesh.n_nodes());
  state.counters["sample"] = static_cast<double>(n_sample);
  state.counters["every"] = static_cast<double>(every);
  state.counters["marked_of_sample"] = static_cast<double>(n_marked);
  state.counters["triangles"] = static_cast<double>(triangles.n());
  state.counters["least_ms"] = shortest.milliseconds();
  state.counters["all_nodes_ms"] =
      shortest.milliseconds() * static_cast<double>(mesh.n_nodes()) / static_cast<double>(n_sample);
}

// Runs the paper's second search, also in plain code. The search walks from marked nodes to their neighbours, and measures each
// node on its way against every triangle.
void search_paper_neighbor(benchmark::State &state) {
  const CylinderMesh &mesh = mesh_of(state);
  const Triangles triangles(valve_of(state).first());
  const EveryTriangle distance(triangles);
  PaperSearch search(mesh.n_nodes(), mesh.xyz().data(), mesh.rows());
  search.begin_at(triangles);
  std::int64_t n_marked = 0;
  Shortest shortest;
  for (auto _ : state) shortest.time([&] { n_marked = search.run(distance, 0.1, threads_of(state)); });
  shortest.count(state);
  state.counters["nodes"] = static_cast<double>(mesh.n_nodes());
  state.counters["marked"] = static_cast<double>(n_marked);
  state.counters["asked"] = static_cast<double>(search.n_asked());
  state.counters["triangles"] = static_cast<double>(triangles.n());
}

// Measures the time to sort a mesh's nodes into balls. The first neighbour search on a mesh does this work.
void search_groups(benchmark::State &state) {
  const CylinderMesh &mesh = mesh_of(state);
  const double *xyz = mesh.xyz().data();
  const riis::StridedPoints nodes{mesh.n_nodes(), xyz, xyz + 1, xyz + 2, 3};
  const riis::Bounds bounds = riis::check_points(nodes, "node", RIIS_INVALID_MESH);
  for (auto _ : state) {
    const riis::Mesh fresh(nodes, bounds);
    benchmark::DoNotOptimize(&fresh.balls(threads_of(state)));
  }
  state.counters["nodes"] = static_cast<double>(mesh.n_nodes());
  count_time_per(state, "time/node", static_cast<double>(mesh.n_nodes()));
}

// Measures the time to make an adjacency, which is needed once for each mesh.
void search_adjacency_of_tetrahedra(benchmark::State &state) {
  const CylinderMesh &mesh = mesh_of(state);
  const std::vector<std::int32_t> tetrahedra = mesh.tetrahedra();
  for (auto _ : state) benchmark::DoNotOptimize(adjacency_of(mesh.n_nodes(), tetrahedra, threads_of(state)));
  state.counters["nodes"] = static_cast<double>(mesh.n_nodes());
  count_time_per(state, "time/node", static_cast<double>(mesh.n_nodes()));
}

// Measures the time to make an adjacency from faces. Here the nodes of the grid stand for cells. A face lies between two cells,
// its owner and its neighbour.
void search_adjacency_of_faces(benchmark::State &state) {
  const CylinderMesh &mesh = mesh_of(state);
  const std::int64_t n[3] = {mesh.n_across(), mesh.n_across(), mesh.n_along()};
  std::vector<std::int32_t> pairs;
  for (std::int64_t cell = 0; cell < mesh.n_nodes(); ++cell) {
    const std::int64_t at[3] = {cell % n[0], cell / n[0] % n[1], cell / n[0] / n[1]};
    const std::int64_t step[3] = {1, n[0], n[0] * n[1]};
    for (int axis = 0; axis < 3; ++axis) {
      if (at[axis] + 1 == n[axis]) continue;
      pairs.push_back(static_cast<std::int32_t>(cell));
      pairs.push_back(static_cast<std::int32_t>(cell + step[axis]));
    }
  }
  riis_mesh_faces faces;
  check(riis_mesh_faces_init(&faces, sizeof faces));
  faces.n_cells = mesh.n_nodes();
  faces.n_faces = static_cast<std::int64_t>(pairs.size() / 2);
  faces.owner = pairs.data();
  faces.neighbor = pairs.data() + 1;
  faces.stride = 2;
  faces.n_threads = threads_of(state);
  for (auto _ : state) {
    riis_adjacency *adjacency = nullptr;
    check(riis_adjacency_create_from_faces(&faces, &adjacency));
    riis_adjacency_destroy(&adjacency);
  }
  state.counters["nodes"] = static_cast<double>(mesh.n_nodes());
  count_time_per(state, "time/node", static_cast<double>(mesh.n_nodes()));
}

void search_adjacency_of_grid(benchmark::State &state) {
  const CylinderMesh &mesh = mesh_of(state);
  for (auto _ : state) {
    riis_adjacency *adjacency = nullptr;
    check(riis_adjacency_create_from_grid(mesh.n_across(), mesh.n_across(), mesh.n_along(), threads_of(state),
                                          &adjacency));
    riis_adjacency_destroy(&adjacency);
  }
  state.counters["nodes"] = static_cast<double>(mesh.n_nodes());
  count_time_per(state, "time/node", static_cast<double>(mesh.n_nodes()));
}

// The sizes of the meshes are close to those of the paper's meshes. The measurements use the paper's numbers of threads.
const std::vector<std::int64_t> valves{0, 1}, sizes{110, 260, 500, 1000, 1480}, threads{1, 2, 4, 8, 12};

void with(benchmark::internal::Benchmark *benchmark, const std::vector<std::vector<std::int64_t>> &arguments) {
  benchmark->ArgsProduct(arguments)->Unit(benchmark::kMillisecond)->UseRealTime();
}
void of_every_size(benchmark::internal::Benchmark *benchmark) { with(benchmark, {valves, sizes, threads}); }
// The arguments of benchmarks that do not depend on the valve.
void of_every_mesh(benchmark::internal::Benchmark *benchmark) { with(benchmark, {{0}, {110, 500, 1000}, {1, 2}}); }
void of_the_smallest(benchmark::internal::Benchmark *benchmark) { with(benchmark, {valves, {110}, {1}}); }

BENCHMARK(search_exhaustive)->Apply(of_every_size);
BENCHMARK(search_clusters)->Apply(of_every_size);
BENCHMARK(search_neighbor_cold)->Apply(of_every_size);
BENCHMARK(search_neighbor_warm)->Apply(of_every_size);
BENCHMARK(search_paper)->Apply(of_every_size);
BENCHMARK(search_all_distances)->Apply(of_every_size);
BENCHMARK(search_paper_exhaustive)->Apply(of_every_size);
BENCHMARK(search_paper_neighbor)->Apply(of_every_size);
BENCHMARK(search_every_triangle)->Apply(of_the_smallest);
BENCHMARK(search_groups)->Apply(of_every_mesh);
BENCHMARK(search_adjacency_of_tetrahedra)->Apply(of_every_mesh);
BENCHMARK(search_adjacency_of_faces)->Apply(of_every_mesh);
BENCHMARK(search_adjacency_of_grid)->Apply(of_every_mesh);

}  // namespace
