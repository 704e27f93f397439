// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include "assembly/constraint/elimination.hpp"
#include "assembly/coupling/coupling.hpp"
#include "assembly/load/mass_properties.hpp"
#include "block_mesh.hpp"
#include "core/base/error.hpp"
#include "core/dense/cholesky.hpp"
#include "core/dense/least_squares.hpp"
#include "core/fe/assemble.hpp"
#include "small_solver.hpp"
#include "tests/observed.hpp"
#include "tests/refusal.hpp"
#include "two_parts.hpp"

namespace clatter::assembly::testing {
namespace {

/// A random symmetric positive definite matrix (lower) and functionals on it.
struct RandomModel {
  SparseMatrix A;
  Coupling coupling;
  std::vector<int32_t> fixed = {4, 17, 18};
};

RandomModel random_model(int n) {
  RandomModel model;
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd B = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(generator); });
  Eigen::MatrixXd A = B * B.transpose();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (std::abs(i - j) > 7) A(i, j) = 0.0;  // holes, so that structure matters
  A.diagonal().array() += 100.0 * n;
  model.A = Eigen::MatrixXd(A.triangularView<Eigen::Lower>()).sparseView();
  for (int r = 0; r < 3; ++r) {
    Functional row;
    for (int k = 0; k < 9; ++k) {
      row.dofs.push_back(5 * r + 2 * k);
      row.values.push_back(normal(generator));
    }
    model.coupling.rows.push_back(row);
    model.coupling.set.labels.push_back("row");
  }
  return model;
}

TEST(AssemblyHard, HardE3_InPlaceTransformEqualsTheDenseProductOfCopies) {
  RandomModel model = random_model(40);
  Eliminator eliminator(40, model.fixed, {2, 7});
  eliminator.add(model.coupling, "test");
  const Elimination elimination = eliminator.finish();
  ASSERT_EQ(elimination.size(), 37);  // 40 less 3 fixed; 3 coordinates replace 3 pivots
  const Eigen::MatrixXd T = elimination.T;
  const Eigen::MatrixXd want = T.transpose() * full(model.A) * T;
  const SparseMatrix got = transform(SparseMatrix(model.A), elimination);
  test::expect_at_most("difference from the dense product",
                       (full(got) - want).cwiseAbs().maxCoeff() / want.cwiseAbs().maxCoeff(),
                       1e-12);
  // And it is a lower triangle with ascending rows.
  for (Eigen::Index c = 0; c < got.cols(); ++c) {
    Eigen::Index last = c - 1;
    for (SparseMatrix::InnerIterator it(got, c); it; ++it) {
      EXPECT_GT(it.row(), last);
      last = it.row();
    }
  }
}

TEST(AssemblyHard, HardE3_CouplingsOneByOneEqualAllAtOnce) {
  // Later rows contain pivots of earlier ones: substitution in both directions.
  RandomModel model = random_model(40);
  Eliminator together(40, model.fixed, {});
  together.add(model.coupling, "test");
  Eliminator apart(40, model.fixed, {});
  for (const Functional& row : model.coupling.rows) {
    Coupling one;
    one.rows = {row};
    one.set.labels = {"row"};
    apart.add(one, "test");
  }
  for (const Eliminator* eliminator : {&together, &apart}) {
    const Elimination e = eliminator->finish();
    const Eigen::MatrixXd T = e.T;
    for (int g = 0; g < 3; ++g) {
      Eigen::RowVectorXd c = Eigen::RowVectorXd::Zero(40);
      const Functional& row = model.coupling.rows[g];
      for (size_t k = 0; k < row.dofs.size(); ++k) c(row.dofs[k]) = row.values[k];
      // C T must be the unit row of the coordinate.
      const Eigen::RowVectorXd unit = Eigen::RowVectorXd::Unit(e.size(), e.reduced_of[40 + g]);
      EXPECT_LT((c * T - unit).cwiseAbs().maxCoeff(), 1e-12 * T.cwiseAbs().maxCoeff());
    }
  }
}

