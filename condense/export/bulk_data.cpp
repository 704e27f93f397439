// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/bulk_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "condense/export/node_frames.hpp"
#include "core/base/artefact.hpp"
#include "core/base/error.hpp"

namespace clatter::condense {
namespace {

constexpr int kField = 16;
/// Below it the exponent has three digits, which leave fewer than ten digits in a field.
constexpr double kSmallest = 1e-99;

struct Grid {
  std::string loose = "123456";  // components without a coordinate
  Eigen::Vector3d position;
  bool of_deck = false, turned = false;
};

std::map<int, Grid> grids_of(const ExportedPart& part) {
  std::map<int, Grid> grids;
  for (const rom::MappedDof& dof : part.map) {
    if (dof.component == 0) continue;
    Grid& grid = grids[dof.node];
    std::erase(grid.loose, static_cast<char>('0' + dof.component));
    grid.position = dof.position;
    grid.of_deck = dof.of_deck;
    grid.turned = grid.turned || dof.turned;
  }
  return grids;
}

/// The system with the number of its grid.
void write_system(std::ostream& out, int node, const Eigen::Matrix3d& frame) {
  const std::string zero = nastran_number(0.0);
  const auto of = [&](Eigen::Index axis, Eigen::Index d) { return nastran_number(frame(d, axis)); };
  out << fmt::format(
      "CORD2R* {:<16}{:<16}{:<16}{:<16}*\n*       {:<16}{:<16}{:<16}{:<16}*\n*       "
      "{:<16}{:<16}{:<16}\n",
      node, 0, zero, zero, zero, of(2, 0), of(2, 1), of(2, 2), of(0, 0), of(0, 1), of(0, 2));
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

void write_bulk_head(std::ostream& out, const ExportedPart& part,
                     const std::vector<std::string>& lines) {
  const rom::ReducedModel& model = part.model;
  for (const rom::MappedDof& dof : part.map)
    if (dof.node > kLargestGrid)
      throw InputError(
          fmt::format("{}: number {} of {}: found more than Nastran's {}, expected "
                      "--first-grid and --first-spoint below",
                      model.name, dof.node, dof.label, kLargestGrid));
  out << fmt::format("$ clatter {}: {:.40} ({}), {}\n", version(), model.name, model.method,
                     text_of(part.units));
  out << fmt::format("$ {} boundary coordinates, then {} modal ones\n", model.n_boundary,
                     model.size() - model.n_boundary);
  for (const std::string& line : lines) out << "$ " << line << '\n';
  const bool turned = std::ranges::any_of(part.map, [](const auto& dof) { return dof.turned; });
  out << fmt::format("$ row  node  component (0: SPOINT)  label; components are along the {}\n",
                     turned ? "displacement axes of their grids (CD)" : "basic axes");
  for (size_t j = 0; j < part.map.size(); ++j)
    out << fmt::format("$ {}  {}  {}  {:.40}\n", j + 1, part.map[j].node, part.map[j].component,
                       part.map[j].label);
}

void write_grids(std::ostream& out, const ExportedPart& part, bool deck_nodes) {
  const std::map<int, Eigen::Matrix3d> frames = frames_of(part.map);
  for (const auto& [node, grid] : grids_of(part)) {
    if (grid.of_deck && !deck_nodes) {
      out << fmt::format("$ GRID {}: keep the deck's, with {} (--deck-nodes writes it here)\n",
                         node, grid.turned ? "its CD" : "CD 0");
      continue;
    }
    if (grid.turned) write_system(out, node, frames.at(node));
    const Eigen::Vector3d& p = grid.position;
    out << fmt::format("GRID*   {:<16}{:<16}{:<16}{:<16}*\n*       {:<16}{:<16}{:<16}\n", node, 0,
                       nastran_number(p[0]), nastran_number(p[1]), nastran_number(p[2]),
                       grid.turned ? node : 0, grid.loose);
  }
}

void write_spoints(std::ostream& out, const ExportedPart& part) {
  for (const rom::MappedDof& dof : part.map)
    if (dof.component == 0) out << fmt::format("SPOINT  {:<8}\n", dof.node);
}

void write_dmig(std::ostream& out, const std::string& name, const Eigen::MatrixXd& matrix,
                const ExportedPart& part) {
  out << fmt::format("DMIG    {:<8}{:<8}{:<8}{:<8}\n", name, 0, 6, 2);
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    const rom::MappedDof& column = part.map[j];
    bool begun = false;
    for (Eigen::Index i = j; i < matrix.rows(); ++i) {
      if (std::abs(matrix(i, j)) < kSmallest) continue;
      if (!begun)
        out << fmt::format("DMIG*   {:<16}{:<16}{:<16}\n", name, column.node, column.component);
      begun = true;
      const rom::MappedDof& row = part.map[i];
      out << fmt::format("*       {:<16}{:<16}{:<16}\n", row.node, row.component,
                         nastran_number(matrix(i, j)));
    }
  }
}

void write_fields(std::ostream& out, const std::string& head, const std::vector<int>& numbers) {
  out << head;
  size_t on_line = head.size() / 8 - 1;
  for (const int number : numbers) {
    if (on_line == 8) {
      out << "\n        ";
      on_line = 0;
    }
    out << fmt::format("{:<8}", number);
    ++on_line;
  }
  out << '\n';
}

}  // namespace clatter::condense
