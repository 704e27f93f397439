// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/given/rising_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::dynamics {
namespace {

const std::vector<double>& checked(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 2 || y.size() != x.size())
    throw InputError(
        fmt::format("found {} rows, expected at least 2", std::min(x.size(), y.size())));
  if (x[0] != 0.0 || y[0] != 0.0)
    throw InputError(fmt::format("found {:g} at {:g} first, expected 0 at 0", y[0], x[0]));
  for (size_t k = 1; k < x.size(); ++k) {
    if (!(x[k] > x[k - 1]))
      throw InputError(
          fmt::format("found {:g} after {:g}, expected an ascending first column", x[k], x[k - 1]));
    if (!(y[k] >= y[k - 1]))
      throw InputError(fmt::format("found {:g} after {:g}, expected values that do not descend",
                                   y[k], y[k - 1]));
  }
  return x;
}

}  // namespace

RisingTable::RisingTable(std::vector<double> x, std::vector<double> y)
    : x_(checked(x, y)),
      inside_(Spline::Kind::kMonotoneCubic, std::move(x), y),
      integral_(x_.size(), 0.0),
      last_(y.back()),
      last_slope_(inside_.slope(x_.back())) {
  for (size_t k = 1; k < x_.size(); ++k) integral_[k] = integral_[k - 1] + part(k - 1, x_[k]);
}

double RisingTable::value(double x) const {
  return x > x_.back() ? last_ + last_slope_ * (x - x_.back()) : inside_(x);
}

double RisingTable::slope(double x) const { return x > x_.back() ? last_slope_ : inside_.slope(x); }

// From point k to x in the interval after it; Simpson's rule is exact for a cubic.
double RisingTable::part(size_t k, double x) const {
  return (x - x_[k]) / 6.0 * (inside_(x_[k]) + 4.0 * inside_(0.5 * (x_[k] + x)) + inside_(x));
}

double RisingTable::integral(double x) const {
  if (x > x_.back()) {
    const double beyond = x - x_.back();
    return integral_.back() + beyond * (last_ + 0.5 * last_slope_ * beyond);
  }
  const auto after = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
  const auto k = static_cast<size_t>(after - x_.begin()) - 1;
  return integral_[k] + part(k, x);
}

}  // namespace clatter::dynamics
