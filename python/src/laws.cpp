// SPDX-License-Identifier: Apache-2.0
// Laws of opening. riis/laws.py has the classes. The functions in laws.cpp receive the values of these classes one by one.
#include "module.hpp"
#include "surface.hpp"

#include <utility>
#include <vector>

namespace riis_python {
namespace {

// Calls at(time, opening, rate) for a number or for an array of times. Returns the pair (opening, rate).
template <class At>
nb::object at_times(nb::handle time, const At &at) {
  if (!has_entries(time)) {
    double opening = 0, rate = 0;
    call_shortly(at(number(time, "time"), &opening, &rate));
    return nb::make_tuple(opening, rate);
  }
  const Array times = Array::of<double>(time, "time");
  times.expect({-1});
  const std::int64_t n = times.size(0);
  const nb::object openings = new_array("float64", {n}), rates = new_array("float64", {n});
  const Array opening = Array::of<double>(openings, "opening", Access::write),
              rate = Array::of<double>(rates, "rate", Access::write);
  for (std::int64_t i = 0; i < n; ++i)
    call_shortly(at(times.data<double>()[i], opening.data<double>() + i, rate.data<double>() + i));
  return nb::make_tuple(openings, rates);
}

nb::object from_table(nb::handle keys_, nb::handle openings_, nb::handle period, nb::handle interpolation,
                      nb::handle time) {
  riis_opening_table table;
  call_shortly(riis_opening_table_init(&table, sizeof table));
  const Array keys = Array::of<double>(keys_, "time"), openings = Array::of<double>(openings_, "opening");
  keys.expect({-1});
  openings.expect({keys.size(0)});
  table.n_keys = keys.size(0);
  table.time = keys.data<double>();
  table.opening = openings.data<double>();
  table.period = number(period, "period");
  table.interpolation = interpolation_of(interpolation);
  return at_times(
      time, [&](double t, double *opening, double *rate) { return riis_opening_from_table(&table, t, opening, rate); });
}

nb::object from_times(nb::handle opening_start, nb::handle opening_duration, nb::handle closing_start,
                      nb::handle closing_duration, nb::handle closed, nb::handle open, nb::handle period,
                      nb::handle time) {
  riis_opening_times times;
  call_shortly(riis_opening_times_init(&times, sizeof times));
  times.opening_start = number(opening_start, "opening_start");
  times.opening_duration = number(opening_duration, "opening_duration");
  times.closing_start = number(closing_start, "closing_start");
  times.closing_duration = number(closing_duration, "closing_duration");
  times.closed = number(closed, "closed");
  times.open = number(open, "open");
  times.period = number(period, "period");
  return at_times(
      time, [&](double t, double *opening, double *rate) { return riis_opening_from_times(&times, t, opening, rate); });
}

// The doubles of a struct, by their names in the class of riis.laws.
template <class Struct>
using Doubles = std::vector<std::pair<const char *, double Struct::*>>;

const Doubles<riis_opening_switch> of_switch = {{"opening_duration", &riis_opening_switch::opening_duration},
                                                {"closing_duration", &riis_opening_switch::closing_duration},
                                                {"open_above", &riis_opening_switch::open_above},
                                                {"close_below", &riis_opening_switch::close_below},
                                                {"filter_time", &riis_opening_switch::filter_time},
                                                {"dwell_time", &riis_opening_switch::dwell_time}};
const Doubles<riis_opening_switch_state> of_switch_state = {
    {"time", &riis_opening_switch_state::time},
    {"opening", &riis_opening_switch_state::opening},
    {"rate", &riis_opening_switch_state::rate},
    {"progress", &riis_opening_switch_state::progress},
    {"pressure_difference", &riis_opening_switch_state::pressure_difference},
    {"flow", &riis_opening_switch_state::flow},
    {"turn_time", &riis_opening_switch_state::turn_time}};
const Doubles<riis_opening_angle> of_angle = {
    {"pressure_gain", &riis_opening_angle::pressure_gain}, {"flow_gain", &riis_opening_angle::flow_gain},
    {"friction", &riis_opening_angle::friction},           {"vortex_gain", &riis_opening_angle::vortex_gain},
    {"angle_min", &riis_opening_angle::angle_min},         {"angle_max", &riis_opening_angle::angle_max}};
const Doubles<riis_opening_angle_state> of_angle_state = {
    {"time", &riis_opening_angle_state::time},
    {"opening", &riis_opening_angle_state::opening},
    {"rate", &riis_opening_angle_state::rate},
    {"angle", &riis_opening_angle_state::angle},
    {"angle_rate", &riis_opening_angle_state::angle_rate},
    {"pressure_difference", &riis_opening_angle_state::pressure_difference},
    {"flow", &riis_opening_angle_state::flow}};

// Returns a struct with the values of an object's attributes.
template <class Struct>
Struct read(nb::handle object, riis_status (*init)(Struct *, std::int64_t), const Doubles<Struct> &doubles) {
  Struct values;
  call_shortly(init(&values, sizeof values));
  for (const auto &[name, member] : doubles) values.*member = number(object.attr(name), name);
  return values;
}

// Returns the struct's values by name.
template <class Struct>
nb::dict written(const Struct &values, const Doubles<Struct> &doubles) {
  nb::dict dict;
  for (const auto &[name, member] : doubles) dict[name] = values.*member;
  return dict;
}

// Returns the state as an object of a class of riis.laws.
nb::object state_of(const char *name, const nb::dict &values) {
  return nb::module_::import_("riis.laws").attr(name)(**values);
}

nb::object advance_switch(nb::handle law_, nb::handle before_, nb::handle time, nb::handle pressure_difference,
                          nb::handle flow) {
  const riis_opening_switch law = read(law_, riis_opening_switch_init, of_switch);
  riis_opening_switch_state before = read(before_, riis_opening_switch_state_init, of_switch_state);
  before.phase =
      choice(before_.attr("phase"), "phase", {{"closing", RIIS_PHASE_CLOSING}, {"opening", RIIS_PHASE_OPENING}});
  riis_opening_switch_state now = before;
  call_shortly(riis_opening_switch_advance(&law, &before, number(time, "time"),
                                           number(pressure_difference, "pressure_difference"), number(flow, "flow"),
                                           &now));
  nb::dict values = written(now, of_switch_state);
  values["phase"] = now.phase == RIIS_PHASE_OPENING ? "opening" : "closing";
  return state_of("OpeningSwitchState", values);
}

nb::object advance_angle(nb::handle law_, nb::handle before_, nb::handle time, nb::handle pressure_difference,
                         nb::handle flow) {
  const riis_opening_angle law = read(law_, riis_opening_angle_init, of_angle);
  const riis_opening_angle_state before = read(before_, riis_opening_angle_state_init, of_angle_state);
  riis_opening_angle_state now = before;
  call_shortly(riis_opening_angle_advance(&law, &before, number(time, "time"),
                                          number(pressure_difference, "pressure_difference"), number(flow, "flow"),
                                          &now));
  return state_of("OpeningAngleState", written(now, of_angle_state));
}

}  // namespace

void add_laws(nb::module_ &module) {
  module.def("_opening_from_table", &from_table);
  module.def("_opening_from_times", &from_times);
  module.def("_advance_switch", &advance_switch);
  module.def("_advance_angle", &advance_angle);
}

}  // namespace riis_python
