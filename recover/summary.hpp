// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the stage found, printed and as JSON.
#include <string>
#include <vector>

#include "core/base/json_line.hpp"
#include "recover/field/exports.hpp"
#include "recover/field/field_certificate.hpp"
#include "recover/options/options.hpp"
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

/// The panel whose ERP stands for the sound without a table, and above it: the exposed faces, else
/// all.
template <typename Panel>
const Panel& radiating_panel(const std::vector<Panel>& panels) {
  for (const Panel& panel : panels)
    if (panel.name == "exposed") return panel;
  return panels.front();
}

/// Whether a sound file was given, and its analyses have lines.
bool has_sound(const Summary& summary);

/// For --json: faces, frames, lines, erp_w, erp_db (re 1 pW), spectra_to_hz.
JsonMembers json_of(const Summary& summary);

/// The text that is printed at the end: panels with levels, sensors with peaks.
std::string summary_text(const Summary& summary);

}  // namespace clatter::recover
