// SPDX-License-Identifier: GPL-3.0-or-later
// The piston-liner element: resultants, power, content under the tableau, effects.
#include "dynamics/film/piston_liner.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "film_march.hpp"
#include "piston_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::film {
namespace {

PistonLinerOptions small_scene() {
  PistonLinerOptions options;
  options.cells_around = 8;
  options.cells_along = 9;
  options.clearance = 6e-6;
  options.skirt.barrel_top = 15e-6;
  options.skirt.barrel_bottom = 10e-6;
  options.skirt.ovality = 8e-6;
  return options;
}

void settle(PistonLiner& element, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
            dynamics::Response& response) {
  const dynamics::Stage first{2e-3, 1e-10, 0, {}};
  element.begin_step(first.time);
  element.evaluate(first, y, v, true, response);
  element.finish_stage(first);
  element.accept_step(first.time);
}

double entry(const dynamics::History& history, const std::string& name) {
  for (const auto& one : history.entries())
    if (one.name == name) return one.value;
  ADD_FAILURE() << name;
  return NAN;
}

TEST(PistonLiner, ElasticBodiesInRigidMotionFeelTheSameForceAsRigidOnes) {
  PistonLinerOptions options = small_scene();
  const auto rigid = make_element(options, false);
  PistonLinerBodies bodies;
  bodies.stroke = crank_stroke;
  const rom::ContactGrid skirt =
      make_patches(8, 3, options.skirt_bottom, options.skirt_top, options.bore_radius);
  bodies.piston = ElasticSurface{skirt, {}};
  std::vector<int> coordinates(34);
  std::iota(coordinates.begin(), coordinates.end(), 0);
  PistonLiner elastic(options, bodies, coordinates);
  Eigen::MatrixXd motion(24, 6);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 3; ++j) {
      const Eigen::Vector3d n = pad_normal(skirt.angle[i]);
      const double z = skirt.axis_point.z() + skirt.axial[j];
      motion.row(i * 3 + j) << n.x(), n.y(), 0.0, -z * n.y(), z * n.x(), 0.0;
    }
  Eigen::VectorXd y(6), v(6);
  y << 1e-6, 4e-6, 0.0, 2e-5, -1e-5, 0.0;
  v << 0.0, 0.02, 0.0, 0.3, 0.0, 0.0;
  dynamics::Response one, other;
  settle(*rigid, y, v, one);
  const std::vector<int> radial{0, 1, 3, 4};
  Eigen::VectorXd y_e(34), v_e(34);
  y_e << motion * y, y(radial), Eigen::VectorXd::Zero(6);
  v_e << motion * v, v(radial), Eigen::VectorXd::Zero(6);
  settle(elastic, y_e, v_e, other);
  // Radial resultants act on the patches and their fit, friction on the pin.
  Eigen::VectorXd total = motion.transpose() * other.force.head(24) + other.force.tail(6);
  total(radial) += other.force.segment<4>(24);
  EXPECT_GT(one.force.norm(), 1.0);
  EXPECT_LT((total - one.force).norm(),
            1e-8 * one.force.norm());  // rounding of G, magnified by the film's stiffness
}

TEST(PistonLiner, ReportedResultantsAreTheForcesOnTheRigidPiston) {
  PistonLinerOptions options = small_scene();
  options.bore.emplace();  // wider above: part of the pressure is axial
  options.bore->angle = Eigen::VectorXd::Zero(1);
  options.bore->height = Eigen::Vector2d(0.1, 0.4);
  options.bore->deviation = Eigen::RowVector2d(-1e-6, 1e-6);
  const auto element = make_element(options, false, 1e-3);
  dynamics::Response response;
  Eigen::VectorXd y = pushed(*element, false, 5e-6, 3e-5), v = Eigen::VectorXd::Zero(6);
  v[1] = 0.01;
  settle(*element, y, v, response);
  dynamics::History history;
  element->record(history);
  EXPECT_NEAR(entry(history, "side_force"), response.force[1], 1e-9 * std::abs(response.force[1]));
  EXPECT_NEAR(entry(history, "side_moment"), response.force[3], 1e-9 * std::abs(response.force[1]));
  double axial = 0.0;  // of the pressure on the conical bore
  for (const PadSnapshot& pad : element->snapshot()) {
    const double slope = 2e-6 / 0.3, width = options.pad_span / options.cells_around;
    const double area = options.bore_radius * width * (options.skirt_top - options.skirt_bottom) /
                        options.cells_along;
    axial += slope * area * (pad.pressure.sum() + pad.contact_pressure.sum());
  }
  EXPECT_GT(axial, 1e-5);
  EXPECT_NEAR(entry(history, "friction_force"), response.force[2] - axial,
              1e-9 * std::abs(response.force[2]));
  EXPECT_LT(response.force[1], 0.0);  // pushed to the thrust side, driven back
  EXPECT_GT(response.force[2], 0.0);  // moving down at 2 ms, friction points up
  EXPECT_GT(entry(history, "film_pressure_max"), 0.0);
  EXPECT_GT(entry(history, "film_min"), 0.0);
}

