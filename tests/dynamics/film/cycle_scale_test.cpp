// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes that a factor scales over the cycle.
#include "dynamics/film/cycle_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "dynamics/integrate/tableau.hpp"
#include "film_march.hpp"
#include "piston_scene.hpp"

namespace clatter::film {
namespace {

/// A piston at rest in a bore that a factor widens; a full film between them.
PistonLinerOptions breathing_bore() {
  PistonLinerOptions options;
  options.cells_around = 4;
  options.cells_along = 8;
  options.clearance = 20e-6;
  options.bulk_modulus = 0.0;
  options.supply_pressure = 100e5;
  options.effects.asperities = options.effects.friction = false;
  options.roughness = {0.0, 0.0, 1.0, false};
  const LinerShape wide{Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, 0.2),
                        Eigen::MatrixXd::Constant(1, 1, 1e-6)};
  options.scaled_bore.push_back(
      {wide, [](double time) {
         return ScaleState{1.0 - std::cos(500.0 * time), 500.0 * std::sin(500.0 * time)};
       }});
  return options;
}

std::unique_ptr<PistonLiner> resting(const PistonLinerOptions& options) {
  PistonLinerBodies bodies;
  bodies.stroke = [](double) { return StrokeState{0.2, 0.0}; };
  return std::make_unique<PistonLiner>(options, bodies, std::vector<int>{0, 1, 2, 3, 4, 5});
}

class March {
 public:
  March(const PistonLinerOptions& options, double begin) : element_(resting(options)) {
    const double kappa = 1e-9;
    const dynamics::Stage first{begin + kappa, kappa, 0, {}};
    element_->begin_step(begin);
    evaluate(first);
    element_->accept_step(begin);
  }
  void step(const dynamics::Tableau& A, double t, double dt) {
    element_->begin_step(t);
    evaluate({t + A.c_1 * dt, A.d * dt, 1, {A.a_10 * dt}});
    evaluate({t + dt, A.d * dt, 2, {A.a_20 * dt, A.a_21 * dt}});
    element_->accept_step(t + dt);
  }
  double pressure() const {
    const PadSnapshot pad = element_->snapshot().front();
    EXPECT_EQ(pad.fill.minCoeff(), 1.0);
    return pad.pressure.mean();
  }
  double gap() const { return element_->snapshot().front().gap.mean(); }
  PistonLiner& element() { return *element_; }

 private:
  void evaluate(const dynamics::Stage& stage) {
    element_->evaluate(stage, rest_, rest_, false, response_);
    element_->finish_stage(stage);
  }
  std::unique_ptr<PistonLiner> element_;
  Eigen::VectorXd rest_ = Eigen::VectorXd::Zero(6);
  dynamics::Response response_;
};

// The reference at one time is a start at that time, as for the stroke in given_gap_test.cpp.
TEST(CycleScale, ThePressureOfItsSqueezeIsOfSecondOrder) {
  const double begin = 1e-3, end = 5e-3;
  const PistonLinerOptions options = breathing_bore();
  const double exact = March(options, end - 1e-9).pressure();
  const double still = [&] {
    PistonLinerOptions fixed = options;
    fixed.scaled_bore.clear();
    return March(fixed, end).pressure();
  }();
  EXPECT_GT(std::abs(exact - still), 0.02 * exact);  // the squeeze matters
  for (const dynamics::Tableau* A : {&dynamics::sdirk2(), &dynamics::tr_bdf2()}) {
    double last = 0.0;
    for (const int steps : {20, 40, 80}) {
      March march(options, begin);
      const double dt = (end - begin) / steps;
      for (int k = 0; k < steps; ++k) march.step(*A, begin + k * dt, dt);
      const double error = march.pressure() / exact - 1.0;
      std::printf("breathing bore %-7s steps=%3d error %+.1e order %.2f\n", A->name.c_str(), steps,
                  error, order(last, error));
      if (last != 0.0) {
        EXPECT_NEAR(order(last, error), 2.0, 0.3);
      }
      last = error;
    }
  }
}

TEST(CycleScale, OfBoreAndSkirtWidensAndNarrowsTheGapAndWorksOnTheLoad) {
  PistonLinerOptions options = breathing_bore();
  const double time = 2e-3, factor = 1.0 - std::cos(1.0);
  EXPECT_NEAR(March(options, time).gap(), 20e-6 + 1e-6 * factor, 1e-11);
  options.scaled_skirt = options.scaled_bore;
  options.scaled_bore.clear();
  March march(options, time);
  EXPECT_NEAR(march.gap(), 20e-6 - 1e-6 * factor, 1e-11);
  // Nothing moves but the skirt's wall: what its factor gives, the film loses.
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(6);
  const dynamics::Power power = march.element().power(rest, rest);
  EXPECT_GT(power.lost, 0.0);
  EXPECT_NEAR(power.input, power.lost, 1e-12 * power.lost);
}

TEST(CycleScale, ConstantIsTheShapeItself) {
  PistonLinerOptions constant = breathing_bore(), plain = constant;
  constant.scaled_bore[0].scale = [](double) { return ScaleState{0.5, 0.0}; };
  plain.bore_shapes = {plain.scaled_bore[0].shape};
  plain.bore_shapes[0].deviation *= 0.5;
  plain.scaled_bore.clear();
  EXPECT_EQ(March(constant, 0.0).gap(), March(plain, 0.0).gap());
  EXPECT_EQ(March(constant, 0.0).pressure(), March(plain, 0.0).pressure());
}

}  // namespace
}  // namespace clatter::film
