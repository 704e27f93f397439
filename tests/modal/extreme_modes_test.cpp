// SPDX-License-Identifier: GPL-3.0-or-later
// Models at their limits: positions far from the origin, tiny and huge units, heavy masses, cells
// far too flat, copies of a part, permuted nodes, soft and stiff springs, a limit at an eigenvalue.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "assembly/load/mass_properties.hpp"
#include "core/base/error.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/mesh/boundary.hpp"
#include "core/modes/analysis.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "core/sparse/eigen/mode_values.hpp"
#include "tests/assembly/two_parts.hpp"
#include "tests/condense/solid_model.hpp"
#include "tests/observed.hpp"
#include "tests/refusal.hpp"

namespace clatter::modal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using fe::FeModel;
using test::expect_at_most;

constexpr sparse::EigenMethod kExact[] = {sparse::EigenMethod::kBlockLanczos,
                                          sparse::EigenMethod::kArpack};

mesh::Mesh short_bar() {
  return test::bar_mesh({0.3, 0.1, 0.1}, {4, 2, 2}, mesh::CellType::kHex20);
}

sparse::ModeSet modes_of(const FeModel& model, int count,
                         sparse::EigenMethod method = sparse::EigenMethod::kBlockLanczos) {
  modes::ModesOptions options;
  options.count = count;
  options.method = method;
  return modes::analyse(model, options).modes;
}

/// Frequencies by a dense solver [Hz], rigid ones as rounding leaves them.
VectorXd dense_hz(const FeModel& model) {
  const VectorXd values =
      dense::symmetric_eigen(sparse::dense_symmetric(model.K), sparse::dense_symmetric(model.M),
                             dense::EigenParts::kValues)
          .values;
  VectorXd hz(values.size());
  for (Eigen::Index j = 0; j < hz.size(); ++j)
    hz[j] = sparse::hz_of_value(std::max(values[j], 0.0));
  return hz;
}

double largest_change(const VectorXd& found, const VectorXd& expected, Eigen::Index first,
                      Eigen::Index end) {
  double worst = 0.0;
  for (Eigen::Index j = first; j < end; ++j)
    worst = std::max(worst, std::abs(found[j] / expected[j] - 1.0));
  return worst;
}

TEST(HardF2, APartFarFromTheOriginHasItsMassPropertiesAndModes) {
  const FeModel near = test::model_of(short_bar(), test::steel_toml());
  const VectorXd expected = modes_of(near, 16).frequencies_hz();
  for (const double lengths : {1e3, 1e5}) {
    mesh::Mesh mesh = short_bar();
    const Eigen::RowVector3d offset = 0.3 * lengths * Eigen::RowVector3d(0.8, -0.6, 0.5);
    mesh.nodes.rowwise() += offset;
    const FeModel far = test::model_of(mesh, test::steel_toml());
    const double inertia = (far.mass.inertia - near.mass.inertia).norm() / near.mass.inertia.norm();
    // Coordinates are rounded to 1e-16 of the offset.
    expect_at_most(fmt::format("error of the inertia at {:.0e} lengths", lengths), inertia,
                   1e-14 * lengths + 1e-13);
    expect_at_most("shift of the centre over the length",
                   (far.mass.centre - near.mass.centre - offset.transpose()).norm() / 0.3,
                   1e-14 * lengths);
    const sparse::ModeSet modes = modes_of(far, 16);
    EXPECT_EQ(modes.rigid, 6);
    EXPECT_TRUE(modes.proof.proved);
    expect_at_most("change of frequencies", largest_change(modes.frequencies_hz(), expected, 6, 16),
                   1e-12 * lengths);
  }
}

TEST(HardF3, AHeavyPointMassLeavesThePartItsMassProperties) {
  // The mass is in the end face's centre: the bar turns about it as if that were fixed.
  for (const double mass : {1.0, 1e9}) {
    const FeModel model = test::model_of(
        short_bar(), test::steel_toml() +
                         "[[coupling]]\nname = \"hub\"\nnode_set = \"x0\"\n[[point_mass]]\non = "
                         "\"hub\"\nmass = " +
                         std::to_string(mass) + "\n");
    // 24 kg of 0.3 x 0.1 x 0.1 m at x = 0.15 m and the mass at x = 0.
    const double reduced = 24.0 * mass / (24.0 + mass);
    const double yy = 24.0 * (0.09 + 0.01) / 12.0 + reduced * 0.0225;
    expect_at_most(fmt::format("error of the inertia with {:.0e} kg", mass),
                   std::abs(model.mass.inertia(1, 1) / yy - 1.0), 1e-12);
    expect_at_most(
        "error of R^T M R",
        assembly::compare(assembly::properties_of(model.M, model.rigid), model.mass).inertia,
        1e-10);
    EXPECT_EQ(modes_of(model, 10).rigid, 6);
  }
}

