// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/dmig.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "core/base/artefact.hpp"
#include "core/base/whole_file.hpp"
#include "core/rom/dof_map.hpp"

namespace clatter::condense {
namespace {

constexpr int kField = 16;
/// Below it the exponent has three digits, which leave fewer than ten digits in a field.
constexpr double kSmallest = 1e-99;

void write_head(std::ostream& out, const rom::ReducedModel& model,
                const std::vector<rom::MappedDof>& map) {
  out << fmt::format("$ clatter {}: {:.40} ({}), SI: m, kg, s, N\n", version(), model.name,
                     model.method);
  out << fmt::format("$ {} boundary coordinates, then {} modal ones\n", model.n_boundary,
                     model.size() - model.n_boundary);
  out << "$ Case control: K2GG = KCLATTR and M2GG = MCLATTR\n"
         "$ row  node  component (0: SPOINT)  label\n";
  for (size_t j = 0; j < map.size(); ++j)
    out << fmt::format("$ {}  {}  {}  {:.40}\n", j + 1, map[j].node, map[j].component,
                       map[j].label);
}

/// GRIDs with the components without a coordinate constrained, and SPOINTs.
void write_points(std::ostream& out, const std::vector<rom::MappedDof>& map) {
  std::map<int, std::string> loose;  // of each grid: the components without a coordinate
  std::map<int, Eigen::Vector3d> position;
  for (const rom::MappedDof& dof : map) {
    if (dof.component == 0) {
      out << fmt::format("SPOINT  {:<8}\n", dof.node);
      continue;
    }
    std::string& components = loose.try_emplace(dof.node, "123456").first->second;
    std::erase(components, static_cast<char>('0' + dof.component));
    position[dof.node] = dof.position;
  }
  for (const auto& [node, components] : loose) {
    const Eigen::Vector3d& p = position[node];
    out << fmt::format("GRID*   {:<16}{:<16}{:<16}{:<16}*\n*       {:<16}{:<16}{:<16}\n", node, 0,
                       nastran_number(p[0]), nastran_number(p[1]), nastran_number(p[2]), 0,
                       components);
  }
}

void write_matrix(std::ostream& out, const std::string& name, const Eigen::MatrixXd& matrix,
                  const std::vector<rom::MappedDof>& map) {
  out << fmt::format("DMIG    {:<8}{:<8}{:<8}{:<8}\n", name, 0, 6, 2);
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    const rom::MappedDof& column = map[static_cast<size_t>(j)];
    bool begun = false;
    for (Eigen::Index i = j; i < matrix.rows(); ++i) {
      if (std::abs(matrix(i, j)) < kSmallest) continue;
      if (!begun)
        out << fmt::format("DMIG*   {:<16}{:<16}{:<16}\n", name, column.node, column.component);
      begun = true;
      const rom::MappedDof& row = map[static_cast<size_t>(i)];
      out << fmt::format("*       {:<16}{:<16}{:<16}\n", row.node, row.component,
                         nastran_number(matrix(i, j)));
    }
  }
}

}  // namespace

std::string nastran_number(double value) {
  if (std::abs(value) < kSmallest) return "0.0D+0";
  for (int decimals = 11;; --decimals) {
    const std::string text = fmt::format("{:.{}e}", value, decimals);
    const size_t at = text.find('e');
    const int exponent = std::stoi(text.substr(at + 1));
    const std::string out = fmt::format("{}D{:+d}", text.substr(0, at), exponent);
    if (out.size() <= kField) return out;
  }
}

std::vector<std::filesystem::path> export_dmig(const rom::ReducedModel& model,
                                               const std::filesystem::path& path) {
  const std::vector<rom::MappedDof> map = rom::map_of(model);
  WholeFile file(path);
  write_head(file.stream(), model, map);
  write_points(file.stream(), map);
  write_matrix(file.stream(), "KCLATTR", model.K_rr, map);
  write_matrix(file.stream(), "MCLATTR", model.M_rr, map);
  file.commit();
  return {path};
}

}  // namespace clatter::condense
