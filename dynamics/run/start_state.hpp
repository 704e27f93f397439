// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The state in which a run starts that does not go on from another one.
#include "dynamics/run/model.hpp"
#include "dynamics/run/run_end.hpp"

namespace clatter::dynamics {

/// Bodies where their components put them; where a component needs it, in static equilibrium near
/// there, with what is driven at rest, and with the velocities that their components gave them.
/// NumericsError naming the body and where it is when none is found.
ModalStart start_state(const Scene& scene, const LoadedBodies& bodies, const Model& model);

/// The state in which any run starts: start_state(), or the end of the run that time.start_from
/// names, which also gives the elements of `model` their states.
ModalStart first_state(const Scene& scene, const LoadedBodies& bodies, Model& model);

}  // namespace clatter::dynamics
