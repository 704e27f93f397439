// SPDX-License-Identifier: GPL-3.0-or-later
// Pin, journals, bearings and load of a crankshaft, each by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>

#include "dynamics/bearing/bearing_laws.hpp"
#include "dynamics/bearing/film_bearing.hpp"
#include "dynamics/body/crank_body.hpp"
#include "dynamics/body/mechanism_port.hpp"
#include "dynamics/component/law_table.hpp"
#include "dynamics/crank/crank_gyroscope.hpp"
#include "dynamics/crank/crank_load.hpp"
#include "dynamics/crank/mean_torque.hpp"
#include "dynamics/element/crank_angle.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/law/joint_laws.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

using testing::arbitrary;
using testing::tangent_error;

constexpr double kSpeed = 200.0;  // [rad/s]
const CrankClock kUneven{kSpeed, {{2.0, 8.0, 0.4}}};

SliderCrank crank_of(Rotation rotation = Rotation::kForward) {
  return SliderCrank(0.065, 0.210, 1e-3, kUneven, 0.3, rotation);
}

PointWeights axis_at(double arm) {
  PointWeights point;
  point.add(0, 1.0, 0.0);
  point.add(1, 0.0, 1.0);
  point.add(2, 0.0, -arm);
  point.add(3, arm, 0.0);
  return point;
}

TEST(CrankAngle, LeadsItsClockByTheTimeInWhichThatGetsThere) {
  for (const Rotation rotation : {Rotation::kForward, Rotation::kBackward}) {
    const double sign = rotation == Rotation::kForward ? 1.0 : -1.0;
    const CrankAngle angle(crank_of(rotation), 0);
    // Its rotation from the clock: a + a' t + a'' t^2 / 2.
    const double a = 0.1, rate = 9.0, acceleration = -3000.0, kappa = 1e-5;
    const auto lead = [&](double t, double more) {
      Eigen::VectorXd y(1), v(1), known(1), before(1);
      y << a + t * (rate + 0.5 * t * acceleration);
      v << rate + t * acceleration;
      known = v - kappa * Eigen::VectorXd::Constant(1, acceleration);
      before = y - kappa * v;
      Stage stage{2e-3 + t, kappa, 1, {}};
      stage.y_begin = &before;
      stage.v_begin = stage.v_known = &known;
      return angle.lead(stage, (y.array() + more).matrix(), (v.array() + more / kappa).matrix());
    };
    const CrankLead at = lead(0.0, 0.0);
    EXPECT_NEAR(kUneven.angle(2e-3 + at.now.position), kUneven.angle(2e-3) + sign * a, 1e-14);
    EXPECT_NEAR(angle.at(2e-3, a, rate).angle, kUneven.angle(2e-3) - 0.3 + sign * a, 1e-15);
    EXPECT_NEAR(kUneven.angle(2e-3 - kappa + at.begin.position),
                kUneven.angle(2e-3 - kappa) + sign * (a - kappa * rate), 1e-14);
    constexpr double kTime = 1e-6, kTurn = 1e-6;
    const Motion<double> later = lead(kTime, 0.0).now, earlier = lead(-kTime, 0.0).now,
                         more = lead(0.0, kTurn).now, less = lead(0.0, -kTurn).now;
    EXPECT_NEAR((later.position - earlier.position) / (2.0 * kTime), at.now.velocity, 1e-8);
    EXPECT_NEAR((later.velocity - earlier.velocity) / (2.0 * kTime), at.now.acceleration, 1e-5);
    EXPECT_NEAR((more.position - less.position) / (2.0 * kTurn), at.by_turn.position, 1e-10);
    EXPECT_NEAR((more.velocity - less.velocity) / (2.0 * kTurn), at.by_turn.velocity,
                1e-6 * std::abs(at.by_turn.velocity));
    EXPECT_NEAR((more.acceleration - less.acceleration) / (2.0 * kTurn), at.by_turn.acceleration,
                1e-6 * std::abs(at.by_turn.acceleration));
  }
}

