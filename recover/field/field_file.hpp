// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The field file, schema "clatter/field/1". The README documents the complete layout.
//
// Every dataset has attributes `unit` and `meaning`; complex ones are a pair x_re, x_im.
#include <vector>

#include "core/base/h5_file.hpp"
#include "recover/spectrum/analysis.hpp"
#include "recover/spectrum/lines.hpp"

namespace clatter::recover {

inline constexpr const char* kFieldSchema = "clatter/field/1";

/// Writes the conventions (phase, amplitudes, references, air) to root attributes.
void write_conventions(H5File& file, const Options& options, const FrequencyLimit& limit,
                       double valid_to_hz);

/// Writes `skin/`: nodes, triangles, areas, normals.
void write_skin_geometry(H5File& file, const rom::Skin& skin, const SkinGeometry& geometry);

/// Writes `panels/<name>`: faces and areas.
void write_panels(H5File& file, const std::vector<Panel>& panels);

/// Writes `analysis/<name>/`: sensors and radiation of one piece.
void write_analysis(H5File& file, const Analysis& analysis, const LevelReferences& references);

/// Contents of `frames/`: datasets displacement/00000, velocity/00000 (n_s x 3, single precision)
/// and normal_velocity/00000 (n_f), one per frame.
struct FrameIndex {
  std::vector<double> time_s{}, angle_deg{};  // from firing TDC; angles empty without a crank
  bool displacement = true;
  size_t size() const { return time_s.size(); }
};

/// Expands and writes frames block by block; the complete expansion is never in memory.
FrameIndex write_frames(H5File& file, const RunBody& body, const rom::Skin& skin,
                        const SparseRows& face_normal, const Piece& piece,
                        const std::vector<int64_t>& samples, bool displacement);

/// Expands and writes `lines/`: complex velocities (n_s x 3) and normal velocities (n_f) per line,
/// double precision, peak amplitudes.
void write_lines(H5File& file, const Analysis& analysis, const std::vector<ChosenLine>& lines,
                 const rom::Skin& skin, const SparseRows& face_normal);

/// "00042": the dataset name of frame or line 42.
std::string member_name(size_t index);

}  // namespace clatter::recover
