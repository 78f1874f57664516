// SPDX-License-Identifier: Apache-2.0
#include "valve/valve.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "common/nearest_name.hpp"
#include "valve/warp.hpp"

namespace riis {
namespace {

// Shortens a name for a message, because it may have any length.
std::string_view shown(std::string_view name) { return name.substr(0, 80); }

// Returns the part of a name after the leaflet's name.
std::string_view without_leaflet(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

// Returns the parameter that the user may have meant, or "" if none is near. The result begins with a leaflet's name only if the
// given name does.
std::string_view nearest_parameter(const ValveKind &kind, std::string_view name) {
  const bool names_leaflet = name.find('.') != std::string_view::npos;
  NearestName nearest(name);
  for (const ParameterSpec &spec : kind.parameters) {
    const std::string_view full = spec.name;
    nearest.consider(names_leaflet ? full : full.substr(full.find('.') + 1));
    if (spec.other.name && !names_leaflet) nearest.consider(spec.other.name);
  }
  return nearest.nearest();
}

// Returns whether a name is the name of a bump's parameter. Kinds with bumps have these parameters at the end of their lists.
bool is_of_bump(std::string_view name) { return name.substr(0, 5) == "bump_"; }

[[noreturn]] void fail_unknown(const ValveKind &kind, std::string_view name) {
  for (const AbsentName &absent : kind.absent)
    if (without_leaflet(name) == absent.name)
      fail(RIIS_INVALID_PARAMETER, "'", name, "' is not a parameter of the ", kind.name, " valve: ", absent.reason);
  if (is_of_bump(name) && !is_of_bump(kind.parameters.back().name))
    fail(RIIS_INVALID_PARAMETER, "'", shown(name), "' is not a parameter of the ", kind.name,
         " valve: only bicuspid, coapting, quadricuspid, mitral_coapting and tricuspid valves have bumps");
  const std::string_view nearest = nearest_parameter(kind, name);
  const bool is_near = !nearest.empty();
  fail(RIIS_INVALID_PARAMETER, "'", shown(name), "' is not a parameter of the ", kind.name, " valve; ",
       is_near ? "did you mean '" : "", shown(nearest), is_near ? "'? " : "",
       "riis_valve_get_parameter and riis params list them");
}

bool is_of_a_leaflet(const ParameterSpec &spec) { return spec.name.find('.') != std::string::npos; }

// Says whether a name means a parameter. If so, `factor` times the parameter's value is the value under this name.
struct Naming {
  bool names_it = false;
  bool is_whole = false;  // the name means no other parameter
  double factor = 1;      // factor from the parameter's value to the value under that name
};

Naming naming(const ParameterSpec &spec, std::string_view name) {
  const std::string_view full = spec.name, base = without_leaflet(full);
  const std::string_view leaflet = full.substr(0, full.size() - base.size());  // the leaflet's name with its dot
  const auto names = [&](std::string_view own, double factor) -> Naming {
    if (name == own) return {true, leaflet.empty(), factor};
    const bool is_whole = !leaflet.empty() && name.size() == leaflet.size() + own.size() &&
                          name.substr(0, leaflet.size()) == leaflet && name.substr(leaflet.size()) == own;
    return {is_whole, is_whole, factor};
  };
  const Naming by_own = names(base, 1);
  return by_own.names_it || !spec.other.name ? by_own : names(spec.other.name, spec.other.factor);
}

// Calls action(position, naming) for all parameters that a name means. A whole name, such as "right.leaflet_angle", means one
// parameter. A name without the leaflet's name means this parameter of every leaflet. The function allocates nothing, because a
// solver sets the opening in each time step.
template <class Action>
void for_each_meant(const ValveKind &kind, std::string_view name, const Action &action) {
  const auto &specs = kind.parameters;
  for (std::size_t i = 0; i < specs.size(); ++i)
    if (const Naming named = naming(specs[i], name); named.is_whole) return action(i, named);
  bool names_any = false;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const Naming named = naming(specs[i], name);
    if (!named.names_it) continue;
    names_any = true;
    action(i, named);
  }
  if (!names_any) fail_unknown(kind, name);
}

void check_n_values(const ParameterSpec &spec, std::string_view name, std::int64_t n_values) {
  if (n_values != spec.n_values)
    fail(RIIS_INVALID_PARAMETER, "parameter '", shown(name), "' has ", spec.n_values, " value",
         spec.n_values == 1 ? "" : "s", ", not ", n_values);
}

void check_range(const ParameterSpec &spec, std::string_view name, double factor, double value) {
  if (!(value >= factor * spec.minimum && value <= factor * spec.maximum))
    fail(RIIS_INVALID_PARAMETER, "parameter '", shown(name), "' is ", value, "; it must be from ",
         factor * spec.minimum, " to ", factor * spec.maximum);
}

// Checks values that follow from rules. Such a value may be out of its range if the rule uses sizes that are near the ends of
// their ranges.
void check_derived(const ValveKind &kind, const ValveState &state) {
  for (std::size_t i = 0; i < kind.parameters.size(); ++i) {
    const ParameterSpec &spec = kind.parameters[i];
    if (!spec.rule.text || state.is_set[i]) continue;
    for (int k = 0; k < spec.n_values; ++k) {
      const double value = view(state.values[i])[k];
      if (!(value >= spec.minimum && value <= spec.maximum))
        fail(RIIS_INVALID_PARAMETER, spec.name, " was not set and is ", spec.rule.text, ", which is ", value,
             "; it must be from ", spec.minimum, " to ", spec.maximum);
    }
  }
}

}  // namespace

namespace {

struct NamedKind {
  const char *name;
  const ValveKind &(*kind)();
};
constexpr NamedKind kinds[] = {
    {"aortic", aortic_valve_kind},
    {"bicuspid", bicuspid_valve_kind},
    {"bileaflet", bileaflet_valve_kind},
    {"coapting", coapting_valve_kind},
    {"mitral", mitral_valve_kind},
    {"mitral_coapting", mitral_coapting_valve_kind},
    {"quadricuspid", quadricuspid_valve_kind},
    {"tricuspid", tricuspid_valve_kind},
    {"trileaflet", trileaflet_valve_kind},
};

}  // namespace

const ValveKind &find_valve_kind(std::string_view name) {
  std::string names;
  for (const NamedKind &known : kinds) {
    if (name == known.name) return known.kind();
    names += (names.empty() ? "" : ", ") + std::string(known.name);
  }
  fail(RIIS_INVALID_PARAMETER, "'", shown(name), "' is not a kind of valve; there are: ", names.c_str());
}

Valve::Valve(const ValveKind &kind, PatchSet patches) : kind_(&kind), state_{{}, std::move(patches), {}} {
  state_.values.reserve(kind.parameters.size());
  for (const ParameterSpec &spec : kind.parameters) state_.values.push_back(spec.default_values);
  state_.is_set.assign(kind.parameters.size(), 0);
  for (std::size_t i = 0; i < kind.parameters.size(); ++i) {
    const std::string_view name = kind.parameters[i].name;
    if (name == "root_radius" || name == "radius") radius_ = i;
    if (without_leaflet(name) == "translation") translations_.push_back(i);
  }
}

std::uint64_t Valve::next_revision() {
  static std::atomic<std::uint64_t> last{0};
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

void Valve::set(std::string_view name, std::int64_t n_values, const double *new_values) {
  revision_ = next_revision();
  for_each_meant(*kind_, name, [&](std::size_t position, const Naming &named) {
    const ParameterSpec &spec = kind_->parameters[position];
    check_n_values(spec, name, n_values);
    for (int k = 0; k < spec.n_values; ++k) check_range(spec, name, named.factor, new_values[k]);
  });
  for_each_meant(*kind_, name, [&](std::size_t position, const Naming &named) {
    for (int k = 0; k < kind_->parameters[position].n_values; ++k)
      view(state_.values[position])[k] = new_values[k] / named.factor;
    state_.is_set[position] = 1;
  });
  if (name == "skirt_length") skirt_lengths_.clear();
  derive();
}

void Valve::unset(std::string_view name) {
  revision_ = next_revision();
  for_each_meant(*kind_, name, [&](std::size_t position, const Naming &) {
    state_.values[position] = kind_->parameters[position].default_values;
    state_.is_set[position] = 0;
  });
  if (name == "skirt_length") skirt_lengths_.clear();
  derive();
}

void Valve::derive() {
  for (std::size_t i = 0; i < kind_->parameters.size(); ++i) {
    const ParameterRule &rule = kind_->parameters[i].rule;
    if (rule.text && !state_.is_set[i]) state_.values[i] = rule.value_from(state_.values);
  }
}

std::size_t Valve::position_of(std::string_view name) const {
  const auto &specs = kind_->parameters;
  for (std::size_t i = 0; i < specs.size(); ++i)
    if (naming(specs[i], name).is_whole) return i;
  for (const ParameterSpec &spec : specs)
    if (is_of_a_leaflet(spec) && naming(spec, name).names_it) {
      const std::string leaflet = spec.name.substr(0, spec.name.size() - without_leaflet(spec.name).size());
      fail(RIIS_INVALID_PARAMETER, "parameter '", name, "' exists for each leaflet separately: name a leaflet, as in '",
           leaflet, name, "'");
    }
  fail_unknown(*kind_, name);
}

void Valve::set_skirt_lengths(SkirtLengths lengths) {
  revision_ = next_revision();
  double largest = 0;
  for (const Vector<double> &of_side : lengths)
    for (const double length : of_side) largest = std::max(largest, length);
  skirt_lengths_ = std::move(lengths);
  state_.values[kind_->skirt_length][0] = largest;
  state_.is_set[kind_->skirt_length] = 1;
}

void Valve::get(std::string_view name, std::int64_t n_values, double *out) const {
  const std::size_t position = position_of(name);
  const ParameterSpec &spec = kind_->parameters[position];
  check_n_values(spec, name, n_values);
  const double factor = naming(spec, name).factor;
  for (int k = 0; k < spec.n_values; ++k) out[k] = factor * view(state_.values[position])[k];
}

std::array<double, 2> Valve::range_of(std::string_view name) const {
  const ParameterSpec &spec = kind_->parameters[position_of(name)];
  const double factor = naming(spec, name).factor;
  return {factor * spec.minimum, factor * spec.maximum};
}

bool Valve::is_set(std::string_view name) const { return state_.is_set[position_of(name)] != 0; }

void Valve::set_open_state(const Valve &open) {
  revision_ = next_revision();
  if (open.kind_ != kind_)
    fail(RIIS_INVALID_PARAMETER, "the open state is of the kind ", open.kind_->name, ", the valve of the kind ",
         kind_->name, ": both must be of one kind");
  if (kind_->check_states) kind_->check_states(state_, open.state_, "the open state");
  open_ = ValveState(open.state_);  // copied first, because assigning one member after another could fail half way
}

void Valve::set_warp(const WarpMap *closed, const WarpMap *open) {
  revision_ = next_revision();
  if (kind_->is_rigid && closed)
    fail(RIIS_INVALID_PARAMETER, "the ", kind_->name,
         " valve cannot be warped, because its leaflets and its ring are rigid: place it by scale, rotation and "
         "translation");
  if (!closed) {
    warp_.reset();
    return;
  }
  // The copies are complete before they replace the old maps, because assigning one member after another could fail half way.
  Warp made{*closed, {}, warp_ ? warp_->known : nullptr};
  if (open) made.open = *open;
  warp_ = std::move(made);
}

BlendedWarp Valve::blended_warp() const {
  return {warp_->closed, warp_->open ? *warp_->open : warp_->closed, opening()};
}

Valve::Disc Valve::disc() const {
  Disc disc{kind_->is_rigid && radius_ ? state_.values[*radius_][0] : 0, 0, 0, {0, 0, 1}};
  double n_shifts = 0, z = 0;
  for (const std::size_t i : translations_) {
    const std::array<double, 3> &shift = state_.values[i];
    ++n_shifts;
    disc.x += (shift[0] - disc.x) / n_shifts;
    disc.y += (shift[1] - disc.y) / n_shifts;
    z += (shift[2] - z) / n_shifts;
  }
  if (!warp_) return disc;
  const MapAt here = blended_warp().at({disc.x, disc.y, z});
  const Vec3 normal = cross(here.along_x, here.along_y);
  if (length(normal) > 0) disc.axis = (1 / length(normal)) * normal;
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
             ": only opening and placement may change");
  }
  for (std::size_t i = 0; i < fixed.patches.curves.size(); ++i)
    if (!are_equal(fixed.patches.curves[i], now.patches.curves[i]))
      fail(RIIS_INVALID_PARAMETER, "curve ", i, where,
           " differs from the curve that the surface's triangulation is fixed for",
           ": only opening and placement may change");
}

}  // namespace

