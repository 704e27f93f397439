// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/numbering.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr int64_t kMost = std::numeric_limits<int32_t>::max();
// A few gigabytes: a small deck can define very many instances.
constexpr int64_t kMostNodes = int64_t{1} << 26, kMostCells = int64_t{1} << 26;

// Added to numbers up to `own` so that they are above `taken`: a multiple of a power of ten, which
// keeps the own number readable. 0 if not needed.
int64_t offset_above(int32_t taken, int32_t lowest, int32_t own) {
  if (lowest > taken) return 0;
  int64_t power = 10;
  while (power <= own) power *= 10;
  return (taken + power - 1) / power * power;
}

}  // namespace

Numbering::Numbering(RawDeck deck, const Source& source) : source_(source), deck_(std::move(deck)) {
  node_index_.reserve(deck_.parts.size() + 1);
  element_index_.reserve(deck_.parts.size() + 1);
  for (const Scope& part : deck_.parts) index_scope(part);
  index_scope(deck_.model);
  std::map<std::string, size_t> part_of;
  for (size_t p = 0; p < deck_.parts.size(); ++p) part_of[folded(deck_.parts[p].name)] = p;
  for (const InstanceLine& line : deck_.instances) {
    if (find_use(line.name) >= 0) {
      source_.fail(line.origin, fmt::format("found a second instance {}", line.name));
    }
    const auto part = part_of.find(folded(line.part));
    if (part == part_of.end()) {
      source_.fail(line.origin, fmt::format("found no part {}", shown(line.part)));
    }
    add_use(deck_.parts[part->second], &line, static_cast<int32_t>(part->second));
  }
  if (!deck_.parts.empty() && deck_.instances.empty()) {
    source_.fail(deck_.parts.front().origin, "found parts, expected instances of them (*INSTANCE)");
  }
  add_use(deck_.model, nullptr, static_cast<int32_t>(deck_.parts.size()));
  for (Scope& part : deck_.parts) {
    part.nodes = NodeTable();
    part.cells.clear();
  }
}

void Numbering::index_scope(const Scope& scope) {
  const NodeTable& nodes = scope.nodes;
  node_index_.emplace_back(nodes.ids);
  for (const auto& [first, second] : node_index_.back().duplicates()) {
    const double* a = nodes.xyz.data() + 3 * int64_t{first};
    const double* b = nodes.xyz.data() + 3 * int64_t{second};
    if (std::equal(a, a + 3, b)) continue;
    source_.fail(nodes.origins[second],
                 fmt::format("node {}: found another one with this number at {}", nodes.ids[second],
                             source_.where(nodes.origins[first])));
  }
  std::vector<int32_t> ids;
  std::vector<Origin> origins;
  for (const CellTable& table : scope.cells) {
    ids.insert(ids.end(), table.ids.begin(), table.ids.end());
    origins.insert(origins.end(), table.origins.begin(), table.origins.end());
  }
  for (const PointElement& point : scope.points) {
    ids.push_back(point.id);
    origins.push_back(point.origin);
  }
  for (const ThinElement& thin : scope.thin) {
    ids.push_back(thin.id);
    origins.push_back(thin.origin);
  }
  ids.insert(ids.end(), scope.ignored_elements.begin(), scope.ignored_elements.end());
  element_index_.emplace_back(ids);
  const auto known = static_cast<int32_t>(origins.size());
  for (const auto& [first, second] : element_index_.back().duplicates()) {
    if (first >= known && second >= known) continue;
    const auto [here, other] = second < known ? std::pair(second, first) : std::pair(first, second);
    const std::string where = other < known ? " at " + source_.where(origins[other]) : "";
    source_.fail(origins[here], fmt::format("element {}: found another one with this number{}",
                                            ids[first], where));
  }
}

void Numbering::add_use(Scope& scope, const InstanceLine* line, int32_t index) {
  Use use;
  use.scope = &scope;
  use.index = index;
  if (line != nullptr) {
    use.name = line->name;
    use.shift = line->placement.shift;
    use.rotation = line->placement.rotation;
  }
  add_nodes(scope, use);
  add_cells(scope, use);
  if (line != nullptr) use_of_[folded(use.name)] = static_cast<int>(uses_.size());
  uses_.push_back(use);
}

