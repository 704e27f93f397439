// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/flow_factors.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace clatter::film {
namespace {

struct PressureRow {
  double peklenik, c, r;
};
constexpr std::array<PressureRow, 7> kPressureTable{{{1.0 / 9.0, 1.48, 0.42},
                                                     {1.0 / 6.0, 1.38, 0.42},
                                                     {1.0 / 3.0, 1.18, 0.42},
                                                     {1.0, 0.90, 0.56},
                                                     {3.0, 0.225, 1.5},
                                                     {6.0, 0.520, 1.5},
                                                     {9.0, 0.870, 1.5}}};

struct ShearRow {
  double peklenik, a1, alpha1, alpha2, alpha3, a2;
};
constexpr std::array<ShearRow, 7> kShearTable{{{1.0 / 9.0, 2.046, 1.12, 0.78, 0.03, 1.856},
                                               {1.0 / 6.0, 1.962, 1.08, 0.77, 0.03, 1.754},
                                               {1.0 / 3.0, 1.858, 1.01, 0.76, 0.03, 1.561},
                                               {1.0, 1.899, 0.98, 0.92, 0.05, 1.126},
                                               {3.0, 1.560, 0.85, 1.13, 0.08, 0.556},
                                               {6.0, 1.290, 0.62, 1.09, 0.08, 0.388},
                                               {9.0, 1.011, 0.54, 1.07, 0.08, 0.295}}};

struct StressRow {
  double peklenik, a3, alpha4, alpha5, alpha6, d, s, lowest;
};
constexpr std::array<StressRow, 7> kStressTable{
    {{1.0 / 9.0, 14.1, 2.45, 2.30, 0.10, 1.51, 0.52, 1.0},
     {1.0 / 6.0, 13.4, 2.42, 2.30, 0.10, 1.51, 0.54, 1.0},
     {1.0 / 3.0, 12.3, 2.32, 2.30, 0.10, 1.47, 0.58, 1.0},
     {1.0, 11.1, 2.31, 2.38, 0.11, 1.40, 0.66, 0.75},
     {3.0, 9.8, 2.25, 2.80, 0.18, 0.98, 0.79, 0.5},
     {6.0, 10.1, 2.25, 2.90, 0.18, 0.97, 0.91, 0.5},
     {9.0, 8.7, 2.15, 2.97, 0.18, 0.73, 0.91, 0.5}}};
constexpr double kStressBegin = 0.5, kStressEnd = 7.0;

template <typename Table>
[[noreturn]] void refuse(const Table& table, double peklenik, const char* what) {
  std::string known;
  for (const auto& row : table)
    known += fmt::format("{}{:.4g}", known.empty() ? "" : ", ", row.peklenik);
  throw InputError(
      fmt::format("peklenik: no {} for {}, expected one of {}", what, peklenik, known));
}

template <typename Table>
const auto& find_row(const Table& table, double peklenik, const char* what) {
  for (const auto& row : table)
    if (std::abs(row.peklenik - peklenik) < 1e-3 * row.peklenik) return row;
  refuse(table, peklenik, what);
}

double lowest_of_row(double peklenik) { return peklenik < 1.0 ? 1.0 : 0.5; }

// Even moments of the density 35/32 (1 - t^2)^3 on (-1, 1): m_k = m_{k-1} (2k - 1) / (2k + 7).
ValueSlope inverse_gap_series(double z) {
  double moment = 1.0, power = 1.0 / z;
  ValueSlope sum;
  for (int k = 0; k < 14; ++k) {
    sum.value += moment * power;
    sum.slope -= (2 * k + 1) * moment * power / z;
    moment *= (2.0 * k + 1.0) / (2.0 * k + 9.0);
    power /= z * z;
  }
  return sum;
}

}  // namespace

ValueSlope mean_gap(double h, double sigma) {
  // erfc keeps its relative accuracy far below zero, where 1 + erf cancels.
  const double ratio = h / sigma;
  const double free_share = 0.5 * std::erfc(-ratio / std::numbers::sqrt2);
  const double density = std::exp(-0.5 * ratio * ratio) / std::sqrt(2.0 * std::numbers::pi);
  return {h * free_share + sigma * density, free_share};
}

double lowest_ratio(double peklenik) {
  return lowest_of_row(find_row(kPressureTable, peklenik, "flow factors").peklenik);
}

