// SPDX-License-Identifier: Apache-2.0
#include "program/svmultiphysics/uris_leaflets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "common/array_view.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/valve_source.hpp"

namespace riis::program {

namespace {

// The largest number of triangles. With more triangles, a text file would be too large to be useful, even with few frames.
constexpr std::int64_t most_triangles = 2000000;

template <class Use>
void for_all_frames(const UrisMotion &motion, const Use &use) {
  for (const std::vector<double> *openings : {&motion.opening, &motion.closing})
    for (const double opening : *openings) use(opening);
}

}  // namespace

UrisLeaflets::UrisLeaflets(const ExportOptions &options, const UrisMotion &motion)
    : subject_(subject_of(options)), valve_(make_valve(options)), net_(0, {}) {
  check(riis_valve_set_scalar(valve_, "opening", motion.opening[0]), subject_);
  riis_surface_options how = options.surface_options;
  how.triangulation = RIIS_TRIANGULATION_FIXED;
  how.scale *= options.to_solver;
  if (how.half_thickness > 0) how.half_thickness *= options.to_solver;
  for (double &x : how.translation) x *= options.to_solver;
  surface_ = create_for<Surface>(subject_, riis_surface_create, valve_, &how);
  const riis_surface_info info = info_of(surface_);
  half_thickness_ = info.half_thickness;
  double largest = half_thickness_;
  for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(info.lower[k]), std::abs(info.upper[k])});
  grid_ = uris_grid(largest);
  housing_ = info.housing_leaflet_id;
  ring_ = options.ring;
  std::vector<FinerTriangles::Triangle> lasting = lasting_triangles(motion);
  net_ = FinerTriangles(info.n_vertices, std::move(lasting));
  refine(motion, options.largest_edge, options.to_solver);
  find_forward(motion.opening[0]);
  if (ring_ == ring_face) turn_ring(motion.opening[0]);
  part(options);
  add_box(motion);
}

std::vector<double> UrisLeaflets::vertices_at(double opening) {
  open_to(opening);
  const riis_triangles triangles = triangles_of(surface_);
  std::vector<double> all(triangles.xyz, triangles.xyz + 3 * triangles.n_vertices);
  net_.append_middles(all);
  for (double &x : all) x = std::nearbyint(x / grid_) * grid_;
  if (box_) box_->append_nodes(all);
  return all;
}

std::int64_t UrisLeaflets::n_triangles() const { return view(net_.triangles()).size(); }

void UrisLeaflets::open_to(double opening) {
  check(riis_valve_set_scalar(valve_, "opening", opening), subject_);
  check(riis_surface_update(surface_, valve_, nullptr), subject_);
}

// Returns the triangles that have an area in all frames. A triangle without area has no normal, and the solver would divide by
// zero.
std::vector<FinerTriangles::Triangle> UrisLeaflets::lasting_triangles(const UrisMotion &motion) {
  struct Seen {
    FinerTriangles::Triangle triangle;
    std::size_t n_frames = 0;
  };
  std::vector<Seen> seen;  // by triangle_id
  std::size_t n_frames = 0;
  for_all_frames(motion, [&](double opening) {
    open_to(opening);
    const riis_triangles triangles = triangles_of(surface_);
    const std::int64_t n = triangles.n_triangles;
    const std::int64_t *const vertex = triangles.vertex_id, *const id = triangles.triangle_id;
    if (n > 0 && id[n - 1] >= view(seen).size()) resize(seen, id[n - 1] + 1);
    for (std::int64_t i = 0; i < n; ++i) {
      Seen &of = view(seen)[id[i]];
      of.triangle = {{vertex[3 * i], vertex[3 * i + 1], vertex[3 * i + 2]}, triangles.leaflet_id[i]};
      ++of.n_frames;
    }
    ++n_frames;
  });
  std::vector<FinerTriangles::Triangle> lasting;
  for (const Seen &of : seen) {
    if (ring_ == no_ring && of.triangle.leaflet == housing_) continue;
    if (of.n_frames == n_frames) lasting.push_back(of.triangle);
    n_left_out_ += of.n_frames > 0 && of.n_frames < n_frames;
  }
  return lasting;
}

void UrisLeaflets::refine(const UrisMotion &motion, double largest_edge, double to_solver) {
  do {
    if (n_triangles() > most_triangles) {
      refuse_usage("--largest-edge: " + shortest(largest_edge) + " makes more than " + std::to_string(most_triangles) +
                   " triangles");
    }
    for_all_frames(motion, [&](double opening) { net_.measure(vertices_at(opening)); });
    longest_edge_ = net_.longest_edge();
  } while (largest_edge > 0 && net_.halve_longer(largest_edge * to_solver));
}

void UrisLeaflets::find_forward(double opening) {
  const std::vector<double> xyz = vertices_at(opening);
  for (const auto &[corners, leaflet] : net_.triangles()) {
    if (leaflet == housing_) continue;
    forward_ = forward_ + twice_area(xyz, corners);
  }
  const double length = norm(forward_);
  if (!(length > 0))
    refuse_data((subject_.empty() ? "" : subject_ + ": ") +
                "the normals of the leaflets cancel, so the direction of forward flow is not known");
  for (double &x : forward_) x /= length;
}

