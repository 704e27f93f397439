// SPDX-License-Identifier: GPL-3.0-or-later
// Ties of non-matching surfaces.
#include <gtest/gtest.h>

#include <cmath>

#include "assembly/surface/surface_integral.hpp"
#include "assembly/tie/clip.hpp"
#include "assembly/tie/mortar.hpp"
#include "block_mesh.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/dense/cholesky.hpp"
#include "core/mesh/quadrature.hpp"
#include "small_solver.hpp"
#include "two_parts.hpp"

namespace clatter::assembly::testing {
namespace {

using mesh::CellType;

TEST(Clip, OfTwoSquaresByHand) {
  const Polygon a = {{0, 0}, {2, 0}, {2, 2}, {0, 2}}, b = {{1, 1}, {3, 1}, {3, 3}, {1, 3}};
  EXPECT_NEAR(signed_area(clip(a, b)), 1.0, 1e-15);
  EXPECT_TRUE(clip(a, {{5, 5}, {6, 5}, {6, 6}}).empty());
  const Polygon inside = {{0.5, 0.5}, {1.0, 0.5}, {0.5, 1.0}};
  EXPECT_NEAR(signed_area(clip(inside, a)), signed_area(inside), 1e-16);
  EXPECT_NEAR(signed_area(clip(a, inside)), signed_area(inside), 1e-16);
}

/// Both sides of the plane z = 1 between two blocks of any cells.
struct Pair {
  mesh::Mesh mesh;
  std::vector<TieFace> slave, master;
};

Pair pair_of(CellType lower, CellType upper, double shake) {
  Pair pair;
  pair.mesh = two_parts(slab(lower, {2, 3, 1}, shake), slab(upper, {3, 2, 1}, shake, 1.0));
  pair.slave = tie_faces(pair.mesh.nodes, pair.mesh.surface("a_z1"));
  pair.master = tie_faces(pair.mesh.nodes, pair.mesh.surface("b_z0"));
  return pair;
}

class TieOf : public ::testing::TestWithParam<std::tuple<CellType, CellType>> {};
INSTANTIATE_TEST_SUITE_P(
    AllFaces, TieOf,
    ::testing::Combine(::testing::Values(CellType::kTet4, CellType::kTet10, CellType::kHex8,
                                         CellType::kHex20, CellType::kWedge15),
                       ::testing::Values(CellType::kTet4, CellType::kTet10, CellType::kHex8,
                                         CellType::kHex20, CellType::kWedge15)));

TEST_P(TieOf, CarriesLinearFieldsAndConstantStressAcrossAPlane) {
  // With u_slave = P u_master: P x_master = x_slave, and the nodal forces of a constant traction
  // balance, P^T w_slave = w_master. Both together are the patch test.
  const auto [lower, upper] = GetParam();
  const Pair pair = pair_of(lower, upper, 0.0);
  const Projection found = project(pair.slave, pair.master, 1e-3);
  EXPECT_TRUE(found.untied.empty());
  EXPECT_NEAR(found.covered, found.slave_area, 1e-12 * found.slave_area);
  const SurfaceIntegrals on_slave = integrate_surface(pair.mesh.nodes, pair.mesh.surface("a_z1"));
  const SurfaceIntegrals on_master = integrate_surface(pair.mesh.nodes, pair.mesh.surface("b_z0"));
  ASSERT_EQ(found.tied.size(), on_slave.nodes.size());
  std::map<int32_t, double> pulled;
  for (size_t j = 0; j < found.tied.size(); ++j) {
    const ProjectedNode& row = found.tied[j];
    ASSERT_EQ(row.node, on_slave.nodes[j]);
    Eigen::RowVector3d position = Eigen::RowVector3d::Zero();
    double sum = 0.0;
    for (const auto& [node, value] : row.on) {
      position += value * pair.mesh.nodes.row(node);
      sum += value;
      pulled[node] += value * on_slave.weight(static_cast<Eigen::Index>(j));
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_LT((position - pair.mesh.nodes.row(row.node)).norm(), 1e-12);
  }
  for (size_t k = 0; k < on_master.nodes.size(); ++k)
    EXPECT_NEAR(pulled[on_master.nodes[k]], on_master.weight(static_cast<Eigen::Index>(k)), 1e-13);
}

TEST(Tie, OfUnevenQuadrilateralsIsExactToTheQuadrature) {
  // Quadrilaterals that are no parallelograms have rational inverse maps: linear fields stay
  // exact, the balance of forces has the error of sixteen points a piece.
  for (const CellType type : {CellType::kHex8, CellType::kHex20}) {
    const Pair pair = pair_of(type, type, 0.2);
    const Projection found = project(pair.slave, pair.master, 1e-3);
    const SurfaceIntegrals on_slave = integrate_surface(pair.mesh.nodes, pair.mesh.surface("a_z1"));
    const SurfaceIntegrals on_master =
        integrate_surface(pair.mesh.nodes, pair.mesh.surface("b_z0"));
    std::map<int32_t, double> pulled;
    for (size_t j = 0; j < found.tied.size(); ++j) {
      Eigen::RowVector3d position = Eigen::RowVector3d::Zero();
      for (const auto& [node, value] : found.tied[j].on) {
        position += value * pair.mesh.nodes.row(node);
        pulled[node] += value * on_slave.weight(static_cast<Eigen::Index>(j));
      }
      EXPECT_LT((position - pair.mesh.nodes.row(found.tied[j].node)).norm(), 1e-11);
    }
    double worst = 0.0;
    for (size_t k = 0; k < on_master.nodes.size(); ++k)
      worst = std::max(worst, std::abs(pulled[on_master.nodes[k]] -
                                       on_master.weight(static_cast<Eigen::Index>(k))));
    EXPECT_LT(worst, 1e-5);  // of faces of area 1 / 6
  }
}

TEST(Tie, RigidMotionsCrossCurvedAndGapingInterfaces) {
  // Two rings of different divisions, one in the other: nodes of one lie off the faces of the
  // other.
  const auto ring_of = [](int around, double inner, double outer) {
    BlockOptions options;
    options.curved = options.wrap_x = true;
    return block_mesh({around, 1, 2}, ring(inner, outer, 0.05), options);
  };
  const mesh::Mesh mesh = two_parts(ring_of(8, 0.04, 0.05), ring_of(11, 0.0505, 0.06));
  const BuiltModel built = build(mesh, R"(
[[tie]]
name = "fit"
slave = "a_y1"
master = "b_y0"
distance = 0.002
)");
  EXPECT_LT(built.certificate.rigid_recovery_error.value(), 1e-11);
  EXPECT_LT(built.certificate.rigid_force_residue.value(), 1e-10);
  EXPECT_LT(built.certificate.mass_error.value(), 1e-9);
  EXPECT_LT(built.certificate.inertia_error.value(), 1e-9);
  EXPECT_TRUE(dense::Cholesky(full(built.model.M)).ok());
  // One body: six rigid motions and no more.
  const Eigen::VectorXd hz = free_hz(built.model, 8);
  EXPECT_LT(hz(5), 1e-3 * hz(6));
}

TEST(Tie, HardB7_CongruentFacesFollowAcrossAGap) {
  // Each slave node sees one master node alone, which has no rotation of its own.
  for (const CellType type : {CellType::kTet4, CellType::kHex8, CellType::kTet10}) {
    const BuiltModel built =
        build(two_parts(slab(type, {2, 2, 1}, 0.0), slab(type, {2, 2, 1}, 0.0, 1.04)),
              "[[tie]]\nname = \"t\"\nslave = \"a_z1\"\nmaster = \"b_z0\"\ndistance = 0.05\n");
    EXPECT_LT(built.certificate.rigid_recovery_error.value(), 1e-11);
    EXPECT_LT(built.certificate.rigid_force_residue.value(), 1e-10);
    const Eigen::VectorXd hz = free_hz(built.model, 8);
    EXPECT_LT(hz(5), 1e-3 * hz(6));
  }
}

TEST(Tie, SlavesBeyondTheMasterStayFree) {
  // The master covers the left half.
  const mesh::Mesh mesh = two_parts(slab(CellType::kTet10, {4, 2, 1}, 0.0),
                                    slab(CellType::kTet10, {1, 1, 1}, 0.0, 1.0, 0.5));
  const Projection found = project(tie_faces(mesh.nodes, mesh.surface("a_z1")),
                                   tie_faces(mesh.nodes, mesh.surface("b_z0")), 1e-3);
  EXPECT_NEAR(found.covered / found.slave_area, 0.5, 1e-9);
  for (const ProjectedNode& row : found.tied) EXPECT_LT(mesh.nodes(row.node, 0), 0.5 + 1e-9);
  for (const int32_t node : found.untied) EXPECT_GT(mesh.nodes(node, 0), 0.5 + 1e-9);
}

TEST(Tie, OfSurfacesApartIsRefused) {
  mesh::Mesh mesh =
      two_parts(slab(CellType::kTet4, {1, 1, 1}, 0.0), slab(CellType::kTet4, {1, 1, 1}, 0.0, 1.0));
  try {
    build(mesh, "[[tie]]\nname = \"t\"\nslave = \"a_z0\"\nmaster = \"b_z1\"\ndistance = 0.1\n");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("tie t: found no part of a_z0 that faces b_z1"),
              std::string::npos)
        << error.what();
  }
}

TEST(Tie, ASlaveThatARigidCouplingMovesIsRefusedByName) {
  mesh::Mesh mesh =
      two_parts(slab(CellType::kTet4, {1, 1, 1}, 0.0), slab(CellType::kTet4, {2, 2, 1}, 0.0, 1.0));
  try {
    build(mesh,
          "[[tie]]\nname = \"t\"\nslave = \"a_z1\"\nmaster = \"b_z0\"\n[[coupling]]\nname = "
          "\"r\"\ntype = \"rigid\"\nsurface = \"a_x0\"\n");
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("tie t"), std::string::npos) << text;
    EXPECT_NE(text.find("coupling r"), std::string::npos) << text;
  }
}

TEST(Bolt, ItsTensionStretchesTheShankAndItsCoordinateIsTheShortening) {
  // A shank in two halves, both ends held; tension F shortens it by F (L1 + L2) / (E A), nu = 0.
  mesh::Mesh mesh = two_parts(slab(CellType::kTet10, {2, 2, 2}, 0.0),
                              slab(CellType::kTet10, {3, 1, 2}, 0.0, 1.0));
  set_quiet(true);
  const Config config = Config::parse(R"(
[material.cork]
regions = ["a", "b"]
E = 1e6
nu = 0.0
rho = 1.0
[[support]]
surface = "a_z0"
[[support]]
surface = "b_z1"
[[bolt]]
name = "bolt_1"
slave = "a_z1"
master = "b_z0"
direction = [0.0, 0.0, 1.0]
[[load]]
name = "tension"
kind = "force"
set = "bolt_1"
force = [0.0, 0.0, 100.0]
)",
                                      "bolt.fe.toml");
  StepClock clock;
  const fe::FeModel model = build_fe_model(mesh, read_recipe(config, mesh), clock).model;
  const Eigen::VectorXd q = dense::Cholesky(full(model.K)).solve(model.loads.at("tension"));
  EXPECT_NEAR(q(model.set("bolt_1").dofs[0]), 100.0 * 2.0 / 1e6, 1e-13);
  // Lower half: stretched by 1e-4 a metre, upwards.
  const Eigen::VectorXd u = model.T * q;
  for (const int32_t node : mesh::nodes_of(mesh.surface("a_z1")))
    EXPECT_NEAR(u(3 * node + 2), 1e-4, 1e-13);
}

}  // namespace
}  // namespace clatter::assembly::testing
