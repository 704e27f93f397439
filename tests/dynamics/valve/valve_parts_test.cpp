// SPDX-License-Identifier: GPL-3.0-or-later
// All elements of valves on a shaft: tangents and balance of forces.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace clatter::dynamics
