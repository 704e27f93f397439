// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/vtu_writer.hpp"

#include <fmt/format.h>

#include <array>
#include <span>
#include <type_traits>

#include "core/base/xml.hpp"

namespace clatter::mesh {
namespace {

// Appended raw arrays: consecutive, each preceded by its length in bytes.
class RawArrays {
 public:
  template <class T>
  std::string add(std::string_view name, Eigen::Index components, std::span<const T> values) {
    const auto offset = bytes_.size();
    const uint64_t length = values.size_bytes();
    append(&length, sizeof length);
    append(values.data(), length);
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" NumberOfTuples=\"{}\" "
        "format=\"appended\" offset=\"{}\"/>\n",
        type_name<T>(), escape_xml(name), components,
        values.size() / static_cast<size_t>(components), offset);
  }
  template <class T>
  std::string add(std::string_view name, const std::vector<T>& values) {
    return add(name, 1, std::span<const T>(values));
  }
  template <class Matrix>
  std::string rows(std::string_view name, const Matrix& values) {
    return add(name, values.cols(),
               std::span<const typename Matrix::Scalar>(values.data(),
                                                        static_cast<size_t>(values.size())));
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  static constexpr const char* type_name() {
    if (std::is_same_v<T, double>) return "Float64";
    if (std::is_same_v<T, int32_t>) return "Int32";
    return std::is_same_v<T, int64_t> ? "Int64" : "UInt8";
  }
  void append(const void* data, uint64_t length) {
    bytes_.append(static_cast<const char*>(data), length);
  }
  std::string bytes_;
};

// VTK's triangle, quadratic triangle, quadrilateral, quadratic quadrilateral.
uint8_t vtk_type(FaceType type) {
  constexpr std::array<uint8_t, kFaceTypes> kTypes = {5, 22, 9, 23};
  return kTypes[static_cast<size_t>(type)];
}

int64_t count_drawn(const Mesh& mesh) {
  return mesh.cell_count() == 0 ? mesh.surface("skin").face_count() : mesh.cell_count();
}

std::string cells(const Mesh& mesh, RawArrays& raw) {
  std::vector<int32_t> connectivity;
  std::vector<int64_t> offsets;
  std::vector<uint8_t> types;
  for (const CellBlock& block : mesh.cells)
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      for (const int i : traits(block.type).to_vtk) connectivity.push_back(block.nodes(c, i));
      offsets.push_back(static_cast<int64_t>(connectivity.size()));
      types.push_back(static_cast<uint8_t>(traits(block.type).vtk_type));
    }
  const auto faces = [&](const auto& block) {
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
      for (Eigen::Index i = 0; i < block.nodes.cols(); ++i)
        connectivity.push_back(block.nodes(f, i));
      offsets.push_back(static_cast<int64_t>(connectivity.size()));
      types.push_back(vtk_type(block.type));
    }
  };
  for (const ShellBlock& block : mesh.shells) faces(block);
  if (mesh.cell_count() == 0)
    for (const FaceBlock& block : mesh.surface("skin").faces) faces(block);
  return raw.add("connectivity", connectivity) + raw.add("offsets", offsets) +
         raw.add("types", types);
}

std::string cell_data(const Mesh& mesh, RawArrays& raw) {
  std::vector<int32_t> ids, regions;
  const auto number = [&](const auto& block) {
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      regions.push_back(block.region);
      ids.push_back(block.ids.empty() ? static_cast<int32_t>(ids.size()) + 1 : block.ids[c]);
    }
  };
  for (const CellBlock& block : mesh.cells) number(block);
  for (const ShellBlock& block : mesh.shells) number(block);
  if (mesh.cell_count() == 0) return "";
  return raw.add("id", ids) + raw.add("region", regions);
}

std::string point_data(const Mesh& mesh, RawArrays& raw) {
  const auto n = static_cast<size_t>(mesh.nodes.rows());
  std::vector<int32_t> ids = mesh.node_ids;
  for (size_t i = ids.size(); i < n; ++i) ids.push_back(static_cast<int32_t>(i) + 1);
  std::string out = raw.add("id", ids);
  for (const auto& [name, nodes] : mesh.node_sets) {
    std::vector<uint8_t> flags(n, 0);
    for (const int32_t node : nodes) flags[node] = 1;
    out += raw.add(name, flags);
  }
  for (const auto& [name, field] : mesh.fields) out += raw.rows(name, field);
  return out;
}

std::string field_data(const Mesh& mesh, RawArrays& raw) {
  std::string out;
  for (size_t r = 0; r < mesh.regions.size(); ++r)
    out += raw.add(fmt::format("region {}", mesh.regions[r]),
                   std::vector<int32_t>{static_cast<int32_t>(r)});
  for (const auto& [name, surface] : mesh.surfaces)
    for (const FaceBlock& block : surface.faces)
      out += raw.rows(fmt::format("surface {} {}", name, traits(block.type).name), block.nodes);
  return out;
}

}  // namespace

std::string vtu_text(const Mesh& mesh) {
  RawArrays raw;
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n";
  const auto section = [&](const char* name, const std::string& arrays) {
    out += fmt::format("<{0}>\n{1}</{0}>\n", name, arrays);
  };
  section("FieldData", field_data(mesh, raw));
  out += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", mesh.nodes.rows(),
                     count_drawn(mesh));
  section("Points", raw.rows("points", mesh.nodes));
  section("Cells", cells(mesh, raw));
  section("PointData", point_data(mesh, raw));
  section("CellData", cell_data(mesh, raw));
  out += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  out += raw.bytes();
  out += "\n</AppendedData>\n</VTKFile>\n";
  return out;
}

}  // namespace clatter::mesh
