// SPDX-License-Identifier: Apache-2.0
// What the library's marking is compared with, written plainly and compiled with the same flags: the paper's neighbour search, over a
// distance of one's choice, and a pass over the coordinates.
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

// The least distance to any triangle, by asking all of them (paper, 4.1).
class EveryTriangle {
 public:
  explicit EveryTriangle(const Triangles &triangles) : triangles_(triangles) {}
  double operator()(const double *p, double limit) const;

 private:
  const Triangles &triangles_;
};

// The same by an Embree point query of a radius: a primitive a triangle, distances in double precision. More than the limit where no
// triangle is within it.
class PointQuery {
 public:
  explicit PointQuery(const Triangles &triangles);
  ~PointQuery();
  double operator()(const double *p, double limit) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// The paper's neighbour search (4.2.2): breadth first through marked nodes, begun for every leaflet at the node nearest to it. Its queue
// is taken level by level, so that threads can share it.
class PaperSearch {
 public:
  PaperSearch(std::int64_t n_nodes, const double *xyz, const riis_csr &rows)
      : n_nodes_(n_nodes), xyz_(xyz), rows_(rows) {}

  // Finds where to begin; not part of a search, which has the last marking.
  void begin_at(const Triangles &triangles);
  // How many nodes are marked; how many were asked is in n_asked().
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

// The least distance of a node from the origin, squared: reads every coordinate once.
double pass_over_coordinates(std::int64_t n_nodes, const double *xyz, int n_threads);

}  // namespace bench
