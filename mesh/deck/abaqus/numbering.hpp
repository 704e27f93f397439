// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// All nodes and elements of the model in one numbering: parts copied into their instances, deck
// numbers replaced by rows.
#include <Eigen/Core>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "mesh/deck/abaqus/raw_deck.hpp"
#include "mesh/deck/id_index.hpp"

namespace clatter::mesh::deck::abaqus {

/// One use of a scope. Its elements are numbered: cells in the order of its tables, then points,
/// then thin ones, then those that the user ignores.
struct Use {
  const Scope* scope = nullptr;
  std::string name;  // of the instance; empty: the flat deck or the assembly
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  int32_t index = 0;  // of node_index_ and element_index_
  int32_t first_node = 0, first_table = 0, first_cell = 0, first_point = 0;
  int32_t first_thin = 0;
  int32_t node_offset = 0, element_offset = 0;  // added to the deck's numbers
  int32_t cells = 0;                            // of this use
};

/// Cells of one table of one use; `nodes` are rows.
struct FlatTable {
  std::string name;
  CellType type = CellType::kTet4;
  Formulation formulation = Formulation::kDefault;
  int32_t first = 0;  // number of its first cell among all
  std::vector<int32_t> ids, nodes;
  std::vector<Origin> origins;
};

class Numbering {
 public:
  /// Consumes the tables of the deck; cards and sets stay. InputError for numbers with two
  /// meanings, for missing nodes and for instances of unknown parts.
  Numbering(RawDeck deck, const Source& source);
  Numbering(const Numbering&) = delete;
  Numbering& operator=(const Numbering&) = delete;

  const Source& source() const { return source_; }
  /// Instances in the order of the deck, then the flat deck or the assembly.
  const std::vector<Use>& uses() const { return uses_; }
  size_t main_use() const { return uses_.size() - 1; }
  /// Index of an instance by name; -1 if there is none.
  int find_use(const std::string& name) const;
  /// The public name of `name` in a use: the same, prefixed with "instance." if there are several
  /// instances or the assembly has that name too. Characters that HDF5 does not allow become _.
  std::string public_name(size_t use, const std::string& name) const;

  int32_t nodes() const { return static_cast<int32_t>(node_ids_.size()); }
  const std::vector<int32_t>& node_ids() const { return node_ids_; }
  int32_t highest_node() const { return highest_node_; }
  int32_t highest_element() const { return highest_element_; }
  const std::vector<double>& coordinates() const { return xyz_; }
  Eigen::Vector3d at(int32_t row) const { return Eigen::Vector3d(xyz_.data() + 3 * int64_t{row}); }
  /// Row of node `id` of a use; -1 if there is none.
  int32_t find_node(size_t use, int32_t id) const;
  std::vector<int32_t> find_nodes(size_t use, const IdRange& range) const;

  int32_t cells() const { return cells_; }
  const std::vector<FlatTable>& tables() const { return tables_; }
  const FlatTable& table_of(int32_t cell) const;
  /// Rows of the nodes of a cell, Abaqus order.
  std::span<const int32_t> nodes_of(int32_t cell) const;
  /// Elements of one node or two; `node` is a row, and `second`, or -1. Their numbers follow those
  /// of the cells.
  const std::vector<PointElement>& points() const { return points_; }
  /// The point or thin element with that number among all elements; null for others.
  const PointElement* point(int32_t element) const;
  const ThinElement* thin(int32_t element) const;
  /// Their nodes are rows.
  const std::vector<ThinElement>& thin() const { return thin_; }
  /// The number of thin element 0 among all.
  int32_t first_thin() const { return cells_ + static_cast<int32_t>(points_.size()); }
  /// Of cells, points and thin ones.
  int32_t elements() const { return first_thin() + static_cast<int32_t>(thin_.size()); }
  /// Rows of the nodes of any element.
  std::vector<int32_t> rows_of(int32_t element) const;
  /// Element `id` of a use: a cell, cells() + a point, first_thin() + a thin one, kIgnored for an
  /// ignored one, or -1.
  int32_t find_element(size_t use, int32_t id) const;
  /// Without those that the user ignores.
  std::vector<int32_t> find_elements(size_t use, const IdRange& range) const;
  static constexpr int32_t kIgnored = -2;

 private:
  void add_use(Scope& scope, const InstanceLine* line, int32_t index);
  void add_nodes(Scope& scope, Use& use);
  void add_cells(Scope& scope, Use& use);
  void index_scope(const Scope& scope);
  const Use& use_of(const Scope& scope, const Use& own, int32_t instance, Origin origin) const;
  int32_t row_of(const Use& use, int32_t id, Origin origin) const;
  int32_t element_at(const Use& use, int32_t local) const;

  const Source& source_;
  RawDeck deck_;
  std::vector<IdIndex> node_index_, element_index_;
  std::vector<Use> uses_;
  std::map<std::string, int> use_of_;  // by folded name
  std::vector<int32_t> node_ids_;
  std::vector<double> xyz_;
  std::vector<FlatTable> tables_;
  std::vector<PointElement> points_;
  std::vector<ThinElement> thin_;
  int32_t cells_ = 0;
  int32_t highest_node_ = 0, highest_element_ = 0;
};

}  // namespace clatter::mesh::deck::abaqus