void UrisLeaflets::part(const ExportOptions &options) {
  std::map<std::int32_t, std::vector<Corners>> by_leaflet;
  for (const auto &[corners, leaflet] : net_.triangles()) by_leaflet[leaflet].push_back(corners);
  for (auto &[id, triangles] : by_leaflet) {
    UrisLeaflet leaflet{file_name_of_leaflet(options.valve, id), {}, std::move(triangles)};
    for (const Corners &corners : leaflet.triangles)
      leaflet.nodes.insert(leaflet.nodes.end(), corners.begin(), corners.end());
    std::sort(leaflet.nodes.begin(), leaflet.nodes.end());
    leaflet.nodes.erase(std::unique(leaflet.nodes.begin(), leaflet.nodes.end()), leaflet.nodes.end());
    for (Corners &corners : leaflet.triangles)
      for (std::int64_t &vertex : corners)
        vertex = std::lower_bound(leaflet.nodes.begin(), leaflet.nodes.end(), vertex) - leaflet.nodes.begin();
    leaflets_.push_back(std::move(leaflet));
  }
}

// Turns the triangles of the ring so that their normals point against the flow. The solver then takes upstream nodes inside the
// ring for nodes on the upstream side of the valve.
void UrisLeaflets::turn_ring(double opening) {
  const std::vector<double> xyz = vertices_at(opening);
  const auto middle_of = [&](const Corners &corners) {
    Vector3 middle{};
    for (const std::int64_t vertex : corners)
      for (std::size_t k = 0; k < 3; ++k) middle[k] += vertex_of(xyz, vertex)[k] / 3;
    return middle;
  };
  Vector3 centre{};
  double n = 0;
  for (const auto &[corners, leaflet] : net_.triangles()) {
    if (leaflet != housing_) continue;
    const Vector3 middle = middle_of(corners);
    for (std::size_t k = 0; k < 3; ++k) centre[k] = (centre[k] * n + middle[k]) / (n + 1);
    ++n;
  }
  for (std::size_t i = 0; i < net_.triangles().size(); ++i) {
    const auto &[corners, leaflet] = net_.triangles()[i];
    if (leaflet != housing_) continue;
    if (dot(middle_of(corners) - centre, twice_area(xyz, corners)) < 0) net_.turn(i);
  }
}

// Adds the triangles that widen the box. If several triangles are equally near, the solver takes the first. The face "box"
// therefore comes last.
void UrisLeaflets::add_box(const UrisMotion &motion) {
  std::vector<Corners> triangles;
  for (const auto &[corners, leaflet] : net_.triangles()) triangles.push_back(corners);
  const std::vector<double> first = vertices_at(motion.opening.front()), last = vertices_at(motion.opening.back());
  box_.emplace(std::move(triangles), first, last, half_thickness_, grid_);
  UrisLeaflet face{"box", {}, {}};
  for (std::int64_t i = 0; i < UrisBox::n_nodes; ++i)
    face.nodes.push_back(static_cast<std::int64_t>(first.size()) / 3 + i);
  for (std::int64_t i = 0; i < UrisBox::n_nodes; i += 3) face.triangles.push_back({i, i + 1, i + 2});
  leaflets_.push_back(std::move(face));
}

// ---- Uris box ----

namespace {

// The solver widens its box by the factor solver_share. The bands in which the solver measures pressures end at end_of_bands half
// thicknesses. With the factor 1 + 1e-6, nodes at the end of the bands are inside the box.
constexpr double solver_share = 0.1, end_of_bands = 5 * (1 + 1e-6);

Box box_of_corners(const std::vector<Corners> &triangles, const std::vector<double> &xyz) {
  Box box = empty_box();
  for (const Corners &corners : triangles)
    for (const std::int64_t vertex : corners) box.grow(xyz.data() + 3 * vertex);
  return box;
}

double middle(const Box &box, std::size_t k) { return (box.lower[k] + box.upper[k]) / 2; }

double sum_of(const Corners &corners, const std::vector<double> &xyz, std::size_t k) {
  double sum = 0;
  for (const std::int64_t vertex : corners) sum += view(xyz)[3 * vertex + static_cast<std::int64_t>(k)];
  return sum;
}

}  // namespace

double uris_grid(double largest) {
  constexpr int free_bits = 7;
  return std::ldexp(1, std::ilogb(largest) + 1 + free_bits - std::numeric_limits<double>::digits);
}

UrisBox::UrisBox(std::vector<Corners> triangles, const std::vector<double> &first, const std::vector<double> &last,
                 double half_thickness, double grid)
    : triangles_(std::move(triangles)), half_thickness_(half_thickness), grid_(grid) {
  const Box at_first = box_of_corners(triangles_, first), at_last = box_of_corners(triangles_, last);
  for (std::size_t k = 0; k < 3; ++k) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const double off = std::max(std::abs(sum_of(triangles_[i], first, k) / 3 - middle(at_first, k)),
                                  std::abs(sum_of(triangles_[i], last, k) / 3 - middle(at_last, k)));
      if (!(off < least)) continue;
      least = off;
      chosen_[k] = i;
    }
  }
}