ValueSlope pressure_flow_factor(double ratio, double peklenik) {
  const PressureRow& row = find_row(kPressureTable, peklenik, "pressure flow factor");
  const double lowest = lowest_of_row(row.peklenik);
  const bool clamped = ratio < lowest;
  const double h = clamped ? lowest : ratio;
  ValueSlope factor;
  if (row.peklenik <= 1.0) {
    const double decay = row.c * std::exp(-row.r * h);
    factor = {1.0 - decay, row.r * decay};
  } else {
    const double excess = row.c * std::pow(h, -row.r);
    factor = {1.0 + excess, -row.r * excess / h};
  }
  if (clamped) factor.slope = 0.0;
  return factor;
}

ValueSlope shear_flow_factor(double ratio, double peklenik) {
  const ShearRow& row = find_row(kShearTable, peklenik, "shear flow factor");
  const double lowest = lowest_of_row(row.peklenik);
  const bool clamped = ratio < lowest;
  const double h = clamped ? lowest : ratio;
  ValueSlope factor;
  if (h <= 5.0) {
    factor.value =
        row.a1 * std::pow(h, row.alpha1) * std::exp(-row.alpha2 * h + row.alpha3 * h * h);
    factor.slope = factor.value * (row.alpha1 / h - row.alpha2 + 2.0 * row.alpha3 * h);
  } else {
    factor.value = row.a2 * std::exp(-0.25 * h);
    factor.slope = -0.25 * factor.value;
  }
  if (clamped) factor.slope = 0.0;
  return factor;
}

ValueSlope shear_stress_factor(double ratio, double peklenik) {
  const StressRow& row = find_row(kStressTable, peklenik, "shear stress factor");
  const double h = std::clamp(ratio, kStressBegin, kStressEnd);
  ValueSlope factor;
  factor.value = row.a3 * std::pow(h, row.alpha4) * std::exp(h * (row.alpha6 * h - row.alpha5));
  if (ratio > kStressEnd) {
    factor.value *= std::exp(kStressEnd - ratio);
    factor.slope = -factor.value;
  } else if (ratio >= kStressBegin) {
    factor.slope = factor.value * (row.alpha4 / h - row.alpha5 + 2.0 * row.alpha6 * h);
  }
  return factor;
}

double lowest_stress_ratio(double peklenik) {
  return find_row(kStressTable, peklenik, "shear stress factor").lowest;
}

ValueSlope pressure_stress_factor(double ratio, double peklenik) {
  const StressRow& row = find_row(kStressTable, peklenik, "shear stress factor");
  const double decay = row.d * std::exp(-row.s * std::max(ratio, row.lowest));
  return {1.0 - decay, ratio < row.lowest ? 0.0 : row.s * decay};
}

// With t = d / (3 sigma) and z = H / 3 the mean is 1/(3 sigma) of the integral of 35/32 (1 - t^2)^3
// / (z + t).
ValueSlope mean_inverse_gap(double ratio) {
  const double z = std::max(ratio, 0.0) / 3.0;
  ValueSlope mean;
  if (z > 3.0) {
    mean = inverse_gap_series(z);
  } else {
    const double w = 1.0 - z * z;
    if (z <= 1.0) {
      const double log_term = std::log(300.0 * (z + 1.0));
      const double poly =
          (-55.0 +
           z * (132.0 + z * (345.0 + z * (-160.0 + z * (-405.0 + z * (60.0 + z * 147.0)))))) /
          60.0;
      const double poly_slope =
          (132.0 + z * (690.0 + z * (-480.0 + z * (-1620.0 + z * (300.0 + z * 882.0))))) / 60.0;
      mean.value = w * w * w * log_term + poly;
      mean.slope = -6.0 * z * w * w * log_term + w * w * w / (z + 1.0) + poly_slope;
    } else {
      const double log_term = std::log((z + 1.0) / (z - 1.0));
      mean.value = w * w * w * log_term + z / 15.0 * (66.0 + z * z * (30.0 * z * z - 80.0));
      mean.slope = -6.0 * z * w * w * log_term + 2.0 * w * w +
                   (66.0 + z * z * (150.0 * z * z - 240.0)) / 15.0;
    }
    mean.value *= 35.0 / 32.0;
    mean.slope *= 35.0 / 32.0;
  }
  mean.value /= 3.0;
  mean.slope = ratio > 0.0 ? mean.slope / 9.0 : 0.0;
  return mean;
}

}  // namespace clatter::film
