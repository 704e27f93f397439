// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rom/damping_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace clatter::rom {

double DampingTable::at(double frequency_hz) const {
  if (empty()) return 0.0;
  const double* const begin = hz.data();
  const double* const end = begin + hz.size();
  const double* const above = std::upper_bound(begin, end, frequency_hz);
  if (above == begin) return ratio[0];
  if (above == end) return ratio[ratio.size() - 1];
  const Eigen::Index k = above - begin;
  const double share = (frequency_hz - hz[k - 1]) / (hz[k] - hz[k - 1]);
  return (1.0 - share) * ratio[k - 1] + share * ratio[k];
}

Eigen::VectorXd DampingTable::rates(const Eigen::VectorXd& omega_squared) const {
  return omega_squared.unaryExpr([this](double square) {
    if (!(square > 0.0)) return 0.0;
    const double omega = std::sqrt(square);
    return 2.0 * at(omega / (2.0 * std::numbers::pi)) * omega;
  });
}

std::string DampingTable::fault() const {
  if (ratio.size() != hz.size())
    return fmt::format("found {} ratios for {} frequencies, expected equal numbers", ratio.size(),
                       hz.size());
  for (Eigen::Index k = 0; k < hz.size(); ++k) {
    if (!(std::isfinite(hz[k]) && hz[k] > (k == 0 ? 0.0 : hz[k - 1])))
      return fmt::format("found {:g} Hz in row {}, expected positive, ascending frequencies", hz[k],
                         k + 1);
    if (!(ratio[k] >= 0.0 && ratio[k] < 1.0))
      return fmt::format(
          "found ratio {:g} in row {}, expected 0 or more and less than 1 (critical)", ratio[k],
          k + 1);
  }
  return {};
}

void write_damping_table(H5File& file, const DampingTable& table) {
  if (table.empty()) return;
  file.write("modal_damping/hz", table.hz);
  file.write("modal_damping/ratio", table.ratio);
}

DampingTable read_damping_table(const H5File& file) {
  DampingTable table;
  if (!file.has("modal_damping")) return table;
  table.hz = file.read_vector("modal_damping/hz");
  table.ratio = file.read_vector("modal_damping/ratio");
  const std::string fault = table.fault();
  if (!fault.empty())
    throw InputError(fmt::format("{}: modal_damping: {}", file.path().string(), fault));
  return table;
}

}  // namespace clatter::rom
