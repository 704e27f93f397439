// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Small models of shells, assembled and solved by Eigen alone.
#include <Eigen/SparseCore>
#include <functional>
#include <vector>

#include "core/fe/shell.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::fe::testing {

using Sparse = Eigen::SparseMatrix<double>;
using Map = std::function<Eigen::Vector3d(double u, double v)>;

/// Cells of a grid; triangles: each quadrilateral cut from its first to its third node.
enum class Cells { kQuads, kTriangles, kMixed, kQuads8, kTriangles6 };

struct Sheet {
  RowMatrix nodes;
  RowMatrix uv;  // of each node
  std::vector<mesh::ShellBlock> shells{};
  IndexMatrix grid{};  // the quadrilaterals that the shells are
};

/// The unit square in nu x nv cells, mapped. Distorted: sides divided as 1 : 2 : ..., opposite ones
/// reversed, joined by straight lines (Bucalem and Bathe, as in tests of MITC shells).
Sheet mapped(const Map& map, int nu, int nv, Cells cells, bool distorted = false);
/// Quadrilaterals as cells of this kind, quadratic ones without their mid-side nodes.
std::vector<mesh::ShellBlock> blocks_of(const IndexMatrix& quads, Cells cells);
/// Gives linear cells mid-side nodes at map(mean of u, mean of v), or in the middle of their sides.
void add_middles(Sheet& sheet, const Map* map = nullptr);

/// One sheet of one thickness.
struct Plate {
  double E = 0.0, nu = 0.0, rho = 1.0, thickness = 0.0;
  double offset = 0.0;
  double drilling = 1e-4;
  MassForm mass = MassForm::kConsistent;
};

ShellStiffness stiffness_of(const Plate& plate);
/// Cells with their directors: block, row.
ShellCell cell_of(const Sheet& sheet, const std::vector<RowMatrix>& directors, const Plate& plate,
                  size_t block, Eigen::Index row);
/// A cell of 3, 4, 6 or 8 nodes alone, its directors the normals there.
ShellCell cell_alone(const ShellNodes& x, const Plate& plate);

struct SheetMatrices {
  Sparse K, M;  // 6 DoFs a node, lower triangles
};
SheetMatrices assemble(const Sheet& sheet, const Plate& plate);

/// A x for a lower triangle A.
Eigen::MatrixXd times(const Sparse& A, const Eigen::MatrixXd& x);

/// Six motions of nodes as a rigid body.
Eigen::MatrixXd rigid_motions(const RowMatrix& nodes);

/// K u = f with u of `fixed` DoFs given.
Eigen::VectorXd solve(const Sparse& K, const Eigen::VectorXd& f, const std::vector<int>& fixed,
                      const Eigen::VectorXd& given);

/// The lowest frequencies [Hz], of a free one too; zero where lambda < 0 by rounding.
/// @param below [Hz] the spectrum is inverted at -(2 pi below)^2
Eigen::VectorXd frequencies(const SheetMatrices& model, const std::vector<int>& fixed, int count,
                            double below);

/// DoFs (0 ... 5) of the nodes where `is` holds for u, v.
std::vector<int> dofs_where(const Sheet& sheet, const std::vector<int>& dofs,
                            const std::function<bool(double, double)>& is);
std::vector<int> joined(const std::vector<std::vector<int>>& lists);

}  // namespace clatter::fe::testing
