// SPDX-License-Identifier: Apache-2.0
#include "cut_tubes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "common/array_view.hpp"

namespace riis::tests {

namespace {

using Edge = std::pair<std::int64_t, std::int64_t>;

Vector3 draw_direction(random_source &random) {
  for (;;) {
    Vector3 v;
    for (double &x : v) x = random_between(&random, -1, 1);
    if (norm(v) > 0.1 && norm(v) < 1) return unit_vector(v);
  }
}

// Makes the new vertices on edges, and stores them for later cubes.
class CutPoints {
 public:
  CutPoints(std::vector<Vector3> &points, const std::function<Vector3(std::int64_t, std::int64_t)> &place)
      : points_(points), place_(place) {}
  std::int64_t on(std::int64_t a, std::int64_t b) {
    const Edge edge = std::minmax(a, b);
    const auto [found, is_new] = known_.try_emplace(edge, static_cast<std::int64_t>(points_.size()));
    if (is_new) points_.push_back(place_(edge.first, edge.second));
    return found->second;
  }

 private:
  std::vector<Vector3> &points_;
  const std::function<Vector3(std::int64_t, std::int64_t)> place_;
  std::map<Edge, std::int64_t> known_;
};

double smooth_least(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0);
  return std::min(a, b) - h * h / (4 * width);
}

double distance_to_segment(const Vector3 &x, const Vector3 &to) {
  const double t = std::clamp(dot(x, to) / dot(to, to), 0.0, 1.0);
  return norm(x - t * to);
}

}  // namespace

Triangles surface_of(const std::function<double(const Vector3 &)> &function, const Vector3 &lower, double side,
                     int n_cells) {
  const std::int64_t n = n_cells + 1;
  const double step = side / n_cells;
  const auto place = [&](std::int64_t id) {
    return lower + step * Vector3{static_cast<double>(id % n), static_cast<double>(id / n % n),
                                  static_cast<double>(id / n / n)};
  };
  std::vector<double> value(static_cast<std::size_t>(n * n * n));
  for (std::int64_t id = 0; id < n * n * n; ++id) view(value)[id] = function(place(id));
  Triangles made;
  CutPoints cut_points(made.points, [&](std::int64_t a, std::int64_t b) {
    const double share = view(value)[a] / (view(value)[a] - view(value)[b]);
    return place(a) + share * (place(b) - place(a));
  });
  // The six tetrahedra of a cube around its diagonal.
  constexpr int tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  for (std::int64_t cell = 0; cell < n_cells * n_cells * static_cast<std::int64_t>(n_cells); ++cell) {
    const std::int64_t i = cell % n_cells, j = cell / n_cells % n_cells, k = cell / n_cells / n_cells;
    std::array<std::int64_t, 8> corner;
    int n_inside = 0;
    for (int c = 0; c < 8; ++c) {
      view(corner)[c] = i + (c & 1) + n * (j + (c >> 1 & 1) + n * (k + (c >> 2)));
      n_inside += view(value)[view(corner)[c]] < 0;
    }
    if (n_inside == 0 || n_inside == 8) continue;
    for (const auto &tetrahedron : tetrahedra) {
      std::vector<std::int64_t> inside, outside;
      for (const int c : tetrahedron) (view(value)[view(corner)[c]] < 0 ? inside : outside).push_back(view(corner)[c]);
      if (inside.empty() || outside.empty()) continue;
      std::vector<std::int64_t> polygon;
      if (inside.size() == 2) {
        polygon = {cut_points.on(inside[0], outside[0]), cut_points.on(inside[0], outside[1]),
                   cut_points.on(inside[1], outside[1]), cut_points.on(inside[1], outside[0])};
      } else {
        const auto &one = inside.size() == 1 ? inside : outside, &three = inside.size() == 1 ? outside : inside;
        for (const std::int64_t other : three) polygon.push_back(cut_points.on(one[0], other));
      }
      const Vector3 out = place(outside[0]) - place(inside[0]);
      const auto point = [&](std::size_t c) { return view(made.points)[polygon[c]]; };
      if (dot(cross(point(1) - point(0), point(2) - point(0)), out) < 0) std::reverse(polygon.begin(), polygon.end());
      for (std::size_t c = 2; c < polygon.size(); ++c) made.corners.push_back({polygon[0], polygon[c - 1], polygon[c]});
    }
  }
  return made;
}

