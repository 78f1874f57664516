// SPDX-License-Identifier: Apache-2.0
#include "figures/tetrahedra.hpp"

#include <riis/riis.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>

namespace riis::figures {
namespace {

// The corners 0, a, b, 7 of a tetrahedron in a cube whose corner k is at (k & 1, k >> 1 & 1, k >> 2). There are six paths from 0
// to 7 along edges.
constexpr int ways[6][2] = {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}};

template <class T, void (*destroy)(T **)>
struct Destroy {
  void operator()(T *handle) const { destroy(&handle); }
};
template <class T, void (*destroy)(T **)>
using Handle = std::unique_ptr<T, Destroy<T, destroy>>;

// A place to which a create function writes a handle. The owner takes the handle at the end of the statement.
template <class Owner>
class Out {
 public:
  explicit Out(Owner &owner) : owner_(owner) {}
  ~Out() { owner_.reset(made_); }
  operator typename Owner::pointer *() { return &made_; }  // NOLINT(google-explicit-constructor): a place to write to

 private:
  Owner &owner_;
  typename Owner::pointer made_ = nullptr;
};
template <class Owner>
Out<Owner> out(Owner &owner) {
  return Out<Owner>(owner);
}

void check(riis_status status) {
  if (status != RIIS_OK) throw std::runtime_error(riis_last_error());
}

}  // namespace

TetrahedralMesh mesh_cylinder(const Cylinder &cylinder, double edge) {
  const auto n_across = static_cast<std::int64_t>(std::ceil(2 * cylinder.radius / edge)),
             n_up = static_cast<std::int64_t>(std::ceil(cylinder.height / edge));
  TetrahedralMesh mesh;
  const auto from_minus_one = [](std::int64_t i, std::int64_t n) {
    return 2.0 * static_cast<double>(i) / static_cast<double>(n) - 1;
  };
  for (std::int64_t k = 0; k <= n_up; ++k)
    for (std::int64_t j = 0; j <= n_across; ++j)
      for (std::int64_t i = 0; i <= n_across; ++i) {
        // Maps a square to a disc: its grid lines become parts of ellipses.
        const double x = from_minus_one(i, n_across), y = from_minus_one(j, n_across);
        const Vec3 on_disc{x * std::sqrt(1 - 0.5 * y * y), y * std::sqrt(1 - 0.5 * x * x), 0};
        const Vec3 p =
            cylinder.middle + cylinder.radius * on_disc + Vec3{0, 0, 0.5 * cylinder.height * from_minus_one(k, n_up)};
        mesh.xyz.insert(mesh.xyz.end(), {p.x, p.y, p.z});
      }
  const std::int64_t n = n_across + 1;
  for (std::int64_t k = 0; k < n_up; ++k)
    for (std::int64_t j = 0; j < n_across; ++j)
      for (std::int64_t i = 0; i < n_across; ++i) {
        const auto corner = [&](int which) {
          return ((k + (which >> 2)) * n + j + (which >> 1 & 1)) * n + i + (which & 1);
        };
        for (const auto &way : ways) mesh.tetrahedra.push_back({corner(0), corner(way[0]), corner(way[1]), corner(7)});
      }
  return mesh;
}

