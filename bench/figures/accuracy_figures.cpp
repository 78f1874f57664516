// SPDX-License-Identifier: Apache-2.0
// Draws the errors of the paper's three methods for a distance, painted on a leaflet, and their distributions.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/ground_truth.hpp"
#include "accuracy/methods.hpp"
#include "accuracy/smooth_surface.hpp"
#include "figures/figures.hpp"
#include "figures/shapes.hpp"
#include "figures/text.hpp"
#include "figures/violins.hpp"

namespace riis::figures {
namespace {

using accuracy::leaflets;
using accuracy::make_ground_truth;
using accuracy::MeasuredSurface;
using accuracy::name_of;
using accuracy::patches_of;
using accuracy::Setting;
using accuracy::SmoothSurface;

constexpr PictureSize painted_size{900, 760};
const View views[2] = {looking({-1, 0.35, -0.55}, {0, 0, 1}), looking({-0.35, -1, -0.35}, {0, 0, 1})};

// The logarithm of an error gives its colour, from dark to bright. The colour map, viridis, suits any colour vision.
constexpr double darkest_power = -5, brightest_power = -1;
Colour colour_of_error(double error) {
  constexpr std::array<Colour, 6> stops{
      {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
  const double power = error > 0 ? std::log10(error) : darkest_power;
  const double at = std::clamp((power - darkest_power) / (brightest_power - darkest_power), 0.0, 1.0) * 5;
  const auto below = std::min<std::size_t>(static_cast<std::size_t>(at), 4);
  const double t = at - static_cast<double>(below);
  const auto mixed = [&](unsigned char a, unsigned char b) {
    return static_cast<unsigned char>(std::lround((1 - t) * a + t * b));
  };
  const Colour a = stops[below], b = stops[below + 1];
  return {mixed(a.red, b.red), mixed(a.green, b.green), mixed(a.blue, b.blue)};
}

// Returns a fraction of the half thickness as text.
std::string share_text(double share) { return number(100 * share, 2) + " %"; }

// A part of the range of a patch's parameter u or v.
struct Part {
  double from, to;
};

// Returns the middles of n equal steps (first = 0.5), or their starts (first = 0).
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

struct Painting {
  Faces faces{4, {}, {}, {}};
  std::vector<double> errors;  // at every cell's middle, in half thicknesses
};

class Painter {
 public:
  // Paints cells of about the given size. A cell's colour is the error of the distance at its middle, where the true distance is
  // 0.
  Painter(const SmoothSurface &smooth, const MeasuredSurface &surface, double cell)
      : smooth_(smooth), surface_(surface), cell_(cell) {}

  Painting everything() const {
    Painting painting;
    for (std::size_t image = 0; image < smooth_.n_images(); ++image) add(painting, image, {0, 1}, {0, 1});
    return finished(std::move(painting));
  }
  Painting part(std::size_t image, const Part &u, const Part &v) const {
    Painting painting;
    add(painting, image, u, v);
    return finished(std::move(painting));
  }

 private:
  static Painting finished(Painting painting) {
    std::sort(painting.errors.begin(), painting.errors.end());
    return painting;
  }

  // Several lines run along one parameter of a patch. Returns the number of cells that the longest line needs.
  std::size_t n_cells(std::size_t image, const Part &u, const Part &v, bool along_u) const {
    constexpr std::size_t n = 16;
    const std::vector<Vec3> net = smooth_.at_lines(image, ends_of_steps(n, u), ends_of_steps(n, v));
    double longest = 0;
    for (std::size_t line = 0; line <= n; ++line) {
      const auto at = [&](std::size_t i) { return along_u ? net[line * (n + 1) + i] : net[i * (n + 1) + line]; };
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i) sum += distance(at(i), at(i + 1));
      longest = std::max(longest, sum);
    }
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(longest / cell_)));
  }