CutEnd cut(Triangles &triangles, const Vector3 &point, const Vector3 &outward, double radius, Cap cap,
           random_source &random) {
  const auto height = [&](std::int64_t id) { return dot(view(triangles.points)[id] - point, outward); };
  const auto is_beyond = [&](std::int64_t id) {
    return height(id) > 0 && norm(view(triangles.points)[id] - point) < radius;
  };
  CutPoints cut_points(triangles.points, [&](std::int64_t a, std::int64_t b) {
    const Vector3 &p = view(triangles.points)[a], &q = view(triangles.points)[b];
    return p + height(a) / (height(a) - height(b)) * (q - p);
  });
  std::vector<Corners> kept;
  std::map<std::int64_t, std::int64_t> next;  // for each point of the rim, the next point; the wall is on the left
  for (const Corners &corner : triangles.corners) {
    std::vector<std::int64_t> polygon;
    std::int64_t from = -1, to = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t a = corner[k], b = corner[(k + 1) % 3];
      if (!is_beyond(a)) polygon.push_back(a);
      if (is_beyond(a) == is_beyond(b)) continue;
      polygon.push_back(cut_points.on(a, b));
      (is_beyond(b) ? from : to) = polygon.back();
    }
    for (std::size_t k = 2; k < polygon.size(); ++k) kept.push_back({polygon[0], polygon[k - 1], polygon[k]});
    if (from >= 0) next[from] = to;
  }
  triangles.corners = kept;
  std::vector<std::int64_t> rim{next.begin()->first};
  while (next.at(rim.back()) != rim[0]) rim.push_back(next.at(rim.back()));
  if (rim.size() != next.size()) std::printf("a cut has several rims\n"), std::exit(1);
  CutEnd end;
  end.outward = outward;
  Vector3 middle{};
  for (const std::int64_t id : rim)
    middle = middle + 1.0 / static_cast<double>(rim.size()) * view(triangles.points)[id];
  std::vector<Corners> caps;
  const auto add = [&](std::int64_t a, std::int64_t b, std::int64_t c) {
    caps.push_back({a, b, c});
    const Vector3 &p = view(triangles.points)[a], &q = view(triangles.points)[b], &r = view(triangles.points)[c];
    const double area = 0.5 * dot(cross(q - p, r - p), outward);
    end.area += area;
    end.centre = end.centre + area / 3 * (p + q + r);
  };
  // Rings of points lead from the rim to the middle. Each point is shifted at random within the plane.
  std::vector<std::int64_t> ring = rim;
  const int n_rings = cap == Cap::rings ? 4 : 1;
  for (int i = 1; i < n_rings; ++i) {
    std::vector<std::int64_t> inner;
    for (const std::int64_t id : rim) {
      const double share = 1 - (i + random_between(&random, -0.2, 0.2)) / n_rings;
      inner.push_back(static_cast<std::int64_t>(triangles.points.size()));
      triangles.points.push_back(middle + share * (view(triangles.points)[id] - middle));
    }
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::size_t l = (k + 1) % ring.size();
      add(ring[l], ring[k], inner[k]);
      add(ring[l], inner[k], inner[l]);
    }
    ring = inner;
  }
  const auto last = static_cast<std::int64_t>(triangles.points.size());
  triangles.points.push_back(middle);
  for (std::size_t k = 0; k < ring.size(); ++k) add(ring[(k + 1) % ring.size()], ring[k], last);
  end.centre = 1 / end.area * end.centre;
  end.n_triangles = static_cast<std::int64_t>(caps.size());
  if (cap != Cap::open) triangles.corners.insert(triangles.corners.end(), caps.begin(), caps.end());
  return end;
}

