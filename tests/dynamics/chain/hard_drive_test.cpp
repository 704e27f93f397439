// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases of the timing drive of the reference.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "dynamics/given/drive.hpp"
#include "dynamics/integrate/equilibrium.hpp"
#include "dynamics/run/energy.hpp"
#include "dynamics/run/start_state.hpp"
#include "tests/dynamics/chain/running_drive.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/observed.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

using test::expect_parts;
using test::refusal_of;
using testing::RunningDrive;
using testing::TimingDrive;

TimingDrive with_friction_and_play() {
  TimingDrive drive;
  drive.friction = 0.08;
  drive.joint_clearance_um = 12.5;
  return drive;
}

/// Means over the steps from now to a time.
std::vector<double> means(RunningDrive& drive, double until,
                          const std::vector<std::string>& names) {
  std::vector<double> sums(names.size(), 0.0);
  double before = drive.method->state().time;
  const double begin = before;
  drive.run(until, [&] {
    const double now = drive.method->state().time;
    for (size_t i = 0; i < names.size(); ++i) sums[i] += (now - before) * drive.history(names[i]);
    before = now;
  });
  for (double& sum : sums) sum /= until - begin;
  return sums;
}

TEST(HardTD1_Assembly, APlunger3mmBackIsSlackAtTheStartAndFindsItsEquilibrium) {
  for (TimingDrive drive : {TimingDrive(), with_friction_and_play()}) {
    drive.plunger_back_mm = 3.0;
    RunningDrive one(drive);
    const auto model = build_model(one.scene, {}, true);
    const Equilibrium found = find_equilibrium(model->system, 0.0, model->system.eta_start());
    EXPECT_TRUE(found.found);
    test::expect_at_most("residual of the equilibrium [N]", found.residual, 1e-6);
    EXPECT_LT(found.iterations, 300);
  }
}

TEST(HardTD1_Assembly, LongAndShortLinksStiffJointsAndOtherPhasesFindTheirEquilibrium) {
  // Coarse, as meant, fine; the oil's check valve opens at the pressure of rest.
  struct Case {
    double finer, joint_n_m, gap_deg;
  };
  for (const Case& one : {Case{0.4, 1e7, -20.94}, Case{0.4, 6e7, -9.69}, Case{0.6, 1e7, -13.44},
                          Case{0.6, 6e7, -20.94}, Case{0.8, 6e7, -20.94}, Case{1.0, 6e7, -20.94},
                          Case{1.0, 1e7, -16.44}, Case{2.0, 6e7, -20.94}, Case{2.0, 1e7, -18.69},
                          Case{4.0, 1e7, -20.94}}) {
    TimingDrive drive;
    drive.tensioner = "start_travel_mm = 0\n";
    drive.friction = 0.08;
    drive.finer = one.finer;
    drive.joint_n_m = one.joint_n_m;
    drive.gap_deg = one.gap_deg;
    RunningDrive running(drive);
    const auto model = build_model(running.scene, {}, true);
    const Equilibrium found = find_equilibrium(model->system, 0.0, model->system.eta_start());
    EXPECT_TRUE(found.found) << one.finer << " " << one.joint_n_m << " " << one.gap_deg;
    EXPECT_LT(found.residual, 1e-6);
    EXPECT_LT(found.iterations, 300) << one.finer << " " << one.joint_n_m << " " << one.gap_deg;
  }
}

TEST(HardTD1_Assembly, LooseJointsOfFineLinksArePulledTaut) {
  // 520 links of 2 mm with 12.5 um of play: 13 mm more chain than the arm takes up at the start.
  TimingDrive drive = with_friction_and_play();
  drive.finer = 4.0;
  RunningDrive one(drive);
  const auto model = build_model(one.scene, {}, true);
  const Equilibrium found = find_equilibrium(model->system, 0.0, model->system.eta_start());
  EXPECT_TRUE(found.found);
  test::expect_at_most("residual of the equilibrium of loose joints [N]", found.residual, 1e-6);
}

TEST(HardTD1_Assembly, AChainWithoutEquilibriumIsAnErrorThatNamesTheSpan) {
  // A moment of 300 N m on the exhaust wheel: 5.9 kN, against which the slack side holds nothing.
  TimingDrive drive = with_friction_and_play();
  drive.more = "[[load]]\nbody = \"exhaust\"\ncomponent = \"rz\"\nvalue = 300\n";
  RunningDrive one(drive);
  expect_parts(
      refusal_of<NumericsError>([&] { one.start(); }),
      {"no static equilibrium after", "unbalanced, most of it on ", "chain link", "guide"});
}

TEST(HardTD1_Assembly, AStateThatAnElementRefusesIsAnErrorWithItsReason) {
  // The chain on the teeth of the exhaust wheel instead of in its gaps.
  std::string shifted = TimingDrive().scene();
  const std::string key = "turn = \"clockwise\"\nteeth = 40\n";
  shifted.replace(shifted.rfind(key), key.size(), key + "gap_deg = 4.5\n");
  const Scene scene = testing::scene_of(shifted, testing::test_folder());
  const auto model = build_model(scene, {});
  expect_parts(
      refusal_of<NumericsError>([&] { start_state(scene, {}, *model); }),
      {"no static equilibrium after 0 iterations: chain exhaust: a link is too deep in the "
       "profile, link"});
}