TEST(HardF5, TouchingPartsAndCopiesKeepAllTheirModes) {
  // Eight equal bars, each touching the next with coincident nodes: all frequencies eight times.
  const mesh::Mesh one = short_bar();
  const VectorXd expected = dense_hz(test::model_of(one, test::steel_toml()));
  mesh::Mesh all = one;
  for (int copy = 1; copy < 8; ++copy) {
    const auto first = static_cast<int32_t>(all.nodes.rows());
    all.nodes.conservativeResize(first + one.nodes.rows(), 3);
    all.nodes.bottomRows(one.nodes.rows()) =
        one.nodes.rowwise() + Eigen::RowVector3d(0.3 * copy, 0, 0);
    for (mesh::CellBlock block : one.cells) {
      block.nodes.array() += first;
      all.cells.push_back(block);
    }
  }
  all.node_sets.clear();
  all.surfaces.clear();
  all.surfaces["skin"] = mesh::skin_of(mesh::boundary_faces(all));
  const FeModel model = test::model_of(all, test::steel_toml());
  for (const sparse::EigenMethod method : kExact) {
    const sparse::ModeSet modes = modes_of(model, 48 + 40, method);
    EXPECT_EQ(modes.rigid, 48);
    EXPECT_TRUE(modes.proof.proved);
    const VectorXd hz = modes.frequencies_hz();
    double worst = 0.0;
    for (Eigen::Index j = 0; j < 40; ++j)
      worst = std::max(worst, std::abs(hz[48 + j] / expected[6 + j / 8] - 1.0));
    expect_at_most(std::string(sparse::name_of(method)) + ", copies of a frequency: difference",
                   worst, 1e-9);
  }
}

TEST(HardF6, CellsThatAreTooFlatAreRefusedWhereRoundingLeavesNoDigit) {
  // Free square plates of quadratic cells with edges of 0.25 m, nu = 0.
  const auto plate = [](double thickness) {
    return test::solid_bar({1.0, 1.0, thickness}, {4, 4, 1}, 0.0, "", mesh::CellType::kHex20);
  };
  // Thin plates follow their thickness, up to what rounding is reported to add.
  const VectorXd thick = modes_of(plate(2e-3), 10).frequencies_hz();
  const sparse::ModeSet thin = modes_of(plate(1e-3), 10);
  const double change = largest_change(2.0 * thin.frequencies_hz(), thick, 6, 10);
  expect_at_most("1 mm on 1 m: change of f / t", change, 5e-3 + thin.rounding.maxCoeff());
  expect_at_most("1 mm on 1 m: rounding as reported", thin.rounding.maxCoeff(), 1e-2);
  for (const double thickness : {1e-4, 1e-5}) {
    const std::string message =
        test::refusal_of<NumericsError>([&] { modes_of(plate(thickness), 10); });
    EXPECT_NE(message.find("flat"), std::string::npos) << message;
    EXPECT_NE(message, "accepted");
    test::observed("refused: " + message);
  }
}

TEST(HardF10, UnitsOfLengthFromNanometresToMegametresGiveTheSameModes) {
  const VectorXd expected =
      modes_of(test::model_of(short_bar(), test::steel_toml()), 14).frequencies_hz();
  for (const double scale : {1e-9, 1e-6, 1e3, 1e6}) {
    mesh::Mesh mesh = short_bar();
    mesh.nodes *= scale;
    const sparse::ModeSet modes = modes_of(test::model_of(mesh, test::steel_toml()), 14);
    EXPECT_EQ(modes.rigid, 6);
    EXPECT_TRUE(modes.proof.proved);
    expect_at_most(fmt::format("lengths times {:.0e}: change of f l", scale),
                   largest_change(scale * modes.frequencies_hz(), expected, 6, 14), 1e-11);
  }
}

TEST(HardF11, PermutedNodesAndCellsGiveTheSameModes) {
  const mesh::Mesh given = short_bar();
  const VectorXd expected = dense_hz(test::model_of(given, test::steel_toml()));
  std::mt19937 random(5);
  for (int k = 0; k < 3; ++k) {
    std::vector<int32_t> to(static_cast<size_t>(given.nodes.rows()));
    std::iota(to.begin(), to.end(), 0);
    std::shuffle(to.begin(), to.end(), random);
    mesh::Mesh mesh = given;
    mesh.node_sets.clear();
    mesh.surfaces.clear();
    for (Eigen::Index a = 0; a < given.nodes.rows(); ++a)
      mesh.nodes.row(to[a]) = given.nodes.row(a);
    for (mesh::CellBlock& block : mesh.cells) {
      for (int32_t& node : block.nodes.reshaped()) node = to[node];
      block.nodes = block.nodes.colwise().reverse().eval();
    }
    mesh.surfaces["skin"] = mesh::skin_of(mesh::boundary_faces(mesh));
    const sparse::ModeSet modes = modes_of(test::model_of(mesh, test::steel_toml()), 20);
    EXPECT_EQ(modes.rigid, 6);
    expect_at_most("change of frequencies", largest_change(modes.frequencies_hz(), expected, 6, 20),
                   1e-10);
  }
}

