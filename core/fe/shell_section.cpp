// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/shell_section.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace clatter::fe {
namespace {

constexpr double kDrilling = 1e-4;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// A layer between two distances from the mid-surface.
struct Ply {
  SheetLaw law;
  double bottom, top;  // [m]
};

/// The layers of a sheet of `thickness`.
template <class Visit>
void for_each_layer(const ShellSection& section, double thickness, Visit&& visit) {
  const double scale = thickness / section.thickness;
  double at = -0.5 * thickness;
  for (const ShellLayer& layer : section.layers) {
    const double top = at + scale * layer.thickness;
    visit(layer, at, top);
    at = top;
  }
}

std::vector<Ply> plies_of(const ShellSection& section, double thickness) {
  std::vector<Ply> plies;
  for_each_layer(section, thickness, [&](const ShellLayer& layer, double bottom, double top) {
    plies.push_back({sheet_law(layer.material, layer.angle), bottom, top});
  });
  return plies;
}

/// int z^power dz over a ply.
double moment(const Ply& ply, int power) {
  return (std::pow(ply.top, power + 1) - std::pow(ply.bottom, power + 1)) / (power + 1);
}

Matrix6d stretching_and_bending(const ShellStiffness& s) {
  Matrix6d all;
  all << s.A, s.B, s.B.transpose(), s.D;
  return all;
}

/// q = S gamma with the energy of the shear stresses that balance the bending stresses. Moments
/// that change along direction 1 or 2 by V are carried without a membrane force: the stresses of a
/// unit moment m are Q (b + z d) m, [b; d] the last columns of the inverse of [A B; B D]. The shear
/// stresses are minus their integrals from the inner face.
Eigen::Matrix2d shear_by_energy(const std::vector<Ply>& plies, const ShellStiffness& s) {
  const Matrix6d flexibility = stretching_and_bending(s).inverse();
  const Eigen::Matrix3d b = flexibility.topRightCorner<3, 3>();
  const Eigen::Matrix3d d = flexibility.bottomRightCorner<3, 3>();
  // Gauss points of [-1, 1]: the squares of the stresses are of degree 4.
  const double far = std::sqrt(0.6);
  const std::array<std::array<double, 2>, 3> points = {
      {{-far, 5.0 / 9.0}, {0.0, 8.0 / 9.0}, {far, 5.0 / 9.0}}};
  Eigen::Matrix2d compliance = Eigen::Matrix2d::Zero();
  Eigen::Matrix3d below = Eigen::Matrix3d::Zero();  // integral up to the bottom of the ply
  for (const Ply& ply : plies) {
    const auto integral = [&](double z) {
      return Eigen::Matrix3d(below + ply.law.plane * ((z - ply.bottom) * b +
                                                      0.5 * (z * z - ply.bottom * ply.bottom) * d));
    };
    const Eigen::Matrix2d soft = ply.law.shear.inverse();
    const double half = 0.5 * (ply.top - ply.bottom), middle = 0.5 * (ply.top + ply.bottom);
    for (const auto& [at, weight] : points) {
      const Eigen::Matrix3d f = integral(middle + half * at);
      // Columns: V along 1 with m11, along 2 with m22. Rows: stresses 13, 23.
      Eigen::Matrix2d stress;
      stress << f(0, 0), f(2, 1), f(2, 0), f(1, 1);
      compliance += half * weight * stress.transpose() * soft * stress;
    }
    below = integral(ply.top);
  }
  return compliance.inverse();
}

ShellStiffness laminate(const ShellSection& section, double thickness) {
  ShellStiffness out;
  Vector6d force = Vector6d::Zero();  // N, m per kelvin with all strains held
  const std::vector<Ply> plies = plies_of(section, thickness);
  for (const Ply& ply : plies) {
    out.A += moment(ply, 0) * ply.law.plane;
    out.B += moment(ply, 1) * ply.law.plane;
    out.D += moment(ply, 2) * ply.law.plane;
    const Eigen::Vector3d held = ply.law.plane * ply.law.expansion;
    force.head<3>() += moment(ply, 0) * held;
    force.tail<3>() += moment(ply, 1) * held;
  }
  out.S = shear_by_energy(plies, out);
  const Vector6d free = stretching_and_bending(out).inverse() * force;
  out.stretch = free.head<3>();
  out.curl = free.tail<3>();
  return out;
}

ShellStiffness plate(const ShellSection& section, const Material& material, double thickness) {
  const auto law = [&](const std::optional<Material>& other) {
    return sheet_law(other ? *other : material);
  };
  const SheetLaw membrane = sheet_law(material);
  ShellStiffness out;
  out.A = thickness * membrane.plane;
  out.D = section.bending * thickness * thickness * thickness / 12.0 *
          law(section.bending_material).plane;
  out.S = section.shear * thickness * law(section.shear_material).shear;
  out.stretch = membrane.expansion;
  return out;
}

}  // namespace

bool ShellSection::has_directions(const Material& material) const {
  if (!layers.empty())
    return std::ranges::any_of(layers,
                               [](const auto& one) { return !one.material.is_isotropic(); });
  const auto turns = [](const std::optional<Material>& one) { return one && !one->is_isotropic(); };
  return !material.is_isotropic() || turns(bending_material) || turns(shear_material);
}

ShellMass mass_of(const ShellSection& section, const Material& material, double thickness) {
  ShellMass out;
  out.total = out.area_mass = section.area_mass;
  if (section.layers.empty()) {
    out.total += material.density * thickness;
    out.rotary = material.density * thickness * thickness * thickness / 12.0;
    return out;
  }
  for_each_layer(section, thickness, [&](const ShellLayer& layer, double bottom, double top) {
    const double rho = layer.material.density;
    out.total += rho * (top - bottom);
    out.moment += rho * (top * top - bottom * bottom) / 2.0;
    out.rotary += rho * (top * top * top - bottom * bottom * bottom) / 3.0;
  });
  return out;
}

ShellStiffness stiffness_of(const ShellSection& section, const Material& material,
                            double thickness) {
  ShellStiffness out =
      section.layers.empty() ? plate(section, material, thickness) : laminate(section, thickness);
  out.drilling = kDrilling * out.A(2, 2);
  out.mass = mass_of(section, material, thickness);
  return out;
}

FaceLaws face_laws(const ShellSection& section, const Material& material) {
  if (section.layers.empty()) return {sheet_law(material), sheet_law(material)};
  const ShellLayer &first = section.layers.front(), &last = section.layers.back();
  return {sheet_law(first.material, first.angle), sheet_law(last.material, last.angle)};
}

}  // namespace clatter::fe
