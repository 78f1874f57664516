// SPDX-License-Identifier: Apache-2.0
#include "mesh/proportions.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "base/log.hpp"

namespace riis {
namespace {

double largest_side(const Bounds &bounds) {
  const Vec3 extent = bounds.upper - bounds.lower;
  return std::max({extent.x, extent.y, extent.z});
}

// Returns a message that names two sizes that do not fit together, or NULL if all fit.
const char *misfit(double mesh, double surface, double half_thickness) {
  constexpr double most = 50;
  if (surface > most * mesh) return "the surface is more than 50 times as large as the mesh";
  if (mesh > most * surface) return "the mesh is more than 50 times as large as the surface";
  if (half_thickness > surface) return "the half thickness is larger than the surface";
  if (half_thickness > mesh) return "the half thickness is larger than the mesh";
  return nullptr;
}

}  // namespace

bool WarnedSurfaces::has(std::uint64_t surface_number) const {
  return std::any_of(numbers_.begin(), numbers_.end(), [&](const std::atomic<std::uint64_t> &number) {
    return number.load(std::memory_order_relaxed) == surface_number;
  });
}

bool WarnedSurfaces::is_first(std::uint64_t surface_number) {
  for (std::atomic<std::uint64_t> &number : numbers_) {
    std::uint64_t found = 0;
    if (number.compare_exchange_strong(found, surface_number, std::memory_order_relaxed)) return true;
    if (found == surface_number) return false;
  }
  return false;
}

void check_proportions(const Sizes &sizes, std::uint64_t surface_number, WarnedSurfaces &warned) {
  // Meshes with fewer nodes are not checked, because the box of a few nodes may have any size.
  constexpr std::int64_t fewest_nodes = 1000;
  if (sizes.n_nodes < fewest_nodes) return;
  const double mesh = largest_side(sizes.mesh), surface = largest_side(sizes.surface);
  const char *what = misfit(mesh, surface, sizes.half_thickness);
  if (!what || warned.has(surface_number) || !is_logging() || !warned.is_first(surface_number)) return;
  constexpr int digits = 6;
  log_message(RIIS_LOG_WARNING, what, ": largest sides of their boxes are ", rounded(mesh, digits), " (mesh of ",
              sizes.n_nodes, " nodes) and ", rounded(surface, digits), " (surface), the half thickness is ",
              rounded(sizes.half_thickness, digits),
              "; are all in one unit? See scale and half_thickness of riis_surface_options");
}

}  // namespace riis
