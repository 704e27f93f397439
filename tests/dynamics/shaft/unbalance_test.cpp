// SPDX-License-Identifier: GPL-3.0-or-later
// Discs with an unbalance: what a free one keeps, and the whirl of a rotor.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/base/units.hpp"
#include "dynamics/run/energy.hpp"
#include "dynamics/shaft/disc_body.hpp"
#include "dynamics/shaft/disc_unbalance.hpp"
#include "tests/dynamics/element_check.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/dynamics/shaft_model.hpp"
#include "tests/dynamics/slap_scene.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;
using testing::arbitrary;
using testing::ShaftModelOf;
using testing::started;

TEST(Unbalance, TangentIsTheDifferenceQuotientOfTheForce) {
  DiscUnbalance element("u", {0, 1, 2}, 0.02, 0.4, 1.0, 30.0);
  const VectorXd y = arbitrary(3, 1);
  for (const double spin : {0.0, 25.0, -300.0}) {
    VectorXd v = arbitrary(3, 2);
    v(2) += spin;
    const Stage stage{0.1, 0.03, 1, {0.03}};
    EXPECT_LT(testing::tangent_error(element, stage, y, y - stage.kappa * v, 1e-6), 1e-6) << spin;
  }
}

TEST(Unbalance, OfAFreeDiscMovesItsAxisRoundTheCentreOfMass) {
  const double m = 2.0, polar = 0.03, U = 0.01, phase = 0.7, speed = 50.0, end = 0.5;
  System system;
  const ShaftAxes axes;
  const DiscStart start{0.3, speed};
  const int body = system.add_body(make_disc_body("disc", {m, polar, 0.02}, axes, start));
  const int x = system.coordinate(body, 0), y = system.coordinate(body, 1),
            a = system.coordinate(body, 5);
  system.add_element(std::make_unique<DiscUnbalance>("u", std::vector<int>{x, y, a}, U, phase,
                                                     start.angle, start.speed));
  EnergyBalance energy(system);
  StepOptions options;
  options.largest = 1e-3;
  options.accuracy = {1e-6, 1e-3, 0.1, 0.05};
  const auto method = make_integrator(system, options);
  method->set_observer(&energy);
  method->start(-1e-9, system.eta_start(), system.v_start());
  const auto centre = [&] {
    const VectorXd& at = method->state().y;
    const double angle = at(a) + phase;
    return Vector2d(at(x) + U / m * std::cos(angle), at(y) + U / m * std::sin(angle));
  };
  const Vector2d begin = centre();
  const double angle = start.angle + phase;
  const Vector2d velocity = U / m * speed * Vector2d(-std::sin(angle), std::cos(angle));
  double worst = 0.0, slowest = speed;
  while (method->state().time < end) {
    method->step(end);
    worst = std::max(worst, (centre() - begin - velocity * method->state().time).norm());
    slowest = std::min(slowest, method->state().v_y(a));
  }
  // The axis is U / m = 5 mm from it.
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT(energy.residue(), 5e-6);
  // About the centre of mass a free body turns evenly: so does the angle.
  EXPECT_NEAR(slowest, speed, 1e-4 * speed);
}

/// A short shaft in a linear bearing, with a flywheel that keeps its speed.
std::string rotor(double rpm, const std::string& bearing) {
  return fmt::format(R"(
[[shaft]]
name = "rotor"
speed_rpm = {}
[[shaft.section]]
from_mm = -8
to_mm = 8
diameter_mm = 24
[[shaft.bearing]]
name = "b"
at_mm = 0
{}
[[shaft.disc]]
name = "disc"
at_mm = 0
mass_kg = 2.0
polar_kg_m2 = 1e3
diametral_kg_m2 = 1
unbalance_g_mm = 100
unbalance_deg = 20
)",
                     rpm, bearing);
}

TEST(Unbalance, ResumesToTheBit) {
  const std::string text =
      rotor(3000.0, "model = \"linear\"\nstiffness_n_m = 1e6\ndamping_n_s_m = 400");
  ShaftModelOf one(text), other(text);
  StepOptions options;
  options.largest = 1e-4;
  options.accuracy = {1e-6, 1e-5, 0.1, 0.05};
  const auto method = started(one.system(), options);
  while (method->state().time < 0.01) method->step(0.01);
  for (int e = 0; e < one.system().elements(); ++e)
    other.system().element(e).restore(one.system().element(e).save());
  const auto resumed = make_integrator(other.system(), options);
  resumed->resume(method->state(), method->rung());
  method->forget_history();
  for (Integrator* each : {method.get(), resumed.get()})
    while (each->state().time < 0.02) each->step(0.02);
  EXPECT_EQ(resumed->state().eta, method->state().eta);
  EXPECT_EQ(resumed->state().v, method->state().v);
}

