// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Which DoF depends on which others, and by which relation. Conflicts are reported, not resolved.
#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

namespace clatter::assembly {

/// Collects all dependences before anything is eliminated.
class ConstraintGraph {
 public:
  /// `name` returns the name of a DoF for messages.
  explicit ConstraintGraph(std::function<std::string(int32_t)> name) : name_(std::move(name)) {}

  /// A relation "file:line: coupling foot"; returns its number.
  int add_relation(const std::string& where);

  /// DoF `dof` depends on the DoFs `on` by `relation`. `may_be_held`: the dof is the reference of a
  /// distributing coupling, where displacements of the face are eliminated and a support is no
  /// conflict.
  /// InputError naming both relations when it already depends, is held, or must stay a coordinate.
  void depend(int32_t dof, const std::vector<int32_t>& on, int relation, bool may_be_held = false);

  /// `dof` is held by a support, or must remain a coordinate (a sensor), because of `relation`.
  void hold(int32_t dof, int relation);
  void keep(int32_t dof, int relation);

  /// True when a support holds the DoF.
  bool is_held(int32_t dof) const { return held_.contains(dof); }
  /// True when the DoF depends on others.
  bool depends(int32_t dof) const { return links_.contains(dof); }
  /// The relation by which the DoF depends on others.
  const std::string& relation_of(int32_t dof) const;

  /// Dependent DoFs, each after those that it depends on. InputError listing the relations of a
  /// cycle.
  std::vector<int32_t> order() const;

 private:
  struct Link {
    int relation;
    bool may_be_held;
    std::vector<int32_t> on;
  };
  [[noreturn]] void clash(int32_t dof, int relation, const char* verb, int other,
                          const char* other_verb) const;
  [[noreturn]] void refuse_cycle(const std::vector<int32_t>& path, int32_t again) const;

  std::function<std::string(int32_t)> name_;
  std::vector<std::string> relations_;
  std::vector<int32_t> dependents_;  // in order of addition
  std::unordered_map<int32_t, Link> links_;
  std::unordered_map<int32_t, int> held_, kept_;
};

}  // namespace clatter::assembly
