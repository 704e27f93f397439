// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/modal_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/synthetic.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

using testing::clamped_bar;
using testing::vector;

TEST(ModalBody, ShapesAreMassOrthonormalAndRebuildTheStiffness) {
  const auto model = testing::elastic_block(0.0535, 6, 4);
  const ModalBody body = make_modal_body(model, {});
  const auto n = body.modes();
  const Eigen::MatrixXd mass = body.shapes.transpose() * model.M_rr * body.shapes;
  const Eigen::MatrixXd stiffness = body.shapes.transpose() * model.K_rr * body.shapes;
  EXPECT_LT((mass - Eigen::MatrixXd::Identity(n, n)).norm(), 1e-10);
  const Eigen::MatrixXd rest = stiffness - Eigen::MatrixXd(body.omega_squared.asDiagonal());
  EXPECT_LT(rest.norm(), 1e-9 * stiffness.norm());
}

TEST(ModalBody, SixRigidModesAreExactlyZeroAndUndamped) {
  const ModalBody body = make_modal_body(testing::elastic_piston(0.0535, 4, 4), {});
  ASSERT_EQ(body.rigid_modes, 6);
  EXPECT_EQ(body.omega_squared.head(6).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(body.damping.head(6).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT(body.omega_squared(6), std::pow(2.0 * std::numbers::pi * 100.0, 2));
  // A unit translation in z has no part in elastic modes, and the mass of the entire body.
  EXPECT_LT(body.rigid.bottomRows(body.modes() - 6).norm(), 1e-9);
}

TEST(ModalBody, RigidVariantKeepsTheSixMotionsOnly) {
  const auto model = testing::elastic_piston(0.0535, 4, 4);
  const ModalBody body = make_modal_body(model, {false, 0.0});
  EXPECT_EQ(body.modes(), 6);
  test::expect_parts(
      test::refusal_of<NumericsError>([&] {
        make_modal_body(clamped_bar(1.0, 20, 3), {false, 0.0});
      }),
      {"bar: found model = \"rigid\", but only 0 of its six rigid motions are free"});
}

TEST(ModalBody, ForceOfAWrenchHasThatResultantAndDoesNotDeformAFreeBody) {
  const ModalBody body = make_modal_body(testing::elastic_block(0.0535, 6, 4), {});
  const Eigen::Vector3d point(0.2, -0.01, 0.3);
  for (int k = 0; k < 6; ++k) {
    const Wrench wrench = unit_wrench(k, point);
    const Eigen::VectorXd force = body.force_of(wrench);
    EXPECT_LT((body.rigid.transpose() * force - wrench).norm(), 1e-12);
    EXPECT_LT(force.tail(body.modes() - 6).norm(), 1e-10 * force.norm());
    // As a row it is the displacement of the point in a rigid motion.
    const Wrench motion = Wrench::LinSpaced(0.3, -0.7);
    EXPECT_NEAR(force.dot(body.rigid * motion), wrench.dot(motion), 1e-12);
  }
  EXPECT_EQ(unit_wrench(1, point).tail<3>(), Eigen::Vector3d(-0.3, 0.0, 0.2));
  test::expect_parts(
      test::refusal_of<NumericsError>([&] { testing::point_mass(2.0).force_of(Wrench::Unit(0)); }),
      {"mass: found 0 independent rigid motions, expected 6"});
}

TEST(System, FrameCoordinatesAreSharedNamedAndKnowRotations) {
  System system;
  const int body = system.add_body(make_modal_body(testing::elastic_block(0.0535, 6, 4), {}));
  const Eigen::Vector3d point(0.2, 0.0, 0.0);
  const int tilt = system.frame_coordinate(body, 4, point), up = system.frame_coordinate(body, 2);
  EXPECT_EQ(system.frame_coordinate(body, 4), tilt);  // a rotation has no point
  EXPECT_EQ(system.frame_coordinate(body, 2), up);
  EXPECT_NE(system.frame_coordinate(body, 2, point), up);
  EXPECT_NE(system.coordinate(body, 2), up);
  EXPECT_EQ(system.interface_size(), 4);
  EXPECT_TRUE(system.is_rotation(tilt));
  EXPECT_FALSE(system.is_rotation(up));
  EXPECT_EQ(system.coordinate_name(tilt), "block: rigid frame, ry");
}

TEST(ModalBody, InertiaIsDroppedAboveTheLimit) {
  const auto model = clamped_bar(1.0, 40, 10);
  const ModalBody body = make_modal_body(model, {true, 6000.0});
  for (int i = 0; i < body.modes(); ++i) {
    const double hz = std::sqrt(body.omega_squared(i)) / (2.0 * std::numbers::pi);
    EXPECT_EQ(body.inertia(i), hz <= 6000.0 ? 1.0 : 0.0) << hz;
  }
}

TEST(ModalBody, BarFrequenciesAreThoseOfTheContinuum) {
  // f_i = (2 i - 1) c / (4 L); linear elements of h = L / 400 raise it by (k h)^2 / 24, and 100
  // modes with a fixed tip by less than a twentieth of this.
  const ModalBody body = make_modal_body(clamped_bar(1.0, 400, 100), {});
  const double c = std::sqrt(210e9 / 7850.0);
  for (int i = 0; i < 3; ++i) {
    const double hz = std::sqrt(body.omega_squared(i)) / (2.0 * std::numbers::pi);
    const double kh = (2 * i + 1) * std::numbers::pi / 2.0 / 400.0, rise = kh * kh / 24.0;
    EXPECT_NEAR(hz / ((2 * i + 1) * c / 4.0) - 1.0, rise, 0.05 * rise) << i;
  }
}

}  // namespace
}  // namespace clatter::dynamics
