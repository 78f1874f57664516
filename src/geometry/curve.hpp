// SPDX-License-Identifier: Apache-2.0
// Curves of one Bézier piece or several, parametrised by the share of their length.
// In: Bézier pieces. Out: points and parts by share of the length, and points close enough together to replace the curve.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/bezier.hpp"

namespace riis {

// Every piece but the first begins where the one before ends, in the direction in which that one ends: the curve may change
// its curvature there, not its course. (Curves with corners are several curves, and their patches several patches.)
class Curve {
 public:
  Curve(const Bezier &piece);  // NOLINT(google-explicit-constructor): a piece is a curve
  explicit Curve(std::vector<Bezier> pieces);

  const std::vector<Bezier> &pieces() const { return pieces_; }
  double length() const { return ends_.back(); }
  double length(std::size_t piece) const { return piece == 0 ? ends_[0] : ends_[piece] - ends_[piece - 1]; }
  Vec3 first() const { return pieces_.front().first(); }
  Vec3 last() const { return pieces_.back().last(); }

  // Shares of the length at which one piece ends and the next begins, ascending.
  std::vector<double> joints() const;

  // The point at a share of the length, and the unit vector along the curve there; 0 where the curve has no direction.
  struct Frame {
    Vec3 point, tangent;
  };
  Frame frame(double share) const;
  Vec3 at(double share) const;

  // A part of a single piece that begins at the share of the length, or ends there.
  Bezier piece_beside(double share, bool after) const;

  // The part from one share to another, share0 < share1.
  Curve between(double share0, double share1) const;

  Curve reversed() const;

  // The same curve with its ends moved, by no more than rounding, to where other curves end.
  Curve through(Vec3 first, Vec3 last) const;

 private:
  struct Place {
    std::size_t piece;
    double t;
  };
  Place place(double share) const;

  std::vector<Bezier> pieces_;
  std::vector<double> ends_;  // length from the start of the curve to the end of each piece
};

// A curve replaced by chords.
struct Flattened {
  std::vector<Vec3> points;    // on the curve, from its first to its last; the first alone where the length is 0
  std::vector<double> t;       // of every point: share of the curve's length, binary fractions from 0 to 1
  std::vector<double> errors;  // of every chord: how far it may be from the curve, at equal shares of their own lengths
};

// Halves the curve until every part has a flatness that keeps it within max_error (> 0) of its chord, and is at most max_error
// from it at equal shares of their lengths. A Bézier piece lies within 3/4 (cubic) or 1/2 (quadratic) of its flatness
// from its chord. Parts are halved by length, where the paper (algorithm "Recursive de Casteljau subdivision") halves the
// parameter: shares of two curves then either agree to the last bit or differ by at least a part, so patches have no
// slivers between them. A shared middle point appears once. Fails with RIIS_LIMIT_EXCEEDED for more than 2^20 parts.
Flattened flatten(const Curve &curve, double max_error);

}  // namespace riis