TEST(HardTD1_Assembly, AChainTooLongOrTooShortAndWheelsThatOverlapAreRefusedByName) {
  for (const int links : {124, 136}) {
    TimingDrive drive;
    drive.links = links;
    expect_parts(
        refusal_of([&] { RunningDrive one(drive); }),
        {"drive.run.toml", "the way around crank, arm, intake, exhaust, guide is 1042.03 mm",
         fmt::format("the chain {} mm", 8 * links), "130 links are nearest"});
  }
  const std::string text = TimingDrive().scene(), exhaust = "at_mm = [60, 326, 0]";
  std::string near = text;
  near.replace(near.rfind(exhaust), exhaust.size(), "at_mm = [-60, 326, 0]");
  expect_parts(refusal_of([&] { testing::scene_of(near, testing::test_folder()); }),
               {"drive.run.toml", "no straight span joins intake and exhaust"});
}

TEST(HardTD8_WornChain, RunsWithHalfAMillimetreOfPlayInEveryJoint) {
  TimingDrive drive = with_friction_and_play();
  drive.joint_clearance_um = 500.0;
  drive.links = 124;  // 992 mm, 1054 mm to the end of its play
  drive.rpm = 3400.0;
  RunningDrive one(drive);
  one.start();
  one.run(2e-3);
  EXPECT_TRUE(one.method->state().y.allFinite());
  EXPECT_GT(one.history("chain_tension_max"), 50.0);
  test::expect_at_most("largest tension of the worn chain [N]", one.history("chain_tension_max"),
                       1000.0);
  EXPECT_EQ(one.history("chain_jumps"), 0.0);
}

TEST(HardTD9_ReversedRotation, TheMirroredDriveMirrorsTheResultToRounding) {
  TimingDrive drive = with_friction_and_play();
  drive.rpm = 3400.0;
  TimingDrive other = drive;
  other.mirrored = true;
  RunningDrive one(drive), mirror(other);
  one.start();
  mirror.start();
  for (int i = 1; i <= 10; ++i) {
    one.run(i * 1e-4);
    mirror.run(i * 1e-4);
    EXPECT_EQ(one.steps, mirror.steps);
    double worst = 0.0;
    for (const char* name : {"chain_tension_min", "chain_tension_max", "chain_guide_depth",
                             "chain_tension_guide_crank", "bushing_exhaust_force_y"})
      worst = std::max(worst, std::abs(one.history(name) - mirror.history(name)));
    for (const char* name : {"chain_guide_force_x", "chain_crank_force_x"})
      worst = std::max(worst, std::abs(one.history(name) + mirror.history(name)));
    // The rounding of positions, 1e-16 m, by the stiffness of joints and contacts is 1e-8 N; steps
    // multiply it.
    test::expect_at_most("difference of the mirrored drive", worst, 1e-5);
    EXPECT_NEAR(one.y("exhaust", 2), -mirror.y("exhaust", 2), 1e-14);
  }
}

TEST(HardTD10_ChainAt12000Rpm, LeavesTheGuidesWhereThePlungerIsBlocked) {
  // The tension of the chain at rest, 185 N, holds it on the guides up to v = sqrt(T / m), 24.85
  // m/s or 9320 rpm; at 8000 rpm with a quarter of the force at rest.
  TimingDrive drive;
  drive.plunger_n_m = 1e9;
  drive.plunger_back_mm = -0.69748;
  const std::vector<std::string> names{"chain_arm_force_x", "chain_guide_force_x",
                                       "chain_guide_contacts"};
  RunningDrive rest(drive);
  rest.start();
  const double at_rest = rest.history(names[0]);
  double share[2] = {};
  for (const int i : {0, 1}) {
    drive.rpm = i == 0 ? 6000.0 : 8000.0;
    RunningDrive one(drive);
    one.start();
    one.run(2e-3);
    share[i] = means(one, 4e-3, names)[0] / at_rest;
  }
  // The share of the force falls with the square of the speed, to 0 at v. The waves of the start
  // still run, so the mean of 2 ms has some percent.
  const double slope = (share[0] - share[1]) / (64.0 - 36.0),
               lost = 1e3 * std::sqrt(64.0 + share[1] / slope);
  test::expect_at_most("error of the speed at which the chain leaves",
                       std::abs(lost / 9320.0 - 1.0), 0.06);

  drive.rpm = 12000.0;
  RunningDrive fast(drive);
  fast.start();
  const double guide = rest.history(names[1]), links = rest.history(names[2]);
  fast.run(2e-3);
  const std::vector<double> found = means(fast, 4e-3, names);
  test::expect_at_most("force on the guides, of that at rest", found[0] / at_rest, 0.06);
  EXPECT_LT(found[1] / guide, 0.25);
  EXPECT_LT(found[2], 0.1 * links);
  // On the teeth: without jumps, and the wheels turn with the crank.
  EXPECT_EQ(fast.history("chain_jumps"), 0.0);
  EXPECT_NEAR(fast.rate("exhaust", 2), -200.0 * std::numbers::pi, 0.02 * 200.0 * std::numbers::pi);
}

