// SPDX-License-Identifier: GPL-3.0-or-later
// What happens at the angle and the speed of a free crank, and not at those of its clock.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <numbers>
#include <set>

#include "dynamics/given/load_table.hpp"
#include "dynamics/ring/ring_law.hpp"
#include "tests/dynamics/element_check.hpp"
#include "tests/dynamics/rod_truss.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::VectorXd;

constexpr double kClockSpeed = 2000.0 * std::numbers::pi / 30.0;  // of the clock [rad/s]
constexpr double kBore = 0.0535, kAmbient = 1e5;                  // radius [m], [Pa]
constexpr double kViscosity = 0.02, kReversal = 0.05;             // [Pa s], [m/s]

// All loads act from the start on: while inertia forces grow, motions depend on the clock.
constexpr const char* kAtOnce = "[time]\ncycles = 1\nramp_deg = 0\noutput_step_us = 50\n";

constexpr const char* kRing =
    "[[contact.ring]]\nheight_mm = 45\nface_radius_mm = 20\nload_n_mm = 1\nwidth_mm = 2.5\n"
    "thickness_mm = 4\ngas_share = 1\nfriction_coefficient = 0.1\n";

RingSpec ring() {
  RingSpec ring;
  ring.face_radius = 0.02;
  ring.load = 1e3;
  ring.width = 2.5e-3;
  ring.gas_share = 1.0;
  ring.boundary = 0.1;
  return ring;
}

/// A rigid slider-crank with flywheel under gas, the friction T of a ring, constant load:
///   J theta'' + J'(theta) theta'^2 / 2 = (T - (p - p_0) A) z'(theta) - L
class RigidEngine {
 public:
  RigidEngine(Spline gas, double polar, double load)
      : gas_(std::move(gas)), polar_(polar), load_(load) {}

  /// theta at ascending times [s], from -2 pi at the clock's angle and speed, by the classical
  /// method of fourth order in steps of at most 2 us.
  std::vector<double> angles(const std::vector<double>& times) const {
    std::vector<double> found;
    double q = -2.0 * std::numbers::pi, v = kClockSpeed, last = q / kClockSpeed;
    for (const double time : times) {
      const double span = time - last;
      last = time;
      const int parts = static_cast<int>(std::ceil(span / 2e-6));
      const double h = span / parts;
      for (int k = 0; k < parts; ++k) {
        const double a1 = rate(q, v), v2 = v + 0.5 * h * a1;
        const double a2 = rate(q + 0.5 * h * v, v2), v3 = v + 0.5 * h * a2;
        const double a3 = rate(q + 0.5 * h * v2, v3), v4 = v + h * a3;
        const double a4 = rate(q + h * v3, v4);
        q += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
        v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
      }
      found.push_back(q);
    }
    return found;
  }

 private:
  double rate(double q, double v) const {
    constexpr double r = 0.065, l = 0.21, d = 0.07, piston = 1.9, rod = 2.2, inertia = 0.02,
                     area = 8.992e-3;
    const double s = std::sin(q), c = std::cos(q);
    const double sine = -r * s / l, cosine = std::sqrt(1.0 - sine * sine);
    const double phi_1 = -r * c / (l * cosine), phi_2 = (r * s / l + phi_1 * phi_1 * sine) / cosine;
    // First and second derivatives by theta of the pin's z and of the rod's centre.
    const auto height = [&](double arm) {
      return std::pair{-r * s - arm * sine * phi_1,
                       -r * c - arm * (cosine * phi_1 * phi_1 + sine * phi_2)};
    };
    const auto [z_1, z_2] = height(l);
    const auto [w_1, w_2] = height(d);
    const double y_1 = -r * c - d * cosine * phi_1,
                 y_2 = r * s + d * (sine * phi_1 * phi_1 - cosine * phi_2);
    const double total =
        polar_ + piston * z_1 * z_1 + rod * (y_1 * y_1 + w_1 * w_1) + inertia * phi_1 * phi_1;
    const double half_slope =
        piston * z_1 * z_2 + rod * (y_1 * y_2 + w_1 * w_2) + inertia * phi_1 * phi_2;
    const double gauge = gas_(q) - kAmbient;
    double on_piston = -gauge * area;
    const double normal = ring().load + std::max(gauge, 0.0) * ring().width;
    on_piston += 2.0 * std::numbers::pi * kBore *
                 ring_shear(ring(), kViscosity, normal, z_1 * v, kReversal).force;
    return (on_piston * z_1 - load_ - half_slope * v * v) / total;
  }