void Valve::check_same_but_for_opening(const Valve &other) const {
  if (other.kind_ != kind_)
    fail(RIIS_INVALID_PARAMETER, "the valve is of the kind ", other.kind_->name, fixed_for, "one of the kind ",
         kind_->name);
  if (kind_->check_states) kind_->check_states(state_, other.state_, "the valve");
  check_same_state(*kind_, state_, other.state_, "");
  if (skirt_lengths_ != other.skirt_lengths_)
    fail(RIIS_INVALID_PARAMETER,
         "the lengths of the skirt to the wall have changed since the surface got its fixed triangulation: only "
         "opening and placement may change");
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
      for (const Bezier &span : curve.spans())
        for (int i = 0; i <= span.degree; ++i)
          for (const double x : {view(span.control)[i].x, view(span.control)[i].y, view(span.control)[i].z}) add(x);
    for (const Patch &patch : state.patches.patches) {
      for (const PatchImage &image : patch.images) add(static_cast<std::uint64_t>(image.leaflet_id));
      for (const Side *side : {&patch.v0, &patch.v1, &patch.u0, &patch.u1})
        add(static_cast<std::uint64_t>(2 * side->curve + (side->reversed ? 1 : 0)));
    }
  }
  void add(const WarpMap &map) {
    add(static_cast<std::uint64_t>(map.source_x.size()));
    for (const double x : {map.centre.x, map.centre.y, map.centre.z, map.size}) add(x);
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
  for (const Vector<double> &of_side : skirt_lengths_)
    for (const double length : of_side) digest.add(length);
  return digest.value();
}

