// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/shell.hpp"

#include <Eigen/Cholesky>
#include <array>

#include "core/fe/element.hpp"
#include "core/fe/shell_kinematics.hpp"

namespace clatter::fe {
namespace {

using SectionMatrix = Eigen::Matrix<double, kShellStrains, kShellStrains>;
using InnerByNodes =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kShellInner, kShellDofs>;
using NodeVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kShellDofs, 1>;
using InnerVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kShellInner, 1>;
using ColumnSquare =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kShellColumns, kShellColumns>;
constexpr int kMaxRows = 9 * kShellStrains;  // of all points
using PointRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxRows, kShellColumns>;
using Strains = Eigen::Matrix<double, kShellStrains, 1>;
using PointStrains = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxRows, 1>;

template <class Body>
auto with_theory(const MidSurface& mid, const Body& body) {
  switch (mid.type) {
    case mesh::FaceType::kTri3:
      return body(TriangleShell(mid));
    case mesh::FaceType::kTri6:
      return body(Triangle6Shell(mid));
    case mesh::FaceType::kQuad8:
      return body(Quad8Shell(mid));
    default:
      return body(QuadShell(mid));
  }
}

double ratio_at(const ShellCell& cell, const ShellWeights& h) {
  return cell.ratio.size() == 0 ? 1.0 : h.dot(cell.ratio);
}

/// Forces by strains, in the order of shell_kinematics.hpp, where the sheet is `ratio` as thick.
SectionMatrix section_at(const ShellStiffness& s, double ratio) {
  SectionMatrix C = SectionMatrix::Zero();
  C.block<3, 3>(0, 0) = ratio * s.A;
  C.block<3, 3>(0, 3) = ratio * ratio * s.B;
  C.block<3, 3>(3, 0) = ratio * ratio * s.B.transpose();
  C.block<3, 3>(3, 3) = ratio * ratio * ratio * s.D;
  C.block<2, 2>(6, 6) = ratio * s.S;
  C(8, 8) = ratio * s.drilling;
  return C;
}

/// Nodes that move by their positions, and do not turn.
NodeVector stretch_of(const ShellCell& cell) {
  NodeVector u = NodeVector::Zero(6 * cell.x.rows());
  for (Eigen::Index i = 0; i < cell.x.rows(); ++i) u.segment<3>(6 * i) = cell.x.row(i);
  return u;
}

/// The same stretch along 1 and 2 per kelvin, which nodes that move by their positions have.
double even_stretch(const ShellCell& cell) {
  return 0.5 * (cell.stiffness.stretch(0) + cell.stiffness.stretch(1));
}

/// The other thermal strains per kelvin where the sheet is `ratio` as thick.
Strains uneven_strains(const ShellCell& cell, double ratio) {
  Strains out = Strains::Zero();
  out.head<3>() = cell.stiffness.stretch;
  out.head<2>().array() -= even_stretch(cell);
  out.segment<3>(3) = cell.stiffness.curl / ratio;
  return out;
}

/// Thermal strains at all points, by the strains of the DoFs there.
PointStrains thermal_strains(const ShellTheory& theory, const ShellCell& cell,
                             const PointRows& strain, const Eigen::VectorXd& dT) {
  PointStrains out =
      even_stretch(cell) * strain.leftCols(theory.node_columns()).lazyProduct(stretch_of(cell));
  const mesh::FaceRule& rule = theory.rule();
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const ShellWeights h = mesh::face_shape(cell.type, rule.points.row(q).transpose()).value;
    auto at = out.segment<kShellStrains>(kShellStrains * q);
    at = h.dot(dT) * (at + uneven_strains(cell, ratio_at(cell, h)));
  }
  return out;
}

/// Stiffness of the mid-surface, and the inner DoFs by those of the nodes: inner u + warm.
struct Condensed {
  ShellMatrix K;
  InnerByNodes inner;
  InnerVector warm;  // of thermal strains
  NodeVector force;  // of thermal strains
};

Condensed condense(const ShellTheory& theory, const ShellCell& cell, const Eigen::VectorXd& dT) {
  const mesh::FaceRule& rule = theory.rule();
  const Eigen::Index points = rule.weights.size(), n = theory.node_columns(), c = theory.columns();
  PointRows strain, force;
  strain.resize(kShellStrains * points, c);
  force.resize(kShellStrains * points, c);
  for (Eigen::Index q = 0; q < points; ++q) {
    const SurfacePoint p(theory.mid(), rule.points.row(q).transpose());
    const ShellStrain B = theory.strain(p);
    const double weight = rule.weights(q) * p.area;
    strain.middleRows<kShellStrains>(kShellStrains * q) = B;
    force.middleRows<kShellStrains>(kShellStrains * q) =
        (weight * section_at(cell.stiffness, ratio_at(cell, p.h))).lazyProduct(B);
  }
  ColumnSquare K(c, c);
  K.noalias() = strain.transpose() * force;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kShellInner, kShellInner> own =
      K.bottomRightCorner(c - n, c - n);
  Condensed out;
  // LDL^T: where the section does not resist, inner DoFs are zero.
  const auto factor = own.ldlt();
  out.inner = -factor.solve(K.bottomLeftCorner(c - n, n));
  out.K = K.topLeftCorner(n, n) + K.topRightCorner(n, c - n).lazyProduct(out.inner);
  out.warm.setZero(c - n);
  if (dT.size() == 0) return out;
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kShellColumns, 1> f =
      force.transpose().lazyProduct(thermal_strains(theory, cell, strain, dT));
  out.warm = factor.solve(f.tail(c - n));
  out.force = f.head(n) + out.inner.transpose().lazyProduct(f.tail(c - n));
  return out;
}

using MovingSquare =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kShellNodes + 1, kShellNodes + 1>;

/// int m_i m_j of ShellMass.
struct NodalMass {
  Eigen::MatrixXd total, moment, rotary;
};

/// From what moves to the nodes and the centre of a quad8, which also moves with its nodes.
MovingSquare with_centre(const MidSurface& mid) {
  const Eigen::Index n = mid.moving_V.rows(), nodes = mid.x.rows();
  MovingSquare out = MovingSquare::Identity(n, n);
  if (n > nodes)
    out.row(nodes).head(nodes) = SurfacePoint(mid, Eigen::Vector2d::Zero()).h.transpose();
  return out;
}

/// @param n of what moves, from the first.
NodalMass nodal_mass(const MidSurface& mid, const ShellCell& cell, Eigen::Index n) {
  const mesh::FaceRule& rule = mesh::face_rule(mid.type);
  NodalMass out;
  for (Eigen::MatrixXd* m : {&out.total, &out.moment, &out.rotary}) m->setZero(n, n);
  const ShellMass& of = cell.stiffness.mass;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const SurfacePoint p(mid, rule.points.row(q).transpose());
    const double ratio = ratio_at(cell, p.h), weight = rule.weights(q) * p.area;
    const MovingSquare area = weight * p.m.head(n) * p.m.head(n).transpose();
    out.total += (of.area_mass + ratio * (of.total - of.area_mass)) * area;
    out.moment += ratio * ratio * of.moment * area;
    out.rotary += ratio * ratio * ratio * of.rotary * area;
  }
  return out;
}

