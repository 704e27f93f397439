// SPDX-License-Identifier: GPL-3.0-or-later
// The layer of oil that is remembered on the liner, while a piston passes over it with the crank.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "dynamics/integrate/tableau.hpp"
#include "piston_scene.hpp"

namespace clatter::film {
namespace {

/// A piston that is held on the bore's axis and moves with the crank.
struct Held {
  explicit Held(const PistonLinerOptions& options) : element(make_element(options, false)) {
    rest = Eigen::VectorXd::Zero(element->size());
  }
  void start(double time) {
    const double kappa = 1e-9;
    stages({{time + kappa, kappa, 0, {}}}, time, time + kappa);
  }
  void step(const dynamics::Tableau& A, double time, double dt) {
    const double kappa = A.d * dt;
    stages({{time + A.c_1 * dt, kappa, 1, {A.a_10 * dt}},
            {time + dt, kappa, 2, {A.a_20 * dt, A.a_21 * dt}}},
           time, time + dt);
  }
  void stages(const std::vector<dynamics::Stage>& all, double begin, double end) {
    element->begin_step(begin);
    for (const dynamics::Stage& stage : all) {
      element->evaluate(stage, rest, Eigen::VectorXd::Zero(rest.size()), false, response);
      element->finish_stage(stage);
    }
    element->accept_step(end);
  }
  std::unique_ptr<PistonLiner> element;
  Eigen::VectorXd rest;
  dynamics::Response response;
};

PistonLinerOptions remembered(double clearance, double thickness) {
  PistonLinerOptions options;
  options.cells_around = 2;
  options.cells_along = 14;
  options.clearance = clearance;
  options.effects.asperities = options.effects.friction = false;
  options.roughness = {0.0, 0.0, 1.0, false};
  options.oil_thickness = thickness;
  options.liner_layer.emplace();
  options.liner_layer->bottom = 0.08;
  options.liner_layer->top = 0.32;
  return options;
}

constexpr double kBegin = 6.2e-3;  // [s]; the stroke is fastest and the start step changes nothing

/// A revolution of the crank and a little further, in `steps` steps.
void revolve(Held& piston, const dynamics::Tableau& method, int steps) {
  const double begin = kBegin, end = kBegin + 0.031;
  piston.start(begin);
  for (int k = 0; k < steps; ++k)
    piston.step(method, begin + (end - begin) * k / steps, (end - begin) / steps);
}

TEST(LinerLayer, AUniformLayerReturnsUnchangedFromTheEntireStroke) {
  for (const dynamics::Tableau* method : {&dynamics::sdirk2(), &dynamics::tr_bdf2()}) {
    Held piston(remembered(20e-6, 5e-6));
    revolve(piston, *method, 700);
    double worst = 0.0;
    for (const PadSnapshot& pad : piston.element->snapshot()) {
      for (const double t : pad.liner_oil.reshaped())
        if (t > 0.0) worst = std::max(worst, std::abs(t / 5e-6 - 1.0));
      worst = std::max(worst, (pad.fill.array() * pad.gap.array() / 5e-6 - 1.0).abs().maxCoeff());
    }
    const OilBalance oil = *piston.element->oil_balance();
    std::printf("    %-7s uniform layer after the stroke and back: %.1e, oil missing %.1e\n",
                method->name.c_str(), worst, oil.residue());
    EXPECT_LT(worst, 1e-10);
    EXPECT_LT(oil.residue(), 1e-12);
    EXPECT_GT(oil.moved, 4.0 * 0.12 * 5e-6 * 0.07);  // both pads, both edges, most of the stroke
  }
}

PistonLinerOptions busy() {
  PistonLinerOptions options = remembered(12e-6, 7e-6);
  options.cells_around = 4;
  options.skirt.barrel_top = 20e-6;
  options.skirt.barrel_bottom = 15e-6;
  options.skirt.ovality = 20e-6;
  LinerLayerOptions& layer = *options.liner_layer;
  layer.splash = 2e-3;
  layer.splash_thickness = 9e-6;
  layer.most = 30e-6;
  layer.rings = {{35e-3, 0.02, 1000.0, 0.5e-6}, {43e-3, 0.01, 500.0, 0.2e-6}};
  options.ends = {0.115, 0.31};  // the skirt leaves the bottom by 15 mm
  return options;
}

TEST(LinerLayer, NoOilIsMissingAfterACycleWithEveryEffect) {
  for (const dynamics::Tableau* method : {&dynamics::sdirk2(), &dynamics::tr_bdf2()}) {
    Held piston(busy());
    piston.rest[1] = 6e-6;
    revolve(piston, *method, 500);
    const OilBalance oil = *piston.element->oil_balance();
    std::printf(
        "    %-7s oil [mm3]: first %.2f, gap %.2f, liner %.2f, supplied %.2f, scraped %.2f, "
        "dripped "
        "%.2f, sides %.3f, ends %.2f; missing %.1e of %.2f moved\n",
        method->name.c_str(), 1e9 * oil.first, 1e9 * oil.gap, 1e9 * oil.liner, 1e9 * oil.supplied,
        1e9 * oil.scraped, 1e9 * oil.dripped, 1e9 * oil.sides, 1e9 * oil.ends, oil.residue(),
        1e9 * oil.moved);
    EXPECT_LT(oil.residue(), 1e-10);
    for (const double part : {oil.supplied, oil.scraped, oil.dripped, oil.sides})
      EXPECT_GT(part, 1e-4 * oil.moved);
    EXPECT_NE(oil.ends, 0.0);
    OilBalance leaky = oil;
    leaky.scraped *= 1.0 + 1e-6;
    EXPECT_GT(leaky.residue(), 1e-10);  // it would be seen
    for (const PadSnapshot& pad : piston.element->snapshot())
      EXPECT_GE(pad.liner_oil.minCoeff(), 0.0);
  }
}

TEST(LinerLayer, NoOilIsMissingAroundTheEntireSkirtAndNoneLeavesOverSides) {
  PistonLinerOptions options = busy();
  options.span = SkirtSpan::kWhole;
  options.cells_around = 12;
  Held piston(options);
  piston.rest[1] = 6e-6;
  revolve(piston, dynamics::tr_bdf2(), 500);
  const OilBalance oil = *piston.element->oil_balance();
  EXPECT_LT(oil.residue(), 1e-10);
  EXPECT_EQ(oil.sides, 0.0);
  EXPECT_GT(oil.moved, 10.0 * oil.first * 0.1);
}

TEST(LinerLayer, AMirroredPistonHasAMirroredLayer) {
  const auto run = [](double lateral) {
    Held piston(busy());
    piston.rest[1] = lateral;
    revolve(piston, dynamics::sdirk2(), 300);
    return piston.element->snapshot();
  };
  const auto one = run(5e-6), other = run(-5e-6);
  for (const int pad : {0, 1}) {
    const Eigen::MatrixXd a = one[pad].liner_oil, b = other[1 - pad].liner_oil;
    EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-9 * a.maxCoeff());
  }
  EXPECT_GT((one[0].liner_oil - one[1].liner_oil).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(LinerLayer, ARejectedStepChangesNothingAndARestoredStateContinuesBitByBit) {
  const dynamics::Tableau& method = dynamics::tr_bdf2();
  Held piston(busy());
  revolve(piston, method, 200);
  const std::vector<double> saved = piston.element->save();
  const double t = kBegin + 0.031, dt = 5e-5, kappa = method.d * dt;
  piston.element->begin_step(t);
  const dynamics::Stage stage{t + method.c_1 * dt, kappa, 1, {method.a_10 * dt}};
  piston.element->evaluate(stage, piston.rest, piston.rest, false, piston.response);
  piston.element->finish_stage(stage);  // then the step is rejected
  EXPECT_EQ(piston.element->save(), saved);
  Held restored(busy());
  restored.element->restore(saved);
  EXPECT_EQ(restored.element->oil_balance()->missing(), piston.element->oil_balance()->missing());
  for (Held* one : {&piston, &restored})
    for (int k = 0; k < 5; ++k) one->step(method, t + k * dt, dt);
  EXPECT_EQ(restored.element->save(), piston.element->save());
  EXPECT_NE(restored.element->save(), saved);
}

TEST(LinerLayer, IsAbsentUnlessItIsRequested) {
  PistonLinerOptions options = busy();
  const size_t with = make_element(options, false)->save().size();
  options.liner_layer.reset();
  const auto without = make_element(options, false);
  EXPECT_LT(without->save().size(), with);
  EXPECT_FALSE(without->oil_balance().has_value());
  EXPECT_EQ(without->snapshot().front().liner_oil.size(), 0);
}

}  // namespace
}  // namespace clatter::film
