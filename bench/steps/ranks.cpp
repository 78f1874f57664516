// SPDX-License-Identifier: Apache-2.0
// ./run bench ranks: measures the cost of a time step on each rank of a partitioned mesh, for the table of docs/performance.md.
// METIS cuts a mesh of a million nodes into 2 to 64 parts. The steps of the ranks run here one after the other, on one thread.
// Adapted and fixed triangulations take turns. The marks of all parts together must equal the marks of the whole mesh, bit for
// bit. Otherwise the program ends with status 1.
//   argv[1]  thousands of nodes instead of a million, for a quick look
#include <metis.h>
#include <riis/riis.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

#include "shared/cylinder.hpp"
#include "shared/handles.hpp"

namespace {

using namespace bench;

constexpr int n_steps = 21;  // steps of each part; their median counts
using NodeDistances = std::vector<std::pair<std::int64_t, double>>;
constexpr std::int32_t triangulations[] = {RIIS_TRIANGULATION_ADAPTED, RIIS_TRIANGULATION_FIXED};
constexpr std::size_t n_triangulations = 2, adapted = 0, fixed_once = 1;

double milliseconds_of(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// The graph of the mesh, in METIS's format.
struct Graph {
  std::vector<idx_t> offsets, columns;
};

Graph graph_of(const CylinderNodes &nodes) {
  const Adjacency adjacency = adjacency_of(nodes.n_nodes(), nodes.tetrahedra(), 0);
  riis_csr rows;
  check(riis_adjacency_get_csr(adjacency.get(), &rows, sizeof rows));
  const auto *offsets = static_cast<const std::int64_t *>(rows.offsets);
  const auto *columns = static_cast<const std::int32_t *>(rows.columns);
  return {{offsets, offsets + nodes.n_nodes() + 1}, {columns, columns + offsets[nodes.n_nodes()]}};
}

// Returns, for each node, the number of its part. Each kind of weight is balanced between the parts.
std::vector<idx_t> partition(Graph &graph, idx_t n_parts, std::vector<idx_t> &weights) {
  auto n_nodes = static_cast<idx_t>(graph.offsets.size() - 1);
  auto n_weights = static_cast<idx_t>(weights.size() / static_cast<std::size_t>(n_nodes)), cut = idx_t{0};
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  std::vector<idx_t> part(static_cast<std::size_t>(n_nodes), 0);
  if (METIS_PartGraphKway(&n_nodes, &n_weights, graph.offsets.data(), graph.columns.data(), weights.data(), nullptr,
                          nullptr, &n_parts, nullptr, nullptr, options, &cut, part.data()) == METIS_OK)
    return part;
  std::fprintf(stderr, "METIS failed to make %lld parts\n", static_cast<long long>(n_parts));
  std::exit(1);
}

// A rank of the partitioned mesh. The rank has separate copies of the whole surfaces, and the nodes of one part.
class Rank {
 public:
  Rank(const CylinderNodes &nodes, std::vector<std::int64_t> ids)
      : ids_(std::move(ids)), valve_(make_valve("mitral")), before_(make_valve("mitral")) {
    for (const std::int64_t id : ids_) {
      const double *at = nodes.xyz().data() + 3 * id;
      xyz_.insert(xyz_.end(), at, at + 3);
    }
    const auto n = static_cast<std::int64_t>(ids_.size());
    riis_mesh *mesh = nullptr;
    check(riis_mesh_create(n, xyz_.data(), xyz_.data() + 1, xyz_.data() + 2, 3, &mesh));
    mesh_ = Mesh(mesh);
    check(riis_mesh_prepare(mesh, 1));
    move();
    riis_surface_options options;
    check(riis_surface_options_init(&options, sizeof options));
    options.n_threads = 1;
    for (std::size_t i = 0; i < n_triangulations; ++i) {
      options.triangulation = triangulations[i];
      sides_[i].surface = make_surface(valve_.get(), &options);
    }
    check(riis_mark_options_init(&marking_, sizeof marking_));
    marking_.n_threads = 1;
    marking_.fields = RIIS_FIELD_VELOCITY;
    check(riis_resistance_init(&resistance_, sizeof resistance_));
    resistance_.R = 1;
    K_.resize(ids_.size());
    K_u_surface_.resize(3 * ids_.size());
  }

  // Runs time steps. Keeps the median time of each part of a step.
  void run() {
    std::vector<double> updates[n_triangulations], markings[n_triangulations];
    for (int i = 0; i < n_steps; ++i) {
      move();
      for (std::size_t k = 0; k < n_triangulations; ++k) {
        const Side &side = sides_[k];
        const auto start = std::chrono::steady_clock::now();
        check(riis_surface_update_moving(side.surface.get(), valve_.get(), before_.get(), 1e-3, nullptr, nullptr));
        const auto updated = std::chrono::steady_clock::now();
        check(riis_mark_nodes(side.surface.get(), mesh_.get(), &marking_, side.result.get()));
        add_resistance(side.result.get(), resistance_, K_, K_u_surface_.data());
        updates[k].push_back(milliseconds_of(updated - start));
        markings[k].push_back(milliseconds_of(std::chrono::steady_clock::now() - updated));
      }
    }
    for (std::size_t k = 0; k < n_triangulations; ++k) {
      sides_[k].update = median(updates[k]);
      sides_[k].marking = median(markings[k]);
    }
  }

  // Appends the marked nodes of the last step, with the ids that they have in the whole mesh.
  void append_marks(std::size_t triangulation, NodeDistances &marks) const {
    const riis_mark_list marked = marked_in(sides_[triangulation].result.get());
    for (std::int64_t i = 0; i < marked.n_nodes; ++i)
      marks.emplace_back(ids_[static_cast<std::size_t>(marked.node_id[i])], marked.distance[i]);
  }
  std::int64_t n_marked() const { return stats_of(sides_[adapted].result.get()).n_marked; }
  double update(std::size_t triangulation) const { return sides_[triangulation].update; }
  double marking(std::size_t triangulation) const { return sides_[triangulation].marking; }

 private:
  void move() {
    step_ = (step_ + 1) % 10;
    check(riis_valve_set_scalar(before_.get(), "opening", opening_));
    check(riis_valve_set_scalar(valve_.get(), "opening", opening_ = 0.001 * (step_ < 5 ? step_ : 10 - step_)));
  }

  // A surface with an adapted or a fixed triangulation, and the results and times of its steps.
  struct Side {
    Surface surface;
    Result result = make_result();
    double update = 0, marking = 0;  // milliseconds a step
  };

  std::vector<std::int64_t> ids_;
  std::vector<double> xyz_;
  Valve valve_, before_;
  Mesh mesh_;
  Side sides_[n_triangulations];
  riis_mark_options marking_;
  riis_resistance resistance_;
  std::vector<double> K_, K_u_surface_;
  int step_ = 0;
  double opening_ = 0;
};

struct Cost {
  struct Times {
    double update = 0, marking_mean = 0, marking_most = 0;
    double step_most() const { return update + marking_most; }
  };
  Times of[n_triangulations];
  double marked_mean = 0, marked_most = 0;
  int n_empty = 0;  // number of ranks without a marked node
};
using Marks = NodeDistances[n_triangulations];

Cost cost_of(const CylinderNodes &nodes, const std::vector<idx_t> &part, idx_t n_parts, Marks &marks) {
  std::vector<std::vector<std::int64_t>> ids(static_cast<std::size_t>(n_parts));
  for (std::size_t i = 0; i < part.size(); ++i)
    ids[static_cast<std::size_t>(part[i])].push_back(static_cast<std::int64_t>(i));
  Cost cost;
  std::vector<double> updates[n_triangulations];
  for (NodeDistances &of_one : marks) of_one.clear();
  for (std::vector<std::int64_t> &of_rank : ids) {
    Rank rank(nodes, std::move(of_rank));
    rank.run();
    for (std::size_t k = 0; k < n_triangulations; ++k) {
      rank.append_marks(k, marks[k]);
      updates[k].push_back(rank.update(k));
      cost.of[k].marking_mean += rank.marking(k) / n_parts;
      cost.of[k].marking_most = std::max(cost.of[k].marking_most, rank.marking(k));
    }
    const auto n_marked = static_cast<double>(rank.n_marked());
    cost.marked_mean += n_marked / n_parts;
    cost.marked_most = std::max(cost.marked_most, n_marked);
    cost.n_empty += n_marked == 0;
  }
  for (std::size_t k = 0; k < n_triangulations; ++k) {
    // Every rank makes the same surface, so the time of one rank holds for all ranks.
    cost.of[k].update = median(updates[k]);
    std::sort(marks[k].begin(), marks[k].end());
  }
  return cost;
}

bool same_bits(const NodeDistances &a, const NodeDistances &b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const auto &one, const auto &other) {
           return one.first == other.first && std::memcmp(&one.second, &other.second, sizeof one.second) == 0;
         });
}

}  // namespace

