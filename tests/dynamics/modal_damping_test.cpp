// SPDX-License-Identifier: GPL-3.0-or-later
// Modal damping by table: the damping of the body's oscillators, and the decay of free vibration.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "dynamics/body/modal_body.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/synthetic.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

using testing::clamped_bar;

rom::ReducedModel bar_with_table() {
  rom::ReducedModel bar = clamped_bar(1.0, 100, 10);
  bar.modal_damping.hz = Eigen::Vector2d(1000.0, 5000.0);
  bar.modal_damping.ratio = Eigen::Vector2d(0.01, 0.03);
  return bar;
}

/// Logarithmic decrement a period of mode `k` of a body that is released from its shape: ln of the
/// ratio of two deflections that are `periods` complete damped periods apart, over `periods`.
double decrement(const ModalBody& body, int k, double zeta, int periods) {
  System system;
  system.add_body(body);
  const double omega = std::sqrt(body.omega_squared(k));
  const double period = 2.0 * std::numbers::pi / (omega * std::sqrt(1.0 - zeta * zeta));
  StepOptions options;
  options.largest = period / 2000;
  options.first = 1e-7 * period;
  options.fixed = true;
  Dirk method(system, options);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(system.modes());
  method.start(-options.first, Eigen::VectorXd::Unit(system.modes(), k) * 1e-3, rest);
  for (int step = 0; step < 2000; ++step) method.step(1e9);
  const double first = method.state().eta(k);
  for (int step = 0; step < 2000 * periods; ++step) method.step(1e9);
  return std::log(first / method.state().eta(k)) / periods;
}

TEST(DampingTable, IsLinearBetweenItsRowsAndConstantOutside) {
  const rom::DampingTable table = bar_with_table().modal_damping;
  EXPECT_DOUBLE_EQ(table.at(10.0), 0.01);
  EXPECT_DOUBLE_EQ(table.at(1000.0), 0.01);
  EXPECT_DOUBLE_EQ(table.at(2000.0), 0.015);
  EXPECT_DOUBLE_EQ(table.at(5000.0), 0.03);
  EXPECT_DOUBLE_EQ(table.at(1e6), 0.03);
  EXPECT_EQ(rom::DampingTable{}.at(100.0), 0.0);
}

TEST(ModalDamping, FreeVibrationOfEachModeDiesAwayByItsTableRow) {
  const ModalBody body = make_modal_body(bar_with_table(), {});
  const rom::DampingTable table = bar_with_table().modal_damping;
  for (const int k : {0, 1, 2}) {
    const double hz = std::sqrt(body.omega_squared(k)) / (2.0 * std::numbers::pi);
    const double zeta = table.at(hz);
    const double expected = 2.0 * std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta);
    // Second order with 2000 steps a period: (2 pi / 2000)^2 = 1e-5 of the motion.
    EXPECT_NEAR(decrement(body, k, zeta, 5), expected, 1e-5 * expected) << hz;
  }
}

TEST(ModalDamping, LossFactorsAreThoseOfEachModeAtItsOwnFrequency) {
  // Half of the bar loses energy.
  rom::ReducedModel bar = clamped_bar(1.0, 100, 10);
  bar.loss = 0.02 * bar.K_rr;
  const Eigen::Index half = bar.loss.rows() / 2;
  bar.loss.topRows(half).setZero();
  bar.loss.leftCols(half).setZero();
  const ModalBody body = make_modal_body(bar, {});
  for (const int k : {0, 1, 2}) {
    const Eigen::VectorXd shape = body.shapes.col(k);
    const double eta = shape.dot(bar.loss * shape) / body.omega_squared(k);
    EXPECT_GT(eta, 0.0);
    EXPECT_NEAR(body.damping(k), eta * std::sqrt(body.omega_squared(k)), 1e-12 * body.damping(k));
    const double zeta = 0.5 * eta;
    const double expected = 2.0 * std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta);
    EXPECT_NEAR(decrement(body, k, zeta, 5), expected, 1e-4 * expected);
  }
}

TEST(ModalDamping, RayleighAndTableAddUp) {
  rom::ReducedModel bar = bar_with_table();
  bar.alpha = 5e-7;
  bar.beta = 40.0;
  const ModalBody body = make_modal_body(bar, {});
  for (const int k : {0, 2}) {
    const double omega = std::sqrt(body.omega_squared(k));
    const double zeta = bar.modal_damping.at(omega / (2.0 * std::numbers::pi)) +
                        0.5 * (bar.alpha * omega + bar.beta / omega);
    EXPECT_NEAR(body.damping(k), 2.0 * zeta * omega, 1e-12 * body.damping(k));
    const double expected = 2.0 * std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta);
    EXPECT_NEAR(decrement(body, k, zeta, 5), expected, 1e-5 * expected);
  }
}

TEST(ModalDamping, RigidMotionsAreNotDamped) {
  rom::ReducedModel block = testing::elastic_block(0.0535, 6, 4);
  block.modal_damping.hz = Eigen::VectorXd::Constant(1, 500.0);
  block.modal_damping.ratio = Eigen::VectorXd::Constant(1, 0.02);
  const ModalBody body = make_modal_body(block, {});
  EXPECT_EQ(body.damping.head(6).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT(body.damping(6), 2.0 * 0.02 * std::sqrt(body.omega_squared(6)));  // alpha adds
}

TEST(ModalDamping, TheTableRoundTripsAndASenselessOneIsRefused) {
  const std::filesystem::path path =
      std::filesystem::path(::testing::TempDir()) / "clatter_damping.rom.h5";
  rom::ReducedModel bar = bar_with_table();
  testing::write_rom(path, bar);
  const rom::DampingTable back = rom::read_reduced_model(path).modal_damping;
  EXPECT_EQ(back.hz, bar.modal_damping.hz);
  EXPECT_EQ(back.ratio, bar.modal_damping.ratio);
  bar.modal_damping.hz[1] = 500.0;
  testing::write_rom(path, bar);
  const auto refusal = [&] { return test::refusal_of([&] { rom::read_reduced_model(path); }); };
  EXPECT_EQ(refusal(),
            path.string() +
                ": modal_damping: found 500 Hz in row 2, expected positive, ascending frequencies");
  bar.modal_damping = {Eigen::VectorXd::Constant(1, 500.0), Eigen::VectorXd::Constant(1, 1.5)};
  testing::write_rom(path, bar);
  EXPECT_EQ(refusal(), path.string() +
                           ": modal_damping: found ratio 1.5 in row 1, expected 0 or more and less "
                           "than 1 (critical)");
}

}  // namespace
}  // namespace clatter::dynamics
