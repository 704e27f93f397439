#pragma once
// Where a degree of freedom of a model is, for messages.
#include <string>

#include "core/fe/fe_model.hpp"

namespace clatter::fe {

/// "node 12 (0.1, 0.2, 0.3) direction y" of coordinate `dof` of q, from the row of T that it moves
/// most; "DoF 12" when it moves no node.
std::string place_of(const FeModel& model, int32_t dof);

}  // namespace clatter::fe
