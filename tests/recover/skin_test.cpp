// SPDX-License-Identifier: GPL-3.0-or-later
// Areas, normals and weights of a skin against hand-computed values.
#include "recover/skin/skin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "recover/skin/panels.hpp"
#include "recover/skin/sensors.hpp"
#include "recover/skin/triangle6.hpp"
#include "synthetic.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

using namespace testing;

double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

TEST(Triangle6, QuadratureIsExactToDegreeFour) {
  // integral of u^i v^j over the reference triangle = i! j! / (i + j + 2)!
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j) {
      double sum = 0.0;
      for (const auto& p : quadrature_points())
        sum += p.weight * std::pow(p.u, i) * std::pow(p.v, j);
      EXPECT_NEAR(sum, factorial(i) * factorial(j) / factorial(i + j + 2), 1e-16) << i << " " << j;
    }
}

TEST(Triangle6, ShapeFunctionsAreOneAtTheirNodeAndGradientsMatchDifferences) {
  const double u[6] = {0, 1, 0, 0.5, 0.5, 0}, v[6] = {0, 0, 1, 0, 0.5, 0.5};
  for (int a = 0; a < 6; ++a) {
    Shape6 unit = Shape6::Zero();
    unit[a] = 1.0;
    EXPECT_LT((shape_functions(u[a], v[a]) - unit).norm(), 1e-15);
  }
  const double h = 1e-4;  // shape functions are quadratic: central differences are exact
  const auto g = shape_gradients(0.3, 0.2);
  EXPECT_LT(
      (g.col(0) - (shape_functions(0.3 + h, 0.2) - shape_functions(0.3 - h, 0.2)) / (2 * h)).norm(),
      1e-11);
  EXPECT_LT(
      (g.col(1) - (shape_functions(0.3, 0.2 + h) - shape_functions(0.3, 0.2 - h)) / (2 * h)).norm(),
      1e-11);
}

TEST(Sensors, OfAPositionSaysItsDistanceAndIsRefusedInAnotherUnit) {
  const Mesh6 mesh = box({1, 1, 1}, 1);
  const RowMatrix rows = RowMatrix::Identity(mesh.nodes.size(), 2);
  const rom::ReducedModel model = model_on(mesh, rows, 0.0);
  const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
  const rom::SkinRows T(rows);
  ::testing::internal::CaptureStderr();
  const auto sensors = find_sensors({{.name = "top", .position = Eigen::Vector3d(1.0, 1.0, 1.003)}},
                                    model, T, geometry);
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(
      said.find("sensor 'top': the nearest node of the skin lies at (1, 1, 1) m, 3 mm from the "
                "requested position"),
      std::string::npos)
      << said;
  EXPECT_EQ(sensors.at(0).position.row(0), Eigen::RowVector3d(1, 1, 1));
  test::expect_parts(test::refusal_of([&] {
                       find_sensors({{.name = "top", .position = Eigen::Vector3d(0, 0, 1000)}},
                                    model, T, geometry);
                     }),
                     {"sensor 'top': the nearest node of the skin lies at (0, 0, 1) m",
                      "expected at most an element's size there, 1.41e+03 mm: positions are in "
                      "metres, this one fits in millimetres"});
  EXPECT_EQ(test::refusal_of([&] {
              find_sensors({{.name = "top", .position = Eigen::Vector3d(4, 4, 4)}}, model, T,
                           geometry);
            }).find("fits"),
            std::string::npos);
}

TEST(Skin, BoxHasItsAreaVolumeAndClosesExactly) {
  const Mesh6 mesh = box({0.3, 0.2, 0.1}, 3);
  const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
  EXPECT_NEAR(geometry.area, 2 * (0.06 + 0.03 + 0.02), 1e-15);
  EXPECT_NEAR(geometry.volume, 0.006, 1e-16);
  EXPECT_LT(geometry.closure, 1e-15);
  EXPECT_NEAR(geometry.node_area.sum(), geometry.area, 1e-15);
  EXPECT_GT(geometry.node_area.minCoeff(), 0.0);
}

TEST(Skin, CurvedClosedSkinStillHasVanishingVectorArea) {
  const Mesh6 mesh = unit_sphere(2);
  const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
  EXPECT_LT(geometry.closure, 1e-14);  // exact for quadratic faces, rounding only
  EXPECT_NEAR(geometry.area, 4 * std::numbers::pi, 1e-3 * 4 * std::numbers::pi);
  // Normals of the sphere are its radii.
  EXPECT_LT((geometry.node_normal - mesh.nodes).rowwise().norm().maxCoeff(), 5e-3);
}

TEST(Skin, SphereAreaAndVolumeConvergeWithFourthOrder) {
  double area_error[2], volume_error[2];
  for (int level : {1, 2}) {
    const Mesh6 mesh = unit_sphere(level);
    const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
    area_error[level - 1] = std::abs(geometry.area - 4 * std::numbers::pi);
    volume_error[level - 1] = std::abs(geometry.volume - 4 * std::numbers::pi / 3);
  }
  // Quadratic faces: error ~ h^4, so a factor near 16; 12 allows for the coarse mesh.
  EXPECT_GT(area_error[0] / area_error[1], 12.0);
  EXPECT_GT(volume_error[0] / volume_error[1], 12.0);
}

TEST(Skin, InsideOutIsRefused) {
  Mesh6 mesh = box({1, 1, 1}, 1);
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  mesh.triangles.col(3).swap(mesh.triangles.col(5));
  test::expect_parts(test::refusal_of([&] { measure_skin(mesh.nodes, mesh.triangles); }),
                     {"skin: enclosed volume -1 m3, expected outward triangles"});
}