  void add(Painting &painting, std::size_t image, const Part &u, const Part &v) const {
    const std::size_t n_u = n_cells(image, u, v, true), n_v = n_cells(image, u, v, false);
    const auto first = static_cast<std::int64_t>(painting.faces.points.size()),
               row = static_cast<std::int64_t>(n_u + 1);
    append(painting.faces.points, smooth_.at_lines(image, ends_of_steps(n_u, u), ends_of_steps(n_v, v)));
    const std::vector<Vec3> middles = smooth_.at_lines(image, equal_steps(n_u, 0.5, u), equal_steps(n_v, 0.5, v));
    for (std::size_t i = 0; i < middles.size(); ++i) {
      const double xyz[3] = {middles[i].x, middles[i].y, middles[i].z};
      painting.errors.push_back(surface_.distance(xyz) / accuracy::half_thickness);
      painting.faces.colours.push_back(colour_of_error(painting.errors.back()));
      const auto corner = first + static_cast<std::int64_t>(i / n_u) * row + static_cast<std::int64_t>(i % n_u);
      painting.faces.corners.insert(painting.faces.corners.end(), {corner, corner + 1, corner + row + 1, corner + row});
    }
  }

  const SmoothSurface &smooth_;
  const MeasuredSurface &surface_;
  double cell_;
};

// Returns the absolute errors of a method, for points whose true distance is known.
std::vector<double> errors_of(const MeasuredSurface &surface, const accuracy::TruePoints &points) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < points.n(); ++i)
    errors.push_back(std::abs(surface.distance(points.point(i)) - points.distance[i]) / accuracy::half_thickness);
  std::sort(errors.begin(), errors.end());
  return errors;
}

double quantile(const std::vector<double> &ascending, double share) {
  return ascending[std::min(ascending.size() - 1,
                            static_cast<std::size_t>(share * static_cast<double>(ascending.size())))];
}

Colour colour_of_method(std::int32_t method) {
  return method == RIIS_MEASURE_MINIMIZATION ? green : method == RIIS_MEASURE_SAMPLING ? orange : blue;
}

}  // namespace

Figure accuracy_figure() {
  Figure figure{"Errors of distances, painted", {}, 3, {}, {}, {}, {}};
  // Sampling has the tolerance 10 %, because its samples are then far enough apart to be visible.
  constexpr std::array<Setting, 3> painted{{{RIIS_MEASURE_MINIMIZATION, 0.01, "0.01"},
                                            {RIIS_MEASURE_SAMPLING, 0.1, "10 %"},
                                            {RIIS_MEASURE_TRIANGLES, 0.1, "10 %"}}};
  // The rows show a cusp, a part of this cusp, and a mitral leaflet.
  for (const std::size_t row : {0, 1, 2}) {
    const std::size_t k = row / 2;
    const PatchSet patches = patches_of(leaflets[k]);
    const SmoothSurface smooth(patches);
    for (const Setting &setting : painted) {
      const MeasuredSurface surface(patches, setting.method, setting.tolerance);
      // Minimisation is slow, and its errors vary over larger distances than the errors of sampling. Its cells are therefore
      // larger.
      const double cell = setting.method == RIIS_MEASURE_MINIMIZATION ? 0.007 : 0.0035;
      const Painting painting = row == 1
                                    ? Painter(smooth, surface, 0.001).part(smooth.image_of(0), {0, 0.3}, {0.6, 0.9})
                                    : Painter(smooth, surface, cell).everything();
      Picture picture(painted_size, views[k], painting.faces.points, 40);
      picture.add_title(std::string(name_of(setting.method)) + ", " + setting.name);
      picture.add_faces(painting.faces, Shading::painted);
      if (row != 1) picture.add_scale_and_axes();
      figure.panels.push_back(
          {picture.png(), std::string(leaflets[k].name) + (row == 1 ? ", a part some millimetres wide, " : ", ") +
                              name_of(setting.method) + " at " + setting.name + ": half of it is off by at most " +
                              share_text(quantile(painting.errors, 0.5)) + ", 95 % by " +
                              share_text(quantile(painting.errors, 0.95)) + ", all by " +
                              share_text(painting.errors.back()) + "."});
    }
  }
  for (double power = darkest_power; power <= brightest_power; ++power)
    figure.key.push_back({colour_of_error(std::pow(10, power)),
                          share_text(std::pow(10, power)) + (power == darkest_power     ? " or less"
                                                             : power == brightest_power ? " or more"
                                                                                        : "")});
  figure.caption =
      "Distances that the three methods give for points on the smooth surface, in per cent of the half thickness. "
      "From the top: one cusp of the aortic valve, a part of this cusp below its middle, and the anterior leaflet of "
      "the open mitral valve. "
      "The true distance is 0 everywhere. Between samples, distances grow to about the tolerance. Triangles touch the "
      "surface at their corners, and in between leave it by at most the tolerance. Minimisation has errors because it "
      "stops early, because of the patches that it uses, and sometimes because of a local minimum.";
  figure.paper =
      "section 4.1, “Performance evaluation”, figure “Errors in distance calculation plotted on aortic cusp surfaces "
      "for all three distance functions”.";
  return figure;
}