  Spline gas_;
  double polar_, load_;
};

class FreeCranks : public testing::SlapScenes {
 protected:
  /// Values of a history at equal intervals of the run.
  static std::vector<double> sampled(const H5File& file, const std::string& name, int count) {
    const auto time = file.read_doubles("history/time"), all = file.read_doubles("history/" + name);
    std::vector<double> found;
    size_t k = 0;
    for (int i = 0; i <= count; ++i) {
      const double t = time.front() + (time.back() - time.front()) * i / count;
      while (k + 2 < time.size() && time[k + 1] < t) ++k;
      const double share = (t - time[k]) / (time[k + 1] - time[k]);
      found.push_back((1.0 - share) * all[k] + share * all[k + 1]);
    }
    return found;
  }
};

TEST_F(FreeCranks, TurnAsARigidSliderCrankDoes) {
  constexpr double kPolar = 0.3, kLoad = 5.0;  // [kg m2], [N m]
  const std::string stiff =
      "clearance_um = 0\nsoft_stiffness_n_m = 0\nstiffness = 1e13\ndamping_n_s_m = 1e5\n";
  const std::string described =
      std::string(kAtOnce) +
      "method = \"tr-bdf2\"\nlargest_step_us = 20\n[accuracy]\ntolerance = 1e-6\n"
      "[small_end]\n" +
      stiff + "[big_end]\n" + stiff +
      fmt::format(
          "[contact]\nlubrication = \"none\"\nfriction = false\nclearance_um = 0\n"
          "barrel_top_um = 0\nbarrel_bottom_um = 0\nviscosity_pa_s = {}\n"
          "reversal_speed_m_s = {}\n[crank]\nspeed = \"free\"\npolar_kg_m2 = {}\n"
          "[crank.load]\nlaw = \"constant\"\ntorque_n_m = {}\n{}",
          kViscosity, kReversal, kPolar, kLoad, kRing);
  const H5File file = recorded(scene(described), "free");
  const auto time = file.read_doubles("history/time"),
             deviation = file.read_doubles("history/crank_deviation");
  const RigidEngine engine(
      read_gas_table(folder_ / "motored.csv", "pressure", Spline::Kind::kMonotoneCubic), kPolar,
      kLoad);
  const auto angles = engine.angles(time);
  double most = 0.0, apart = 0.0;
  for (size_t k = 0; k < time.size(); ++k) {
    const double expected = angles[k] - kClockSpeed * time[k];
    most = std::max(most, std::abs(expected));
    apart = std::max(apart, std::abs(deviation[k] - expected));
  }
  std::printf("crank up to %.4f rad from its clock, %.1e rad from a rigid one, residue %.1e\n",
              most, apart, result_.energy_residue);
  EXPECT_GT(most, 0.01);
  EXPECT_LT(apart, 1e-6);
  EXPECT_LT(result_.energy_residue, 1e-7);
}

/// A clock whose speed varies, but not at the start.
constexpr const char* kUnevenOrder =
    "[[engine.order]]\norder = 2\namplitude_rpm = 60\nphase_deg = 90\n";

