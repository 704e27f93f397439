// SPDX-License-Identifier: GPL-3.0-or-later
// Impacts of bushes on profiles.
//
// The references are those of F = C depth^1.5, the limit of small contacts. The contact on the real
// curves differs from it by the order of depth over radius of the circles. A stiffer mattress has
// smaller contacts: with kappa times 10^10 force and time scale by 10^4, and what differs falls by
// 10^4.
#include <gtest/gtest.h>

#include "tests/dynamics/profile/profile_cases.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector3d;
using namespace testing;

struct Impact {
  double force = 0.0, duration = 0.0;  // largest [N], [s]
  Vector3d rate;                       // after it
};

/// A free body with the outline of the contact from `q` with the rate `v`, until it has separated:
/// the classical method of Runge and Kutta with steps of `step`, the end by linear interpolation of
/// the distance of its circle.
Impact impact(const MattressContact& contact, double mass, double inertia, Vector3d q, Vector3d v,
              double step) {
  const Vector3d mobility(1.0 / mass, 1.0 / mass, 1.0 / inertia);
  const auto acceleration = [&](const Vector3d& at, const Vector3d& rate) -> Vector3d {
    return mobility.cwiseProduct(force_at(contact, at, rate).wrench);
  };
  const auto gap = [&](const Vector3d& at) {
    const LinkOutline& circle = contact.outline();
    const Eigen::Vector2d axis(std::cos(at.z()), std::sin(at.z()));
    return contact.profile().closest(at.head<2>() + circle.from * axis).distance - circle.radius;
  };
  Impact result;
  for (int i = 0; i < 1000000; ++i) {
    const double before = gap(q);
    result.force = std::max(result.force, force_at(contact, q, v).wrench.head<2>().norm());
    const Vector3d a1 = acceleration(q, v), v2 = v + 0.5 * step * a1;
    const Vector3d a2 = acceleration(q + 0.5 * step * v, v2), v3 = v + 0.5 * step * a2;
    const Vector3d a3 = acceleration(q + 0.5 * step * v2, v3), v4 = v + step * a3;
    const Vector3d a4 = acceleration(q + step * v3, v4);
    q += step / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
    v += step / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    result.duration = step * (i + 1);
    if (const double after = gap(q); after > 0.0) {
      result.duration -= step * after / (after - before);
      break;
    }
  }
  result.rate = v;
  return result;
}

/// Where a bush at the link's origin lands, and the reference.
struct ImpactOracle {
  const char* name;
  std::vector<Segment> segments;
  double arc_length;
  double radius_mm, force, time_us;
  double real;  // difference allowed at the real stiffness, of the order of its contact's size
};

std::vector<ImpactOracle> impact_oracles() {
  ToothGap gap = iso606_gap(kPitch, kBush, 20);
  gap.seat_radius = 2.58399e-3;  // rounded as in the reference: 1e-6 of it is 3e-5 of the clearance
  const std::vector<Segment> tooth = tooth_gap_segments(gap);
  const Profile profile = sprocket(gap);
  const auto middle = [&](size_t cell) {
    return profile.cells()[cell].start + 0.5 * profile.cells()[cell].length;
  };
  const std::vector<Segment> line{LineSegment{{0.02, 0.0}, {-0.02, 0.0}}};
  return {{"flat", line, 0.02, 2.5, 68.6790, 58.9263, 2e-3},
          {"seat", tooth, middle(2), 76.9136, 136.282, 29.6959, 3e-2},
          {"flank", tooth, middle(3), 2.198068, 66.9336, 60.4629, 2e-3}};
}

class WinklerImpact : public ::testing::TestWithParam<ImpactOracle> {};
INSTANTIATE_TEST_SUITE_P(Oracles, WinklerImpact, ::testing::ValuesIn(impact_oracles()),
                         [](const auto& info) { return std::string(info.param.name); });

constexpr double kLinkMass = 2.2e-3, kLinkInertia = 4e-8, kSpeed = 0.5;

Profile profile_of(const ImpactOracle& oracle) {
  return Profile(oracle.segments, {.largest_kink = 0.5 * kPi});
}

/// With a mattress that is stiffer by `factor`; forces and times scaled back.
Impact landing(const ImpactOracle& oracle, MattressLaw law, double factor, double speed = kSpeed) {
  law.stiffness *= factor;
  const Profile profile = profile_of(oracle);
  const LinkOutline bush = LinkOutline::circle(0.0, 2.5e-3);
  const MattressContact contact(profile, bush, law);
  const ProfilePoint at = profile.at(oracle.arc_length);
  const Eigen::Vector2d start = at.position + bush.radius * at.normal, v = -speed * at.normal;
  const double stiffness = small_depth_stiffness(law, bush.radius, at.curvature);
  const double depth = std::pow(1.25 * kLinkMass * speed * speed / stiffness, 0.4);
  Impact found = impact(contact, kLinkMass, kLinkInertia, {start.x(), start.y(), 0.0},
                        {v.x(), v.y(), 0.0}, 2.943275 * depth / speed / 2000.0);
  found.force /= std::pow(factor, 0.4);
  found.duration *= std::pow(factor, 0.4);
  return found;
}

