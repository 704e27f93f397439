// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The state at the end of an engine's run, from which another one may start.
#include <Eigen/Core>
#include <filesystem>

#include "core/base/h5_file.hpp"
#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/run/bodies.hpp"
#include "dynamics/run/model.hpp"

namespace clatter::dynamics {

/// Writes group `end` of a run file: the state at the end of its last cycle.
void write_end(H5File& file, const Model& model, const StageState& state);

/// Modal displacements and velocities, N each.
struct ModalStart {
  Eigen::VectorXd eta, v;
};

/// Reads the state at the end of the run at `path`, of the same bodies, and gives its elements' own
/// states to those of `model`. Speed, loads, tolerance and forces may be others. InputError when
/// the run has no such state, or bodies or films of other sizes.
ModalStart read_end(const std::filesystem::path& path, Model& model, const LoadedBodies& bodies);

}  // namespace clatter::dynamics
