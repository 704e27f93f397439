// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/asperity.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace clatter::film {
namespace {

constexpr double kFitFactor = 4.4086e-5, kFitPower = 6.804, kFitEnd = 4.0;
// The table of the exact law: F_5/2(8) is 1e-17 of F_5/2(0), where it ends.
constexpr double kTableBegin = -8.0, kTableEnd = 8.0, kTableStep = 1.0 / 32.0;
constexpr int kTableNodes = 513;

}  // namespace

double greenwood_tripp(int twice_n, double l) {
  const double reach = std::sqrt(std::max(0.0, -l) + 9.5);
  const double step = reach / 200.0;
  double sum = 0.0;
  for (int i = 1; i <= 200; ++i) {
    const double u = i * step, s = u * u + l;
    sum += std::pow(u, twice_n + 1) * std::exp(-0.5 * s * s);
  }
  return 2.0 * step * sum / std::sqrt(2.0 * std::numbers::pi);
}

double five_halves_bessel(double l) {
  const double x = 0.25 * l * l;
  return std::exp(-x) * std::pow(l, 1.5) / (8.0 * std::sqrt(std::numbers::pi)) *
         ((2.0 * l * l + 3.0) * std::cyl_bessel_k(0.75, x) -
          (2.0 * l * l + 5.0) * std::cyl_bessel_k(0.25, x));
}

double contact_factor(double density, double radius, double roughness) {
  const double crowding = density * radius * roughness;
  return 16.0 * std::numbers::sqrt2 * std::numbers::pi / 15.0 * crowding * crowding *
         std::sqrt(roughness / radius);
}

Asperity::Asperity(const AsperityOptions& options)
    : options_(options), scale_(options.factor * options.modulus) {
  if (!(options.factor > 0.0) || !(options.modulus > 0.0) || !(options.roughness > 0.0))
    throw InputError(
        fmt::format("asperity: found factor {}, modulus {} Pa, roughness {} m, expected all > 0",
                    options.factor, options.modulus, options.roughness));
  if (options.law == AsperityOptions::Law::kFit) return;
  table_.reserve(3 * kTableNodes);
  for (int i = 0; i < kTableNodes; ++i) {
    const double ratio = kTableBegin + i * kTableStep;
    table_.push_back(greenwood_tripp(7, ratio) / 3.5);
    table_.push_back(-greenwood_tripp(5, ratio));
    table_.push_back(2.5 * greenwood_tripp(3, ratio));
  }
}

double Asperity::reach() const {
  return options_.roughness * (options_.law == AsperityOptions::Law::kFit ? kFitEnd : kTableEnd);
}

Asperity::Contact Asperity::at(double h) const {
  if (h >= reach()) return {};
  const double ratio = h / options_.roughness;
  Contact contact = options_.law == AsperityOptions::Law::kFit ? fit(ratio) : exact(ratio);
  contact.pressure *= scale_;
  contact.slope *= scale_ / options_.roughness;
  contact.energy *= scale_ * options_.roughness;
  return contact;
}

Asperity::Contact Asperity::fit(double ratio) const {
  const double depth = kFitEnd - ratio;
  const double value = kFitFactor * std::pow(depth, kFitPower);
  return {value, -kFitPower * value / depth, value * depth / (kFitPower + 1.0)};
}

Asperity::Contact Asperity::exact(double ratio) const {
  if (ratio < kTableBegin)
    return {greenwood_tripp(5, ratio), -2.5 * greenwood_tripp(3, ratio),
            greenwood_tripp(7, ratio) / 3.5};
  const int node = std::min(static_cast<int>((ratio - kTableBegin) / kTableStep), kTableNodes - 2);
  const double t = (ratio - kTableBegin) / kTableStep - node;
  const double* a = table_.data() + 3 * node;
  const double* b = a + 3;
  // Quintic Hermite on [0, 1]: value, slope and curvature at both ends.
  const double c0 = a[0], c1 = a[1] * kTableStep, c2 = 0.5 * a[2] * kTableStep * kTableStep;
  const double value = b[0] - c0 - c1 - c2;
  const double slope = b[1] * kTableStep - c1 - 2.0 * c2;
  const double curve = b[2] * kTableStep * kTableStep - 2.0 * c2;
  const double c3 = 10.0 * value - 4.0 * slope + 0.5 * curve;
  const double c4 = -15.0 * value + 7.0 * slope - curve;
  const double c5 = 6.0 * value - 3.0 * slope + 0.5 * curve;
  const double g = c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * c5))));
  const double dg = c1 + t * (2.0 * c2 + t * (3.0 * c3 + t * (4.0 * c4 + t * 5.0 * c5)));
  const double ddg = 2.0 * c2 + t * (6.0 * c3 + t * (12.0 * c4 + t * 20.0 * c5));
  return {-dg / kTableStep, -ddg / (kTableStep * kTableStep), g};
}

}  // namespace clatter::film
