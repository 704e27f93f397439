// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "assembly/load/load_case.hpp"
#include "assembly/load/mass_properties.hpp"
#include "assembly/load/point_mass.hpp"
#include "bar_model.hpp"
#include "block_mesh.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/dense/cholesky.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/shape.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

using test::expect_parts;

mesh::Mesh short_bar() { return block_mesh({2, 2, 4}, brick({0.1, 0.2, 0.4})); }

TEST(LoadCase, PressureOnAClosedSkinHasNoResultant) {
  BlockOptions options;
  options.curved = options.wrap_x = true;
  const mesh::Mesh mesh = block_mesh({8, 1, 2}, ring(0.04, 0.06, 0.1), options);
  const fe::FeModel model =
      build(mesh, "[[load]]\nname = \"p\"\nkind = \"pressure\"\nsurface = \"skin\"\n").model;
  const Eigen::VectorXd resultant = model.rigid.transpose() * model.loads.at("p");
  EXPECT_LT(resultant.norm(), 1e-15);  // against 0.01 m2 of skin, times rounding
  EXPECT_EQ(model.load_units.at("p"), "Pa");
}

TEST(LoadCase, PressurePushesAgainstTheFaceWithItsArea) {
  const fe::FeModel model =
      build(short_bar(), "[[load]]\nname = \"gas\"\nkind = \"pressure\"\nsurface = \"z1\"\n").model;
  const Eigen::VectorXd resultant = model.rigid.transpose() * model.loads.at("gas");
  // 1 Pa on 0.1 x 0.2 m2 at (0.05, 0.1, 0.4), downwards: F_z = -0.02, M_x = y F_z, M_y = -x F_z.
  const Eigen::VectorXd want = (Eigen::VectorXd(6) << 0, 0, -0.02, -0.002, 0.001, 0).finished();
  EXPECT_LT((resultant - want).norm(), 1e-15);
}

TEST(LoadCase, AResultantIsSpreadEvenlyAndActsAtTheCentroid) {
  const fe::FeModel model = build(short_bar(), R"(
[[load]]
name = "head"
kind = "resultant"
surface = "z1"
direction = [0.0, 0.0, 2.0]
total = 8.992e-3
unit = "Pa"
)")
                                .model;
  const Eigen::VectorXd resultant = model.rigid.transpose() * model.loads.at("head");
  EXPECT_NEAR(resultant(2), 8.992e-3, 1e-16);
  EXPECT_NEAR(resultant(3), 0.1 * 8.992e-3, 1e-16);
  EXPECT_EQ(model.load_units.at("head"), "Pa");
}

/// A bar with a force of 3 N along z on its upper end, spread around (33, 71) mm.
struct SpreadForce {
  mesh::Mesh mesh;
  fe::FeModel model;
  std::vector<std::string> warnings;

  SpreadForce(const std::array<int, 3>& cells, mesh::CellType type, double radius) {
    BlockOptions options;
    options.type = type;
    mesh = block_mesh(cells, brick({0.1, 0.2, 0.4}), options);
    set_log_sink([&](bool warning, const std::string& text) {
      if (warning) warnings.push_back(text);
    });
    model = build(mesh, fmt::format("[[load]]\nname = \"bolt\"\nkind = \"resultant\"\n"
                                    "surface = \"z1\"\ndirection = [0.0, 0.0, 1.0]\n"
                                    "total = 3.0\nat = [0.033, 0.071, 0.4]\nradius = {}\n",
                                    radius))
                .model;
    set_log_sink({});
  }
};

TEST(LoadCase, AResultantIsSpreadAroundAPointWhereverNodesAre) {
  // Nodes are 25 to 100 mm apart: none is at the point.
  for (const mesh::CellType type : {mesh::CellType::kTet10, mesh::CellType::kHex8})
    for (const double radius : {1e-4, 0.005, 0.020, 0.030}) {
      const SpreadForce force({2, 2, 4}, type, radius);
      const Eigen::VectorXd resultant =
          force.model.rigid.transpose() * force.model.loads.at("bolt");
      const Eigen::VectorXd want = (Eigen::VectorXd(6) << 0, 0, 3, 0.213, -0.099, 0).finished();
      EXPECT_LT((resultant - want).norm(), 3e-3 * radius) << radius;  // arm times force
      EXPECT_TRUE(force.warnings.empty());
    }
}

