// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/part_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/log.hpp"

namespace clatter::fe {

Eigen::MatrixXd part_errors(const FeParts& parts, const Eigen::VectorXd& values,
                            const Eigen::MatrixXd& vectors) {
  const auto count = static_cast<Eigen::Index>(parts.list.size());
  Eigen::MatrixXd errors =
      Eigen::MatrixXd::Constant(values.size(), count, std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index p = 0; p < count; ++p) {
    const FePart& part = parts.list[p];
    if (part.truncation.rows() == 0) continue;
    const Eigen::MatrixXd image = multiply_symmetric(part.truncation, vectors);
    const double limit = std::pow(2.0 * std::numbers::pi * part.valid_to_hz, 2);
    for (Eigen::Index j = 0; j < values.size(); ++j)
      if (values[j] < limit)
        errors(j, p) = 0.5 * std::max(0.0, values[j] * vectors.col(j).dot(image.col(j))) /
                       (1.0 - values[j] / limit);
  }
  return errors;
}

std::string parts_without_truncation(const FeParts& parts) {
  std::string names;
  for (const FePart& part : parts.list)
    if (part.truncation.rows() == 0) names += (names.empty() ? "" : ", ") + part.name;
  return names;
}

void warn_of_unknown_errors(const FeParts& parts, const std::string& model) {
  const std::string unknown = parts_without_truncation(parts);
  if (!unknown.empty())
    warn(model + ": the error by the modes that " + unknown +
         " lack is not known: joined_error = true in their rom.toml");
}

}  // namespace clatter::fe