TEST(AssemblyHard, HardE3_SupportedBlocksEqualTheDenseProductsOfCopies) {
  // Dependences, couplings, plain and oblique supports together, against [T T_s]^T A [T T_s].
  RandomModel model = random_model(40);
  Eliminator eliminator(40, model.fixed, {2, 7});
  eliminator.depend(30, {{31, 33, 17}, {0.5, -2.0, 0.3}});
  eliminator.hold({{{34, 35, 36}, {0.6, 0.0, 0.8}}}, "test");
  eliminator.add(model.coupling, "test");
  eliminator.depend(33, {{38, 39}, {1.0, 0.25}});  // DoFs that 30 already depends on
  const Elimination e = eliminator.finish();
  Eigen::MatrixXd T(40, e.size() + e.supports());
  T << Eigen::MatrixXd(e.T), Eigen::MatrixXd(e.T_s);
  const Eigen::MatrixXd want = T.transpose() * full(model.A) * T;
  const CoordinateBlocks got = transform_with_supports(SparseMatrix(model.A), e);
  const Eigen::Index n = e.size(), n_s = e.supports();
  ASSERT_EQ(n_s, 4);
  const double tolerance = 1e-12 * want.cwiseAbs().maxCoeff();
  EXPECT_LT((full(got.qq) - want.topLeftCorner(n, n)).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LT((Eigen::MatrixXd(got.sq) - want.bottomLeftCorner(n_s, n)).cwiseAbs().maxCoeff(),
            tolerance);
  EXPECT_LT((full(got.ss) - want.bottomRightCorner(n_s, n_s)).cwiseAbs().maxCoeff(), tolerance);
}

TEST(AssemblyHard, HardE4_AMatrixBeyond32BitIndicesIsRefusedBeforeMemoryIsTaken) {
  // 1.3 M nodes with 80 neighbours each, half of them counted: fits; three times as many do not.
  EXPECT_NO_THROW(fe::predict_size(1'300'000, 1'300'000LL * 40));
  EXPECT_EQ(fe::predict_size(2, 1).stiffness, 21);  // 6 x 7 / 2
  EXPECT_EQ(fe::predict_size(2, 1).mass, 9);
  try {
    fe::predict_size(8'000'000, 8'000'000LL * 40);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("2928000000 entries"), std::string::npos)
        << error.what();
    test::observed(std::string("refused: ") + error.what());
  }
  // The assembler makes the same check: a pattern that is too large is rejected.
  fe::NodePattern pattern;
  pattern.start = {0, 1'000'000'000'000};
  mesh::Mesh mesh = block_mesh({1, 1, 1}, brick({1, 1, 1}));
  test::expect_parts(test::refusal_of([&] { fe::assemble(mesh, materials_of(mesh), pattern); }),
                     {"mesh of 1 nodes: the stiffness matrix would have 8999999999997 entries",
                      "expected fewer than 2147483647"});
}

/// A ring that lies beside the origin.
mesh::Mesh shifted_ring() {
  BlockOptions options;
  options.curved = options.wrap_x = true;
  mesh::Mesh mesh = block_mesh({8, 1, 3}, ring(0.04, 0.06, 0.1), options);
  mesh.nodes.rowwise() += Eigen::RowVector3d(0.3, -0.1, 0.2);
  return mesh;
}

/// Ten mass properties are right, nothing of the mesh and the masses `added` [kg] is lost, and M is
/// definite although some masses have no or little rotary inertia.
void expect_mass_kept(const BuiltModel& built, const mesh::Mesh& mesh, double added) {
  test::expect_at_most("error of the mass", built.certificate.mass_error.value(), 1e-9);
  EXPECT_LT(built.certificate.centre_error.value(), 1e-9);
  test::expect_at_most("error of the inertia", built.certificate.inertia_error.value(), 1e-9);
  EXPECT_LT(built.certificate.rigid_force_residue.value(), 1e-10);
  const double of_mesh = integrate_mass(mesh, materials_of(mesh)).mass;
  EXPECT_NEAR(built.model.mass.mass, of_mesh + added, 1e-12);
  EXPECT_TRUE(dense::Cholesky(full(built.model.M)).ok());
}