TEST(LoadCase, ASpreadResultantHasTheTractionThatItSays) {
  // (1 - r^2 / R^2)^2 has a mean r^2 of R^2 / 4. Quadratic cells have the field r^2 itself.
  const double R = 0.030;
  const SpreadForce force({4, 8, 1}, mesh::CellType::kTet10, R);
  double work = 0.0;
  for (Eigen::Index a = 0; a < force.mesh.nodes.rows(); ++a)
    work += force.model.loads.at("bolt")(3 * a + 2) *
            (force.mesh.nodes.row(a) - Eigen::RowVector3d(0.033, 0.071, 0.4)).squaredNorm();
  EXPECT_NEAR(work / 3.0, R * R / 4.0, 1e-4 * R * R);  // quadrature at the edge
}

TEST(LoadCase, ASpreadResultantThatIsCutOffIsToldAndOneBesideTheSurfaceRefused) {
  const SpreadForce cut({2, 2, 4}, mesh::CellType::kTet10, 0.08);  // the edge is 33 mm away
  ASSERT_EQ(cut.warnings.size(), 1U);
  expect_parts(cut.warnings[0],
               {"load bolt: acts ", " mm from `at`: the surface is curved or ends"});
  const std::string head =
      "[[load]]\nname = \"bolt\"\nkind = \"resultant\"\nsurface = \"z1\"\n"
      "direction = [0.0, 0.0, 1.0]\n";
  const auto refusal = [&](const std::string& text) {
    return test::refusal_of([&] { build(short_bar(), head + text); });
  };
  expect_parts(refusal("at = [0.05, 0.1, 0.3]\nradius = 0.02\n"),
               {"load bolt", "at: found no part of the surface within 20 mm, expected a point"});
  expect_parts(refusal("at = [0.05, 0.1, 0.4]\n"), {"load[0].radius: is missing"});
  expect_parts(refusal("radius = 0.02\n"), {"load[0].radius: needs at"});
}

TEST(LoadCase, RotationIsTheMassTimesTheArmOfEachNodeOnCurvedCellsToo) {
  // r is linear in x, and x is interpolated as displacements are: int rho N r dV = M r(nodes).
  BlockOptions options;
  options.curved = options.wrap_x = true;
  const mesh::Mesh mesh = block_mesh({8, 1, 2}, ring(0.04, 0.06, 0.1), options);
  const fe::FeModel model = build(mesh, R"(
[[load]]
name = "spin"
kind = "centrifugal"
axis_point = [0.3, -0.2, 0.1]
axis = [0.0, 3.0, 4.0]
)")
                                .model;
  const Eigen::Vector3d point(0.3, -0.2, 0.1), axis(0.0, 0.6, 0.8);
  Eigen::VectorXd arm(model.T.rows());
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a) {
    const Eigen::Vector3d r = mesh.nodes.row(a).transpose() - point;
    arm.segment<3>(3 * a) = r - r.dot(axis) * axis;
  }
  const Eigen::VectorXd want = model.M.selfadjointView<Eigen::Lower>() * arm;
  EXPECT_LT((model.loads.at("spin") - want).cwiseAbs().maxCoeff(),
            1e-13 * want.cwiseAbs().maxCoeff());  // rounding
  EXPECT_EQ(model.load_units.at("spin"), "rad2/s2");
}

TEST(LoadCase, RotationPullsPointMassesByTheirArmAndTurnsSkewInertiaIntoLine) {
  const std::string text = R"(
[[coupling]]
name = "top"
surface = "z1"
[[point_mass]]
on = "top"
mass = 3.0
offset = [0.0, 0.0, 0.1]
inertia = [0.01, 0.02, 0.03, 0.004, 0.005, 0.006]
[[load]]
name = "spin"
kind = "centrifugal"
axis_point = [-1.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
)";
  const fe::FeModel with = build(short_bar(), text).model;
  const fe::FeModel without =
      build(short_bar(), text + "regions = [\"body\"]\n").model;  // of the elements alone
  const Eigen::VectorXd change = with.loads.at("spin") - without.loads.at("spin");
  const Eigen::VectorXd resultant = with.rigid.transpose() * change;
  // Centre at (0.05, 0.1, 0.5): F = 3 (1.05, 0.1, 0); M = x cross F - n cross (J n), with
  // J n = (0.006, 0.005, 0.03).
  const Eigen::Vector3d force(3.15, 0.3, 0.0), centre(0.05, 0.1, 0.5), turn(-0.005, 0.006, 0.0);
  EXPECT_LT((resultant.head(3) - force).norm(), 1e-13);
  EXPECT_LT((resultant.tail(3) - (centre.cross(force) - turn)).norm(), 1e-13);
  test::expect_parts(
      test::refusal_of([&] { build(short_bar(), text + "regions = [\"bodies\"]\n"); }),
      {"test.fe.toml:", "regions: found \"bodies\", expected one of: body"});
}

