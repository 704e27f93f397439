// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Axial shear force on the piston, cell by cell, with the coefficients of its exact derivative.
#include <Eigen/Core>

#include "dynamics/film/grid.hpp"
#include "dynamics/film/reynolds.hpp"
#include "dynamics/film/roughness.hpp"

namespace clatter::film {

struct FrictionOptions {
  double coefficient = 0.1;      // mu_a of the asperity contact [1]
  double reversal_speed = 1e-2;  // u_0 of the smoothed sign U / sqrt(U^2 + u_0^2) [m/s]
};

/// Film pressure [Pa] and where oil thickens with it, n each.
struct FilmPressure {
  const Eigen::ArrayXd& value;
  /// mu over that at p = 0; null: 1. `coefficient` is its logarithmic slope by p [1/Pa].
  const Eigen::ArrayXd* thickening = nullptr;
  double coefficient = 0.0;
};

/// Axial force of each cell on the piston that slides at U along z past a liner at rest:
///
///   f = -mu U a (1/h) A + (l/2) dp/dz A - mu_a p_c A U / sqrt(U^2 + u_0^2)
///
/// a is the sheared fraction of a cell's area (Reynolds::sheared), 1 when full. The film's part is
/// the reaction to the shear on the liner wall, mu U/h - (h/2) dp/dz (Couette and Poiseuille); the
/// pressure on the slope of the skirt is contained in it, because the liner wall is straight. 1/h
/// and l are those of rough walls, RoughFilm::shear().
/// Derivative: df = gap_slope dh + rate_slope dh' + film_slope dx + speed_slope dU, where x is p in
/// a full cell and theta in a cavitated one. Summed along one axial column of cells both are exact.
class Friction {
 public:
  Friction(const FrictionOptions& options, int cells);

  /// Sets all arrays to zero before the contributions of a new state, which are limited to the
  /// part of the pad inside the liner; null: all of it.
  void clear(const Cover* cover = nullptr);
  /// Adds film shear; `viscosity` [Pa s] at p = 0, `speed` U [m/s].
  void add_film(const Reynolds& solution, const FilmPressure& pressure, const ShearThickness& shear,
                double viscosity, double speed);
  /// Adds contact friction; `contact` p_c [Pa], `contact_slope` dp_c/dh, n, and `rate_slope`
  /// dp_c/dh' [Pa s/m], n, or none for an elastic contact.
  void add_contact(const PadGrid& grid, const Eigen::ArrayXd& contact,
                   const Eigen::ArrayXd& contact_slope, const Eigen::ArrayXd& rate_slope,
                   double speed);

  const Eigen::ArrayXd& force() const { return force_; }              // [N]
  const Eigen::ArrayXd& gap_slope() const { return gap_slope_; }      // [N/m]
  const Eigen::ArrayXd& rate_slope() const { return rate_slope_; }    // [N s/m]; empty: elastic
  const Eigen::ArrayXd& film_slope() const { return film_slope_; }    // [N/Pa] or [N]
  const Eigen::ArrayXd& speed_slope() const { return speed_slope_; }  // [N s/m]
  /// By the height of the pad past the ends of the liner [N/m].
  const Eigen::ArrayXd& height_slope() const { return height_slope_; }

 private:
  FrictionOptions options_;
  Eigen::ArrayXd force_, gap_slope_, rate_slope_, film_slope_, speed_slope_, height_slope_;
  Eigen::ArrayXd share_, share_slope_;  // covered fraction of the cells and its derivative [1/m]
};

}  // namespace clatter::film
