// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Tooth gaps of chain sprockets by ISO 606.
#include <vector>

#include "dynamics/profile/profile.hpp"
#include "dynamics/profile/segment.hpp"

namespace clatter::dynamics {

/// Where between its limits of ISO 606 a gap is.
enum class GapForm { kMinimum, kMean, kMaximum };

/// Measures of a tooth gap: the seat, a concave arc about the pitch point; at its ends, tangent,
/// the flanks, convex arcs; up to the tip diameter, whose arc is the tip. Lengths [m].
struct ToothGap {
  int teeth;
  double pitch_diameter;   // d_p, of the bushes' centres
  double seat_radius;      // r_i
  double flank_radius;     // r_e
  double seat_half_angle;  // alpha / 2 [rad]
  double tip_diameter;     // d_a

  double pitch_angle() const;  // 2 pi/z [rad]
};

/// Measures by ISO 606, lengths in mm inside the cube root:
///   d_p = p/sin(pi/z),
///   r_i  = 0.505 d1                ..  0.505 d1 + 0.069 d1^(1/3),
///   r_e  = 0.12 d1 (z + 2)         ..  0.008 d1 (z^2 + 180),
///   alpha = 140 deg - 90 deg/z     ..  120 deg - 90 deg/z,
///   d_a  = d_p + p (1 - 1.6/z) - d1  ..  d_p + 1.25 p - d1
/// for the minimum .. maximum form; mean: half way. d_a is chosen by itself.
/// @param pitch p of the chain [m]. @param roller diameter d1 of rollers or bushes [m].
/// InputError for a pitch or diameter that is not positive, a roller as long as the pitch, and
/// fewer than 5 teeth.
ToothGap iso606_gap(double pitch, double roller, int teeth, GapForm form = GapForm::kMean,
                    GapForm tip = GapForm::kMean);

/// Seat, flanks and halves of the tips, counter-clockwise about the sprocket's axis; the pitch
/// point is on the x axis. InputError when the flanks meet below the tip diameter (the message says
/// at which), do not reach it, or the seat is not inside the gap.
std::vector<Segment> tooth_gap_segments(const ToothGap& gap);

/// The sprocket with this gap. The tips have corners.
Profile sprocket(const ToothGap& gap);
/// A sprocket with a given tooth gap from border to border, 2 pi/z apart, counter-clockwise.
/// `largest_kink` as in ProfileOptions.
Profile sprocket(const std::vector<Segment>& gap, int teeth, double largest_kink = 1e-3);

}  // namespace clatter::dynamics