TEST(HardTD10_ChainAt12000Rpm, StaysOnGuidesAndTeethWhereThePlungerIsFree) {
  // The chain leaves the guides at first, as its tension at rest is less than m v^2, 307 N; then
  // the plunger has followed.
  TimingDrive drive;
  drive.friction = 0.08;
  drive.rpm = 12000.0;
  RunningDrive one(drive);
  one.start();
  one.run(9e-3);
  const std::vector<double> found =
      means(one, 13e-3,
            {"chain_guide_contacts", "chain_arm_contacts", "chain_crank_contacts",
             "chain_exhaust_contacts", "chain_intake_contacts", "chain_tension_min"});
  EXPECT_GT(found[0], 8.0);
  EXPECT_GT(found[1], 8.0);
  for (const size_t i : {2, 3, 4}) EXPECT_GT(found[i], 4.0) << i;
  EXPECT_GT(found[5], 300.0);
  EXPECT_EQ(one.history("chain_jumps"), 0.0);
}

TEST(HardTD11_Friction, TheDriveConvergesAsTheRegularisationSpeedFalls) {
  std::vector<double> found;
  for (const double slip_speed : {0.16, 0.08, 0.04, 0.02, 0.01}) {
    TimingDrive drive;
    drive.friction = 0.08;
    drive.rpm = 3400.0;
    drive.tolerance = 1e-4;
    drive.slip_speed_m_s = slip_speed;
    RunningDrive one(drive);
    one.start();
    found.push_back(means(one, 5e-4, {"chain_tension_guide_crank"})[0]);
  }
  // 0.18, 0.12, 0.04, 0.01 N of 187.
  for (size_t i = 2; i < found.size(); ++i)
    EXPECT_LT(std::abs(found[i] - found[i - 1]), 0.8 * std::abs(found[i - 1] - found[i - 2])) << i;
  test::expect_at_most("change by the last halving of the speed",
                       std::abs(found[4] - found[3]) / found[4], 1e-4);
}

TEST(HardTD12_StoppedCrank, EnergyOnlyFalls) {
  TimingDrive drive = with_friction_and_play();
  drive.exhaust_spin = 20.0;
  drive.tolerance = 1e-4;
  RunningDrive one(drive);
  EnergyBalance energy(one.model->system, *one.scene.steps.method);
  one.method->set_observer(&energy);
  one.start();
  const double begin = energy.now().stored();
  double before = begin, most = 0.0;
  one.run(4e-3, [&] {
    const double now = energy.now().stored();
    most = std::max(most, now - before);
    before = now;
  });
  EXPECT_EQ(most, 0.0);
  EXPECT_LT(before, begin - 0.05);
  EXPECT_EQ(energy.now().input, 0.0);
  test::expect_at_most("energy residue of a stopped crank", energy.residue(), 1e-4);
}

TEST(HardTD14_HoursOfAngle, ADriveKeepsItsDigitsAfterAMillionTurns) {
  const double speed = 3400.0 * std::numbers::pi / 30.0, step = 3e-6;
  const Drive drive(-speed);
  // Five hours; times are multiples of 2^-38 s there, so that their differences are exact.
  for (double time = 17647.0; time < 17647.0 + 100 * step; time += step) {
    const double next = time + step;
    const double turned = drive.at(next).position - drive.at(time).position;
    EXPECT_NEAR(std::remainder(turned, 2.0 * std::numbers::pi), -speed * (next - time), 1e-14);
  }
  const Drive turned(-speed, 2.0e6 * std::numbers::pi);
  // The argument of a million turns has 5e-10 rad.
  test::expect_at_most("difference after a million turns [m]",
                       std::abs(turned.at(1.0).position - drive.at(1.0).position), 1e-9);
}

TEST(HardTD14_HoursOfAngle, TheDriveStartsAfter2777TurnsAsAfterNone) {
  TimingDrive drive = with_friction_and_play();
  drive.rpm = 3400.0;
  TimingDrive later = drive;
  later.start_turns = 2776.0;
  RunningDrive one(drive), other(later);
  one.start();
  other.start();
  one.run(3e-4);
  other.run(3e-4);
  // Angles of 1.7e4 rad have 2e-12 rad, 1e-13 m at the teeth.
  for (const char* name : {"chain_tension_max", "chain_crank_force_x", "chain_exhaust_force_y"})
    EXPECT_NEAR(one.history(name), other.history(name), 2e-5) << name;
}

}  // namespace
}  // namespace clatter::dynamics
