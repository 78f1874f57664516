// SPDX-License-Identifier: Apache-2.0
// Computes the errors of the paper's three methods for a distance, in half thicknesses.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "accuracy/ground_truth.hpp"
#include "accuracy/methods.hpp"
#include "accuracy/smooth_surface.hpp"
#include "figures/numbers.hpp"

namespace riis::figures {
namespace {

using accuracy::leaflets;
using accuracy::MeasuredSurface;
using accuracy::name_of;
using accuracy::Setting;
using accuracy::SmoothSurface;
using nlohmann::json;

// A part of the range of a patch's parameter u or v.
struct Part {
  double from, to;
};

// Divides a part into n equal steps. Returns the middle of every step if `first` is 0.5, and its start if `first` is 0.
std::vector<double> equal_steps(std::size_t n, double first, const Part &part) {
  std::vector<double> steps;
  for (std::size_t i = 0; i < n; ++i)
    steps.push_back(part.from + (part.to - part.from) * (static_cast<double>(i) + first) / static_cast<double>(n));
  return steps;
}

std::vector<double> ends_of_steps(std::size_t n, const Part &part) {
  std::vector<double> ends = equal_steps(n, 0, part);
  ends.push_back(part.to);
  return ends;
}

// Paints cells of about the given size. The middle of a cell lies on the surface, so its true distance is 0. The distance that a
// method computes there is therefore the error.
struct Painter {
  const SmoothSurface &smooth;
  const MeasuredSurface &surface;
  double cell;
  Numbers &numbers;

  // Compares the lengths of several lines, which run along one parameter of a patch. Returns the number of cells that the longest
  // line needs.
  std::size_t n_cells(std::size_t image, const Part &u, const Part &v, bool along_u) const {
    constexpr std::size_t n = 16;
    const std::vector<Vec3> net = smooth.at_lines(image, ends_of_steps(n, u), ends_of_steps(n, v));
    double longest = 0;
    for (std::size_t line = 0; line <= n; ++line) {
      const auto at = [&](std::size_t i) { return along_u ? net[line * (n + 1) + i] : net[i * (n + 1) + line]; };
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i) sum += distance(at(i), at(i + 1));
      longest = std::max(longest, sum);
    }
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(longest / cell)));
  }

  json paint(std::size_t image, const Part &u, const Part &v) const {
    const std::size_t n_u = n_cells(image, u, v, true), n_v = n_cells(image, u, v, false);
    std::vector<double> corners, errors;
    for (const Vec3 &p : smooth.at_lines(image, ends_of_steps(n_u, u), ends_of_steps(n_v, v)))
      corners.insert(corners.end(), {p.x, p.y, p.z});
    for (const Vec3 &p : smooth.at_lines(image, equal_steps(n_u, 0.5, u), equal_steps(n_v, 0.5, v))) {
      const double xyz[3] = {p.x, p.y, p.z};
      errors.push_back(surface.distance(xyz) / accuracy::half_thickness);
    }
    return {{"n_u", n_u}, {"n_v", n_v}, {"corners", numbers.put(corners)}, {"errors", numbers.put(errors)}};
  }
};

// Returns the painted cells of a leaflet. If is_part is true, returns only cells of a part of one patch.
json paintings(const accuracy::Leaflet &leaflet, bool is_part, Numbers &numbers) {
  // Sampling has the tolerance 10 %, so its samples are far enough apart to be visible.
  constexpr std::array<Setting, 3> painted{{{RIIS_MEASURE_MINIMIZATION, 0.01, "0.01"},
                                            {RIIS_MEASURE_SAMPLING, 0.1, "10 %"},
                                            {RIIS_MEASURE_TRIANGLES, 0.1, "10 %"}}};
  const PatchSet patches = accuracy::patches_of(leaflet);
  const SmoothSurface smooth(patches);
  json made = json::array();
  for (const Setting &setting : painted) {
    const MeasuredSurface surface(patches, setting.method, setting.tolerance);
    // Minimisation is slow, and its errors vary less from place to place than the errors of sampling. The cells of minimisation
    // are therefore larger.
    const double cell = is_part ? 0.001 : setting.method == RIIS_MEASURE_MINIMIZATION ? 0.007 : 0.0035;
    const Painter painter{smooth, surface, cell, numbers};
    json images = json::array();
    if (is_part)
      images.push_back(painter.paint(smooth.image_of(0), {0, 0.3}, {0.6, 0.9}));
    else
      for (std::size_t image = 0; image < smooth.n_images(); ++image)
        images.push_back(painter.paint(image, {0, 1}, {0, 1}));
    made.push_back({{"leaflet", leaflet.name},
                    {"is_part", is_part},
                    {"method", name_of(setting.method)},
                    {"setting", setting.name},
                    {"images", images}});
  }
  return made;
}

// Returns the absolute errors of a method, for points whose true distance is known.
std::vector<double> errors_of(const MeasuredSurface &surface, const accuracy::TruePoints &points) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < points.n(); ++i)
    errors.push_back(std::abs(surface.distance(points.point(i)) - points.distance[i]) / accuracy::half_thickness);
  return errors;
}

json distributions(const accuracy::Leaflet &leaflet, Numbers &numbers) {
  constexpr std::size_t n_points = 4000;
  constexpr std::uint64_t seed = 1;
  const PatchSet patches = accuracy::patches_of(leaflet);
  const accuracy::GroundTruth truth = accuracy::make_ground_truth(patches, {n_points, seed, 2e-4});
  json made = {{"leaflet", leaflet.name}, {"valve", leaflet.valve}};
  for (const Setting &setting : accuracy::settings) {
    const MeasuredSurface surface(patches, setting.method, setting.tolerance);
    made["settings"].push_back({{"method", name_of(setting.method)},
                                {"setting", setting.name},
                                {"tolerance", setting.tolerance},
                                {"on", numbers.put(errors_of(surface, truth.on_surface))},
                                {"off", numbers.put(errors_of(surface, truth.off_surface))}});
  }
  return made;
}

}  // namespace

json errors(Numbers &numbers) {
  // The rows of the table show a cusp, a part of this cusp, and a mitral leaflet.
  return {{"paintings",
           {paintings(leaflets[0], false, numbers), paintings(leaflets[0], true, numbers),
            paintings(leaflets[1], false, numbers)}},
          {"distributions", {distributions(leaflets[0], numbers), distributions(leaflets[1], numbers)}}};
}

}  // namespace riis::figures
