// SPDX-License-Identifier: GPL-3.0-or-later
// Options of a .rom.toml besides boundary and modes.
#include <gtest/gtest.h>

#include "condense/condense.hpp"
#include "tests/refusal.hpp"

namespace clatter::condense {
namespace {

CondenseOptions parse(const std::string& text) {
  return condense_keys().read(
      Config::parse("boundary = [\"left\"]\ncount = 4\n" + text, "box.rom.toml"));
}

TEST(ModalDampingRows, AreReadInOrder) {
  const rom::DampingTable table = parse(
                                      "[[modal_damping]]\nhz = 500\nratio = 0.01\n"
                                      "[[modal_damping]]\nhz = 2000\nratio = 0.03\n")
                                      .modal_damping;
  EXPECT_EQ(table.hz, Eigen::VectorXd(Eigen::Vector2d(500.0, 2000.0)));
  EXPECT_EQ(table.ratio, Eigen::VectorXd(Eigen::Vector2d(0.01, 0.03)));
  EXPECT_TRUE(parse("").modal_damping.empty());
}

TEST(BadInput, ModalDampingOutOfOrderOrOverCriticalIsRefusedAtItsLine) {
  const auto refusal = [](const std::string& rows) {
    return test::refusal_of([&] { parse(rows); });
  };
  test::expect_parts(refusal("[[modal_damping]]\nhz = 500\nratio = 0.01\n"
                             "[[modal_damping]]\nhz = 400\nratio = 0.03\n"),
                     {"box.rom.toml:7", "hz", "400", "ascend"});
  test::expect_parts(refusal("[[modal_damping]]\nhz = 500\nratio = 1.0\n"), {"ratio", "critical"});
  test::expect_parts(refusal("[[modal_damping]]\nhz = 500\n"), {"ratio"});
  test::expect_parts(refusal("[[modal_damping]]\nhz = 500\nratio = 0.01\nzeta = 2\n"), {"zeta"});
  test::expect_parts(refusal("[[modal_damping]]\nhz = 0\nratio = 0.01\n"), {"hz"});
}

TEST(EigenSolverKeys, SayWhichSolverAndHowAccurate) {
  EXPECT_EQ(parse("").modes.method, sparse::EigenMethod::kBlockLanczos);
  const ModeRequest request = parse("eigen_solver = \"amls\"\naccuracy = 1e-3\n").modes;
  EXPECT_EQ(request.method, sparse::EigenMethod::kAmls);
  EXPECT_EQ(request.accuracy, 1e-3);
}

TEST(BadInput, AnAccuracyOutOfRangeAndAnUnknownSolverAreRefusedAtTheirLine) {
  const auto refusal = [](const std::string& rows) {
    return test::refusal_of([&] { parse(rows); });
  };
  test::expect_parts(refusal("eigen_solver = \"amls\"\naccuracy = 0.5\n"),
                     {"box.rom.toml:4", "accuracy", "0.5"});
  test::expect_parts(refusal("eigen_solver = \"amls\"\naccuracy = 0\n"), {"accuracy"});
  test::expect_parts(refusal("eigen_solver = \"aml\"\n"), {"box.rom.toml:3", "amls"});
}

}  // namespace
}  // namespace clatter::condense