TEST(PistonLiner, PowerBalancesForceTimesVelocity) {
  // f.v = input - lost - d(stored)/dt, in a state where film, asperities, liner slope and friction
  // all act.
  const auto element = make_element(small_scene(), true, 1e-3);
  dynamics::Response response;
  Eigen::VectorXd y = pushed(*element, true, 6.5e-6, 2e-5),
                  v = Eigen::VectorXd::Zero(element->size());
  for (int k = 0; k < v.size(); ++k) v[k] = 1e-3 * std::cos(2.0 * k);
  settle(*element, y, v, response);
  const dynamics::Power power = element->power(y, v);
  const double work = response.force.dot(v);
  // Stored energy along the motion, by central difference in time.
  const double dt = 1e-7;
  auto stored_at = [&](double shift) {
    dynamics::Response ignored;
    const dynamics::Stage probe{2e-3 + shift, 1e-7, 1, {0.0}};
    element->evaluate(probe, y + shift * v, v, false, ignored);
    return element->power(y, v).stored;
  };
  const double rate = (stored_at(dt) - stored_at(-dt)) / (2.0 * dt);
  EXPECT_GT(std::abs(rate), 1e-3);
  EXPECT_NEAR(work, power.input - power.lost - rate,
              5e-12 * (std::abs(power.lost) + std::abs(rate)));  // rounding of the difference
}

TEST(PistonLiner, ForceAndTangentDoNotDependOnTheNumberOfThreads) {
  dynamics::Response response[2];
  for (const int threads : {1, 2}) {
    set_thread_count(threads);
    const auto element = make_element(small_scene(), true, 1e-3);
    const Eigen::VectorXd y = pushed(*element, true, 6.5e-6, 2e-5);
    settle(*element, y, Eigen::VectorXd::Constant(y.size(), 1e-3), response[threads - 1]);
  }
  set_thread_count(0);
  EXPECT_GT(response[0].force.norm(), 1.0);
  EXPECT_EQ(response[0].force, response[1].force);
  EXPECT_EQ(response[0].tangent, response[1].tangent);
}

TEST(PistonLiner, DryContactTakesNoFilmMemoryAndIsConservativeWithoutFrictionAndDamping) {
  PistonLinerOptions options = small_scene();
  options.effects = {false, true, true, false};
  options.damping.loss_factor = 0.0;
  const auto element = make_element(options, false);
  EXPECT_TRUE(element->save().size() == 1);
  Eigen::VectorXd mass(6);
  mass << 2.0, 2.0, 2.0, 4e-3, 4e-3, 4e-3;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(6), v = Eigen::VectorXd::Zero(6);
  v[1] = 0.1;
  Flight flight(*element, mass, y, v);
  flight.start();
  const double start = 0.5 * v.cwiseAbs2().dot(mass);
  for (int k = 0; k < 400; ++k) ASSERT_TRUE(flight.step(1e-6));
  EXPECT_LT(flight.v[1], 0.0);  // bounced
  EXPECT_EQ(element->snapshot()[0].pressure.size(), 0);
  const double energy =
      0.5 * flight.v.cwiseAbs2().dot(mass) + element->power(flight.y, flight.v).stored;
  EXPECT_NEAR(energy / start, 1.0, 2e-3);  // TR-BDF2 at 1 us over the bounce loses a little
}

TEST(PistonLiner, ContentFollowsTheTableauAndSurvivesSaving) {
  PistonLinerOptions options = small_scene();
  options.initial_fill = 0.8;
  const auto one = make_element(options, false), two = make_element(options, false);
  Eigen::VectorXd mass = Eigen::VectorXd::Constant(6, 2.0);
  mass.tail(3).setConstant(4e-3);
  Eigen::VectorXd v = Eigen::VectorXd::Zero(6);
  v[1] = 0.05;
  Flight first(*one, mass, Eigen::VectorXd::Zero(6), v);
  first.start();
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(first.step(1e-6));
  two->restore(one->save());
  const dynamics::Stage stage{first.time + 1e-6, 1e-6, 1, {1e-6}};
  dynamics::Response a, b;
  one->begin_step(first.time);
  two->begin_step(first.time);
  one->evaluate(stage, first.y, first.v, true, a);
  two->evaluate(stage, first.y, first.v, true, b);
  EXPECT_LT((a.force - b.force).norm(), 1e-10 * a.force.norm());
  test::expect_parts(test::refusal_of([&] {
                       two->restore({1.0, 2.0});
                     }),
                     {": the saved film state has 2 numbers, expected "});
}

