// SPDX-License-Identifier: Apache-2.0
#include "program/mark/leaks.hpp"

#include <algorithm>
#include <cmath>

#include "common/array_view.hpp"
#include "program/base/handles.hpp"
#include "program/base/ranks.hpp"
#include "program/base/refusal.hpp"

namespace riis::program {

std::vector<std::int64_t> BandMeasures::add(const Piece &piece, const riis_marks *marks,
                                            const riis_mark_options &options) {
  const FileNodes::Lent lent(*piece.mesh);
  riis_mesh *const mesh = piece.mesh->mesh();
  if (piece.nodes.is_whole())
    of_whole_ = get<riis_cells_across>(riis_marks_get_cells_across, marks, mesh);
  else
    add_lengths(piece, list_of(marks, RIIS_LIST_MARKED));
  std::vector<std::int64_t> regions(static_cast<std::size_t>(piece.nodes.n()));
  riis_mark_options how = options;
  how.node_mask = piece.nodes.mask();
  std::int64_t n_regions = 0;
  check(riis_label_open_regions(mesh, marks, &how, piece.nodes.n(), regions.data(), &n_regions));
  n_regions_ += n_regions;
  return regions;
}

void BandMeasures::Lengths::add(const Lengths &other) {
  n += other.n;
  sum += other.sum;
  shortest = std::min(shortest, other.shortest);
  longest = std::max(longest, other.longest);
}

void BandMeasures::add_lengths(const Piece &piece, const riis_mark_list &marked) {
  const PieceNodes &nodes = piece.nodes;
  std::vector<std::uint8_t> is_marked(static_cast<std::size_t>(nodes.n()));
  for (std::int64_t i = 0; i < marked.n_nodes; ++i) view(is_marked)[marked.node_id[i]] = 1;
  for (std::int64_t i = 0; i < nodes.n(); ++i) {
    if (nodes.is_ghost(i)) continue;
    piece.mesh->for_each_neighbor(i, [&](std::int64_t j) {
      if (j < i || nodes.is_ghost(j) || !(view(is_marked)[i] || view(is_marked)[j])) return;
      const double *p = nodes.point(i), *q = nodes.point(j);
      const double length =
          std::sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2]));
      if (!(length > 0)) return;
      if (nodes.is_shared(i) && nodes.is_shared(j))
        shared_.push_back(edge_between(nodes.key(i), nodes.key(j), length));
      else
        lengths_.add({1, length, length, length});
    });
  }
}

void BandMeasures::judge(const MatchedNodes &matched, double half_thickness, FlowReport &report) const {
  Lengths all;
  for (const Lengths &lengths : ranks::gather(std::vector<Lengths>{lengths_})) all.add(lengths);
  for (const KeyedEdge &edge : gathered(shared_)) all.add({1, edge.length, edge.length, edge.length});
  riis_cells_across cells{0, 0, 0, 0, 0, 0, half_thickness, all.n};
  if (all.n > 0) {
    const double mean =
        std::clamp(static_cast<double>(all.sum / static_cast<long double>(all.n)), all.shortest, all.longest);
    const double across = 2 * half_thickness;
    cells = {across / all.longest, across / mean, across / all.shortest, all.shortest, mean, all.longest,
             half_thickness,       all.n};
  }
  report.cells = of_whole_.value_or(cells);
  report.n_open_regions = ranks::sum(n_regions_) - matched.n_joins();
}

}  // namespace riis::program
