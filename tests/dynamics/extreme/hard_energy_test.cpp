// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases S1, S8 and S9: energy that no load or damper accounts for, and what grows rightly.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "tests/dynamics/extreme/extreme_scene.hpp"

namespace clatter::dynamics {
namespace {

using testing::joint;
using testing::slider;
using testing::span;
using HardS1 = testing::ExtremeScenes;
using HardS8 = testing::ExtremeScenes;
using HardS9 = testing::ExtremeScenes;

// 1 kg at 1 m/s on 1e4 N/m: 0.5 J pass from the body to the spring and back.
TEST_F(HardS1, AnUndampedOscillatorShowsWhatItsStepsLose) {
  double before = 0.0;
  for (const double tolerance : {1e-2, 1e-4}) {
    const H5File file =
        recorded(span(0.1, tolerance) + slider("b", 1.0, 1.0) + joint("b", "", 1e4));
    const double energy =
        file.read_doubles("energy/kinetic").back() + file.read_doubles("energy/element").back();
    EXPECT_NEAR(result_.energy_exchanged, 0.5, 0.01);
    // Before, the residue of a motion without losses was 0 whatever its steps did.
    test::expect_at_most("difference of residue and lost part of the energy",
                         std::abs(result_.energy_residue - std::abs(energy - 0.5) / 0.5), 1e-4);
    test::expect_at_least("residue", result_.energy_residue, 1e-7);
    if (before > 0.0)
      test::expect_at_most("residue over that of a hundredfold tolerance",
                           result_.energy_residue / before, 0.1);
    before = result_.energy_residue;
  }
}

// The oscillation of two bodies on a joint of 1e16 N/m is too fast for any step: they go on
// together, as after a plastic impact, which loses half of the energy. The balance says so.
TEST_F(HardS1, ABlowThatAStiffJointTakesIsUnbalanced) {
  recorded(span(0.01) + slider("b", 1.0) + slider("c", 1.0, 1.0) + joint("b", "c", 1e16));
  test::expect_at_least("residue", result_.energy_residue, 0.9);
}

// A joint of 1e16 N/m beside one of 1 N/m: a slow oscillator of 2 kg.
TEST_F(HardS9, StiffnessesOfARatioOf1e16GiveTheSlowMotion) {
  const double end = 0.5, w = std::sqrt(0.5);
  const H5File file = recorded(span(end) + slider("b", 1.0, 1.0) + slider("c", 1.0, 1.0) +
                               joint("b", "c", 1e16) + joint("b", "", 1.0));
  const double expected = std::sin(w * end) / w;
  test::expect_at_most("error of the motion",
                       std::abs(last(file, "c_travel") - expected) / expected, 1e-6);
  test::expect_at_most("steps", static_cast<double>(result_.statistics.accepted), 1000.0);
}

// 1e-6 kg on 1e3 kg: the light one is carried along, and takes no momentum of the heavy one.
TEST_F(HardS9, MassesOfARatioOf1e9MoveTogether) {
  const H5File file =
      recorded(span(0.1) + slider("b", 1e-6) + slider("c", 1e3, 1.0) + joint("b", "c", 1e3, 1e-1));
  // c' = 1 but for the momentum of b; b follows after some 10 us.
  test::expect_at_most("error of the heavy body", std::abs(last(file, "c_travel") - 0.1), 1e-9);
  test::expect_at_most("error of the light body", std::abs(last(file, "b_travel") - 0.1), 2e-6);
}

// Damping that turns with a shaft drives its whirl above the critical speed:
//   lambda^2 + c/m (lambda - i Omega) + k/m = 0.
// A mass on such a joint goes out of any bounds, and that is right.
TEST_F(HardS8, DampingThatTurnsWithAShaftDrivesItsWhirlAsTheoryGives) {
  constexpr double kStiffness = 1e6, kDamping = 1e3;
  const auto growth = [&](double rpm) {
    const H5File file = recorded(span(0.02) + fmt::format(R"(
[[rigid_body]]
name = "b"
motion = "xy"
mass_kg = 1
inertia_kg_m2 = 1
centre_mm = [0, 100, 0]
[[drive]]
name = "d"
axis = "z"
speed_rpm = {}
[[bushing]]
a = {{ body = "b", at_mm = [0, 100, 0] }}
b = {{ body = "d", at_mm = [0, 100, 0] }}
stiffness_n_m = {}
damping_n_s_m = {}
)",
                                                          rpm, kStiffness, kDamping));
    const auto time = file.read_doubles("history/time"), x = file.read_doubles("history/b_x"),
               y = file.read_doubles("history/b_y");
    const auto from =
        static_cast<size_t>(std::lower_bound(time.begin(), time.end(), 0.015) - time.begin());
    return std::log(std::hypot(x.back(), y.back()) / std::hypot(x[from], y[from])) /
           (time.back() - time[from]);
  };
  const double spin = 20000.0 * std::numbers::pi / 30.0;
  const std::complex<double> root =
      std::sqrt(std::complex<double>(0.25 * kDamping * kDamping - kStiffness, kDamping * spin));
  const double expected = root.real() - 0.5 * kDamping;
  EXPECT_GT(expected, 300.0);
  const double forward = growth(20000.0);
  test::expect_at_most("error of the growth", std::abs(forward / expected - 1.0), 0.02);
  // Backward it is the mirror image.
  test::expect_at_most("difference of the reversed shaft",
                       std::abs(growth(-20000.0) / forward - 1.0), 1e-9);
  // Below the critical speed of 9549 rpm the whirl dies and the steady orbit stays.
  test::expect_at_most("growth below the critical speed", growth(6000.0), 20.0);
}

}  // namespace
}  // namespace clatter::dynamics
