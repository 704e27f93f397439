// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/certify/verify.hpp"

#include <fmt/format.h>

#include "core/base/log.hpp"

namespace clatter::condense {
namespace {

/// Modes of the part by all processes that have its rows; rank 0 receives their vectors.
modes::ModeSolver solver_of(const PartitionedModel& part) {
  return [&part](const std::vector<int32_t>& /*all*/, const sparse::EigenOptions& requested) {
    sparse::EigenOptions options = requested;
    // Matrices imported without positions have no known rigid-body motions.
    if ((part.full.rigid.colwise().squaredNorm().array() > 0.0).all())
      options.rigid = part.rows_of_whole(part.free.q);
    sparse::ModeSet found = sparse::solve_modes(part.whole(), options);
    found.vectors = part.team().gather_at(part.whole_dofs, found.vectors, part.full.size());
    return found;
  };
}

}  // namespace

modes::Comparison verify(rom::ReducedModel& reduced, const PartitionedModel& part, double to_hz) {
  rom::ReducedCertificate& out = reduced.certificate;
  const double limit = to_hz > 0.0 ? to_hz : out.accurate_to_hz.value();
  modes::Comparison result;
  try {
    result = modes::compare(part.full, reduced, {limit, 0}, solver_of(part));
  } catch (const modes::NothingCompared& error) {  // the certificate is valid without it
    warn(fmt::format("not verified: {}", error.what()));
    return result;
  }
  if (result.modes.empty()) return result;
  out.verified_to_hz = limit;
  out.verified_modes = static_cast<double>(result.modes.size());
  out.verified_frequency_error = result.largest_error();
  out.verified_mac = result.smallest_mac();
  return result;
}

}  // namespace clatter::condense
