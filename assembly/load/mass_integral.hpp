// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Integrals over the mass of a mesh: integration points shared by mass properties and body forces.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <vector>

#include "core/fe/shell_section.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::assembly {

/// Calls visit(c, N, x, dm) at each point of each cell c of a block: N the values of the shape
/// functions there, x the position [m], dm = density weight det J [kg]. Sums over it are exact for
/// polynomials of x up to x x^T: det J has at most the degrees that cube_bernstein.cpp lists, x
/// adds its own twice.
template <class Visit>
void for_each_mass_point(const mesh::Mesh& mesh, const mesh::CellBlock& block, double density,
                         Visit&& visit) {
  const mesh::CellRule& rule = mesh::fine_rule(block.type);
  std::vector<mesh::CellShape> shapes;
  for (const auto& point : rule.points.rowwise())
    shapes.push_back(mesh::cell_shape(block.type, point.transpose()));
  for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
    const mesh::CellNodes x = mesh::cell_nodes(mesh, block, c);
    for (size_t q = 0; q < shapes.size(); ++q) {
      const Eigen::Vector3d at = x.transpose() * shapes[q].value;
      const Eigen::Matrix3d J = x.transpose() * shapes[q].gradient;
      visit(c, shapes[q].value, at,
            density * rule.weights(static_cast<Eigen::Index>(q)) * J.determinant());
    }
  }
}

/// A point of the middle of a sheet.
struct ShellPoint {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();        // [m]
  Eigen::Vector3d director = Eigen::Vector3d::Zero();  // mean of the nodes', not of length 1
  double thickness = 0.0;                              // [m]
  double area = 0.0;                                   // that it stands for [m2]
};

/// Calls visit(point) at the points of the mass of each shell of a block.
template <class Visit>
void for_each_shell_point(const mesh::Mesh& mesh, const mesh::ShellBlock& block,
                          const RowMatrix& directors, const fe::ShellSection& section,
                          Visit&& visit) {
  const mesh::FaceRule& rule = mesh::face_rule(block.type);
  for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
    const double offset = block.offset.size() > 0 ? block.offset(c) : section.offset;
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const mesh::FaceShape shape = mesh::face_shape(block.type, rule.points.row(q).transpose());
      const Eigen::RowVector3d corner = mesh.nodes.row(block.nodes(c, 0));
      Eigen::Matrix<double, 3, 2> tangent = Eigen::Matrix<double, 3, 2>::Zero();
      ShellPoint point;
      for (Eigen::Index a = 0; a < block.nodes.cols(); ++a) {
        const Eigen::Vector3d director = directors.row(c).segment<3>(3 * a).transpose();
        const Eigen::Vector3d x =
            (mesh.nodes.row(block.nodes(c, a)) - corner).transpose() + offset * director;
        point.at += shape.value(a) * x;
        tangent += x * shape.gradient.row(a);
        point.director += shape.value(a) * director;
        point.thickness += shape.value(a) *
                           (block.thickness.size() > 0 ? block.thickness(c, a) : section.thickness);
      }
      point.at += corner.transpose();
      point.area = rule.weights(q) * tangent.col(0).cross(tangent.col(1)).norm();
      visit(point);
    }
  }
}

}  // namespace clatter::assembly
