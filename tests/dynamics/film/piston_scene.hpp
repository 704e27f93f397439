// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A small piston in a liner for the element's tests.
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include "dynamics/film/piston_liner.hpp"

namespace clatter::film {

/// Patches all around, `n_a` x `n_z` over [low, high] along z.
inline rom::ContactGrid make_patches(int n_a, int n_z, double low, double high, double radius) {
  rom::ContactGrid grid;
  grid.radius = radius;
  grid.axis_point = {0.0, 0.0, low};
  grid.zero_angle = Eigen::Vector3d::UnitY();
  const double width = 2.0 * std::numbers::pi / n_a;
  grid.angle = Eigen::VectorXd::LinSpaced(n_a, 0.0, 2.0 * std::numbers::pi - width);
  grid.angle_edges.resize(2 * n_a);
  for (int i = 0; i < n_a; ++i)
    grid.angle_edges.segment<2>(2 * i) << (i - 0.5) * width, (i + 0.5) * width;
  grid.axial_edges = Eigen::VectorXd::LinSpaced(n_z + 1, 0.0, high - low);
  grid.axial = 0.5 * (grid.axial_edges.head(n_z) + grid.axial_edges.tail(n_z));
  return grid;
}

/// Stroke of the sample's crank drive at 2000 rpm, 65 mm crank and 210 mm rod.
inline StrokeState crank_stroke(double time) {
  const double w = 2000.0 * std::numbers::pi / 30.0, r = 0.065, l = 0.210;
  const double s = std::sin(w * time), c = std::cos(w * time),
               root = std::sqrt(l * l - r * r * s * s);
  return {r * c + root, -w * (r * s + r * r * s * c / root)};
}

/// Coordinates of an elastic element: [skirt | its fit | liner | its fit | pin | axial].
constexpr int kSkirt = 0, kSkirtFit = 24, kLiner = 28, kLinerFit = 68, kPin = 72, kAxial = 78;

/// The tangent of all coordinates.
inline Eigen::MatrixXd full_tangent(const dynamics::Response& response) {
  const Eigen::Index n = response.force.size();
  if (response.touched.empty()) return response.tangent;
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(n, n);
  tangent(response.touched, response.touched) = response.tangent;
  return tangent;
}

/// `elastic`: 8 x 3 skirt patches and 8 x 5 liner patches with an axial liner coordinate and a
/// resting shape. `offset`: of the pin toward the thrust side [m]; the liner's axial coordinate is
/// then off the bore's axis by another half of it.
inline std::unique_ptr<PistonLiner> make_element(PistonLinerOptions options, bool elastic,
                                                 double offset = 0.0) {
  PistonLinerBodies bodies;
  bodies.bore_axis.y() = -offset;
  bodies.liner_axial = {0.5 * offset, -1.5 * offset};
  bodies.stroke = crank_stroke;
  int n = 6;
  if (elastic) {
    bodies.piston = ElasticSurface{
        make_patches(8, 3, options.skirt_bottom, options.skirt_top, options.bore_radius), {}};
    bodies.liner = ElasticSurface{make_patches(8, 5, 0.08, 0.31, options.bore_radius), {}};
    LinerShape shape;
    shape.angle = Eigen::VectorXd::LinSpaced(4, 0.0, 1.5 * std::numbers::pi);
    shape.height = Eigen::VectorXd::LinSpaced(3, 0.05, 0.33);
    shape.deviation =
        1e-6 * (Eigen::MatrixXd(4, 3) << 0, 1, 2, 1, 0, 1, 2, 1, 0, 0, 2, 1).finished();
    options.bore = shape;
    n = kAxial + 1;
  }
  std::vector<int> coordinates(static_cast<size_t>(n));
  std::iota(coordinates.begin(), coordinates.end(), 0);
  return std::make_unique<PistonLiner>(options, bodies, coordinates);
}

/// State with the piston moved by `depth` to the thrust side and tilted; elastic bodies also bend a
/// little.
inline Eigen::VectorXd pushed(const PistonLiner& element, bool elastic, double depth, double tilt) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(element.size());
  const int pin = elastic ? kPin : 0;
  y[pin + 1] = depth;
  y[pin + 3] = tilt;
  if (!elastic) return y;
  const rom::ContactGrid skirt =
      make_patches(8, 3, element.options().skirt_bottom, element.options().skirt_top, 1.0);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 3; ++j) {
      const double z = skirt.axis_point.z() + skirt.axial[j];
      y[i * 3 + j] =
          std::cos(skirt.angle[i]) * (depth - tilt * z) + 2e-7 * std::cos(2.0 * skirt.angle[i] + j);
    }
  for (int k = 0; k < 40; ++k) y[kLiner + k] = 3e-7 * std::sin(1.7 * k);
  const ElasticSurface liner{make_patches(8, 5, 0.08, 0.31, element.options().bore_radius), {}};
  y.segment<kFits>(kSkirtFit) = rigid_fit({skirt, {}}) * y.segment<24>(kSkirt);
  y.segment<kFits>(kLinerFit) = rigid_fit(liner) * y.segment<40>(kLiner);
  return y;
}

}  // namespace clatter::film
