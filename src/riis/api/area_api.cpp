// SPDX-License-Identifier: Apache-2.0
// Checks the arguments of riis_find_by_area, and makes the surfaces for the search (measures/area_search.hpp).
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/handles.hpp"
#include "api/structs.hpp"
#include "api/surface_options.hpp"
#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "measures/area_search.hpp"

using riis::check_range;
using riis::guarded_with_handles;
using riis::require;
using riis::require_handle;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t most_areas = 1'000'000;
constexpr double largest_area = 1e120;
constexpr std::int32_t most_samples = 100'001;

const riis_area_search default_search{sizeof(riis_area_search), nullptr, nullptr, no_number, no_number, 1e-8, 33,
                                      RIIS_AREA_GEOMETRIC};

// The number that the search changes: the opening, the scale of the placement, or a parameter.
enum class Sought { opening, scale, parameter };

Sought sought_by(const std::string &name) {
  return name == "opening" ? Sought::opening : name == "scale" ? Sought::scale : Sought::parameter;
}

// The range to search. If several values fit, the value nearest to `near` is wanted.
struct Values {
  double from, to, near;
};

// Makes a surface of the valve for each value that the search tries. AreaTrials calls the public functions, which refuse bad
// input.
class AreaTrials {
 public:
  AreaTrials(const riis::Valve &valve, const char *name, const riis_area_search &search)
      : valve_(valve),
        name_(name),
        sought_(sought_by(name_)),
        search_(search),
        options_(riis::completed(search.surface, "search.surface", riis::default_surface_options)) {}

  Values values() const {
    if (seeks_opening()) return checked({0, 1, 0}, {0, 1});
    if (sought_ == Sought::scale) {
      riis::check_placement(options_, "search.surface");
      return checked({options_.scale / 10, options_.scale * 10, options_.scale}, {1e-12, 1e12});
    }
    double now = 0;
    valve_.get(name_, 1, &now);
    const std::array<double, 2> range = valve_.range_of(name_);
    if (now == 0 && range[0] == 0 && range[1] <= 1) return checked({0, range[1], now}, range);
    if (now == 0 && (std::isnan(search_.from) || std::isnan(search_.to)))
      riis::fail(RIIS_INVALID_ARGUMENT, name_, " is 0, so a range to search is needed: from and to");
    return checked({std::min(now / 2, 2 * now), std::max(now / 2, 2 * now), now}, range);
  }

  bool seeks_opening() const { return sought_ == Sought::opening; }

  // Returns whether the samples form a geometric series, in which each sample is a constant factor times the previous one.
  // Samples of the opening are evenly spaced instead, as in the tables of openings.
  bool grows(const Values &values) const { return !seeks_opening() && values.from > 0; }

  // Returns the area at a value. If a value makes no valve or no orifice, returns nothing while the search takes samples. Later,
  // such a value is an error.
  std::optional<double> area_at(double value) {
    ++n_surfaces;
    try {
      return orifice_at(value);
    } catch (const riis::Error &error) {
      if (error.status != RIIS_INVALID_PARAMETER && error.status != RIIS_LIMIT_EXCEEDED) throw;
      const riis::Error said{error.status, riis::Message("at ", name_, " ", value, ": ", error.message.text())};
      if (!is_sampling) throw said;
      if (!refusal_) refusal_ = said;
      return std::nullopt;
    }
  }

  void check(const riis::AreaSearch &areas, const Values &values) const {
    if (!areas.has_area()) throw *refusal_;
    if (areas.is_constant())
      riis::fail(RIIS_INVALID_PARAMETER, name_, " does not change the ", words(), ", which is ", areas.most().area,
                 " from ", name_, " ", values.from, " to ", values.to);
  }

  [[noreturn]] void fail_out_of_reach(std::int64_t i, double area, const riis::AreaSearch &areas,
                                      const Values &values) const {
    riis::fail(RIIS_INVALID_ARGUMENT, "area ", i, " is ", area, ", which is out of reach: from ", name_, " ",
               values.from, " to ", values.to, " the ", words(), " goes from ", areas.least().area, " to ",
               areas.most().area);
  }

  std::int64_t n_surfaces = 0;
  bool is_sampling = true;

 private:
  const char *words() const { return search_.area == RIIS_AREA_EFFECTIVE ? "effective area" : "area"; }

  // Returns the caller's range. If the caller left out an end of the range, the usual end is used, limited to the range of
  // possible values.
  Values checked(const Values &usual, const std::array<double, 2> &range) const {
    const double from = std::isnan(search_.from) ? std::clamp(usual.from, range[0], range[1]) : search_.from;
    const double to = std::isnan(search_.to) ? std::clamp(usual.to, range[0], range[1]) : search_.to;
    check_range("search", "from", from, range[0], range[1]);
    check_range("search", "to", to, range[0], range[1]);
    if (!(from < to))
      riis::fail(RIIS_INVALID_ARGUMENT, "search.to is ", to, "; it must be above the start of the range, ", from);
    return {from, to, seeks_opening() ? from : usual.near};
  }

