// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "block_mesh.hpp"
#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"
#include "sheet.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

constexpr double kAreaMass = 5.0;

std::string lined(const std::string& surface) {
  return "[[surface_mass]]\nsurface = \"" + surface + "\"\narea_mass = 5.0\n";
}

Eigen::MatrixXd added_to(const mesh::Mesh& mesh, const std::string& surface) {
  return full(build(mesh, lined(surface)).model.M) - full(build(mesh, "").model.M);
}

// int N_a N_b dA of a rectangle: A / 36 [4 2 1 2; 2 4 2 1; 1 2 4 2; 2 1 2 4].
TEST(SurfaceMass, IsThatOfABilinearFaceByHand) {
  BlockOptions options;
  options.type = mesh::CellType::kHex8;
  const mesh::Mesh mesh = block_mesh({1, 1, 1}, brick({0.3, 0.2, 0.1}), options);
  const Eigen::MatrixXd M = added_to(mesh, "z1");
  const double unit = kAreaMass * 0.3 * 0.2 / 36.0;
  for (Eigen::Index a = 0; a < 8; ++a)
    for (Eigen::Index b = 0; b < 8; ++b) {
      const Eigen::Vector3d apart = (mesh.nodes.row(a) - mesh.nodes.row(b)).transpose();
      const bool on_face = mesh.nodes(a, 2) > 0.05 && mesh.nodes(b, 2) > 0.05;
      const double share =
          (std::abs(apart.x()) > 0.1 ? 1.0 : 2.0) * (std::abs(apart.y()) > 0.1 ? 1.0 : 2.0);
      const Eigen::Matrix3d want = (on_face ? share * unit : 0.0) * Eigen::Matrix3d::Identity();
      EXPECT_LT((M.block<3, 3>(3 * a, 3 * b) - want).cwiseAbs().maxCoeff(), 1e-15);
    }
}

TEST(SurfaceMass, OnASheetIsTheAreaMassOfItsShells) {
  mesh::Mesh mesh = sheet(0.4, 0.05, 4, 2);
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    mesh.nodes(a, 2) = 0.3 * mesh.nodes(a, 0) * mesh.nodes(a, 1);
  mesh.surfaces["face"] = mesh::shell_surface(mesh);
  const auto on_face = build_all(mesh, kSheetSteel + lined("face"));
  const auto in_shells = build_all(mesh, kSheetSteel + "area_mass = 5.0\n");
  const Eigen::MatrixXd M = full(in_shells.model.M);
  EXPECT_LT((full(on_face.model.M) - M).cwiseAbs().maxCoeff(),
            1e-15 * M.cwiseAbs().maxCoeff() * 100);
  EXPECT_NEAR(on_face.model.mass.mass, in_shells.model.mass.mass, 1e-14);
}

// The certificate compares M with the integrals of the same masses.
TEST(SurfaceMass, CountsInMassGravityAndRotationOnCurvedFaces) {
  BlockOptions options;
  options.curved = options.wrap_x = true;
  const mesh::Mesh mesh = block_mesh({8, 1, 2}, ring(0.04, 0.06, 0.1), options);
  const std::string loads = R"(
[[load]]
name = "weight"
kind = "acceleration"
direction = [0.0, 0.0, -1.0]
[[load]]
name = "spin"
kind = "centrifugal"
axis_point = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
[[load]]
name = "spin_of_the_body"
kind = "centrifugal"
axis_point = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
regions = ["body"]
)";
  const auto plain = build(mesh, loads), lining = build(mesh, lined("y0") + loads);
  EXPECT_LT(*lining.certificate.mass_error, 1e-13);
  EXPECT_LT(*lining.certificate.inertia_error, 1e-12);
  const double mass = lining.model.mass.mass - plain.model.mass.mass;
  EXPECT_NEAR(mass, kAreaMass * 2.0 * std::numbers::pi * 0.04 * 0.1,
              2e-3 * mass);  // 8 cells around
  const Eigen::VectorXd weight = lining.model.rigid.transpose() * lining.model.loads.at("weight");
  EXPECT_NEAR(weight(2), -lining.model.mass.mass, 1e-12);
  Eigen::VectorXd arm(3 * mesh.nodes.rows());
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    arm.segment<3>(3 * a) << mesh.nodes(a, 0), mesh.nodes(a, 1), 0.0;
  const Eigen::VectorXd want = full(lining.model.M) * arm;
  EXPECT_LT((lining.model.loads.at("spin") - want).cwiseAbs().maxCoeff(),
            1e-13 * want.cwiseAbs().maxCoeff());
  EXPECT_EQ(
      (lining.model.loads.at("spin_of_the_body") - plain.model.loads.at("spin_of_the_body")).norm(),
      0.0);
}

TEST(SurfaceMass, RefusesAnUnknownSurfaceAndAMassThatIsNone) {
  const mesh::Mesh mesh = block_mesh({1, 1, 1}, brick({0.1, 0.1, 0.1}));
  test::expect_parts(test::refusal_of([&] { build(mesh, lined("bottom")); }),
                     {"surface", "bottom"});
  test::expect_parts(test::refusal_of([&] {
                       build(mesh, "[[surface_mass]]\nsurface = \"z0\"\narea_mass = 0.0\n");
                     }),
                     {"area_mass", "found 0"});
}

}  // namespace
}  // namespace clatter::assembly::testing
