// SPDX-License-Identifier: Apache-2.0
// ./run bench ranks: measures the cost of a time step on each rank of a partitioned mesh, for the table of docs/solvers.md. METIS
// cuts a mesh of a million nodes into 2 to 64 parts. The ranks' steps run here one after the other, on one thread. The marks of
// all parts together must equal those of the whole mesh, bit for bit. Otherwise the program ends with status 1.
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

// Returns the part of each node. Every kind of weight is balanced between the parts.
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

// A rank, with a whole surface of its own and the nodes of one part.
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
    surface_ = make_surface(valve_.get(), &options);
    check(riis_mark_options_init(&marking_, sizeof marking_));
    marking_.n_threads = 1;
    marking_.fields = RIIS_FIELD_VELOCITY;
    check(riis_resistance_init(&resistance_, sizeof resistance_));
    resistance_.R = 1;
    K_.resize(ids_.size());
    K_u_surface_.resize(3 * ids_.size());
  }

  // Runs time steps, and keeps the median time of each of their parts.
  void run() {
    std::vector<double> updates, markings;
    for (int i = 0; i < n_steps; ++i) {
      move();
      const auto start = std::chrono::steady_clock::now();
      check(riis_surface_update_moving(surface_.get(), valve_.get(), before_.get(), 1e-3, nullptr, nullptr));
      const auto updated = std::chrono::steady_clock::now();
      check(riis_mark_nodes(surface_.get(), mesh_.get(), &marking_, result_.get()));
      add_resistance(result_.get(), resistance_, K_, K_u_surface_.data());
      updates.push_back(milliseconds_of(updated - start));
      markings.push_back(milliseconds_of(std::chrono::steady_clock::now() - updated));
    }
    update = median(updates);
    marking = median(markings);
  }

  // Appends the marked nodes of the last step, with their numbers in the whole mesh.
  void append_marks(NodeDistances &marks) const {
    const riis_mark_list marked = marked_in(result_.get());
    for (std::int64_t i = 0; i < marked.n_nodes; ++i)
      marks.emplace_back(ids_[static_cast<std::size_t>(marked.node_id[i])], marked.distance[i]);
  }
  std::int64_t n_marked() const { return stats_of(result_.get()).n_marked; }

  double update = 0, marking = 0;  // milliseconds a step

 private:
  void move() {
    step_ = (step_ + 1) % 10;
    check(riis_valve_set_scalar(before_.get(), "opening", opening_));
    check(riis_valve_set_scalar(valve_.get(), "opening", opening_ = 0.001 * (step_ < 5 ? step_ : 10 - step_)));
  }

  std::vector<std::int64_t> ids_;
  std::vector<double> xyz_;
  Valve valve_, before_;
  Mesh mesh_;
  Surface surface_;
  Result result_ = make_result();
  riis_mark_options marking_;
  riis_resistance resistance_;
  std::vector<double> K_, K_u_surface_;
  int step_ = 0;
  double opening_ = 0;
};

struct Cost {
  double update = 0, marking_mean = 0, marking_most = 0, step_most = 0, marked_mean = 0, marked_most = 0;
  int n_empty = 0;  // number of ranks without a marked node
};

Cost cost_of(const CylinderNodes &nodes, const std::vector<idx_t> &part, idx_t n_parts, NodeDistances &marks) {
  std::vector<std::vector<std::int64_t>> ids(static_cast<std::size_t>(n_parts));
  for (std::size_t i = 0; i < part.size(); ++i)
    ids[static_cast<std::size_t>(part[i])].push_back(static_cast<std::int64_t>(i));
  Cost cost;
  std::vector<double> updates;
  marks.clear();
  for (std::vector<std::int64_t> &of_rank : ids) {
    Rank rank(nodes, std::move(of_rank));
    rank.run();
    rank.append_marks(marks);
    const auto n_marked = static_cast<double>(rank.n_marked());
    updates.push_back(rank.update);
    cost.marking_mean += rank.marking / n_parts;
    cost.marking_most = std::max(cost.marking_most, rank.marking);
    cost.marked_mean += n_marked / n_parts;
    cost.marked_most = std::max(cost.marked_most, n_marked);
    cost.n_empty += n_marked == 0;
  }
  // Every rank makes the same surface, so one time stands for all.
  cost.update = median(updates);
  cost.step_most = cost.update + cost.marking_most;
  std::sort(marks.begin(), marks.end());
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
  NodeDistances whole, together;
  const Cost alone = cost_of(nodes, std::vector<idx_t>(n, 0), 1, whole);
  std::printf(
      "The mitral valve near opening 0, %lld nodes, %zu marked. On one rank a step takes %.2f ms: %.2f for the surface "
      "and its velocity, %.2f for marks, K and K u_surface.\n\n",
      static_cast<long long>(nodes.n_nodes()), whole.size(), alone.step_most, alone.update, alone.marking_most);
  std::printf(
      "| ranks | METIS balances | without marked nodes | marked: mean | most | surface, ms | marks: mean, ms | most, "
      "ms "
      "| step of the slowest, ms | marking is faster by |\n|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<idx_t> equal(n, 1), both(2 * n, 0);
  for (std::size_t i = 0; i < n; ++i) both[2 * i] = 1;
  for (const auto &mark : whole) both[2 * static_cast<std::size_t>(mark.first) + 1] = 1;
  for (const idx_t n_parts : {2, 4, 8, 16, 32, 64}) {
    for (std::vector<idx_t> *weights : {&equal, &both}) {
      const Cost cost = cost_of(nodes, partition(graph, n_parts, *weights), n_parts, together);
      if (!same_bits(whole, together)) {
        std::fprintf(stderr, "the marks of %lld parts differ from the marks of the whole mesh\n",
                     static_cast<long long>(n_parts));
        return 1;
      }
      std::printf("| %lld | %s | %d | %.0f | %.0f | %.2f | %.2f | %.2f | %.2f | %.1f |\n",
                  static_cast<long long>(n_parts), weights == &equal ? "nodes" : "nodes and band", cost.n_empty,
                  cost.marked_mean, cost.marked_most, cost.update, cost.marking_mean, cost.marking_most, cost.step_most,
                  alone.marking_most / cost.marking_most);
    }
  }
  std::printf("\nThe marks of all parts together equal the marks of the whole mesh, bit for bit.\n");
  return 0;
}
