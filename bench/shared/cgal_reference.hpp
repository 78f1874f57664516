// SPDX-License-Identifier: Apache-2.0
// A competitor of the library's marking, if CGAL was found: its tree of boxes round triangles (AABB_tree).
#pragma once

#include <cstdint>
#include <memory>

#include "references.hpp"

namespace bench {

// Computes the distances of all nodes within a limit, each by a query of its own, and infinity for the others. It is the fastest
// of CGAL's ways that give a distance. Times on one thread, with a million nodes of which 3 % are marked, and 2456 triangles:
//
//   a traversal that begins with the limit and shrinks, as here, with the tree's own box before it    50 ms
//   the same with CGAL's test of a sphere and a box in place of the distance of a box                 62 ms
//   the same without the tree's own box before it, or beginning with the last node's triangle         54, 50 ms
//   do_intersect of a sphere, which gives marks and no distances                                      44 ms
//   that, and the traversal above for the nodes that it finds; or squared_distance for these          65, 82 ms
//   closest_point as it comes, with the k-d tree of hints (accelerate_distance_queries)             2380 ms
//   the same after the tree's own box; with the last closest point as the hint                 672, 550 ms
//   the first with triangles behind an iterator, not cached in the tree                               56 ms
class CgalQuery {
 public:
  explicit CgalQuery(const Triangles &triangles);
  ~CgalQuery();
  // distance: (n_nodes). xyz: (3, n_nodes).
  void distances(std::int64_t n_nodes, const double *xyz, double limit, int n_threads, double *distance) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bench