/// The bar on springs to the ground at the point of a coupling, in all six directions.
FeModel on_springs(double stiffness) {
  std::string toml = test::steel_toml() +
                     "[[point]]\nname = \"p\"\nat = [0.0, 0.05, 0.05]\n[[coupling]]\nnode_set = "
                     "\"x0\"\npoint = \"p\"\n";
  for (const char* direction : {"x", "y", "z", "rx", "ry", "rz"})
    toml += fmt::format(
        "[[spring]]\nname = \"s{0}\"\nstiffness = {1:e}\nterms = [{{ point = \"p\", direction = "
        "\"{0}\" }}]\n",
        direction, stiffness);
  return test::model_of(short_bar(), toml);
}

TEST(HardF12, SpringsFromSoftToRigidGiveModesFromFreeToClamped) {
  const VectorXd free_hz =
      modes_of(test::model_of(short_bar(), test::steel_toml()), 12).frequencies_hz();
  const VectorXd clamped = modes_of(on_springs(1e15), 8).frequencies_hz();
  // Beyond 1e15 N/m nothing moves there any more, up to forces that no double could subtract.
  for (const double stiffness : {1e18, 1e25}) {
    const sparse::ModeSet modes = modes_of(on_springs(stiffness), 8);
    EXPECT_EQ(modes.rigid, 0);
    EXPECT_TRUE(modes.proof.proved);
    expect_at_most(fmt::format("{:.0e} N/m: change of frequencies", stiffness),
                   largest_change(modes.frequencies_hz(), clamped, 0, 8), 1e-4);
  }
  // A rigid body on springs: along x alone the mass of 24 kg is on one. Motions that springs hold
  // by less than 1e-10 of the stiffness in their rows are reported as free, 0 Hz; the elastic modes
  // stay right.
  for (const double stiffness : {1e4, 1e3, 1e2, 1.0}) {
    const sparse::ModeSet soft = modes_of(on_springs(stiffness), 8);
    EXPECT_TRUE(soft.proof.proved);
    const VectorXd hz = soft.frequencies_hz();
    expect_at_most(fmt::format("{:.0e} N/m: change of the elastic frequencies", stiffness),
                   largest_change(hz, free_hz, 6, 8),
                   2e-8 * stiffness + 1e-7);  // (k / I) / omega^2 / 2 of the springs themselves
    expect_at_most("modes reported as free", soft.rigid, stiffness > 5e3 ? 0.0 : 6.0);
    if (soft.rigid > 0) continue;
    const double x_hz = std::sqrt(stiffness / 24.0) / (2.0 * M_PI);
    double nearest = 1.0;
    for (Eigen::Index j = 0; j < 6; ++j) nearest = std::min(nearest, std::abs(hz[j] / x_hz - 1.0));
    expect_at_most("error of the rigid body on the spring", nearest, 1e-5);
  }
  const sparse::ModeSet none = modes_of(on_springs(1e-6), 8);
  EXPECT_EQ(none.rigid, 6);
  expect_at_most("1e-6 N/m: change of the elastic frequencies",
                 largest_change(none.frequencies_hz(), free_hz, 6, 8), 1e-9);
}

TEST(HardF13, ALimitExactlyAtADoubleEigenvalueIsCountedOrRefused) {
  const FeModel model = test::model_of(short_bar(), test::steel_toml());
  const sparse::ModeSet all = modes_of(model, 10);
  const double pair = all.frequencies_hz()[6];
  ASSERT_NEAR(all.frequencies_hz()[7] / pair, 1.0, 1e-10);
  int refused = 0;
  for (const double factor : {1.0 - 1e-9, 1.0 - 1e-15, 1.0, 1.0 + 1e-15, 1.0 + 1e-9}) {
    modes::ModesOptions options;
    options.fmax_hz = factor * pair;
    try {
      const sparse::ModeSet below = modes::analyse(model, options).modes;
      EXPECT_TRUE(below.proof.proved);
      EXPECT_EQ(below.size(), below.proof.below) << factor;
      if (factor < 1.0 - 1e-10) {
        EXPECT_EQ(below.size(), 6);
      }
      if (factor > 1.0 + 1e-10) {
        EXPECT_EQ(below.size(), 8);
      }
    } catch (const NumericsError& error) {
      ++refused;  // a limit within the eigenvalue's rounding
      EXPECT_LT(std::abs(factor - 1.0), 1e-10) << error.what();
    }
  }
  expect_at_most("limits refused, of three within rounding", refused, 3.0);
}

}  // namespace
}  // namespace clatter::modal