TEST(LoadCase, GravityIsTheWeightOfElementsAndPointMasses) {
  const fe::FeModel model = build(short_bar(), R"(
[[coupling]]
name = "top"
surface = "z1"
[[point_mass]]
on = "top"
mass = 3.0
inertia = [0.01, 0.02, 0.025]
[[load]]
name = "weight"
kind = "gravity"
direction = [0.0, 0.0, -1.0]
)")
                                .model;
  const double m = 7800.0 * 0.1 * 0.2 * 0.4 + 3.0;
  const Eigen::VectorXd resultant = model.rigid.transpose() * model.loads.at("weight");
  EXPECT_NEAR(resultant(2) / -m, 1.0, 1e-12);
  EXPECT_NEAR(resultant(3) / -(0.1 * m), 1.0, 1e-12);  // both centres lie at y = 0.1
  EXPECT_NEAR(model.mass.mass / m, 1.0, 1e-13);
}

// On a node that is kept along other axes a mass beside it is where its offset says.
TEST(PointMass, OnASetOfTurnedDirectionsHasTheEnergyOfTheMass) {
  rom::DofSet set;
  set.kind = "nodes";
  set.dofs = {5, 1, 2, 3, 4, 0};
  set.is_rotation = {0, 0, 0, 1, 1, 1};
  const Eigen::Matrix3d axes =
      Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  set.direction.resize(6, 3);
  set.direction << axes.transpose(), axes.transpose();
  set.position = RowMatrix::Zero(6, 3);
  PointMassSpec spec;
  spec.mass = 3.0;
  spec.offset = {0.1, -0.2, 0.4};
  spec.inertia = Eigen::Vector3d(0.1, 0.2, 0.3).asDiagonal();
  SparseMatrix M(6, 6);
  add_to_set(M, spec, set);
  const Eigen::Vector3d v(0.3, 0.7, -1.1), w(0.9, -0.4, 0.2);
  Eigen::VectorXd q(6);
  for (int k = 0; k < 3; ++k) {
    q(set.dofs[k]) = axes.col(k).dot(v);
    q(set.dofs[k + 3]) = axes.col(k).dot(w);
  }
  const Eigen::Vector3d at = v + w.cross(spec.offset);
  EXPECT_NEAR(q.dot(multiply_symmetric(M, q).col(0)),
              3.0 * at.squaredNorm() + w.dot(spec.inertia * w), 1e-12);
}

TEST(LoadCase, AcrossABoltIsRefused) {
  rom::DofSet set;
  set.kind = "bolt";
  set.dofs = {2};
  set.direction = Eigen::RowVector3d(0.0, 0.0, -1.0);
  EXPECT_EQ(set_load(3, set, {0, 0, 4.0}, {0, 0, 0}, "load t")(2), -4.0);
  EXPECT_NE(test::refusal_of([&] {
              set_load(3, set, {1.0, 0, 0}, {0, 0, 0}, "load t");
            }).find("load t: found a load beside the axis (0, 0, -1) of the bolt"),
            std::string::npos);
}

