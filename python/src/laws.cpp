// SPDX-License-Identifier: Apache-2.0
// Laws of opening. riis/laws.py has the classes; these functions take their values one by one.
#include "module.hpp"
#include "surface.hpp"

namespace riis_python {
namespace {

// Calls at(time, opening, rate) for a number or for an array of times. Returns (opening, rate).
template <class At>
nb::object at_times(nb::handle time, const At &at) {
  if (!PyObject_CheckBuffer(time.ptr()) || !nb::hasattr(time, "shape") || nb::len(nb::object(time.attr("shape"))) == 0) {
    double opening = 0, rate = 0;
    call_shortly(at(number(time, "time"), &opening, &rate));
    return nb::make_tuple(opening, rate);
  }
  const Array times = Array::of<double>(time, "time");
  times.expect({-1});
  const std::int64_t n = times.size(0);
  const nb::object openings = new_array("float64", {n}), rates = new_array("float64", {n});
  const Array opening = Array::of<double>(openings, "opening", Access::write), rate = Array::of<double>(rates, "rate", Access::write);
  for (std::int64_t i = 0; i < n; ++i)
    call_shortly(at(times.data<double>()[i], opening.data<double>() + i, rate.data<double>() + i));
  return nb::make_tuple(openings, rates);
}

nb::object from_table(nb::handle keys_, nb::handle openings_, nb::handle period, nb::handle interpolation, nb::handle time) {
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
  return at_times(time, [&](double t, double *opening, double *rate) { return riis_opening_from_table(&table, t, opening, rate); });
}

nb::object from_times(nb::handle opening_start, nb::handle opening_seconds, nb::handle closing_start, nb::handle closing_seconds,
                      nb::handle closed, nb::handle open, nb::handle period, nb::handle time) {
  riis_opening_times times;
  call_shortly(riis_opening_times_init(&times, sizeof times));
  times.opening_start = number(opening_start, "opening_start");
  times.opening_seconds = number(opening_seconds, "opening_seconds");
  times.closing_start = number(closing_start, "closing_start");
  times.closing_seconds = number(closing_seconds, "closing_seconds");
  times.closed = number(closed, "closed");
  times.open = number(open, "open");
  times.period = number(period, "period");
  return at_times(time, [&](double t, double *opening, double *rate) { return riis_opening_from_times(&times, t, opening, rate); });
}

double attribute(nb::handle of, const char *name) { return number(of.attr(name), name); }

// Returns a state of a class of riis.laws.
nb::object state_of(const char *name, nb::handle values) { return nb::module_::import_("riis.laws").attr(name)(**nb::borrow<nb::dict>(values)); }

nb::object advance_switch(nb::handle law_, nb::handle before_, nb::handle time, nb::handle pressure_difference, nb::handle flow) {
  riis_opening_switch law;
  call_shortly(riis_opening_switch_init(&law, sizeof law));
  law.opening_seconds = attribute(law_, "opening_seconds");
  law.closing_seconds = attribute(law_, "closing_seconds");
  law.open_above = attribute(law_, "open_above");
  law.close_below = attribute(law_, "close_below");
  law.filter_seconds = attribute(law_, "filter_seconds");
  law.dwell_seconds = attribute(law_, "dwell_seconds");
  riis_opening_switch_state before, now;
  call_shortly(riis_opening_switch_state_init(&before, sizeof before));
  now = before;
  before.time = attribute(before_, "time");
  before.opening = attribute(before_, "opening");
  before.rate = attribute(before_, "rate");
  before.progress = attribute(before_, "progress");
  before.pressure_difference = attribute(before_, "pressure_difference");
  before.flow = attribute(before_, "flow");
  before.since = attribute(before_, "since");
  before.phase = choice(before_.attr("phase"), "phase", {{"closing", RIIS_PHASE_CLOSING}, {"opening", RIIS_PHASE_OPENING}});
  call_shortly(riis_opening_switch_advance(&law, &before, number(time, "time"),
                                           number(pressure_difference, "pressure_difference"), number(flow, "flow"), &now));
  nb::dict values;
  values["time"] = now.time;
  values["opening"] = now.opening;
  values["rate"] = now.rate;
  values["progress"] = now.progress;
  values["pressure_difference"] = now.pressure_difference;
  values["flow"] = now.flow;
  values["since"] = now.since;
  values["phase"] = now.phase == RIIS_PHASE_OPENING ? "opening" : "closing";
  return state_of("OpeningSwitchState", values);
}

nb::object advance_angle(nb::handle law_, nb::handle before_, nb::handle time, nb::handle pressure_difference, nb::handle flow) {
  riis_opening_angle law;
  call_shortly(riis_opening_angle_init(&law, sizeof law));
  law.pressure_gain = attribute(law_, "pressure_gain");
  law.flow_gain = attribute(law_, "flow_gain");
  law.friction = attribute(law_, "friction");
  law.vortex_gain = attribute(law_, "vortex_gain");
  law.angle_min = attribute(law_, "angle_min");
  law.angle_max = attribute(law_, "angle_max");
  riis_opening_angle_state before, now;
  call_shortly(riis_opening_angle_state_init(&before, sizeof before));
  now = before;
  before.time = attribute(before_, "time");
  before.opening = attribute(before_, "opening");
  before.rate = attribute(before_, "rate");
  before.angle = attribute(before_, "angle");
  before.angle_rate = attribute(before_, "angle_rate");
  before.pressure_difference = attribute(before_, "pressure_difference");
  before.flow = attribute(before_, "flow");
  call_shortly(riis_opening_angle_advance(&law, &before, number(time, "time"), number(pressure_difference, "pressure_difference"),
                                          number(flow, "flow"), &now));
  nb::dict values;
  values["time"] = now.time;
  values["opening"] = now.opening;
  values["rate"] = now.rate;
  values["angle"] = now.angle;
  values["angle_rate"] = now.angle_rate;
  values["pressure_difference"] = now.pressure_difference;
  values["flow"] = now.flow;
  return state_of("OpeningAngleState", values);
}

}  // namespace

void add_laws(nb::module_ &module) {
  module.def("_opening_from_table", &from_table);
  module.def("_opening_from_times", &from_times);
  module.def("_advance_switch", &advance_switch);
  module.def("_advance_angle", &advance_angle);
}

}  // namespace riis_python
