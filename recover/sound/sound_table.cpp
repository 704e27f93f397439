// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/sound_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"

namespace clatter::recover {
namespace {

Stencil table_stencil(const SoundTable& table, double frequency_hz) {
  if (!covers(table, frequency_hz))
    throw InputError(
        fmt::format("sound: found a frequency of {:g} Hz, expected at most {:g}, the "
                    "limit of the acoustic skin",
                    frequency_hz, table.to_hz()));
  std::vector<double> grid;
  for (const SoundSample& sample : table.samples) grid.push_back(sample.frequency_hz);
  return stencil(grid, frequency_hz);
}

/// exp(sign i k distance) of each microphone.
Eigen::VectorXcd phases(const SoundTable& table, double frequency_hz, double sign) {
  const double k = table.fluid.wavenumber(frequency_hz);
  return table.distance.unaryExpr([&](double d) { return std::polar(1.0, sign * k * d); });
}

}  // namespace

bool covers(const SoundTable& table, double frequency_hz) {
  // Frequencies of lines carry rounding.
  return frequency_hz <= table.to_hz() * (1.0 + 1e-9);
}

Stencil stencil(const std::vector<double>& frequency_hz, double at_hz) {
  const auto above = static_cast<size_t>(
      std::lower_bound(frequency_hz.begin(), frequency_hz.end(), at_hz) - frequency_hz.begin());
  if (above == 0) return {0, Eigen::VectorXd::Ones(1)};
  constexpr size_t kReach = 3;  // samples on either side
  const size_t first = above >= kReach ? above - kReach : 0;
  const size_t last = std::min(above + kReach - 1, frequency_hz.size() - 1);
  Stencil out{first, Eigen::VectorXd::Ones(static_cast<Eigen::Index>(last - first + 1))};
  for (size_t i = first; i <= last; ++i)
    for (size_t j = first; j <= last; ++j)
      if (i != j)
        out.weight[static_cast<Eigen::Index>(i - first)] *=
            (at_hz - frequency_hz[j]) / (frequency_hz[i] - frequency_hz[j]);
  return out;
}

Stencil power_stencil(const SoundTable& table, double frequency_hz) {
  Stencil by = table_stencil(table, frequency_hz);
  for (Eigen::Index i = 0; i < by.weight.size(); ++i) {
    const double ratio =
        frequency_hz / table.samples[by.first + static_cast<size_t>(i)].frequency_hz;
    by.weight[i] *= ratio * ratio;
  }
  return by;
}

Eigen::MatrixXd resistance_at(const SoundTable& table, double frequency_hz) {
  const Stencil by = power_stencil(table, frequency_hz);
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(table.size(), table.size());
  for (Eigen::Index i = 0; i < by.weight.size(); ++i)
    R += by.weight[i] * table.samples[by.first + static_cast<size_t>(i)].R;
  return R;
}

Eigen::MatrixXcd microphones_at(const SoundTable& table, double frequency_hz) {
  const Stencil by = table_stencil(table, frequency_hz);
  Eigen::MatrixXcd H = Eigen::MatrixXcd::Zero(table.distance.size(), table.size());
  for (Eigen::Index i = 0; i < by.weight.size(); ++i) {
    const SoundSample& sample = table.samples[by.first + static_cast<size_t>(i)];
    H += by.weight[i] * (frequency_hz / sample.frequency_hz) *
         (phases(table, sample.frequency_hz, 1.0).asDiagonal() * sample.H);
  }
  return phases(table, frequency_hz, -1.0).asDiagonal() * H;
}

SampleErrors interpolation_errors(const SoundTable& table, const SoundSample& computed) {
  SampleErrors errors;
  const Eigen::VectorXd found = resistance_at(table, computed.frequency_hz).diagonal();
  for (Eigen::Index j = 0; j < found.size(); ++j) {
    if (computed.R(j, j) <= 0.0) continue;  // a coordinate that moves no exposed face
    const double error = found[j] > 0.0 ? std::abs(10.0 * std::log10(found[j] / computed.R(j, j)))
                                        : std::numeric_limits<double>::infinity();
    errors.resistance = std::max(errors.resistance, error);
  }
  const Eigen::MatrixXcd difference = microphones_at(table, computed.frequency_hz) - computed.H;
  for (Eigen::Index m = 0; m < difference.rows(); ++m)
    if (const double size = computed.H.row(m).norm(); size > 0.0)
      errors.microphone =
          std::max(errors.microphone, 20.0 * std::log10(1.0 + difference.row(m).norm() / size));
  return errors;
}

}  // namespace clatter::recover
