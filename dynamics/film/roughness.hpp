// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// From the gap h to the thicknesses in the Reynolds equation.
#include <Eigen/Core>

#include "dynamics/film/reynolds.hpp"

namespace clatter::film {

/// Roughness of the two walls.
struct RoughnessOptions {
  double piston = 0.0;        // rms height of the wall that carries the grid [m]
  double liner = 0.0;         // rms height of the wall that slides past [m]
  double peklenik = 1.0;      // pattern: correlation length along the axis over that around it [1]
  bool flow_factors = false;  // Patir-Cheng factors; off: only the mean gap h_T replaces h
  bool stress_factors = false;  // their phi_fs and phi_fp of the friction; with flow_factors only
};

/// What shear needs of the thicknesses, cell by cell, n each: effective 1/h [1/m] and the thickness
/// l of the pressure gradient's part, l/2 dp/dz [m], with their slopes by the gap h.
struct ShearThickness {
  Eigen::ArrayXd inverse, inverse_slope;
  Eigen::ArrayXd lever, lever_slope;
};

/// Thicknesses of a film between rough walls, averaged after Patir and Cheng 1978, 1979:
///
///   s = h_T,   g^3 = phi h^3,   c = h_T - sigma (V_p - V_l) Phi_s,   sigma^2 = sigma_p^2 +
///   sigma_l^2, V = sigma_i^2 / sigma^2.
///
/// The sign of c holds because the grid moves with the piston: oil in the piston's valleys is not
/// transported. Below `lowest_ratio` times sigma, where the fit of a factor ends, g and c continue
/// in proportion to h_T: they stay positive and monotone into contact. sigma = 0: all thicknesses
/// are h, which must then be positive.
class RoughFilm {
 public:
  /// InputError for roughness below 0, a pattern that is not in the tables, or stress factors
  /// without flow factors.
  explicit RoughFilm(const RoughnessOptions& options);

  double sigma() const { return sigma_; }
  /// Lowest admissible gap [m]: 0 for smooth walls (not admissible itself), -4 sigma for rough
  /// ones.
  double lowest_gap() const { return -4.0 * sigma_; }
  /// Fills `film` for the gaps `h` [m], n.
  void thicknesses(const Eigen::ArrayXd& h, FilmCells& film) const;
  /// Effective 1/h of the shear stress: 1 / h_T, with flow factors phi_f / h, with stress factors
  /// (phi_f + phi_fs) / h; l = h_T, with stress factors V_p phi_fp h + V_l (2 h_T - phi_fp h).
  ///
  /// phi_fs and phi_fp are those of a smooth wall opposite a rough one, which feels all of the
  /// tangential force. The rough wall gets the reaction, part of it as pressure on its asperities,
  /// which the shear on it alone (phi_f - phi_fs) lacks. So both are exact in the model when one
  /// wall is smooth, and weighted by the variances V when none is.
  void shear(const Eigen::ArrayXd& h, const FilmCells& film, ShearThickness& shear) const;

 private:
  void apply_factors(double h, int cell, FilmCells& film) const;
  void add_stress_factors(double h, int cell, ShearThickness& shear) const;
  RoughnessOptions options_;
  double sigma_ = 0.0;
  double share_difference_ = 0.0;  // V_p - V_l
};

}  // namespace clatter::film