PatchSet Valve::make_patches() const { return make_patches(FoldCheck::yes); }

PatchSet Valve::make_patches(FoldCheck check) const {
  if (opening() != 0 && !can_open())
    fail(RIIS_INVALID_PARAMETER, "opening is ", opening(), ", but the ", kind_->name,
         " valve has only one state: set its open state with riis_valve_set_open_state");
  check_derived(*kind_, state_);
  if (kind_->check_values) {
    // These checks do not depend on the opening, so a time step does not repeat them.
    const std::uint64_t shape = shape_digest();
    if (checked_.digest != shape) {
      kind_->check_values(state_.values);
      if (open_) check_open_values();
      checked_.digest = shape;
    }
  }
  PatchSet made = kind_->make_patches(state_, open_ ? *open_ : state_, opening());
  const SkirtAxis axis = kind_->skirt_axis;
  aim_skirt(made, axis);
  // Neighbours are found before the warp, so that a moving warp does not change them.
  if (axis == SkirtAxis::boundary) made.neighbour_ends = neighbour_ends(made, false);
  if (warp_) {
    const PatchSet at_rest = std::move(made);
    const BlendedWarp warp = blended_warp();
    made = warped(at_rest, warp, *landmark_cuts(at_rest), check);
    made.neighbour_ends = axis == SkirtAxis::of_cusp ? neighbour_ends(at_rest, true) : at_rest.neighbour_ends;
    if (axis == SkirtAxis::boundary) aim_skirt(made, axis);
    if (axis == SkirtAxis::of_cusp || axis == SkirtAxis::vertical) aim_warped_skirt(made, at_rest, warp);
  }
  if (has_skirt()) add_skirt(made, state_.values[kind_->skirt_length][0], skirt_lengths_);
  return made;
}

