// SPDX-License-Identifier: GPL-3.0-or-later
// Boundaries at their limits: as many DoFs as rigid motions, sets that overlap, all modes of the
// interior; jumps of stiffness and of mass at the boundary.
#include <gtest/gtest.h>

#include "condense/condense.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "core/sparse/eigen/mode_values.hpp"
#include "tests/condense/solid_model.hpp"
#include "tests/observed.hpp"
#include "tests/refusal.hpp"

namespace clatter::condense {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::expect_at_most;

constexpr const char* kHub = "[[coupling]]\nname = \"hub\"\nnode_set = \"x0\"\n";
constexpr const char* kFoot = "[[nodes]]\nname = \"foot\"\nnode_set = \"x0\"\n";

rom::ReducedModel reduce_extreme(const fe::FeModel& model, std::vector<std::string> boundary,
                                 int count, const std::string& method = "craig-bampton") {
  CondenseOptions options;
  options.method = method;
  options.boundary = std::move(boundary);
  options.modes.count = count;
  options.modes.frequency_error = 0.0;
  options.skin = {};
  StepClock clock;
  return condense(model, options, clock);
}

/// All eigenvalues, ascending, by a dense solver.
VectorXd dense_spectrum(const MatrixXd& K, const MatrixXd& M) {
  return dense::symmetric_eigen(K, M, dense::EigenParts::kValues).values;
}

VectorXd dense_spectrum(const fe::FeModel& model) {
  return dense_spectrum(sparse::dense_symmetric(model.K), sparse::dense_symmetric(model.M));
}

TEST(HardF1, ABodyOnOneCouplingIsReducedWithFewerModesThanItHasRigidMotions) {
  const fe::FeModel model =
      test::solid_bar({0.3, 0.1, 0.1}, {4, 2, 2}, 0.3, kHub, mesh::CellType::kHex20);
  const VectorXd full = dense_spectrum(model);
  double mass_error = 0.0, below = 1.0, wrong_count = 0.0;
  for (const int count : {1, 2, 5, 6, 20}) {
    const rom::ReducedModel reduced = reduce_extreme(model, {"hub"}, count);
    ASSERT_EQ(reduced.size(), 6 + count);
    mass_error = std::max(mass_error, *reduced.certificate.mass_error);
    wrong_count = std::max(wrong_count, std::abs(*reduced.certificate.rigid_modes - 6.0));
    // Rayleigh: frequencies of a subspace are not below those of the body.
    const VectorXd values = dense_spectrum(reduced.K_rr, reduced.M_rr);
    for (int j = 6; j < values.size(); ++j) below = std::min(below, values[j] / full[j]);
    EXPECT_NEAR(*reduced.certificate.first_elastic_hz, sparse::hz_of_value(values[6]),
                1e-8 * sparse::hz_of_value(values[6]));
  }
  expect_at_most("rigid motions too many or too few", wrong_count, 0.0);
  expect_at_most("error of ten mass properties", mass_error, 1e-12);
  test::expect_at_least("eigenvalue over the body's own", below, 1.0 - 1e-9);
}

TEST(HardF1, ABodyOnOneCouplingIsARigidBodyByGuyan) {
  const fe::FeModel model =
      test::solid_bar({0.3, 0.1, 0.1}, {4, 2, 2}, 0.3, kHub, mesh::CellType::kHex20);
  const rom::ReducedModel reduced = reduce_extreme(model, {"hub"}, 0, "guyan");
  ASSERT_EQ(reduced.size(), 6);
  EXPECT_EQ(*reduced.certificate.rigid_modes, 6.0);
  expect_at_most("stiffness left over that of the part",
                 reduced.K_rr.cwiseAbs().maxCoeff() / model.K.coeffs().abs().maxCoeff(), 1e-12);
  expect_at_most("error of ten mass properties", *reduced.certificate.mass_error, 1e-12);
}

TEST(HardF7, AllModesOfTheInteriorGiveTheFullModel) {
  const fe::FeModel model =
      test::solid_bar({0.3, 0.1, 0.1}, {4, 2, 2}, 0.3, kFoot, mesh::CellType::kHex20);
  const int interior = static_cast<int>(model.size()) - 63;
  ASSERT_GT(interior, 300);  // not in the range of the dense solver
  const VectorXd full = dense_spectrum(model);
  const rom::ReducedModel reduced = reduce_extreme(model, {"foot"}, interior);
  const VectorXd values = dense_spectrum(reduced.K_rr, reduced.M_rr);
  ASSERT_EQ(values.size(), full.size());
  double error = 0.0;
  for (Eigen::Index j = 6; j < full.size(); ++j)
    error = std::max(error, std::abs(values[j] / full[j] - 1.0));
  expect_at_most("error of the complete spectrum", error, 1e-9);
  test::expect_parts(test::refusal_of([&] { reduce_extreme(model, {"foot"}, interior + 1); }),
                     {"count = 361", "at most 360"});
}

TEST(HardF8, OverlappingBoundarySetsGiveOneCoordinateADoF) {
  const std::string corner =
      std::string(kFoot) + "[[nodes]]\nname = \"all\"\nnode_set = \"corner\"\n";
  mesh::Mesh mesh = test::bar_mesh({0.3, 0.1, 0.1}, {4, 2, 2}, mesh::CellType::kHex20);
  mesh.node_sets["corner"] = {mesh.node_sets.at("x0").front(), mesh.node_sets.at("x0").back()};
  const fe::FeModel model = test::model_of(mesh, test::steel_toml() + corner);
  const rom::ReducedModel once = reduce_extreme(model, {"foot"}, 10);
  for (const auto& order : {std::vector<std::string>{"foot", "all"}, {"all", "foot"}}) {
    const rom::ReducedModel both = reduce_extreme(model, order, 10);
    ASSERT_EQ(both.size(), once.size());
    const VectorXd a = dense_spectrum(once.K_rr, once.M_rr),
                   b = dense_spectrum(both.K_rr, both.M_rr);
    double error = 0.0;
    for (Eigen::Index j = 6; j < a.size(); ++j)
      error = std::max(error, std::abs(b[j] / a[j] - 1.0));
    expect_at_most("difference of the reduced spectra", error, 1e-9);
  }
  test::expect_parts(test::refusal_of([&] {
                       reduce_extreme(model, {"foot", "foot"}, 10);
                     }),
                     {"set \"foot\" is named twice"});
  test::expect_parts(test::refusal_of([&] { reduce_extreme(model, {"all"}, 10); }),
                     {"its 6 coordinates hold 5 of the body's 6 rigid motions", "rotation"});
  test::observed("refused: a boundary of two nodes, which leaves a rotation about their line");
}

/// A bar whose half x > `at` is `jump` times softer; both halves share the nodes between them.
fe::FeModel two_materials(double jump) {
  mesh::Mesh mesh = test::bar_mesh({0.3, 0.1, 0.1}, {6, 2, 2}, mesh::CellType::kHex20);
  const mesh::CellBlock all = mesh.cells.front();
  std::vector<Eigen::Index> in[2];
  for (Eigen::Index c = 0; c < all.nodes.rows(); ++c)
    in[mesh.nodes(all.nodes(c, 0), 0) < 0.149 ? 0 : 1].push_back(c);
  mesh.regions = {"hard", "soft"};
  mesh.cells.clear();
  for (int32_t region = 0; region < 2; ++region)
    mesh.cells.push_back({all.type, region, all.nodes(in[region], Eigen::all), {}});
  const auto material = [](const std::string& name, double E) {
    return fmt::format("[material.{0}]\nregions = [\"{0}\"]\nE = {1}\nnu = 0.3\nrho = 8000.0\n",
                       name, E);
  };
  return test::model_of(mesh, material("hard", 2e11) + material("soft", 2e11 / jump) + kFoot);
}

TEST(HardF9, AJumpOfStiffnessAtSharedNodesIsCondensedWithItsCertificate) {
  // Once the hard half is rigid beside the soft one, frequencies are those of the soft material.
  const rom::ReducedModel near = reduce_extreme(two_materials(1e6), {"foot"}, 12);
  const rom::ReducedModel far = reduce_extreme(two_materials(1e10), {"foot"}, 12);
  expect_at_most("first frequency over its limit for a rigid half, less 1",
                 std::abs(*far.certificate.first_elastic_hz * 1e5 /
                              (*near.certificate.first_elastic_hz * 1e3) -
                          1.0),
                 1e-4);
  expect_at_most("error of ten mass properties", *far.certificate.mass_error, 1e-11);
  expect_at_most("stiffness of rigid motions", *far.certificate.rigid_stiffness_residue, 1e-10);
  EXPECT_EQ(*far.certificate.rigid_modes, 6.0);
  EXPECT_EQ(*far.certificate.count_proved, 1.0);
}

TEST(HardF3, AHeavyPointMassLeavesThePartItsMassPropertiesInTheReducedModel) {
  const fe::FeModel model = test::solid_bar(
      {0.3, 0.1, 0.1}, {4, 2, 2}, 0.3,
      std::string(kHub) + "[[point_mass]]\non = \"hub\"\nmass = 1e9\n", mesh::CellType::kHex20);
  const rom::ReducedModel reduced = reduce_extreme(model, {"hub"}, 8);
  expect_at_most("error of ten mass properties", *reduced.certificate.mass_error_elements, 1e-9);
  EXPECT_EQ(*reduced.certificate.rigid_modes, 6.0);
}

TEST(HardF2, APartFarFromTheOriginIsCondensedAsNearIt) {
  mesh::Mesh mesh = test::bar_mesh({0.3, 0.1, 0.1}, {4, 2, 2}, mesh::CellType::kHex20);
  const auto condensed = [&] {
    return reduce_extreme(test::model_of(mesh, test::steel_toml() + kHub), {"hub"}, 10);
  };
  const double near = *condensed().certificate.first_elastic_hz;
  mesh.nodes.rowwise() += Eigen::RowVector3d(3e4, -1e4, 2e4);  // 1e5 times the length
  const rom::ReducedModel far = condensed();
  expect_at_most("change of the first frequency",
                 std::abs(*far.certificate.first_elastic_hz / near - 1.0), 1e-6);
  expect_at_most("error of ten mass properties", *far.certificate.mass_error_elements, 1e-9);
  EXPECT_EQ(*far.certificate.rigid_modes, 6.0);
}

}  // namespace
}  // namespace clatter::condense