// M a: the uniform field is the load by direction, and half of the nodes have half of M's columns.
TEST(LoadCase, AFieldOfAccelerationsActsThroughTheMassMatrix) {
  mesh::Mesh mesh = bar();
  const Eigen::Index n = mesh.nodes.rows();
  mesh.fields["all"] = Eigen::RowVector3d(0.0, 3.0, 4.0).replicate(n, 1);
  mesh.fields["some"] = mesh.fields["all"];
  mesh.fields["some"].topRows(n / 2).setZero();
  const auto load = [](const std::string& name, const std::string& body) {
    return "[[load]]\nname = \"" + name + "\"\nkind = \"acceleration\"\n" + body + "\n";
  };
  const fe::FeModel model = build(mesh, load("by_direction", "direction = [0.0, 0.6, 0.8]") +
                                            load("all", "field = \"all\"") +
                                            load("some", "field = \"some\"\nscale = 2.0"))
                                .model;
  const Eigen::VectorXd& uniform = model.loads.at("by_direction");
  EXPECT_LT((model.loads.at("all") - 5.0 * uniform).norm(), 1e-13 * 5.0 * uniform.norm());
  const RowMatrix some = mesh.fields["some"];
  const Eigen::VectorXd expected =
      2.0 * full(model.M) * Eigen::Map<const Eigen::VectorXd>(some.data(), some.size());
  EXPECT_LT((model.loads.at("some") - expected).norm(), 1e-13 * expected.norm());
  test::expect_parts(test::refusal_of([&] {
                       build(mesh, load("a", "field = \"all\"\ndirection = [1.0, 0.0, 0.0]"));
                     }),
                     {"field: field and direction exclude each other"});
}

/// A cell of a cylinder of 0.1 m about z.
mesh::Mesh quadratic_shell() {
  mesh::Mesh mesh;
  mesh.name = "shell";
  mesh.regions = {"body"};
  mesh::ShellBlock block;
  block.type = mesh::FaceType::kQuad8;
  block.nodes.resize(1, 8);
  const RowMatrix rs = mesh::reference_nodes(block.type);
  mesh.nodes.resize(8, 3);
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.5 * rs(i, 0);
    mesh.nodes.row(i) << 0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.05 * rs(i, 1);
    block.nodes(0, i) = i;
  }
  mesh.shells = {block};
  mesh.surfaces["skin"] = mesh::skin_of({}, mesh.shells);
  return mesh;
}

// The centre of the cell is accelerated as its nodes are, not as its equilibrium moves it.
TEST(LoadCase, AFieldOfAccelerationsHoldsWithinQuadraticShells) {
  mesh::Mesh mesh = quadratic_shell();
  mesh.fields["arm"] = mesh.nodes;
  mesh.fields["arm"].col(2).setZero();
  for (const std::string mass : {"", "[mass]\nlumping = 'hrz'\n"}) {
    const fe::FeModel model =
        build(mesh, mass +
                        "[[shell]]\nregions = [\"body\"]\nthickness = 0.001\n"
                        "[[load]]\nname = \"spin\"\nkind = \"centrifugal\"\naxis_point = [0.0, "
                        "0.0, 0.0]\naxis = [0.0, 0.0, 1.0]\n"
                        "[[load]]\nname = \"field\"\nkind = \"acceleration\"\nfield = \"arm\"\n")
            .model;
    const Eigen::VectorXd spin = model.loads.at("spin"), field = model.loads.at("field");
    EXPECT_LT((field - spin).norm(), 1e-13 * spin.norm());
  }
}

TEST(LoadCase, ForceAndMomentOnAReferenceNodeAreItsCoordinatesForces) {
  const fe::FeModel model = build(short_bar(), R"(
[[coupling]]
name = "top"
surface = "z1"
[[load]]
name = "push"
kind = "force"
set = "top"
force = [1.0, 2.0, 0.0]
moment = [0.0, 0.0, 4.0]
)")
                                .model;
  const rom::DofSet& top = model.set("top");
  const Eigen::VectorXd& f = model.loads.at("push");
  EXPECT_DOUBLE_EQ(f(top.dofs[0]), 1.0);
  EXPECT_DOUBLE_EQ(f(top.dofs[1]), 2.0);
  EXPECT_DOUBLE_EQ(f(top.dofs[5]), 4.0);
  EXPECT_DOUBLE_EQ(f.norm(), std::sqrt(21.0));
}

TEST(LoadCase, AMomentOnPlainNodesIsRefused) {
  test::expect_parts(
      test::refusal_of([&] {
        build(short_bar(),
              "[[sensor]]\nname = \"s\"\nsurface = \"z1\"\nnear = [0.0, 0.0, "
              "0.4]\n[[load]]\nname = \"m\"\nkind = \"force\"\nset = \"s\"\nmoment = "
              "[1.0, 0.0, 0.0]\n");
      }),
      {"test.fe.toml:", "load m: found a load along x, expected a set with a coordinate along it"});
}

