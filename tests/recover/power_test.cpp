// SPDX-License-Identifier: GPL-3.0-or-later
// Quadratic form, ERP and classic radiators.
#include "recover/skin/radiated_power.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "recover/field/expand.hpp"
#include "recover/skin/triangle6.hpp"
#include "synthetic.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::recover {
namespace {

using namespace testing;
using Complex = std::complex<double>;

TEST(RadiatedPower, UniformNormalVelocityGivesHalfRhoCSVSquaredExactly) {
  // The two x sides of a box move outward with v; the other four only move tangentially.
  const Mesh6 mesh = box({0.2, 0.5, 0.3}, 3);
  RowMatrix T = RowMatrix::Zero(mesh.nodes.size(), 1);
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a) T(3 * a, 0) = mesh.nodes(a, 0) / 0.1 - 1.0;
  const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
  const auto panels = choose_panels(default_panels({}), bare_skin(mesh), geometry);
  const auto forms =
      normal_velocity_forms({mesh.nodes, mesh.triangles}, rom::SkinRows(T), geometry, panels);
  const double v = 3e-3, S = 2 * 0.5 * 0.3;
  Eigen::MatrixXcd line(1, 1);
  line << v * std::polar(1.0, 0.7);
  const Air air;
  const double mean_square = 0.5 * normal_velocity_integral(forms[0].W, line)[0] / geometry.area;
  const double expected = 0.5 * air.density * air.sound_speed * S * v * v;
  EXPECT_NEAR(equivalent_radiated_power(air, geometry.area, mean_square) / expected, 1.0, 1e-14);
}

TEST(RadiatedPower, QuadraticFormEqualsBruteForceExpansion) {
  const Mesh6 mesh = unit_sphere(2);  // curved faces
  const int r = 7;
  const rom::Skin skin{mesh.nodes, mesh.triangles, random_rows(mesh, r, 1)};
  const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
  const auto panels = choose_panels(default_panels({}), bare_skin(mesh), geometry);
  const auto forms = normal_velocity_forms(skin, rom::SkinRows(skin.T), geometry, panels);
  Eigen::MatrixXcd v = test::random_matrix<Eigen::MatrixXcd>(3, r);
  for (size_t p = 0; p < panels.size(); ++p) {
    const Eigen::VectorXd fast = normal_velocity_integral(forms[p].W, v);
    for (Eigen::Index line = 0; line < v.rows(); ++line) {
      const Eigen::VectorXcd u = skin.T * v.row(line).transpose();
      double brute = 0.0;
      for (int32_t face : panels[p].faces)
        for (const FacePoint& point :
             face_points(face_coordinates(mesh.nodes, mesh.triangles, face))) {
          Eigen::Vector3cd at = Eigen::Vector3cd::Zero();
          for (int a = 0; a < 6; ++a)
            at += point.shape[a] * u.segment(3 * mesh.triangles(face, a), 3);
          const double dS = point.area_vector.norm();
          brute += dS * std::norm(point.area_vector.cast<Complex>().cwiseProduct(at).sum() / dS);
        }
      EXPECT_NEAR(fast[line] / brute, 1.0, 1e-12) << panels[p].name;
    }
  }
}

TEST(RadiatedPower, PanelsThatShareFacesSumAsTheirPartsDo) {
  const Mesh6 mesh = box({1, 1, 1}, 2);
  const rom::Skin skin{mesh.nodes, mesh.triangles, random_rows(mesh, 4, 2)};
  const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
  const auto panels = choose_panels(default_panels({}), bare_skin(mesh), geometry);
  const auto forms = normal_velocity_forms(skin, rom::SkinRows(skin.T), geometry, panels);
  Eigen::MatrixXd sides = Eigen::MatrixXd::Zero(4, 4);
  for (size_t p = 2; p < forms.size(); ++p) sides += forms[p].W;
  EXPECT_LT((sides - forms[0].W).norm(), 1e-13 * forms[0].W.norm());
  EXPECT_EQ(forms[0].W, forms[0].W.transpose());
}

TEST(RadiatedPower, ExpansionInBlocksEqualsTheWholeProduct) {
  const Mesh6 mesh = box({1, 1, 1}, 2);
  const RowMatrix T = random_rows(mesh, 5, 3);
  const Eigen::MatrixXd reduced = test::random_matrix(5, 11);
  Eigen::MatrixXd whole(T.rows(), 11);
  expand(rom::SkinRows(T), reduced, {30, 4}, [&](int64_t row, int64_t column, const auto& u) {
    ASSERT_LE(u.cols(), 4);
    ASSERT_LE(u.rows(), 30);
    whole.block(row, column, u.rows(), u.cols()) = u;
  });
  EXPECT_LT((whole - T * reduced).norm(), 1e-13);
}