TEST(AssemblyHard, HardB5_TenMassPropertiesSurviveCouplingsAndPointMasses) {
  mesh::Mesh mesh = shifted_ring();
  const BuiltModel built = build(mesh, R"(
[[coupling]]
name = "pin"
surface = "y0"
[[coupling]]
name = "foot"
surface = "z0"
dofs = 3
[[point_mass]]
on = "pin"
mass = 0.7
inertia = [0.002, 0.003, 0.004]
[[point_mass]]
on = "foot"
mass = 0.4
)");
  expect_mass_kept(built, mesh, 1.1);
}

TEST(AssemblyHard, HardB5_TenMassPropertiesSurviveRigidCouplingsWithPointMasses) {
  // A ring with a rigid hub in its bore and a flywheel on an arm: CONM2s with offset and inertia
  // on a point, on a follower of it and on a reference node of its own.
  mesh::Mesh mesh = shifted_ring();
  for (const int32_t node : mesh::nodes_of(mesh.surface("z1")))
    if ((mesh.nodes.row(node).head<2>() - Eigen::RowVector2d(0.3, -0.1)).norm() > 0.0599)
      mesh.node_sets["top"].push_back(node);
  const BuiltModel built = build(mesh, R"(
[[point]]
name = "hub"
at = [0.3, -0.1, 0.25]
[[point]]
name = "flywheel"
at = [0.45, 0.0, 0.1]
[[coupling]]
type = "rigid"
point = "hub"
surface = "y0"
points = ["flywheel"]
[[coupling]]
name = "cap"
type = "rigid"
node_set = "top"
point = [0.31, -0.1, 0.32]
[[point_mass]]
on = "hub"
mass = 0.7
offset = [0.01, 0.02, -0.03]
inertia = [0.002, 0.003, 0.004, 0.0001, 0.0002, -0.0003]
[[point_mass]]
on = "flywheel"
mass = 2.5
offset = [0.1, 0.0, 0.05]
inertia = [0.02, 0.02, 0.035]
[[point_mass]]
on = "cap"
mass = 0.4
offset = [0.0, 0.0, 0.02]
)");
  expect_mass_kept(built, mesh, 3.6);
}

