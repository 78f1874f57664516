// SPDX-License-Identifier: Apache-2.0
// Declares a competitor of the library's marking, which is built if CGAL was found. The competitor uses CGAL's tree of boxes
// around triangles (AABB_tree).
#pragma once

#include <cstdint>
#include <memory>

#include "references.hpp"

namespace bench {

// Computes the distances of nodes. A node beyond the limit gets infinity. This class is the fastest way to get distances from
// CGAL. Times on one thread, with a million nodes of which 3 % are marked, and 2456 triangles:
//
//   this class: a traversal with a shrinking limit, after a test of the tree's own box                50 ms
//   the same with CGAL's test of a sphere and a box instead of the distance of a box                  62 ms
//   the same without the test of the tree's own box; or beginning with the last node's triangle       54, 50 ms
//   do_intersect of a sphere, which gives marks but no distances                                      44 ms
//   the same, then the traversal above, or squared_distance, for the nodes that it finds              65, 82 ms
//   closest_point as provided, with the k-d tree of hints (accelerate_distance_queries)             2380 ms
//   the same after a test of the tree's own box; with the last closest point as the hint       672, 550 ms
//   this class with triangles behind an iterator, not cached in the tree                              56 ms
class CgalQuery {
 public:
  explicit CgalQuery(const Triangles &triangles);
  ~CgalQuery();
  // distance: (n_nodes). xyz: (3, n_nodes). If the limit is infinite, the search for a node starts from the distance to the
  // triangle that the last search found.
  void distances(std::int64_t n_nodes, const double *xyz, double limit, int n_threads, double *distance) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bench