void Numbering::add_nodes(Scope& scope, Use& use) {
  const bool main = use.name.empty();
  const NodeTable nodes = main ? std::move(scope.nodes) : scope.nodes;
  use.first_node = static_cast<int32_t>(node_ids_.size());
  if (nodes.ids.empty()) return;
  const auto [low, high] = std::minmax_element(nodes.ids.begin(), nodes.ids.end());
  const int64_t offset = offset_above(highest_node_, *low, *high);
  if (offset + *high > kMost ||
      static_cast<int64_t>(node_ids_.size() + nodes.ids.size()) > kMostNodes) {
    source_.fail(nodes.origins.front(), "found too many or too high node numbers");
  }
  use.node_offset = static_cast<int32_t>(offset);
  highest_node_ = std::max(highest_node_, use.node_offset + *high);
  if (main) node_ids_.reserve(node_ids_.size() + nodes.ids.size());
  for (const int32_t id : nodes.ids) node_ids_.push_back(id + use.node_offset);
  if (main) {
    xyz_.reserve(xyz_.size() + nodes.xyz.size());
    xyz_.insert(xyz_.end(), nodes.xyz.begin(), nodes.xyz.end());
    return;
  }
  for (size_t n = 0; n < nodes.ids.size(); ++n) {
    const Eigen::Vector3d x = use.rotation * Eigen::Vector3d(nodes.xyz.data() + 3 * n) + use.shift;
    xyz_.insert(xyz_.end(), x.data(), x.data() + 3);
  }
}

int32_t Numbering::row_of(const Use& use, int32_t id, Origin origin) const {
  const int32_t local = node_index_[use.index].find(id);
  if (local < 0) source_.fail(origin, fmt::format("found no node {}", id));
  return use.first_node + local;
}

// The use that a node's instance names: a number from 1 of Scope::other_instances, 0 for its own.
const Use& Numbering::use_of(const Scope& scope, const Use& own, int32_t instance,
                             Origin origin) const {
  if (instance == 0) return own;
  const std::string& name = scope.other_instances[instance - 1];
  const int use = find_use(name);
  if (use < 0) source_.fail(origin, fmt::format("found no instance {}", shown(name)));
  return uses_[use];
}

void Numbering::add_cells(Scope& scope, Use& use) {
  use.first_table = static_cast<int32_t>(tables_.size());
  use.first_cell = cells_;
  use.first_point = static_cast<int32_t>(points_.size());
  use.first_thin = static_cast<int32_t>(thin_.size());
  int32_t low = std::numeric_limits<int32_t>::max(), high = 0;
  int64_t count = 0;
  for (const CellTable& table : scope.cells) {
    for (const int32_t id : table.ids) low = std::min(low, id), high = std::max(high, id);
    count += static_cast<int64_t>(table.ids.size());
  }
  const int64_t offset = offset_above(highest_element_, low, high);
  if (offset + high > kMost || cells_ + count > kMostCells) {
    source_.fail(scope.origin, "found too many or too high element numbers");
  }
  use.element_offset = static_cast<int32_t>(offset);
  use.cells = static_cast<int32_t>(count);
  highest_element_ = std::max(highest_element_, use.element_offset + high);
  for (CellTable& from : scope.cells) {
    CellTable moved = use.name.empty() ? std::move(from) : from;
    FlatTable table{moved.name,
                    moved.type,
                    moved.formulation,
                    cells_,
                    std::move(moved.ids),
                    std::move(moved.nodes),
                    std::move(moved.origins)};
    const auto columns = static_cast<size_t>(traits(table.type).nodes);
    for (int32_t& id : table.ids) id += use.element_offset;
    for (size_t i = 0; i < table.nodes.size(); ++i) {
      table.nodes[i] = row_of(use, table.nodes[i], table.origins[i / columns]);
    }
    cells_ += static_cast<int32_t>(table.ids.size());
    tables_.push_back(std::move(table));
  }
  for (PointElement point : scope.points) {
    const auto row = [&](size_t end, int32_t id) {
      return row_of(use_of(scope, use, point.instance[end], point.origin), id, point.origin);
    };
    point.node = row(0, point.node);
    point.second = point.second == 0 ? -1 : row(1, point.second);
    points_.push_back(point);
  }
  for (ThinElement thin : scope.thin) {
    for (size_t i = 0; i < static_cast<size_t>(thin.count); ++i) {
      thin.nodes[i] = row_of(use, thin.nodes[i], thin.origin);
    }
    thin_.push_back(std::move(thin));
  }
}

