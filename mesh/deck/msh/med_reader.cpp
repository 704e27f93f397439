// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/msh/med_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <span>

#include "core/base/error.hpp"
#include "core/base/h5_file.hpp"
#include "core/mesh/cell.hpp"

namespace clatter::mesh {
namespace {

// An element type: Gmsh's number, and p with a_med[i] = a_ours[p[i]].
struct MedKind {
  int dim, gmsh_type;
  std::vector<int> order;
};

std::vector<int> identity(int count) {
  std::vector<int> order(static_cast<size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

std::optional<MedKind> med_kind(const std::string& name) {
  for (int t = 0; t < kCellTypes; ++t) {
    const CellTraits& cell = traits(static_cast<CellType>(t));
    if (cell.med_name == name)
      return MedKind{3, cell.gmsh_type, {cell.to_med.begin(), cell.to_med.end()}};
  }
  for (int t = 0; t < kFaceTypes; ++t) {
    const FaceTraits& face = traits(static_cast<FaceType>(t));
    if (face.med_name == name) return MedKind{2, face.gmsh_type, identity(face.nodes)};
  }
  if (name == "SE2") return MedKind{1, 1, identity(2)};
  if (name == "SE3") return MedKind{1, 8, identity(3)};
  if (name == "PO1") return MedKind{0, 15, identity(1)};
  return std::nullopt;
}

class MedReader {
 public:
  MedReader(const std::filesystem::path& path, const std::vector<std::string>& ignore)
      : path_(path.string()), file_(H5File::open(path)), ignore_(ignore.begin(), ignore.end()) {
    out_.scan.version = 4;
  }

  ForeignMesh run() {
    const auto meshes = file_.list("ENS_MAA");
    if (meshes.size() != 1)
      fail(fmt::format("found {} meshes ({}), expected one", meshes.size(),
                       fmt::join(meshes, ", ")));
    const std::string root = "ENS_MAA/" + meshes.front();
    const auto steps = file_.list(root);
    if (steps.empty() || file_.get_int(root, "ESP") != 3)
      fail(fmt::format("mesh {}: expected one in three dimensions", meshes.front()));
    step_ = root + "/" + steps.front();
    read_families("FAS/" + meshes.front() + "/ELEME", element_groups_);
    read_families("FAS/" + meshes.front() + "/NOEUD", node_groups_);
    read_nodes();
    for (const std::string& type : file_.list(step_ + "/MAI")) read_elements(type);
    if (elements_ == 0) fail("found no elements, expected some");
    out_.contents.elements = tables_.finish();
    if (!numbered_) number_elements();
    for (const auto& [key, name] : names_) out_.scan.names.push_back({key.first, key.second, name});
    return std::move(out_);
  }

 private:
  using Families = std::map<int32_t, std::vector<int>>;  // numbers of their groups

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}: {}", path_, message));
  }

  void read_families(const std::string& folder, Families& families) {
    for (const std::string& family : file_.list(folder)) {
      const std::string at = folder + "/" + family;
      std::vector<int>& groups = families[static_cast<int32_t>(file_.get_int(at, "NUM"))];
      if (!file_.has(at + "/GRO/NOM")) continue;
      for (const std::string& name : file_.read_byte_texts(at + "/GRO/NOM"))
        groups.push_back(
            group_number_.emplace(name, static_cast<int>(group_number_.size()) + 1).first->second);
      std::sort(groups.begin(), groups.end());
      groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    }
  }

  // Names each group in the dimensions in which it has members.
  std::vector<int> groups_of(const Families& families, int32_t family, int dim) {
    const auto found = families.find(family);
    if (found == families.end()) return {};
    if (!named_.insert({family, dim}).second) return found->second;
    for (const auto& [name, number] : group_number_)
      if (std::binary_search(found->second.begin(), found->second.end(), number))
        names_[{dim, number}] = name;
    return found->second;
  }

  std::vector<int32_t> list(const std::string& name, size_t count) const {
    if (!file_.has(name)) return {};
    std::vector<int32_t> values = file_.read_ints(name);
    if (values.size() != count)
      fail(fmt::format("{}: found {} values, expected {}", name, values.size(), count));
    return values;
  }

  void read_nodes() {
    const std::string at = step_ + "/NOE";
    const std::vector<double> columns = file_.read_doubles(at + "/COO");
    const size_t count = columns.size() / 3;
    if (columns.size() % 3 != 0) fail(fmt::format("{}/COO: expected three values a node", at));
    const std::vector<int32_t> numbers = list(at + "/NUM", count), own = list(at + "/FAM", count);
    for (size_t n = 0; n < count; ++n) {
      out_.contents.node_tags.push_back(numbers.empty() ? n + 1 : static_cast<size_t>(numbers[n]));
      for (size_t k = 0; k < 3; ++k) out_.contents.coordinates.push_back(columns[k * count + n]);
    }
    out_.scan.nodes = static_cast<int64_t>(count);
    for (size_t n = 0; n < own.size(); ++n) {
      const auto groups = groups_of(node_groups_, own[n], 0);
      const size_t tag = out_.contents.node_tags[n];
      if (!groups.empty()) tables_.add(0, 15, "PO1", groups, tag, {tag});
    }
  }

  void read_elements(const std::string& type) {
    const std::string at = step_ + "/MAI/" + type;
    const auto kind = med_kind(type);
    if (!kind && !ignore_.contains(type))
      fail(
          fmt::format("found elements {}, expected linear and quadratic solids, faces and edges; "
                      "--ignore {} leaves out all of these",
                      type, type));
    const std::vector<int32_t> columns = file_.read_ints(at + "/NOD");
    if (!kind) {
      ++out_.ignored["elements " + type];
      return;
    }
    const size_t each = kind->order.size(), count = columns.size() / each;
    if (columns.size() % each != 0)
      fail(
          fmt::format("{}/NOD: found {} values, expected {} an element", at, columns.size(), each));
    const std::vector<int32_t> numbers = list(at + "/NUM", count), own = list(at + "/FAM", count);
    std::vector<size_t> nodes(each);
    for (size_t e = 0; e < count; ++e) {
      ++elements_;
      const size_t tag = numbers.empty() ? elements_ : static_cast<size_t>(numbers[e]);
      numbered_ = numbered_ && !numbers.empty() && tags_.insert(tag).second;
      for (size_t i = 0; i < each; ++i) nodes[kind->order[i]] = node_at(columns[i * count + e], at);
      const auto groups =
          own.empty() ? std::vector<int>() : groups_of(element_groups_, own[e], kind->dim);
      tables_.add(kind->dim, kind->gmsh_type, type, groups, tag, nodes);
    }
  }

  // Elements name nodes by their position, counted from 1.
  size_t node_at(int32_t position, const std::string& where) const {
    if (position < 1 || static_cast<size_t>(position) > out_.contents.node_tags.size())
      fail(fmt::format("{}/NOD: found node {}, expected 1 to {}", where, position,
                       out_.contents.node_tags.size()));
    return out_.contents.node_tags[static_cast<size_t>(position) - 1];
  }

  // Without numbers, or with the same ones in several types, all are counted.
  void number_elements() {
    size_t next = 0;
    for (MshElements& table : out_.contents.elements)
      if (table.dim > 0)
        for (size_t& tag : table.tags) tag = ++next;
  }

  std::string path_;
  H5File file_;
  std::set<std::string> ignore_;
  ForeignMesh out_;
  ElementTables tables_;
  std::string step_;
  Families element_groups_, node_groups_;
  std::map<std::string, int> group_number_;
  std::map<std::pair<int, int>, std::string> names_;  // by dimension and number
  std::set<std::pair<int32_t, int>> named_;           // families and dimensions
  std::set<size_t> tags_;
  size_t elements_ = 0;
  bool numbered_ = true;
};

}  // namespace

ForeignMesh read_med(const std::filesystem::path& path, const std::vector<std::string>& ignore) {
  return MedReader(path, ignore).run();
}

}  // namespace clatter::mesh
