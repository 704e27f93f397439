#include "mesh/mesh_export.hpp"

#include <fmt/format.h>

#include <functional>

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "mesh/deck/abaqus_writer.hpp"
#include "mesh/deck/nastran_writer.hpp"
#include "mesh/msh_writer.hpp"

namespace clatter::mesh {
namespace {

using Text = fmt::memory_buffer;

template <class... Args>
void put(Text& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

// Calls body(block, row, number) for each cell, numbered through from 0.
void for_each_cell(const Mesh& mesh,
                   const std::function<void(const CellBlock&, Eigen::Index, int64_t)>& body) {
  int64_t number = 0;
  for (const CellBlock& block : mesh.cells) {
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) body(block, c, number++);
  }
}

// Appended raw arrays: one after the other, each behind its length in bytes.
class RawArrays {
 public:
  template <class T>
  std::string add(const char* type, const char* name, int components,
                  const std::vector<T>& values) {
    const auto offset = bytes_.size();
    const auto length = static_cast<uint64_t>(values.size() * sizeof(T));
    append(&length, sizeof length);
    append(values.data(), length);
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
        "offset=\"{}\"/>\n",
        type, name, components, offset);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void append(const void* data, uint64_t length) {
    bytes_.append(static_cast<const char*>(data), length);
  }
  std::string bytes_;
};

Text vtu_text(const Mesh& mesh) {
  std::vector<double> points(mesh.nodes.data(), mesh.nodes.data() + mesh.nodes.size());
  std::vector<int32_t> connectivity, regions;
  std::vector<int64_t> offsets;
  std::vector<uint8_t> types;
  for_each_cell(mesh, [&](const CellBlock& block, Eigen::Index c, int64_t) {
    const CellTraits& cell = traits(block.type);
    for (int i : cell.to_vtk) connectivity.push_back(block.nodes(c, i));
    offsets.push_back(static_cast<int64_t>(connectivity.size()));
    types.push_back(static_cast<uint8_t>(cell.vtk_type));
    regions.push_back(block.region);
  });
  RawArrays raw;
  Text out;
  put(out,
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      mesh.nodes.rows(), mesh.cell_count());
  put(out, "<Points>\n{}</Points>\n", raw.add("Float64", "points", 3, points));
  const std::string ids = raw.add("Int32", "connectivity", 1, connectivity);
  const std::string ends = raw.add("Int64", "offsets", 1, offsets);
  const std::string kinds = raw.add("UInt8", "types", 1, types);
  put(out, "<Cells>\n{}{}{}</Cells>\n", ids, ends, kinds);
  put(out, "<CellData>\n{}</CellData>\n", raw.add("Int32", "region", 1, regions));
  put(out, "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
  out.append(raw.bytes());
  put(out, "\n</AppendedData>\n</VTKFile>\n");
  return out;
}

}  // namespace

void export_mesh(const Mesh& mesh, const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  const auto whole = [&](const Text& text) { write_whole_file(path, {text.data(), text.size()}); };
  if (extension == ".vtu") return whole(vtu_text(mesh));
  if (extension == ".msh") return write_whole_file(path, msh_text(mesh));
  if (extension == ".inp") return deck::write_abaqus(mesh, path);
  if (extension == ".bdf" || extension == ".nas" || extension == ".dat")
    return deck::write_nastran(mesh, path);
  throw InputError(
      fmt::format("{}: found extension '{}', expected .vtu, .msh, .inp, .bdf, .nas or .dat",
                  path.string(), extension));
}

}  // namespace clatter::mesh