TEST(AssemblyHard, HardB6_ADistributingCouplingLetsTheBoreOvaliseAndARigidOneDoesNot) {
  BlockOptions options;
  options.curved = options.wrap_x = true;
  const mesh::Mesh mesh = block_mesh({12, 1, 1}, ring(0.05, 0.058, 0.03), options);
  const std::string rest = R"(
[[coupling]]
name = "bore"
surface = "y0"
)";
  const fe::FeModel plain = build(mesh, "").model;
  const fe::FeModel coupled = build(mesh, rest).model;
  // A patch load: +-y forces on the outside, balanced, so the free ring needs no support.
  const SurfaceIntegrals outside = integrate_surface(mesh.nodes, mesh.surface("y1"));
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * mesh.nodes.rows());
  Eigen::Index top = 0, bottom = 0;
  for (size_t k = 0; k < outside.nodes.size(); ++k) {
    const Eigen::RowVector3d x = mesh.nodes.row(outside.nodes[k]);
    const double patch = std::abs(x(0)) < 0.016 ? outside.weight(static_cast<Eigen::Index>(k)) : 0;
    f(3 * outside.nodes[k] + 1) = x(1) > 0.0 ? -patch : patch;
  }
  const std::vector<int32_t> bore = mesh::nodes_of(mesh.surface("y0"));
  for (const int32_t node : bore) {
    if (mesh.nodes(node, 1) > mesh.nodes(top, 1) || top == 0) top = node;
    if (mesh.nodes(node, 1) < mesh.nodes(bottom, 1) || bottom == 0) bottom = node;
  }
  const auto ovalisation = [&](const SparseMatrix& K, const Eigen::MatrixXd& T) {
    // A free body under balanced load: the mass-like shift on rigid motions fixes the rest.
    Eigen::MatrixXd stiffness = full(K);
    const Eigen::MatrixXd rigid = dense::least_squares(T, plain.T * plain.rigid).X;
    const double scale = stiffness.diagonal().mean() / rigid.squaredNorm();
    stiffness += scale * rigid * rigid.transpose();
    const Eigen::VectorXd u = T * dense::Cholesky(stiffness).solve(T.transpose() * f);
    return u(3 * top + 1) - u(3 * bottom + 1);
  };
  const double want = ovalisation(plain.K, Eigen::MatrixXd(plain.T));
  test::expect_at_most("error of the ovalisation",
                       std::abs(ovalisation(coupled.K, Eigen::MatrixXd(coupled.T)) / want - 1.0),
                       1e-11);  // rounding

  // RBE2 keeps the bore round, which must not happen here.
  const fe::FeModel stiff =
      build(mesh, "[[coupling]]\nname = \"bore\"\ntype = \"rigid\"\nsurface = \"y0\"\n").model;
  test::expect_at_most("ovalisation that a rigid coupling lets through",
                       std::abs(ovalisation(stiff.K, Eigen::MatrixXd(stiff.T)) / want), 1e-11);
}

/// A beam along x, complete or cut at mid-length into halves with non-matching meshes.
mesh::Mesh beam(const std::array<int, 3>& n, double begin, double end,
                mesh::CellType type = mesh::CellType::kTet10) {
  BlockOptions options;
  options.type = type;
  const auto map = [=](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return {begin + (end - begin) * x(0), 0.05 * x(1), 0.04 * x(2)};
  };
  return block_mesh(n, map, options);
}

TEST(AssemblyHard, HardB7_ABeamCutInTwoHasTheModesOfTheWholeAndNoMore) {
  const fe::FeModel whole =
      build(beam({16, 3, 3}, 0.0, 0.4), "[[support]]\nsurface = \"x0\"\n").model;
  const mesh::Mesh halves = two_parts(beam({8, 3, 3}, 0.0, 0.2), beam({9, 4, 3}, 0.2, 0.4));
  for (const auto& [slave, master] : {std::pair{"a_x1", "b_x0"}, std::pair{"b_x0", "a_x1"}}) {
    const BuiltModel built =
        build(halves, std::string("[[support]]\nsurface = \"a_x0\"\n[[tie]]\nslave = \"") + slave +
                          "\"\nmaster = \"" + master + "\"\n");
    const Eigen::VectorXd want = lowest_hz(whole.K, whole.M, 10);
    const Eigen::VectorXd got = lowest_hz(built.model.K, built.model.M, 10);
    for (Eigen::Index k = 0; k < 10; ++k)
      EXPECT_NEAR(got(k) / want(k), 1.0, 0.005) << "mode " << k + 1 << ", slave " << slave;
  }
}

