// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/exports/med_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/plain_h5.hpp"
#include "mesh/exports/export_groups.hpp"

namespace clatter::mesh {
namespace {

constexpr const char* kNoProfile = "MED_NO_PROFILE_INTERNAL";
constexpr const char* kNoStep = "-0000000000000000001-0000000000000000001";
constexpr size_t kLongestGroup = 80, kLongestMesh = 64;

/// Elements of one type: rows by columns, as MED stores them, their families and numbers.
struct Elements {
  std::vector<std::vector<int32_t>> nodes;  // of each element, numbers from 1 in MED's order
  std::vector<int32_t> families, numbers;
};

// All first nodes, then all second ones, ...
std::vector<int32_t> by_columns(const std::vector<std::vector<int32_t>>& rows) {
  std::vector<int32_t> flat;
  for (size_t column = 0; !rows.empty() && column < rows.front().size(); ++column)
    for (const auto& row : rows) flat.push_back(row[column]);
  return flat;
}

class MedWriter {
 public:
  MedWriter(const Mesh& mesh, PlainH5& file)
      : mesh_(mesh), file_(file), numbers_(export_cell_numbers(mesh)) {
    name_ = mesh.name.substr(0, kLongestMesh);
    std::replace(name_.begin(), name_.end(), '/', '_');
    if (name_.empty()) name_ = "part";
    root_ = "ENS_MAA/" + name_;
    step_ = root_ + "/" + kNoStep;
  }

  void run() {
    head();
    nodes();
    solids();
    faces();
    write_elements();
    families();
  }

 private:
  void head() {
    file_.group("INFOS_GENERALES");
    file_.set("INFOS_GENERALES", "MAJ", 3);
    file_.set("INFOS_GENERALES", "MIN", 0);
    file_.set("INFOS_GENERALES", "REL", 8);
    file_.group(step_);
    for (const char* dimension : {"DIM", "ESP"}) file_.set(root_, dimension, 3);
    file_.set(root_, "REP", 0);  // Cartesian
    file_.set(root_, "TYP", 0);  // unstructured
    file_.set(root_, "SRT", 1);  // sorted by time step
    file_.set(root_, "UNT", std::string(16, ' '));
    file_.set(root_, "UNI", fmt::format("{0:<16}{0:<16}{0:<16}", "m"));
    file_.set(root_, "NOM", fmt::format("{:<16}{:<16}{:<16}", "X", "Y", "Z"));
    file_.set(root_, "DES", std::string("written by clatter"));
    file_.set(step_, "CGT", 1);
    file_.set(step_, "NDT", -1);
    file_.set(step_, "NOR", -1);
    file_.set(step_, "PDT", -1.0);
  }

  template <class T>
  void counted(const std::string& name, const std::vector<T>& values, size_t count) {
    file_.write(name, values);
    file_.set(name, "CGT", 1);
    file_.set(name, "NBR", static_cast<int32_t>(count));
  }

  void entity(const std::string& group) {
    file_.group(group);
    file_.set(group, "CGT", 1);
    file_.set(group, "CGS", 1);
    file_.set(group, "PFL", std::string(kNoProfile));
  }

  void nodes() {
    const auto count = static_cast<size_t>(mesh_.nodes.rows());
    const std::string group = step_ + "/NOE";
    std::vector<double> columns;
    for (int d = 0; d < 3; ++d)
      for (Eigen::Index n = 0; n < mesh_.nodes.rows(); ++n) columns.push_back(mesh_.nodes(n, d));
    std::vector<std::string> names;
    for (const auto& [name, set] : mesh_.node_sets) names.push_back(name);
    std::vector<int32_t> own;
    for (const std::vector<size_t>& sets : sets_of_nodes(mesh_)) {
      std::vector<std::string> groups;
      for (const size_t set : sets) groups.push_back(names[set]);
      own.push_back(family(node_families_, groups, 1));
    }
    entity(group);
    counted(group + "/COO", columns, count);
    counted(group + "/FAM", own, count);
    counted(group + "/NUM", export_node_numbers(mesh_), count);
  }

