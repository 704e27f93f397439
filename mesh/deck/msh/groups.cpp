// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/msh/groups.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "core/base/error.hpp"

namespace clatter::mesh {
namespace {

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

constexpr const char* kKinds[] = {"point", "curve", "surface", "volume"};

}  // namespace

MshGroups::MshGroups(std::string path, const MshScan& scan, const std::vector<std::string>& ignore)
    : path_(std::move(path)), scan_(scan) {
  for (const std::string& name : ignore) ignore_.insert(upper(name));
}

void MshGroups::fail(const std::string& what) const {
  throw InputError(fmt::format("{}: {}", path_, what));
}

bool MshGroups::ignores(const std::string& name) const { return ignore_.contains(upper(name)); }

std::vector<int> MshGroups::numbers_of(const MshElements& elements, size_t e) const {
  if (scan_.version != 2) return elements.groups;
  const auto found = scan_.group_of.find(elements.tags[e]);
  if (found == scan_.group_of.end())
    fail(fmt::format("Gmsh returns element {}, which is not in the file", elements.tags[e]));
  if (found->second == 0) return {};
  return {found->second};
}

std::string MshGroups::name_of(int dim, int number) const {
  const auto found = names_.find({dim, number});
  return found != names_.end() ? found->second : fmt::format("{}_{}", kKinds[dim], number);
}

std::string MshGroups::names_present(int dim) const {
  std::vector<std::string> names;
  for (const auto& [d, number] : used_)
    if (d == dim) names.push_back(name_of(d, number));
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

void MshGroups::learn(const MshContents& contents) {
  for (const MshGroupName& group : scan_.names) {
    if (group.name.empty() || group.name.find('/') != std::string::npos)
      fail(fmt::format("found the group name '{}', expected one without '/'", group.name));
    names_[{group.dim, group.number}] = group.name;
  }
  for (const MshElements& elements : contents.elements)
    for (size_t e = 0; e < elements.tags.size(); ++e)
      for (int number : numbers_of(elements, e)) used_.insert({elements.dim, number});
  std::map<std::pair<int, std::string>, int> number_of;
  for (const auto& [dim, number] : used_) {
    const auto [at, is_new] = number_of.emplace(std::pair(dim, name_of(dim, number)), number);
    if (!is_new && !ignores(at->first.second))
      fail(fmt::format("found two groups of dimension {} with the name '{}': {} and {}", dim,
                       at->first.second, at->second, number));
  }
  for (const auto& [key, name] : names_) {
    if (used_.contains(key) || ignores(name)) continue;
    fail(
        fmt::format("group '{}' (dimension {}, number {}) has no element; the groups of that "
                    "dimension that have some: {}; --ignore \"{}\" skips it",
                    name, key.first, key.second, names_present(key.first), name));
  }
}

bool MshGroups::skips(const MshElements& elements) {
  if (!ignores(elements.kind)) return false;
  if (counted_kinds_.insert(&elements).second)
    ignored_[elements.kind] += static_cast<int64_t>(elements.tags.size());
  return true;
}

std::vector<std::string> MshGroups::of(const MshElements& elements, size_t e) {
  std::vector<std::string> names;
  bool ignored_group = false;
  for (int number : numbers_of(elements, e)) {
    const std::string name = name_of(elements.dim, number);
    if (ignores(name)) {
      ignored_group = true;
      if (counted_elements_.insert(elements.tags[e]).second) ++ignored_[name];
    } else {
      names.push_back(name);
    }
  }
  if (names.empty() && !ignored_group && counted_elements_.insert(elements.tags[e]).second)
    ++ignored_[elements.kind + " in no group"];
  return names;
}

std::optional<int> MshGroups::region_of(const MshElements& elements, size_t e) {
  const bool has_groups =
      std::any_of(used_.begin(), used_.end(), [](const auto& group) { return group.first == 3; });
  if (!has_groups) return 0;
  std::vector<int> numbers;
  bool ignored_group = false;
  for (int number : numbers_of(elements, e)) {
    const bool ignored = ignores(name_of(3, number));
    if (!ignored) numbers.push_back(number);
    ignored_group = ignored_group || ignored;
  }
  const std::string what = fmt::format("element {} ({})", elements.tags[e], elements.kind);
  if (numbers.size() > 1)
    fail(
        fmt::format("{} is in the groups '{}' and '{}', expected one: a region has one material; "
                    "--ignore one of them",
                    what, name_of(3, numbers[0]), name_of(3, numbers[1])));
  if (numbers.size() == 1) return numbers[0];
  if (!ignored_group && !ignores("NO GROUP"))
    fail(
        fmt::format("{} is in no group of solids, expected one of: {}; --ignore \"NO GROUP\" "
                    "leaves such cells out",
                    what, names_present(3)));
  ++ignored_[ignored_group ? "cells of ignored groups" : "NO GROUP"];
  return std::nullopt;
}

std::string MshGroups::region_name(int group) const {
  return group == 0 ? "solid" : name_of(3, group);
}

}  // namespace clatter::mesh
