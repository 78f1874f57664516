// SPDX-License-Identifier: Apache-2.0
// Declares competitors of the library's marking, which are built if VTK was found. vtkStaticCellLocator is VTK's tree of cells
// with a bounded query. vtkImplicitPolyDataDistance is VTK's signed distance, which has no bound. vtkStaticPointLocator has bins
// of points. All three competitors run on one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "references.hpp"

namespace bench {

class VtkLocator {
 public:
  explicit VtkLocator(const Triangles &triangles);
  ~VtkLocator();
  // distance: (n_nodes), with infinity if all triangles are beyond the limit. xyz: (3, n_nodes).
  void distances(std::int64_t n_nodes, const double *xyz, double limit, double *distance) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

class VtkDistance {
 public:
  explicit VtkDistance(const Triangles &triangles);
  ~VtkDistance();
  // Writes the absolute value of the distance.
  void distances(std::int64_t n_nodes, const double *xyz, double *distance) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// Finds the nearest of given points, such as the middles of triangles.
class VtkPoints {
 public:
  // points: (3, n)
  explicit VtkPoints(const std::vector<double> &points);
  ~VtkPoints();
  // distance: (n_nodes), with infinity if all points are beyond the limit. xyz: (3, n_nodes).
  void distances(std::int64_t n_nodes, const double *xyz, double limit, double *distance) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bench