Figure accuracy_distribution_figure() {
  constexpr std::size_t n_points = 4000;
  constexpr std::uint64_t seed = 1;
  Figure figure{"Errors of distances, distributed", {}, 2, {}, {}, {}, {}};
  std::vector<std::vector<std::string>> rows = {
      {"leaflet", "method", "tolerance", "on it: median", "95 %", "largest", "off it: median", "95 %", "largest"}};
  for (const accuracy::Leaflet &leaflet : leaflets) {
    const PatchSet patches = patches_of(leaflet);
    const accuracy::GroundTruth truth = make_ground_truth(patches, {n_points, seed, 2e-4});
    std::array<std::vector<Violin>, 2> violins;
    for (const Setting &setting : accuracy::settings) {
      const MeasuredSurface surface(patches, setting.method, setting.tolerance);
      std::vector<std::string> row = {leaflet.name, name_of(setting.method), setting.name};
      for (std::size_t off = 0; off < 2; ++off) {
        std::vector<double> errors = errors_of(surface, off ? truth.off_surface : truth.on_surface);
        for (const double share : {0.5, 0.95, 1.0}) row.push_back(share_text(quantile(errors, share)));
        violins[off].push_back({setting.name, name_of(setting.method), colour_of_method(setting.method),
                                setting.tolerance, std::move(errors)});
      }
      rows.push_back(row);
    }
    for (std::size_t off = 0; off < 2; ++off)
      figure.panels.push_back({violin_plot(std::string(leaflet.valve) + " valve, " + leaflet.name +
                                               (off ? ": off the surface" : ": on the surface"),
                                           violins[off]),
                               std::string(leaflet.name) + ", " +
                                   count(off ? truth.off_surface.n() : truth.on_surface.n()) +
                                   (off ? " points 0.1, 0.5 and 1 half thickness off the surface, to either side."
                                        : " points of the surface.")});
  }
  for (const std::int32_t method : {RIIS_MEASURE_MINIMIZATION, RIIS_MEASURE_SAMPLING, RIIS_MEASURE_TRIANGLES})
    figure.key.push_back({colour_of_method(method), name_of(method)});
  figure.key.push_back({vermilion, "tolerance"});
  figure.caption =
      "Errors of distances, in per cent of the half thickness, on a logarithmic scale. Widths show fractions of the "
      "points, lines the median and 95 %, dots the largest error. The errors of samples and of triangles stay below "
      "the tolerance; for minimisation the tolerance only says when to stop. The points' true distances are known: the "
      "smooth surface is evaluated from its curves, without polylines, and other points lie on its normals. Points are "
      "left out if another part of the leaflet is nearer, or if the offset exceeds half the radius of curvature.";
  figure.table = html_table(rows);
  figure.paper =
      "section 4.1, “Performance evaluation”, figure “Results for accuracy and performance testing for each distance "
      "algorithm”, left column.";
  return figure;
}

}  // namespace riis::figures
