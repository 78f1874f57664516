// SPDX-License-Identifier: Apache-2.0
// In: the marked pieces of a mesh. Out: measures of one valve's band that matter for a flow: the mesh edges across it, and the
// open regions that it parts.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "program/mark/leaks.hpp"
#include "program/mark/mesh_pieces.hpp"
#include "program/output/report.hpp"

namespace riis::program {

class BandMeasures {
 public:
  // Adds a piece, which has its neighbours. Returns the open region of each node.
  std::vector<std::int64_t> add(const Piece &piece, const riis_marks *marks, const riis_mark_options &options);
  // Writes the measures of all ranks into the report.
  void judge(const MatchedNodes &matched, double half_thickness, FlowReport &report) const;

 private:
  // Lengths of the edges with a marked node.
  struct Lengths {
    std::int64_t n = 0;
    long double sum = 0;  // so that the mean hardly depends on the pieces
    double shortest = std::numeric_limits<double>::infinity(), longest = 0;

    void add(const Lengths &other);
  };
  void add_lengths(const Piece &piece, const riis_mark_list &marked);

  std::optional<riis_cells_across> of_whole_;
  Lengths lengths_;                // of edges that no other piece has
  std::vector<KeyedEdge> shared_;  // edges between two shared nodes, which may be in several pieces
  std::int64_t n_regions_ = 0;
};

}  // namespace riis::program
