// SPDX-License-Identifier: GPL-3.0-or-later
// Loss factors of materials, gaskets and springs, through modes, reduction and assembly.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <numbers>

#include "condense/export/pencil_modes.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/fe/shell_section.hpp"
#include "core/modes/analysis.hpp"
#include "sheet.hpp"
#include "tests/condense/part_files.hpp"

namespace clatter::condense {
namespace {

using namespace testing;
using assembly::testing::full;

std::string with_loss(const std::string& material, double loss_factor) {
  return material + fmt::format("loss_factor = {}\n", loss_factor);
}

modes::PartModes modes_of_model(const fe::FeModel& model, int count) {
  modes::ModesOptions options;
  options.count = count;
  return modes::analyse(model, options);
}

/// Loss factors by the eigenvalues of M^{-1} (K + i loss), ascending.
VectorXd complex_loss_factors(const fe::FeModel& model) {
  const Eigen::MatrixXd M = full(model.M), K = full(model.K), loss = full(model.loss);
  const Eigen::LLT<Eigen::MatrixXd> factor(M);
  const auto scaled = [&](const Eigen::MatrixXd& A) -> Eigen::MatrixXd {
    const Eigen::MatrixXd half = factor.matrixL().solve(A);
    return factor.matrixL().solve(half.transpose());
  };
  Eigen::MatrixXcd A = scaled(K).cast<std::complex<double>>();
  A += std::complex<double>(0.0, 1.0) * scaled(loss).cast<std::complex<double>>();
  Eigen::VectorXcd values = Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(A, false).eigenvalues();
  std::sort(values.begin(), values.end(),
            [](const auto& a, const auto& b) { return a.real() < b.real(); });
  return values.imag().cwiseQuotient(values.real());
}

TEST(LossFactors, OfOneMaterialAreThoseOfEveryModeThroughTheReduction) {
  const fe::FeModel model = build_all(block({4, 2, 2}, CellType::kHex8),
                                      material("body", with_loss(kIron, 0.013)) + kept("z1"))
                                .model;
  const Eigen::MatrixXd K = full(model.K);
  EXPECT_LT((full(model.loss) - 0.013 * K).norm(), 1e-9 * 0.013 * K.norm());
  const modes::PartModes found = modes_of_model(model, 16);
  for (int k = 6; k < 16; ++k) EXPECT_NEAR(found.loss_factors(k), 0.013, 1e-9);
  EXPECT_EQ(found.loss_factors(0), 0.0);
  EXPECT_NE(modes::describe(found)[8].find("loss factor 1.30e-02"), std::string::npos);
  const rom::ReducedModel reduced = reduced_again(model, "joint", below(30e3));
  EXPECT_LT((reduced.loss - 0.013 * reduced.K_rr).norm(), 1e-9 * 0.013 * reduced.K_rr.norm());
  modes::ModesOptions options;
  options.count = 16;
  const modes::PartModes again = modes::analyse(reduced, options);
  for (int k = 6; k < 16; ++k) EXPECT_NEAR(again.loss_factors(k), 0.013, 1e-8);
  // 2 zeta omega = eta omega, in time domain and exports.
  const PencilModes modes = elastic_modes_of(reduced);
  const VectorXd rates = reduced.damping_rates(modes.Lambda, modes.Phi);
  for (Eigen::Index k = 0; k < rates.size(); ++k)
    EXPECT_NEAR(rates(k), 0.013 * std::sqrt(modes.Lambda(k)), 1e-8 * rates(k));
  const Eigen::MatrixXd D = modes.Phi.transpose() * damping_of(reduced) * modes.Phi;
  EXPECT_LT((D - Eigen::MatrixXd(rates.asDiagonal())).norm(), 1e-7 * rates.norm());
}

TEST(LossFactors, OfTwoMaterialsAndAGasketAreThoseOfComplexEigenvalues) {
  const mesh::Mesh mesh = assembly::testing::two_parts(block({4, 2, 1}, CellType::kHex8),
                                                       plate({4, 2, 1}, CellType::kHex8));
  const auto engine = [&](double iron, double aluminium, double of_gasket) {
    return build_all(mesh, "[material.a]\nregions = [\"a\"]\n" + with_loss(kIron, iron) +
                               "[material.b]\nregions = [\"b\"]\n" +
                               with_loss(kAluminium, aluminium) +
                               gasket(1e12, 1e11, "b_z0", "a_z1") +
                               fmt::format("loss_factor = {}\n", of_gasket))
        .model;
  };
  const fe::FeModel model = engine(1e-4, 5e-5, 1.5e-3);
  const VectorXd expected = complex_loss_factors(model);
  const modes::PartModes found = modes_of_model(model, 26);
  double least = 1.0, most = 0.0;
  for (int k = 6; k < 26; ++k) {
    EXPECT_NEAR(found.loss_factors(k), expected(k), 2e-3 * expected(k)) << k;
    least = std::min(least, expected(k));
    most = std::max(most, expected(k));
  }
  EXPECT_GT(most, 3.0 * least);
  // Each is a share of the energy: the gasket alone, the cells alone.
  const VectorXd alone = modes_of_model(engine(0.0, 0.0, 1.5e-3), 26).loss_factors,
                 cells = modes_of_model(engine(1e-4, 5e-5, 0.0), 26).loss_factors;
  EXPECT_LT((alone + cells - found.loss_factors).norm(), 1e-8);
}

TEST(LossFactors, OfASpringBetweenRigidMassesIsThatOfTheirBounce) {
  const mesh::Mesh mesh = assembly::testing::two_parts(block({2, 1, 1}, CellType::kHex8),
                                                       plate({2, 1, 1}, CellType::kHex8));
  const fe::FeModel model =
      build_all(mesh, "[material.a]\nregions = [\"a\"]\n" + kIron +
                          "[material.b]\nregions = [\"b\"]\n" + kAluminium +
                          gasket(1e8, 1e8, "b_z0", "a_z1") + "loss_factor = 0.2\n")
          .model;
  const modes::PartModes found = modes_of_model(model, 12);
  // Six motions of one against the other: all elastic energy is that of the joint.
  for (int k = 6; k < 12; ++k) EXPECT_NEAR(found.loss_factors(k), 0.2, 2e-4) << k;
}

TEST_F(CompleteParts, CarryTheirLossFactorsIntoTheAssembly) {
  const std::string iron = with_loss(kIron, 0.002), aluminium = with_loss(kAluminium, 0.01);
  const fe::FeModel a =
      build_all(block({4, 2, 2}, CellType::kHex8), material("body", iron) + kept("z1")).model;
  const fe::FeModel b =
      build_all(plate({3, 2, 1}, CellType::kHex8), material("body", aluminium) + kept("z0")).model;
  const fe::FeModel engine = joined(part("block", reduced_file("block", a, complete(a))) +
                                    part("plate", reduced_file("plate", b, complete(b))) + kTie)
                                 .model;
  const fe::FeModel mesh =
      build_all(assembly::testing::two_parts(block({4, 2, 2}, CellType::kHex8),
                                             plate({3, 2, 1}, CellType::kHex8)),
                "[material.a]\nregions = [\"a\"]\n" + iron + "[material.b]\nregions = [\"b\"]\n" +
                    aluminium + "[[tie]]\nslave = \"b_z0\"\nmaster = \"a_z1\"\n")
          .model;
  const VectorXd found = modes_of_model(engine, 20).loss_factors,
                 expected = modes_of_model(mesh, 20).loss_factors;
  for (int k = 6; k < 20; ++k) EXPECT_NEAR(found(k), expected(k), 1e-7) << k;
  EXPECT_GT(found.tail(14).maxCoeff(), 1.5 * found.tail(14).minCoeff());
}

/// Steel, a soft core that loses energy, steel: bending with the shear of the core in series.
TEST(LossFactors, OfAConstrainedLayerAreThoseOfItsShearInBending) {
  constexpr double kLength = 0.3, kEta = 0.3;
  const std::string toml = fmt::format(
      "[material.steel]\nE = 2e11\nnu = 0.0\nrho = 8000.0\n"
      "[material.core]\nE = 2e7\nnu = 0.0\nrho = 1000.0\nloss_factor = {}\n"
      "[[shell]]\nregions = [\"sheet\"]\n"
      "[[shell.layer]]\nmaterial = \"steel\"\nthickness = 0.001\n"
      "[[shell.layer]]\nmaterial = \"core\"\nthickness = 0.0005\n"
      "[[shell.layer]]\nmaterial = \"steel\"\nthickness = 0.001\n"
      "[[support]]\nname = \"left\"\nnode_set = \"x0\"\ndirections = \"z\"\n"
      "[[support]]\nname = \"right\"\nnode_set = \"x1\"\ndirections = \"z\"\n",
      kEta);
  const fe::FeModel model = build_all(assembly::testing::sheet(kLength, 0.03, 60, 2), toml).model;
  const fe::ShellStiffness law =
      fe::stiffness_of(model.cells.sections[0], model.cells.materials[0], 0.0025);
  const double D = law.D(0, 0), S = law.S(0, 0), mass = law.mass.total;
  const modes::PartModes found = modes_of_model(model, 12);
  for (int half_waves = 1; half_waves <= 3; ++half_waves) {
    const double k = half_waves * std::numbers::pi / kLength, soft = D * k * k / S;
    const double hz = k * k * std::sqrt(D / mass / (1.0 + soft)) / (2.0 * std::numbers::pi);
    Eigen::Index nearest = 0;
    (found.modes.frequencies_hz().array() / hz - 1.0).abs().minCoeff(&nearest);
    EXPECT_NEAR(found.modes.frequencies_hz()(nearest) / hz, 1.0, 0.01) << half_waves;
    EXPECT_NEAR(found.loss_factors(nearest), kEta * soft / (1.0 + soft), 0.02 * kEta) << half_waves;
  }
}

}  // namespace
}  // namespace clatter::condense