TEST_F(FreeCranks, MoveWhateverTheirClockDoes) {
  // The clock is a choice of coordinates: skirt, rings and shapes move as with any other.
  const std::string described =
      std::string(kAtOnce) +
      "[accuracy]\ntolerance = 1e-4\n[contact]\nviscosity_pa_s = 0.02\ncavitation = false\n"
      "reversal_speed_m_s = 0.5\n"
      "clearance_um = 10\n" +
      kRing +
      "groove_coefficient = 0.05\nmass_g = 30\n[[contact.bore_shape]]\norder = 0\n"
      "height_mm = [100, 330]\namplitude_um = [4, 4]\nscale = \"gas\"\nat_bar = 40\n"
      "[crank]\nspeed = \"free\"\npolar_kg_m2 = 0.5\n[crank.load]\nlaw = \"constant\"\n"
      "torque_n_m = 0\n";
  std::map<std::string, std::vector<double>> of[2];
  for (const int k : {0, 1}) {
    const H5File file =
        recorded(scene(described + (k == 1 ? kUnevenOrder : "")), k == 1 ? "uneven" : "even");
    EXPECT_LT(result_.energy_residue, 1e-5);
    for (const char* name :
         {"crank_speed", "piston_lateral", "piston_tilt", "side_force", "friction_force",
          "film_min", "ring_friction_force", "ring_groove_force", "gas_pressure"})
      of[k][name] = sampled(file, name, 720);
  }
  for (const auto& [name, values] : of[0]) {
    double most = 0.0, apart = 0.0;
    for (size_t i = 0; i < values.size(); ++i) {
      most = std::max(most, std::abs(values[i]));
      apart = std::max(apart, std::abs(values[i] - of[1][name][i]));
    }
    std::printf("%-20s %.1e of %.3g\n", name.c_str(), apart / most, most);
    // Forces between accepted steps are interpolated.
    const bool force = name == "side_force" || name.starts_with("ring_");
    EXPECT_LT(apart, (force ? 5e-3 : 5e-4) * most) << name;
  }
}

TEST_F(FreeCranks, StretchAnElasticRodWhateverTheirClockDoes) {
  testing::write_rom(folder_ / "rod.rom.h5", testing::rod_model(testing::rod_truss(2e9, 0.3)));
  const std::string described =
      std::string(kAtOnce) +
      "[accuracy]\ntolerance = 1e-4\n[contact]\ncavitation = false\nviscosity_pa_s = 0.02\n"
      "clearance_um = 10\n[rod]\nmodel = \"elastic\"\nrom = \"rod.rom.h5\"\n"
      "[crank]\nspeed = \"free\"\npolar_kg_m2 = 0.5\n[crank.load]\nlaw = \"constant\"\n"
      "torque_n_m = 0\n";
  RowMatrix of[2];
  for (const int k : {0, 1}) {
    of[k] = recorded(scene(described + (k == 1 ? kUnevenOrder : "")), k == 1 ? "uneven" : "even")
                .read_rows("bodies/rod/q");
    EXPECT_LT(result_.energy_residue, 1e-5);
  }
  ASSERT_EQ(of[0].rows(), of[1].rows());
  const double most = of[0].cwiseAbs().maxCoeff(), apart = (of[0] - of[1]).cwiseAbs().maxCoeff();
  std::printf("rod's deformation: %.1e of %.3g\n", apart / most, most);
  EXPECT_LT(apart, 4e-3 * most);
}

