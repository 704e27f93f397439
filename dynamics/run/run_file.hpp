// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The file of a run, schema clatter/run/1.
#include <filesystem>

#include "core/base/artefact.hpp"
#include "dynamics/run/simulate.hpp"

namespace clatter::dynamics {

/// Appends a block of samples:
///   output/time [s], output/crank_angle_deg        n_t, uniform
///   bodies/<name>/q, v, a                          n_t x r, reduced coordinates, SI
void append_samples(H5File& file, const Model& model, const LoadedBodies& bodies,
                    const SampleBlock& block);

/// Writes the attributes of a body's group: its reduced model and frame.
void write_body(H5File& file, const LoadedBody& body);

/// Adds to the file of a result what is known at its end:
///   bodies/<name>                       attributes rom (relative to the run file), rom_sha256
///   energy                              attribute residue
///   effects/..., statistics (attributes), certificate (attributes)
/// Root attribute `complete`: 0 when the run was interrupted inside its last cycle. Provenance,
/// timing and the name of the file are left to the caller (finish_artefact).
void write_run(const Scene& scene, const LoadedBodies& bodies, const RunResult& result);

/// Schema, resolved configuration and inputs of a run.
Provenance provenance_of(const Scene& scene);

/// The certificate of a run.
RunCertificate run_certificate(const RunResult& result);

}  // namespace clatter::dynamics
