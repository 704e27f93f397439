// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/shell_section.hpp"

namespace clatter::fe {

ShellStiffness stiffness_of(const ShellSection& section, const Material& material,
                            double thickness) {
  constexpr double kDrilling = 1e-4;
  const double nu = material.poisson, E = material.youngs, G = E / (2.0 * (1.0 + nu));
  Eigen::Matrix3d plane_stress;
  plane_stress << 1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu);
  plane_stress *= E / (1.0 - nu * nu);
  const double inertia = thickness * thickness * thickness / 12.0;
  ShellStiffness out;
  out.A = thickness * plane_stress;
  out.D = section.bending * inertia * plane_stress;
  out.S = section.shear * G * thickness * Eigen::Matrix2d::Identity();
  out.drilling = kDrilling * G * thickness;
  out.mass = material.density * thickness + section.area_mass;
  out.area_mass = section.area_mass;
  out.rotary = material.density * inertia;
  return out;
}

}  // namespace clatter::fe
