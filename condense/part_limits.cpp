// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/part_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/fe/part_errors.hpp"

namespace clatter::condense {
namespace {

constexpr double kTooFar = 0.05;  // of a frequency: where first-order estimates are too low

/// The part that has the largest error of a mode, by those that are known.
const std::string& worst_part(const fe::FeParts& parts, Eigen::RowVectorXd errors) {
  Eigen::Index worst = 0;
  errors.array().isNaN().select(0.0, errors).maxCoeff(&worst);
  return parts.list[worst].name;
}

/// The error of a mode by all parts that are known.
double sum_of_known(const Eigen::RowVectorXd& errors) {
  return errors.array().isNaN().select(0.0, errors).sum();
}

}  // namespace

void check_parts(const fe::FeModel& model, const ModeRequest& request) {
  if (request.accurate_to_hz <= model.parts.accurate_to_hz()) return;
  throw NumericsError(fmt::format(
      "{}: accurate_to_hz: found {:g} Hz, but its {} reduced parts are accurate to {:g} Hz: reduce "
      "them with a higher cut-off, or ask for less",
      model.name, request.accurate_to_hz, model.parts.list.size(), model.parts.accurate_to_hz()));
}

void limit_to_parts(const fe::FeModel& model, const ModeRequest& request, CraigBampton& source) {
  const fe::FeParts& parts = model.parts;
  if (parts.list.empty()) return;
  InteriorModes& interior = source.interior;
  interior.cutoff_hz = std::min(interior.cutoff_hz, parts.valid_to_hz());
  interior.accurate_to_hz = std::min(interior.accurate_to_hz, parts.accurate_to_hz());
  fe::warn_of_unknown_errors(parts, model.name);
  const ResidualReport& report = source.residual;
  const bool requested = request.accurate_to_hz > 0.0;
  const double limit = requested ? request.frequency_error : kTooFar;
  for (Eigen::Index j = 0; j < report.of_parts.rows(); ++j) {
    const double hz = report.modes_hz[j], error = sum_of_known(report.of_parts.row(j));
    if (hz > interior.accurate_to_hz || error <= limit) continue;
    const std::string what = fmt::format(
        "{}: the frequency of {:.1f} Hz is too high by {:.2g} % for the modes that its reduced "
        "parts lack, most by part {}",
        model.name, hz, 100.0 * error, worst_part(parts, report.of_parts.row(j)));
    if (requested || j == 0)
      throw NumericsError(
          fmt::format("{}, expected at most {:g} %: reduce it with a higher cut-off{}", what,
                      100.0 * limit, requested ? ", or allow more (frequency_error)" : ""));
    interior.accurate_to_hz = report.modes_hz[j - 1];
    warn(fmt::format("{}: accurate to {:.1f} Hz", what, interior.accurate_to_hz));
  }
}

void record_parts(const fe::FeModel& model, const CraigBampton& source,
                  rom::ReducedCertificate& certificate) {
  const ResidualReport& report = source.residual;
  if (report.of_parts.rows() == 0 || !fe::parts_without_truncation(model.parts).empty()) return;
  double worst = 0.0;
  for (Eigen::Index j = 0; j < report.of_parts.rows(); ++j)
    if (report.modes_hz[j] <= source.interior.accurate_to_hz)
      worst = std::max(worst, report.of_parts.row(j).sum());
  certificate.frequency_error_parts = worst;
}

}  // namespace clatter::condense
