// SPDX-License-Identifier: GPL-3.0-or-later
// Chains in closed form (reference/timing-drive.md, parts): spans, hanging chains, polygons, wraps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/units.hpp"
#include "dynamics/chain/profile_contact.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/profile/tooth_gap.hpp"
#include "tests/dynamics/chain/open_chain.hpp"
#include "tests/dynamics/chain/small_motion.hpp"
#include "tests/dynamics/mechanisms.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::OpenChain;

using std::numbers::pi;
constexpr double kLinkPitch = 8e-3;

std::unique_ptr<Port> ground(const Vector2d& at) {
  return std::make_unique<GroundPort>(Vector3d(at.x(), at.y(), 0.0));
}

/// Pins on a straight line.
std::vector<Vector2d> line(const Vector2d& from, const Vector2d& step, int links) {
  std::vector<Vector2d> pins;
  for (int j = 0; j <= links; ++j) pins.push_back(from + j * step);
  return pins;
}

void add_weight(OpenChain& chain) {
  for (int j = 0; j < chain.links(); ++j) chain.pull(j, {0.0, -9.81 * chain.make.mass(j).mass});
}

TEST(ChainOracle, SpanFrequencies) {
  // 15 links over 120 mm under 200 N. Joints of 1e11 N/m open by 2e-9 m, 2.5e-7 of a pitch.
  const double tension = 200.0, k = 1e11, gap = tension / k;
  OpenChain chain(line({0.0, 0.0}, {kLinkPitch, 0.0}, 15), kLinkPitch, k);
  VectorXd y = chain.system.interface(chain.system.eta_start());
  for (int j = 0; j < 15; ++j) y(3 * j) += (j + 1) * gap;
  chain.pin("rear", chain.rear_end(), ground({0.0, 0.0}));
  chain.pin("front", chain.front_end(), ground({15 * kLinkPitch + 16 * gap, 0.0}));
  const testing::SmallMotion motion = testing::small_motion(chain.system, y);
  const double expected[] = {107.3009, 212.9261, 315.2781};
  // Half of the strain of the joints, and the last digit given.
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(motion.hertz(i), expected[i], 1e-4) << i;
  // The continuum, 15 equal pieces: sqrt(T / m) / 2 L.
  EXPECT_NEAR(std::sqrt(tension / 0.3) / 0.24, 107.58287, 1e-5);
}

TEST(ChainOracle, HangingChainFrequencies) {
  // Joints of 1e8 N/m under 0.47 N: 6e-7 of a pitch.
  OpenChain chain(line({0.0, 0.0}, {0.0, -kLinkPitch}, 20), kLinkPitch, 1e8);
  chain.pin("hook", chain.rear_end(), ground({0.0, 0.0}));
  add_weight(chain);
  const VectorXd y = chain.rest(2e-8);
  const testing::SmallMotion motion = testing::small_motion(chain.system, y);
  const double expected[] = {1.497094, 3.396957, 5.126632};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(motion.hertz(i), expected[i], 3e-6) << i;
  double weight = 19.0 * 2.4e-3 * 9.81;
  for (int j = 0; j < 19; ++j, weight -= 2.4e-3 * 9.81)
    EXPECT_NEAR(chain.tension(j), weight, 20 * 2e-8) << j;
}

TEST(ChainOracle, ChainBetweenPins120mmApart) {
  // The chain begins on an arc of its length over the chord of 120 mm.
  constexpr int kLinks = 20;
  double half = 1.0;  // angle: chord / length = sin(half) / half, of the polygon's pins
  for (int i = 0; i < 100; ++i)
    half -= (std::sin(half) / half - 0.75) / ((std::cos(half) - std::sin(half) / half) / half);
  const double radius = 0.06 / std::sin(half);
  std::vector<Vector2d> pins;
  for (int j = 0; j <= kLinks; ++j) {
    const double angle = half * (2.0 * j / kLinks - 1.0);
    pins.push_back({0.06 + radius * std::sin(angle), -radius * (std::cos(angle) - std::cos(half))});
  }
  OpenChain chain(pins, kLinkPitch, 1e8);
  const int rear = chain.pin("rear", chain.rear_end(), ground({0.0, 0.0}));
  chain.pin("front", chain.front_end(), ground({0.12, 0.0}));
  add_weight(chain);
  const VectorXd y = chain.rest(5e-9);  // N of each of 20 links
  const VectorXd& held = chain.system.response(rear).force;
  EXPECT_NEAR(-held(0), 0.1306028, 1e-7);
  // 20 links: the lowest pin is between links 10 and 11. Ten joints open by up to 2.3e-9 m.
  const double sag = -(y(3 * 9 + 1) + 0.5 * kLinkPitch * std::sin(y(3 * 9 + 2)));
  EXPECT_NEAR(sag, 47.16017e-3, 3e-8);
  EXPECT_NEAR(-y(2) / kDegree, 59.7188, 1e-4);
}

