// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the triangles and quadrilaterals of shells have in common: their surface, and the strains
// by the motions of their nodes. Used by shell*.cpp alone.
//
// Strains, nine rows: membrane 11 22 12, curvature 11 22 12, shear 13 23, and the rotation about
// the normal beside that of the membrane (drilling). Columns: six DoFs of each node, then those
// that the cell has beside its nodes.
#include <array>

#include "core/fe/shell.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"

namespace clatter::fe {

inline constexpr int kShellStrains = 9;
inline constexpr int kShellInner = 5;                           // at most
inline constexpr int kShellColumns = kShellDofs + kShellInner;  // at most

using ShellRow = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, kShellColumns>;
template <int rows>
using ShellRows = Eigen::Matrix<double, rows, Eigen::Dynamic, 0, rows, kShellColumns>;
using ShellStrain = ShellRows<kShellStrains>;
/// Of each node, or of each that moves: the centre of a quad8 does so too.
using ShellWeights = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kShellNodes + 1, 1>;

/// theta x v = cross_matrix(v) theta.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

/// The mid-surface of a cell.
struct MidSurface {
  mesh::FaceType type;
  ShellNodes x, V;
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kShellNodes + 1, 3> moving_V;  // of what moves
  Eigen::Vector3d axis;  // of direction 1, not zero

  explicit MidSurface(const ShellCell& cell);
};

/// A point of it.
struct SurfacePoint {
  Eigen::Vector2d at;          // r, s
  ShellWeights h, h_r, h_s;    // shape functions of the nodes
  ShellWeights m, m_r, m_s;    // of the motion: those, and of a quad8 (1 - r^2)(1 - s^2)
  Eigen::Vector3d x_r, x_s;    // [m]
  Eigen::Vector3d normal;      // unit
  double area;                 // |x,r x x,s| [m2]
  Eigen::Matrix3d axes;        // columns: 1, 2, normal
  Eigen::Matrix2d to_axes;     // (a, i): direction a along the contravariant vector i
  Eigen::Matrix3d strain_map;  // 11 22 12 (engineering) by rr ss rs (tensor) components

  SurfacePoint(const MidSurface& mid, const Eigen::Vector2d& at);

 private:
  void add_centre();
};

/// Strains of one kind of cell.
class ShellTheory {
 public:
  virtual ~ShellTheory() = default;

  /// Of the stiffness.
  virtual const mesh::FaceRule& rule() const = 0;
  virtual ShellStrain strain(const SurfacePoint& point) const = 0;
  /// Neither concave, folded, nor without area.
  virtual bool is_shell() const;

  const MidSurface& mid() const { return mid_; }
  Eigen::Index node_columns() const { return 6 * mid_.x.rows(); }
  Eigen::Index columns() const { return node_columns() + inner_; }

 protected:
  ShellTheory(const MidSurface& mid, const Eigen::Vector2d& centre, int inner)
      : mid_(mid), centre_(mid, centre), inner_(inner) {}

  /// direction . sum weight_i u_i, and direction . sum weight_i theta_i x V_i.
  ShellRow translation(const Eigen::Vector3d& direction, const ShellWeights& weight) const;
  ShellRow turning(const Eigen::Vector3d& direction, const ShellWeights& weight) const;

  /// Components rr ss rs of the membrane strain, (x,i . u,j + x,j . u,i) / 2.
  ShellRows<3> membrane(const SurfacePoint& point) const;
  /// Of the curvature, (x,i . w,j + x,j . w,i + V,i . u,j + V,j . u,i) / 2.
  ShellRows<3> curvature(const SurfacePoint& point) const;
  /// Twice the component of the shear strain along r (0) or s (1): x,i . w + V . u,i.
  ShellRow shear(const SurfacePoint& point, int i) const;
  /// By the motion of the nodes alone.
  ShellRow drilling(const SurfacePoint& point) const;
  /// direction . theta x V of a rotation in two inner columns, at the centre about its directions 1
  /// and 2, whose factor (a bubble or its derivative) is `factor`.
  void add_bubble(const Eigen::Vector3d& direction, double factor, ShellRow& row) const;
  /// The curvature's rr ss rs of the bubble 27 r s (1 - r - s) of a triangle.
  void add_bubble(const SurfacePoint& point, ShellRows<3>& curvature) const;
  double bubble(const Eigen::Vector2d& at) const { return 27.0 * at(0) * at(1) * (1.0 - at.sum()); }
  /// The rows of `point` by components: rr ss rs of the membrane and curvature, r s of the shear.
  ShellStrain in_axes(const SurfacePoint& point, const ShellRows<3>& membrane,
                      const ShellRows<3>& curvature, const ShellRows<2>& shear) const;

  const MidSurface& mid_;
  SurfacePoint centre_;

 private:
  int inner_;
};

/// Four inner columns: the enhanced strains.
class QuadShell final : public ShellTheory {
 public:
  explicit QuadShell(const MidSurface& mid);
  const mesh::FaceRule& rule() const override { return mesh::quad_rule_4(); }
  ShellStrain strain(const SurfacePoint& point) const override;
  bool is_shell() const override;

 private:
  ShellRows<3> unwarped(const Eigen::Vector2d& at) const;
  void replace_warp();

  ShellRow constant_r_, constant_s_, constant_rs_, linear_r_, linear_s_, bilinear_, replaced_;
  Eigen::Vector2d skew_;                            // c_r, c_s: 0 for parallelograms
  ShellRow shear_a_, shear_b_, shear_c_, shear_d_;  // at (0, 1), (-1, 0), (0, -1), (1, 0)
};

/// Two inner columns: rotations of the bubble.
class TriangleShell final : public ShellTheory {
 public:
  explicit TriangleShell(const MidSurface& mid);
  const mesh::FaceRule& rule() const override { return mesh::triangle_rule_6(); }
  ShellStrain strain(const SurfacePoint& point) const override;

 private:
  ShellRows<2> shear_at(double r, double s) const;

  ShellRows<3> membrane_;
  ShellRow mean_r_, mean_s_, twist_;  // of the tied shear strains
};

/// Of a quad8 a component along one direction of the membrane strain, the curvature and the shear
/// strain; of a tri6 one of the membrane strain at three points.
using TiedRows = ShellRows<3>;

/// Five inner columns: the motion of the centre beside that of the nodes, without rotation about
/// the director, which would move nothing.
class Quad8Shell final : public ShellTheory {
 public:
  explicit Quad8Shell(const MidSurface& mid);
  const mesh::FaceRule& rule() const override { return mesh::quad_rule_9(); }
  ShellStrain strain(const SurfacePoint& point) const override;

 private:
  ShellStrain tied(const SurfacePoint& point) const;

  std::array<TiedRows, 6> along_r_, along_s_;
  std::array<ShellRows<2>, 4> across_;  // rs of the membrane strain and the curvature
  ShellRows<6> missing_;                // mean of what the tied ones leave out, in axes
};

/// Two inner columns: rotations of the bubble.
class Triangle6Shell final : public ShellTheory {
 public:
  explicit Triangle6Shell(const MidSurface& mid);
  const mesh::FaceRule& rule() const override { return mesh::triangle_rule_6(); }
  ShellStrain strain(const SurfacePoint& point) const override;

 private:
  std::array<TiedRows, 3> sides_;  // membrane strain along each, at three points
  ShellRows<8> shear_;             // coefficients of the shear strains
};

}  // namespace clatter::fe
