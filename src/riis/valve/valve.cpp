// SPDX-License-Identifier: Apache-2.0
#include "valve/valve.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "common/nearest_name.hpp"
#include "valve/warped_patches.hpp"

namespace riis {
namespace {

// Shortens a name for a message, because it may have any length.
std::string_view shown(std::string_view name) { return name.substr(0, 80); }

// Returns the parameter that the user may have meant, or "" if none is near. The result has a leaflet's name if the given name
// has one.
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
  const std::string_view nearest = nearest_parameter(kind, name);
  const bool is_near = !nearest.empty();
  fail(RIIS_INVALID_PARAMETER, "'", shown(name), "' is not a parameter of the ", kind.name, " valve; ",
       is_near ? "did you mean '" : "", shown(nearest), is_near ? "'? " : "",
       "riis_valve_get_parameter and riis params list them");
}

// Returns whether the spec's name consists of a leaflet's name, a dot, and the given name.
bool is_of_a_leaflet(const ParameterSpec &spec, std::string_view name) {
  const std::string_view full = spec.name;
  return full.size() > name.size() + 1 && full.substr(full.size() - name.size()) == name &&
         full[full.size() - name.size() - 1] == '.';
}

void check(const ParameterSpec &spec, std::string_view name, std::int64_t n_values, const double *values) {
  if (n_values != spec.n_values)
    fail(RIIS_INVALID_PARAMETER, "parameter '", shown(name), "' has ", spec.n_values, " value",
         spec.n_values == 1 ? "" : "s", ", not ", n_values);
  for (int i = 0; i < spec.n_values; ++i)
    if (!(values[i] >= spec.minimum && values[i] <= spec.maximum))
      fail(RIIS_INVALID_PARAMETER, "parameter '", shown(name), "' is ", values[i], "; it must be from ", spec.minimum,
           " to ", spec.maximum);
}

}  // namespace

const ValveKind &find_valve_kind(std::string_view name) {
  if (name == "aortic") return aortic_valve_kind();
  if (name == "bileaflet") return bileaflet_valve_kind();
  if (name == "mitral") return mitral_valve_kind();
  if (name == "trileaflet") return trileaflet_valve_kind();
  fail(RIIS_INVALID_PARAMETER, "'", shown(name),
       "' is not a kind of valve; there are: aortic, bileaflet, mitral, trileaflet");
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
      fail(RIIS_INVALID_PARAMETER, "parameter '", specs[i].name, "' has ", specs[i].n_values, " value",
           specs[i].n_values == 1 ? "" : "s", ", not ", n_values);
    std::copy_n(state_.values[i].begin(), n_values, out);
    return;
  }
  for (const ParameterSpec &spec : specs)
    if (is_of_a_leaflet(spec, name))
      fail(RIIS_INVALID_PARAMETER, "parameter '", spec.name.c_str() + (spec.name.size() - name.size()),
           "' exists for each leaflet separately: name one, as in '", spec.name, "'");
  fail_unknown(*kind_, name);
}

void Valve::set_open_state(const Valve &open) {
  if (open.kind_ != kind_)
    fail(RIIS_INVALID_PARAMETER, "the open state is of the kind ", open.kind_->name, ", the valve of the kind ",
         kind_->name, ": both must be of one kind");
  if (kind_->check_states) kind_->check_states(state_, open.state_, "the open state");
  open_ = ValveState(open.state_);  // copied first, because member-by-member assignment could fail half way
}

void Valve::set_warp(const WarpMap *closed, const WarpMap *open) {
  if (kind_->is_rigid && closed)
    fail(RIIS_INVALID_PARAMETER, "the ", kind_->name,
         " valve cannot be warped, because its leaflets and its ring are rigid: place it by scale, rotation and "
         "translation");
  if (!closed) {
    warp_.reset();
    return;
  }
  // The copies are made first, because assignment member by member could fail half way. Their memory comes from the last ones.
  Warp made{*closed, {}};
  if (open) made.open = *open;
  warp_ = std::move(made);
}

