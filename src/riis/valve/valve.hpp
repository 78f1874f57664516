// SPDX-License-Identifier: Apache-2.0
// Valves: a kind, named parameters, and optionally a second state to which the valve opens.
// A valve takes names and values as users write them, checks them, and makes the patches at an opening.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/recycled.hpp"
#include "valve/landmark_cuts.hpp"
#include "valve/patches.hpp"
#include "valve/skirt.hpp"
#include "valve/warp.hpp"

namespace riis {

using ParameterValues = Vector<std::array<double, 3>>;  // one entry for each spec
inline Vec3 vector_of(const std::array<double, 3> &values) { return {values[0], values[1], values[2]}; }

// Computes the value of an unset parameter from the values of other parameters. The other parameters come earlier in the list, so
// their values are known already.
struct ParameterRule {
  const char *text = nullptr;  // such as "0.5 leaflet_height", or null without a rule
  std::array<double, 3> (*value)(const ParameterValues &values) = nullptr;
  std::size_t same_as = 0;  // without a function, the value is that of the parameter at this position

  std::array<double, 3> value_from(const ParameterValues &values) const {
    return value ? value(values) : values[same_as];
  }
};

// A second name for a parameter. The value under this name is the parameter's value times a factor. The factor is a power of 2,
// so that nothing is rounded.
struct OtherName {
  const char *name;
  double factor;
};

struct ParameterSpec {
  std::string name;  // "root_radius", or "right.leaflet_angle" for a parameter of one leaflet
  const char *unit;
  const char *description;
  int n_values;  // 1 or 3
  std::array<double, 3> default_values;
  double minimum, maximum;
  ParameterRule rule = {};         // from default values, the rule computes exactly the default, to the last bit
  OtherName other = {nullptr, 0};  // the other name without the leaflet's name
};

// A name that a user may expect, and why the kind has no parameter of this name. A name without a leaflet's name also stands for
// this name with any leaflet's name before it.
struct AbsentName {
  const char *name, *reason;
};

// A state of a valve: its parameters or, for valves given by patches, its patches.
struct ValveState {
  ParameterValues values;
  PatchSet patches;
  Vector<char> is_set;  // for each value: 1 if the caller set the value, 0 for a default and for a value from a rule
};

// A kind of valve: its parameters, and the functions that make patches from them.
struct ValveKind {
  const char *name;
  Vector<ParameterSpec> parameters;
  std::size_t opening;   // the position of the parameter "opening"
  bool opens_by_itself;  // one set of parameters defines both the closed and the open state
  // Refuses values that do not fit together. NULL if the kind has nothing to check.
  void (*check_values)(const ParameterValues &values);
  // Makes the patches at an opening from 0, the closed state, to 1, the open state. Both states have been checked. If the valve
  // has no separate open state, both arguments are the same object.
  PatchSet (*make_patches)(const ValveState &closed, const ValveState &open, double opening);
  // Refuses another state if its curves or patches are not built like the valve's. The message calls this state `name`, such as
  // "the open state". NULL if all states of the kind are built alike.
  void (*check_states)(const ValveState &valve, const ValveState &other, const char *name);
  // True if leaflets meet only where their triangles have common vertices, for example at commissures. Otherwise leaflets may
  // touch anywhere, and their triangles may penetrate each other by as much as the triangles' error.
  bool has_exact_contacts = false;
  // True if the orifice is seen along the valve's z axis. Otherwise the orifice is seen along the vector area of the edges that
  // are farthest from the orifice's middle. This vector area would be oblique in valves whose cusps differ and whose open edges
  // reach beyond the attachment.
  bool is_seen_along_z = false;
  // The leaflet_id of a wall that hinges reach into, or -1.
  std::int32_t housing = -1;
  Vector<AbsentName> absent = {};
  // True if the leaflets are stiff. A warp would bend them.
  bool is_rigid = false;
  // The line that a skirt leads away from, and the position of the parameter "skirt_length". with_skirt sets both.
  SkirtAxis skirt_axis = SkirtAxis::none;
  std::size_t skirt_length = 0;
};

// Adds the parameter "skirt_length" to a kind.
ValveKind with_skirt(ValveKind kind, SkirtAxis axis);

// The kinds of valves that are defined by parameters. Most kinds are in a file with the name of the kind. The kinds with two to
// four coapting cusps are in valve/coapting.cpp. The kinds with coapting leaflets on an annulus are in
// valve/atrioventricular.cpp.
const ValveKind &aortic_valve_kind();
const ValveKind &bicuspid_valve_kind();
const ValveKind &bileaflet_valve_kind();
const ValveKind &coapting_valve_kind();
const ValveKind &mitral_valve_kind();
const ValveKind &mitral_coapting_valve_kind();
const ValveKind &quadricuspid_valve_kind();
const ValveKind &tricuspid_valve_kind();
const ValveKind &trileaflet_valve_kind();

// Returns the kind with that name. For an unknown kind, fails with RIIS_INVALID_PARAMETER and names the existing kinds.
const ValveKind &find_valve_kind(std::string_view name);

// A valve: a kind and its values. All functions fail with RIIS_INVALID_PARAMETER and name the parameter and the value. A failure
// leaves the valve unchanged.
class Valve {
 public:
  explicit Valve(const ValveKind &kind, PatchSet patches = {});
  const ValveKind &kind() const { return *kind_; }
  const ParameterValues &values() const { return state_.values; }