std::shared_ptr<const LandmarkCuts> Valve::landmark_cuts(const PatchSet &now) const {
  const std::uint64_t digest = shape_digest();
  std::shared_ptr<const KnownCuts> known = std::atomic_load(&warp_->known);
  if (!known || known->shape_digest != digest) {
    const auto add = [&](LandmarkCuts &cuts, double at, const WarpMap &map) {
      if (at == opening()) return cuts.add(now, map);
      cuts.add(kind_->make_patches(state_, open_ ? *open_ : state_, at), map);
    };
    KnownCuts made{digest, {}};
    add(made.cuts, 0, warp_->closed);
    if (warp_->open && can_open()) add(made.cuts, 1, *warp_->open);
    known = std::make_shared<const KnownCuts>(std::move(made));
    std::atomic_store(&warp_->known, known);
  }
  return {known, &known->cuts};
}

PatchSet Valve::make_patches_before(const Valve &before, const PatchSet *known) const {
  before.check_is_state_of(*kind_, warp_.has_value(), {"valve_before", "valve"});
  if (kind_->check_states) kind_->check_states(state_, before.state_, "valve_before");
  if (known) return *known;
  // The earlier state was once the valve's present state, and was searched for folds then. The search for folds is therefore not
  // repeated.
  return before.make_patches_unsearched("valve_before");
}

