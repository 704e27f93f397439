// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/msh/unv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <unordered_map>

#include "core/base/error.hpp"
#include "mesh/deck/msh/text_lines.hpp"
#include "mesh/deck/unv_kinds.hpp"

namespace clatter::mesh {
namespace {

constexpr int64_t kMostUnvNodes = 60;  // of an element
constexpr size_t kInt = 10;            // columns of an integer
constexpr int64_t kMostProperty = 1 << 30;
constexpr int kFirstProperty = 1 << 24;  // numbers of groups that are properties

struct UnvElement {
  size_t tag;
  int descriptor, property;
  std::vector<size_t> nodes;
};

class UnvReader {
 public:
  UnvReader(std::istream& file, const std::string& name, const std::vector<std::string>& ignore)
      : lines_(file, name), name_(name), ignore_(ignore.begin(), ignore.end()) {
    out_.scan.version = 4;
  }

  ForeignMesh run() {
    while (lines_.next()) {
      if (lines_.trimmed_text() != "-1") continue;
      lines_.require("the number of a dataset");
      read_dataset(std::string(lines_.trimmed_text()));
    }
    if (elements_.empty()) fail("found no elements (dataset 2412), expected some");
    add_elements();
    for (const size_t node : group_nodes_)
      tables_.add(0, kPoint, "Point", groups_of_node_.at(node), node, {node});
    out_.contents.elements = tables_.finish();
    out_.scan.nodes = static_cast<int64_t>(out_.contents.node_tags.size());
    return std::move(out_);
  }

 private:
  static constexpr int kPoint = 15, kLine2 = 1, kLine3 = 8;  // Gmsh's types

  bool at_end() const { return lines_.trimmed_text() == "-1"; }

  void read_dataset(const std::string& dataset) {
    static const std::set<std::string> kGroups = {"2417", "2429", "2430", "2432",
                                                  "2435", "2452", "2467", "2477"};
    if (dataset == "2411") return read_nodes();
    if (dataset == "2412") return read_elements();
    if (kGroups.contains(dataset)) return read_groups(dataset < "2435");
    if (dataset == "15" || dataset == "780" || dataset == "781")
      lines_.fail(
          fmt::format("found dataset {}, an old form of nodes or elements; expected 2411 and "
                      "2412, which newer exports write",
                      dataset));
    skip_dataset();
  }

  void skip_dataset() {
    while (lines_.next())
      if (at_end()) return;
  }

  void read_nodes() {
    while (true) {
      lines_.require("a node or -1");
      if (at_end()) return;
      out_.contents.node_tags.push_back(
          static_cast<size_t>(lines_.integer(0, kInt, "the number of a node")));
      lines_.require("coordinates");
      for (size_t k = 0; k < 3; ++k)
        out_.contents.coordinates.push_back(lines_.real(25 * k, 25, "a coordinate"));
    }
  }

  void read_elements() {
    while (true) {
      lines_.require("an element or -1");
      if (at_end()) return;
      UnvElement element;
      element.tag = static_cast<size_t>(lines_.integer(0, kInt, "the number of an element"));
      element.descriptor = static_cast<int>(lines_.integer(kInt, kInt, "its descriptor"));
      const int64_t property = lines_.integer(2 * kInt, kInt, "its property");
      if (property < 0 || property > kMostProperty)
        lines_.fail(
            fmt::format("found the property {}, expected 0 to {}", property, kMostProperty));
      element.property = static_cast<int>(property);
      const int64_t count = lines_.integer(5 * kInt, kInt, "the number of its nodes");
      if (count < 0 || count > kMostUnvNodes)
        lines_.fail(
            fmt::format("found {} nodes of an element, expected at most {}", count, kMostUnvNodes));
      if (deck::unv_line_nodes(element.descriptor) > 0) lines_.require("the line of a beam");
      for (int64_t i = 0; i < count; ++i) {
        if (i % 8 == 0) lines_.require("nodes of an element");
        element.nodes.push_back(static_cast<size_t>(
            lines_.integer(static_cast<size_t>(i % 8) * kInt, kInt, "the number of a node")));
      }
      elements_.push_back(std::move(element));
    }
  }

