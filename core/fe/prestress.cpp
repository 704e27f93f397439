// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/prestress.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/artefact.hpp"
#include "core/base/threads.hpp"
#include "core/fe/cell_strain.hpp"
#include "core/fe/element.hpp"
#include "core/fe/fe_checks.hpp"
#include "core/fe/fe_gasket.hpp"
#include "core/fe/shell_directors.hpp"
#include "core/fe/stress.hpp"

namespace clatter::fe {
namespace {

constexpr double kSamePlace = 1e-9;      // of the part's size
constexpr Eigen::Index kTogether = 512;  // cells whose matrices are held

/// The nodes of the results are those of the part.
void require_nodes(const H5File& file, const RowMatrix& nodes) {
  const RowMatrix found = file.read_rows("nodes");
  if (found.rows() == 0 && nodes.rows() == 0) return;
  const double size =
      nodes.rows() == 0 ? 0.0 : (nodes.colwise().maxCoeff() - nodes.colwise().minCoeff()).norm();
  if (found.rows() == nodes.rows() && found.cols() == 3 &&
      ((found - nodes).rowwise().norm().array() <= kSamePlace * size).all())
    return;
  refuse(
      file, "nodes", fmt::format("{}, at other places", found.rows()),
      fmt::format("the {} nodes of this part: results of clatter-modal statics for the same mesh",
                  nodes.rows()));
}

std::string chosen_case(const H5File& file, const std::string& wanted) {
  const std::vector<std::string> present = file.list("cases");
  if (wanted.empty() && present.size() == 1) return present[0];
  if (std::ranges::count(present, wanted) == 0)
    refuse(file, "case", wanted.empty() ? "none" : fmt::format("\"{}\"", wanted),
           fmt::format("one of: {}", fmt::join(present, ", ")));
  return wanted;
}

RowMatrix read_motion(const H5File& file, const std::string& name, Eigen::Index rows,
                      Eigen::Index cols) {
  RowMatrix out = file.read_rows(name);
  check_shape(file, name, out, rows, cols);
  check_finite(file, name, out);
  return out;
}

Eigen::Matrix3d tensor(const Voigt& s) {
  Eigen::Matrix3d out;
  out << s(0), s(3), s(5), s(3), s(1), s(4), s(5), s(4), s(2);
  return out;
}

/// int grad N_a . sigma grad N_b dV at the points of the stiffness, so that a rigid motion changes
/// the forces of the stress as those of its equilibrium turn.
Eigen::MatrixXd between_nodes(mesh::CellType type, const mesh::CellNodes& x,
                              const Material& material, const Eigen::VectorXd& u,
                              const Eigen::VectorXd& dT) {
  const CellPoints& points =
      stiffness_points(type, integration_of(type, material.integration), is_straight(type, x));
  const StressRows stress = point_stress(type, points, x, material, u, dT);
  const CellModes modes(x, false);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(x.rows(), x.rows());
  ModeGradient gradient;
  for (size_t q = 0; q < points.size(); ++q) {
    const double det = modes.at(points[q], gradient);
    const Eigen::Matrix3d sigma = tensor(stress.row(static_cast<Eigen::Index>(q)).transpose());
    out.noalias() += points[q].weight * det * (gradient * sigma) * gradient.transpose();
  }
  return out;
}

/// The nodes of a cell, counted from the first one, with their motions.
struct MovedCell {
  mesh::CellNodes x;
  Eigen::VectorXd u, dT;  // 3n; n, or empty
  Eigen::Vector3d first;
};

MovedCell moved_cell(const mesh::Mesh& mesh, const mesh::CellBlock& block, Eigen::Index cell,
                     const Prestress& state) {
  const mesh::CellNodes x = mesh::cell_nodes(mesh, block, cell);
  const Eigen::Index n = x.rows();
  MovedCell out{x.rowwise() - x.row(0), Eigen::VectorXd(3 * n), {}, x.row(0)};
  if (state.temperature.size() > 0) out.dT.resize(n);
  for (Eigen::Index a = 0; a < n; ++a) {
    const int32_t node = block.nodes(cell, a);
    out.u.segment<3>(3 * a) = state.displacement.row(node);
    if (out.dT.size() > 0) out.dT(a) = state.temperature(node);
  }
  return out;
}

/// Sums of pairs of nodes, at the places of `pattern`.
std::vector<double> sums_of_solids(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                                   const NodePattern& pattern, const Prestress& state) {
  std::vector<double> sums(pattern.rows.size(), 0.0);
  std::vector<Eigen::MatrixXd> chunk(kTogether);
  for (const mesh::CellBlock& block : mesh.cells)
    for (Eigen::Index first = 0; first < block.nodes.rows(); first += kTogether) {
      const Eigen::Index count = std::min(kTogether, block.nodes.rows() - first);
      parallel_pieces(count, [&](int64_t begin, int64_t end) {
        for (int64_t c = begin; c < end; ++c) {
          const MovedCell cell = moved_cell(mesh, block, first + c, state);
          chunk[c] = between_nodes(block.type, cell.x,
                                   materials[block.region].seen_from(cell.first), cell.u, cell.dT);
        }
      });
      for (Eigen::Index c = 0; c < count; ++c) {
        const auto nodes = block.nodes.row(first + c);
        for (Eigen::Index b = 0; b < nodes.size(); ++b)
          for (Eigen::Index a = 0; a < nodes.size(); ++a)
            if (nodes(a) >= nodes(b))
              sums[pattern.start[nodes(b)] + pattern.position(nodes(b), nodes(a))] +=
                  chunk[c](a, b);
      }
    }
  return sums;
}

/// The same value for the three directions of each pair.
SparseMatrix spread(const NodePattern& pattern, const std::vector<double>& sums, int64_t size) {
  SparseMatrix out(size, size);
  out.resizeNonZeros(static_cast<Eigen::Index>(3 * sums.size()));
  int32_t* start = out.outerIndexPtr();
  int32_t at = 0;
  for (int64_t column = 0; column < size; ++column) {
    start[column] = at;
    const int64_t node = column / 3;
    if (node >= pattern.nodes()) continue;
    for (int64_t k = pattern.start[node]; k < pattern.start[node + 1]; ++k, ++at) {
      out.innerIndexPtr()[at] = 3 * pattern.rows[k] + static_cast<int32_t>(column % 3);
      out.valuePtr()[at] = sums[k];
    }
  }
  start[size] = at;
  return out;
}

/// x y z rx ry rz of each node of a shell.
Eigen::VectorXd moved_shell(const mesh::ShellBlock& block, Eigen::Index cell,
                            const Prestress& state) {
  Eigen::VectorXd out(6 * block.nodes.cols());
  for (Eigen::Index a = 0; a < block.nodes.cols(); ++a) {
    const int32_t node = block.nodes(cell, a);
    const auto k = std::ranges::lower_bound(state.turning, node) - state.turning.begin();
    out.segment<3>(6 * a) = state.displacement.row(node);
    out.segment<3>(6 * a + 3) = state.rotation.row(k);
  }
  return out;
}

SparseMatrix shell_terms(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                         const std::vector<ShellSection>& sections, const ShellIds& ids,
                         const Prestress& state) {
  const std::vector<RowMatrix> directors = shell_directors(mesh.nodes, mesh.shells);
  ShellEntries entries;
  for (size_t b = 0; b < mesh.shells.size(); ++b) {
    const mesh::ShellBlock& block = mesh.shells[b];
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const ShellCell cell =
          shell_cell(mesh, block, c, directors[b], sections[block.region], materials[block.region]);
      Eigen::VectorXd dT;
      if (state.temperature.size() > 0) dT = state.temperature(block.nodes.row(c));
      add_lower(shell_geometric_stiffness(cell, moved_shell(block, c, state), dT), block, c, ids,
                entries);
    }
  }
  SparseMatrix out(ids.count, ids.count);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace

Prestress read_prestress(const std::filesystem::path& path, std::string of_case,
                         const RowMatrix& nodes) {
  const H5File file = open_artefact(path, kStaticSchema);
  require_nodes(file, nodes);
  Prestress out;
  out.of_case = chosen_case(file, of_case);
  const std::string group = "cases/" + out.of_case + "/";
  out.displacement = read_motion(file, group + "displacement", nodes.rows(), 3);
  if (file.has("rotation_nodes")) {
    out.turning = file.read_ints("rotation_nodes");
    out.rotation = read_motion(file, group + "rotation", std::ssize(out.turning), 3);
  }
  if (file.has(group + "temperature_rise"))
    out.temperature = read_motion(file, group + "temperature_rise", nodes.rows(), 1);
  if (file.has("points/names")) {
    out.points = file.read_strings("points/names");
    out.point_motion = read_motion(file, group + "points", std::ssize(out.points), 6);
  }
  return out;
}

SparseMatrix geometric_stiffness(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                                 const std::vector<ShellSection>& sections,
                                 const NodePattern& pattern, const ShellIds& ids,
                                 const Prestress& state) {
  SparseMatrix out = spread(pattern, sums_of_solids(mesh, materials, pattern, state), ids.count);
  if (!mesh.shells.empty()) out += shell_terms(mesh, materials, sections, ids, state);
  out *= state.factor;
  return out;
}

}  // namespace clatter::fe