void UrisBox::append_nodes(std::vector<double> &xyz) const {
  const Box box = box_of_corners(triangles_, xyz);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double nodes[3][3];  // first index: corner; second index: coordinate
    for (std::size_t k = 0; k < 3; ++k) {
      const double sum = sum_of(triangles_[chosen_[axis]], xyz, k), at = sum / 3;
      const double half = (box.upper[k] - box.lower[k]) / 2,
                   wanted = std::max(half, (half + end_of_bands * half_thickness_) / (1 + 2 * solver_share));
      // Along its axis, the added triangle extends equally far in both directions. Across the axis, the triangle has a width, so
      // that its area is not 0.
      const double reach = wanted + std::abs(at - middle(box, k));
      const double across = k == (axis + 1) % 3 ? half_thickness_ : 0;
      const double offsets[2] = {k == axis ? reach : across, k == axis ? -reach : across};
      for (std::size_t c = 0; c < 2; ++c) nodes[c][k] = std::nearbyint((at + offsets[c]) / grid_) * grid_;
      nodes[2][k] = sum - nodes[0][k] - nodes[1][k];
    }
    for (const auto &node : nodes) xyz.insert(xyz.end(), node, node + 3);
  }
}

// ---- Finer triangles ----

FinerTriangles::FinerTriangles(std::int64_t n_given, std::vector<Triangle> triangles)
    : n_given_(n_given), triangles_(std::move(triangles)) {
  find_edges();
}

double FinerTriangles::longest_edge() const {
  double longest = 0;
  for (const Edge &edge : edges_) longest = std::max(longest, edge.length);
  return longest;
}

void FinerTriangles::append_middles(std::vector<double> &xyz) const {
  xyz.reserve(xyz.size() + 3 * middles_.size());
  for (const Edge &edge : middles_)
    for (std::int64_t k = 0; k < 3; ++k) xyz.push_back(0.5 * (view(xyz)[3 * edge.a + k] + view(xyz)[3 * edge.b + k]));
}

void FinerTriangles::measure(const std::vector<double> &xyz) {
  for (Edge &edge : edges_) edge.length = std::max(edge.length, norm(vertex_of(xyz, edge.a) - vertex_of(xyz, edge.b)));
}

bool FinerTriangles::halve_longer(double length) {
  // For a halved edge, the list has the number of the vertex in the middle of the edge. For any other edge, it has -1.
  std::vector<std::int64_t> middle;
  for (const Edge &edge : edges_) {
    middle.push_back(edge.length > length ? n_given_ + view(middles_).size() : -1);
    if (edge.length > length) middles_.push_back(edge);
  }
  std::vector<Triangle> cut;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto &[corners, leaflet] = triangles_[i];
    const auto add = [&cut, id = leaflet](std::int64_t a, std::int64_t b, std::int64_t c) {
      cut.push_back({{a, b, c}, id});
    };
    std::array<std::int64_t, 3> middles{};
    std::size_t n_cut = 0, last_cut = 0, whole = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      middles[k] = view(middle)[edge_of(i, k)];
      n_cut += middles[k] >= 0;
      (middles[k] >= 0 ? last_cut : whole) = k;
    }
    if (n_cut == 0) {
      add(corners[0], corners[1], corners[2]);
    } else if (n_cut == 1) {
      const std::size_t k = last_cut, next = (k + 1) % 3, other = (k + 2) % 3;
      add(corners[k], middles[k], corners[other]);
      add(middles[k], corners[next], corners[other]);
    } else if (n_cut == 2) {
      // Two edges are halved, and the edge from a to b is not.
      const std::size_t k = whole, next = (k + 1) % 3, other = (k + 2) % 3;
      const std::int64_t a = corners[k], b = corners[next], c = corners[other], bc = middles[next], ca = middles[other];
      add(ca, bc, c);
      const bool bc_is_longer = view(edges_)[edge_of(i, next)].length > view(edges_)[edge_of(i, other)].length;
      add(a, b, bc_is_longer ? bc : ca);
      bc_is_longer ? add(a, bc, ca) : add(ca, b, bc);
    } else {
      for (std::size_t k = 0; k < 3; ++k) add(corners[k], middles[k], middles[(k + 2) % 3]);
      add(middles[0], middles[1], middles[2]);
    }
  }
  const bool was_cut = cut.size() > triangles_.size();
  triangles_ = std::move(cut);
  if (was_cut) find_edges();
  return was_cut;
}

void FinerTriangles::find_edges() {
  std::vector<Corners> corners;
  for (const Triangle &triangle : triangles_) corners.push_back(triangle.corners);
  edges_.clear();
  triangle_edges_.assign(triangles_.size(), {});
  for_each_edge(sorted_sides(corners), [&](const TriangleSide *side, std::size_t n_sides) {
    for (std::size_t i = 0; i < n_sides; ++i) view(triangle_edges_)[side[i].triangle][side[i].k] = view(edges_).size();
    edges_.push_back({side->a, side->b, 0});
  });
}

}  // namespace riis::program