TEST(Skin, FaceWithoutAreaIsRefused) {
  Mesh6 mesh = box({1, 1, 1}, 1);
  for (int a = 1; a < 6; ++a) mesh.triangles(0, a) = mesh.triangles(0, 0);
  test::expect_parts(test::refusal_of([&] { measure_skin(mesh.nodes, mesh.triangles); }),
                     {"skin: triangle 0: area 0 m2, expected a positive area"});
}

TEST(Skin, FaceOperatorGivesTheMeanNormalVelocityOfALinearField) {
  const Mesh6 mesh = box({1, 1, 1}, 2);
  const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
  const SparseRows normal = face_normal_operator(mesh.nodes, mesh.triangles, geometry);
  Eigen::VectorXd v(mesh.nodes.size());
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    v.segment(3 * a, 3) = mesh.nodes.row(a).transpose() * 2.0;  // v = 2 x: its mean is 2 centre
  const Eigen::VectorXd expected =
      2.0 * (geometry.face_centre.cwiseProduct(geometry.face_normal)).rowwise().sum();
  EXPECT_LT((normal * v - expected).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Panels, DirectionBoxAndExposurePickTheFacesOfAHollowBox) {
  const Mesh6 mesh = hollow_box({0.3, 0.3, 0.3}, 2);
  const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
  EXPECT_NEAR(geometry.volume, 0.027 - 0.001, 1e-15);
  const auto panels = choose_panels(default_panels({}), bare_skin(mesh), geometry);
  ASSERT_EQ(panels.size(), 8u);  // skin, exposed, six sides
  EXPECT_NEAR(panels[0].area, 6 * (0.09 + 0.01), 1e-14);
  EXPECT_NEAR(panels[1].area, 6 * 0.09, 1e-14);  // walls of the hole face each other
  for (size_t side = 2; side < 8; ++side) EXPECT_NEAR(panels[side].area, 0.09, 1e-14);

  PanelRule half{.name = "half"};
  half.direction = Eigen::Vector3d(0, 2, 0);
  half.angle_deg = 10.0;
  half.box_min = Eigen::Vector3d(0.0, 0.29, 0.0);
  half.box_max = Eigen::Vector3d(0.15, 0.31, 0.3);
  EXPECT_NEAR(choose_panels({half}, bare_skin(mesh), geometry)[0].area, 0.045, 1e-15);
}

TEST(Panels, SurfacesOfTheMeshAreJoinedAndCombineWithTheOtherConditions) {
  const Mesh6 mesh = box({1, 2, 3}, 1);
  const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
  // Sides in the order -x +x -y +y -z +z, two triangles each.
  const std::map<std::string, std::vector<int32_t>> surfaces{
      {"ends", {0, 1, 2, 3}}, {"deck", {10, 11}}, {"half", {2, 4, 10}}};
  const auto choose = [&](const PanelRule& rule) {
    return choose_panels({rule}, bare_skin(mesh, surfaces), geometry)[0];
  };
  EXPECT_EQ(choose({.name = "p", .surfaces = {"deck"}}).faces, (std::vector<int32_t>{10, 11}));
  const Panel joined = choose({.name = "p", .surfaces = {"half", "ends"}});
  EXPECT_EQ(joined.faces, (std::vector<int32_t>{0, 1, 2, 3, 4, 10}));
  EXPECT_NEAR(joined.area, 2 * 6.0 + 0.5 * 3.0 + 0.5 * 2.0, 1e-14);
  PanelRule narrow{.name = "p", .surfaces = {"half", "ends"}};
  narrow.direction = Eigen::Vector3d(1, 0, 0);
  EXPECT_EQ(choose(narrow).faces, (std::vector<int32_t>{2, 3}));

  EXPECT_EQ(test::refusal_of([&] {
              choose({.name = "p", .surfaces = {"deck", "ends", "dekc"}});
            }),
            "panel 'p': no surface of the skin named dekc, expected one of: deck, ends, half");
  narrow.surfaces = {"deck"};
  test::expect_parts(
      test::refusal_of([&] { choose(narrow); }),
      {"panel 'p': found no face, expected at least one: the skin has 12 faces, lies between "
       "(0, 0, 0) and (1, 2, 3) m, and has the surfaces [deck, ends, half]"});
  test::expect_parts(
      test::refusal_of(
          [&] { choose_panels({{.name = "p", .surfaces = {"deck"}}}, bare_skin(mesh), geometry); }),
      {"panel 'p': surfaces: the reduced model has no surfaces by name"});
}

TEST(Panels, RuleWithoutAFaceAndNameTwiceAreRefused) {
  const Mesh6 mesh = box({1, 1, 1}, 1);
  const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
  PanelRule nowhere{.name = "nowhere"};
  nowhere.box_min = Eigen::Vector3d(5, 5, 5);
  test::expect_parts(
      test::refusal_of([&] { choose_panels({nowhere}, bare_skin(mesh), geometry); }),
      {"panel 'nowhere': found no face, expected at least one: the skin has 12 faces, lies between "
       "(0, 0, 0) and (1, 1, 1) m, and has the surfaces []"});
  const PanelRule all{.name = "all"};
  test::expect_parts(test::refusal_of([&] {
                       choose_panels({all, all}, bare_skin(mesh), geometry);
                     }),
                     {"panel 'all': found twice, expected different names"});
}

}  // namespace
}  // namespace clatter::recover
