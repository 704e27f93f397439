// SPDX-License-Identifier: GPL-3.0-or-later
// How the mattress converges with the number of its sections.
#include <gtest/gtest.h>

#include "tests/dynamics/profile/profile_cases.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector3d;
using namespace testing;

/// A bush in the seat, 20 um deep: circles with centres e apart, penetration
/// r - sqrt(R^2 + e^2 - 2 R e cos(psi)), by the trapezoidal rule on 2e6 points.
double slow_seat_force(const ToothGap& gap, const MattressLaw& law, double e) {
  const double R = gap.seat_radius, r = 2.5e-3;
  constexpr int kPoints = 2000000;
  double sum = 0.0;
  for (int i = 1; i < kPoints; ++i) {
    const double psi = gap.seat_half_angle * (2.0 * i / kPoints - 1.0);
    const double distance = std::sqrt(R * R + e * e - 2.0 * R * e * std::cos(psi));
    if (distance < r) sum += (r - distance) * (R * std::cos(psi) - e) / distance;
  }
  return law.stiffness * law.width * sum * R * 2.0 * gap.seat_half_angle / kPoints;
}

TEST(Sections, ConvergeToTheIntegralGeometrically) {
  const ToothGap gap = iso606_gap(kPitch, kBush, 20);
  const Profile profile = sprocket(gap);
  MattressLaw law = elastic(bush_law());
  const double e = gap.seat_radius - 2.5e-3 + 2e-5;
  const double expected = slow_seat_force(gap, law, e);
  double before = 1.0;
  for (int n = 2; n <= 7; ++n) {
    law.sections = n;
    const MattressContact contact(profile, LinkOutline::circle(0.0, 2.5e-3), law);
    const double force = force_at(contact, {0.5 * gap.pitch_diameter - e, 0.0, 0.0}).wrench.x();
    const double error = std::abs(force / expected - 1.0);
    EXPECT_LT(error, 0.15 * before) << n;
    before = error;
  }
  EXPECT_LT(before, 1e-7);
}

TEST(Sections, AreOfTheOrderOfGaussOnASmallContact) {
  // The zone's half angle a falls as the root of the depth; n sections are wrong by a^(2 n - 2),
  // because those of degree 2 n - 1 are exact and the parabola is what all contacts share.
  const Profile profile({ArcSegment{{0.0, 0.0}, 5e-3, 0.0, kPi}});
  MattressLaw law = elastic(bush_law());
  MattressLaw fine = law;
  fine.sections = 8;
  for (const int n : {2, 3}) {
    law.sections = n;
    const MattressContact contact(profile, LinkOutline::circle(0.0, 2.5e-3), law);
    const MattressContact reference(profile, LinkOutline::circle(0.0, 2.5e-3), fine);
    double before = 0.0;
    for (const double depth : {400e-6, 100e-6, 25e-6}) {
      const Vector3d q(0.0, 7.5e-3 - depth, 0.0);
      const double error =
          std::abs(force_at(contact, q).wrench.y() / force_at(reference, q).wrench.y() - 1.0);
      if (before > 0.0) {
        EXPECT_NEAR(std::log2(before / error), 2.0 * n - 2.0, 0.35) << n;
      }
      before = error;
    }
  }
}

}  // namespace
}  // namespace clatter::dynamics
