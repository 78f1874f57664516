// SPDX-License-Identifier: Apache-2.0
// Declares plain competitors of the library's marking, compiled with the library's flags. The competitors are the paper's
// neighbour search, with a choice of methods for distances, and a pass over the coordinates.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace bench {

// The corners of a surface's triangles, (3, 3, n).
struct Triangles {
  std::vector<double> corners;
  std::vector<std::int32_t> leaflet_id;

  explicit Triangles(const riis_surface *surface);
  std::int64_t n() const { return static_cast<std::int64_t>(leaflet_id.size()); }
};

// Computes the least distance to any triangle by measuring all triangles (paper, 4.1). The edges of a triangle and their products
// do not depend on the point, so they are computed once.
class EveryTriangle {
 public:
  explicit EveryTriangle(const Triangles &triangles);
  double operator()(const double *p, double limit) const;

 private:
  struct Prepared {
    double a[3], ab[3], ac[3];
    double ab_ab, ab_ac, ac_ac;
    double by_ab, by_ac, by_bc, by_area;  // inverses of the squares of the edges, and of the parallelogram's area
  };
  std::vector<Prepared> triangles_;
};

// Computes the least distance to any triangle by an Embree point query with a radius. Each triangle is a primitive, and distances
// are in double precision. If all triangles are beyond the limit, the result is above the limit.
class PointQuery {
 public:
  explicit PointQuery(const Triangles &triangles);
  ~PointQuery();
  double operator()(const double *p, double limit) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// The paper's neighbour search (4.2.2). The search goes breadth first through marked nodes. For every leaflet the search begins
// at the node that is nearest to the leaflet. The queue is processed level by level, so that threads can share a level.
class PaperSearch {
 public:
  PaperSearch(std::int64_t n_nodes, const double *xyz, const riis_csr &rows)
      : n_nodes_(n_nodes), xyz_(xyz), rows_(rows) {}

  // Finds the nodes where the first search begins. Later searches begin at the nodes of the last marking.
  void begin_at(const Triangles &triangles);
  // Returns the number of marked nodes. n_asked() returns the number of queried nodes.
  template <class Distance>
  std::int64_t run(const Distance &distance, double half_thickness, int n_threads);
  std::int64_t n_asked() const { return n_asked_; }

 private:
  std::int64_t n_nodes_;
  const double *xyz_;
  riis_csr rows_;
  std::vector<std::int64_t> starts_;
  std::vector<std::uint8_t> was_seen_;
  std::int64_t n_asked_ = 0;
};

// Returns the least squared distance from the origin to a node. The loop reads every coordinate once.
double pass_over_coordinates(std::int64_t n_nodes, const double *xyz, int n_threads);

}  // namespace bench
