// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/heat.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "core/fe/cell_points.hpp"
#include "core/fe/cell_strain.hpp"
#include "core/fe/element.hpp"
#include "core/mesh/face_points.hpp"
#include "core/mesh/quadrature.hpp"

namespace clatter::fe {
namespace {

constexpr Eigen::Index kHeatChunk = 2048;  // cells whose matrices are held at once

/// The value at a point of a face with shape functions N.
double value_at(const SurfaceValue& value, const auto& face, const auto& N,
                const Eigen::Vector3d& x) {
  if (const auto* nodal = std::get_if<Eigen::VectorXd>(&value)) {
    double sum = 0.0;
    for (Eigen::Index a = 0; a < N.size(); ++a) sum += N(a) * (*nodal)(face(a));
    return sum;
  }
  return std::get<0>(value)(x);
}

/// Adds a cell's matrix to the lower triangle.
void add_cell(const NodePattern& pattern, const Eigen::MatrixXd& cell, const auto& nodes,
              double* values) {
  for (Eigen::Index b = 0; b < nodes.size(); ++b) {
    const int32_t column = nodes(b);
    double* entries = values + pattern.start[static_cast<size_t>(column)];
    for (Eigen::Index a = 0; a < nodes.size(); ++a)
      if (nodes(a) >= column) entries[pattern.position(column, nodes(a))] += cell(a, b);
  }
}

}  // namespace

Eigen::MatrixXd cell_conduction(mesh::CellType type, const mesh::CellNodes& x,
                                const Material& material) {
  const CellModes modes(x, false);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(x.rows(), x.rows());
  ModeGradient gradient;
  for (const CellPoint& point : stiffness_points(type, Integration::kFull, is_straight(type, x))) {
    const Eigen::Vector3d position = x.transpose() * point.shape.value;
    const double det = modes.at(point, gradient);
    if (!(det > 0.0))
      throw InputError(fmt::format(
          "conduction at ({:.6g}, {:.6g}, {:.6g}) m: found det J = {:.3g}, expected > 0 (inverted "
          "cell)",
          position(0), position(1), position(2), det));
    K.noalias() +=
        gradient * (point.weight * det * material.conductivity_at(position)) * gradient.transpose();
  }
  return K;
}

SparseMatrix conduction(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                        const NodePattern& pattern) {
  const auto n = static_cast<Eigen::Index>(pattern.nodes());
  SparseMatrix K(n, n);
  K.resizeNonZeros(static_cast<Eigen::Index>(pattern.rows.size()));
  std::transform(pattern.start.begin(), pattern.start.end(), K.outerIndexPtr(),
                 [](int64_t start) { return static_cast<int32_t>(start); });
  std::copy(pattern.rows.begin(), pattern.rows.end(), K.innerIndexPtr());
  std::fill_n(K.valuePtr(), pattern.rows.size(), 0.0);
  std::vector<Eigen::MatrixXd> chunk(kHeatChunk);
  for (const mesh::CellBlock& block : mesh.cells) {
    const Material& material = materials.at(static_cast<size_t>(block.region));
    for (Eigen::Index first = 0; first < block.nodes.rows(); first += kHeatChunk) {
      const Eigen::Index count = std::min(kHeatChunk, block.nodes.rows() - first);
      parallel_pieces(count, [&](int64_t begin, int64_t end) {
        for (int64_t c = begin; c < end; ++c)
          chunk[static_cast<size_t>(c)] =
              cell_conduction(block.type, mesh::cell_nodes(mesh, block, first + c), material);
      });
      // One thread adds in the order of the cells: the sum does not depend on the thread count.
      for (Eigen::Index c = 0; c < count; ++c)
        add_cell(pattern, chunk[static_cast<size_t>(c)], block.nodes.row(first + c), K.valuePtr());
    }
  }
  return K;
}

Eigen::VectorXd volume_heat(const mesh::Mesh& mesh, const std::vector<double>& source) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(mesh.nodes.rows());
  for (const mesh::CellBlock& block : mesh.cells) {
    const double s = source.at(static_cast<size_t>(block.region));
    if (s == 0.0) continue;
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const mesh::CellNodes x = mesh::cell_nodes(mesh, block, c);
      for (const CellPoint& point : mass_points(block.type, is_straight(block.type, x))) {
        const double dV = point.weight * jacobian(x, point).determinant();
        for (Eigen::Index a = 0; a < x.rows(); ++a)
          q(block.nodes(c, a)) += s * dV * point.shape.value(a);
      }
    }
  }
  return q;
}

SurfaceHeat film_heat(const RowMatrix& nodes, const mesh::Surface& surface,
                      const SurfaceValue& coefficient, const SurfaceValue& temperature) {
  const Eigen::Index n = nodes.rows();
  SurfaceHeat out{SparseMatrix(n, n), Eigen::VectorXd::Zero(n)};
  std::vector<Eigen::Triplet<double, int32_t>> entries;
  mesh::for_each_face_point(nodes, surface,
                            [&](const auto& face, const auto& N, const Eigen::Vector3d& x,
                                double weight, const Eigen::Vector3d& normal) {
                              const double dS = weight * normal.norm();
                              const double h = value_at(coefficient, face, N, x);
                              const double heat = h * value_at(temperature, face, N, x);
                              for (Eigen::Index a = 0; a < N.size(); ++a) {
                                out.q(face(a)) += heat * dS * N(a);
                                for (Eigen::Index b = 0; b < N.size(); ++b)
                                  if (face(a) >= face(b))
                                    entries.emplace_back(face(a), face(b), h * dS * N(a) * N(b));
                              }
                            });
  out.H.setFromTriplets(entries.begin(), entries.end());
  return out;
}

Eigen::VectorXd flux_heat(const RowMatrix& nodes, const mesh::Surface& surface,
                          const SurfaceValue& flux) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(nodes.rows());
  mesh::for_each_face_point(nodes, surface,
                            [&](const auto& face, const auto& N, const Eigen::Vector3d& x,
                                double weight, const Eigen::Vector3d& normal) {
                              const double heat =
                                  value_at(flux, face, N, x) * (weight * normal.norm());
                              for (Eigen::Index a = 0; a < N.size(); ++a) q(face(a)) += heat * N(a);
                            });
  return q;
}

}  // namespace clatter::fe
