// SPDX-License-Identifier: Apache-2.0
// In: a valve and the openings of its frames. Out: leaflets whose nodes and triangles stay the same in all frames, and a face that
// widens the box in which the solver looks.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "program/command_line.hpp"
#include "program/finer_triangles.hpp"
#include "program/handles.hpp"
#include "program/uris_box.hpp"
#include "program/uris_motion.hpp"

namespace riis::program {

struct UrisLeaflet {
  std::string name;                 // fit for a file's name
  std::vector<std::int64_t> nodes;  // ascending: a node's vertex
  std::vector<Corners> triangles;   // by the leaflet's own nodes, from 0
  bool is_scaffold;                 // at rest, and on no side of the flow: a housing
};

class UrisLeaflets {
 public:
  // Looks at all frames, and cuts the triangles as the options say.
  UrisLeaflets(const Options &options, const UrisMotion &motion);

  const riis_valve *valve() const { return valve_.get(); }
  const std::vector<UrisLeaflet> &leaflets() const { return leaflets_; }
  // Returns all vertices at an opening, xyz(3, n): multiples of a power of two, so that the solver's sums of them are exact.
  std::vector<double> vertices_at(double opening);
  // The mean normal of the leaflets, without a housing, in the first frame: forward flow.
  const std::array<double, 3> &forward() const { return forward_; }
  double half_thickness() const { return half_thickness_; }
  double longest_edge() const { return longest_edge_; }
  std::int64_t n_triangles() const;
  // Triangles that have an area in some frames only, and are left out.
  std::int64_t n_left_out() const { return n_left_out_; }

 private:
  void open_to(double opening);
  std::vector<FinerTriangles::Triangle> lasting_triangles(const UrisMotion &motion);
  void refine(const UrisMotion &motion, double largest_edge);
  void find_forward(double opening);
  void part(const Options &options);
  void add_boxes(const UrisMotion &motion);

  std::string subject_;
  Valve valve_;
  Surface surface_;
  FinerTriangles net_;
  std::vector<UrisBox> boxes_;
  std::vector<UrisLeaflet> leaflets_;
  std::array<double, 3> forward_{};
  double half_thickness_ = 0, longest_edge_ = 0, grid_ = 0;
  std::int64_t housing_ = -1, n_left_out_ = 0;
};

}  // namespace riis::program
