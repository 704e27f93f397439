// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The stage's main function: from a run and its reduced model to a field file.
#include <filesystem>

#include "core/base/h5_file.hpp"
#include "core/base/stopwatch.hpp"
#include "recover/options/options.hpp"
#include "recover/run/run_input.hpp"
#include "recover/summary.hpp"

namespace clatter::recover {

/// Recovers everything requested by `options` and writes it to `file` (conventions, skin, panels,
/// analyses, frames, lines, certificate; provenance and timing are the caller's).
/// @throws InputError for spans, panels, sensors or frequencies outside run or basis
Summary recover(const RunBody& body, const rom::ReducedModel& model, const Options& options,
                H5File& file, StepClock& clock);

/// Writes the XDMF files of the committed field file; removes those of an older run that are no
/// longer valid.
void write_exports(const std::filesystem::path& field_file, const Summary& summary);

}  // namespace clatter::recover