  // Number of the family of these groups: 0 for none, else 1, 2, ... or -1, -2, ...
  static int32_t family(std::map<std::vector<std::string>, int32_t>& families,
                        const std::vector<std::string>& groups, int sign) {
    if (groups.empty()) return 0;
    const auto next = static_cast<int32_t>(families.size()) + 1;
    return sign * families.emplace(groups, next).first->second;
  }

  void solids() {
    for (size_t b = 0; b < mesh_.cells.size(); ++b) {
      const CellBlock& block = mesh_.cells[b];
      const CellTraits& cell = traits(block.type);
      Elements& elements = elements_[std::string(cell.med_name)];
      const int32_t own = family(cell_families_, {mesh_.regions[block.region]}, -1);
      for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
        std::vector<int32_t>& row = elements.nodes.emplace_back();
        for (const int i : cell.to_med) row.push_back(block.nodes(c, i) + 1);
        elements.families.push_back(own);
        elements.numbers.push_back(numbers_[b][c]);
      }
    }
  }

  void faces() {
    std::vector<std::string> names;
    for (const auto& [name, surface] : mesh_.surfaces) names.push_back(name);
    const std::vector<std::string> regions = export_region_names(mesh_);
    const std::vector<ExportFace> all = export_faces(mesh_);
    int32_t last = largest_cell_number(numbers_, all);
    for (const ExportFace& face : all) {
      std::vector<std::string> groups;
      if (face.region >= 0) groups.push_back(regions[face.region]);
      for (const size_t surface : face.surfaces) groups.push_back(names[surface]);
      Elements& elements = elements_[std::string(traits(face.type).med_name)];
      std::vector<int32_t>& row = elements.nodes.emplace_back();
      for (const int32_t node : face.nodes) row.push_back(node + 1);
      elements.families.push_back(family(cell_families_, groups, -1));
      elements.numbers.push_back(face.region < 0 ? ++last : face.number);
    }
  }

  void write_elements() {
    file_.group(step_ + "/MAI");
    file_.set(step_ + "/MAI", "CGT", 1);
    for (const auto& [type, elements] : elements_) {
      const std::string group = step_ + "/MAI/" + type;
      entity(group);
      counted(group + "/NOD", by_columns(elements.nodes), elements.nodes.size());
      counted(group + "/FAM", elements.families, elements.nodes.size());
      counted(group + "/NUM", elements.numbers, elements.nodes.size());
    }
  }

  void families() {
    const std::string all = "FAS/" + name_;
    file_.group(all + "/FAMILLE_ZERO");
    file_.set(all + "/FAMILLE_ZERO", "NUM", 0);
    for (const auto& [groups, number] : node_families_)
      write_family(all + "/NOEUD", groups, number);
    for (const auto& [groups, number] : cell_families_)
      write_family(all + "/ELEME", groups, -number);
  }

  void write_family(const std::string& folder, const std::vector<std::string>& groups,
                    int32_t number) {
    for (const std::string& group : groups)
      if (group.size() > kLongestGroup)
        throw InputError(fmt::format("mesh '{}': the name '{}' has {} bytes, MED allows {}",
                                     mesh_.name, group, group.size(), kLongestGroup));
    const std::string at = fmt::format("{}/FAM_{}", folder, number);
    file_.group(at + "/GRO");
    file_.set(at, "NUM", number);
    file_.set(at + "/GRO", "NBR", static_cast<int32_t>(groups.size()));
    file_.write_fixed(at + "/GRO/NOM", groups, kLongestGroup);
  }

  const Mesh& mesh_;
  PlainH5& file_;
  std::string name_, root_, step_;
  std::map<std::string, Elements> elements_;  // by MED's name of the type
  std::map<std::vector<std::string>, int32_t> node_families_, cell_families_;  // by groups
  std::vector<std::vector<int32_t>> numbers_;                                  // of the solids
};

}  // namespace

void write_med(const Mesh& mesh, const std::filesystem::path& path) {
  PlainH5 file(path);
  MedWriter(mesh, file).run();
  file.commit();
}

}  // namespace clatter::mesh
