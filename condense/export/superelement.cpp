// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/superelement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "condense/export/bulk_data.hpp"
#include "condense/export/pencil_modes.hpp"
#include "core/base/whole_file.hpp"

namespace clatter::condense {
namespace {

std::set<int> nodes_of(const ExportedPart& part) {
  std::set<int> nodes;
  for (const rom::MappedDof& dof : part.map)
    if (dof.component != 0) nodes.insert(dof.node);
  return nodes;
}

void write_assembly(std::ostream& out, const ExportedPart& part, const std::string& super) {
  const int id = part.options.superelement;
  write_bulk_head(
      out, part,
      {"For the main bulk data of the assembly. After all of it: INCLUDE '" + super + "'",
       "Case control: K2GG = KAAX and M2GG = MAAX (and B2GG = BAAX of a damped part)"});
  out << fmt::format("SEBULK  {:<8}EXTERNAL        MANUAL\n", id);
  std::vector<int> pairs;
  for (const int node : nodes_of(part)) pairs.insert(pairs.end(), {node, node});
  out << fmt::format("SECONCT {:<8}{:<8}{:<8}NO\n", id, 0, "");
  write_fields(out, "        ", pairs);
  write_grids(out, part, part.options.deck_nodes);
}

/// ASET1 of each set of components that some node has, and of the scalar points.
void write_aset(std::ostream& out, const ExportedPart& part) {
  std::map<int, std::string> components;
  for (const rom::MappedDof& dof : part.map)
    components[dof.node] += static_cast<char>('0' + dof.component);
  std::map<std::string, std::vector<int>> nodes;
  for (auto& [node, text] : components) {
    std::sort(text.begin(), text.end());
    nodes[text].push_back(node);
  }
  for (const auto& [text, list] : nodes)
    write_fields(out, fmt::format("{:<8}{:<8}", "ASET1", text), list);
}

void write_part(std::ostream& out, const ExportedPart& part) {
  out << fmt::format("BEGIN SUPER={}\n", part.options.superelement);
  write_bulk_head(out, part, {});
  write_grids(out, part, true);
  write_spoints(out, part);
  write_aset(out, part);
  write_dmig(out, "KAAX", part.model.K_rr, part);
  write_dmig(out, "MAAX", part.model.M_rr, part);
  const Eigen::MatrixXd D = damping_of(part.model);
  if (!D.isZero(0.0)) write_dmig(out, "BAAX", D, part);
}

}  // namespace

std::vector<std::filesystem::path> superelement_files(const std::filesystem::path& path) {
  return {path, std::filesystem::path(path).replace_extension(".super.pch")};
}

void export_superelement(const ExportedPart& part, const std::filesystem::path& path) {
  const std::filesystem::path super = superelement_files(path)[1];
  WholeFile assembly(path), inner(super);
  write_assembly(assembly.stream(), part, super.filename().string());
  write_part(inner.stream(), part);
  inner.commit();
  assembly.commit();
}

}  // namespace clatter::condense
