// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/shaft_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

namespace clatter::dynamics {

double ShaftSection::area() const {
  return std::numbers::pi / 4.0 * (outer * outer - inner * inner);
}

double ShaftSection::second_moment() const {
  return std::numbers::pi / 64.0 * (std::pow(outer, 4) - std::pow(inner, 4));
}

double ShaftSection::shear_factor(const ShaftMaterial& material) const {
  if (material.shear_factor > 0.0) return material.shear_factor;
  const double nu = material.youngs / (2.0 * material.shear) - 1.0, m = inner / outer;
  const double both = (1.0 + m * m) * (1.0 + m * m);
  return 6.0 * (1.0 + nu) * both / ((7.0 + 6.0 * nu) * both + (20.0 + 12.0 * nu) * m * m);
}

ShaftSections::ShaftSections(std::vector<ShaftSection> sections, const ShaftMaterial& material)
    : sections_(std::move(sections)), material_(material) {
  constexpr double kSame = 1e-9;  // [m]
  for (size_t i = 1; i < sections_.size(); ++i) {
    const double end = sections_[i - 1].to, next = sections_[i].from;
    if (std::abs(next - end) > kSame)
      throw InputError(
          fmt::format("section {} from {:g} mm: the one before it ends at {:g} mm, "
                      "expected sections one after the other",
                      i + 1, next / kMilli, end / kMilli));
  }
}

template <class Visit>
void ShaftSections::visit(double from, double to, const Visit& visit) const {
  for (const ShaftSection& section : sections_) {
    const double low = std::max(from, section.from), high = std::min(to, section.to);
    if (high > low) visit(section, low, high);
  }
}

ShaftPiece joined(const ShaftPiece& a, const ShaftPiece& b) {
  ShaftPiece both;
  both.inertia.mass = a.inertia.mass + b.inertia.mass;
  both.centre = a.centre;
  if (both.inertia.mass > 0.0)
    both.centre = (a.inertia.mass * a.centre + b.inertia.mass * b.centre) / both.inertia.mass;
  for (const ShaftPiece* one : {&a, &b}) {
    const double arm = one->centre - both.centre;
    both.inertia.polar += one->inertia.polar;
    both.inertia.diametral += one->inertia.diametral + one->inertia.mass * arm * arm;
  }
  return both;
}

ShaftPiece ShaftSections::piece(double from, double to) const {
  ShaftPiece all;
  all.centre = 0.5 * (from + to);
  visit(from, to, [&](const ShaftSection& section, double low, double high) {
    const double length = high - low;
    ShaftPiece one;
    one.centre = 0.5 * (low + high);
    one.inertia.mass = material_.density * section.area() * length;
    const double about_diameter = material_.density * section.second_moment() * length;
    one.inertia.polar = 2.0 * about_diameter;
    one.inertia.diametral = about_diameter + one.inertia.mass * length * length / 12.0;
    all = joined(all, one);
  });
  return all;
}

ShaftFlexibility ShaftSections::flexibility(double from, double to) const {
  ShaftFlexibility sum;
  sum.bending.setZero();
  visit(from, to, [&](const ShaftSection& section, double low, double high) {
    // Distances from the loaded end: the bending moment there is force * s + moment.
    const double s0 = to - high, s1 = to - low, length = high - low;
    const double bending = material_.youngs * section.second_moment();
    const double shear = section.shear_factor(material_) * material_.shear * section.area();
    sum.bending(0, 0) += (s1 * s1 * s1 - s0 * s0 * s0) / (3.0 * bending) + length / shear;
    sum.bending(0, 1) += (s1 * s1 - s0 * s0) / (2.0 * bending);
    sum.bending(1, 1) += length / bending;
    sum.torsion += length / (2.0 * material_.shear * section.second_moment());
    sum.axial += length / (material_.youngs * section.area());
  });
  sum.bending(1, 0) = sum.bending(0, 1);
  return sum;
}

}  // namespace clatter::dynamics
