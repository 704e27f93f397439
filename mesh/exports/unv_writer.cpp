// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/exports/unv_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>

#include "core/base/error.hpp"
#include "mesh/deck/unv_kinds.hpp"
#include "mesh/exports/export_groups.hpp"

namespace clatter::mesh {
namespace {

constexpr int kElement = 8, kNode = 7;  // entities of groups

// Fortran's D instead of e.
std::string real(double value) {
  std::string text = fmt::format("{:25.16E}", value);
  std::replace(text.begin(), text.end(), 'E', 'D');
  return text;
}

class UnvWriter {
 public:
  explicit UnvWriter(const Mesh& mesh)
      : mesh_(mesh),
        node_numbers_(export_node_numbers(mesh)),
        cell_numbers_(export_cell_numbers(mesh)),
        faces_(export_faces(mesh)),
        last_(largest_cell_number(cell_numbers_, faces_)) {}

  std::string run() {
    begin(164);
    put("{:>10}{:<20}{:>10}\n", 1, "SI: Meter (newton)", 2);
    put("{}{}{}\n{}\n", real(1.0), real(1.0), real(1.0), real(273.15));
    end();
    begin(2411);
    for (Eigen::Index n = 0; n < mesh_.nodes.rows(); ++n) {
      put("{:>10}{:>10}{:>10}{:>10}\n", node_numbers_[n], 1, 1, 11);
      put("{}{}{}\n", real(mesh_.nodes(n, 0)), real(mesh_.nodes(n, 1)), real(mesh_.nodes(n, 2)));
    }
    end();
    begin(2412);
    for (size_t b = 0; b < mesh_.cells.size(); ++b) cells(b);
    const auto no_region = static_cast<int32_t>(mesh_.regions.size());
    for (ExportFace& face : faces_) {
      if (face.region < 0) face.number = ++last_;
      element(face.number, deck::unv_kind(face.type),
              (face.region < 0 ? no_region : face.region) + 1, face.nodes);
    }
    end();
    begin(2467);
    groups();
    end();
    return fmt::to_string(out_);
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }
  void begin(int dataset) { put("    -1\n{:>6}\n", dataset); }
  void end() { put("    -1\n"); }

  void element(int32_t number, const deck::UnvKind& kind, int property,
               std::span<const int32_t> nodes) {
    put("{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n", number, kind.descriptor, property, property, 7,
        kind.nodes.size());
    for (size_t i = 0; i < kind.nodes.size(); ++i) {
      const auto row = nodes[kind.nodes[i]];
      put("{:>10}", node_numbers_[row]);
      if (i % 8 == 7 || i + 1 == kind.nodes.size()) put("\n");
    }
  }

  void cells(size_t b) {
    const CellBlock& block = mesh_.cells[b];
    const deck::UnvKind kind = deck::unv_kind(block.type);
    if (kind.descriptor == 0)
      throw InputError(fmt::format("mesh '{}': universal files have no element for {}", mesh_.name,
                                   traits(block.type).name));
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      element(
          cell_numbers_[b][c], kind, block.region + 1,
          {block.nodes.data() + c * block.nodes.cols(), static_cast<size_t>(block.nodes.cols())});
    }
  }

  void group(const std::string& name, int entity, const std::vector<int32_t>& members) {
    constexpr size_t kLongest = 40;
    if (name.empty() || name.size() > kLongest || name.find('\n') != std::string::npos)
      throw InputError(
          fmt::format("mesh '{}': the name '{}' is not one line of 1 to {} characters, "
                      "the limit of universal files",
                      mesh_.name, name, kLongest));
    put("{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n{}\n", ++groups_, 0, 0, 0, 0, 0, 0,
        members.size(), name);
    for (size_t i = 0; i < members.size(); ++i) {
      put("{:>10}{:>10}{:>10}{:>10}", entity, members[i], 0, 0);
      if (i % 2 == 1 || i + 1 == members.size()) put("\n");
    }
  }

  void groups() {
    const std::vector<std::string> names = export_region_names(mesh_);
    for (size_t r = 0; r < names.size(); ++r) {
      std::vector<int32_t> members;
      for (size_t b = 0; b < mesh_.cells.size(); ++b)
        if (mesh_.cells[b].region == static_cast<int32_t>(r))
          members.insert(members.end(), cell_numbers_[b].begin(), cell_numbers_[b].end());
      for (const ExportFace& face : faces_)
        if (face.region == static_cast<int32_t>(r)) members.push_back(face.number);
      group(names[r], kElement, members);
    }
    size_t index = 0;
    for (const auto& [name, surface] : mesh_.surfaces) {
      std::vector<int32_t> members;
      for (const ExportFace& face : faces_)
        if (std::ranges::binary_search(face.surfaces, index)) members.push_back(face.number);
      ++index;
      group(name, kElement, members);
    }
    for (const auto& [name, nodes] : mesh_.node_sets) {
      std::vector<int32_t> members;
      for (const int32_t row : nodes) members.push_back(node_numbers_[row]);
      group(name, kNode, members);
    }
  }

  const Mesh& mesh_;
  std::vector<int32_t> node_numbers_;
  std::vector<std::vector<int32_t>> cell_numbers_;
  std::vector<ExportFace> faces_;
  int32_t last_;  // number of an element
  fmt::memory_buffer out_;
  int groups_ = 0;
};

}  // namespace

std::string unv_text(const Mesh& mesh) { return UnvWriter(mesh).run(); }

}  // namespace clatter::mesh