TEST(ChainOracle, PolygonOfADrivenSprocket) {
  // A pin of a sprocket of 20 at 3400 rpm while it carries the straight span: one pitch of teeth
  // about the place where the span is parallel to its chord.
  const int teeth = 20;
  const double speed = 3400.0 * pi / 30.0, pitch = 2.0 * pi / teeth;
  const ToothGap gap = iso606_gap(kLinkPitch, 5e-3, teeth);
  DrivenPort pin(Drive(-speed, 0.5 * pi + 0.5 * pitch), Vector3d::Zero(),
                 {0.5 * gap.pitch_diameter, 0.0, 0.0}, Vector3d::UnitZ());
  PortState at;
  const auto move = [&](double share) {
    pin.motion(share * pitch / speed, VectorXd(), VectorXd(), at);
  };
  move(0.0);
  const Vector3d begin = at.position, slow = at.velocity;
  move(1.0);
  const Vector3d end = at.position;
  move(0.5);
  EXPECT_NEAR((at.position.y() - begin.y()) / at.position.y(), 0.0123117, 5e-8);
  EXPECT_NEAR(at.position.y() - begin.y(), 0.314807e-3, 5e-10);
  EXPECT_NEAR(slow.x(), 8.991973, 5e-7);
  EXPECT_NEAR(at.velocity.x(), 9.104059, 5e-7);
  EXPECT_NEAR((end.x() - begin.x()) * speed / pitch, 9.066667, 5e-7);
  // Differences over 1e-4 of a pitch of a sine: 1e-8 and rounding.
  const double h = 1e-4;
  move(h);
  const double forward = at.velocity.x();
  move(-h);
  EXPECT_NEAR((forward - at.velocity.x()) * speed / (2.0 * h * pitch), 507.078, 5e-4);
}

/// 41 links from a pin of a polygon of 20 about the origin to one of 40.
double driven_angle(double driver, double moment) {
  const double height = 0.3270141003;
  const double small = 0.5 * kLinkPitch / std::sin(pi / 20.0),
               large = 0.5 * kLinkPitch / std::sin(pi / 40.0);
  const Vector2d from(small * std::cos(driver), small * std::sin(driver));
  const Vector2d to(large * std::cos(0.5 * driver), height + large * std::sin(0.5 * driver));
  OpenChain chain(line(from, (to - from) / 41.0, 41), kLinkPitch, 1e10);
  PlanarMotion start;
  start.centre = {0.0, height};
  start.angle = 0.5 * driver;
  const std::vector<int> wheel = testing::add_planar(chain.system, "wheel", 1.0, 1e-3, start);
  chain.pin("bearing", std::make_unique<PlanarPort>(wheel, Vector2d::Zero()), ground(start.centre));
  chain.pin("driver", chain.rear_end(), ground(from));
  chain.pin("driven", chain.front_end(), std::make_unique<PlanarPort>(wheel, Vector2d(large, 0.0)));
  chain.system.add_element(std::make_unique<testing::Moment>(wheel[2], moment));
  return chain.rest(5e-6)(wheel[2]);
}

TEST(ChainOracle, RigidTightSpanBetweenPolygons) {
  // Linear in the load: from two of them to none, so that joints of 1e10 N/m are rigid. Forces are
  // balanced to 1e-9 N, 1e-9 of the tension.
  const auto rigid = [](double degrees) {
    const double driver = degrees * kDegree;
    return (2.0 * driven_angle(driver, 0.05) - driven_angle(driver, 0.1)) / kDegree;
  };
  const double turned[] = {-9.0, 0.0, 4.5, 9.0},
               expected[] = {-4.4860610, 0.0, 2.2586502, 4.5137688},
               ratio[] = {0.4937687, 0.5015461, 0.5019131, 0.4999801};
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(-rigid(-turned[i]), expected[i], 2e-7) << turned[i];
    const double h = 0.02;  // deg; the third derivative over h^2 is 1e-7
    EXPECT_NEAR((rigid(-turned[i] + h) - rigid(-turned[i] - h)) / (2.0 * h), ratio[i], 5e-7)
        << turned[i];
  }
}

