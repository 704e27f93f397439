// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include "core/base/error.hpp"
#include "core/base/whole_file.hpp"
#include "mesh/deck/abaqus/cells.hpp"
#include "mesh/deck/abaqus/lines.hpp"
#include "mesh/deck/abaqus/number.hpp"
#include "mesh/deck/field_text.hpp"
#include "mesh/deck/shell_numbers.hpp"
#include "mesh/deck/text_buffer.hpp"

namespace clatter::mesh::deck {
namespace {

// Abaqus reads sixteen entries per line.
constexpr size_t kEntries = 16;

// The corners of a face in cyclic order, as a key to its cell.
using FaceCorners = std::array<int32_t, 4>;

FaceCorners turned(std::span<const int32_t> nodes, size_t corners) {
  FaceCorners out{-1, -1, -1, -1};
  const auto first =
      std::min_element(nodes.begin(), nodes.begin() + static_cast<long>(corners)) - nodes.begin();
  for (size_t i = 0; i < corners; ++i) out[i] = nodes[(static_cast<size_t>(first) + i) % corners];
  return out;
}

class AbaqusWriter {
 public:
  AbaqusWriter(const Mesh& mesh, std::ostream& out) : mesh_(mesh), text_(out) {}

  void run() {
    number_nodes();
    number_cells();
    text_.put("*HEADING\n{} (lengths in metres)\n*NODE\n", one_line(mesh_.name));
    for (Eigen::Index n = 0; n < mesh_.nodes.rows(); ++n) {
      text_.put("{}, {}, {}, {}\n", node_ids_[n], abaqus_number(mesh_.nodes(n, 0)),
                abaqus_number(mesh_.nodes(n, 1)), abaqus_number(mesh_.nodes(n, 2)));
    }
    check_names(mesh_.regions);
    for (size_t b = 0; b < mesh_.cells.size(); ++b) write_cells(b);
    if (!mesh_.shells.empty()) text_.put("{}\n", abaqus::kShellMark);
    for (size_t b = 0; b < mesh_.shells.size(); ++b) write_shells(b);
    std::vector<std::string> names;
    for (const auto& [name, nodes] : mesh_.node_sets) names.push_back(name);
    check_names(names);
    for (const auto& [name, nodes] : mesh_.node_sets) write_node_set(name, nodes);
    names.clear();
    for (const auto& [name, surface] : mesh_.surfaces) names.push_back(name);
    check_names(names);
    if (!mesh_.surfaces.empty()) index_faces();
    for (const auto& [name, surface] : mesh_.surfaces) write_surface(name, surface);
    text_.put("{}\n", abaqus::kEndMark);
    text_.flush();
  }

 private:
  static std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.starts_with('*') ? " " + text : text;
  }

  static bool all_different(std::vector<int32_t> ids) {
    std::sort(ids.begin(), ids.end());
    return std::adjacent_find(ids.begin(), ids.end()) == ids.end() &&
           (ids.empty() || ids.front() > 0);
  }

  void number_nodes() {
    node_ids_ = mesh_.node_ids;
    const auto count = static_cast<size_t>(mesh_.nodes.rows());
    if (node_ids_.size() == count && all_different(node_ids_)) return;
    node_ids_.resize(count);
    for (size_t n = 0; n < count; ++n) node_ids_[n] = static_cast<int32_t>(n) + 1;
  }

  void number_cells() {
    std::vector<int32_t> all;
    bool known = true;
    for (const CellBlock& block : mesh_.cells) {
      known = known && static_cast<Eigen::Index>(block.ids.size()) == block.nodes.rows();
      cell_ids_.push_back(block.ids);
      all.insert(all.end(), block.ids.begin(), block.ids.end());
    }
    if (!known || !all_different(all)) count_cells();
    shell_ids_ = shell_numbers(mesh_, cell_ids_);
  }

  void count_cells() {
    int32_t next = 0;
    for (size_t b = 0; b < mesh_.cells.size(); ++b) {
      cell_ids_[b].resize(mesh_.cells[b].nodes.rows());
      for (int32_t& id : cell_ids_[b]) id = ++next;
    }
  }

  // Names are compared without case and blanks.
  void check_names(const std::vector<std::string>& names) const {
    std::map<std::string, std::string> known;
    for (const std::string& name : names) {
      if (name.empty() || name.find_first_of("\"\n\r") != std::string::npos) {
        throw InputError(fmt::format("mesh '{}': the name '{}' cannot be written to an Abaqus deck",
                                     mesh_.name, name));
      }
      const auto [at, is_new] = known.emplace(folded(name), name);
      if (!is_new) {
        throw InputError(fmt::format("mesh '{}': the names '{}' and '{}' are the same to Abaqus",
                                     mesh_.name, at->second, name));
      }
    }
  }

  static std::string quoted(const std::string& name) {
    return name.find_first_of(", =\t") == std::string::npos ? name : "\"" + name + "\"";
  }

  // Entry i of n, and its separator.
  void put_entry(int32_t value, size_t i, size_t n) {
    text_.put("{}{}", value, i + 1 == n ? "\n" : i % kEntries == kEntries - 1 ? ",\n" : ", ");
  }

