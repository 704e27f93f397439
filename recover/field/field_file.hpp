// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The field file, schema "clatter/field/1". The README documents the complete layout.
//
// Every dataset has attributes `unit` and `meaning`; complex ones are a pair x_re, x_im.
#include <vector>

#include "core/base/h5_file.hpp"
#include "recover/field/skin_writer.hpp"
#include "recover/spectrum/analysis.hpp"
#include "recover/spectrum/lines.hpp"

namespace clatter::recover {

inline constexpr const char* kFieldSchema = "clatter/field/1";

/// Writes the conventions (phase, amplitudes, references, air) to root attributes.
void write_conventions(H5File& file, const Options& options, const FrequencyLimit& limit,
                       double valid_to_hz);

/// Writes `skin/`: nodes, triangles, areas, normals.
void write_skin_geometry(H5File& file, const rom::Skin& skin, const SkinGeometry& geometry);

/// Writes `panels/<name>`: areas, and on request the faces.
void write_panels(H5File& file, const std::vector<Panel>& panels, bool with_faces);

/// Writes `analysis/<name>/`: sensors and radiation of one piece, without what `output` leaves out.
void write_analysis(H5File& file, const Analysis& analysis, const LevelReferences& references,
                    const OutputRule& output);

/// Contents of `frames/`: datasets displacement/00000, velocity/00000, acceleration/00000 (n_s x 3)
/// and normal_velocity/00000 (n_f), one per frame, in single precision.
struct FrameIndex {
  std::vector<double> time_s{}, angle_deg{};  // from firing TDC; angles empty without a crank
  Quantities quantities{};
  size_t size() const { return time_s.size(); }
};

/// Expands and writes the chosen quantities of frames, block by block.
FrameIndex write_frames(H5File& file, const RunBody& body, const SkinWriter& writer,
                        const Piece& piece, const std::vector<int64_t>& samples,
                        const Quantities& quantities);

/// Contents of `lines/`: datasets velocity_re/00000, velocity_im/00000, ... one per line.
struct LineIndex {
  std::vector<double> frequency_hz{};
  Quantities quantities{};
  bool single = false;
  size_t size() const { return frequency_hz.size(); }
};

/// Expands and writes `lines/`: complex motion per line, peak amplitudes. Displacement is v / (i
/// w), acceleration i w v.
LineIndex write_lines(H5File& file, const Analysis& analysis, const std::vector<ChosenLine>& lines,
                      const SkinWriter& writer, const Quantities& quantities, bool single);

/// "00042": the dataset name of frame or line 42.
std::string member_name(size_t index);

}  // namespace clatter::recover