TEST(CrankAngle, OfAClockLeadsByNothing) {
  const CrankLead lead = CrankAngle().lead({2e-3, 1e-5, 1, {}}, {}, {});
  const Motion<double> given{0.2, 3.0, -4e3}, seen = led(given, lead.now);
  EXPECT_EQ(seen.position, given.position);
  EXPECT_EQ(seen.velocity, given.velocity);
  EXPECT_EQ(seen.acceleration, given.acceleration);
}

TEST(CrankPin, IsWhereTheTurnedCrankHasIt) {
  CrankPinPort pin(axis_at(0.2), 4, crank_of());
  const double t = 2e-3;
  const Eigen::Vector2d p = crank_of().crank_pin(t).position, w = crank_of().crank_pin(t).velocity;
  Eigen::VectorXd y(5), v = Eigen::VectorXd::Zero(5);
  PortState state;
  // A quarter of a turn about +x: (y, z) -> (-z, y); 1 mm and 1 mrad of the axis.
  y << 1e-3, 0.0, 0.0, 1e-3, 0.5 * std::numbers::pi;
  pin.motion(t, y, v, state);
  EXPECT_NEAR(state.position.y(), -p.y() - p.x() + 1e-3 + 0.2e-3, 1e-15);
  EXPECT_NEAR(state.position.z(), p.x() - p.y(), 1e-15);
  EXPECT_NEAR(state.velocity.y(), -w.y() - w.x(), 1e-13);
  EXPECT_NEAR(state.velocity.z(), w.x() - w.y(), 1e-13);
  EXPECT_LT((state.velocity - state.driven.head<3>()).norm(), 1e-15);
  EXPECT_EQ(state.driven(3), crank_of().spin(t));
  // It turns with its axes.
  const Eigen::Vector3d pin_then(0.0, -p.y(), p.x());
  EXPECT_LT((state.rotation * Eigen::Vector3d(0.0, 0.0, p.norm()) - pin_then).norm(), 1e-15);
}

TEST(CrankPin, ItsRateIsThatOfItsDisplacement) {
  for (const Rotation rotation : {Rotation::kForward, Rotation::kBackward}) {
    CrankPinPort pin(axis_at(0.2), 4, crank_of(rotation));
    const Eigen::VectorXd y = 0.3 * arbitrary(5, 1), v = 40.0 * arbitrary(5, 2);
    PortState at, before, after;
    const double h = 1e-7, t = 3e-3;
    pin.motion(t, y, v, at);
    pin.motion(t - h, y - h * v, v, before);
    pin.motion(t + h, y + h * v, v, after);
    EXPECT_LT(((after.position - before.position) / (2.0 * h) - at.velocity).norm(),
              1e-8 * at.velocity.norm());
  }
}

TEST(CrankPin, TangentsOfItsJointAreDifferenceQuotients) {
  const RadialLaw law{1e-5, 1e4, 1e5, 1.0, 30.0};
  const SliderCrank crank = crank_of();
  PairElement joint(
      "crank_pin", std::make_unique<CrankPinPort>(axis_at(0.2), 4, crank),
      std::make_unique<RodPort>(std::vector<int>{5, 6, 7}, crank, Eigen::Vector2d(0.0, -0.07)),
      std::make_unique<RadialJoint>(law));
  EXPECT_LT(tangent_error(joint, 0.2 * arbitrary(8, 1), arbitrary(8, 2)), 1e-6);
}