  void write_cells(size_t b) {
    const CellBlock& block = mesh_.cells[b];
    const CellTraits& cell = traits(block.type);
    if (block.nodes.rows() == 0) return;
    if (cell.abaqus_name.empty()) {
      throw InputError(
          fmt::format("mesh '{}': Abaqus has no element for {}", mesh_.name, cell.name));
    }
    text_.put("*ELEMENT, TYPE={}, ELSET={}\n", cell.abaqus_name,
              quoted(mesh_.regions[block.region]));
    const std::span<const int> p = cell.to_abaqus;
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      put_entry(cell_ids_[b][c], 0, p.size() + 1);
      for (size_t i = 0; i < p.size(); ++i) {
        put_entry(node_ids_[block.nodes(c, p[i])], i + 1, p.size() + 1);
      }
    }
  }

  void write_shells(size_t b) {
    const ShellBlock& block = mesh_.shells[b];
    if (block.nodes.rows() == 0) return;
    constexpr std::array<const char*, kFaceTypes> kTypes = {"S3", "S6", "S4", "S8R"};
    text_.put("*ELEMENT, TYPE={}, ELSET={}\n", kTypes[static_cast<size_t>(block.type)],
              quoted(mesh_.regions[block.region]));
    const auto entries = static_cast<size_t>(block.nodes.cols()) + 1;
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      put_entry(shell_ids_[b][static_cast<size_t>(c)], 0, entries);
      for (size_t i = 1; i < entries; ++i)
        put_entry(node_ids_[block.nodes(c, static_cast<Eigen::Index>(i) - 1)], i, entries);
    }
  }

  void write_node_set(const std::string& name, const std::vector<int32_t>& nodes) {
    text_.put("*NSET, NSET={}\n", quoted(name));
    for (size_t i = 0; i < nodes.size(); ++i) {
      put_entry(node_ids_[nodes[i]], i, nodes.size());
    }
  }

  // Element and face number of each candidate face: those with all corners on a surface.
  void index_faces() {
    std::vector<bool> on_surface(static_cast<size_t>(mesh_.nodes.rows()), false);
    for (const auto& [name, surface] : mesh_.surfaces) {
      for (const int32_t node : nodes_of(surface)) on_surface[node] = true;
    }
    for (size_t b = 0; b < mesh_.cells.size(); ++b) {
      const CellBlock& block = mesh_.cells[b];
      const auto& faces = traits(block.type).faces;
      for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
        for (size_t f = 0; f < faces.size(); ++f) {
          std::array<int32_t, 4> nodes{};
          const auto corners = static_cast<size_t>(traits(faces[f].type).corners);
          bool wanted = true;
          for (size_t i = 0; i < corners; ++i) {
            nodes[i] = block.nodes(c, faces[f].nodes[i]);
            wanted = wanted && on_surface[nodes[i]];
          }
          if (!wanted) continue;
          faces_.push_back({turned(nodes, corners), cell_ids_[b][c],
                            abaqus::number_of_face(block.type, static_cast<int>(f))});
        }
      }
    }
    for (size_t b = 0; b < mesh_.shells.size(); ++b) index_sides(b);
    std::sort(faces_.begin(), faces_.end(),
              [](const Face& a, const Face& b) { return a.corners < b.corners; });
  }

  // Both sides of the shells of a block.
  void index_sides(size_t b) {
    const ShellBlock& block = mesh_.shells[b];
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      std::array<int32_t, 4> nodes{};
      const auto corners = static_cast<size_t>(traits(block.type).corners);
      for (size_t i = 0; i < corners; ++i) nodes[i] = block.nodes(c, static_cast<Eigen::Index>(i));
      const int32_t cell = shell_ids_[b][static_cast<size_t>(c)];
      faces_.push_back({turned(nodes, corners), cell, kSpos});
      std::reverse(nodes.begin(), nodes.begin() + corners);
      faces_.push_back({turned(nodes, corners), cell, kSneg});
    }
  }

  void write_surface(const std::string& name, const Surface& surface) {
    text_.put("*SURFACE, NAME={}, TYPE=ELEMENT\n", quoted(name));
    for (const FaceBlock& block : surface.faces) {
      const auto corners = static_cast<size_t>(traits(block.type).corners);
      for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
        const std::span<const int32_t> nodes(block.nodes.data() + f * block.nodes.cols(), corners);
        const Face& face = face_at(nodes, name);
        if (face.number > 0)
          text_.put("{}, S{}\n", face.cell, face.number);
        else
          text_.put("{}, {}\n", face.cell, face.number == kSpos ? "SPOS" : "SNEG");
      }
    }
  }

  static constexpr int kSpos = 0, kSneg = -1;
  struct Face {
    FaceCorners corners;
    int32_t cell;
    int number;  // 1, 2, ...; of shells kSpos or kSneg
  };

  // The face with those corners in that cyclic order: outward from its cell.
  const Face& face_at(std::span<const int32_t> nodes, const std::string& surface) const {
    const FaceCorners wanted = turned(nodes, nodes.size());
    const auto at = std::lower_bound(
        faces_.begin(), faces_.end(), wanted,
        [](const Face& face, const FaceCorners& corners) { return face.corners < corners; });
    if (at == faces_.end() || at->corners != wanted) {
      throw InputError(
          fmt::format("mesh '{}': surface {}: the face of nodes {} is not an outward face "
                      "of a cell",
                      mesh_.name, surface, fmt::join(nodes, " ")));
    }
    return *at;
  }

  const Mesh& mesh_;
  TextBuffer text_;
  std::vector<int32_t> node_ids_;
  std::vector<std::vector<int32_t>> cell_ids_, shell_ids_;
  std::vector<Face> faces_;
};

}  // namespace

void write_abaqus(const Mesh& mesh, const std::filesystem::path& path) {
  WholeFile file(path);
  AbaqusWriter(mesh, file.stream()).run();
  file.commit();
}

}  // namespace clatter::mesh::deck
