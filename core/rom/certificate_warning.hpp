// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Warning about a reduced model without a complete certificate.
#include <string>

#include "core/rom/reduced_model.hpp"

namespace clatter::rom {

/// Text of a warning about a reduced model: "" when it is certified, else the reason: no
/// certificate, or condensed with --no-certificate.
std::string certificate_warning(const ReducedModel& model);

}  // namespace clatter::rom