  double orifice_at(double value) {
    if (sought_ == Sought::scale)
      options_.scale = value;
    else
      valve_.set(name_, 1, &value);
    // A fixed triangulation is made for one shape and one scale. Another value of a parameter or of the scale therefore needs a
    // new triangulation.
    const bool is_planned_anew = options_.triangulation == RIIS_TRIANGULATION_FIXED && !seeks_opening();
    if (!surface_ || is_planned_anew) {
      surface_ = std::make_unique<riis_surface>();
      surface_->updatable.ignore_crossings();
    }
    const riis_valve changed{{}, valve_};
    if (const riis_status status = riis_surface_update(surface_.get(), &changed, &options_); status != RIIS_OK)
      riis::fail(status, status == RIIS_INVALID_ARGUMENT ? "search.surface: " : "", riis_last_error());
    riis_orifice orifice;
    const riis_status status = riis_surface_get_orifice(surface_.get(), search_.resistance, &orifice, sizeof orifice);
    if (status != RIIS_OK) riis::fail(status, "search.", riis_last_error());
    if (orifice.outline == RIIS_OUTLINE_NONE)
      riis::fail(RIIS_INVALID_PARAMETER, "the valve has no orifice: its open edges do not surround a centre");
    return search_.area == RIIS_AREA_EFFECTIVE ? orifice.effective_area : orifice.area;
  }

  riis::Valve valve_;
  std::string name_;
  Sought sought_;
  const riis_area_search &search_;
  riis_surface_options options_;
  std::unique_ptr<riis_surface> surface_;
  std::optional<riis::Error> refusal_;
};

riis_area_search checked_search(const riis_area_search *search) {
  const riis_area_search whole = riis::completed(search, "search", default_search);
  check_range("search", "tolerance", whole.tolerance, 1e-12, 1e-2);
  if (whole.n_samples < 2 || whole.n_samples > most_samples)
    riis::fail(RIIS_INVALID_ARGUMENT, "search.n_samples is ", whole.n_samples, "; it must be from 2 to ", most_samples);
  if (whole.area != RIIS_AREA_GEOMETRIC && whole.area != RIIS_AREA_EFFECTIVE)
    riis::fail(RIIS_INVALID_ARGUMENT, "search.area is ", whole.area,
               "; it must be RIIS_AREA_GEOMETRIC or RIIS_AREA_EFFECTIVE");
  return whole;
}

void check_areas(std::int64_t n_areas, const double *areas) {
  if (n_areas < 0 || n_areas > most_areas)
    riis::fail(RIIS_INVALID_ARGUMENT, "n_areas is ", n_areas, "; it must be from 0 to ", most_areas);
  if (n_areas > 0) require(areas, "areas");
  for (std::int64_t i = 0; i < n_areas; ++i)
    if (!(areas[i] >= 0 && areas[i] <= largest_area))
      riis::fail(RIIS_INVALID_ARGUMENT, "area ", i, " is ", areas[i], "; it must be from 0 to ", largest_area);
}

riis_area_range range_of(const riis::AreaSearch &areas, const Values &values) {
  riis_area_range made{values.from,
                       values.to,
                       areas.least().area,
                       areas.most().area,
                       areas.least().value,
                       areas.most().value,
                       {no_number, no_number, no_number, no_number},
                       0,
                       riis::view(areas.turns()).size(),
                       0,
                       areas.n_refused()};
  for (std::size_t i = 0; i < std::min<std::size_t>(std::size(made.turns), areas.turns().size()); ++i)
    made.turns[i] = areas.turns()[i];
  return made;
}

}  // namespace

extern "C" {

RIIS_DEFINE_INIT(riis_area_search_init, riis_area_search, search, default_search)

riis_status riis_find_by_area(const riis_valve *valve, const char *name, int64_t n_areas, const double *areas,
                              const riis_area_search *search, double *values, double *reached, riis_area_range *range,
                              int64_t struct_size) {
  return guarded_with_handles([&] {
    const auto start = std::chrono::steady_clock::now();
    require_handle(valve, "valve");
    require(name, "name");
    check_areas(n_areas, areas);
    const riis_area_search whole = checked_search(search);
    if (range) riis::check_struct_size<riis_area_range>(struct_size, "range");
    AreaTrials trials(valve->valve, name, whole);
    const Values searched = trials.values();
    if (trials.seeks_opening() && !valve->valve.can_open())
      riis::fail(RIIS_INVALID_PARAMETER, "valve has only one state: set its open state with riis_valve_set_open_state");
    const riis::AreaSearch found([&](double value) { return trials.area_at(value); }, searched.from, searched.to,
                                 whole.n_samples, trials.grows(searched));
    trials.check(found, searched);
    trials.is_sampling = false;
    std::vector<riis::AreaSearch::Point> points;
    points.reserve(static_cast<std::size_t>(n_areas));
    for (std::int64_t i = 0; i < n_areas; ++i) {
      auto point = found.find(areas[i], searched.near, whole.tolerance);
      // Slits remain between closed leaflets, so no opening has the area 0. The area 0 therefore stands for the least area.
      if (!point && areas[i] == 0 && trials.seeks_opening()) point = found.least();
      if (!point) trials.fail_out_of_reach(i, areas[i], found, searched);
      points.push_back(*point);
    }
    for (std::int64_t i = 0; i < n_areas; ++i) {
      if (values) values[i] = riis::view(points)[i].value;
      if (reached) reached[i] = riis::view(points)[i].area;
    }
    if (!range) return;
    riis_area_range made = range_of(found, searched);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    made.seconds = elapsed.count();
    made.n_surfaces = trials.n_surfaces;
    riis::write_struct(range, struct_size, "range", made);
  });
}
}
