// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Description of a DoF for messages.
#include <string>

#include "core/fe/fe_model.hpp"

namespace clatter::fe {

/// "node 12 (0.1, 0.2, 0.3) direction y" for coordinate `dof` of q, from the largest entry of its
/// column of T; "DoF 12" when it moves no node.
std::string describe_dof(const FeModel& model, int32_t dof);

}  // namespace clatter::fe
