// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The stage's main function: from a run and its reduced model to a field file.
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"
#include "core/base/json_line.hpp"
#include "core/base/stopwatch.hpp"
#include "recover/field/exports.hpp"
#include "recover/field/field_certificate.hpp"
#include "recover/options/options.hpp"
#include "recover/run/run_input.hpp"
#include "recover/sound/run_sound.hpp"

namespace clatter::recover {

/// Results for the printed and the JSON summary.
struct Summary {
  Options options{};
  std::vector<Panel> panels{};
  std::vector<Sensor> sensors{};
  std::vector<Analysis> analyses{};
  std::vector<RunSound> sounds{};  // of the analyses; empty without a sound file
  FrameIndex frames{};
  LineIndex lines{};
  FrequencyLimit limit{};
  int64_t n_nodes = 0, n_faces = 0;
  FieldCertificate certificate{};
};

/// Recovers everything requested by `options` and writes it to `file` (conventions, skin, panels,
/// analyses, frames, lines, certificate; provenance and timing are the caller's).
/// @throws InputError for spans, panels, sensors or frequencies outside run or basis
Summary recover(const RunBody& body, const rom::ReducedModel& model, const Options& options,
                H5File& file, StepClock& clock);

/// Writes the XDMF files of the committed field file; removes those of an older run that are no
/// longer valid.
void write_exports(const std::filesystem::path& field_file, const Summary& summary);

/// For --json: faces, frames, lines, erp_w, erp_db (re 1 pW), spectra_to_hz.
JsonMembers json_of(const Summary& summary);

/// The text that is printed at the end: panels with levels, sensors with peaks.
std::string summary_text(const Summary& summary);

}  // namespace clatter::recover
