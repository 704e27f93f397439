// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/sets.hpp"

#include <fmt/format.h>

#include <numeric>

#include "mesh/deck/node_sets.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// Deepest nesting of sets; far beyond real decks.
constexpr int kDeepest = 64;
// A gigabyte of members: small decks can repeat large sets very often.
constexpr size_t kMostMembers = size_t{1} << 28;

}  // namespace

const IdSets& Sets::sets_of(Kind kind, size_t use) const {
  const Scope& scope = *numbering_.uses()[use].scope;
  return kind == Kind::kNodes ? scope.node_sets : scope.element_sets;
}

// "instance.name" refers to a set of the instance.
Sets::Key Sets::key_of(size_t use, const std::string& name) const {
  for (size_t dot = name.find('.'); dot != std::string::npos; dot = name.find('.', dot + 1)) {
    const int instance = numbering_.find_use(name.substr(0, dot));
    if (instance >= 0) return {static_cast<size_t>(instance), folded(name.substr(dot + 1))};
  }
  return {use, folded(name)};
}

int32_t Sets::find(Kind kind, size_t use, int32_t id) const {
  return kind == Kind::kNodes ? numbering_.find_node(use, id) : numbering_.find_element(use, id);
}

const std::vector<int32_t>& Sets::nodes(size_t use, const std::string& name, Origin origin) {
  const bool here = sets_of(Kind::kNodes, use).contains(folded(name));
  return resolve(Kind::kNodes, here ? Key{use, folded(name)} : key_of(use, name), origin);
}

const std::vector<int32_t>& Sets::elements(size_t use, const std::string& name, Origin origin) {
  const bool here = sets_of(Kind::kElements, use).contains(folded(name));
  return resolve(Kind::kElements, here ? Key{use, folded(name)} : key_of(use, name), origin);
}

const std::vector<int32_t>& Sets::resolve(Kind kind, const Key& key, Origin origin) {
  const auto [at, is_new] = done_[static_cast<size_t>(kind)].try_emplace(key);
  Entry& entry = at->second;
  if (entry.done) return entry.members;
  const char* what = kind == Kind::kNodes ? "node set" : "element set";
  const IdSets& sets = sets_of(kind, key.first);
  const auto set = sets.find(key.second);
  if (set == sets.end()) {
    numbering_.source().fail(origin, fmt::format("found no {} {}", what, shown(key.second)));
  }
  if (!is_new) {
    numbering_.source().fail(origin, fmt::format("{} {} holds itself", what, set->second.name));
  }
  if (++depth_ > kDeepest) {
    numbering_.source().fail(origin, fmt::format("found more than {} nested sets", kDeepest));
  }
  std::vector<int32_t> members;
  for (const SetChunk& chunk : set->second.chunks) add_chunk(kind, key.first, chunk, members);
  --depth_;
  if (set->second.unsorted) entry.in_order = members;
  sort_unique(members);
  members.shrink_to_fit();
  members_ += members.size();
  if (members_ > kMostMembers) {
    numbering_.source().fail(origin,
                             fmt::format("all sets have more than {} members", kMostMembers));
  }
  entry.members = std::move(members);
  entry.done = true;
  return entry.members;
}

void Sets::add_chunk(Kind kind, size_t use, const SetChunk& chunk, std::vector<int32_t>& out) {
  if (!chunk.instance.empty()) {
    const int instance = numbering_.find_use(chunk.instance);
    if (instance < 0) {
      numbering_.source().fail(chunk.origin,
                               fmt::format("found no instance {}", shown(chunk.instance)));
    }
    use = static_cast<size_t>(instance);
  }
  add_rows(kind, use, chunk, out);
  add_numbers(kind, use, chunk, out);
  compact(out);
  for (const IdRange& range : chunk.ranges) {
    add_range(kind, use, range, out);
    compact(out);
  }
  for (const auto& [name, origin] : chunk.names) {
    const std::string quoted = '"' + name + '"';
    const auto other = at(kind, Fields(quoted, numbering_.source(), origin), 0, use);
    out.insert(out.end(), other.begin(), other.end());
    compact(out);
  }
  for (const std::string& name : chunk.elements_of) {
    for (const int32_t element : elements(use, name, chunk.origin)) {
      const auto rows = numbering_.rows_of(element);
      out.insert(out.end(), rows.begin(), rows.end());
    }
  }
}

