// SPDX-License-Identifier: Apache-2.0
#include "figures/violins.hpp"

#include <algorithm>
#include <cmath>

#include "figures/text.hpp"

namespace riis::figures {
namespace {

constexpr PictureSize size{1120, 760};
constexpr double least_power = -6, most_power = 0;
// Lengths are in pixels, which are also the units of the picture's coordinates.
constexpr double left = 110, right = 1100, bottom = 70, top = 660, half_width = 0.42;

double height_of(double value) {
  const double power = value > 0 ? std::log10(value) : least_power;
  return bottom +
         (std::clamp(power, least_power, most_power) - least_power) / (most_power - least_power) * (top - bottom);
}

Vec3 at(double x, double y) { return {x, y, 0}; }

// Returns half widths from the lower to the upper end of the scale. The widest is 1. The half widths are counts in bins, smoothed
// by a Gaussian.
std::vector<double> outline_of(const std::vector<double> &ascending) {
  constexpr std::size_t bins_per_power = 20;
  constexpr std::size_t n = static_cast<std::size_t>(most_power - least_power) * bins_per_power;
  constexpr std::ptrdiff_t reach = 4;
  std::vector<double> counts(n), widths(n);
  for (const double value : ascending) {
    const double bin = (height_of(value) - bottom) / (top - bottom) * static_cast<double>(n);
    ++counts[std::min(n - 1, static_cast<std::size_t>(bin))];
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const std::ptrdiff_t from = static_cast<std::ptrdiff_t>(i) + k;
      if (from < 0 || from >= static_cast<std::ptrdiff_t>(n)) continue;
      widths[i] += counts[static_cast<std::size_t>(from)] * std::exp(-0.5 * static_cast<double>(k * k) / 2.25);
    }
  const double widest = *std::max_element(widths.begin(), widths.end());
  for (double &width : widths) width /= widest;
  return widths;
}

void add_outline(Faces &faces, double middle, double step, const Violin &violin) {
  const std::vector<double> widths = outline_of(violin.values);
  const double rise = (top - bottom) / static_cast<double>(widths.size());
  for (std::size_t i = 0; i + 1 < widths.size(); ++i) {
    const double a = half_width * step * widths[i], b = half_width * step * widths[i + 1];
    // Parts of the outline without visible width are not drawn. A single point among thousands has none.
    if (std::max(a, b) < 0.4) continue;
    const double y = bottom + rise * (static_cast<double>(i) + 0.5);
    // The smoothed outline must not reach beyond the least and the greatest value.
    if (y + rise > height_of(violin.values.back()) + 0.5 || y < height_of(violin.values.front()) - 0.5) continue;
    const auto first = static_cast<std::int64_t>(faces.points.size());
    for (const Vec3 &p : {at(middle - a, y), at(middle + a, y), at(middle + b, y + rise), at(middle - b, y + rise)})
      faces.points.push_back(p);
    faces.corners.insert(faces.corners.end(), {first, first + 1, first + 2, first + 3});
    faces.colours.push_back(violin.colour);
  }
}

double quantile(const std::vector<double> &ascending, double share) {
  return ascending[std::min(ascending.size() - 1,
                            static_cast<std::size_t>(share * static_cast<double>(ascending.size())))];
}

void add_scale(Picture &picture) {
  Segments lines;
  for (double power = least_power; power <= most_power; ++power) {
    const double value = std::pow(10, power), y = height_of(value);
    lines.push_back({at(left, y), at(right, y)});
    char text[32];
    std::snprintf(text, sizeof text, "%.*f %%", static_cast<int>(std::max(0.0, -power - 2)), 100 * value);
    picture.add_label(at(left, y), text, -58, 0, dark, 21);
  }
  picture.add_segments(lines, light_grey, 1, -1);
}

}  // namespace

Png violin_plot(const std::string &title, const std::vector<Violin> &violins) {
  Picture picture(size, top_view, {at(0, 0), at(size.width, size.height - 60)}, 0);
  picture.add_title(title);
  add_scale(picture);
  Faces faces{4, {}, {}, {}};
  Points largest;
  Segments medians, others;
  const double step = (right - left) / static_cast<double>(violins.size());
  for (std::size_t i = 0; i < violins.size(); ++i) {
    const Violin &violin = violins[i];
    const double middle = left + step * (static_cast<double>(i) + 0.5);
    add_outline(faces, middle, step, violin);
    const auto across = [&](double value, double share) -> std::array<Vec3, 2> {
      return {at(middle - share * step, height_of(value)), at(middle + share * step, height_of(value))};
    };
    medians.push_back(across(quantile(violin.values, 0.5), 0.3));
    others.push_back(across(quantile(violin.values, 0.95), 0.15));
    largest.push_back(at(middle, height_of(violin.values.back())));
    const auto mark = across(violin.mark, 0.46);
    picture.add_curve({mark[0], mark[1]}, vermilion, 4);
    picture.add_label(at(middle, bottom), violin.label, 0, -20, dark, 22);
    // The group's name is below the middle of its members.
    if (i > 0 && violins[i - 1].group == violin.group) continue;
    std::size_t end = i;
    while (end < violins.size() && violins[end].group == violin.group) ++end;
    picture.add_label(at(left + 0.5 * step * static_cast<double>(i + end), bottom), violin.group, 0, -50, violin.colour,
                      24);
  }
  picture.add_faces(faces, Shading::painted);
  for (const auto &line : medians) picture.add_curve({line[0], line[1]}, dark, 4, 1);
  for (const auto &line : others) picture.add_curve({line[0], line[1]}, dark, 3, 1);
  picture.add_points(largest, dark, 9);
  return picture.png();
}

}  // namespace riis::figures