TEST(PointMass, EntersTheDiagonalOfItsReferenceNodeOnly) {
  const std::string coupling = "[[coupling]]\nname = \"pin\"\nsurface = \"z1\"\n";
  const fe::FeModel bare = build(short_bar(), coupling).model;
  const fe::FeModel loaded =
      build(short_bar(), coupling +
                             "[[point_mass]]\non = \"pin\"\nmass = 2.0\ninertia "
                             "= [0.3, 0.2, 0.4, 0.01, 0.02, 0.03]\n")
          .model;
  Eigen::MatrixXd change = full(loaded.M) - full(bare.M);
  const std::vector<int32_t>& dofs = loaded.set("pin").dofs;
  Eigen::MatrixXd want = Eigen::MatrixXd::Zero(6, 6);
  want.diagonal() << 2.0, 2.0, 2.0, 0.3, 0.2, 0.4;
  want(3, 4) = want(4, 3) = 0.01;
  want(4, 5) = want(5, 4) = 0.02;
  want(3, 5) = want(5, 3) = 0.03;
  EXPECT_LT((change(dofs, dofs) - want).norm(), 1e-13);
  change(dofs, dofs).setZero();
  EXPECT_EQ(change.cwiseAbs().maxCoeff(), 0.0);
}

TEST(PointMass, OnASoftBarGivesTheOscillatorsFrequency) {
  // A mass of 1000 bars on a clamped bar in pure stretch (nu = 0): w^2 = E A / (L (m + bar / 3)).
  mesh::Mesh mesh = short_bar();
  set_quiet(true);
  const Config config = Config::parse(R"(
[material.cork]
regions = ["body"]
E = 1e6
nu = 0.0
rho = 1.0
[[support]]
surface = "z0"
[[coupling]]
name = "top"
surface = "z1"
[[point_mass]]
on = "top"
mass = 8.0
inertia = [1e6, 1e6, 1e6]
)",
                                      "cork.fe.toml");
  StepClock clock;
  const fe::FeModel model = build_fe_model(mesh, read_recipe(config, mesh), clock).model;
  const Eigen::VectorXd f = Eigen::VectorXd::Unit(model.size(), model.set("top").dofs[2]);
  const double compliance = f.dot(dense::Cholesky(full(model.K)).solve(f).col(0));
  EXPECT_NEAR(compliance / (0.4 / (1e6 * 0.02)), 1.0, 1e-10);
}

TEST(Damping, ARatioAtAFrequencyGivesAlpha) {
  const fe::FeModel model = build(short_bar(), "[damping]\nratio = 0.02\nat_hz = 2000.0\n").model;
  const double omega = 2.0 * std::numbers::pi * 2000.0;
  EXPECT_NEAR(0.5 * model.alpha * omega, 0.02, 1e-16);
  EXPECT_EQ(model.beta, 0.0);
}

TEST(LumpedMass, AFreeModelKeepsItsMassAndSaysHowFarItsInertiaIsOff) {
  mesh::Mesh mesh = block_mesh({2, 2, 2}, brick({0.3, 0.2, 0.1}));
  const Config config = Config::parse(
      "[material.iron]\nregions = ['body']\nE = 1e11\nnu = 0.3\nrho = 7200.0\n"
      "[mass]\nlumping = 'hrz'\n",
      "iron.fe.toml");
  StepClock clock;
  const BuiltModel built = build_fe_model(mesh, read_recipe(config, mesh), clock);
  EXPECT_EQ(built.model.M.nonZeros(), built.model.size());
  EXPECT_LT(built.certificate.mass_error.value(), 1e-12);
  // Two cells along each side: the mass points are nearer to the outside than the mass.
  const Eigen::VectorXd m = built.model.M.diagonal();
  Eigen::Matrix3d points = Eigen::Matrix3d::Zero();
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a) {
    const Eigen::Vector3d r = mesh.nodes.row(a).transpose() - Eigen::Vector3d(0.15, 0.1, 0.05);
    points += m(3 * a) * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  const Eigen::Vector3d box = 7200.0 * 0.006 / 12.0 * Eigen::Vector3d(0.05, 0.10, 0.13);
  const Eigen::Matrix3d more = points - Eigen::Matrix3d(box.asDiagonal());
  EXPECT_GT(more.trace(), 0.1 * box.sum());
  EXPECT_NEAR(built.certificate.inertia_error.value(), more.cwiseAbs().maxCoeff() / box.sum(),
              1e-12);
}

}  // namespace
}  // namespace clatter::assembly::testing
