// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Viscosity of the oil over temperature, pressure and shear rate.
#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "dynamics/film/flow_factors.hpp"
#include "dynamics/film/reynolds.hpp"

namespace clatter::film {

/// mu = a exp(b / (T - c)) (Vogel 1921).
struct VogelLaw {
  double a = 0.0;  // [Pa s] > 0
  double b = 0.0;  // [K]
  double c = 0.0;  // [K], below every temperature
};

/// log10 log10(nu + 0.7) = A - B log10 T with nu in mm2/s (Walther 1931; ASTM D341), through two
/// points; mu = rho nu with a constant density.
struct WaltherLaw {
  std::array<double, 2> temperature{};  // [K], ascending
  std::array<double, 2> kinematic{};    // [m2/s], descending, above 0.31 mm2/s
  double density = 0.0;                 // [kg/m3]
};

/// mu = mu_0 (r + (1 - r) / (1 + (|U| / (h_T g))^m)) (Cross 1965), of oils with polymers.
struct CrossLaw {
  double rate = 0.0;      // g, shear rate at which half of the polymers' part is left [1/s]
  double ratio = 0.0;     // r, second Newtonian viscosity over the first [1], 0 to 1
  double exponent = 1.0;  // m [1]
};

struct ViscosityOptions {
  /// One of the two, or none: `PistonLinerOptions::viscosity` at every temperature.
  std::optional<VogelLaw> vogel;
  std::optional<WaltherLaw> walther;
  std::vector<double> height;         // engine z, ascending [m]; empty: one temperature
  std::vector<double> temperature;    // of the oil film there [K]
  double pressure_coefficient = 0.0;  // alpha of mu exp(alpha p) (Barus 1893) [1/Pa]; 0: none
  std::optional<CrossLaw> cross;

  bool by_temperature() const { return vogel || walther; }
};

double viscosity_of(const VogelLaw& law, double temperature);    // [Pa s] at [K]
double viscosity_of(const WaltherLaw& law, double temperature);  // [Pa s] at [K]
/// mu / mu_0 at a shear rate [1/s] and its derivative by the logarithm of the rate.
ValueSlope shear_thinning(const CrossLaw& law, double rate);

/// Viscosity in the cells of a pad.
///
/// mu = mu_0(T(z)) s(|U| / h_T) exp(alpha p), all at the state of the stage itself:
///
/// - The ratio of temperature and shear to the reference viscosity is taken into the thicknesses:
///   g^3 is divided by it and 1/h multiplied, with their derivatives by the gap. A face has the
///   mean of its cells as for the gap. The height is the ideal stroke's.
/// - exp(-alpha p) grad p = grad P with P = (1 - exp(-alpha p)) / alpha (Grubin 1949). So P obeys
///   the Reynolds equation with mu at p = 0, and P = 0 where p = 0: the film is solved for P and
///   p = -ln(1 - alpha P) / alpha follows. The oil's compression is P / B: its modulus is B at p =
///   0 and grows as exp(alpha p), as that of oils does.
///
/// Shear thinning is that of simple shear at |U| / h_T for flow in all directions; heat made by the
/// shear does not change the temperature.
class Viscosity {
 public:
  /// `constant` [Pa s] holds without a law over temperature. InputError when a law gives no
  /// positive finite viscosity at a temperature of the options.
  Viscosity(const ViscosityOptions& options, double constant);

  /// The viscosity that Reynolds and Friction get [Pa s].
  double reference() const { return reference_; }
  /// Without pressure and shear at engine z `height` [m], [Pa s].
  double at_height(double height) const;
  /// True when the ratio differs from cell to cell or in time.
  bool varies() const { return varies_ || options_.cross.has_value(); }
  /// Ratio of temperature and shear to the reference, n, and its slope by the gap [1/m]; the pad's
  /// z = 0 is at `height` [m], `speed` is |U| or U [m/s].
  void ratio(const PadGrid& grid, double height, double speed, const FilmCells& film,
             Eigen::ArrayXd& value, Eigen::ArrayXd& slope) const;

  double pressure_coefficient() const { return options_.pressure_coefficient; }
  /// P [Pa] of a pressure p [Pa].
  double reduced(double pressure) const;
  /// p [Pa] and dp/dP = exp(alpha p) of P [Pa], n; false where alpha P >= 1, which no pressure has.
  bool pressure(const Eigen::ArrayXd& reduced, Eigen::ArrayXd& value, Eigen::ArrayXd& slope) const;

 private:
  double at_temperature(double temperature) const;
  double temperature_at(double height) const;
  ViscosityOptions options_;
  double constant_, reference_;
  bool varies_ = false;
};

/// Takes the viscosity ratio into the thicknesses that conduct.
void divide_conductance(const Eigen::ArrayXd& ratio, const Eigen::ArrayXd& slope, FilmCells& film);
/// Takes it into the effective 1/h of the shear.
void multiply_shear(const Eigen::ArrayXd& ratio, const Eigen::ArrayXd& slope,
                    Eigen::ArrayXd& inverse, Eigen::ArrayXd& inverse_slope);

}  // namespace clatter::film
