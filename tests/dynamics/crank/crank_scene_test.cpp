// SPDX-License-Identifier: GPL-3.0-or-later
// Engine scenes with a crankshaft.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "dynamics/crank/crank_component.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

constexpr const char* kDry = "[contact]\nlubrication = \"none\"\n";
// A full film damps what impacts of a dry piston would multiply.
constexpr const char* kFull = "[contact]\ncavitation = false\ncells_around = 4\ncells_along = 4\n";
constexpr const char* kOneCycle = "[time]\ncycles = 1\n";

/// [crank] with a mass and two bearings 120 mm apart, each with the keys `law`.
std::string in_bearings(const std::string& law, const std::string& more = "") {
  std::string text =
      "[crank]\nmass_kg = 40\ndiametral_kg_m2 = 1.5\npolar_kg_m2 = 0.6\ncentre_mm = 10\n" + more;
  for (const int x : {-60, 60})
    text += fmt::format("[[crank.bearing]]\nname = \"b{}\"\nat_mm = {}\n{}", x > 0 ? 2 : 1, x, law);
  return text;
}

std::string free_crank(double polar, const std::string& load = "") {
  return fmt::format("[crank]\nspeed = \"free\"\npolar_kg_m2 = {}\n{}", polar, load);
}

constexpr const char* kPlain =
    "diameter_mm = 85\nwidth_mm = 30\nclearance = 1e-3\nviscosity_mpa_s = 10\n";

class CrankScenes : public testing::SlapScenes {
 protected:
  std::vector<double> history(const H5File& file, const std::string& name) {
    return file.read_doubles("history/" + name);
  }
  /// A history at 1441 equal intervals of the reported cycle.
  std::vector<double> sampled(const H5File& file, const std::string& name) {
    const auto time = history(file, "time"), values = history(file, name);
    std::vector<double> found;
    size_t k = 0;
    for (int i = 0; i <= 1440; ++i) {
      const double t = time.front() + (time.back() - time.front()) * i / 1440.0;
      while (k + 2 < time.size() && time[k + 1] < t) ++k;
      const double share = (t - time[k]) / (time[k + 1] - time[k]);
      found.push_back((1.0 - share) * values[k] + share * values[k + 1]);
    }
    return found;
  }
  static double largest(const std::vector<double>& a, const std::vector<double>& b = {}) {
    double most = 0.0;
    for (size_t i = 0; i < a.size(); ++i)
      most = std::max(most, std::abs(a[i] - (b.empty() ? 0.0 : b[i])));
    return most;
  }
};

TEST_F(CrankScenes, AFreeCrankTendsToThePrescribedOneAsItsInertiaGrows) {
  const auto lateral = [&](const std::string& crank, const std::string& name) {
    return sampled(
        recorded(scene(std::string(kFull) + kOneCycle + "[accuracy]\ntolerance = 1e-6\n" + crank),
                 name),
        "piston_lateral");
  };
  const auto ideal = lateral("", "ideal");
  double first = 0.0;
  // The deviation is T/(J w^2), 1e-3 rad at 10 kg m2. Where two runs take other steps, the
  // tolerance is between them: 6e-11 m with 1e-4.
  for (const double polar : {10.0, 100.0, 1000.0, 1e4, 1e5}) {
    const double difference =
        largest(lateral(free_crank(polar), fmt::format("free{}", polar)), ideal);
    std::printf("%6.0f kg m2: piston %.3e m from that of a prescribed crank\n", polar, difference);
    if (first == 0.0) first = difference * polar;
    EXPECT_NEAR(difference * polar, first, 0.05 * first);
  }
  EXPECT_LT(largest(lateral(free_crank(9e8), "huge"), ideal), 1e-9);
}

TEST_F(CrankScenes, StiffBearingsTendToTheIdealCrank) {
  const auto run = [&](const std::string& crank, const std::string& name) {
    return recorded(
        scene(std::string(kFull) + kOneCycle + "[accuracy]\ntolerance = 1e-3\n" + crank), name);
  };
  const auto ideal = sampled(run("", "ideal"), "crank_pin_force_z");
  double last = 0.0, apart = 0.0;
  // Far above the frequency of the load, 100 rad/s: 40 kg on 1e10 N/m have 2e4 rad/s.
  for (const double k : {1e10, 1e11, 1e12}) {
    const auto law =
        fmt::format("stiffness_n_m = {}\ndamping_n_s_m = {}\n", k, 1e6 * std::sqrt(k / 1e10));
    const H5File file = run(in_bearings(law), fmt::format("k{:g}", k));
    const double moved = largest(history(file, "crankshaft_z"));
    apart = largest(sampled(file, "crank_pin_force_z"), ideal) / largest(ideal);
    std::printf("%.0e N/m: crank moves by %.3e m, force of its pin %.1e from the ideal one\n", k,
                moved, apart);
    if (last > 0.0) {
      EXPECT_NEAR(moved, 0.1 * last, 0.02 * last);
    }
    last = moved;
  }
  EXPECT_LT(apart, 0.01);  // of steps at this tolerance
}