/// The elements of a scene that have the rotation of the crank as their last coordinate are at the
/// crank's own angle. Adds their names to `checked`.
void check_elements(const Scene& described, std::set<std::string>& checked) {
  const LoadedBodies bodies = load_bodies(described);
  const auto model = build_model(described, bodies);
  System& system = model->system;
  int crankshaft = 0;
  while (system.bodies()[crankshaft].name != CrankBody::kName) ++crankshaft;
  const int turn = system.coordinate(crankshaft, 0);
  for (int e = 0; e < system.elements(); ++e) {
    ForceElement& element = system.element(e);
    const std::string name = element.name();
    const std::vector<int>& at = element.coordinates();
    if (at.back() != turn || name == "crank load") continue;
    checked.insert(name);
    const auto n = std::ssize(at);
    // Some state of all coordinates, and how it came about at some acceleration.
    const Eigen::Index all = system.interface_size();
    VectorXd y(all), v(all), a(all);
    for (Eigen::Index i = 0; i < all; ++i) {
      y(i) = 1e-7 * std::sin(1.0 + static_cast<double>(i));
      v(i) = 1e-3 * std::cos(2.0 * static_cast<double>(i));
      a(i) = 1e3 * std::sin(3.0 * static_cast<double>(i));
    }
    y(turn) = 0.03;
    v(turn) = 8.0;
    a(turn) = -4000.0;
    Stage stage{0.0021, 2e-5, 1, {}};
    const VectorXd v_known = v - stage.kappa * a, before = y - stage.kappa * v;
    stage.y_begin = &before;
    stage.v_begin = stage.v_known = &v_known;
    const VectorXd own_y = gather(y, at), own_v = gather(v, at), own_before = gather(before, at);
    Response response, more, less;
    element.evaluate(stage, own_y, own_v, true, response);
    const Eigen::MatrixXd tangent = testing::complete_tangent(response);
    VectorXd plus = own_y, minus = own_y;
    constexpr double kStep = 1e-8;
    plus(n - 1) += kStep;
    minus(n - 1) -= kStep;
    element.evaluate(stage, plus, (plus - own_before) / stage.kappa, false, more);
    element.evaluate(stage, minus, (minus - own_before) / stage.kappa, false, less);
    const VectorXd column = (more.force - less.force) / (2.0 * kStep);
    const double error = (tangent.col(n - 1) - column).norm() / column.norm();
    std::printf("%-14s column of the crank %.1e of %.2e apart\n", name.c_str(), error,
                column.norm());
    EXPECT_GT(column.norm(), 0.0) << name;
    // Of the rings it has the inertia, not the gas; of guides and frame no third derivatives.
    EXPECT_LT(error, name == "rings" ? 1e-2 : 1e-5) << name;
    EXPECT_EQ(response.force(n - 1), 0.0) << name;
    // At constant rates, of which the stage knows nothing else.
    const auto power = [&](double later) {
      const Stage now{stage.time + later, 1e-6, 1, {}};
      const VectorXd there = own_y + later * own_v;
      element.evaluate(now, there, own_v, false, response);
      element.finish_stage(now);
      return element.power(there, own_v);
    };
    constexpr double kApart = 1e-6;
    const double stored = (power(kApart).stored - power(-kApart).stored) / (2.0 * kApart);
    const Power here = power(0.0);
    EXPECT_NEAR(response.force.dot(own_v) + stored + here.lost, here.input,
                1e-6 * (std::abs(here.lost) + std::abs(here.input) + std::abs(stored)))
        << name;
  }
}

TEST_F(FreeCranks, HaveTangentsAndPowersAtTheirOwnSpeed) {
  testing::write_rom(folder_ / "rod.rom.h5", testing::rod_model(testing::rod_truss(2e9, 0.3)));
  const std::string described = std::string(kAtOnce) + testing::kElasticBlock +
                                "[rod]\nmodel = \"elastic\"\nrom = \"rod.rom.h5\"\n"
                                "[crank]\nspeed = \"free\"\npolar_kg_m2 = 0.5\n" +
                                kUnevenOrder;
  std::set<std::string> checked;
  for (const char* film : {"cavitation = false\n", "oil_thickness_um = 100\n"})
    check_elements(scene(described + "[contact]\nviscosity_pa_s = 0.02\n" + film + kRing +
                         "groove_coefficient = 0.05\nmass_g = 30\n"),
                   checked);
  EXPECT_EQ(checked, (std::set<std::string>{"gas on block", "gas on piston", "pin_guide",
                                            "piston_liner", "rings", "rod frame", "rod_guide"}));
}