/// Power through a skin: 1/2 Re integral of p v_n^* dS, v given at nodes, p everywhere.
template <typename Pressure, typename Velocity>
double power_through(const Mesh6& mesh, const Pressure& pressure, const Velocity& velocity) {
  Eigen::VectorXcd v(mesh.nodes.size());
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    v.segment(3 * a, 3) = velocity(Eigen::Vector3d(mesh.nodes.row(a)));
  std::vector<int32_t> faces(static_cast<size_t>(mesh.triangles.rows()));
  for (size_t f = 0; f < faces.size(); ++f) faces[f] = static_cast<int32_t>(f);
  const NormalSamples samples =
      normal_samples(mesh.nodes, mesh.triangles, faces, 0, mesh.triangles.rows());
  const Eigen::VectorXd re = samples.sample * v.real(), im = samples.sample * v.imag();
  double power = 0.0;
  Eigen::Index row = 0;
  for (int32_t face : faces) {
    const Coordinates6 x = face_coordinates(mesh.nodes, mesh.triangles, face);
    for (const FacePoint& point : face_points(x)) {
      const Complex p = pressure(Eigen::Vector3d(x.transpose() * point.shape));
      power += 0.5 * samples.weight[row] * std::real(p * std::conj(Complex(re[row], im[row])));
      ++row;
    }
  }
  return power;
}

/// p = A exp(-i k r) / r about `centre` and its velocity -grad p / (i w rho), e^{+i w t}.
struct Monopole {
  Eigen::Vector3d centre;
  double k;
  Complex A{0.4, 0.3};
  double density = 1.204, sound_speed = 343.2;
  Complex pressure(const Eigen::Vector3d& x) const {
    const double r = (x - centre).norm();
    return A * std::exp(-Complex(0.0, 1.0) * k * r) / r;
  }
  Eigen::Vector3cd velocity(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d d = x - centre;
    const double r = d.norm();
    const Complex slope = pressure(x) * (-Complex(0.0, 1.0) * k - 1.0 / r);
    return (-slope / (Complex(0.0, 1.0) * k * sound_speed * density) / r) * d.cast<Complex>();
  }
  double power() const { return 2 * std::numbers::pi * std::norm(A) / (density * sound_speed); }
};

Mesh6 ellipsoid(int level) {
  Mesh6 mesh = unit_sphere(level);
  mesh.nodes.col(0) *= 0.4;
  mesh.nodes.col(1) *= 0.25;
  mesh.nodes.col(2) *= 0.3;
  return mesh;
}

TEST(Order, MonopoleInsideASkinSendsItsPowerThroughIt) {
  const Monopole source{{0.05, -0.03, 0.04}, 8.0};
  double error[3];
  for (int level : {1, 2, 3})
    error[level - 1] =
        std::abs(power_through(
                     ellipsoid(level), [&](const auto& x) { return source.pressure(x); },
                     [&](const auto& x) { return source.velocity(x); }) /
                     source.power() -
                 1.0);
  EXPECT_LT(error[2], 1e-4);            // 1280 faces
  EXPECT_GT(error[1] / error[2], 8.0);  // at least third order; quadratic faces give up to 16
}

TEST(Order, PulsatingSphereHasItsRadiationEfficiency) {
  // sigma = P / (rho c S <v_n^2>) = (ka)^2 / (1 + (ka)^2): 0.5 at ka = 1.
  const Mesh6 mesh = unit_sphere(3);
  const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
  for (double ka : {0.3, 1.0, 4.0}) {
    const Monopole source{Eigen::Vector3d::Zero(), ka};
    RowMatrix T(mesh.nodes.size(), 2);  // columns: real and imaginary part of the velocity
    for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a) {
      const Eigen::Vector3cd v = source.velocity(Eigen::Vector3d(mesh.nodes.row(a)));
      T.block(3 * a, 0, 3, 1) = v.real();
      T.block(3 * a, 1, 3, 1) = v.imag();
    }
    const auto forms =
        normal_velocity_forms({mesh.nodes, mesh.triangles}, rom::SkinRows(T), geometry,
                              choose_panels({{.name = "skin"}}, bare_skin(mesh), geometry));
    Eigen::MatrixXcd q(1, 2);
    q << 1.0, Complex(0.0, 1.0);
    const Air air{source.density, source.sound_speed, 1.0};
    const double mean_square = 0.5 * normal_velocity_integral(forms[0].W, q)[0] / geometry.area;
    const double erp = equivalent_radiated_power(air, geometry.area, mean_square);
    // Faces are quadratic, not spherical: 1280 of them leave about 1e-5.
    EXPECT_NEAR(source.power() / erp, ka * ka / (1 + ka * ka), 1e-4 * ka * ka / (1 + ka * ka));
  }
}

}  // namespace
}  // namespace clatter::recover