/// A chain without friction that ends on a sprocket: the force of its last bush on the tooth and
/// the tensions of the links from there on [N].
struct Wrapped {
  double first = 0.0, tension[4] = {};
};

/// Four links of which the front one is pulled with 300 N. The bushes of the three joints lie at
/// the ends of their seats, and the pitch is that of the polygon of these places, so that all links
/// turn by the same angle.
Wrapped wrapped(int teeth, double bed) {
  ToothGap gap = iso606_gap(kLinkPitch, 5e-3, teeth);
  const double step = 2.0 * pi / teeth;
  // Of a bush in the gap on the x axis that is pulled clockwise.
  const double play = gap.seat_radius - 2.5e-3, radius = 0.5 * gap.pitch_diameter;
  // The reference has the links of pins on the pitch circle. At the ends of the seats pins are
  // behind it by their play, which turns the links by 0.17 deg at 20 teeth: the seats are shorter
  // by as much here, so that the angle between normal and link is that of the reference.
  const double end = gap.seat_half_angle;
  for (int i = 0; i < 20; ++i)
    gap.seat_half_angle = end - std::atan2(play * std::sin(gap.seat_half_angle),
                                           radius - play * std::cos(gap.seat_half_angle));
  const Vector2d bush(radius - play * std::cos(gap.seat_half_angle),
                      -play * std::sin(gap.seat_half_angle));
  const auto place = [&](int gaps) -> Vector2d {
    const double c = std::cos(gaps * step), s = std::sin(gaps * step);
    return {c * bush.x() - s * bush.y(), s * bush.x() + c * bush.y()};
  };
  const Vector2d tight = place(0) - place(1);
  const double pitch = tight.norm();
  // Joints that open by 3e-9 m of the 84 um of play and so turn the normals by 4e-5 rad: 0.01 N.
  OpenChain chain({place(4), place(3), place(2), place(1), place(0)}, pitch, 1e11);
  MattressLaw law{};
  law.stiffness = bed;
  law.width = 4.6e-3;
  ProfileCarrier carrier;
  carrier.port = ground({0.0, 0.0});
  LinkOutlines outlines;  // a joint's bush is that of the link behind it, and the front is free
  outlines.inner = outlines.outer = {LinkOutline::circle(0.5 * pitch, 2.5e-3)};
  ChainMake on_teeth = chain.make;
  on_teeth.kinds.pop_back();
  on_teeth.pitches.pop_back();
  const int contact = chain.system.elements();
  chain.system.add_element(std::make_unique<ProfileContact>(
      "wheel", std::vector<int>(chain.y.begin(), chain.y.end() - 3), on_teeth,
      std::make_shared<const Profile>(sprocket(gap)), outlines, law, std::move(carrier)));
  chain.pull(3, 300.0 * tight.normalized());
  const int tail = chain.pin("tail", chain.rear_end(), ground(place(4)));
  chain.rest(3e-6);
  Wrapped found;
  found.first = chain.system.response(contact).force.segment<2>(6).norm();
  for (int i = 0; i < 3; ++i) found.tension[i] = chain.tension(2 - i);
  found.tension[3] = chain.system.response(tail).force.head<2>().norm();
  return found;
}

class Wrap : public ::testing::TestWithParam<int> {};

TEST_P(Wrap, OracleWithoutFriction) {
  const bool small = GetParam() == 20;
  const double f = (small ? 18.25 : 21.625) * kDegree, ratio = small ? 0.5296105 : 0.7234353;
  EXPECT_NEAR(std::sin(f) / std::sin(f + 2.0 * pi / GetParam()), ratio, 5e-8);
  // Half of a contact is on the flank, which turns its force by half of its width, in proportion to
  // bed^(-1/3): from two beds to a rigid one.
  const Wrapped coarse = wrapped(GetParam(), 1.25e19), fine = wrapped(GetParam(), 1e20);
  double expected = 300.0;
  for (int i = 0; i < 4; ++i, expected *= ratio)
    EXPECT_NEAR(2.0 * fine.tension[i] - coarse.tension[i], expected, 0.01) << i;
  if (small) {
    EXPECT_NEAR(2.0 * fine.first - coarse.first, 156.779, 0.01);
    EXPECT_NEAR(2.0 * fine.tension[3] - coarse.tension[3], 44.565, 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Sprockets, Wrap, ::testing::Values(20, 40));

}  // namespace
}  // namespace clatter::dynamics