TEST_F(FreeCranks, GoOnFromACheckpointToTheBit) {
  testing::write_rom(folder_ / "rod.rom.h5", testing::rod_model(testing::rod_truss(2e9, 0.3)));
  const auto recording = [&](int cycles) {
    return scene(fmt::format("[time]\nrecord_cycles = {}\n", cycles) +
                 "method = \"tr-bdf2\"\n[accuracy]\ntolerance = 1e-2\n"
                 "[contact]\nviscosity_pa_s = 0.02\noil_thickness_um = 30\n[contact.liner_oil]\n" +
                 kRing +
                 "groove_coefficient = 0.05\nmass_g = 30\n[[contact.bore_shape]]\norder = 0\n"
                 "height_mm = [100, 330]\namplitude_um = [4, 4]\nscale = \"gas\"\nat_bar = 40\n"
                 "[rod]\nmodel = \"elastic\"\nrom = \"rod.rom.h5\"\n"
                 "[crank]\nspeed = \"free\"\npolar_kg_m2 = 0.5\n" +
                 kUnevenOrder);
  };
  const Scene described = recording(1);
  const LoadedBodies bodies = load_bodies(described);
  constexpr const char* kHistories[] = {"crank_deviation", "piston_tilt",       "side_force",
                                        "oil_in_gap",      "ring_groove_force", "crank_speed"};
  const auto run = [&](const char* name, const std::optional<Checkpoint>& from) {
    RunControl control;
    control.output = folder_ / (std::string(name) + ".run.h5");
    control.resume_from = from;
    if (from)
      std::filesystem::copy_file(checkpoint_path(folder_ / "whole.run.h5"),
                                 checkpoint_path(control.output));
    RunResult result = simulate(described, bodies, control);
    const auto point = read_checkpoint(checkpoint_path(control.output), fingerprint(described));
    const H5File file = testing::finished_file(described, bodies, result);
    std::vector<std::vector<double>> found;
    for (const char* history : kHistories)
      found.push_back(file.read_doubles(std::string("history/") + history));
    return std::pair{found, point};
  };
  const auto [whole, point] = run("whole", std::nullopt);
  ASSERT_TRUE(point.has_value());
  EXPECT_EQ(run("again", point).first, whole);

  // Cycles that are recorded together move the same.
  const Scene both = recording(2);
  RunControl control;
  control.output = folder_ / "both.run.h5";
  RunResult result = simulate(both, bodies, control);
  const H5File file = testing::finished_file(both, bodies, result);
  for (size_t k = 0; k < std::size(kHistories); ++k) {
    const std::vector<double> values = file.read_doubles(std::string("history/") + kHistories[k]);
    ASSERT_GT(values.size(), whole[k].size());
    EXPECT_TRUE(std::equal(whole[k].begin(), whole[k].end(), values.end() - std::ssize(whole[k])))
        << kHistories[k];
  }
}

/// A torque over one cycle of 720 deg with a spike.
std::string load_rows() {
  std::string text = "crank_angle [deg], torque [N m]\n";
  for (int deg = -360; deg <= 360; ++deg)
    text += fmt::format("{}, {}\n", deg, deg == 40 ? 500.0 : 10.0);
  return text;
}

// The integrator asks gas and load for their tables to find pulses between stages.
TEST_F(FreeCranks, HardS16_KnowTheTablesOfTheirForces) {
  std::ofstream(folder_ / "load.csv") << load_rows();
  const Scene described =
      scene(std::string(kAtOnce) +
            "[contact]\nlubrication = \"none\"\n[crank]\nspeed = \"free\"\npolar_kg_m2 = 0.5\n"
            "[crank.load]\nlaw = \"table\"\ntable = \"load.csv\"\ncolumn = \"torque\"\n");
  const LoadedBodies bodies = load_bodies(described);
  const auto model = build_model(described, bodies);
  System& system = model->system;
  std::vector<std::string> found;
  for (int e = 0; e < system.elements(); ++e) {
    ForceElement& element = system.element(e);
    const auto* table = dynamic_cast<const TableForce*>(&element);
    if (table == nullptr || !table->has_table()) continue;
    found.push_back(element.name());
    const auto n = static_cast<Eigen::Index>(element.coordinates().size());
    VectorXd y = VectorXd::Zero(n), v = VectorXd::Zero(n);
    y(n - 1) = 0.03;  // the rotation of the crank
    v(n - 1) = 8.0;
    constexpr double kTime = 0.0021, kStep = 1e-6;
    const TurningAngle at = table->table_angle(kTime, y, v);
    const TurningAngle later = table->table_angle(kTime + kStep, y + kStep * v, v);
    EXPECT_NEAR(at.rate, (later.angle - at.angle) / kStep, 1e-5 * at.rate) << element.name();
    EXPECT_GT(table->next_row(at.angle), at.angle);
    EXPECT_LE(table->next_row(at.angle), at.angle + 20.0 * std::numbers::pi / 180.0);
    Response response;
    element.evaluate({kTime, 2e-5, 1, {}}, y, v, false, response);
    EXPECT_NEAR(response.force(0), table->by_table(kTime, at), 1e-12 * std::abs(response.force(0)))
        << element.name();
    EXPECT_NE(response.force(0), 0.0);
    EXPECT_FALSE(table->has_reaction());
  }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<std::string>{"crank load", "gas on piston"}));
}

}  // namespace
}  // namespace clatter::dynamics