// Repeated ranges take no more memory than a few complete sets, and linear time in their members.
void Sets::compact(std::vector<int32_t>& out) const {
  const size_t all =
      static_cast<size_t>(numbering_.nodes()) + static_cast<size_t>(numbering_.elements());
  if (out.size() <= 4 * all + 4096) return;
  std::vector<bool> is_member(all, false);
  for (const int32_t member : out) is_member[member] = true;
  out.clear();
  for (size_t member = 0; member < all; ++member) {
    if (is_member[member]) out.push_back(static_cast<int32_t>(member));
  }
}

// Rows of *NODE, NSET= or *ELEMENT, ELSET=. A node that is given twice counts as its first row.
void Sets::add_rows(Kind kind, size_t use, const SetChunk& chunk, std::vector<int32_t>& out) const {
  const Use& at = numbering_.uses()[use];
  for (int32_t row = chunk.row_begin; row < chunk.row_end; ++row) {
    if (kind == Kind::kElements) {
      const size_t table = static_cast<size_t>(at.first_table + chunk.table);
      out.push_back(numbering_.tables()[table].first + row);
    } else {
      const int32_t id = numbering_.node_ids()[at.first_node + row];
      out.push_back(numbering_.find_node(use, id - at.node_offset));
    }
  }
}

void Sets::add_numbers(Kind kind, size_t use, const SetChunk& chunk,
                       std::vector<int32_t>& out) const {
  size_t line = 0;
  for (size_t i = 0; i < chunk.ids.size(); ++i) {
    while (line + 1 < chunk.id_lines.size() && chunk.id_lines[line + 1].first <= i) ++line;
    const int32_t member = find(kind, use, chunk.ids[i]);
    if (member == -1) {
      numbering_.source().fail(
          chunk.id_lines[line].second,
          fmt::format("found no {} {}", kind == Kind::kNodes ? "node" : "element", chunk.ids[i]));
    }
    if (member >= 0) out.push_back(member);
  }
}

// Missing numbers within a range are no error: programs write ranges over gaps.
void Sets::add_range(Kind kind, size_t use, const IdRange& range, std::vector<int32_t>& out) const {
  const auto found = kind == Kind::kNodes ? numbering_.find_nodes(use, range)
                                          : numbering_.find_elements(use, range);
  out.insert(out.end(), found.begin(), found.end());
}

std::vector<int32_t> Sets::at(Kind kind, const Fields& fields, size_t i, size_t use) {
  const char* what = kind == Kind::kNodes ? "a node or node set" : "an element or element set";
  const std::string text = fields.word(i, what);
  const Key key = key_of(use, text);
  const auto id = to_integer(sets_of(kind, use).contains(folded(text)) ? text : key.second);
  if (!id) {
    return kind == Kind::kNodes ? nodes(use, text, fields.origin())
                                : elements(use, text, fields.origin());
  }
  const int32_t member = find(kind, key.first, *id);
  if (member == -1) {
    fields.fail(fmt::format("found no {} {}", kind == Kind::kNodes ? "node" : "element", text));
  }
  if (member < 0) return {};
  return {member};
}

std::vector<int32_t> Sets::nodes_in_order(const Fields& fields, size_t i, size_t use) {
  std::vector<int32_t> rows = nodes_at(fields, i, use);
  const std::string text = fields.word(i, "a node or node set");
  const bool here = sets_of(Kind::kNodes, use).contains(folded(text));
  const auto known = done_[0].find(here ? Key{use, folded(text)} : key_of(use, text));
  return known != done_[0].end() && !known->second.in_order.empty() ? known->second.in_order : rows;
}

std::vector<int32_t> Sets::nodes_at(const Fields& fields, size_t i, size_t use) {
  return at(Kind::kNodes, fields, i, use);
}

std::vector<int32_t> Sets::elements_at(const Fields& fields, size_t i, size_t use) {
  return at(Kind::kElements, fields, i, use);
}

std::vector<int32_t> Sets::elements_or_all(const Fields& fields, size_t i, size_t use) {
  if (!fields.blank(i)) return elements_at(fields, i, use);
  std::vector<int32_t> all(static_cast<size_t>(numbering_.elements()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

int32_t Sets::node_at(const Fields& fields, size_t i, size_t use) {
  const auto rows = nodes_at(fields, i, use);
  if (rows.size() != 1) {
    fields.fail(
        fmt::format("found {} nodes in {}, expected one", rows.size(), shown(fields.text(i))));
  }
  return rows.front();
}

int32_t Sets::node_named(const std::string& text, size_t use, Origin origin) {
  const std::string quoted = '"' + text + '"';
  return node_at(Fields(quoted, numbering_.source(), origin), 0, use);
}

}  // namespace clatter::mesh::deck::abaqus
