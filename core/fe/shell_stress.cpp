// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/shell_stress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/fe/assemble_shells.hpp"
#include "core/fe/shell_directors.hpp"
#include "core/mesh/shape.hpp"

namespace clatter::fe {
namespace {

constexpr double kSameDirector = 1e-9;  // squared distance of unit vectors

/// The means at one node over the cells with one director.
struct Mean {
  Eigen::Vector3d director;
  Voigt outer = Voigt::Zero(), inner = Voigt::Zero();
  int cells = 0;
};

/// The stress at the distance `z` from the mid-surface in a layer, in the global frame.
Voigt stress_at(const ShellStrains& strains, const ShellStiffness& sheet, const SheetLaw& law,
                double z) {
  const Eigen::Vector3d free = sheet.stretch + z / strains.ratio * sheet.curl;
  const Eigen::Vector3d e =
      strains.membrane + z * strains.curvature + strains.rise * (free - law.expansion);
  const Eigen::Vector3d stress = law.plane * e;
  Eigen::Matrix3d local = Eigen::Matrix3d::Zero();
  local(0, 0) = stress(0);
  local(1, 1) = stress(1);
  local(0, 1) = local(1, 0) = stress(2);
  const Eigen::Matrix3d s = strains.axes * local * strains.axes.transpose();
  Voigt out;
  out << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0);
  return out;
}

using NodeStress = std::array<std::pair<Voigt, Voigt>, kShellNodes>;  // outer, inner

/// Points of a cell, and values at its nodes (rows) by those there (columns).
struct Extrapolation {
  Eigen::MatrixX2d points;
  Eigen::MatrixXd to_nodes;
};

Extrapolation extrapolation_of(mesh::FaceType type) {
  const Eigen::MatrixX2d nodes = mesh::reference_nodes(type);
  // The functions of the linear cell with corners at the points.
  const auto through = [&](const Eigen::Vector2d& origin, double size, mesh::FaceType linear) {
    Extrapolation out;
    out.points = (size * mesh::reference_nodes(linear)).rowwise() + origin.transpose();
    out.to_nodes.resize(nodes.rows(), out.points.rows());
    for (Eigen::Index a = 0; a < nodes.rows(); ++a)
      out.to_nodes.row(a) =
          mesh::face_shape(linear, (nodes.row(a).transpose() - origin) / size).value.transpose();
    return out;
  };
  switch (type) {
    case mesh::FaceType::kTri3:
      return {Eigen::RowVector2d::Constant(1.0 / 3.0), Eigen::VectorXd::Ones(3)};
    case mesh::FaceType::kTri6:
      return through(Eigen::Vector2d::Constant(1.0 / 6.0), 0.5, mesh::FaceType::kTri3);
    default:
      return through(Eigen::Vector2d::Zero(), 1.0 / std::sqrt(3.0), mesh::FaceType::kQuad4);
  }
}

/// @param dT of the nodes, or empty.
NodeStress node_stress(const ShellCell& cell, const Extrapolation& by, const FaceLaws& laws,
                       const Eigen::VectorXd& u, const Eigen::VectorXd& dT) {
  const auto both = [&](const Eigen::Vector2d& at) {
    const ShellStrains strains = shell_strains(cell, u, at, dT);
    const double z = 0.5 * cell.thickness * strains.ratio;
    return std::pair(stress_at(strains, cell.stiffness, laws.outer, z),
                     stress_at(strains, cell.stiffness, laws.inner, -z));
  };
  NodeStress out;
  out.fill({Voigt::Zero(), Voigt::Zero()});
  for (Eigen::Index q = 0; q < by.points.rows(); ++q) {
    const auto [outer, inner] = both(by.points.row(q).transpose());
    for (Eigen::Index a = 0; a < by.to_nodes.rows(); ++a) {
      out[a].first += by.to_nodes(a, q) * outer;
      out[a].second += by.to_nodes(a, q) * inner;
    }
  }
  return out;
}

void add(std::vector<Mean>& means, const Eigen::Vector3d& director,
         const std::pair<Voigt, Voigt>& stress) {
  auto found = std::ranges::find_if(means, [&](const Mean& mean) {
    return (mean.director - director).squaredNorm() < kSameDirector;
  });
  if (found == means.end()) found = means.insert(means.end(), Mean{director});
  found->outer += stress.first;
  found->inner += stress.second;
  ++found->cells;
}

/// The largest mean of each node.
RegionStress largest(const std::map<int32_t, std::vector<Mean>>& nodes, const std::string& name,
                     Voigt Mean::*side) {
  RegionStress out;
  out.name = name;
  out.stress.resize(static_cast<Eigen::Index>(nodes.size()), 6);
  out.von_mises.resize(out.stress.rows());
  for (const auto& [node, means] : nodes) {
    const auto row = static_cast<Eigen::Index>(out.nodes.size());
    out.nodes.push_back(node);
    out.von_mises(row) = -1.0;
    for (const Mean& mean : means) {
      const Voigt stress = mean.*side / mean.cells;
      if (const double size = von_mises(stress); size > out.von_mises(row)) {
        out.stress.row(row) = stress.transpose();
        out.von_mises(row) = size;
      }
    }
  }
  return out;
}

/// x y z rx ry rz of the nodes of a cell.
Eigen::VectorXd moved(const mesh::ShellBlock& block, Eigen::Index cell, const Eigen::VectorXd& u,
                      const std::vector<int32_t>& turning, const Eigen::VectorXd& theta) {
  Eigen::VectorXd out(6 * block.nodes.cols());
  for (Eigen::Index a = 0; a < block.nodes.cols(); ++a) {
    const int32_t node = block.nodes(cell, a);
    const auto k = std::ranges::lower_bound(turning, node) - turning.begin();
    out.segment<3>(6 * a) = u.segment<3>(3 * node);
    out.segment<3>(6 * a + 3) = theta.segment<3>(3 * k);
  }
  return out;
}

}  // namespace

std::vector<RegionStress> shell_stress(const RowMatrix& nodes, const FeCells& cells,
                                       const Eigen::VectorXd& u,
                                       const std::vector<int32_t>& turning,
                                       const Eigen::VectorXd& theta, const Eigen::VectorXd& dT) {
  mesh::Mesh mesh;
  mesh.nodes = nodes;
  const std::vector<RowMatrix> directors = shell_directors(nodes, cells.shells);
  std::map<int32_t, std::map<int32_t, std::vector<Mean>>> regions;
  for (size_t b = 0; b < cells.shells.size(); ++b) {
    const mesh::ShellBlock& block = cells.shells[b];
    const Material& material = cells.materials[block.region];
    const ShellSection& section = cells.sections[block.region];
    const FaceLaws laws = face_laws(section, material);
    const Extrapolation by = extrapolation_of(block.type);
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const ShellCell cell = shell_cell(mesh, block, c, directors[b], section, material);
      Eigen::VectorXd rise;
      if (dT.size() > 0) rise = dT(block.nodes.row(c));
      const NodeStress stress =
          node_stress(cell, by, laws, moved(block, c, u, turning, theta), rise);
      for (Eigen::Index a = 0; a < block.nodes.cols(); ++a)
        add(regions[block.region][block.nodes(c, a)], cell.directors.row(a).transpose(), stress[a]);
    }
  }
  std::vector<RegionStress> out;
  for (const auto& [region, means] : regions) {
    out.push_back(largest(means, cells.regions[region] + " (outer)", &Mean::outer));
    out.push_back(largest(means, cells.regions[region] + " (inner)", &Mean::inner));
  }
  return out;
}

}  // namespace clatter::fe