CutVessels draw_vessels(random_source &random, int n_ends, double waves, Cap cap) {
  constexpr double length = 5, least_angle = 60 * 3.14159265358979323846 / 180;
  std::vector<Vector3> directions;
  std::vector<double> radii;
  while (static_cast<int>(directions.size()) < n_ends) {
    const Vector3 direction = draw_direction(random);
    if (std::any_of(directions.begin(), directions.end(),
                    [&](const Vector3 &other) { return dot(other, direction) > std::cos(least_angle); }))
      continue;
    directions.push_back(direction);
    radii.push_back(random_between(&random, 0.55, 1));
  }
  std::vector<std::pair<Vector3, double>> sines;
  for (int i = 0; i < 6; ++i)
    sines.emplace_back(random_between(&random, 1, 4) * draw_direction(random), random_between(&random, 0, 6));
  const auto function = [&](const Vector3 &x) {
    double least = 1e9;
    for (std::size_t i = 0; i < directions.size(); ++i)
      least = smooth_least(least, distance_to_segment(x, (length + 1.3 * radii[i]) * directions[i]) - radii[i], 0.4);
    double wave = 0;
    for (const auto &[direction, phase] : sines) wave += std::sin(dot(direction, x) + phase);
    return least + waves / 2.5 * wave;
  };
  constexpr double reach = length + 2.5;
  CutVessels made;
  // The grid must not share a symmetry with the vessels.
  made.triangles = surface_of(function, {-reach - 0.031, -reach - 0.017, -reach - 0.023}, 2 * reach + 0.05, 56);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vector3 tilted = unit_vector(directions[i] + random_between(&random, 0, 0.8) *
                                                           unit_vector(cross(directions[i], draw_direction(random))));
    made.ends.push_back(cut(made.triangles, length * directions[i], tilted, 3.2 * radii[i], cap, random));
    made.axes.push_back(0.5 * length * directions[i]);
  }
  return made;
}

Vector3 Placement::turned(const Vector3 &vector) const {
  return {dot(axes[0], vector), dot(axes[1], vector), dot(axes[2], vector)};
}
Vector3 Placement::of(const Vector3 &point) const { return offset + scale * turned(point); }

Placement draw_placement(random_source &random, double scale, double far) {
  Placement placement;
  placement.axes[0] = draw_direction(random);
  placement.axes[1] = unit_vector(cross(placement.axes[0], draw_direction(random)));
  placement.axes[2] = cross(placement.axes[0], placement.axes[1]);
  placement.scale = scale;
  placement.offset = far * draw_direction(random);
  return placement;
}

void write_stl(const std::string &path, const Triangles &triangles, const Placement &placement, Turned turned,
               random_source &random) {
  std::vector<Corners> order = triangles.corners;
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random_bits(&random) % i]);
  std::FILE *const file = std::fopen(path.c_str(), "wb");
  char head[80] = "";
  std::fwrite(head, 1, sizeof head, file);
  const auto n = static_cast<std::uint32_t>(order.size());
  std::fwrite(&n, sizeof n, 1, file);
  for (Corners corner : order) {
    if (turned == Turned::all || (turned == Turned::some && random_bits(&random) % 4 == 0))
      std::swap(corner[1], corner[2]);
    float numbers[12] = {0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 point = placement.of(view(triangles.points)[corner[k]]);
      for (std::size_t axis = 0; axis < 3; ++axis) numbers[3 + 3 * k + axis] = static_cast<float>(point[axis]);
    }
    const std::uint16_t none = 0;
    std::fwrite(numbers, sizeof numbers, 1, file);
    std::fwrite(&none, sizeof none, 1, file);
  }
  std::fclose(file);
}

void expect(bool is_right, const std::string &what) {
  if (!is_right) std::printf("%s: not true: %s\n", here.c_str(), what.c_str());
  n_faults += !is_right;
}

void expect_near(double found, double expected, double tolerance, const std::string &what) {
  expect(std::abs(found - expected) <= tolerance,
         what + ": " + std::to_string(found) + " for " + std::to_string(expected));
}

}  // namespace riis::tests