  // A name without a leaflet means the valve's own parameter. If the valve has no such parameter, the name means the parameter of
  // every leaflet.
  void set(std::string_view name, std::int64_t n_values, const double *new_values);
  void get(std::string_view name, std::int64_t n_values, double *out) const;
  // Returns the least and the largest value of a parameter. The name must mean only one parameter.
  std::array<double, 2> range_of(std::string_view name) const;
  // Removes the value that the caller set. The parameter has its default again, or the value from its rule.
  void unset(std::string_view name);
  bool is_set(std::string_view name) const;

  // Uses the other valve's own state as the open state. The other valve must be of the same kind.
  void set_open_state(const Valve &open);

  // Lets a map move the valve's curves at every opening: the map `closed` at opening 0, the map `open` at opening 1, and a blend
  // of both maps at openings between 0 and 1. The maps are copied. If `open` is null, the map `closed` is used at all openings.
  // If both are null, the valve has no warp.
  void set_warp(const WarpMap *closed, const WarpMap *open);
  bool is_warped() const { return warp_.has_value(); }

  // Returns whether the opening may differ from 0.
  bool can_open() const { return open_ || kind_->opens_by_itself; }
  double opening() const { return state_.values[kind_->opening][0]; }

  // Returns the disc of a mechanical valve's housing about the z axis, or a radius of 0 for other valves.
  struct Disc {
    double radius, x, y;  // the centre is the mean translation of the valve or of its leaflets
    Vec3 axis;            // the z axis; for a warped valve, the normal of the warped plane z = 0 at the centre
  };
  Disc disc() const;

  // Returns whether make_patches adds a skirt.
  bool has_skirt() const { return kind_->skirt_axis != SkirtAxis::none && state_.values[kind_->skirt_length][0] != 0; }
  // Replaces the skirt by a skirt with these lengths (valve/skirt.hpp). The parameter "skirt_length" becomes the largest of these
  // lengths. Setting "skirt_length" later removes these lengths.
  void set_skirt_lengths(SkirtLengths lengths);

  // Compares this valve with another valve. Fails if they differ in anything except the opening and the values of a warp. The
  // message names the first parameter that differs.
  void check_same_but_for_opening(const Valve &other) const;

  // Returns whether all parameters except the opening have the kind's defaults.
  bool has_default_shape() const;
  // Returns a digest of the shape and of a warp's landmarks, but not of the opening or the landmarks' targets. The digest is
  // never 0. It is very improbable that two different shapes have the same digest.
  std::uint64_t shape_digest() const;

