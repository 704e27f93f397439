// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/assemble_shells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/error.hpp"
#include "core/base/progress.hpp"
#include "core/base/threads.hpp"
#include "core/fe/shell_directors.hpp"

namespace clatter::fe {
namespace {

constexpr Eigen::Index kShellsTogether = 512;  // cells whose matrices are held

/// The rows of x y z rx ry rz of each node of a cell.
std::vector<int32_t> shell_rows(const mesh::ShellBlock& block, Eigen::Index cell,
                                const ShellIds& ids) {
  std::vector<int32_t> rows;
  for (const int32_t node : block.nodes.row(cell)) {
    for (int d = 0; d < 3; ++d) rows.push_back(3 * node + d);
    for (int d = 0; d < 3; ++d) rows.push_back(ids.rotation_of[node] + d);
  }
  return rows;
}

bool moves_rigidly(const std::vector<int32_t>& rigid_of_node, const mesh::ShellBlock& block,
                   Eigen::Index cell) {
  if (rigid_of_node.empty()) return false;
  const int32_t body = rigid_of_node[block.nodes(cell, 0)];
  return body >= 0 && std::ranges::all_of(block.nodes.row(cell), [&](int32_t node) {
           return rigid_of_node[node] == body;
         });
}

[[noreturn]] void refuse_shell(const mesh::Mesh& mesh, const mesh::ShellBlock& block,
                               Eigen::Index cell, const std::string& why) {
  const Eigen::RowVector3d at = mesh.nodes.row(block.nodes(cell, 0));
  throw InputError(fmt::format("mesh '{}': region {}: shell {} at ({:.6g}, {:.6g}, {:.6g}) m: {}",
                               mesh.name, mesh.regions[block.region],
                               block.ids.empty() ? static_cast<int32_t>(cell) + 1 : block.ids[cell],
                               at(0), at(1), at(2), why));
}

[[noreturn]] void refuse_shape(const mesh::Mesh& mesh, const mesh::ShellBlock& block,
                               Eigen::Index cell) {
  refuse_shell(mesh, block, cell,
               fmt::format("found it folded, concave or without area, expected a convex {}",
                           mesh::traits(block.type).corners == 3 ? "triangle" : "quadrilateral"));
}

/// Of materials with directions, direction 1 has a projection on each cell.
void check_directions(const mesh::Mesh& mesh, const mesh::ShellBlock& block, Eigen::Index cell,
                      const ShellCell& sheet) {
  constexpr double kAlong = 0.1;  // sine of the angle to the normal: 6 degrees
  const Eigen::Vector3d normal = sheet.directors.colwise().sum().normalized();
  if (normal.cross(sheet.axis).norm() > kAlong * sheet.axis.norm()) return;
  refuse_shell(mesh, block, cell,
               "direction 1 of its material is along its normal, expected one along the sheet: "
               "system of its [[shell]]");
}

SparseMatrix from_entries(int64_t size, const ShellEntries& entries) {
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

ShellCell shell_cell(const mesh::Mesh& mesh, const mesh::ShellBlock& block, Eigen::Index cell,
                     const RowMatrix& directors, const ShellSection& section,
                     const Material& material) {
  const Eigen::Index n = block.nodes.cols();
  ShellCell out;
  out.type = block.type;
  out.x.resize(n, 3);
  out.directors.resize(n, 3);
  // From the first node: far from the origin differences of positions would lose digits.
  for (Eigen::Index a = 0; a < n; ++a) {
    out.x.row(a) = mesh.nodes.row(block.nodes(cell, a)) - mesh.nodes.row(block.nodes(cell, 0));
    out.directors.row(a) = directors.row(cell).segment<3>(3 * a);
  }
  out.thickness = section.thickness;
  if (block.thickness.size() > 0) {
    const Eigen::VectorXd own = block.thickness.row(cell).transpose();
    out.thickness = own.mean();
    if ((own.array() != out.thickness).any()) out.ratio = own / out.thickness;
  }
  out.stiffness = stiffness_of(section, material, out.thickness);
  out.offset = block.offset.size() > 0 ? block.offset(cell) : section.offset;
  if (block.axis.size() > 0)
    out.axis = block.axis.row(cell).transpose();
  else if (section.axes)
    out.axis =
        section.axes->at(mesh.nodes(block.nodes.row(cell), Eigen::all).colwise().mean()).col(0);
  return out;
}

void add_lower(const ShellMatrix& values, const mesh::ShellBlock& block, Eigen::Index cell,
               const ShellIds& ids, ShellEntries& entries) {
  const std::vector<int32_t> rows = shell_rows(block, cell, ids);
  for (Eigen::Index j = 0; j < values.cols(); ++j)
    for (Eigen::Index i = 0; i < values.rows(); ++i)
      if (rows[i] >= rows[j] && values(i, j) != 0.0)
        entries.emplace_back(rows[i], rows[j], values(i, j));
}

NodalMatrices assemble_shells(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                              const std::vector<ShellSection>& sections, const ShellIds& ids,
                              MassForm form, const std::vector<int32_t>& rigid_of_node,
                              const std::vector<bool>& blocks) {
  const std::vector<RowMatrix> directors = shell_directors(mesh.nodes, mesh.shells);
  const auto takes = [&](size_t b) { return blocks.empty() || blocks[b]; };
  int64_t cells = 0;
  for (size_t b = 0; b < mesh.shells.size(); ++b)
    if (takes(b)) cells += mesh.shells[b].nodes.rows();
  Progress progress("assemble shells", static_cast<double>(cells), "cells");
  double done = 0.0;
  ShellEntries K, M;
  std::vector<ShellMatrices> chunk(kShellsTogether);
  std::array<char, kShellsTogether> valid{};
  for (size_t b = 0; b < mesh.shells.size(); ++b) {
    if (!takes(b)) continue;
    const mesh::ShellBlock& block = mesh.shells[b];
    const ShellSection& section = sections[block.region];
    const Material& material = materials[block.region];
    const bool turns = section.has_directions(material);
    for (Eigen::Index first = 0; first < block.nodes.rows(); first += kShellsTogether) {
      const Eigen::Index count = std::min(kShellsTogether, block.nodes.rows() - first);
      parallel_pieces(count, [&](int64_t begin, int64_t end) {
        for (int64_t c = begin; c < end; ++c) {
          const ShellCell cell =
              shell_cell(mesh, block, first + c, directors[b], section, material);
          if (turns) check_directions(mesh, block, first + c, cell);
          valid[c] = compute_shell(cell, form, chunk[c]) ? 1 : 0;
        }
      });
      for (Eigen::Index c = 0; c < count; ++c) {
        if (valid[c] == 0) refuse_shape(mesh, block, first + c);
        if (!moves_rigidly(rigid_of_node, block, first + c))
          add_lower(chunk[c].stiffness, block, first + c, ids, K);
        add_lower(chunk[c].mass, block, first + c, ids, M);
      }
      progress.update(done += static_cast<double>(count));
    }
  }
  return {from_entries(ids.count, M), from_entries(ids.count, K)};
}

}  // namespace clatter::fe
