// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Linear elastic materials: isotropic, orthotropic, anisotropic; thermal expansion, conductivity.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/fe/axes.hpp"
#include "core/keys/keys.hpp"

namespace clatter::fe {

/// Stresses 11 22 33 12 23 31 from strains in the same order, with engineering shear strains
/// (gamma = 2 eps) [Pa].
using Elasticity = Eigen::Matrix<double, 6, 6>;
using Voigt = Eigen::Matrix<double, 6, 1>;

/// Integration of the stiffness (element.hpp lists the points).
enum class Integration { kFull, kReduced, kIncompatible, kFine };

/// The choice for each cell type with alternatives.
struct IntegrationChoice {
  Integration hex8 = Integration::kIncompatible;
  Integration hex20 = Integration::kFull;
  Integration wedge6 = Integration::kFull;
  Integration wedge15 = Integration::kFull;
};

/// Consistent mass, or HRZ lumping: its diagonal scaled to the same total (lump_hrz). kNodes, of
/// shells: consistent, by the shape functions of the nodes alone, whatever else moves in a cell;
/// it makes forces of accelerations.
enum class MassForm { kConsistent, kHrz, kNodes };

/// A linear elastic material. Isotropic: sigma = lambda tr(eps) I + 2 mu eps.
struct Material {
  double youngs = 0.0;                                  // E [Pa]; isotropic only
  double poisson = 0.0;                                 // nu [1]; isotropic only
  double density = 0.0;                                 // rho [kg/m3]
  double loss_factor = 0.0;                             // eta of complex moduli (1 + i eta)
  std::optional<Elasticity> elasticity = std::nullopt;  // of any other material, in its axes [Pa]
  Voigt expansion = Voigt::Zero();          // thermal strain per kelvin in its axes [1/K]
  std::optional<Axes> axes = std::nullopt;  // absent: the global frame
  IntegrationChoice integration = {};
  Eigen::Vector3d conductivity = Eigen::Vector3d::Zero();  // along its axes [W/(m K)]; 0: not given

  /// First Lame constant E nu / ((1 + nu) (1 - 2 nu)) [Pa].
  double lambda() const { return youngs * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)); }
  /// Shear modulus E / (2 (1 + nu)) [Pa].
  double mu() const { return 0.5 * youngs / (1.0 + poisson); }
  bool is_isotropic() const { return !elasticity; }
  /// All moduli times `factor`.
  Material scaled(double factor) const;
  /// The same where positions are counted from `origin` [m].
  Material seen_from(const Eigen::Vector3d& origin) const;

  /// Elasticity and thermal strain per kelvin in the global frame at position `x` [m].
  Elasticity elasticity_at(const Eigen::Vector3d& x) const;
  Voigt expansion_at(const Eigen::Vector3d& x) const;
  /// Conductivity in the global frame at position `x` [m]: heat flux = -k grad T [W/(m K)].
  Eigen::Matrix3d conductivity_at(const Eigen::Vector3d& x) const;
};

/// A table [material.NAME], and the material that follows from it.
struct MaterialTable {
  Material material;            // without axes
  std::vector<double> E, G, C;  // [Pa]
  bool E_in_gpa = false, G_in_gpa = false, C_in_gpa = false;
  std::vector<double> nu, expansion, conductivity;
  std::string system;  // name of the axes; empty: the global frame
};

/// Sets the material from the constants. InputError unless the elasticity is positive definite
/// (isotropic: E > 0, -1 < nu < 0.5): otherwise the elastic energy has no lower bound.
void finish(const keys::Source& source, MaterialTable& table);

/// The keys, whose constants finish() checks together.
const keys::Keys<MaterialTable>& material_keys();

}  // namespace clatter::fe
