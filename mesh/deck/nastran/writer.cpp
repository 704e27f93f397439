// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "core/base/error.hpp"
#include "core/base/whole_file.hpp"
#include "mesh/deck/field_text.hpp"
#include "mesh/deck/nastran/number.hpp"
#include "mesh/deck/text_buffer.hpp"

namespace clatter::mesh::deck {
namespace {

constexpr int kLargeField = 16, kSmallField = 8;
constexpr int32_t kNoField = -1;  // left blank
constexpr int32_t kMostInSmallField = 99999999;

// Numbers of the nodes and cells as they are written.
class Numbers {
 public:
  explicit Numbers(const Mesh& mesh) : mesh_(mesh) {
    for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) note(node(static_cast<int32_t>(n)));
    for (const CellBlock& block : mesh.cells) {
      for (int32_t id : block.ids) {
        note(id);
        last_cell_ = std::max(last_cell_, id);
      }
    }
  }
  int32_t node(int32_t index) const {
    return mesh_.node_ids.empty() ? index + 1 : mesh_.node_ids[index];
  }
  int32_t cell(const CellBlock& block, Eigen::Index row) {
    return block.ids.empty() ? ++last_cell_ : block.ids[row];
  }
  /// Width of fields for all numbers.
  int width(int64_t more) const {
    return std::max<int64_t>(largest_, last_cell_ + more) > kMostInSmallField ? kLargeField
                                                                              : kSmallField;
  }

 private:
  void note(int32_t id) {
    if (id < 1) {
      throw InputError(
          fmt::format("mesh '{}': found the number {}, Nastran expects 1 or more", mesh_.name, id));
    }
    largest_ = std::max(largest_, id);
  }
  const Mesh& mesh_;
  int32_t largest_ = 0, last_cell_ = 0;
};

class NastranWriter {
 public:
  NastranWriter(const Mesh& mesh, std::ostream& out)
      : mesh_(mesh), text_(out), numbers_(mesh), width_(numbers_.width(mesh.cell_count())) {}

  void run() {
    text_.put("$ {} (lengths in metres)\nBEGIN BULK\n", mesh_.name);
    for (size_t r = 0; r < mesh_.regions.size(); ++r) {
      text_.put("$ clatter region {} {}\nPSOLID  {:<8}1\n", r + 1, mesh_.regions[r], r + 1);
    }
    nodes();
    if (const auto hanging = mesh_.node_sets.find(kHangingMidSideNodes);
        hanging != mesh_.node_sets.end() && !hanging->second.empty())
      text_.put("$ clatter hanging {}\n", numbers_.node(hanging->second.front()));
    for (const CellBlock& block : mesh_.cells) cells(block);
    size_t number = 0;
    for (const auto& [name, nodes] : mesh_.node_sets) {
      if (!nodes.empty() && name != kHangingMidSideNodes) node_set(++number, name, nodes);
    }
    for (const auto& [name, surface] : mesh_.surfaces) faces(name, surface);
    text_.put("ENDDATA\n");
    text_.flush();
  }

 private:
  void nodes() {
    for (Eigen::Index n = 0; n < mesh_.nodes.rows(); ++n) {
      if (hangs(static_cast<int32_t>(n))) continue;
      const int32_t id = numbers_.node(static_cast<int32_t>(n));
      const auto at = mesh_.nodes.row(n);
      std::string fields[3];
      bool exact = true;
      for (int k = 0; k < 3; ++k) {
        fields[k] = nastran_number(at[k], kLargeField);
        exact = exact && to_number(fields[k]) == at[k];
      }
      if (!exact) text_.put("$ clatter at {} {} {} {}\n", id, at[0], at[1], at[2]);
      text_.put("GRID*   {:<16}{:16}{:<16}{:<16}*\n*       {}\n", id, "", fields[0], fields[1],
                fields[2]);
    }
  }

  void cells(const CellBlock& block) {
    const CellTraits& cell = traits(block.type);
    std::vector<int32_t> fields;
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      fields = {numbers_.cell(block, c), block.region + 1};
      for (int i : cell.to_nastran)
        fields.push_back(hangs(block.nodes(c, i)) ? kNoField : numbers_.node(block.nodes(c, i)));
      while (fields.back() == kNoField) fields.pop_back();
      card(cell.nastran_name, fields);
    }
  }

  /// Hanging mid-side nodes are omitted from their cells: the reader adds them again.
  bool hangs(int32_t node) const {
    const auto set = mesh_.node_sets.find(kHangingMidSideNodes);
    return set != mesh_.node_sets.end() &&
           std::binary_search(set->second.begin(), set->second.end(), node);
  }

  void node_set(size_t number, const std::string& name, const std::vector<int32_t>& nodes) {
    text_.put("$ clatter set {} {}\n", number, name);
    std::vector<int32_t> fields = {static_cast<int32_t>(number)};
    for (int32_t node : nodes) fields.push_back(numbers_.node(node));
    card("SET1", fields);
  }

  void faces(const std::string& name, const Surface& surface) {
    text_.put("$ clatter surface {}\n", name);
    for (const FaceBlock& block : surface.faces) {
      for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
        text_.put("$ clatter {}", traits(block.type).name);
        for (Eigen::Index i = 0; i < block.nodes.cols(); ++i) {
          text_.put(" {}", numbers_.node(block.nodes(f, i)));
        }
        text_.put("\n");
      }
    }
  }

  // Integers in small fields, or in large ones if needed.
  void card(std::string_view name, const std::vector<int32_t>& fields) {
    const bool large = width_ == kLargeField;
    text_.put("{:<8}", large ? fmt::format("{}*", name) : std::string(name));
    const size_t per_line = large ? 4 : 8;
    for (size_t i = 0; i < fields.size(); ++i) {
      if (i > 0 && i % per_line == 0) text_.put("{0}\n{0:<8}", large ? '*' : '+');
      if (fields[i] == kNoField)
        text_.put("{:<{}}", "", width_);
      else
        text_.put("{:<{}}", fields[i], width_);
    }
    text_.put("\n");
  }

  const Mesh& mesh_;
  TextBuffer text_;
  Numbers numbers_;
  int width_;
};

}  // namespace

void write_nastran(const Mesh& mesh, std::ostream& out) { NastranWriter(mesh, out).run(); }

void write_nastran(const Mesh& mesh, const std::filesystem::path& path) {
  WholeFile file(path);
  write_nastran(mesh, file.stream());
  file.commit();
}

}  // namespace clatter::mesh::deck
