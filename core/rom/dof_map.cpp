// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rom/dof_map.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/base/text_lines.hpp"
#include "core/base/whole_file.hpp"

namespace clatter::rom {
namespace {

constexpr const char* kKinds[] = {"displacement", "rotation", "modal"};
constexpr size_t kColumns = 12;

/// The component of a direction along one of the basic axes; 0 for any other.
int component_of(const Eigen::Vector3d& direction, bool rotation) {
  for (int d = 0; d < 3; ++d) {
    if (direction[d] > 1.0 - 1e-14) return d + (rotation ? 4 : 1);
  }
  return 0;
}

/// Assigns node numbers.
class NodeNumbers {
 public:
  NodeNumbers(const NodeNumbering& numbering, const DeckOrigin& deck)
      : of_deck_(deck.known()), one_count_(numbering.first_scalar == 0) {
    const int32_t first = of_deck_ ? round_number_after(deck.largest_node) : 1;
    node_ = (numbering.first_node != 0 ? numbering.first_node : first) - 1;
    scalar_ = numbering.first_scalar - 1;
  }

  /// @param deck_number of the DoF's node; 0: none.
  void assign(MappedDof& dof, int32_t deck_number) {
    if (dof.component == 0) {
      dof.node = one_count_ ? ++node_ : ++scalar_;
      return;
    }
    dof.of_deck = of_deck_ && deck_number > 0 && deck_[deck_number].insert(dof.component).second;
    dof.node = dof.of_deck ? deck_number : shared(dof);
  }

 private:
  int shared(const MappedDof& dof) {
    const Eigen::Vector3d& p = dof.position;
    auto& node = nodes_[{dof.set, {p[0], p[1], p[2]}}];
    if (node.number == 0 || !node.components.insert(dof.component).second)
      node = {++node_, {dof.component}};
    return node.number;
  }