Valve::Disc Valve::disc() const {
  constexpr std::string_view shift = "translation";
  Disc disc{0, 0, 0};
  double n_shifts = 0, z = 0;
  for (std::size_t i = 0; i < kind_->parameters.size(); ++i) {
    const std::string_view name = kind_->parameters[i].name;
    const std::array<double, 3> &value = state_.values[i];
    if (name == "root_radius" || name == "radius") disc.radius = value[0];
    if (name != shift && !is_of_a_leaflet(kind_->parameters[i], shift)) continue;
    ++n_shifts;
    disc.x += (value[0] - disc.x) / n_shifts;
    disc.y += (value[1] - disc.y) / n_shifts;
    z += (value[2] - z) / n_shifts;
  }
  if (!warp_ || disc.radius == 0) return disc;
  const BlendedWarp warp(warp_->closed, warp_->open ? *warp_->open : warp_->closed, opening());
  constexpr int n_corners = 96;
  constexpr double turn = 6.283185307179586 / n_corners;
  const double reach = disc.radius * std::sqrt(turn / std::sin(turn));
  for (int i = 0; i < n_corners; ++i)
    disc.rim.push_back(warp.value({disc.x + reach * std::cos(i * turn), disc.y + reach * std::sin(i * turn), z}));
  return disc;
}

namespace {

constexpr const char *fixed_for = ", but the surface's triangulation is fixed for ";

// `where` names the state in messages.
void check_same_state(const ValveKind &kind, const ValveState &fixed, const ValveState &now, const char *where) {
  for (std::size_t i = 0; i < kind.parameters.size(); ++i) {
    const ParameterSpec &spec = kind.parameters[i];
    const auto &was = fixed.values[i], &is = now.values[i];
    if (i == kind.opening) continue;
    for (std::size_t k = 0; k < static_cast<std::size_t>(spec.n_values); ++k)
      if (was[k] != is[k])
        fail(RIIS_INVALID_PARAMETER, spec.name, where, " is ", is[k], fixed_for, was[k],
             ": only opening and placement may move");
  }
  for (std::size_t i = 0; i < fixed.patches.curves.size(); ++i)
    if (!are_equal(fixed.patches.curves[i], now.patches.curves[i]))
      fail(RIIS_INVALID_PARAMETER, "curve ", i, where,
           " differs from the curve that the surface's triangulation is fixed for",
           ": only opening and placement may move");
}

}  // namespace

void Valve::check_same_but_for_opening(const Valve &other) const {
  if (other.kind_ != kind_)
    fail(RIIS_INVALID_PARAMETER, "the valve is of the kind ", other.kind_->name, fixed_for, "one of the kind ",
         kind_->name);
  if (kind_->check_states) kind_->check_states(state_, other.state_, "the valve");
  check_same_state(*kind_, state_, other.state_, "");
  if (open_.has_value() != other.open_.has_value())
    fail(RIIS_INVALID_PARAMETER, "the valve has ", other.open_ ? "an" : "no", " open state", fixed_for,
         other.open_ ? "none" : "one");
  if (open_) check_same_state(*kind_, *open_, *other.open_, " in the open state");
  if (warp_.has_value() != other.warp_.has_value())
    fail(RIIS_INVALID_PARAMETER, "the valve has ", other.warp_ ? "a" : "no", " warp", fixed_for,
         other.warp_ ? "none" : "one");
}

bool Valve::has_default_shape() const {
  if (open_ || warp_ || !state_.patches.curves.empty()) return false;
  for (std::size_t i = 0; i < kind_->parameters.size(); ++i)
    if (i != kind_->opening && state_.values[i] != kind_->parameters[i].default_values) return false;
  return true;
}

namespace {

class Digest {
 public:
  void add(std::uint64_t word) {
    digest_ = (digest_ ^ word) * 0x9e3779b97f4a7c15;
    digest_ ^= digest_ >> 32;
  }
  void add(double number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    add(bits);
  }
  void add(const ValveKind &kind, const ValveState &state) {
    for (std::size_t i = 0; i < kind.parameters.size(); ++i)
      for (const double value : state.values[i])
        if (i != kind.opening) add(value);
    for (const Curve &curve : state.patches.curves)
      for (const Bezier &piece : curve.pieces())
        for (int i = 0; i <= piece.degree; ++i)
          for (const double x : {view(piece.control)[i].x, view(piece.control)[i].y, view(piece.control)[i].z}) add(x);
    for (const Patch &patch : state.patches.patches) {
      for (const PatchImage &image : patch.images) add(static_cast<std::uint64_t>(image.leaflet_id));
      for (const Side *side : {&patch.v0, &patch.v1, &patch.u0, &patch.u1})
        add(static_cast<std::uint64_t>(2 * side->curve + (side->reversed ? 1 : 0)));
    }
  }
  void add(const WarpMap &map) {
    add(static_cast<std::uint64_t>(map.source_x.size()));
    for (const Vector<double> *list : {&map.source_x, &map.source_y, &map.source_z})
      for (const double x : *list) add(x);
  }
  std::uint64_t value() const { return digest_ == 0 ? 1 : digest_; }

