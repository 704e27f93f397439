// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of synthetic displacement fields.
#include "modal/shape.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "block_mesh.hpp"
#include "tests/refusal.hpp"

namespace clatter::modal {
namespace {

using assembly::testing::block_mesh;
using mesh::CellType;

constexpr double kUm = 1e-6;

/// A bore of 50 mm radius from z = 0.1 to 0.3 m; surface y0 is the bore.
mesh::Mesh bore(CellType type, int around, int along = 4) {
  assembly::testing::BlockOptions options;
  options.type = type;
  options.curved = true;
  options.wrap_x = true;
  const auto map = assembly::testing::ring(0.05, 0.06, 0.2);
  return block_mesh(
      {around, 1, along},
      [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
        return map(x) + 0.1 * Eigen::Vector3d::UnitZ();
      },
      options);
}

ShapeOptions options_of(const std::string& surface) {
  ShapeOptions options;
  options.surface = surface;
  options.cases = {"field"};
  options.axes = CylinderAxes{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  options.heights = 9;
  return options;
}

/// The shape of a displacement u(x), with angle 0 along y.
template <class Field>
Shape shape_of_field(const mesh::Mesh& mesh, const Field& u, const ShapeOptions& options) {
  Eigen::VectorXd all(3 * mesh.nodes.rows());
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    all.segment<3>(3 * a) = u(Eigen::Vector3d(mesh.nodes.row(a)));
  return shape_of(mesh.nodes, mesh.surface(options.surface), {all}, options, "test");
}

double angle_of(const Eigen::Vector3d& x) { return std::atan2(-x(0), x(1)); }  // from y, about z

Eigen::Vector3d outward(const Eigen::Vector3d& x) {
  return Eigen::Vector3d(x(0), x(1), 0.0).normalized();
}

/// 10 um wider at z = 0.1 m, 50 um at 0.3 m; 20 um of order 2 with its maximum at 30 degrees.
Eigen::Vector3d cone_and_oval(const Eigen::Vector3d& x) {
  const double oval = std::cos(2.0 * (angle_of(x) - std::numbers::pi / 6.0));
  return (10.0 + 200.0 * (x(2) - 0.1) + 20.0 * oval) * kUm * outward(x);
}

double error_at(CellType type, int around) {
  const Shape shape = shape_of_field(bore(type, around), cone_and_oval, options_of("y0"));
  double worst = 0.0;
  for (Eigen::Index i = 0; i < shape.height.size(); ++i)
    for (Eigen::Index j = 0; j < shape.angle.size(); ++j) {
      const double exact = 10.0 + 200.0 * (shape.height(i) - 0.1) +
                           20.0 * std::cos(2.0 * shape.angle(j) - std::numbers::pi / 3.0);
      worst = std::max(worst, std::abs(shape.cases[0].deviation(i, j) - exact * kUm));
    }
  return worst;
}

TEST(Shape, OfAConeAndAnOvalConvergesWithTheOrderOfTheCells) {
  EXPECT_LT(error_at(CellType::kHex20, 24), 0.1 * kUm);
  for (const CellType type : {CellType::kTet4, CellType::kHex8}) {
    const double rate = std::log2(error_at(type, 16) / error_at(type, 32));
    EXPECT_GT(rate, 1.8) << mesh::traits(type).name;
    EXPECT_LT(rate, 2.3) << mesh::traits(type).name;
  }
  for (const CellType type : {CellType::kTet10, CellType::kHex20})
    EXPECT_GT(std::log2(error_at(type, 12) / error_at(type, 24)), 2.7) << mesh::traits(type).name;
}

TEST(Shape, OrdersAreAmplitudesWithTheirPhase) {
  const Shape shape = shape_of_field(bore(CellType::kHex20, 48), cone_and_oval, options_of("y0"));
  const ShapeCase& found = shape.cases[0];
  ASSERT_EQ(found.order_re.cols(), 9);
  for (Eigen::Index i = 0; i < shape.height.size(); ++i) {
    EXPECT_NEAR(found.order_re(i, 0), (10.0 + 200.0 * (shape.height(i) - 0.1)) * kUm, 2e-3 * kUm);
    // Re c exp(2 i angle), largest at 30 degrees: c = 20 exp(-i 60 degrees).
    EXPECT_NEAR(found.order_re(i, 2), 10.0 * kUm, 2e-3 * kUm);
    EXPECT_NEAR(found.order_im(i, 2), -20.0 * std::sin(std::numbers::pi / 3.0) * kUm, 2e-3 * kUm);
    for (const Eigen::Index m : {1, 3, 4, 5, 6, 7, 8})
      EXPECT_LT(std::hypot(found.order_re(i, m), found.order_im(i, m)), 2e-3 * kUm) << m;
  }
}

TEST(Shape, RigidMotionsAreFoundAndRemovedOrKept) {
  const Eigen::Vector3d shift(30.0 * kUm, -20.0 * kUm, 70.0 * kUm);
  const Eigen::Vector3d turn(1e-4, -2e-4, 5e-4);
  const auto rigid = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return shift + turn.cross(x);
  };
  for (const CellType type : {CellType::kTet4, CellType::kHex20}) {
    ShapeOptions options = options_of("y0");
    const Shape removed = shape_of_field(bore(type, 16), rigid, options);
    EXPECT_LT(removed.cases[0].deviation.cwiseAbs().maxCoeff(), 1e-15);
    // Angle 0 is y, 90 degrees is -x; theta x (z e_z) = (theta_y, -theta_x) z.
    EXPECT_NEAR(removed.cases[0].rigid(0), shift(1), 1e-15);
    EXPECT_NEAR(removed.cases[0].rigid(1), -shift(0), 1e-15);
    EXPECT_NEAR(removed.cases[0].rigid(2), -turn(0), 1e-14);
    EXPECT_NEAR(removed.cases[0].rigid(3), -turn(1), 1e-14);
    options.keep_rigid = true;
    const Shape kept = shape_of_field(bore(type, 16), rigid, options);
    EXPECT_EQ(kept.cases[0].rigid, removed.cases[0].rigid);
    const double z = kept.height(4);
    EXPECT_NEAR(kept.cases[0].order_re(4, 1), shift(1) - turn(0) * z, 1e-14);
    EXPECT_NEAR(kept.cases[0].order_im(4, 1), shift(0) + turn(1) * z, 1e-14);
  }
}

/// The surface without the faces that reach beyond |x| = 25 mm: two pads, as a skirt has.
mesh::Mesh two_pads() {
  mesh::Mesh mesh = bore(CellType::kHex20, 48);
  mesh::SurfaceBuilder pads;
  for (const mesh::FaceBlock& block : mesh.surface("y0").faces)
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
      std::vector<int32_t> face;
      double reach = 0.0;
      for (const int32_t node : block.nodes.row(f)) {
        face.push_back(node);
        reach = std::max(reach, std::abs(mesh.nodes(node, 0)));
      }
      if (reach < 0.0251) pads.add(block.type, face);
    }
  mesh.surfaces["pads"] = pads.finish();
  return mesh;
}

TEST(Shape, OfTwoPadsWidensWithoutATranslationAndIsBridgedBetweenThem) {
  const mesh::Mesh mesh = two_pads();
  const auto wider = [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return (x(1) > 0.0 ? 40.0 : 40.0) * kUm * outward(x) + 5.0 * kUm * Eigen::Vector3d::UnitY();
  };
  const Shape shape = shape_of_field(mesh, wider, options_of("pads"));
  const double covered = shape.covered.cast<double>().mean();
  EXPECT_NEAR(covered, 1.0 / 3.0, 0.03);
  EXPECT_NEAR(shape.cases[0].rigid(0), 5.0 * kUm, 1e-9);
  EXPECT_NEAR(shape.cases[0].rigid(1), 0.0, 1e-9);
  EXPECT_LT((shape.cases[0].deviation.array() - 40.0 * kUm).abs().maxCoeff(), 2e-3 * kUm);
  // Different pads: linear in the angle between them.
  const auto uneven = [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return (x(1) > 0.0 ? 40.0 : 10.0) * kUm * outward(x);
  };
  ShapeOptions options = options_of("pads");
  options.keep_rigid = true;
  const Shape bridged = shape_of_field(mesh, uneven, options);
  EXPECT_NEAR(bridged.cases[0].deviation(4, 0), 40.0 * kUm, 2e-3 * kUm);
  EXPECT_NEAR(bridged.cases[0].deviation(4, 36), 10.0 * kUm, 2e-3 * kUm);
  EXPECT_NEAR(bridged.cases[0].deviation(4, 18), 25.0 * kUm, 0.5 * kUm);
  EXPECT_EQ(bridged.covered(4, 18), 0);
}

TEST(Shape, AxesOfAnyDirectionGiveTheSameDeviations) {
  // The part turned and moved as a body, with its axes.
  mesh::Mesh mesh = bore(CellType::kTet10, 16);
  const Shape upright = shape_of_field(mesh, cone_and_oval, options_of("y0"));
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
  const Eigen::Vector3d place(0.3, -0.7, 0.2);
  const mesh::Mesh original = mesh;
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    mesh.nodes.row(a) = (R * original.nodes.row(a).transpose() + place).transpose();
  ShapeOptions options = options_of("y0");
  options.axes = CylinderAxes{place, R.col(2), R.col(1)};
  const Shape turned = shape_of_field(
      mesh,
      [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
        return R * cone_and_oval(R.transpose() * (x - place));
      },
      options);
  EXPECT_LT((turned.cases[0].deviation - upright.cases[0].deviation).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((turned.height - upright.height).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Shape, WhatDoesNotFitIsRefused) {
  const mesh::Mesh mesh = bore(CellType::kHex8, 8);
  const auto refusal = [&](const ShapeOptions& options) {
    return test::refusal_of([&] { shape_of_field(mesh, cone_and_oval, options); });
  };
  ShapeOptions options = options_of("z0");
  test::expect_parts(refusal(options), {"test: found nodes ", "expected a cylinder about it"});
  options = options_of("y0");
  options.range = {0.1, 0.4};
  test::expect_parts(refusal(options), {"test: --range: found 0.1 to 0.4 m, expected ascending "
                                        "heights from 0.1 to 0.3 m"});
  options = options_of("y0");
  options.orders = 36;
  test::expect_parts(refusal(options),
                     {"--orders: found 36, expected less than half of the 72 angles"});
  options.heights = 1;
  test::expect_parts(refusal(options), {"--heights: found 1, expected 2 to 10000"});
}

TEST(Shape, AHeightWithoutFacesIsRefused) {
  mesh::Mesh mesh = bore(CellType::kHex8, 8);
  mesh::SurfaceBuilder ends;
  for (const mesh::FaceBlock& block : mesh.surface("y0").faces)
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
      std::vector<int32_t> face;
      double z = 0.0;
      for (const int32_t node : block.nodes.row(f)) face.push_back(node), z += mesh.nodes(node, 2);
      if (std::abs(0.25 * z - 0.2) > 0.06) ends.add(block.type, face);
    }
  mesh.surfaces["ends"] = ends.finish();
  test::expect_parts(
      test::refusal_of([&] { shape_of_field(mesh, cone_and_oval, options_of("ends")); }),
      {"test: found no face at height 0.175 m, expected some; choose --range"});
}

}  // namespace
}  // namespace clatter::modal
