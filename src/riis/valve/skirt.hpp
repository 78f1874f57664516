// SPDX-License-Identifier: Apache-2.0
// The skirt of a valve: a strip that leads outwards from the attachment to the wall (docs/theory/skirt.md). The patches of the
// skirt are added to the patches of the valve.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/recycled.hpp"
#include "valve/patches.hpp"
#include "valve/warp.hpp"

namespace riis {

// The line from which a skirt leads away. The skirt leads away at a right angle to this line.
enum class SkirtAxis : std::uint8_t {
  none,      // the kind of valve has no skirt
  of_cusp,   // the root's axis, which is the z axis before a patch's image is placed
  vertical,  // the line along z through the centroid of the attachment
  boundary   // the line through the centroid of the attachment, along its vector area
};

// Gives every attached patch its axis.
void aim_skirt(PatchSet &set, SkirtAxis axis);
// Gives every attached patch of a warped valve its axis. The map takes the axis of the patch at rest to this axis. `at_rest` has
// the patches before the warp, with their axes. The identity map does not change the axes. A map without scale moves the axes as
// a placement does.
void aim_warped_skirt(PatchSet &set, const PatchSet &at_rest, const BlendedWarp &warp);

// A side at which a patch is attached, and which no other patch has.
struct HeldSide {
  std::size_t patch;
  Side side;
};
// Returns the held sides that have a length, in the order of the patches. The patches must have no skirt yet.
Vector<HeldSide> held_sides(const PatchSet &set);

// The lengths of a skirt whose length is not the same everywhere. There is one list for each image of a held side, in the order
// of held_sides. A list has the lengths of the skirt at evenly spaced shares of the side's length.
using SkirtLengths = Vector<Vector<double>>;
inline constexpr std::size_t n_skirt_parts = 32;  // parts of each side with such lengths

// Returns the attached ends of different leaflets that are neighbours but not joined, such as two aortic cusps at a commissure.
// Patches are numbered as after a warp, where each image is a patch of its own. If `wants_turns` is true, the function also
// stores the turns of the skirt at these ends before the warp. The patches must already have their axes.
Vector<NeighbourEnds> neighbour_ends(const PatchSet &set, bool wants_turns);

// An end of a side, and the unit tangent there. The tangent may point either way along the side.
struct SideEnd {
  Vec3 point, tangent;
};

// Returns the direction in which the skirts at two neighbouring ends lead. The skirts end in two parallel planes, and do not
// cross them. The planes have the mean inclination of the two sides. The direction depends continuously on the points and the
// tangents.
Vec3 direction_between(const AxisLine &axis, const SideEnd &before, const SideEnd &after);

// The direction in which a skirt leads away from its attachment. A skirt leads outwards from the axis, except near two ends that
// are neighbours but not joined.
class SkirtDirections {
 public:
  SkirtDirections(const PatchSet &set, const Vector<HeldSide> &sides);

  // Returns the unit vector at a share of the length of a side. `point` is the side's point at this share.
  Vec3 at(std::size_t side, double share, Vec3 point) const;
  bool is_turned(std::size_t side) const { return ends_[side][0].is_turned || ends_[side][1].is_turned; }

 private:
  struct End {
    bool is_turned;
    Vec3 direction;               // the direction to which the skirt is turned
    std::optional<double> angle;  // in place of the direction, the angle by which the skirt is turned about the axis
  };
  Vector<AxisLine> axes_;
  Vector<std::array<End, 2>> ends_;  // for each side: its first and its last end
};

// Returns the mean distance of the attachment from its axis. Fails with RIIS_INVALID_PARAMETER if a side has no outward
// direction.
double attachment_radius(const PatchSet &set, const Vector<HeldSide> &sides);
// The least and the largest length of a skirt, as multiples of attachment_radius.
inline constexpr double least_skirt = 1e-4, most_skirt = 10;
// The least length of a skirt to a wall, as a multiple of attachment_radius. The vertices of the outer edge are evenly spaced
// along its length, so they are not exactly beside the attachment's vertices. With a smaller length, the strip along a round
// attachment would go through itself.
inline constexpr double least_skirt_to_wall = 0.01;

// Returns the unit vector from the axis through the point, perpendicular to the axis. The vector is 0 if the point is on the
// axis.
Vec3 outwards(const AxisLine &axis, Vec3 point);

// Adds the patches of a skirt. If `lengths` is empty, the length is `length` everywhere. The patches continue the leaflets
// outwards. The patches of a skirt have the leaflet_id skirt_leaflet. The patch_id of such a patch is the patch_id of the
// leaflet's patch beside it, plus the number of the leaflets' patch ids. Fails with RIIS_INVALID_PARAMETER for an attachment
// without an outward direction, and for a length that does not fit the attachment.
void add_skirt(PatchSet &set, double length, const SkirtLengths &lengths);

// Returns the leaflet_id that a skirt of these patches has.
std::int32_t skirt_leaflet(const PatchSet &set);

}  // namespace riis
