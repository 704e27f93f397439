// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Resolves numbers and set names of nodes and elements.
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/deck/abaqus/numbering.hpp"

namespace clatter::mesh::deck::abaqus {

/// Sets by name, resolved on first use and kept. A name is one of the scope, or "instance.name"
/// from outside; a number is one of the scope, or "instance.number".
class Sets {
 public:
  explicit Sets(const Numbering& numbering) : numbering_(numbering) {}

  /// Rows of the nodes of a set, ascending. InputError at `origin` for an unknown name, at the
  /// set's line for unknown numbers and for sets that contain themselves.
  const std::vector<int32_t>& nodes(size_t use, const std::string& name, Origin origin);
  /// The same for elements; those of one node follow the cells (Numbering::points).
  const std::vector<int32_t>& elements(size_t use, const std::string& name, Origin origin);

  /// Rows of the nodes of field `i` where sets are paired: those of an UNSORTED set in its order.
  std::vector<int32_t> nodes_in_order(const Fields& fields, size_t i, size_t use);
  /// The members of field `i`: a number or the name of a set.
  std::vector<int32_t> nodes_at(const Fields& fields, size_t i, size_t use);
  std::vector<int32_t> elements_at(const Fields& fields, size_t i, size_t use);
  /// The same; all elements of the model where the field is empty.
  std::vector<int32_t> elements_or_all(const Fields& fields, size_t i, size_t use);
  /// One node: its number, or the name of a set of one node.
  int32_t node_at(const Fields& fields, size_t i, size_t use);
  int32_t node_named(const std::string& text, size_t use, Origin origin);

 private:
  enum class Kind { kNodes, kElements };
  using Key = std::pair<size_t, std::string>;
  struct Entry {
    std::vector<int32_t> members;
    std::vector<int32_t> in_order;  // of an UNSORTED set
    bool done = false;
  };

  Key key_of(size_t use, const std::string& name) const;
  const IdSets& sets_of(Kind kind, size_t use) const;
  const std::vector<int32_t>& resolve(Kind kind, const Key& key, Origin origin);
  void add_chunk(Kind kind, size_t use, const SetChunk& chunk, std::vector<int32_t>& out);
  void add_numbers(Kind kind, size_t use, const SetChunk& chunk, std::vector<int32_t>& out) const;
  void add_range(Kind kind, size_t use, const IdRange& range, std::vector<int32_t>& out) const;
  void add_rows(Kind kind, size_t use, const SetChunk& chunk, std::vector<int32_t>& out) const;
  int32_t find(Kind kind, size_t use, int32_t id) const;
  std::vector<int32_t> at(Kind kind, const Fields& fields, size_t i, size_t use);
  void compact(std::vector<int32_t>& out) const;

  const Numbering& numbering_;
  std::map<Key, Entry> done_[2];
  int depth_ = 0;
  size_t members_ = 0;  // of all sets
};

}  // namespace clatter::mesh::deck::abaqus
