// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Contact pressure of rough surfaces over the gap, with its tangent and its stored energy.
#include <vector>

namespace clatter::film {

/// Greenwood-Tripp integral F_n(l) = 1/sqrt(2 pi) * integral over s > l of (s - l)^n exp(-s^2/2).
///
/// `twice_n` = 2 n: odd, 1 to 7. Any real l. Trapezoidal rule in u = sqrt(s - l), where the
/// integrand is analytic and even: the error falls exponentially (about 1e-14 relative). dF_n/dl =
/// -n F_{n-1}. Source: Greenwood and Tripp 1970; closed form for l > 0 in Bessel functions:
/// `five_halves_bessel`.
double greenwood_tripp(int twice_n, double l);

/// F_5/2(l) = e^{-l^2/4} l^{3/2} / (8 sqrt pi) [(2 l^2 + 3) K_{3/4}(l^2/4) - (2 l^2 + 5)
/// K_{1/4}(l^2/4)], l > 0.
double five_halves_bessel(double l);

/// K of eq. (11) of the paper, (16 sqrt(2) pi / 15) (sigma_s beta eta)^2 sqrt(sigma_s / beta), to
/// be used with F_5/2: the printed 16 sqrt(2 pi) / 15 and F_1/2 are misprints by the convention of
/// Greenwood and Tripp 1970.
///
/// @param density eta, summits per area [1/m2]. @param radius beta of a summit [m]. @param
/// roughness sigma_s, standard deviation of the summit heights [m].
double contact_factor(double density, double radius, double roughness);

struct AsperityOptions {
  enum class Law { kFit, kExact };
  Law law = Law::kFit;        // fit 4.4086e-5 (4 - h/sigma)^6.804 of eq. (12), or the exact F_5/2
  double factor = 1e-3;       // K of eq. (12) [1], 0.0003 to 0.003, or contact_factor()
  double modulus = 53.3e9;    // E* [Pa]
  double roughness = 0.5e-6;  // sigma_s, standard deviation of the summit heights [m]
  bool from_summits = false;  // K is that of eq. (11)
};

/// p_a(h) = K E* F(h / sigma_s), eq. (12) of the paper, or (11) with K = contact_factor();
/// Greenwood and Tripp 1970. Elastic: damping is in contact_damping.hpp.
class Asperity {
 public:
  struct Contact {
    double pressure = 0.0;  // [Pa]
    double slope = 0.0;     // dp/dh [Pa/m], <= 0
    double energy = 0.0;    // integral of p from h to infinity [J/m2]
  };
  /// InputError unless all three numbers are positive.
  explicit Asperity(const AsperityOptions& options);

  /// At gap `h` [m]; negative gaps are within the law (finite, for trial states of a solver).
  Contact at(double h) const;
  /// Largest gap with contact [m].
  double reach() const;

 private:
  Contact fit(double ratio) const;
  Contact exact(double ratio) const;
  AsperityOptions options_;
  double scale_;  // K E* [Pa]
  // Exact law: G = integral of F_5/2 and two derivatives at equidistant ratios; pressure and
  // tangent are the derivatives of one quintic interpolant of G, so force and energy agree to
  // rounding.
  std::vector<double> table_;
};

}  // namespace clatter::film
