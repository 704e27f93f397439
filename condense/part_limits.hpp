// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// An assembly of reduced parts is not better than these.
#include "condense/basis/craig_bampton.hpp"
#include "core/rom/reduced_certificate.hpp"

namespace clatter::condense {

/// NumericsError where more accuracy is requested than the parts have by themselves.
void check_parts(const fe::FeModel& model, const ModeRequest& request);

/// Limits the cut-off and accurate_to_hz of a reduction to those of the parts, and accurate_to_hz
/// to the modes whose error by the modes that the parts lack (fe::part_errors) is below 5 %, where
/// first-order estimates end. NumericsError that names the part where not even the first mode is,
/// and where a requested accurate_to_hz is not met within request.frequency_error.
void limit_to_parts(const fe::FeModel& model, const ModeRequest& request, CraigBampton& source);

/// frequency_error_parts: the largest such error up to accurate_to_hz; absent where one is not
/// known.
void record_parts(const fe::FeModel& model, const CraigBampton& source,
                  rom::ReducedCertificate& certificate);

}  // namespace clatter::condense
