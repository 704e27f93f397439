// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// XDMF3 files beside the field file, for ParaView: small XML texts that refer to data in the HDF5
// file.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "recover/field/field_file.hpp"

namespace clatter::recover {

/// A field of each step of a series.
struct XdmfField {
  std::string name{};
  std::string group{};    // datasets group/00000, group/00001, ...
  bool on_faces = false;  // one number per triangle; else a vector per node
  int precision = 4;      // bytes
};

/// A series of grids on one skin.
struct XdmfSeries {
  std::string name{};
  std::string heavy_file{};  // HDF5 file name, relative to the .xdmf
  int64_t n_nodes = 0, n_faces = 0;
  int precision = 8;             // of the nodes, bytes
  std::vector<double> values{};  // of ParaView's time slider: seconds or Hz
  std::string value_unit{};
  std::vector<XdmfField> fields{};
};

/// The XML text of a series: a temporal collection of uniform grids of Triangle_6.
std::string xdmf_text(const XdmfSeries& series);

/// Frames of a field file; its time slider shows seconds from crank angle 0.
XdmfSeries frame_series(const std::filesystem::path& field_file, int64_t n_nodes, int64_t n_faces,
                        const FrameIndex& frames);
/// Complex lines of a field file; its time slider shows Hz.
XdmfSeries line_series(const std::filesystem::path& field_file, int64_t n_nodes, int64_t n_faces,
                       const LineIndex& lines);

/// slap.field.h5 -> slap.field.xdmf and slap.field.lines.xdmf.
std::filesystem::path frame_export_path(const std::filesystem::path& field_file);
std::filesystem::path line_export_path(const std::filesystem::path& field_file);

}  // namespace clatter::recover
