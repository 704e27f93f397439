// SPDX-License-Identifier: GPL-3.0-or-later
// All elements of valves on a shaft: tangents, balance of forces, cost of an evaluation.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "tests/dynamics/mechanisms.hpp"
#include "tests/dynamics/valve_model.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::VectorXd;

/// The state some steps after the start, when all contacts have their forces.
VectorXd settled(System& system, VectorXd& v) {
  StepOptions options;
  options.largest = 1e-5;
  const auto method = testing::started(system, options);
  for (int i = 0; i < 300; ++i) method->step(1.0);
  v = method->state().v_y;
  return method->state().y;
}

TEST(ValveTrain, TheTangentOfEachElementIsTheDerivativeOfItsForce) {
  for (const char* model : {"full", "rigid"}) {
    const auto valves = testing::valves_on_a_shaft(model, 1700.0, 3);
    System& system = valves->system();
    VectorXd v;
    const VectorXd y = settled(system, v);
    int tested = 0;
    for (int e = 0; e < system.elements(); ++e) {
      ForceElement& element = system.element(e);
      if (element.name().rfind("valve ", 0) != 0 || element.name().find("watch") < 99) continue;
      ++tested;
      Response response;
      element.evaluate({0.1, 1e-5, 1, {}}, gather(y, element.coordinates()),
                       gather(v, element.coordinates()), true, response);
      if (response.force.isZero(0.0)) continue;  // the seat of an open valve
      // Differences of 1 nm and of 1e-12 kg: 1e-3 of the content's own scale.
      const bool oil = element.name().find("adjuster") != std::string::npos;
      EXPECT_LT(testing::tangent_error(element, gather(y, element.coordinates()),
                                       gather(v, element.coordinates()), oil ? 1e-12 : 1e-9, 1e-5),
                oil ? 2e-3 : 2e-4)
          << element.name();
    }
    EXPECT_EQ(tested, 18);
  }
}

TEST(ValveTrain, CostOfAnEvaluationOfTwelveValves) {
  for (const char* model : {"full", "rigid"}) {
    const auto valves = testing::valves_on_a_shaft(model, 1700.0, 12);
    System& system = valves->system();
    VectorXd v;
    const VectorXd y = settled(system, v);
    Response response;
    for (const bool tangent : {false, true}) {
      double best = 1e9;
      for (int repeat = 0; repeat < 20; ++repeat) {
        double sum = 0.0;
        for (int e = 0; e < system.elements(); ++e) {
          ForceElement& element = system.element(e);
          if (element.name().rfind("valve ", 0) != 0) continue;
          const VectorXd at = gather(y, element.coordinates()),
                         rate = gather(v, element.coordinates());
          element.evaluate({0.1, 1e-6, 1, {}}, at, rate, tangent, response);
          const auto begin = std::chrono::steady_clock::now();
          for (int i = 0; i < 10; ++i)
            element.evaluate({0.1, 1e-6, 1, {}}, at, rate, tangent, response);
          const std::chrono::duration<double, std::micro> time =
              std::chrono::steady_clock::now() - begin;
          sum += 0.1 * time.count();
        }
        best = std::min(best, sum);
      }
      std::printf("12 valves, shaft %s, %s: %.1f us\n", model, tangent ? "with tangent" : "force",
                  best);
      EXPECT_LT(best, 1000.0);  // a bound of sanity: the machine is shared
    }
  }
}

}  // namespace
}  // namespace clatter::dynamics