int main(int argc, char **argv) {
  const CylinderNodes nodes(cylinders[1], n_nodes_given(argc, argv, 1, 10));
  const auto n = static_cast<std::size_t>(nodes.n_nodes());
  Graph graph = graph_of(nodes);
  Marks whole, together;
  const Cost alone = cost_of(nodes, std::vector<idx_t>(n, 0), 1, whole);
  std::printf(
      "The mitral valve near opening 0, %lld nodes, %zu marked. On one rank a step takes %.2f ms: %.2f for the "
      "surface and its velocity, %.2f for marks, K and K u_surface. With a fixed triangulation it takes %.2f ms: "
      "%.2f and %.2f.\n\n",
      static_cast<long long>(nodes.n_nodes()), whole[adapted].size(), alone.of[adapted].step_most(),
      alone.of[adapted].update, alone.of[adapted].marking_most, alone.of[fixed_once].step_most(),
      alone.of[fixed_once].update, alone.of[fixed_once].marking_most);
  std::printf(
      "| ranks | METIS balances | without marked nodes | marked: mean | most | surface, ms | fixed | marks: mean, "
      "ms | fixed | most, ms | fixed | step of the slowest, ms | fixed | marking is faster by "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<idx_t> equal(n, 1), both(2 * n, 0);
  for (std::size_t i = 0; i < n; ++i) both[2 * i] = 1;
  for (const auto &mark : whole[adapted]) both[2 * static_cast<std::size_t>(mark.first) + 1] = 1;
  for (const idx_t n_parts : {2, 4, 8, 16, 32, 64}) {
    for (std::vector<idx_t> *weights : {&equal, &both}) {
      const Cost cost = cost_of(nodes, partition(graph, n_parts, *weights), n_parts, together);
      for (std::size_t k = 0; k < n_triangulations; ++k)
        if (!same_bits(whole[k], together[k])) {
          std::fprintf(stderr, "the marks of %lld parts differ from the marks of the whole mesh\n",
                       static_cast<long long>(n_parts));
          return 1;
        }
      const Cost::Times &a = cost.of[adapted], &f = cost.of[fixed_once];
      std::printf("| %lld | %s | %d | %.0f | %.0f | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %.1f |\n",
                  static_cast<long long>(n_parts), weights == &equal ? "nodes" : "nodes and band", cost.n_empty,
                  cost.marked_mean, cost.marked_most, a.update, f.update, a.marking_mean, f.marking_mean,
                  a.marking_most, f.marking_most, a.step_most(), f.step_most(),
                  alone.of[adapted].marking_most / a.marking_most);
    }
  }
  std::printf("\nThe marks of all parts together equal the marks of the whole mesh, bit for bit.\n");
  return 0;
}