  // Makes the patches at the current opening.
  PatchSet make_patches() const;
  // Makes the patches of `before`, an earlier state of this valve. `before` must be of the same kind and build. `known` has the
  // patches of that state, or is null if they have not been made yet.
  PatchSet make_patches_before(const Valve &before, const PatchSet *known) const;
  // Returns a number that is different after every change of the valve. Copies have the same number. Valves with the same number
  // have the same patches, to the last bit. The number is not 0.
  std::uint64_t revision() const { return revision_; }
  // Fails if this valve cannot be a state of another valve. The other valve is of the given kind, and has a warp if `is_warped`
  // is true.
  void check_is_state_of(const ValveKind &kind, bool is_warped, const StateNames &names) const;
  // Makes the patches without a search for folds. A message of failure begins with the state's name.
  PatchSet make_patches_unsearched(const char *name) const;

 private:
  // Returns the position of a parameter. The name must mean only one parameter.
  std::size_t position_of(std::string_view name) const;
  void derive();
  PatchSet make_patches(FoldCheck check) const;
  BlendedWarp blended_warp() const;  // of a warped valve
  // Returns where the warp's landmarks lie on the curves before the warp. The landmarks of the closed map lie on the closed
  // valve, and those of the open map on the open valve. `now` has the patches at the current opening.
  std::shared_ptr<const LandmarkCuts> landmark_cuts(const PatchSet &now) const;
  void check_open_values() const;
  static std::uint64_t next_revision();

  // The cuts of a shape at its landmarks. The cuts are stored, because they do not change when the valve opens or the landmarks'
  // targets move.
  struct KnownCuts {
    std::uint64_t shape_digest;
    LandmarkCuts cuts;
  };
  struct Warp {
    WarpMap closed;
    std::optional<WarpMap> open;
    mutable std::shared_ptr<const KnownCuts> known =
        {};  // changes atomically, because several threads may read a valve at the same time
  };

  // The digest of the last shape whose values were checked, or 0. It changes atomically, because several threads may read a
  // valve.
  struct CheckedShape {
    std::atomic<std::uint64_t> digest{0};
    CheckedShape() = default;
    CheckedShape(const CheckedShape &other) : digest(other.digest.load()) {}
    CheckedShape &operator=(const CheckedShape &other) {
      digest = other.digest.load();
      return *this;
    }
  };

  const ValveKind *kind_;
  // The positions of the parameters that define the disc. Each time step needs these positions, and a search by name is slow.
  std::optional<std::size_t> radius_;
  Vector<std::size_t> translations_;
  ValveState state_;
  std::optional<ValveState> open_;
  std::optional<Warp> warp_;
  SkirtLengths skirt_lengths_;  // empty for a skirt of one length
  mutable CheckedShape checked_;
  std::uint64_t revision_ = next_revision();
};

// Blends one number. The result is exact for openings of 0 and 1.
inline double blend(double closed, double open, double opening) {
  return opening == 0 ? closed : opening == 1 ? open : (1 - opening) * closed + opening * open;
}
inline Vec3 blend(Vec3 closed, Vec3 open, double opening) {
  return {blend(closed.x, open.x, opening), blend(closed.y, open.y, opening), blend(closed.z, open.z, opening)};
}
// Blends two curves of the same degree.
Bezier blend(const Bezier &closed, const Bezier &open, double opening);
// Returns the derivatives of the blend's control points with respect to the opening.
Bezier rate(const Bezier &closed, const Bezier &open);

// Returns the spec of the opening. Every kind has this parameter.
ParameterSpec opening_spec(const char *description, double default_value);

// A size with which other values are compared. The message is, for example, "leaflet_height is 30; it must be from 0.05 to 10
// times root_radius, which is 1.29".
struct Reference {
  const char *name;
  double size;
};
void check_ratio(const ParameterSpec &spec, const std::array<double, 3> &values, const Reference &reference,
                 double least, double most);

}  // namespace riis
