// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/hydraulic/chamber_fluid.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::dynamics {

OilSpec dry_air(double polytropic) {
  OilSpec air;
  air.density = 1.188;
  air.viscosity = 1.82e-5;
  air.polytropic = polytropic;
  return air;
}

ChamberFluid ChamberFluid::oil(const OilSpec& oil) { return {oil, false}; }
ChamberFluid ChamberFluid::air(const OilSpec& air) { return {air, true}; }

double ChamberFluid::modulus(double pressure) const {
  const double k = spec_.polytropic, a = spec_.free_air;
  if (is_air_) return k * pressure;
  const double air = a / k * std::pow(kReferencePressure / pressure, 1.0 / k) / pressure;
  return (1.0 + a) / (1.0 / spec_.modulus + air);
}

double ChamberFluid::log_density(double pressure) const {
  const double k = spec_.polytropic, a = spec_.free_air, p0 = kReferencePressure;
  if (is_air_) return std::log(pressure / p0) / k;
  return ((pressure - p0) / spec_.modulus - a * (std::pow(p0 / pressure, 1.0 / k) - 1.0)) /
         (1.0 + a);
}

double ChamberFluid::density(double pressure) const {
  return spec_.density * std::exp(log_density(pressure));
}

double ChamberFluid::pressure(double density) const {
  const double wanted = std::log(density / spec_.density);
  if (is_air_) return kReferencePressure * std::exp(spec_.polytropic * wanted);
  return oil_pressure(wanted);
}

// ln rho is concave in p, so Newton's method that starts below the root rises to it monotonically
// and ends when rounding stops it. With b = a - (1 + a) ln(rho / rho0) the equation is
//   a (p0/p)^(1/k) = (p - p0) / E0 + b,
// from which p > low = p0 - E0 b, p < low+ + knee, and so a second lower bound.
double ChamberFluid::oil_pressure(double wanted) const {
  const double k = spec_.polytropic, a = spec_.free_air, p0 = kReferencePressure,
               E0 = spec_.modulus;
  const double b = a - (1.0 + a) * wanted;
  const double low = p0 - E0 * b;
  const double knee = std::pow(E0 * a * std::pow(p0, 1.0 / k), k / (k + 1.0));
  const double high = std::max(low, 0.0) + knee;
  double p = std::max(low, p0 * std::pow(a / ((high - p0) / E0 + b), k));
  constexpr int kMost = 200;  // far above what convergence needs, some ten
  for (int i = 0; i < kMost; ++i) {
    const double next = p + modulus(p) * (wanted - log_density(p));
    if (!(next > p)) break;
    p = next;
  }
  return p;
}

// Of oil by the Gauss rule of eight points in intervals of at most one in ln p, where the integrand
// p / rho is smooth: to rounding above 1e-4 bar.
double ChamberFluid::enthalpy(double pressure) const {
  const double k = spec_.polytropic, p0 = kReferencePressure;
  if (is_air_)
    return p0 / spec_.density * k / (k - 1.0) * (std::pow(pressure / p0, 1.0 - 1.0 / k) - 1.0);
  static constexpr double kNode[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                     0.9602898564975363};
  static constexpr double kWeight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                       0.1012285362903763};
  const double span = std::log(pressure / p0);
  const int intervals = std::max(1, static_cast<int>(std::ceil(std::abs(span))));
  const double half = 0.5 * span / intervals;
  double sum = 0.0;
  for (int i = 0; i < intervals; ++i) {
    const double middle = (2 * i + 1) * half;
    for (int j = 0; j < 4; ++j) {
      for (const double node : {-kNode[j], kNode[j]}) {
        const double p = p0 * std::exp(middle + half * node);
        sum += kWeight[j] * half * p / density(p);
      }
    }
  }
  return sum;
}

}  // namespace clatter::dynamics
