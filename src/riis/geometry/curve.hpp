// SPDX-License-Identifier: Apache-2.0
// Curves of one or several Bézier pieces, parametrised by the share of their length.
// In: Bézier pieces. Out: points and parts by share of the length, and points close enough together to replace the curve.
#pragma once

#include <array>
#include <cstddef>

#include "base/recycled.hpp"
#include "geometry/bezier.hpp"

namespace riis {

// A share of a curve's length that is negligible.
inline constexpr double negligible_share = 1e-14;

// A point of a curve: the position of its piece, and the parameter there.
struct PointOnPiece {
  std::size_t piece;
  double t;
};

// Every piece but the first begins at the end of the piece before, in the direction of that end. So the curve may change its
// curvature there, but not its course. (A curve with corners is several curves, and its patch several patches.)
class Curve {
 public:
  Curve(const Bezier &piece);  // NOLINT(google-explicit-constructor): a piece is a curve
  explicit Curve(Vector<Bezier> pieces);

  const Vector<Bezier> &pieces() const { return pieces_; }
  double length() const { return ends_.back(); }
  double length(std::size_t piece) const { return piece == 0 ? ends_[0] : ends_[piece] - ends_[piece - 1]; }
  Vec3 first() const { return pieces_.front().first(); }
  Vec3 last() const { return pieces_.back().last(); }

  // Returns the shares of the length at which one piece ends and the next begins, ascending.
  Vector<double> joints() const;

  // The point at a share of the length, and the unit vector along the curve there. The vector is 0 if the curve has no
  // direction.
  struct Frame {
    Vec3 point, tangent;
  };
  Frame frame(double share) const;
  Vec3 at(double share) const;

  // Returns the part of one piece that begins at this share of the length (after), or ends there. Its other end is that of the
  // piece.
  Bezier piece_beside(double share, bool after) const;

  // Returns the part from one share to another, share0 < share1.
  Curve between(double share0, double share1) const;

  Curve reversed() const;

  // Returns the same curve with its ends moved, by no more than rounding, to the ends of other curves.
  Curve through(Vec3 first, Vec3 last) const;

 private:
  PointOnPiece on_piece(double share) const;

  Vector<Bezier> pieces_;
  Vector<double> ends_;  // length from the start of the curve to the end of each piece
};

// Returns whether both have the same control points, to the last bit.
bool are_equal(const Curve &a, const Curve &b);

// Estimates how far the velocity of a curve's points is from linear along it. A point keeps its share of the length.
class VelocityBend {
 public:
  // The control points of `velocity` are the velocities of the curve's control points.
  VelocityBend(const Bezier &curve, double curve_length, const Bezier &velocity);

  // Estimates the largest distance of the velocity from its linear interpolation between shares u0 and u1.
  double off_linear(double u0, double u1) const;

 private:
  // The bend at a share in a cell.
  double at(double u, std::size_t cell) const;

  static constexpr std::size_t n_cells = 8;
  std::array<double, n_cells + 1> u_;     // shares of the length at the ends of the cells
  std::array<double, n_cells + 1> bend_;  // the velocity's second derivative by the share
};

// A curve replaced by chords.
struct Flattened {
  Vector<Vec3> points;    // on the curve, from its first to its last; only the first if the length is 0
  Vector<double> t;       // of every point: share of the curve's length, binary fractions from 0 to 1
  Vector<double> errors;  // of every chord: how far it may be from the curve, at equal shares of their own lengths
};

// Halves the curve until two conditions hold for every part. Its flatness keeps it within max_error (> 0) of its chord,
// and it is at most max_error from the chord at equal shares of their lengths. A Bézier piece lies within 3/4 (cubic)
// or 1/2 (quadratic) of its flatness from its chord. Parts are halved by length; the paper (algorithm "Recursive de
// Casteljau subdivision") halves the parameter. So shares of two curves either agree to the last bit or differ by at
// least a part, and patches have no slivers between them. A shared middle point appears once. Fails with
// RIIS_LIMIT_EXCEEDED for more than 2^20 parts. A bend also halves parts whose velocity it estimates to be off linear by more
// than max_bend.
Flattened flatten(const Curve &curve, double max_error, const VelocityBend *bend = nullptr, double max_bend = 0);

}  // namespace riis
