// SPDX-License-Identifier: GPL-3.0-or-later
// A chain of 100 masses that collide through stiff unilateral contacts.
#include "tests/dynamics/impact_chain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "dynamics/integrate/integrator.hpp"

namespace clatter::dynamics {
namespace {

using testing::ImpactChain;
using testing::ImpactChainOptions;

/// What happened in a chain until a number of impacts, energies relative to that at the start.
struct Impacts {
  long long count = 0, steps = 0;
  double highest = 0.0, last = 0.0;  // energy
  double momentum = 0.0;             // largest, over the sum of |m v| at the start
};

/// Energy of a chain [J], and which pairs of neighbours touch.
struct Look {
  double energy = 0.0;
  std::vector<char> touching;
  Look(const System& system, const StageState& state) : energy(0.5 * state.v.squaredNorm()) {
    Eigen::VectorXd y, v;
    for (int e = 0; e < system.elements(); ++e) {
      const ForceElement& contact = system.element(e);
      gather(state.y, contact.coordinates(), y);
      gather(state.v_y, contact.coordinates(), v);
      const double stored = contact.power(y, v).stored;
      energy += stored;
      touching.push_back(stored > 0.0);
    }
  }
};

Impacts collide(const ImpactChainOptions& options, double tolerance, long long wanted) {
  ImpactChain chain(options);
  System& system = chain.system;
  StepOptions steps;
  steps.largest = 1e-4;
  steps.first = 1e-9;
  steps.accuracy = {tolerance, 1e-4, 1.0, 1.0};
  const auto method = make_integrator(system, steps);
  method->start(0.0, system.eta_start(), system.v_start());
  Look before(system, method->state());
  const double start = before.energy;
  const double speeds = options.mass * method->state().v_y.cwiseAbs().sum();
  Impacts found;
  while (found.count < wanted) {
    method->step(1.0);
    const StageState& now = method->state();
    Look after(system, now);
    for (size_t e = 0; e < after.touching.size(); ++e)
      found.count += after.touching[e] > before.touching[e];
    found.last = after.energy / start;
    if (std::none_of(after.touching.begin(), after.touching.end(), [](char one) { return one; }))
      found.highest = std::max(found.highest, found.last);
    found.momentum = std::max(found.momentum, std::abs(options.mass * now.v_y.sum()) / speeds);
    before = std::move(after);
  }
  found.steps = method->statistics().accepted;
  return found;
}

TEST(HardT1_UndampedStiffContact, AChainOf100MassesGainsNoEnergyInTenThousandImpacts) {
  // Neighbours approach each other in pairs, so that fifty impacts happen at a time.
  ImpactChainOptions options;
  options.alternating = true;
  const Impacts found = collide(options, 1e-5, 10000);
  std::printf("%lld impacts in %lld steps: energy 1 %+.2e, highest 1 %+.2e, momentum %.1e\n",
              found.count, found.steps, found.last - 1.0, found.highest - 1.0, found.momentum);
  // The velocity of a mass may err by 1e-5 of its speed in each of its 200 impacts: 4e-3 of the
  // energy, if all errors had the same sign. L-stability makes nearly all of it a loss.
  EXPECT_LT(found.highest, 1.0 + 5e-5);
  EXPECT_GT(found.last, 1.0 - 4e-3);
  EXPECT_LT(found.last, 1.0);
  // Action equals reaction, to the rounding of all steps.
  EXPECT_LT(found.momentum, 1e-10);
}

TEST(HardT1_UndampedStiffContact, WithDampingTheChainLosesEnergyAndNoMomentum) {
  ImpactChainOptions options;
  options.damping = 0.3;
  const Impacts found = collide(options, 1e-3, 200);
  EXPECT_LT(found.last, 0.9);
  EXPECT_LT(found.momentum, 1e-10);
}

}  // namespace
}  // namespace clatter::dynamics
