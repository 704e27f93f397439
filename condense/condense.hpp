// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// From an assembled model to a reduced one.
#include "condense/basis/local_part.hpp"
#include "condense/condense_options.hpp"
#include "condense/describe.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fe/fe_model.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// Reduces `model` by Guyan, Craig-Bampton (eq. 13, 14) or Craig-Chang and certifies the result.
/// Steps and their times go to `clock`. Throws InputError (boundary, surfaces) and NumericsError
/// (eigen-solver, count of modes, rigid motions or mass lost).
rom::ReducedModel condense(const fe::FeModel& model, const CondenseOptions& options,
                           StepClock& clock);

/// The same for a part in blocks, which a team may share: then rank 0 receives the complete model,
/// the others one without rows of the skin and of sets besides the boundary.
rom::ReducedModel condense(const PartitionedModel& part, const CondenseOptions& options,
                           StepClock& clock);

}  // namespace clatter::condense