/// At the nodes, and at the centre of a quad8, where its nine Lagrange functions are 1.
void lump(const MidSurface& mid, NodalMass& nodal) {
  const MovingSquare to_nodes = with_centre(mid), from_nodes = to_nodes.inverse();
  for (Eigen::MatrixXd* m : {&nodal.total, &nodal.moment, &nodal.rotary}) {
    if (m->trace() == 0.0) continue;
    *m = from_nodes.transpose() * *m * from_nodes;
    lump_hrz(*m);
    *m = to_nodes.transpose() * *m * to_nodes;
  }
}

/// Of the mid-surface. A rotation about a director moves no mass: its inertia is that of
/// w = theta x V. The centre of a quad8 moves by `inner` with the nodes; with kNodes it rests.
ShellMatrix mass_of(const MidSurface& mid, const ShellCell& cell, MassForm form,
                    const InnerByNodes& inner) {
  const Eigen::Index n = form == MassForm::kNodes ? mid.x.rows() : mid.moving_V.rows();
  NodalMass nodal = nodal_mass(mid, cell, n);
  if (form == MassForm::kHrz) lump(mid, nodal);
  std::array<Eigen::Matrix3d, kShellNodes + 1> turned;  // theta x V = turned theta
  for (Eigen::Index i = 0; i < n; ++i) turned[i] = cross_matrix(mid.moving_V.row(i));
  constexpr int kMost = kShellDofs + 6;
  using Mass = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMost, kMost>;
  Mass M = Mass::Zero(6 * n, 6 * n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      M.block<3, 3>(6 * i, 6 * j).diagonal().setConstant(nodal.total(i, j));
      M.block<3, 3>(6 * i, 6 * j + 3) = nodal.moment(i, j) * turned[j];
      M.block<3, 3>(6 * i + 3, 6 * j) = nodal.moment(i, j) * turned[i].transpose();
      M.block<3, 3>(6 * i + 3, 6 * j + 3) =
          nodal.rotary(i, j) * turned[i].transpose().lazyProduct(turned[j]);
    }
  const Eigen::Index nodes = 6 * mid.x.rows();
  if (M.rows() == nodes) return M;
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kShellDofs> centre(6, nodes);
  centre.topRows<3>() = inner.topRows<3>();
  centre.bottomRows<3>() = SurfacePoint(mid, Eigen::Vector2d::Zero())
                               .axes.leftCols<2>()
                               .lazyProduct(inner.bottomRows<2>());
  ShellMatrix out = M.topLeftCorner(nodes, nodes) + M.topRightCorner(nodes, 6).lazyProduct(centre);
  out += centre.transpose().lazyProduct(M.bottomLeftCorner(6, nodes) +
                                        M.bottomRightCorner(6, 6).lazyProduct(centre));
  return out;
}