TEST(CrankPort, TurnsWithItsClockAndTilts) {
  CrankPort port({0, 1, 2, 3, 4}, 0.5, 0.2, kUneven, Rotation::kBackward);
  const Eigen::VectorXd y = 1e-6 * arbitrary(5, 1), v = 1e-3 * arbitrary(5, 2);
  PortState at, before, after;
  const double h = 1e-6, t = 1e-3;
  port.motion(t - h, y - h * v, v, before);
  port.motion(t + h, y + h * v, v, after);
  port.motion(t, y, v, at);
  EXPECT_LT(((after.position - before.position) / (2.0 * h) - at.velocity).norm(), 1e-10);
  EXPECT_NEAR(at.spin.x(), -kUneven.turn(t).velocity + v(4), 1e-12);
  EXPECT_NEAR(at.position.y(), y(0) + 0.2 * y(3), 1e-18);
  EXPECT_NEAR(at.position.z(), y(1) - 0.2 * y(2), 1e-18);
  // Power of a wrench: on the coordinates, and on what is prescribed.
  const Vector6 load = arbitrary(6, 5);
  const double power = load.dot(wrench(at.velocity, at.spin));
  EXPECT_NEAR(power, (at.work.transpose() * load).dot(v) + load.dot(at.driven), 1e-12);
}

/// A file of the current test.
std::filesystem::path written(const std::string& text) {
  const std::filesystem::path path = testing::test_folder() / "table.csv";
  std::ofstream(path) << text;
  return path;
}

const char* const kRadial = "eccentricity [um], force [kN]\n0, 0\n20, 1\n40, 8\n50, 30\n";

std::unique_ptr<Port> journal() {
  return std::make_unique<CrankPort>(std::vector<int>{0, 1, 2, 3, 4}, 0.5, 0.2, kUneven,
                                     Rotation::kForward);
}

std::unique_ptr<Port> housing() {
  return std::make_unique<NodePort>(Eigen::Vector3d(0.5, 0.0, 0.0),
                                    std::vector<int>{5, 6, 7, 8, 9, 10});
}

RisingTable bearing_table(const std::string& text) {
  return read_rising_table({written(text), "", "m", "N"});
}

TEST(CrankBearing, TangentsAreDifferenceQuotients) {
  const BearingPlace x{ShaftAxes{0}};
  JournalFilmOptions options;
  options.size = {85e-3, 30e-3, 1e-3, 10e-3};
  options.cells_around = 36;
  options.cells_along = 3;
  PairElement table("table", journal(), housing(),
                    std::make_unique<RadialBearing>(x, RadialTable(bearing_table(kRadial), 1e4)));
  PairElement film("film", journal(), housing(), std::make_unique<FilmBearing>(x, options));
  CrankGyroscope gyroscope({0, 1}, 0.8, kUneven, Rotation::kBackward);
  CrankLoadLaw law;
  law.constant = 300.0;
  law.at_speed = 180.0;
  CrankLoad load(0, kUneven, Rotation::kBackward, law, [](double) { return 0.7; });
  for (ForceElement* element :
       std::initializer_list<ForceElement*>{&table, &film, &gyroscope, &load}) {
    const int n = static_cast<int>(element->coordinates().size());
    // Displacements of some um. Rates follow them by kappa: stages of 10 us. The film's tangent
    // lacks what the journal's spin, which moves by the step over kappa, changes of the wedge.
    const Eigen::VectorXd y = 1e-5 * arbitrary(n, 1), v = 1e-2 * arbitrary(n, 2);
    EXPECT_LT(tangent_error(*element, y, v, 1e-9, 1e-5), element == &film ? 2e-3 : 1e-6)
        << element->name();
  }
}

TEST(CrankBearing, OfATableHasItsForcesAndEndsWithIt) {
  const RisingTable table = bearing_table(kRadial);
  PairElement bearing("bearing crankshaft b", journal(), housing(),
                      std::make_unique<RadialBearing>(BearingPlace{ShaftAxes{0}},
                                                      RadialTable(table, 0.0), table.last()));
  Response response;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(11);
  y(0) = 40e-6;
  bearing.evaluate({0.0, 1e-5, 1, {}}, y, Eigen::VectorXd::Zero(11), false, response);
  EXPECT_NEAR(response.force.cwiseAbs().maxCoeff(), 8e3, 1e-6);
  y(0) = 51e-6;
  try {
    bearing.evaluate({0.0, 1e-5, 1, {}}, y, Eigen::VectorXd::Zero(11), false, response);
    FAIL();
  } catch (const StepRefused& refused) {
    EXPECT_EQ(refused.kind(),
              "bearing crankshaft b: the journal is beyond the table of the bearing");
  }
}

