#pragma once
// Linear elastic, isotropic materials.
#include <string>

#include "core/config.hpp"

namespace clatter::assembly {

/// An isotropic elastic material. sigma = lambda tr(eps) I + 2 mu eps.
struct Material {
  double youngs = 0.0;   // E [Pa]
  double poisson = 0.0;  // nu [1]
  double density = 0.0;  // rho [kg/m3]

  /// First Lame constant E nu / ((1 + nu) (1 - 2 nu)) [Pa].
  double lambda() const { return youngs * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)); }
  /// Shear modulus E / (2 (1 + nu)) [Pa].
  double mu() const { return 0.5 * youngs / (1.0 + poisson); }
};

/// Reads `E` [Pa] or `E_gpa` [GPa], `nu`, `rho` [kg/m3]. InputError unless E > 0, rho > 0 and
/// -1 < nu < 0.5: outside, the elastic energy has no lower bound or the volume cannot change.
Material read_material(const Config& table);

}  // namespace clatter::assembly
