// SPDX-License-Identifier: GPL-3.0-or-later
#include "shell_meshes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "core/fe/shell_directors.hpp"

namespace clatter::fe::testing {
namespace {

/// Position i of m in a side divided as 1 : 2 : ... : m, and as m : ... : 1.
std::array<double, 2> divided(int i, int m) {
  const double all = m * (m + 1);
  return {i * (i + 1) / all, 1.0 - (m - i) * (m - i + 1) / all};
}

Eigen::Vector2d crossing(int i, int nu, int j, int nv) {
  const auto [a, b] = divided(i, nu);
  const auto [e, g] = divided(j, nv);
  const double u = (a + (b - a) * e) / (1.0 - (b - a) * (g - e));
  return {u, e + (g - e) * u};
}

IndexMatrix grid(int nu, int nv) {
  IndexMatrix quads(nu * nv, 4);
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const int first = j * (nu + 1) + i;
      quads.row(j * nu + i) << first, first + 1, first + nu + 2, first + nu + 1;
    }
  return quads;
}

}  // namespace

std::vector<mesh::ShellBlock> blocks_of(const IndexMatrix& quads, Cells cells) {
  mesh::ShellBlock quad, tri;
  tri.type = mesh::FaceType::kTri3;
  quad.nodes.resize(quads.rows(), 4);
  tri.nodes.resize(2 * quads.rows(), 3);
  Eigen::Index n_quads = 0, n_triangles = 0;
  for (Eigen::Index c = 0; c < quads.rows(); ++c) {
    const auto q = quads.row(c);
    const bool is_quad = cells == Cells::kQuads || cells == Cells::kQuads8;
    if (is_quad || (cells == Cells::kMixed && c % 2 == 0)) {
      quad.nodes.row(n_quads++) = q;
    } else {
      tri.nodes.row(n_triangles++) << q(0), q(1), q(2);
      tri.nodes.row(n_triangles++) << q(0), q(2), q(3);
    }
  }
  quad.nodes.conservativeResize(n_quads, 4);
  tri.nodes.conservativeResize(n_triangles, 3);
  std::vector<mesh::ShellBlock> out;
  if (n_quads > 0) out.push_back(quad);
  if (n_triangles > 0) out.push_back(tri);
  return out;
}

void add_middles(Sheet& sheet, const Map* map) {
  std::map<std::pair<int, int>, int> middles;
  std::vector<Eigen::RowVector3d> at;
  std::vector<Eigen::RowVector2d> uv;
  const int first = static_cast<int>(sheet.nodes.rows());
  for (mesh::ShellBlock& block : sheet.shells) {
    const int corners = mesh::traits(block.type).corners;
    block.type = corners == 3 ? mesh::FaceType::kTri6 : mesh::FaceType::kQuad8;
    block.nodes.conservativeResize(Eigen::NoChange, 2 * corners);
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c)
      for (int i = 0; i < corners; ++i) {
        const int a = block.nodes(c, i), b = block.nodes(c, (i + 1) % corners);
        const auto [known, added] =
            middles.try_emplace(std::minmax(a, b), first + static_cast<int>(at.size()));
        block.nodes(c, corners + i) = known->second;
        if (!added) continue;
        if (sheet.uv.rows() > 0) uv.push_back(0.5 * (sheet.uv.row(a) + sheet.uv.row(b)));
        if (map != nullptr)
          at.push_back((*map)(uv.back()(0), uv.back()(1)).transpose());
        else
          at.push_back(0.5 * (sheet.nodes.row(a) + sheet.nodes.row(b)));
      }
  }
  sheet.nodes.conservativeResize(first + std::ssize(at), Eigen::NoChange);
  for (size_t i = 0; i < at.size(); ++i) sheet.nodes.row(first + static_cast<int>(i)) = at[i];
  if (sheet.uv.rows() == 0) return;
  sheet.uv.conservativeResize(first + std::ssize(uv), Eigen::NoChange);
  for (size_t i = 0; i < uv.size(); ++i) sheet.uv.row(first + static_cast<int>(i)) = uv[i];
}

Sheet mapped(const Map& map, int nu, int nv, Cells cells, bool distorted) {
  const int n = (nu + 1) * (nv + 1);
  const IndexMatrix quads = grid(nu, nv);
  Sheet sheet{RowMatrix(n, 3), RowMatrix(n, 2), blocks_of(quads, cells), quads};
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i) {
      const Eigen::Vector2d uv =
          distorted ? crossing(i, nu, j, nv) : Eigen::Vector2d(double(i) / nu, double(j) / nv);
      sheet.uv.row(j * (nu + 1) + i) = uv.transpose();
      sheet.nodes.row(j * (nu + 1) + i) = map(uv(0), uv(1)).transpose();
    }
  if (cells == Cells::kQuads8 || cells == Cells::kTriangles6) add_middles(sheet, &map);
  return sheet;
}

