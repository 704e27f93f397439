// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/profile/tooth_gap.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

double between(double minimum, double maximum, GapForm form) {
  const double share = form == GapForm::kMinimum ? 0.0 : form == GapForm::kMean ? 0.5 : 1.0;
  return minimum + share * (maximum - minimum);
}

/// What the gap is made of on the side of positive y.
struct Flank {
  Vector2d pitch_point, centre, tip;
  double seat_end, from, turn;  // polar angles [rad]
};

/// The point of the flank's circle at the tip diameter, clockwise of the circle's centre; not
/// finite where there is none.
Vector2d at_tip(const ToothGap& gap, const Vector2d& centre) {
  const double c = centre.norm(), distance = 0.5 * gap.tip_diameter;
  const double along =
      (c * c + distance * distance - gap.flank_radius * gap.flank_radius) / (2.0 * c);
  const double across = std::sqrt(distance * distance - along * along);
  const Vector2d axis = centre / c;
  return along * axis + across * Vector2d(axis.y(), -axis.x());
}

void check(const ToothGap& gap, const Flank& flank) {
  if (!flank.tip.allFinite() || !(flank.turn > 0.0))
    throw InputError(
        fmt::format("tooth gap: flanks of radius {:g} mm do not reach the tip diameter "
                    "of {:g} mm",
                    1e3 * gap.flank_radius, 1e3 * gap.tip_diameter));
  const double border = 0.5 * gap.pitch_angle();
  if (std::atan2(flank.tip.y(), flank.tip.x()) < border) return;
  const Vector2d out(std::cos(border), std::sin(border));
  const double middle = flank.centre.dot(out);
  const double height = flank.centre.x() * out.y() - flank.centre.y() * out.x();
  const double pointed = middle + std::sqrt(gap.flank_radius * gap.flank_radius - height * height);
  throw InputError(
      fmt::format("tooth gap: teeth are pointed at a diameter of {:g} mm, expected a tip "
                  "diameter below that, found {:g} mm",
                  2e3 * pointed, 1e3 * gap.tip_diameter));
}

Flank flank_of(const ToothGap& gap) {
  Flank flank;
  flank.pitch_point = {0.5 * gap.pitch_diameter, 0.0};
  flank.seat_end = kPi - gap.seat_half_angle;
  const Vector2d direction(std::cos(flank.seat_end), std::sin(flank.seat_end));
  flank.centre = flank.pitch_point + (gap.seat_radius + gap.flank_radius) * direction;
  flank.tip = at_tip(gap, flank.centre);
  // Seen from the flank's centre the seat ends at -alpha/2, and the tip is counter-clockwise of it.
  flank.from = -gap.seat_half_angle;
  const Vector2d to_tip = flank.tip - flank.centre;
  flank.turn = std::atan2(to_tip.y(), to_tip.x()) - flank.from;
  return flank;
}

}  // namespace

double ToothGap::pitch_angle() const { return 2.0 * kPi / teeth; }

ToothGap iso606_gap(double pitch, double roller, int teeth, GapForm form, GapForm tip) {
  if (!(pitch > 0.0) || !(roller > 0.0) || !(roller < pitch) || teeth < 5)
    throw InputError(
        fmt::format("tooth gap: pitch {:g} mm, rollers of {:g} mm, {} teeth; expected 0 < "
                    "roller < pitch and at least 5 teeth",
                    1e3 * pitch, 1e3 * roller, teeth));
  const double z = teeth, roller_mm = 1e3 * roller;
  ToothGap gap;
  gap.teeth = teeth;
  gap.pitch_diameter = pitch / std::sin(kPi / z);
  gap.seat_radius = between(0.505 * roller, 0.505 * roller + 0.069e-3 * std::cbrt(roller_mm), form);
  gap.flank_radius = between(0.12 * roller * (z + 2.0), 0.008 * roller * (z * z + 180.0), form);
  gap.seat_half_angle = 0.5 * kPi / 180.0 * between(140.0 - 90.0 / z, 120.0 - 90.0 / z, form);
  gap.tip_diameter =
      gap.pitch_diameter - roller + between(pitch * (1.0 - 1.6 / z), 1.25 * pitch, tip);
  return gap;
}

std::vector<Segment> tooth_gap_segments(const ToothGap& gap) {
  if (!(gap.seat_half_angle > 0.0) || !(gap.seat_half_angle < 0.5 * kPi) ||
      !(gap.seat_radius > 0.0) || !(gap.flank_radius > 0.0) ||
      !(2.0 * gap.seat_radius < gap.pitch_diameter))
    throw InputError(
        fmt::format("tooth gap: seat of radius {:g} mm over 2 x {:g} deg in a pitch "
                    "diameter of {:g} mm, flanks of {:g} mm; expected positive measures, "
                    "half angles below 90 deg, and a seat inside the pitch circle",
                    1e3 * gap.seat_radius, gap.seat_half_angle * 180.0 / kPi,
                    1e3 * gap.pitch_diameter, 1e3 * gap.flank_radius));
  const Flank flank = flank_of(gap);
  check(gap, flank);
  const double border = 0.5 * gap.pitch_angle(), r = gap.flank_radius;
  const double tip = std::atan2(flank.tip.y(), flank.tip.x()), tip_radius = 0.5 * gap.tip_diameter;
  const Vector2d below(flank.centre.x(), -flank.centre.y()), axis(0.0, 0.0);
  return {
      ArcSegment{axis, tip_radius, -border, border - tip},
      ArcSegment{below, r, -(flank.from + flank.turn), flank.turn},
      ArcSegment{flank.pitch_point, gap.seat_radius, -flank.seat_end, -2.0 * gap.seat_half_angle},
      ArcSegment{flank.centre, r, flank.from, flank.turn},
      ArcSegment{axis, tip_radius, tip, border - tip}};
}

Profile sprocket(const ToothGap& gap) {
  return sprocket(tooth_gap_segments(gap), gap.teeth, 0.5 * kPi);
}

Profile sprocket(const std::vector<Segment>& gap, int teeth, double largest_kink) {
  ProfileOptions options;
  options.repeats = teeth;
  options.largest_kink = largest_kink;
  return Profile(gap, options);
}

}  // namespace clatter::dynamics