TEST(AssemblyHard, HardB21_AForceActsWhereItIsSaidNotWhereANodeIs) {
  // A bar is pulled 8 mm beside its axis in both directions: it bends as by that moment alone,
  // u = M L^2 / (2 E I), on cells of 50 mm, in which no node is there, as on finer ones. The
  // support hinders lateral contraction: 1.4 % stiffer.
  const double moment = 0.008, L = 0.4, E = kSteel.youngs;
  const double want_y = -moment * L * L / (2.0 * E * 0.04 * std::pow(0.05, 3) / 12.0);
  const double want_z = -moment * L * L / (2.0 * E * 0.05 * std::pow(0.04, 3) / 12.0);
  for (const int n : {1, 2, 3, 4}) {
    const fe::FeModel model = build(beam({8, n, n}, 0.0, L), R"(
[[support]]
surface = "x0"
[[load]]
name = "bolt"
kind = "resultant"
surface = "x1"
direction = [1.0, 0.0, 0.0]
at = [0.4, 0.033, 0.028]
radius = 0.01
[[load]]
name = "y"
kind = "resultant"
surface = "x1"
direction = [0.0, 1.0, 0.0]
[[load]]
name = "z"
kind = "resultant"
surface = "x1"
direction = [0.0, 0.0, 1.0]
)")
                                  .model;
    const Eigen::VectorXd u = dense::Cholesky(full(model.K)).solve(model.loads.at("bolt"));
    EXPECT_NEAR(model.loads.at("y").dot(u) / want_y, 1.0, 0.025) << n << " cells";
    EXPECT_NEAR(model.loads.at("z").dot(u) / want_z, 1.0, 0.025) << n << " cells";
  }
}

class JointOf : public ::testing::TestWithParam<std::tuple<mesh::CellType, mesh::CellType>> {};
INSTANTIATE_TEST_SUITE_P(
    AllCells, JointOf,
    ::testing::Combine(::testing::Values(mesh::CellType::kTet4, mesh::CellType::kTet10,
                                         mesh::CellType::kHex8, mesh::CellType::kHex20),
                       ::testing::Values(mesh::CellType::kTet4, mesh::CellType::kTet10,
                                         mesh::CellType::kHex8, mesh::CellType::kHex20)));

TEST_P(JointOf, HardB7_ConstantStressCrossesIt) {
  const auto [left, right] = GetParam();
  mesh::Mesh mesh = two_parts(beam({3, 2, 2}, 0.0, 0.2, left), beam({2, 3, 1}, 0.2, 0.4, right));
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a) {
    const Eigen::Vector3d x = mesh.nodes.row(a).transpose();
    const auto name = [&](double y, double z) {
      return (x - Eigen::Vector3d(0, y, z)).norm() < 1e-9;
    };
    if (name(0.0, 0.0)) mesh.node_sets["o"] = {static_cast<int32_t>(a)};
    if (name(0.05, 0.0)) mesh.node_sets["y"] = {static_cast<int32_t>(a)};
    if (name(0.0, 0.04)) mesh.node_sets["z"] = {static_cast<int32_t>(a)};
  }
  for (const auto& [slave, master] : {std::pair{"a_x1", "b_x0"}, std::pair{"b_x0", "a_x1"}}) {
    const fe::FeModel model = build(mesh, std::string(R"(
[[support]]
node_set = "o"
[[support]]
node_set = "y"
directions = "xz"
[[support]]
node_set = "z"
directions = "x"
[[load]]
name = "pull"
kind = "pressure"
surface = "b_x1"
[[load]]
name = "hold"
kind = "pressure"
surface = "a_x0"
[[tie]]
)") + "slave = \"" + slave + "\"\nmaster = \"" +
                                              master + "\"\n")
                                  .model;
    const double strain = -1.0 / 2.1e11;  // of 1 Pa on both ends
    const Eigen::VectorXd f = model.loads.at("pull") + model.loads.at("hold");
    const dense::Cholesky factor(full(model.K));
    Eigen::VectorXd q = factor.solve(f);
    q += factor.solve(f - multiply_symmetric(model.K, q));
    const Eigen::VectorXd u = model.T * q;
    for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a) {
      const Eigen::Vector3d x = mesh.nodes.row(a).transpose();
      const Eigen::Vector3d want = strain * Eigen::Vector3d(x(0), -0.3 * x(1), -0.3 * x(2));
      EXPECT_LT((u.segment<3>(3 * a) - want).norm(), 1e-10 * std::abs(strain) * 0.4);
    }
  }
}

}  // namespace
}  // namespace clatter::assembly::testing
