// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/sheet_law.hpp"

#include <Eigen/LU>
#include <cmath>

namespace clatter::fe {
namespace {

// Rows of an Elasticity.
constexpr int kPlane[3] = {0, 1, 3}, kShear[2] = {5, 4};  // 11 22 12; 13 23

SheetLaw isotropic(const Material& material) {
  const double nu = material.poisson, E = material.youngs;
  SheetLaw law;
  law.plane << 1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu);
  law.plane *= E / (1.0 - nu * nu);
  law.shear = material.mu() * Eigen::Matrix2d::Identity();
  return law;
}

/// Stresses 33 are 0: the compliance of the plane has those of the solid.
SheetLaw any(const Elasticity& elasticity) {
  const Elasticity compliance = elasticity.inverse();
  SheetLaw law;
  law.plane = Eigen::Matrix3d(compliance(kPlane, kPlane)).inverse();
  law.shear = Eigen::Matrix2d(compliance(kShear, kShear)).inverse();
  return law;
}

/// Stresses in turned directions by those of the material.
Eigen::Matrix3d plane_rotation(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix3d T;
  T << c * c, s * s, -2.0 * c * s, s * s, c * c, 2.0 * c * s, c * s, -c * s, c * c - s * s;
  return T;
}

}  // namespace

bool is_sheet_material(const Material& material) {
  constexpr double kRounding = 1e-12;
  if (material.is_isotropic()) return true;
  const Elasticity& C = *material.elasticity;
  const auto coupled = [&](int i, int j) {
    return std::abs(C(i, j)) > kRounding * std::sqrt(C(i, i) * C(j, j));
  };
  for (const int shear : kShear)
    for (const int other : {0, 1, 2, 3})
      if (coupled(shear, other)) return false;
  return true;
}

SheetLaw sheet_law(const Material& material, double angle) {
  SheetLaw law = material.is_isotropic() ? isotropic(material) : any(*material.elasticity);
  law.expansion = material.expansion(kPlane);
  if (angle == 0.0) return law;
  const Eigen::Matrix3d T = plane_rotation(angle);
  Eigen::Matrix2d R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  law.plane = T * law.plane * T.transpose();
  law.shear = R * law.shear * R.transpose();
  // A strain turns like a stress when its shear is halved.
  law.expansion = T * Eigen::Vector3d(law.expansion.cwiseProduct(Eigen::Vector3d(1.0, 1.0, 0.5)));
  law.expansion(2) *= 2.0;
  return law;
}

}  // namespace clatter::fe