TEST(PistonLiner, AFrontOfOilStaysSharpOnItsWayAlongTheSkirt) {
  PistonLinerOptions options;
  options.cells_around = 2;
  options.cells_along = 40;
  options.clearance = 50e-6;
  options.initial_fill = 0.1;
  options.supply_fill = 0.4;
  PistonLinerBodies bodies;
  const double speed = -10.0;  // the oil moves up the skirt with the liner
  bodies.stroke = [=](double time) { return StrokeState{0.2 + speed * time, speed}; };
  PistonLiner element(options, bodies, {0, 1, 2, 3, 4, 5});
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(6);
  dynamics::Response response;
  settle(element, rest, rest, response);
  const double dt = 1.75e-5;
  for (int k = 1; k <= 200; ++k) {  // 3.5 ms: half of the 70 mm
    const dynamics::Stage stage{2e-3 + k * dt, dt, 1, {}};
    element.begin_step(stage.time - dt);
    element.evaluate(stage, rest, rest, false, response);
    element.finish_stage(stage);
    element.accept_step(stage.time);
  }
  const RowMatrix fill = element.snapshot().front().fill;
  EXPECT_NEAR(fill.row(0).mean(), 0.25, 5e-8);  // no oil is lost
  EXPECT_LT((fill.row(0) - fill.row(1)).cwiseAbs().maxCoeff(), 1e-12);
  int between = 0;
  for (Eigen::Index j = 0; j < fill.cols(); ++j) between += fill(0, j) > 0.13 && fill(0, j) < 0.37;
  EXPECT_LE(between, 8);  // first-order upwinding smears it over more than ten cells
  EXPECT_LT(fill.maxCoeff(), 0.4 + 1e-6);
  EXPECT_GT(fill.minCoeff(), 0.1 - 1e-6);
  printf("    cells of the front: %d\n", between);
}

TEST(PistonLiner, RefusesParametersOutOfRangeAndAGapThatIsClosedAtTheStart) {
  const auto expect_refused = [](void (*spoil)(PistonLinerOptions&), const std::string& said) {
    PistonLinerOptions options = small_scene();
    spoil(options);
    EXPECT_EQ(test::refusal_of([&] { make_element(options, false); }), options.name + ": " + said);
  };
  expect_refused([](PistonLinerOptions& o) { o.clearance = -1e-6; },
                 "clearance: found -1e-06, expected >= 0 m");
  expect_refused([](PistonLinerOptions& o) { o.viscosity = 0.0; },
                 "viscosity: found 0, expected > 0 Pa s");
  expect_refused([](PistonLinerOptions& o) { o.initial_fill = 1.2; },
                 "initial_fill: found 1.2, expected 0 to 1");
  expect_refused([](PistonLinerOptions& o) { o.pad_span = 3.5; },
                 "pad_span: found 3.5, expected between 0 and pi rad");
  expect_refused(
      [](PistonLinerOptions& o) {
        o.span = SkirtSpan::kWhole;
        o.cells_around = 6;
      },
      "cells_around: found 6, expected an even number of at least 8 around the entire skirt");
  expect_refused([](PistonLinerOptions& o) { o.skirt_top = o.skirt_bottom; },
                 "skirt_top: found " + fmt::format("{}", small_scene().skirt_bottom) +
                     ", expected above skirt_bottom");
  expect_refused([](PistonLinerOptions& o) { o.effects.film = o.effects.asperities = false; },
                 "effects: found 0, expected film or asperities on: otherwise nothing separates "
                 "skirt and liner");
  const auto element = make_element(small_scene(), false);
  dynamics::Response response;
  test::expect_parts(test::refusal_of([&] {
                       settle(*element, pushed(*element, false, 60e-6, 0.0),
                              Eigen::VectorXd::Zero(6), response);
                     }),
                     {"found a smallest gap of -", "m at the start, expected more than "});
}

TEST(PistonLiner, GapsBelowTheMinimumAreOneKindOfRefusal) {
  // The value is the detail: as part of the kind each refusal would be counted by itself.
  const auto element = make_element(small_scene(), false);
  dynamics::Response response;
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(6);
  settle(*element, rest, rest, response);
  std::vector<std::string> details;
  for (const double shift : {60e-6, 70e-6, std::numeric_limits<double>::quiet_NaN()}) {
    try {
      element->evaluate({2e-3, 1e-6, 1, {0.0}}, pushed(*element, false, shift, 0.0), rest, false,
                        response);
    } catch (const dynamics::StepRefused& refusal) {
      EXPECT_EQ(refusal.kind(),
                element->name() +
                    (std::isnan(shift) ? ": gap is not finite" : ": gap below the film's minimum"));
      details.push_back(refusal.detail());
    }
  }
  ASSERT_EQ(details.size(), 3U);
  EXPECT_EQ(details[0].front(), '-');
  EXPECT_NE(details[0], details[1]);
  EXPECT_EQ(details[0].find(" m on the thrust pad at -5.0 deg, "), details[0].find(' '));
  EXPECT_NE(details[0].find("mm from the pin"), std::string::npos);
}

}  // namespace
}  // namespace clatter::film