int Numbering::find_use(const std::string& name) const {
  const auto use = use_of_.find(folded(name));
  return use != use_of_.end() ? use->second : -1;
}

std::string Numbering::public_name(size_t use, const std::string& name) const {
  std::string out = name;
  const Scope& main = deck_.model;
  const bool taken =
      main.node_sets.contains(folded(name)) || main.element_sets.contains(folded(name));
  if (use != main_use() && (deck_.instances.size() > 1 || taken)) {
    out = uses_[use].name + "." + name;
  }
  for (char& c : out) {
    if (c == '/' || (c >= 0 && c < ' ')) c = '_';
  }
  return out == "." ? "_" : out;
}

int32_t Numbering::find_node(size_t use, int32_t id) const {
  const int32_t local = node_index_[uses_[use].index].find(id);
  return local < 0 ? -1 : uses_[use].first_node + local;
}

std::vector<int32_t> Numbering::find_nodes(size_t use, const IdRange& range) const {
  const Use& at = uses_[use];
  std::vector<int32_t> rows;
  node_index_[at.index].for_each(range.first, range.last, range.step,
                                 [&](int32_t local) { rows.push_back(at.first_node + local); });
  return rows;
}

int32_t Numbering::element_at(const Use& use, int32_t local) const {
  if (local < 0) return -1;
  if (local < use.cells) return use.first_cell + local;
  const int32_t point = local - use.cells;
  const auto n_points = static_cast<int32_t>(use.scope->points.size());
  if (point < n_points) return cells_ + use.first_point + point;
  const int32_t thin = point - n_points;
  if (thin >= static_cast<int32_t>(use.scope->thin.size())) return kIgnored;
  return first_thin() + use.first_thin + thin;
}

const PointElement* Numbering::point(int32_t element) const {
  if (element < cells_ || element >= first_thin()) return nullptr;
  return &points_[element - cells_];
}

const ThinElement* Numbering::thin(int32_t element) const {
  if (element < first_thin() || element >= elements()) return nullptr;
  return &thin_[element - first_thin()];
}

std::vector<int32_t> Numbering::rows_of(int32_t element) const {
  if (const PointElement* one = point(element)) {
    return one->second < 0 ? std::vector{one->node} : std::vector{one->node, one->second};
  }
  if (const ThinElement* one = thin(element)) {
    return {one->nodes.begin(), one->nodes.begin() + one->count};
  }
  const auto rows = nodes_of(element);
  return {rows.begin(), rows.end()};
}

int32_t Numbering::find_element(size_t use, int32_t id) const {
  const Use& at = uses_[use];
  return element_at(at, element_index_[at.index].find(id));
}

std::vector<int32_t> Numbering::find_elements(size_t use, const IdRange& range) const {
  const Use& at = uses_[use];
  std::vector<int32_t> found;
  element_index_[at.index].for_each(range.first, range.last, range.step, [&](int32_t local) {
    const int32_t element = element_at(at, local);
    if (element != kIgnored) found.push_back(element);
  });
  return found;
}

const FlatTable& Numbering::table_of(int32_t cell) const {
  const auto after =
      std::upper_bound(tables_.begin(), tables_.end(), cell,
                       [](int32_t c, const FlatTable& table) { return c < table.first; });
  return *(after - 1);
}

std::span<const int32_t> Numbering::nodes_of(int32_t cell) const {
  const FlatTable& table = table_of(cell);
  const auto columns = static_cast<size_t>(traits(table.type).nodes);
  return std::span(table.nodes).subspan(static_cast<size_t>(cell - table.first) * columns, columns);
}

}  // namespace clatter::mesh::deck::abaqus