 private:
  std::uint64_t digest_ = 0x7269697373686170;
};

}  // namespace

std::uint64_t Valve::shape_digest() const {
  Digest digest;
  for (const char *letter = kind_->name; *letter; ++letter) digest.add(static_cast<std::uint64_t>(*letter));
  digest.add(*kind_, state_);
  if (open_) digest.add(*kind_, *open_);
  if (warp_) digest.add(warp_->closed);
  if (warp_ && warp_->open) digest.add(*warp_->open);
  return digest.value();
}

PatchSet Valve::make_patches() const { return make_patches(FoldCheck::yes); }

PatchSet Valve::make_patches(FoldCheck check) const {
  if (opening() != 0 && !can_open())
    fail(RIIS_INVALID_PARAMETER, "opening is ", opening(), ", but the ", kind_->name,
         " valve has only one state: set its open state with riis_valve_set_open_state");
  if (kind_->check_values) {
    kind_->check_values(state_.values);
    if (open_) check_open_values();
  }
  PatchSet made = kind_->make_patches(state_, open_ ? *open_ : state_, opening());
  if (!warp_) return made;
  return warped(made, {warp_->closed, warp_->open ? *warp_->open : warp_->closed, opening()}, check);
}

PatchSet Valve::make_patches_before(const Valve &before) const {
  if (before.kind_ != kind_)
    fail(RIIS_INVALID_PARAMETER, "valve_before is of the kind ", before.kind_->name, ", valve of the kind ",
         kind_->name, ": they must be two states of one valve");
  if (kind_->check_states) kind_->check_states(state_, before.state_, "valve_before");
  if (warp_.has_value() != before.warp_.has_value())
    fail(RIIS_INVALID_PARAMETER, "valve_before has ", before.warp_ ? "a" : "no", " warp, but valve has ",
         warp_ ? "one" : "none", ": for a valve at rest, set a warp whose targets are its landmarks");
  try {
    // The earlier state was the valve's own state once, so its folds were searched for then.
    return before.make_patches(FoldCheck::no);
  } catch (const Error &error) {
    fail(error.status, "in valve_before: ", error.message.text());
  }
}

void Valve::check_open_values() const {
  try {
    kind_->check_values(open_->values);
  } catch (const Error &error) {
    fail(error.status, "in the open state: ", error.message.text());
  }
}

Bezier blend(const Bezier &closed, const Bezier &open, double opening) {
  Bezier made = closed;
  for (int i = 0; i <= closed.degree; ++i)
    view(made.control)[i] = blend(view(closed.control)[i], view(open.control)[i], opening);
  return made;
}

Bezier rate(const Bezier &closed, const Bezier &open) {
  Bezier made = closed;
  for (int i = 0; i <= closed.degree; ++i) view(made.control)[i] = view(open.control)[i] - view(closed.control)[i];
  return made;
}

ParameterSpec opening_spec(const char *description, double default_value) {
  return {"opening", "1", description, 1, {default_value}, 0, 1};
}

void check_ratio(const ParameterSpec &spec, const std::array<double, 3> &values, const Measure &measure, double least,
                 double most) {
  for (int i = 0; i < spec.n_values; ++i) {
    const double value = view(values)[i];
    if (!(std::abs(value) >= least * measure.size && std::abs(value) <= most * measure.size))
      fail(RIIS_INVALID_PARAMETER, spec.name, " is ", value, "; it must be from ", least, " to ", most, " times ",
           measure.name, ", which is ", measure.size);
  }
}

}  // namespace riis