TEST_F(CrankScenes, JournalsOrbitInFilmsAsInImpedances) {
  double z[3];
  int i = 0;
  for (const char* model : {"film", "butenschoen", "moes"}) {
    const H5File file = recorded(
        scene(kDry + in_bearings(std::string("model = \"") + model + "\"\n" + kPlain)), model);
    const auto e = history(file, "bearing_crankshaft_b1_eccentricity");
    const auto offset_y = history(file, "bearing_crankshaft_b1_offset_y");
    const auto offset_z = history(file, "bearing_crankshaft_b1_offset_z");
    double most = 0.0;
    for (size_t k = 0; k < e.size(); ++k) {
      EXPECT_NEAR(e[k], std::hypot(offset_y[k], offset_z[k]) / 42.5e-6, 1e-5);
      most = std::max(most, e[k]);
    }
    z[i] = *std::min_element(offset_z.begin(), offset_z.end());
    std::printf("%-12s e up to %.4f, lowest %.2f um, %lld steps, energy residue %.1e\n", model,
                most, 1e6 * z[i], result_.statistics.accepted, result_.energy_residue);
    EXPECT_GT(most, 0.5);
    EXPECT_LT(most, 1.0);
    EXPECT_LT(result_.energy_residue, 3e-3);
    // Friction of the journals is lost, and the drive works for it.
    EXPECT_LT(largest(history(file, "bearing_crankshaft_b1_force_x")), 1e-12);
    ++i;
  }
  // Of the smallest gap, where the impedances differ.
  EXPECT_NEAR(z[1], z[0], 0.15 * 42.5e-6);
  EXPECT_NEAR(z[2], z[0], 0.15 * 42.5e-6);
}

TEST_F(CrankScenes, ACrankThatTurnsBackwardIsTheMirrorImage) {
  const std::string crank =
      std::string(kDry) + kOneCycle +
      in_bearings(std::string("model = \"moes\"\n") + kPlain, "speed = \"free\"\n") +
      "[[crank.unbalance]]\nat_mm = 30\nmoment_kg_m = 0.01\n";
  const H5File forward = recorded(scene(crank), "forward");
  const H5File backward =
      recorded(scene(crank + "[engine]\nrotation = \"backward\"\n"), "backward");
  for (const auto& [name, sign] :
       std::map<std::string, double>{{"piston_lateral", -1.0},
                                     {"crankshaft_y", -1.0},
                                     {"crankshaft_z", 1.0},
                                     {"crankshaft_tilt_y", 1.0},
                                     {"crank_deviation", 1.0},
                                     {"bearing_crankshaft_b1_friction", -1.0}}) {
    const auto a = history(forward, name);
    auto b = history(backward, name);
    for (double& value : b) value *= sign;
    EXPECT_GT(largest(a), 0.0);
    ASSERT_EQ(a.size(), b.size());
    EXPECT_LT(largest(a, b), 1e-6 * largest(a)) << name;  // impacts of the piston multiply rounding
  }
}

TEST_F(CrankScenes, FourPistonsTurnAFreeCrankWithTheirOrders) {
  std::string four = std::string(kFull) + "[time]\ncycles = 8\n[accuracy]\ntolerance = 1e-2\n" +
                     free_crank(1.2, "[crank.load]\nlaw = \"mean\"\n");
  const int firing[] = {0, 540, 180, 360};
  for (int k = 0; k < 4; ++k)
    four += fmt::format("[[cylinder]]\nname = \"c{}\"\nfiring_deg = {}\n", k + 1, firing[k]);
  const H5File file = recorded(scene(four), "four");
  const auto deviation = sampled(file, "crank_deviation"), speed = sampled(file, "crank_speed");
  const double mean = 2000.0 * std::numbers::pi / 30.0;
  // It repeats after 180 deg: orders 2, 4, ..
  const size_t quarter = (deviation.size() - 1) / 4;
  const double most = largest(deviation);
  double apart = 0.0, sum = 0.0;
  for (size_t i = 0; i + quarter < deviation.size(); ++i)
    apart = std::max(apart, std::abs(deviation[i] - deviation[i + quarter]));
  for (size_t i = 0; i + 1 < speed.size(); ++i) sum += speed[i] - mean;
  sum /= static_cast<double>(speed.size() - 1);
  std::printf("deviation up to %.3f mrad, %.1e of it apart, mean speed %+.1e, residue %.1e\n",
              1e3 * most, apart / most, sum / mean, result_.energy_residue);
  EXPECT_GT(most, 1e-4);
  EXPECT_LT(apart, 0.05 * most);
  EXPECT_LT(std::abs(sum), 1e-4 * mean);
  EXPECT_LT(result_.energy_residue, 1e-3);
}