  struct Node {
    int number = 0;
    std::set<int> components;
  };
  bool of_deck_ = false, one_count_ = true;
  std::map<std::pair<std::string, std::array<double, 3>>, Node> nodes_;
  std::map<int32_t, std::set<int>> deck_;  // components of nodes of the deck
  int32_t node_ = 0, scalar_ = 0;          // the last ones
};

MappedDof place_of(const DofSet& set, const std::string& name, size_t k, bool deck_axes) {
  MappedDof dof;
  const bool rotation = set.is_rotation[k] != 0;
  const auto row = static_cast<Eigen::Index>(k);
  dof.kind = rotation ? MappedDof::Kind::kRotation : MappedDof::Kind::kDisplacement;
  dof.position = set.position.row(row);
  dof.direction = set.direction.row(row);
  const int32_t own = k < set.components.size() ? set.components[k] : 0;
  dof.turned = deck_axes && own > 0;
  dof.component = own == 0 ? component_of(dof.direction, rotation) : dof.turned ? own : 0;
  dof.set = name;
  dof.label = set.labels[k];
  return dof;
}

std::vector<std::string_view> columns_of(std::string_view line) {
  std::vector<std::string_view> columns;
  size_t begin = 0;
  for (size_t tab = line.find('\t'); tab != std::string_view::npos; tab = line.find('\t', begin)) {
    columns.push_back(line.substr(begin, tab - begin));
    begin = tab + 1;
  }
  columns.push_back(line.substr(begin));
  return columns;
}

MappedDof::Kind kind_named(const TextLines& lines, std::string_view word) {
  for (int k = 0; k < 3; ++k) {
    if (word == kKinds[k]) return static_cast<MappedDof::Kind>(k);
  }
  lines.refuse(fmt::format("\"{}\"", word.substr(0, 40)), "displacement, rotation or modal");
}

void check(const TextLines& lines, const MappedDof& dof) {
  if (dof.node < 1) lines.refuse(fmt::format("node {}", dof.node), "a number from 1");
  if (dof.kind == MappedDof::Kind::kModal) return;
  const double length = dof.direction.norm();
  if (std::abs(length - 1.0) > 1e-9)
    lines.refuse(fmt::format("a direction of length {:.6g}", length), "a unit vector");
  const bool rotation = dof.kind == MappedDof::Kind::kRotation;
  const int axis = dof.component - (rotation ? 4 : 1);
  if (dof.component == 0) return;
  if (axis < 0 || axis > 2 || dof.direction[axis] < 1.0 - 1e-9)
    lines.refuse(fmt::format("component {}", dof.component),
                 rotation ? "4, 5 or 6 with direction x, y or z, or 0"
                          : "1, 2 or 3 with direction x, y or z, or 0");
}

MappedDof read_line(const TextLines& lines, const std::vector<std::string_view>& columns) {
  MappedDof dof;
  dof.node = static_cast<int>(std::min<int64_t>(lines.integer(columns[1]), INT32_MAX));
  dof.component = static_cast<int>(std::min<int64_t>(lines.integer(columns[2]), INT32_MAX));
  dof.kind = kind_named(lines, columns[3]);
  for (size_t d = 0; d < 3; ++d) {
    dof.position[static_cast<Eigen::Index>(d)] = lines.real(columns[4 + d]);
    dof.direction[static_cast<Eigen::Index>(d)] = lines.real(columns[7 + d]);
  }
  dof.set = columns[10];
  dof.label = columns[11];
  check(lines, dof);
  return dof;
}

}  // namespace

int32_t round_number_after(int32_t number) {
  int32_t power = 1;
  while (power <= number && power < 100'000'000) power *= 10;
  return power > number && power < 100'000'000 ? power + 1 : number + 1;
}

std::vector<MappedDof> map_of(const ReducedModel& model, const NodeNumbering& numbering) {
  std::vector<MappedDof> map(static_cast<size_t>(model.size()));
  std::vector<int32_t> deck_number(map.size(), 0);
  for (const auto& [name, set] : model.sets) {
    for (size_t k = 0; k < set.dofs.size(); ++k) {
      if (set.dofs[k] >= model.size()) continue;  // a combination of coordinates
      MappedDof& dof = map[set.dofs[k]];
      if (dof.kind == MappedDof::Kind::kModal) dof = place_of(set, name, k, numbering.deck_axes);
      int32_t& number = deck_number[set.dofs[k]];
      if (number == 0 && k < set.node_ids.size()) number = set.node_ids[k];
    }
  }
  NodeNumbers numbers(numbering, model.deck);
  for (size_t j = 0; j < map.size(); ++j) {
    numbers.assign(map[j], deck_number[j]);
    if (map[j].kind == MappedDof::Kind::kModal)
      map[j].label = fmt::format("mode_{}", static_cast<int>(j) - model.n_boundary + 1);
  }
  return map;
}

void write_dof_map(const std::filesystem::path& path, const std::vector<MappedDof>& map) {
  WholeFile file(path);
  file.stream() << "# Row and column i of the matrices; SI: positions in m, a displacement along "
                   "or rotation about (dx, dy, dz).\n"
                   "# i\tnode\tcomponent\tkind\tx\ty\tz\tdx\tdy\tdz\tset\tlabel\n";
  for (size_t j = 0; j < map.size(); ++j) {
    const MappedDof& dof = map[j];
    const Eigen::Vector3d &p = dof.position, &d = dof.direction;
    file.stream() << fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", j + 1,
                                 dof.node, dof.component, kKinds[static_cast<int>(dof.kind)], p[0],
                                 p[1], p[2], d[0], d[1], d[2], dof.set, dof.label);
  }
  file.commit();
}

std::vector<MappedDof> read_dof_map(const std::filesystem::path& path) {
  TextLines lines(path);
  std::vector<MappedDof> map;
  std::map<int, Eigen::Vector3d> positions;
  std::string_view line;
  while (lines.next(line)) {
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string_view> columns = columns_of(line);
    if (columns.size() != kColumns)
      lines.refuse(fmt::format("{} columns", columns.size()), "12, separated by tabs");
    if (lines.integer(columns[0]) != static_cast<int64_t>(map.size()) + 1)
      lines.refuse(fmt::format("row {}", columns[0]), fmt::format("row {}", map.size() + 1));
    const MappedDof dof = read_line(lines, columns);
    const Eigen::Vector3d& first = positions.emplace(dof.node, dof.position).first->second;
    if (first != dof.position)
      lines.refuse(fmt::format("node {} at another position", dof.node), "one position per node");
    map.push_back(dof);
  }
  if (map.empty()) lines.refuse("no degree of freedom", "one per line");
  return map;
}

}  // namespace clatter::rom
