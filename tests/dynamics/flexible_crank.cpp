// SPDX-License-Identifier: GPL-3.0-or-later
// The planar flexible slider crank of Simeon (1996), problem CRANK of the Test Set for IVP Solvers.
#include "tests/dynamics/flexible_crank.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "dynamics/body/floating_body.hpp"
#include "tests/dynamics/mechanisms.hpp"

namespace clatter::dynamics::testing {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kCrank = 0.15, kRod = 0.3, kSpeed = 150.0,
                 kPi = 3.1415927;  // as the problem has it
constexpr double kRodMass = 0.151104, kSliderMass = 0.075552, kRodInertia = 0.0045339259;
constexpr double kSide = 0.008, kYoung = 0.2e12;

/// The rod by the problem's four shapes, in the frame at the crank pin with x along the chord: two
/// sines across, and the quadratic shapes of the middle and of the end along the rod. The
/// longitudinal masses are those of the problem, fifteen times those of the rod.
ElasticShapes rod() {
  ElasticShapes shapes;
  shapes.mass = kRodMass;
  shapes.centre = {0.5 * kRod, 0.0, 0.0};
  auto& sums = shapes.invariants;
  sums.first.fill(VectorXd::Zero(4));
  sums.moment.fill(VectorXd::Zero(4));
  sums.product.fill(MatrixXd::Zero(4, 4));
  sums.first[0] = kRodMass * Eigen::Vector4d(0.0, 0.0, 2.0 / 3.0, 1.0 / 6.0);
  sums.first[1] = kRodMass * Eigen::Vector4d(2.0 / kPi, 0.0, 0.0, 0.0);
  sums.moment[0] = kRodMass * kRod * Eigen::Vector4d(0.0, 0.0, 1.0 / 3.0, 1.0 / 6.0);
  sums.moment[1] = kRodMass * kRod * Eigen::Vector4d(1.0 / kPi, -0.5 / kPi, 0.0, 0.0);
  const double cube = kPi * kPi * kPi;
  MatrixXd& across = sums.product[1];  // x y
  across(2, 0) = kRodMass * 16.0 / cube;
  across(3, 0) = -kRodMass * (8.0 / cube - 1.0 / kPi);
  across(3, 1) = -kRodMass * 0.5 / kPi;
  sums.product[3] = across.transpose();
  sums.product[0].bottomRightCorner<2, 2>() << 8.0, 1.0, 1.0, 2.0;
  sums.product[0] *= kRodMass;
  sums.product[4].topLeftCorner<2, 2>() = 0.5 * kRodMass * Eigen::Matrix2d::Identity();
  // Its thickness, which the plane motion does not feel.
  const double thick = kRodMass * kSide * kSide / 12.0;
  sums.place.diagonal() << kRodInertia - thick, thick, thick;

  const double k = kYoung * kSide * kSide / kRod, slender = std::pow(kSide / kRod, 2);
  shapes.stiffness = MatrixXd::Zero(4, 4);
  shapes.stiffness(0, 0) = k * std::pow(kPi, 4) / 24.0 * slender;
  shapes.stiffness(1, 1) = k * std::pow(kPi, 4) * 2.0 / 3.0 * slender;
  shapes.stiffness.bottomRightCorner<2, 2>() << 16.0, -8.0, -8.0, 7.0;
  shapes.stiffness.bottomRightCorner<2, 2>() *= k / 3.0;
  return shapes;
}

}  // namespace

CrankEnd crank_at(double end, double stiffness, double tolerance) {
  ElasticStart start;
  start.q = Eigen::Vector4d(0.0, 0.0, 0.103339863e-4, 0.169327969e-4);
  start.rate = Eigen::Vector4d(0.444896105, 0.463434311e-2, -0.178591076e-5, -0.268938672e-5);
  start.frame.centre = {kCrank, 0.0, 0.0};
  start.frame.velocity = {0.0, kCrank * kSpeed, 0.0};
  start.frame.spin = {0.0, 0.0, -74.9957670};
  const FloatingBody floating = make_floating_body("rod", rod(), start);
  System system;
  const SpatialBody body = add_spatial_body(system, floating.body);
  const auto block = add_slider(system, kSliderMass, 0.450016933, -0.268938672e-5);
  Matrix3X tip = Matrix3X::Zero(3, 4);
  tip(0, 3) = 1.0;
  const double damping = 0.1 * std::sqrt(stiffness * kSliderMass);
  system.add_element(std::make_unique<PairElement>(
      "crank pin", body.port(floating.arm(Vector3d::Zero()), floating.shape(Matrix3X::Zero(3, 4))),
      std::make_unique<DrivenPort>(Drive(kSpeed), Vector3d::Zero(), Vector3d(kCrank, 0.0, 0.0),
                                   Vector3d::UnitZ()),
      linear_joint(stiffness, damping)));
  system.add_element(std::make_unique<PairElement>(
      "slider pin", body.port(floating.arm({kRod, 0.0, 0.0}), floating.shape(tip)),
      std::make_unique<NodePort>(Vector3d::Zero(), block), linear_joint(stiffness, damping)));
  StepOptions options;
  options.largest = 1e-4;
  options.first = 1e-11;
  options.smallest = 1e-14;
  options.accuracy = {tolerance, 1e-5, 0.1, 0.1};
  const auto method = started(system, options);
  while (method->state().time < end) method->step(end);

  const StageState& state = method->state();
  CrankEnd found;
  const Eigen::Vector4d quaternion = body.quaternion(state);
  found.at(0) = 2.0 * std::atan2(quaternion(3), quaternion(0));
  found.rate(0) = body.spin(state).z();
  found.at(1) = state.y(block[0]);
  found.rate(1) = state.v_y(block[0]);
  const auto modal = [&](const VectorXd& all) {
    return floating.W * all.segment<4>(system.mode_offset(body.body) + kSpatial);
  };
  found.at.tail<4>() = modal(state.eta);
  found.rate.tail<4>() = modal(state.v);
  found.steps = method->statistics().accepted;
  return found;
}

void expect_reference(const CrankEnd& found, const CrankLimits& limits) {
  // Release 2.4 of the Test Set, problem CRANK (linear stiffness, no damping) at 0.1 s.
  const double at[] = {-3.311734987910881e-01, 1.697373326718410e-01,  1.893192460247178e-04,
                       2.375751865617931e-05,  -5.323907988763734e-06, -8.363283141616840e-06};
  const double rate[] = {6.025346682645789e+01,  -8.753116989887888e+00, -3.005536801092212e-02,
                         -5.500488291932075e-03, 4.978243404809343e-04,  1.104933470696396e-03};
  const char* names[] = {"phi2", "x3", "q1", "q2", "q3", "q4"};
  for (int k = 0; k < 6; ++k) {
    const double off = std::abs(found.at(k) / at[k] - 1.0),
                 rate_off = std::abs(found.rate(k) / rate[k] - 1.0);
    std::printf("%-4s % .9e off by %.1e, its rate by %.1e\n", names[k], found.at(k), off, rate_off);
    EXPECT_LT(off, limits.at[k]) << names[k];
    if (k >= 3) continue;
    EXPECT_LT(rate_off, limits.rate[k]) << names[k];
  }
  std::printf("%lld steps\n", found.steps);
}

}  // namespace clatter::dynamics::testing