/// From DoFs of the mid-surface to those of the nodes: u_mid = u + theta x (offset V).
void to_nodes(const ShellCell& cell, ShellMatrix& A) {
  if (cell.offset == 0.0) return;
  for (Eigen::Index i = 0; i < cell.x.rows(); ++i) {
    const Eigen::Matrix3d arm = cross_matrix(cell.offset * cell.directors.row(i));
    A.middleCols<3>(6 * i + 3) += A.middleCols<3>(6 * i).lazyProduct(arm);
    A.middleRows<3>(6 * i + 3) += arm.transpose().lazyProduct(A.middleRows<3>(6 * i));
  }
}

}  // namespace

bool compute_shell(const ShellCell& cell, MassForm form, ShellMatrices& out) {
  const MidSurface mid(cell);
  return with_theory(mid, [&](const ShellTheory& theory) {
    if (!theory.is_shell()) return false;
    const Condensed condensed = condense(theory, cell, {});
    out.stiffness = 0.5 * (condensed.K + condensed.K.transpose());
    out.mass = mass_of(mid, cell, form, condensed.inner);
    to_nodes(cell, out.stiffness);
    to_nodes(cell, out.mass);
    return true;
  });
}

ShellStrains shell_strains(const ShellCell& cell, const Eigen::VectorXd& u,
                           const Eigen::Vector2d& at, const Eigen::VectorXd& dT) {
  const MidSurface mid(cell);
  NodeVector moved = u;
  for (Eigen::Index i = 0; i < cell.x.rows(); ++i)
    moved.segment<3>(6 * i) +=
        cross_matrix(cell.offset * cell.directors.row(i)) * u.segment<3>(6 * i + 3);
  return with_theory(mid, [&](const ShellTheory& theory) {
    const Condensed condensed = condense(theory, cell, dT);
    const SurfacePoint p(mid, at);
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kShellColumns, 1> all(theory.columns());
    all << moved, condensed.inner * moved + condensed.warm;
    const double rise = dT.size() > 0 ? p.h.dot(dT) : 0.0, ratio = ratio_at(cell, p.h);
    all.head(moved.size()) -= rise * even_stretch(cell) * stretch_of(cell);
    const Strains e = theory.strain(p) * all - rise * uneven_strains(cell, ratio);
    return ShellStrains{e.head<3>(), e.segment<3>(3), e.segment<2>(6), p.axes, ratio, rise};
  });
}

Eigen::VectorXd shell_thermal_force(const ShellCell& cell, const Eigen::VectorXd& dT) {
  const MidSurface mid(cell);
  return with_theory(mid, [&](const ShellTheory& theory) {
    Eigen::VectorXd force = condense(theory, cell, dT).force;
    for (Eigen::Index i = 0; i < cell.x.rows(); ++i)
      force.segment<3>(6 * i + 3) +=
          cross_matrix(cell.offset * cell.directors.row(i)).transpose() * force.segment<3>(6 * i);
    return force;
  });
}

}  // namespace clatter::fe