/// Where the axis is at 0.5 s, and the direction of the unbalance, as x + i y.
struct Whirl {
  std::complex<double> at, unbalance;
};
Whirl whirl(ShaftModelOf& shaft) {
  System& system = shaft.system();
  StepOptions options;
  options.largest = 1e-4;
  options.accuracy = {1e-6, 1e-5, 0.1, 0.05};
  const auto run = started(system, options);
  while (run->state().time < 0.5) run->step(0.5);
  const VectorXd& y = run->state().y;
  const std::complex<double> at(y(shaft.y("rotor.disc", 0)), y(shaft.y("rotor.disc", 1)));
  return {at, std::polar(1.0, y(shaft.y("rotor.disc", 5)) + 20.0 * kDegree)};
}

TEST(Unbalance, OracleARotorWhirlsAsJeffcottsBelowAtAndAboveItsResonance) {
  const double k = 1e6, c = 400.0, U = 1e-4;
  for (const double rpm : {3000.0, 6700.0, 12000.0}) {
    ShaftModelOf shaft(rotor(rpm, "model = \"linear\"\nstiffness_n_m = 1e6\ndamping_n_s_m = 400"));
    const double m = shaft.system().bodies()[0].mass, w = rpm * std::numbers::pi / 30.0;
    const Whirl whirled = whirl(shaft);
    const std::complex<double> expected = U * w * w / std::complex<double>(k - m * w * w, c * w),
                               found = whirled.at / whirled.unbalance;
    std::printf("%.0f rpm: %.4f um at %.3f deg, Jeffcott %.4f um at %.3f deg\n", rpm,
                1e6 * std::abs(found), std::arg(found) / kDegree, 1e6 * std::abs(expected),
                std::arg(expected) / kDegree);
    EXPECT_LT(std::abs(found - expected), 2e-4 * std::abs(expected)) << rpm;
  }
}

TEST(Unbalance, OracleARotorInCoupledBearingsWhirlsInAnEllipse) {
  // (K + i w C - w^2 m) q = U w^2 (1, -i), of the table at 4500 rpm: half way.
  const double U = 1e-4, rpm = 4500.0, w = rpm * std::numbers::pi / 30.0;
  const std::filesystem::path file = testing::test_folder() / "bearing.csv";
  std::ofstream(file) << "speed [rpm], k11 [N/mm], k12 [N/mm], k21 [N/mm], k22 [N/mm], "
                         "c11 [N s/m], c12 [N s/m], c21 [N s/m], c22 [N s/m]\n"
                         "3000, 1500, 100, -150, 1900, 900, 10, 10, 1100\n"
                         "6000, 1700, 200, -250, 2100, 1100, 30, 30, 1300\n";
  Eigen::Matrix2cd A;
  A << 1.6e6, 1.5e5, -2e5, 2e6;
  Eigen::Matrix2d C;
  C << 1000.0, 20.0, 20.0, 1200.0;
  const std::string constant =
      "model = \"coefficients\"\nstiffness_matrix_n_m = [1.6e6, 1.5e5, -2e5, 2e6]\n"
      "damping_matrix_n_s_m = [1000, 20, 20, 1200]";
  const std::string table = fmt::format("model = \"coefficients\"\ntable = \"{}\"", file.string());
  for (const std::string& bearing : {constant, table}) {
    ShaftModelOf shaft(rotor(rpm, bearing));
    const double m = shaft.system().bodies()[0].mass;
    const std::complex<double> i(0.0, 1.0);
    const Eigen::Matrix2cd D = A + i * w * C - w * w * m * Eigen::Matrix2cd::Identity();
    const Eigen::Vector2cd q = D.inverse() * (U * w * w * Eigen::Vector2cd(1.0, -i));
    const auto [at, unbalance] = whirl(shaft);
    const Vector2d expected = (q * unbalance).real();
    EXPECT_LT((Vector2d(at.real(), at.imag()) - expected).norm(), 5e-4 * expected.norm());
  }
}

}  // namespace
}  // namespace clatter::dynamics
