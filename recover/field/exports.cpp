// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/field/exports.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/xml.hpp"

namespace clatter::recover {
namespace {

const std::string kNormalVelocity = "normal_velocity";

std::string data_item(const XdmfSeries& series, const std::string& dataset,
                      const std::string& shape, const char* type, int precision) {
  return fmt::format(
      "<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" "
      "Format=\"HDF\">{}:/{}</DataItem>",
      shape, type, precision, escape_xml(series.heavy_file), escape_xml(dataset));
}

std::string field_text(const XdmfSeries& series, const XdmfField& field, size_t step) {
  const std::string shape =
      field.on_faces ? fmt::format("{}", series.n_faces) : fmt::format("{} 3", series.n_nodes);
  return fmt::format(
      "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">\n          {}\n        "
      "</Attribute>\n",
      escape_xml(field.name), field.on_faces ? "Scalar" : "Vector",
      field.on_faces ? "Cell" : "Node",
      data_item(series, field.group + "/" + member_name(step), shape, "Float", field.precision));
}

std::string grid_text(const XdmfSeries& series, size_t step) {
  // Each grid repeats the mesh (ParaView reads it from the same dataset), since some readers do not
  // support XPointer references.
  std::string text = fmt::format(
      "      <Grid Name=\"{} {}\" GridType=\"Uniform\">\n        <Time Value=\"{:.12g}\"/>\n"
      "        <Topology TopologyType=\"Triangle_6\" NumberOfElements=\"{}\">\n          {}\n"
      "        </Topology>\n        <Geometry GeometryType=\"XYZ\">\n          {}\n        "
      "</Geometry>\n",
      escape_xml(series.name), step, series.values[step], series.n_faces,
      data_item(series, "skin/triangles", fmt::format("{} 6", series.n_faces), "Int", 4),
      data_item(series, "skin/nodes", fmt::format("{} 3", series.n_nodes), "Float",
                series.precision));
  for (const XdmfField& field : series.fields) text += field_text(series, field, step);
  return text + "      </Grid>\n";
}

XdmfSeries empty_series(const std::string& name, const std::filesystem::path& field_file,
                        int64_t n_nodes, int64_t n_faces) {
  return {.name = name,
          .heavy_file = field_file.filename().string(),
          .n_nodes = n_nodes,
          .n_faces = n_faces};
}

/// The chosen quantities in the group of the series' name, "velocity_re" for part "_re".
void add_fields(XdmfSeries& series, const Quantities& quantities, const std::string& part,
                int precision) {
  for (const std::string& name : names_of(quantities))
    series.fields.push_back(
        {name + part, series.name + "/" + name + part, name == kNormalVelocity, precision});
}

}  // namespace

std::string xdmf_text(const XdmfSeries& series) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n"
      "      <Information Name=\"TimeUnit\" Value=\"{}\"/>\n",
      escape_xml(series.name), escape_xml(series.value_unit));
  for (size_t step = 0; step < series.values.size(); ++step) text += grid_text(series, step);
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

XdmfSeries frame_series(const std::filesystem::path& field_file, int64_t n_nodes, int64_t n_faces,
                        const FrameIndex& frames) {
  XdmfSeries series = empty_series("frames", field_file, n_nodes, n_faces);
  series.values = frames.time_s;
  series.value_unit = "s from crank angle 0";
  add_fields(series, frames.quantities, "", 4);
  return series;
}

XdmfSeries line_series(const std::filesystem::path& field_file, int64_t n_nodes, int64_t n_faces,
                       const LineIndex& lines) {
  XdmfSeries series = empty_series("lines", field_file, n_nodes, n_faces);
  series.values = lines.frequency_hz;
  series.value_unit = "Hz";
  for (const char* part : {"_re", "_im"})
    add_fields(series, lines.quantities, part, lines.single ? 4 : 8);
  return series;
}

std::filesystem::path frame_export_path(const std::filesystem::path& field_file) {
  return std::filesystem::path(field_file).replace_extension(".xdmf");
}

std::filesystem::path line_export_path(const std::filesystem::path& field_file) {
  return std::filesystem::path(field_file).replace_extension(".lines.xdmf");
}

}  // namespace clatter::recover
