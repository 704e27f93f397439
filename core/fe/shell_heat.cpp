// SPDX-License-Identifier: GPL-3.0-or-later
// Heat along sheets: one temperature through the thickness.
#include "core/fe/assemble_shells.hpp"
#include "core/fe/heat.hpp"
#include "core/fe/shell_directors.hpp"
#include "core/fe/shell_kinematics.hpp"

namespace clatter::fe {
namespace {

/// Conductance per width in the axes of the cell [W/K].
Eigen::Matrix2d conductance_of(const ShellSection& section, const Material& material,
                               double thickness) {
  const auto of = [](const Material& one, double t, double angle) {
    const Eigen::Rotation2Dd turn(angle);
    const Eigen::Matrix2d k = one.conductivity.head<2>().asDiagonal();
    return Eigen::Matrix2d(t * turn.toRotationMatrix() * k * turn.toRotationMatrix().transpose());
  };
  if (section.layers.empty()) return of(material, thickness, 0.0);
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const ShellLayer& layer : section.layers)
    sum += of(layer.material, layer.thickness * thickness / section.thickness, layer.angle);
  return sum;
}

/// visit(block, row, cell, point, weight) at the points of each shell; weight: area that a point
/// stands for, times the ratio of the thickness there to the cell's.
template <class Visit>
void for_each_sheet_point(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                          const std::vector<ShellSection>& sections, Visit&& visit) {
  if (mesh.shells.empty()) return;
  const std::vector<RowMatrix> directors = shell_directors(mesh.nodes, mesh.shells);
  for (size_t b = 0; b < mesh.shells.size(); ++b) {
    const mesh::ShellBlock& block = mesh.shells[b];
    const mesh::FaceRule& rule = mesh::face_rule(block.type);
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const ShellCell cell = shell_cell(mesh, block, c, directors[b], sections.at(block.region),
                                        materials.at(block.region));
      const MidSurface mid(cell);
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
        const SurfacePoint point(mid, rule.points.row(q).transpose());
        const double ratio = cell.ratio.size() == 0 ? 1.0 : point.h.dot(cell.ratio);
        visit(block, c, cell, point, rule.weights(q) * point.area * ratio);
      }
    }
  }
}

}  // namespace

SparseMatrix sheet_conduction(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                              const std::vector<ShellSection>& sections) {
  std::vector<Eigen::Triplet<double, int32_t>> entries;
  for_each_sheet_point(
      mesh, materials, sections,
      [&](const mesh::ShellBlock& block, Eigen::Index c, const ShellCell& cell,
          const SurfacePoint& point, double weight) {
        Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kShellNodes> slope(2, point.h.size());
        slope.row(0) = point.h_r.transpose();
        slope.row(1) = point.h_s.transpose();
        slope = point.to_axes * slope;
        const Eigen::Matrix2d k =
            conductance_of(sections[block.region], materials[block.region], cell.thickness);
        const Eigen::MatrixXd K = weight * slope.transpose() * k * slope;
        for (Eigen::Index i = 0; i < K.rows(); ++i)
          for (Eigen::Index j = 0; j < K.cols(); ++j)
            if (block.nodes(c, i) >= block.nodes(c, j))
              entries.emplace_back(block.nodes(c, i), block.nodes(c, j), K(i, j));
      });
  SparseMatrix K(mesh.nodes.rows(), mesh.nodes.rows());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

Eigen::VectorXd sheet_heat(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                           const std::vector<ShellSection>& sections,
                           const std::vector<double>& source) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(mesh.nodes.rows());
  for_each_sheet_point(mesh, materials, sections,
                       [&](const mesh::ShellBlock& block, Eigen::Index c, const ShellCell& cell,
                           const SurfacePoint& point, double weight) {
                         for (Eigen::Index a = 0; a < point.h.size(); ++a)
                           q(block.nodes(c, a)) +=
                               source.at(block.region) * cell.thickness * weight * point.h(a);
                       });
  return q;
}

}  // namespace clatter::fe
