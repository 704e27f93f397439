// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/exports/msh_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "mesh/deck/shell_numbers.hpp"
#include "mesh/exports/export_groups.hpp"

namespace clatter::mesh {
namespace {

constexpr int kPointElement = 15;  // Gmsh's type

class MshWriter {
 public:
  explicit MshWriter(const Mesh& mesh) : mesh_(mesh) {}

  std::string run() {
    put("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    names();
    nodes();
    cells();
    faces();
    points();
    put("$EndElements\n");
    return fmt::to_string(out_);
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }

  void name(int dim, const std::string& name) {
    if (name.find('"') != std::string::npos)
      throw InputError(
          fmt::format("{}: found the name '{}', expected none with '\"'", mesh_.name, name));
    put("{} {} \"{}\"\n", dim, ++groups_, name);
  }

  // Groups are numbered consecutively: node sets, surfaces, regions.
  void names() {
    put("$PhysicalNames\n{}\n",
        mesh_.node_sets.size() + mesh_.surfaces.size() + mesh_.regions.size());
    for (const auto& [set, rows] : mesh_.node_sets) name(0, set);
    for (const auto& [surface, faces] : mesh_.surfaces) name(2, surface);
    std::vector<int> dimension(mesh_.regions.size(), 3);
    for (const ShellBlock& block : mesh_.shells) dimension[block.region] = 2;
    const std::vector<std::string> regions = export_region_names(mesh_);
    for (size_t r = 0; r < regions.size(); ++r) name(dimension[r], regions[r]);
    put("$EndPhysicalNames\n");
  }

  int32_t node_id(int32_t row) const {
    return mesh_.node_ids.empty() ? row + 1 : mesh_.node_ids[row];
  }

  void nodes() {
    put("$Nodes\n{}\n", mesh_.nodes.rows());
    for (int32_t n = 0; n < mesh_.nodes.rows(); ++n)
      put("{} {:.16e} {:.16e} {:.16e}\n", node_id(n), mesh_.nodes(n, 0), mesh_.nodes(n, 1),
          mesh_.nodes(n, 2));
    put("$EndNodes\n");
  }

  template <class Row>
  void element(int64_t id, int type, size_t group, const Row& nodes) {
    put("{} {} 2 {} {}", id, type, group, group);
    for (int32_t node : nodes) put(" {}", node_id(node));
    put("\n");
  }

  void cells() {
    int64_t count = mesh_.cell_count();
    for (const auto& [name, rows] : mesh_.node_sets) count += static_cast<int64_t>(rows.size());
    for (const auto& [name, surface] : mesh_.surfaces) count += surface.face_count();
    put("$Elements\n{}\n", count);
    std::vector<std::vector<int32_t>> numbers;
    for (const CellBlock& block : mesh_.cells) {
      numbers.push_back(block.ids);
      for (const int32_t id : block.ids) last_ = std::max<int64_t>(last_, id);
      while (std::ssize(numbers.back()) < block.nodes.rows())
        numbers.back().push_back(static_cast<int32_t>(++last_));
    }
    for (size_t b = 0; b < mesh_.cells.size(); ++b) block_of_region(mesh_.cells[b], numbers[b]);
    numbers = deck::shell_numbers(mesh_, numbers);
    for (size_t b = 0; b < mesh_.shells.size(); ++b) block_of_region(mesh_.shells[b], numbers[b]);
  }

  template <class Block>
  void block_of_region(const Block& block, const std::vector<int32_t>& numbers) {
    const size_t group = mesh_.node_sets.size() + mesh_.surfaces.size() + 1;
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const int32_t id = numbers[static_cast<size_t>(c)];
      last_ = std::max<int64_t>(last_, id);
      element(id, traits(block.type).gmsh_type, group + static_cast<size_t>(block.region),
              block.nodes.row(c));
    }
  }

  void faces() {
    size_t group = mesh_.node_sets.size();
    for (const auto& [name, surface] : mesh_.surfaces) {
      ++group;
      for (const FaceBlock& block : surface.faces)
        for (Eigen::Index f = 0; f < block.nodes.rows(); ++f)
          element(++last_, traits(block.type).gmsh_type, group, block.nodes.row(f));
    }
  }

  void points() {
    size_t group = 0;
    for (const auto& [name, rows] : mesh_.node_sets) {
      ++group;
      for (int32_t row : rows) element(++last_, kPointElement, group, std::array{row});
    }
  }

  const Mesh& mesh_;
  fmt::memory_buffer out_;
  size_t groups_ = 0;
  int64_t last_ = 0;  // number of an element
};

}  // namespace

std::string msh_text(const Mesh& mesh) { return MshWriter(mesh).run(); }

}  // namespace clatter::mesh
