// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of faces from points and normals: small patches anywhere in space.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "mesh/face/face_shape.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;

/// A patch of 5 x 5 samples of a surface x(u, v) with normals n(u, v), turned and moved.
struct Patch {
  std::vector<Vector3d> points, normals;
  Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
  Vector3d shift = {310.0, -42.0, 77.0};

  using Map = std::function<Vector3d(double, double)>;
  Patch(double u_end, double v_end, const Map& x, const Map& n) {
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j) {
        const double u = u_end * (i + 0.5) / 5, v = v_end * (j + 0.5) / 5;
        points.push_back(turn * x(u, v) + shift);
        normals.push_back(turn * n(u, v));
      }
  }
  SurfaceShape shape(const std::string& kind) const { return find_shape(kind, points, normals); }
  double off_axis(const SurfaceShape& shape, const Vector3d& own) const {
    return (turn * own + shift - shape.point).cross(shape.direction).norm();
  }
};

Vector3d round(double a) { return {std::cos(a), std::sin(a), 0.0}; }

// Angles of a quarter turn down to a degree: the fit loses the square of the angle, 1e-16 / 3e-4.
class FaceShapeOfAPatch : public ::testing::TestWithParam<double> {};

TEST_P(FaceShapeOfAPatch, CylinderRadiusAndAxis) {
  const double tolerance = 1e-10 / (GetParam() * GetParam());
  const Patch patch(
      GetParam(), 20.0,
      [](double u, double v) { return Vector3d(46.5 * round(u) + Vector3d(0, 0, v)); },
      [](double u, double) { return Vector3d(-round(u)); });
  const SurfaceShape shape = patch.shape("Cylinder");
  EXPECT_EQ(shape.kind, ShapeKind::kCylinder);
  EXPECT_NEAR(shape.radius, 46.5, tolerance);
  EXPECT_NEAR(std::abs(shape.direction.dot(patch.turn.col(2))), 1.0, tolerance);
  EXPECT_LT(patch.off_axis(shape, Vector3d::Zero()), tolerance);
  EXPECT_EQ(describe(shape, "mm"), "cylinder of radius 46.5 mm");
}

TEST_P(FaceShapeOfAPatch, ConeApexAndAngle) {
  const double tolerance = 1e-9 / (GetParam() * GetParam()), a = 30.0 * std::numbers::pi / 180;
  const Patch patch(
      GetParam(), 10.0,
      [&](double u, double v) {
        const double s = 20.0 + v;
        return Vector3d(s * std::sin(a) * round(u) + Vector3d(0, 0, s * std::cos(a)));
      },
      [&](double u, double) {
        return Vector3d(std::cos(a) * round(u) - Vector3d(0, 0, std::sin(a)));
      });
  const SurfaceShape shape = patch.shape("Cone");
  EXPECT_NEAR(shape.half_angle_deg, 30.0, tolerance);
  EXPECT_LT((shape.point - patch.shift).norm(), tolerance);
  EXPECT_NEAR(std::abs(shape.direction.dot(patch.turn.col(2))), 1.0, tolerance);
}

TEST_P(FaceShapeOfAPatch, TorusRadii) {
  const double tolerance = 1e-8 / (GetParam() * GetParam());
  const Patch patch(
      GetParam(), 1.5,
      [](double u, double v) {
        return Vector3d((30 + 2 * std::cos(v)) * round(u) + Vector3d(0, 0, 2 * std::sin(v)));
      },
      [](double u, double v) {
        return Vector3d(std::cos(v) * round(u) + Vector3d(0, 0, std::sin(v)));
      });
  const SurfaceShape shape = patch.shape("Torus");
  EXPECT_NEAR(shape.radius, 30.0, tolerance);
  EXPECT_NEAR(shape.minor_radius, 2.0, tolerance);
  EXPECT_LT((shape.point - patch.shift).norm(), tolerance);
  for (const Vector3d& x : patch.points) EXPECT_LT(distance_to(shape, x), tolerance);
}

INSTANTIATE_TEST_SUITE_P(Angles, FaceShapeOfAPatch, ::testing::Values(6.2, 1.5, 0.2, 0.02));

TEST(SurfaceShape, PlaneAndSphere) {
  const Patch plane(
      3.0, 2.0, [](double u, double v) { return Vector3d(u, v, 0); },
      [](double, double) { return Vector3d(0, 0, 1); });
  EXPECT_LT((plane.shape("Plane").direction - plane.turn.col(2)).norm(), 1e-14);
  const Patch ball(
      1.0, 0.5,
      [](double u, double v) {
        return Vector3d(7 * std::cos(v) * round(u) + Vector3d(0, 0, 7 * std::sin(v)));
      },
      [](double u, double v) {
        return Vector3d(std::cos(v) * round(u) + Vector3d(0, 0, std::sin(v)));
      });
  const SurfaceShape sphere = ball.shape("Sphere");
  EXPECT_NEAR(sphere.radius, 7.0, 1e-11);
  EXPECT_LT((sphere.point - ball.shift).norm(), 1e-11);
}

// Some programs write all faces as splines: their shape is found from points.
TEST(SurfaceShape, ASplineThatIsACylinderIsCalledSoAndAWavyOneIsNot) {
  const auto make = [](double wave) {
    return Patch(
               1.0, 30.0,
               [=](double u, double v) {
                 return Vector3d((10 + wave * std::sin(8 * u)) * round(u) + Vector3d(0, 0, v));
               },
               [](double u, double) { return round(u); })
        .shape("BSpline surface");
  };
  EXPECT_EQ(describe(make(0.0), "mm"), "spline cylinder of radius 10 mm");
  EXPECT_EQ(describe(make(0.01), "mm"), "spline");
  EXPECT_EQ(find_shape("Surface of Revolution", {}, {}).kind, ShapeKind::kRevolved);
}

}  // namespace
}  // namespace clatter::mesh