  // Members in pairs of a kind and a number; newer datasets have two more fields for each.
  void read_groups(bool old) {
    const size_t fields = old ? 2 : 4, each_line = old ? 4 : 2;
    while (true) {
      lines_.require("a group or -1");
      if (at_end()) return;
      const int64_t count = lines_.integer(old ? 5 * kInt : 7 * kInt, kInt, "how many members");
      lines_.require("the name of a group");
      const int group = ++groups_;
      names_[group] = std::string(lines_.trimmed_text());
      for (int64_t i = 0; i < count; ++i) {
        const size_t at = static_cast<size_t>(i) % each_line * fields * kInt;
        if (at == 0) lines_.require("members of a group");
        const int64_t kind = lines_.integer(at, kInt, "the kind of a member");
        const auto tag = static_cast<size_t>(lines_.integer(at + kInt, kInt, "its number"));
        if (kind == 8) groups_of_element_[tag].push_back(group);
        if (kind == 7) add_group_node(tag, group);
        if (kind != 7 && kind != 8) ++out_.ignored["members of groups other than nodes, elements"];
      }
    }
  }

  void add_group_node(size_t tag, int group) {
    std::vector<int>& groups = groups_of_node_[tag];
    if (groups.empty()) group_nodes_.push_back(tag);
    groups.push_back(group);
    name_group(0, group);
  }

  void name_group(int dim, int group) {
    if (named_.insert({dim, group}).second) out_.scan.names.push_back({dim, group, names_[group]});
  }

  void add_elements() {
    bool solids_in_groups = false;
    for (const UnvElement& element : elements_)
      solids_in_groups = solids_in_groups || (deck::unv_cell(element.descriptor) &&
                                              groups_of_element_.contains(element.tag));
    for (const UnvElement& element : elements_) add(element, solids_in_groups);
  }

  void add(const UnvElement& element, bool solids_in_groups) {
    const auto found = groups_of_element_.find(element.tag);
    std::vector<int> groups =
        found == groups_of_element_.end() ? std::vector<int>() : found->second;
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    if (const auto cell = deck::unv_cell(element.descriptor)) {
      if (!solids_in_groups) {
        groups = {kFirstProperty + element.property};
        names_[groups.front()] = fmt::format("property_{}", element.property);
      }
      return add(element, 3, traits(*cell).gmsh_type, deck::unv_kind(*cell).nodes, groups);
    }
    if (const auto face = deck::unv_face(element.descriptor)) {
      const auto order = deck::unv_kind(*face).nodes;
      return add(element, 2, traits(*face).gmsh_type, order, groups);
    }
    if (const int nodes = deck::unv_line_nodes(element.descriptor); nodes > 0) {
      static constexpr int kOrder2[] = {0, 1}, kOrder3[] = {0, 2, 1};
      const auto order = nodes == 2 ? std::span<const int>(kOrder2) : std::span<const int>(kOrder3);
      return add(element, 1, nodes == 2 ? kLine2 : kLine3, order, groups);
    }
    const std::string kind = std::to_string(element.descriptor);
    if (!ignore_.contains(kind))
      fail(
          fmt::format("element {} has the descriptor {}, expected solids 111 to 118, shells "
                      "or beams; --ignore {} leaves out all of these, and their stiffness and "
                      "mass: [[spring]] and [[point_mass]] of the recipe replace them",
                      element.tag, kind, kind));
    ++out_.ignored["elements of descriptor " + kind];
  }

  void add(const UnvElement& element, int dim, int gmsh_type, std::span<const int> order,
           const std::vector<int>& groups) {
    if (element.nodes.size() != order.size())
      fail(fmt::format("element {} of descriptor {} has {} nodes, expected {}", element.tag,
                       element.descriptor, element.nodes.size(), order.size()));
    std::vector<size_t> nodes(order.size());
    for (size_t i = 0; i < order.size(); ++i) nodes[order[i]] = element.nodes[i];
    for (const int group : groups) name_group(dim, group);
    tables_.add(dim, gmsh_type, std::to_string(element.descriptor), groups, element.tag, nodes);
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}: {}", name_, message));
  }

  TextLines lines_;
  std::string name_;
  std::set<std::string> ignore_;
  ForeignMesh out_;
  ElementTables tables_;
  std::vector<UnvElement> elements_;
  int groups_ = 0;
  std::map<int, std::string> names_;
  std::set<std::pair<int, int>> named_;
  std::unordered_map<size_t, std::vector<int>> groups_of_element_, groups_of_node_;
  std::vector<size_t> group_nodes_;  // in the order of the file
};

}  // namespace

ForeignMesh read_unv(const std::filesystem::path& path, const std::vector<std::string>& ignore) {
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: file not found", path.string()));
  return read_unv(file, path.string(), ignore);
}

ForeignMesh read_unv(std::istream& file, const std::string& name,
                     const std::vector<std::string>& ignore) {
  return UnvReader(file, name, ignore).run();
}

}  // namespace clatter::mesh
