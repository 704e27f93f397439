// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ostream>

#include "core/base/error.hpp"
#include "core/base/whole_file.hpp"
#include "mesh/deck/field_text.hpp"
#include "mesh/deck/nastran/number.hpp"
#include "mesh/deck/shell_numbers.hpp"
#include "mesh/deck/text_buffer.hpp"

namespace clatter::mesh::deck {
namespace {

constexpr int kLargeField = 16, kSmallField = 8;
constexpr int32_t kNoField = -1;  // left blank
constexpr int32_t kMostInSmallField = 99999999;

/// The card of a shell, and its field ZOFFS from EID on.
struct ShellCard {
  const char* name;
  size_t offset;
};
constexpr std::array<ShellCard, kFaceTypes> kShellCards = {
    {{"CTRIA3", 6}, {"CTRIA6", 9}, {"CQUAD4", 7}, {"CQUAD8", 15}}};

// Numbers of the nodes and cells as they are written.
class Numbers {
 public:
  explicit Numbers(const Mesh& mesh) : mesh_(mesh) {
    for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) note(node(static_cast<int32_t>(n)));
    int32_t last = 0;
    for (const CellBlock& block : mesh.cells)
      for (const int32_t id : block.ids) last = std::max(last, id);
    for (const CellBlock& block : mesh.cells) {
      std::vector<int32_t>& numbers = cells_.emplace_back(block.ids);
      while (std::ssize(numbers) < block.nodes.rows()) numbers.push_back(++last);
    }
    shells_ = shell_numbers(mesh, cells_);
    for (const auto* blocks : {&cells_, &shells_})
      for (const std::vector<int32_t>& numbers : *blocks)
        for (const int32_t number : numbers) note(number);
  }
  int32_t node(int32_t index) const {
    return mesh_.node_ids.empty() ? index + 1 : mesh_.node_ids[index];
  }
  /// Of the solids and shells, block by block.
  const std::vector<std::vector<int32_t>>& cells() const { return cells_; }
  const std::vector<std::vector<int32_t>>& shells() const { return shells_; }
  /// Width of fields for all numbers.
  int width() const { return largest_ > kMostInSmallField ? kLargeField : kSmallField; }

 private:
  void note(int32_t id) {
    if (id < 1) {
      throw InputError(
          fmt::format("mesh '{}': found the number {}, Nastran expects 1 or more", mesh_.name, id));
    }
    largest_ = std::max(largest_, id);
  }
  const Mesh& mesh_;
  std::vector<std::vector<int32_t>> cells_, shells_;
  int32_t largest_ = 0;
};

class NastranWriter {
 public:
  NastranWriter(const Mesh& mesh, std::ostream& out)
      : mesh_(mesh), text_(out), numbers_(mesh), width_(numbers_.width()) {}

  void run() {
    text_.put("$ {} (lengths in metres)\nBEGIN BULK\n", mesh_.name);
    properties();
    nodes();
    if (const auto hanging = mesh_.node_sets.find(kHangingMidSideNodes);
        hanging != mesh_.node_sets.end() && !hanging->second.empty())
      text_.put("$ clatter hanging {}\n", numbers_.node(hanging->second.front()));
    for (size_t b = 0; b < mesh_.cells.size(); ++b) cells(b);
    for (size_t b = 0; b < mesh_.shells.size(); ++b) shells(b);
    size_t number = 0;
    for (const auto& [name, nodes] : mesh_.node_sets) {
      if (!nodes.empty() && name != kHangingMidSideNodes) node_set(++number, name, nodes);
    }
    for (const auto& [name, surface] : mesh_.surfaces) faces(name, surface);
    text_.put("ENDDATA\n");
    text_.flush();
  }

 private:
  // A mesh has no sections: T of a PSHELL is for the user, where its cells have no T1 to T4.
  void properties() {
    std::vector<bool> is_shell(mesh_.regions.size(), false);
    for (const ShellBlock& block : mesh_.shells) is_shell[block.region] = true;
    for (size_t r = 0; r < mesh_.regions.size(); ++r) {
      text_.put("$ clatter region {} {}\n", r + 1, mesh_.regions[r]);
      if (is_shell[r])
        text_.put("PSHELL  {:<8}{:<16}{:<16}{}\n", r + 1, 1, 1, 1);
      else
        text_.put("PSOLID  {:<8}1\n", r + 1);
    }
  }

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

  void cells(size_t b) {
    const CellBlock& block = mesh_.cells[b];
    const CellTraits& cell = traits(block.type);
    std::vector<int32_t> fields;
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      fields = {numbers_.cells()[b][static_cast<size_t>(c)], block.region + 1};
      for (int i : cell.to_nastran)
        fields.push_back(hangs(block.nodes(c, i)) ? kNoField : numbers_.node(block.nodes(c, i)));
      while (fields.back() == kNoField) fields.pop_back();
      card(cell.nastran_name, fields, width_);
    }
  }

  void shells(size_t b) {
    const ShellBlock& block = mesh_.shells[b];
    const ShellCard& shell = kShellCards[static_cast<size_t>(block.type)];
    std::vector<int32_t> fields;
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      fields = {numbers_.shells()[b][static_cast<size_t>(c)], block.region + 1};
      for (const int32_t node : block.nodes.row(c)) fields.push_back(numbers_.node(node));
      if (block.thickness.size() > 0 || block.offset.size() > 0)
        own_section(shell, fields, block, c);
      else
        card(shell.name, fields, width_);
    }
  }

  void own_section(const ShellCard& shell, const std::vector<int32_t>& integers,
                   const ShellBlock& block, Eigen::Index c) {
    constexpr size_t kThickness = 10;  // T1 to T4
    const auto corners = static_cast<size_t>(traits(block.type).corners);
    std::vector<std::string> fields;
    for (const int32_t field : integers) fields.push_back(std::to_string(field));
    fields.resize(std::max(shell.offset + 1, kThickness + corners));
    if (block.offset.size() > 0)
      fields[shell.offset] = nastran_number(block.offset[c], kLargeField);
    for (size_t i = 0; i < corners && block.thickness.size() > 0; ++i)
      fields[kThickness + i] =
          nastran_number(block.thickness(c, static_cast<Eigen::Index>(i)), kLargeField);
    while (fields.back().empty()) fields.pop_back();
    card(shell.name, fields, kLargeField);
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
    card("SET1", fields, width_);
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

  // Fields of eight or sixteen columns.
  template <class Field>
  void card(std::string_view name, const std::vector<Field>& fields, int width) {
    const bool large = width == kLargeField;
    text_.put("{:<8}", large ? fmt::format("{}*", name) : std::string(name));
    const size_t per_line = large ? 4 : 8;
    for (size_t i = 0; i < fields.size(); ++i) {
      if (i > 0 && i % per_line == 0) text_.put("{0}\n{0:<8}", large ? '*' : '+');
      field(fields[i], width);
    }
    text_.put("\n");
  }

  void field(int32_t value, int width) {
    if (value == kNoField)
      field("", width);
    else
      text_.put("{:<{}}", value, width);
  }
  void field(const std::string& value, int width) { text_.put("{:<{}}", value, width); }

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
