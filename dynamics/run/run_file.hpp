// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The file of a run, schema clatter/run/1.
#include <filesystem>

#include "core/base/artefact.hpp"
#include "dynamics/run/simulate.hpp"

namespace clatter::dynamics {

/// Writes
///   output/time [s], output/crank_angle_deg        n_t, uniform
///   bodies/<name>/q, v, a                          n_t x r, reduced coordinates, SI; attributes
///   rom
///                                                  (relative to the run file), rom_sha256
///   history/crank_angle_deg, history/time, history/<name>   accepted states; attribute unit
///   energy/time, kinetic, strain, element, input, lost, imbalance, terms/<name>; attribute residue
///   film/time, film/crank_angle_deg, film/<pad>/angle_deg, axial, gap, pressure, fill,
///     contact_pressure                             instants x angle x axial, single precision
///   effects/..., statistics (attributes), certificate (attributes)
/// Root attribute `complete`: 0 when the run was interrupted inside its last cycle. Provenance and
/// timing are left to the caller.
void write_run(H5File& file, const Scene& scene, const LoadedBodies& bodies,
               const RunResult& result);

/// Schema, resolved configuration and inputs of a run.
Provenance provenance_of(const Scene& scene);

/// The certificate of a run.
RunCertificate run_certificate(const RunResult& result);

}  // namespace clatter::dynamics
