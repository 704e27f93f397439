// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The data for statics in a model file: supports, points, forces on supports, prescribed
// displacements, temperatures, cases, gaskets with curves; temperature fields.
#include "core/base/h5_file.hpp"
#include "core/fe/fe_model.hpp"

namespace clatter::fe {

/// Groups `supports`, `points`, `support_loads`, `prescribed`, `temperature_rise`, `heat`,
/// `cases`, `gaskets`; each only when not empty.
void write_statics(H5File& file, const FeModel& model);

/// Reads them into a model whose matrices and loads are set; checks shapes, ranges, finite values
/// and that cases name existing loads (InputError).
void read_statics(const H5File& file, FeModel& model);

/// Description of the supported DoFs, without matrices: `supports/names`, `support`, `labels`,
/// `position`, `direction`, `is_rotation`.
void write_supported(H5File& file, const FeSupports& supports);

}  // namespace clatter::fe
