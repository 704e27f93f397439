// SPDX-License-Identifier: GPL-3.0-or-later
// The forces of the rings on piston and liner.
#include "dynamics/ring/ring_pack.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/dynamics/element_check.hpp"
#include "tests/dynamics/film/piston_scene.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kBore = 53.5e-3, kPressure = 40e5;
constexpr int kPatches = 40, kFits = 4;  // 8 x 5 patches
constexpr int kPinAt = kPatches + kFits;

RingPackOptions two_rings() {
  RingSpec top;
  top.height = 50e-3;
  top.face_radius = 0.02;
  top.load = 300.0;
  top.width = 2.5e-3;
  top.thickness = 4e-3;
  top.gas_share = 1.0;
  top.mass = 0.02;
  top.boundary = 0.1;
  top.groove = 0.08;
  RingSpec oil = top;
  oil.height = 40e-3;
  oil.gas_share = 0.1;
  oil.load = 1500.0;
  RingPackOptions options;
  options.rings = {top, oil};
  options.bore_radius = kBore;
  return options;
}

RingPackBodies bodies(bool elastic, double stroke_rate, double acceleration = 0.0) {
  RingPackBodies parts;
  if (elastic) parts.liner = film::ElasticSurface{film::make_patches(8, 5, 0.08, 0.31, kBore), {}};
  parts.bore_axis = {0.0, -1e-3};
  parts.liner_axial = {0.5e-3, -1.5e-3};
  parts.stroke = [=](double) { return Motion<double>{0.21, stroke_rate, acceleration}; };
  parts.gas = [](double) { return kPressure; };
  return parts;
}

RingPack pack(bool elastic, RingPackOptions options, double rate = 6.0, double acceleration = 0.0) {
  std::vector<int> coordinates(elastic ? kPinAt + 7 : 6);
  std::iota(coordinates.begin(), coordinates.end(), 0);
  return {std::move(options), bodies(elastic, rate, acceleration), std::move(coordinates)};
}

TEST(RingPack, HasTheFrictionOfItsLoadOnTheBoresAxis) {
  RingPackOptions options = two_rings();
  for (RingSpec& ring : options.rings) ring.groove = 0.0;
  RingPack rings = pack(false, options);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(6);
  Response response;
  rings.evaluate({0.0, 1e-6, 1, {}}, rest, rest, false, response);
  double expected = 0.0;
  for (const RingSpec& ring : options.rings) {
    const double load = ring.load + ring.gas_share * kPressure * 2.5e-3;  // 10 300 and 2 500 N/m
    const double f = ring_friction(ring, 0.01 * std::hypot(6.0, 1e-2) / load).value;
    expected -= 2.0 * std::numbers::pi * kBore * load * f * 6.0 / std::hypot(6.0, 1e-2);
  }
  EXPECT_LT(expected, -20.0);
  EXPECT_NEAR(response.force(2), expected, 1e-12 * std::abs(expected));
  EXPECT_NEAR(response.force(3), -1e-3 * expected, 1e-15 * std::abs(expected));  // 1 mm off the pin
  EXPECT_EQ(response.force(1), 0.0);
}

TEST(RingPack, GroovesHoldThePistonByTheirAxialLoad) {
  RingPackOptions options = two_rings();
  for (RingSpec& ring : options.rings) ring.boundary = 0.0;
  RingPack rings = pack(false, options, 6.0, -1500.0);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(6);
  Eigen::VectorXd v = rest;
  v(1) = 0.3;  // far above the slip speed
  Response response;
  rings.evaluate({0.0, 1e-6, 1, {}}, rest, v, false, response);
  const double area = 2.0 * std::numbers::pi * (kBore - 2e-3) * 4e-3;
  const double top = 0.9 * kPressure * area - 0.02 * 1500.0,
               oil = 0.1 * kPressure * area - 0.02 * 1500.0;
  const double smooth = 0.3 / std::hypot(0.3, 1e-3);
  EXPECT_NEAR(response.force(1), -0.08 * (top + oil) * smooth, 1e-9 * top);
  EXPECT_NEAR(response.force(3), 0.08 * (50e-3 * top + 40e-3 * oil) * smooth, 1e-9 * top);
  // Slow creep: as a damper.
  v(1) = 1e-7;
  rings.evaluate({0.0, 1e-6, 1, {}}, rest, v, false, response);
  EXPECT_NEAR(response.force(1), -0.08 * (top + oil) * 1e-4, 1e-6 * 0.08 * top * 1e-4);
}

TEST(RingPack, TangentMatchesDifferences) {
  for (const bool elastic : {false, true}) {
    RingPack rings = pack(elastic, two_rings(), 2.0, -1500.0);
    const Eigen::Index n = std::ssize(rings.coordinates());
    const Eigen::VectorXd y = 2e-5 * test::random_vector(n, 3),
                          before = y - 1e-8 * test::random_vector(n, 4);
    EXPECT_LT(testing::tangent_error(rings, {0.0, 3e-6, 1, {}}, y, before, 1e-12), 1e-6) << elastic;
  }
}

TEST(RingPack, AllOfItsWorkIsLostOrThatOfTheStroke) {
  RingPack rings = pack(true, two_rings(), -3.0, 800.0);
  const Eigen::Index n = std::ssize(rings.coordinates());
  const Eigen::VectorXd y = 2e-4 * test::random_vector(n, 5), v = 0.05 * test::random_vector(n, 6);
  EXPECT_LT(testing::power_error(rings, 0.0, y, v, 1e-9), 1e-12);
  EXPECT_GT(rings.power(y, v).lost, 10.0);
}

TEST(RingPack, ForcesOnPistonAndLinerCancel) {
  // Displacements of all coordinates when both move together along y, and turn about x at the pin.
  RingPack rings = pack(true, two_rings(), 2.0, -1500.0);
  const Eigen::Index n = std::ssize(rings.coordinates());
  const film::ElasticSurface liner{film::make_patches(8, 5, 0.08, 0.31, kBore), {}};
  const Eigen::MatrixXd radial = film::radial_motions(liner);
  const Eigen::Matrix<double, 3, 1> pin(0.0, 0.0, 0.21);
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(n, 3);  // y, z, rx about the frame's origin
  V.block(0, 0, kPatches, 1) = radial.col(1);
  V.block(0, 2, kPatches, 1) = radial.col(2);
  V(kPatches + 1, 0) = 1.0;
  V(kPatches + 2, 2) = 1.0;
  V(kPinAt + 1, 0) = 1.0;
  V(kPinAt + 1, 2) = -pin.z();
  V(kPinAt + 2, 1) = 1.0;
  V(kPinAt + 3, 2) = 1.0;
  // The pin is at y = 0, so the axial coordinate of the liner is at -1.5 mm.
  V(kPinAt + 6, 1) = 1.0;
  V(kPinAt + 6, 2) = -1.5e-3;
  Response response;
  rings.evaluate({0.0, 1e-6, 1, {}}, Eigen::VectorXd::Zero(n), 0.05 * test::random_vector(n, 8),
                 false, response);
  const Eigen::Vector3d work = V.transpose() * response.force;
  const Eigen::Vector3d terms = V.cwiseAbs().transpose() * response.force.cwiseAbs();
  for (int k = 0; k < 3; ++k) EXPECT_LT(std::abs(work(k)), 1e-12 * terms(k)) << k;
}

}  // namespace
}  // namespace clatter::dynamics
