// SPDX-License-Identifier: Apache-2.0
#include "valve/valve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "api/errors.hpp"
#include "api/nearest_name.hpp"
#include "valve/aortic.hpp"
#include "valve/mitral.hpp"

namespace riis {
namespace {

// A name as it appears in an error: cut, because it may be anything.
struct Shown {
  explicit Shown(std::string_view text)
      : size(static_cast<int>(std::min<std::size_t>(text.size(), 80))), data(text.data()) {}
  int size;
  const char *data;
};

// The parameter that may have been meant, with its leaflet's name where the given name has one; "" if none is near.
std::string_view nearest_parameter(const ValveKind &kind, std::string_view name) {
  const bool names_leaflet = name.find('.') != std::string_view::npos;
  NearestName nearest(name);
  for (const ParameterSpec &spec : kind.parameters) {
    const std::string_view full = spec.name;
    nearest.consider(names_leaflet ? full : full.substr(full.find('.') + 1));
  }
  return nearest.nearest();
}

[[noreturn]] void fail_unknown(const ValveKind &kind, std::string_view name) {
  const Shown shown(name), nearest(nearest_parameter(kind, name));
  const bool is_near = nearest.size > 0;
  fail(RIIS_INVALID_PARAMETER,
       "'%.*s' is not a parameter of the %s valve; %s%.*s%sriis_valve_parameter and riis-mark --print-params list them",
       shown.size, shown.data, kind.name, is_near ? "did you mean '" : "", nearest.size, nearest.data,
       is_near ? "'? " : "");
}

// Whether the spec's name is a leaflet's name, a dot, and the given name.
bool is_of_a_leaflet(const ParameterSpec &spec, std::string_view name) {
  const std::string_view full = spec.name;
  return full.size() > name.size() + 1 && full.substr(full.size() - name.size()) == name &&
         full[full.size() - name.size() - 1] == '.';
}

void check(const ParameterSpec &spec, std::string_view name, std::int64_t n_values, const double *values) {
  const Shown shown(name);
  if (n_values != spec.n_values)
    fail(RIIS_INVALID_PARAMETER, "parameter '%.*s' has %d value%s, not %lld", shown.size, shown.data, spec.n_values,
         spec.n_values == 1 ? "" : "s", static_cast<long long>(n_values));
  for (int i = 0; i < spec.n_values; ++i)
    if (!(values[i] >= spec.minimum && values[i] <= spec.maximum))
      fail(RIIS_INVALID_PARAMETER, "parameter '%.*s' is %s; it must be from %s to %s", shown.size, shown.data,
           Number(values[i]).text, Number(spec.minimum).text, Number(spec.maximum).text);
}

}  // namespace

const ValveKind &find_valve_kind(std::string_view name) {
  if (name == "aortic") return aortic_valve_kind();
  if (name == "mitral") return mitral_valve_kind();
  const Shown shown(name);
  fail(RIIS_INVALID_PARAMETER, "'%.*s' is not a kind of valve; there are: aortic, mitral", shown.size, shown.data);
}

Valve::Valve(const ValveKind &kind, PatchSet patches) : kind_(&kind), state_{{}, std::move(patches)} {
  state_.values.reserve(kind.parameters.size());
  for (const ParameterSpec &spec : kind.parameters) state_.values.push_back(spec.default_values);
}

void Valve::set(std::string_view name, std::int64_t n_values, const double *new_values) {
  const auto &specs = kind_->parameters;
  const auto named = [&](const ParameterSpec &spec) { return spec.name == name || is_of_a_leaflet(spec, name); };
  if (std::none_of(specs.begin(), specs.end(), named)) fail_unknown(*kind_, name);
  for (const ParameterSpec &spec : specs)
    if (named(spec)) check(spec, name, n_values, new_values);
  for (std::size_t i = 0; i < specs.size(); ++i)
    if (named(specs[i])) std::copy_n(new_values, n_values, state_.values[i].begin());
}

void Valve::get(std::string_view name, std::int64_t n_values, double *out) const {
  const auto &specs = kind_->parameters;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (specs[i].name != name) continue;
    if (n_values != specs[i].n_values)
      fail(RIIS_INVALID_PARAMETER, "parameter '%s' has %d value%s, not %lld", specs[i].name.c_str(), specs[i].n_values,
           specs[i].n_values == 1 ? "" : "s", static_cast<long long>(n_values));
    std::copy_n(state_.values[i].begin(), n_values, out);
    return;
  }
  for (const ParameterSpec &spec : specs)
    if (is_of_a_leaflet(spec, name))
      fail(RIIS_INVALID_PARAMETER, "parameter '%s' belongs to one leaflet each: ask for '%s'",
           spec.name.c_str() + (spec.name.size() - name.size()), spec.name.c_str());
  fail_unknown(*kind_, name);
}

void Valve::set_open_state(const Valve &open) {
  if (open.kind_ != kind_)
    fail(RIIS_INVALID_PARAMETER,
         "the open state is of the kind %s, the valve of the kind %s: a valve opens to one of its own",
         open.kind_->name, kind_->name);
  if (kind_->check_states) kind_->check_states(state_, open.state_);
  open_ = ValveState(open.state_);  // copied aside: assigned member by member it could stop half way
}

PatchSet Valve::make_patches() const {
  const double opening = state_.values[kind_->opening][0];
  if (opening != 0 && !open_ && !kind_->opens_by_itself)
    fail(
        RIIS_INVALID_PARAMETER,
        "opening is %s, but the %s valve has one state only: give it another to open to with riis_valve_set_open_state "
        "or riis-mark --params-open",
        Number(opening).text, kind_->name);
  if (kind_->check_values) {
    kind_->check_values(state_.values);
    if (open_) check_open_values();
  }
  return kind_->make_patches(state_, open_ ? *open_ : state_, opening);
}

void Valve::check_open_values() const {
  try {
    kind_->check_values(open_->values);
  } catch (const Error &error) {
    fail(error.status, "in the open state: %s", error.text);
  }
}

Bezier blend(const Bezier &closed, const Bezier &open, double opening) {
  Bezier made = closed;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(closed.degree); ++i)
    made.control[i] = blend(closed.control[i], open.control[i], opening);
  return made;
}

ParameterSpec opening_spec(const char *description, double default_value) {
  return {"opening", "1", description, 1, {default_value}, 0, 1};
}

void check_ratio(const ParameterSpec &spec, const std::array<double, 3> &values, const Measure &measure, double least,
                 double most) {
  for (int i = 0; i < spec.n_values; ++i) {
    const double value = values[static_cast<std::size_t>(i)];
    if (!(std::abs(value) >= least * measure.size && std::abs(value) <= most * measure.size))
      fail(RIIS_INVALID_PARAMETER, "%s is %s; it must be from %s to %s times %s, which is %s", spec.name.c_str(),
           Number(value).text, Number(least).text, Number(most).text, measure.name, Number(measure.size).text);
  }
}

}  // namespace riis
