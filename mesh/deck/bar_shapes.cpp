// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/bar_shapes.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace clatter::mesh::deck {
namespace {

double cube(double x) { return x * x * x; }

}  // namespace

BeamSection ring_section(double outer_radius, double inner_radius) {
  constexpr double kPi = std::numbers::pi;
  const double o2 = outer_radius * outer_radius, i2 = inner_radius * inner_radius;
  const double I = kPi / 4.0 * (o2 * o2 - i2 * i2);
  return {.area = kPi * (o2 - i2), .I1 = I, .I2 = I, .J = 2.0 * I};
}

BeamSection rectangle_section(double along_y, double along_z) {
  const double a = std::max(along_y, along_z), b = std::min(along_y, along_z), q = b / a;
  return {.area = along_y * along_z,
          .I1 = along_z * cube(along_y) / 12.0,
          .I2 = along_y * cube(along_z) / 12.0,
          .J = a * cube(b) * (1.0 / 3.0 - 0.21 * q * (1.0 - q * q * q * q / 12.0))};
}

BeamSection box_section(double along_y, double along_z, double wall_y, double wall_z) {
  const double y = along_y - 2.0 * wall_y, z = along_z - 2.0 * wall_z;  // inside
  const double mid_y = along_y - wall_y, mid_z = along_z - wall_z;
  return {.area = along_y * along_z - y * z,
          .I1 = (along_z * cube(along_y) - z * cube(y)) / 12.0,
          .I2 = (along_y * cube(along_z) - y * cube(z)) / 12.0,
          .J = 2.0 * mid_y * mid_y * mid_z * mid_z / (mid_z / wall_y + mid_y / wall_z)};
}

BeamSection i_section(const IShape& shape) {
  const double web = shape.height - shape.t_below - shape.t_above;
  // Width along z, height along y, centre along y.
  const std::array<std::array<double, 3>, 3> parts = {
      {{shape.below, shape.t_below, 0.5 * shape.t_below},
       {shape.web, web, shape.t_below + 0.5 * web},
       {shape.above, shape.t_above, shape.height - 0.5 * shape.t_above}}};
  BeamSection section;
  double first = 0.0;
  for (const auto& [width, height, at] : parts) {
    section.area += width * height;
    first += width * height * at;
    section.I2 += height * cube(width) / 12.0;
    section.J += std::max(width, height) * cube(std::min(width, height)) / 3.0;
  }
  const double centre = first / section.area;
  for (const auto& [width, height, at] : parts)
    section.I1 += width * cube(height) / 12.0 + width * height * (at - centre) * (at - centre);
  return section;
}

}  // namespace clatter::mesh::deck