ShellStiffness stiffness_of(const Plate& plate) {
  const Material material{.youngs = plate.E, .poisson = plate.nu, .density = plate.rho};
  ShellStiffness out = fe::stiffness_of(ShellSection{}, material, plate.thickness);
  out.drilling *= plate.drilling / 1e-4;
  out.stretch = Eigen::Vector3d(1.0, 1.0, 0.0);  // tests warm it by strains
  return out;
}

ShellCell cell_of(const Sheet& sheet, const std::vector<RowMatrix>& directors, const Plate& plate,
                  size_t block, Eigen::Index row) {
  const mesh::ShellBlock& shells = sheet.shells[block];
  const Eigen::Index n = shells.nodes.cols();
  ShellCell cell;
  cell.type = shells.type;
  cell.x.resize(n, 3);
  cell.directors.resize(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    cell.x.row(i) = sheet.nodes.row(shells.nodes(row, i));
    cell.directors.row(i) = directors[block].row(row).segment<3>(3 * i);
  }
  cell.stiffness = stiffness_of(plate);
  cell.thickness = plate.thickness;
  cell.offset = plate.offset;
  return cell;
}

ShellCell cell_alone(const ShellNodes& x, const Plate& plate) {
  Sheet sheet;
  sheet.nodes = x;
  const int n = static_cast<int>(x.rows());
  sheet.shells.resize(1);
  for (const mesh::FaceType type : {mesh::FaceType::kTri3, mesh::FaceType::kTri6,
                                    mesh::FaceType::kQuad4, mesh::FaceType::kQuad8})
    if (mesh::traits(type).nodes == n) sheet.shells[0].type = type;
  sheet.shells[0].nodes.resize(1, n);
  for (int i = 0; i < n; ++i) sheet.shells[0].nodes(0, i) = i;
  return cell_of(sheet, shell_directors(sheet.nodes, sheet.shells), plate, 0, 0);
}

SheetMatrices assemble(const Sheet& sheet, const Plate& plate) {
  const std::vector<RowMatrix> directors = shell_directors(sheet.nodes, sheet.shells);
  std::vector<Eigen::Triplet<double>> k, m;
  ShellMatrices matrices;
  for (size_t b = 0; b < sheet.shells.size(); ++b)
    for (Eigen::Index c = 0; c < sheet.shells[b].nodes.rows(); ++c) {
      const bool ok = compute_shell(cell_of(sheet, directors, plate, b, c), plate.mass, matrices);
      if (!ok) throw std::runtime_error("a cell is no shell");
      const auto dof = [&](Eigen::Index i) {
        return 6 * sheet.shells[b].nodes(c, i / 6) + static_cast<int>(i % 6);
      };
      for (Eigen::Index i = 0; i < matrices.stiffness.rows(); ++i)
        for (Eigen::Index j = 0; j < matrices.stiffness.cols(); ++j) {
          if (dof(i) < dof(j)) continue;
          k.emplace_back(dof(i), dof(j), matrices.stiffness(i, j));
          if (matrices.mass(i, j) != 0.0) m.emplace_back(dof(i), dof(j), matrices.mass(i, j));
        }
    }
  const Eigen::Index n = 6 * sheet.nodes.rows();
  SheetMatrices out{Sparse(n, n), Sparse(n, n)};
  out.K.setFromTriplets(k.begin(), k.end());
  out.M.setFromTriplets(m.begin(), m.end());
  return out;
}

Eigen::MatrixXd rigid_motions(const RowMatrix& nodes) {
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(6 * nodes.rows(), 6);
  for (Eigen::Index i = 0; i < nodes.rows(); ++i)
    for (int d = 0; d < 3; ++d) {
      R(6 * i + d, d) = 1.0;
      R(6 * i + 3 + d, 3 + d) = 1.0;
      const Eigen::Vector3d x = nodes.row(i);
      R.block<3, 1>(6 * i, 3 + d) = Eigen::Vector3d::Unit(d).cross(x);
    }
  return R;
}

std::vector<int> dofs_where(const Sheet& sheet, const std::vector<int>& dofs,
                            const std::function<bool(double, double)>& is) {
  std::vector<int> out;
  for (Eigen::Index i = 0; i < sheet.uv.rows(); ++i)
    if (is(sheet.uv(i, 0), sheet.uv(i, 1)))
      for (const int d : dofs) out.push_back(static_cast<int>(6 * i) + d);
  return out;
}

std::vector<int> joined(const std::vector<std::vector<int>>& lists) {
  std::vector<int> out;
  for (const std::vector<int>& list : lists) out.insert(out.end(), list.begin(), list.end());
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace clatter::fe::testing
