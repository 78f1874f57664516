// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/pieces.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

namespace riis::vtk {
namespace {

// Returns a vertex's place as bits, which can be sorted even if the file holds NaN. 0 and -0 are the same place.
std::array<std::uint64_t, 3> place_of(const Faces &faces, std::size_t vertex) {
  std::array<std::uint64_t, 3> bits;
  for (std::size_t k = 0; k < 3; ++k) {
    const double coordinate = faces.xyz[3 * vertex + k] + 0.0;
    std::memcpy(&bits[k], &coordinate, sizeof coordinate);
  }
  return bits;
}

// Disjoint sets that can be joined. Each set has one member that stands for it.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t find(std::size_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

std::vector<std::size_t> places_of(const Faces &faces) {
  const std::size_t n = faces.xyz.size() / 3;
  std::vector<std::size_t> order(n), places(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return place_of(faces, a) < place_of(faces, b); });
  for (std::size_t i = 1; i < n; ++i)
    places[order[i]] = places[order[i - 1]] + (place_of(faces, order[i]) == place_of(faces, order[i - 1]) ? 0 : 1);
  return places;
}

std::vector<std::int32_t> pieces_of(const Faces &faces) {
  const std::vector<std::size_t> places = places_of(faces);
  const auto n_corners = static_cast<std::size_t>(faces.corners_per_face);
  const std::size_t n_faces = faces.vertex_ids.size() / n_corners;
  const auto place = [&](std::size_t corner) { return places[static_cast<std::size_t>(faces.vertex_ids[corner])]; };
  Sets sets(places.size());
  for (std::size_t face = 0; face < n_faces; ++face)
    for (std::size_t k = 1; k < n_corners; ++k) sets.join(place(n_corners * face), place(n_corners * face + k));
  std::vector<std::int32_t> piece_of_set(places.size(), -1), pieces(n_faces);
  std::int32_t n_pieces = 0;
  for (std::size_t face = 0; face < n_faces; ++face) {
    std::int32_t &piece = piece_of_set[sets.find(place(n_corners * face))];
    if (piece < 0) piece = n_pieces++;
    pieces[face] = piece;
  }
  return pieces;
}

}  // namespace riis::vtk
