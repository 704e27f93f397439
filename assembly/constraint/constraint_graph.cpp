// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/constraint_graph.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"

namespace clatter::assembly {

int ConstraintGraph::add_relation(const std::string& where) {
  relations_.push_back(where);
  return static_cast<int>(relations_.size()) - 1;
}

void ConstraintGraph::clash(int32_t dof, int relation, const char* verb, int other,
                            const char* other_verb) const {
  const auto word = [this](int r) { return relations_[r]; };
  throw InputError(fmt::format("{}: found {}, which it {} and which {} {}, expected one of them",
                               word(relation), name_(dof), verb, word(other), other_verb));
}

void ConstraintGraph::depend(int32_t dof, const std::vector<int32_t>& on, int relation,
                             bool may_be_held) {
  const auto old = links_.find(dof);
  if (old != links_.end())
    clash(dof, relation, "makes dependent", old->second.relation, "makes dependent too");
  const auto held = held_.find(dof);
  if (held != held_.end() && !may_be_held)
    clash(dof, relation, "makes dependent", held->second, "holds");
  const auto kept = kept_.find(dof);
  if (kept != kept_.end() && !may_be_held)
    clash(dof, relation, "makes dependent", kept->second, "keeps as a coordinate");
  links_[dof] = {relation, may_be_held, on};
  dependents_.push_back(dof);
}

void ConstraintGraph::hold(int32_t dof, int relation) {
  const auto link = links_.find(dof);
  if (link != links_.end() && !link->second.may_be_held)
    clash(dof, relation, "holds", link->second.relation, "makes dependent");
  const auto kept = kept_.find(dof);
  if (kept != kept_.end()) clash(dof, relation, "holds", kept->second, "keeps as a coordinate");
  held_.emplace(dof, relation);
}

void ConstraintGraph::keep(int32_t dof, int relation) {
  const auto link = links_.find(dof);
  if (link != links_.end() && !link->second.may_be_held)
    clash(dof, relation, "keeps as a coordinate", link->second.relation, "makes dependent");
  const auto held = held_.find(dof);
  if (held != held_.end()) clash(dof, relation, "keeps as a coordinate", held->second, "holds");
  kept_.emplace(dof, relation);
}

const std::string& ConstraintGraph::relation_of(int32_t dof) const {
  return relations_[links_.at(dof).relation];
}

void ConstraintGraph::refuse_cycle(const std::vector<int32_t>& path, int32_t again) const {
  std::string text;
  for (auto at = std::find(path.begin(), path.end(), again); at != path.end(); ++at)
    text += fmt::format("{} ({}) depends on ", name_(*at), relation_of(*at));
  throw InputError(fmt::format("{}: found a cycle: {}{}; expected none", relation_of(again), text,
                               name_(again)));
}

std::vector<int32_t> ConstraintGraph::order() const {
  enum class Mark { kOpen, kDone };
  std::unordered_map<int32_t, Mark> marks;
  std::vector<int32_t> ordered;
  for (const int32_t root : dependents_) {
    if (marks.contains(root)) continue;
    std::vector<int32_t> path = {root};  // the chain of unfinished DoFs
    std::vector<size_t> next = {0};      // next entry of each one's list
    marks[root] = Mark::kOpen;
    while (!path.empty()) {
      const std::vector<int32_t>& on = links_.at(path.back()).on;
      if (next.back() == on.size()) {
        marks[path.back()] = Mark::kDone;
        ordered.push_back(path.back());
        path.pop_back();
        next.pop_back();
        continue;
      }
      const int32_t to = on[next.back()++];
      if (!links_.contains(to)) continue;
      const auto mark = marks.find(to);
      if (mark == marks.end()) {
        marks[to] = Mark::kOpen;
        path.push_back(to);
        next.push_back(0);
      } else if (mark->second == Mark::kOpen) {
        refuse_cycle(path, to);
      }
    }
  }
  return ordered;
}

}  // namespace clatter::assembly