Marks mark(const TetrahedralMesh &mesh, const char *kind, double opening, double tolerance) {
  Handle<riis_valve, riis_valve_destroy> valve;
  check(riis_valve_create(kind, out(valve)));
  check(riis_valve_set_scalar(valve.get(), "opening", opening));
  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = half_thickness;
  options.tolerance = tolerance;
  Handle<riis_surface, riis_surface_destroy> surface;
  check(riis_surface_create(valve.get(), &options, out(surface)));
  Handle<riis_mesh, riis_mesh_destroy> nodes;
  const double *xyz = mesh.xyz.data();
  check(riis_mesh_create(static_cast<std::int64_t>(mesh.n_nodes()), xyz, xyz + 1, xyz + 2, 3, out(nodes)));
  Handle<riis_marks, riis_marks_destroy> result;
  check(riis_marks_create(out(result)));
  check(riis_mark_nodes(surface.get(), nodes.get(), nullptr, result.get()));
  riis_mark_list marked;
  check(riis_marks_get_list(result.get(), RIIS_LIST_MARKED, &marked, sizeof marked));

  std::vector<std::int32_t> leaflet(mesh.n_nodes(), -1);
  std::vector<double> distance(mesh.n_nodes(), std::numeric_limits<double>::infinity());
  for (std::int64_t i = 0; i < marked.n_nodes; ++i) {
    leaflet[static_cast<std::size_t>(marked.node_id[i])] = marked.leaflet_id[i];
    distance[static_cast<std::size_t>(marked.node_id[i])] = marked.distance[i];
  }
  Marks marks{static_cast<std::size_t>(marked.n_nodes), {}, {}, 0, 0};
  for (const auto &tetrahedron : mesh.tetrahedra) {
    const auto is_marked = [&](std::int64_t node) { return leaflet[static_cast<std::size_t>(node)] >= 0; };
    const bool is_whole = std::all_of(tetrahedron.begin(), tetrahedron.end(), is_marked);
    const auto closest = *std::min_element(tetrahedron.begin(), tetrahedron.end(), [&](std::int64_t a, std::int64_t b) {
      return distance[static_cast<std::size_t>(a)] < distance[static_cast<std::size_t>(b)];
    });
    marks.leaflet.push_back(leaflet[static_cast<std::size_t>(closest)]);
    marks.is_whole.push_back(is_whole);
    marks.n_whole += is_whole;
    marks.n_touched += marks.leaflet.back() >= 0;
  }
  return marks;
}

Faces marked_faces(const TetrahedralMesh &mesh, const Marks &marks) {
  // A face that belongs to two tetrahedra is not on the outside.
  std::map<std::array<std::int64_t, 3>, std::pair<int, std::int32_t>> faces;
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    if (!marks.is_whole[i]) continue;
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<std::int64_t, 3> face{};
      for (std::size_t k = 0; k < 3; ++k) face[k] = mesh.tetrahedra[i][(left_out + 1 + k) % 4];
      std::sort(face.begin(), face.end());
      auto &entry = faces[face];
      ++entry.first;
      entry.second = marks.leaflet[i];
    }
  }
  Faces made{3, {}, {}, {}};
  for (const auto &[face, entry] : faces) {
    if (entry.first > 1) continue;
    for (const std::int64_t node : face) {
      made.corners.push_back(static_cast<std::int64_t>(made.points.size()));
      made.points.push_back(mesh.node(node));
    }
    made.colours.push_back(leaflet_colours.at(static_cast<std::size_t>(entry.second)));
  }
  return made;
}

Faces slice(const TetrahedralMesh &mesh, const Marks &marks, Vec3 normal, Segments &edges) {
  Faces made{3, {}, {}, {}};
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    std::vector<Vec3> before, behind;
    for (const std::int64_t node : mesh.tetrahedra[i])
      (dot(mesh.node(node), normal) < 0 ? before : behind).push_back(mesh.node(node));
    if (before.empty() || behind.empty()) continue;
    // The points go around the section in order: if two corners are in front of the plane and two behind it, the section is a
    // quad.
    Points section;
    for (std::size_t a = 0; a < before.size(); ++a)
      for (std::size_t b = 0; b < behind.size(); ++b) {
        const Vec3 p = before[a], q = behind[a % 2 == 0 ? b : behind.size() - 1 - b];
        section.push_back(mix(p, q, dot(p, normal) / dot(p - q, normal)));
      }
    const auto first = static_cast<std::int64_t>(made.points.size());
    append(made.points, section);
    for (std::size_t k = 0; k < section.size(); ++k) edges.push_back({section[k], section[(k + 1) % section.size()]});
    for (std::size_t k = 1; k + 1 < section.size(); ++k) {
      made.corners.insert(made.corners.end(),
                          {first, first + static_cast<std::int64_t>(k), first + static_cast<std::int64_t>(k) + 1});
      if (marks.leaflet[i] < 0)
        made.colours.push_back({244, 244, 244});
      else
        made.colours.push_back(
            paler(leaflet_colours.at(static_cast<std::size_t>(marks.leaflet[i])), marks.is_whole[i] ? 0 : 0.6));
    }
  }
  return made;
}

}  // namespace riis::figures