TEST_F(CrankScenes, AreRefusedWithTheKeyThatIsWrong) {
  const auto expect = [&](const std::string& changes, const std::string& said) {
    EXPECT_NE(refusal(changes).find(said), std::string::npos) << changes << refusal(changes);
  };
  const std::string plain = std::string("model = \"film\"\n") + kPlain;
  EXPECT_EQ(refusal(in_bearings(plain)), "accepted");
  EXPECT_EQ(refusal(free_crank(1.0)), "accepted");
  expect("[crank]\npolar_kg_m2 = 40\n",
         "crank.bearing: give [[crank.bearing]] or speed = \"free\"");
  expect("[crank]\nspeed = \"free\"\n", "crank.polar_kg_m2: is missing, speed = \"free\" needs it");
  expect(free_crank(-1.0), "crank.polar_kg_m2: found -1, expected");
  expect(in_bearings("stiffness_n_m = -1\n"), "crank.bearing[0].stiffness_n_m: found -1, expected");
  expect(in_bearings(std::string("model = \"moes\"\n") + "diameter_mm = 85\nwidth_mm = 30\n" +
                     "clearance = -1e-3\nviscosity_mpa_s = 10\n"),
         "crank.bearing[0].clearance: found -0.001, expected");
  expect(in_bearings("model = \"table\"\ntable = \"none.csv\"\n"), "none.csv");
  expect(
      "[crank]\nmass_kg = 40\ndiametral_kg_m2 = 0.1\npolar_kg_m2 = 0.6\ncentre_mm = 10\n"
      "[[crank.bearing]]\nname = \"b\"\nat_mm = 0\nstiffness_n_m = 1e8\n",
      "crank.diametral_kg_m2: found 0.1, expected at least 0.3");
  expect(
      "[crank]\nmass_kg = 40\ndiametral_kg_m2 = 1\ncentre_mm = 10\n"
      "[[crank.bearing]]\nname = \"b\"\nstiffness_n_m = 1e8\n",
      "crank.bearing[0].at_mm: found nothing, expected the bearing's x");
  expect(in_bearings(plain) + "[[crank.bearing]]\nname = \"b1\"\nat_mm = 0\nstiffness_n_m = 1e8\n",
         "crank.bearing[2].name: found \"b1\" after a bearing \"b1\"");
  expect(in_bearings(plain) + "[crank.load]\ntorque_n_m = 3\n",
         "crank.load: needs speed = \"free\": with a prescribed speed the torque is a result");
  expect(free_crank(1.0) + "[[crank.unbalance]]\nat_mm = 0\nmoment_kg_m = 1\n",
         "crank.unbalance: needs bearing");
  expect(free_crank(1.0) + "[crank.load]\nlaw = \"constant\"\n",
         "crank.load.torque_n_m: is missing, law = \"constant\"");
  const std::string elastic = testing::kElasticBlock;
  expect(elastic + in_bearings(plain),
         "crank.bearing[0].set: found nothing, expected a set of the block");
  expect(elastic + in_bearings(plain + "set = \"main_9\"\n"), "main_9");
  expect(elastic + in_bearings(plain + "set = \"sensor\"\n"),
         "\"sensor\" is 219.3 mm beside the crank's axis");
}

TEST_F(CrankScenes, ALoadThatDoesNotHoldTheSpeedEndsTheRunByName) {
  const Scene described = scene(
      std::string(kDry) + free_crank(0.05, "[crank.load]\nlaw = \"constant\"\ntorque_n_m = 900\n"));
  RunControl control;
  control.output = folder_ / "lost.run.h5";
  const RunResult result = simulate(described, load_bodies(described), control);
  EXPECT_FALSE(result.complete);
  EXPECT_NE(result.failure.find("crankshaft: its load does not hold the speed of the clock"),
            std::string::npos)
      << result.failure;
}

TEST_F(CrankScenes, AResumedRunHasTheFilmsAndTheLoadOfTheFirst) {
  const std::string crank = std::string(kDry) + "[accuracy]\ntolerance = 1e-2\n" +
                            in_bearings(std::string("model = \"film\"\ncells_around = 24\n"
                                                    "cells_along = 3\n") +
                                            kPlain,
                                        "speed = \"free\"\n");
  const Scene described = scene(crank);
  const LoadedBodies bodies = load_bodies(described);
  RunControl control;
  control.output = folder_ / "whole.run.h5";
  RunResult whole = simulate(described, bodies, control);
  const auto point = read_checkpoint(checkpoint_path(control.output), fingerprint(described));
  ASSERT_TRUE(point.has_value());
  const auto a =
      testing::finished_file(described, bodies, whole).read_doubles("history/crank_deviation");
  control.output = folder_ / "again.run.h5";
  std::filesystem::copy_file(checkpoint_path(folder_ / "whole.run.h5"),
                             checkpoint_path(control.output));
  control.resume_from = point;
  RunResult again = simulate(described, bodies, control);
  const auto b =
      testing::finished_file(described, bodies, again).read_doubles("history/crank_deviation");
  EXPECT_EQ(a, b);
  // Cycles that are recorded together move the same.
  const Scene both = scene("[time]\nrecord_cycles = 2\n" + crank);
  control = {};
  control.output = folder_ / "both.run.h5";
  RunResult result = simulate(both, bodies, control);
  const auto c =
      testing::finished_file(both, bodies, result).read_doubles("history/crank_deviation");
  ASSERT_GT(c.size(), a.size());
  EXPECT_TRUE(std::equal(a.begin(), a.end(), c.end() - std::ssize(a)));
}

}  // namespace
}  // namespace clatter::dynamics
