#pragma once
// The part of a model's file that statics need: supports, points, forces on supports, prescribed
// displacements, temperatures, cases.
#include "core/base/h5_file.hpp"
#include "core/fe/fe_model.hpp"

namespace clatter::fe {

/// Groups `supports`, `points`, `support_loads`, `prescribed`, `temperature_rise`, `cases`; each
/// only when there is any.
void write_statics(H5File& file, const FeModel& model);

/// Reads them into a model that has its matrices and loads; checks shapes, ranges, finite values
/// and that cases name loads (InputError).
void read_statics(const H5File& file, FeModel& model);

/// What the supported coordinates are, without their matrices: `supports/names`, `support`,
/// `labels`, `position`, `direction`, `is_rotation`.
void write_supported(H5File& file, const FeSupports& supports);

}  // namespace clatter::fe