TEST_P(WinklerImpact, OracleOfTheRelativeRadius) {
  const ImpactOracle& oracle = GetParam();
  const double curvature = profile_of(oracle).at(oracle.arc_length).curvature;
  const double digit = 1e-6 * oracle.radius_mm;  // the reference has 6 digits and more
  EXPECT_NEAR(1e3 / (1.0 / 2.5e-3 + curvature), oracle.radius_mm, digit);
}

TEST_P(WinklerImpact, OracleInTheLimitOfSmallContacts) {
  const ImpactOracle& oracle = GetParam();
  const Impact found = landing(oracle, elastic(bush_law()), 1e10);
  // Half of the reference's last digit and, of the seat, 3e-2/1e4 of what the limit leaves.
  const double rest = 1e-4 * oracle.real;
  EXPECT_NEAR(found.force, oracle.force, (0.5e-5 + rest) * oracle.force);
  EXPECT_NEAR(found.duration * 1e6, oracle.time_us, 0.5e-4 + rest * oracle.time_us);
  // Forces are exact to the rounding of depths of 1 nm, 1e-18 m.
  EXPECT_NEAR(found.rate.head<2>().norm(), kSpeed, 1e-7);
}

TEST_P(WinklerImpact, OracleIsMissedAtTheRealStiffnessInProportionToTheDepth) {
  const ImpactOracle& oracle = GetParam();
  const Impact soft = landing(oracle, elastic(bush_law()), 1.0);
  EXPECT_NEAR(soft.force, oracle.force, oracle.real * oracle.force);
  EXPECT_NEAR(soft.duration * 1e6, oracle.time_us, oracle.real * oracle.time_us);
  const Impact limit = landing(oracle, elastic(bush_law()), 1e10);
  const Impact stiff = landing(oracle, elastic(bush_law()), 32.0);  // a quarter of the depth
  EXPECT_NEAR((soft.force - limit.force) / (stiff.force - limit.force), 4.0, 0.3);
  EXPECT_NEAR((soft.duration - limit.duration) / (stiff.duration - limit.duration), 4.0, 0.3);
}

TEST(WinklerStiffness, OracleOfABushOnAFlat) {
  EXPECT_NEAR(small_depth_stiffness(bush_law(), 2.5e-3, 0.0), 2.168461e9, 0.5e3);
  const Profile profile = flat();
  const MattressContact contact(profile, LinkOutline::circle(0.0, 2.5e-3), elastic(bush_law()));
  const double depth = 1e-9;
  const double force = force_at(contact, {0.0, 2.5e-3 - depth, 0.0}).wrench.y();
  EXPECT_NEAR(force / std::pow(depth, 1.5), 2.168461e9, 0.5e3 + 2.168461e9 * depth / 2.5e-3);
  const double peak = std::pow(1.25 * kLinkMass * kSpeed * kSpeed / 2.168461e9, 0.4);
  EXPECT_NEAR(1e6 * peak, 10.0103, 0.5e-4);
}

TEST(WinklerRestitution, OracleOfDampedImpacts) {
  const double speeds[] = {0.5, 1.0, 2.0}, restitution[] = {0.856851, 0.748435, 0.593624};
  MattressLaw law = bush_law();
  law.friction = 0.0;
  for (size_t i = 0; i < 3; ++i) {
    const Impact found = landing(impact_oracles()[0], law, 1e10, speeds[i]);
    EXPECT_NEAR(found.rate.head<2>().norm() / speeds[i], restitution[i], 0.6e-6);
  }
}

TEST(WinklerImpact, OracleOfALinkThatFallsFlatOnOneBush) {
  EXPECT_NEAR(1.0 / (1.0 / kLinkMass + 4e-3 * 4e-3 / kLinkInertia), 1.170213e-3, 0.5e-9);
  MattressLaw law = elastic(bush_law());
  law.stiffness *= 1e10;
  const Profile profile = flat();
  const MattressContact contact(profile, LinkOutline::circle(4e-3, 2.5e-3), law);
  const Impact found = impact(contact, kLinkMass, kLinkInertia, {0.0, 2.5e-3, 0.0},
                              {0.0, -kSpeed, 0.0}, 46e-6 * 1e-4 / 2000.0);
  EXPECT_NEAR(found.force * 1e-4, 47.0251, 0.6e-4);
  EXPECT_NEAR(found.duration * 1e10, 45.7769, 0.6e-4);
  EXPECT_NEAR(found.rate.z(), 117.021, 0.6e-3);
}

}  // namespace
}  // namespace clatter::dynamics