TEST(CrankLoad, AConstantTorqueTurnsAFreeCrankByItsInertia) {
  // delta'' = -T / J, in the direction of rotation.
  const double J = 0.8, T = 12.0, end = 0.05;
  for (const Rotation rotation : {Rotation::kForward, Rotation::kBackward}) {
    CrankBody crank;
    crank.is_free = true;
    crank.polar = J;
    System system;
    const int body = system.add_body(make_crank_body(crank));
    CrankLoadLaw law;
    law.constant = T;
    const int turn = system.coordinate(body, crank.turn());
    system.add_element(std::make_unique<CrankLoad>(turn, CrankClock{kSpeed}, rotation, law,
                                                   [](double) { return 1.0; }));
    StepOptions options;
    options.largest = 1e-3;
    auto method = make_integrator(system, options);
    method->start(0.0, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1));
    while (method->state().time < end) method->step(end);
    const double expected = -0.5 * T / J * end * end;
    const double sign = rotation == Rotation::kForward ? 1.0 : -1.0;
    // The start is an implicit Euler stage of 1e-7 s.
    EXPECT_NEAR(sign * method->state().y(turn), expected, 1e-5 * std::abs(expected));
  }
}

TEST(CrankLoad, ACrankFarFromItsClockIsRefused) {
  CrankLoad load(0, CrankClock{kSpeed}, Rotation::kForward, {}, [](double) { return 1.0; });
  Response response;
  const Eigen::VectorXd at = Eigen::VectorXd::Constant(1, 0.49);
  load.evaluate({0.0, 1e-5, 1, {}}, at, 0.0 * at, false, response);
  try {
    load.evaluate({0.0, 1e-5, 1, {}}, -1.1 * at, 0.0 * at, false, response);
    FAIL();
  } catch (const StepRefused& refused) {
    EXPECT_EQ(refused.kind(), "crankshaft: its load does not hold the speed of the clock");
    EXPECT_EQ(refused.detail(), "-30.9 deg from its clock, at most 28.6");
  }
}

TEST(MeanTorque, BringsACrankToItsClockInTwoCycles) {
  // A double integrator with a torque that has a mean and orders: exact motion in each cycle.
  const double I = 0.7, cycle = 0.06, mean = 40.0, amplitude = 300.0;
  const double w = 4.0 * 2.0 * std::numbers::pi / cycle;  // four periods a cycle
  MeanTorque control(0.0, I, cycle);
  double angle = 0.0, rate = 0.0;
  for (int k = 0; k < 4; ++k) {
    const double begin = k * cycle, a = (mean - control.torque()) / I, b = amplitude / I;
    control.begin_step(begin);
    const double angle_0 = angle, rate_0 = rate;
    constexpr int kSteps = 400;
    for (int i = 1; i <= kSteps; ++i) {
      const double t = cycle * i / kSteps;
      // a + b sin(w t): rate -b/w (cos - 1), angle b (t/w - sin/w^2).
      rate = rate_0 + a * t + b / w * (1.0 - std::cos(w * t));
      angle = angle_0 + rate_0 * t + 0.5 * a * t * t + b * (t / w - std::sin(w * t) / (w * w));
      control.accept_step(begin + t, angle, rate);
    }
    std::printf("cycle %d: next torque %.6f N m, angle %.3e rad\n", k + 1, control.torque(), angle);
  }
  EXPECT_NEAR(control.torque(), mean, 1e-3 * mean);  // of the trapezoidal mean of the angle
  EXPECT_NEAR(angle, 0.0, 1e-5);
  const auto state = control.save();
  MeanTorque other(0.0, I, cycle);
  other.restore(state);
  EXPECT_EQ(other.save(), state);
}

}  // namespace
}  // namespace clatter::dynamics