void Valve::check_is_state_of(const ValveKind &kind, bool is_warped, const StateNames &names) const {
  if (kind_ != &kind)
    fail(RIIS_INVALID_PARAMETER, names.state, " is of the kind ", kind_->name, ", ", names.of, " of the kind ",
         kind.name, ": they must be two states of one valve");
  if (warp_.has_value() != is_warped)
    fail(RIIS_INVALID_PARAMETER, names.state, " has ", warp_ ? "a" : "no", " warp, but ", names.of, " has ",
         is_warped ? "one" : "none", ": for a valve at rest, set a warp whose targets are its landmarks");
}

PatchSet Valve::make_patches_unsearched(const char *name) const {
  try {
    return make_patches(FoldCheck::no);
  } catch (const Error &error) {
    fail(error.status, "in ", name, ": ", error.message.text());
  }
}

void Valve::check_open_values() const {
  try {
    check_derived(*kind_, *open_);
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

ValveKind with_skirt(ValveKind kind, SkirtAxis axis) {
  kind.skirt_axis = axis;
  kind.skirt_length = kind.parameters.size();
  kind.parameters.push_back({"skirt_length",
                             "length",
                             "length of a skirt, a strip from the leaflets to the wall; 0 means no skirt",
                             1,
                             {0},
                             0,
                             1e9});
  return kind;
}

ParameterSpec opening_spec(const char *description, double default_value) {
  return {"opening", "1", description, 1, {default_value}, 0, 1};
}

void check_ratio(const ParameterSpec &spec, const std::array<double, 3> &values, const Reference &reference,
                 double least, double most) {
  for (int i = 0; i < spec.n_values; ++i) {
    const double value = view(values)[i];
    if (!(std::abs(value) >= least * reference.size && std::abs(value) <= most * reference.size))
      fail(RIIS_INVALID_PARAMETER, spec.name, " is ", value, "; it must be from ", least, " to ", most, " times ",
           reference.name, ", which is ", reference.size);
  }
}

}  // namespace riis
