// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The gap between skirt and liner: cold shape, and its change by displacements of the two bodies.
//
// Angles of pads count from the thrust side (+y) right-handed about z: the outward normal at angle
// f is n = (-sin f, cos f, 0).
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "core/rom/reduced_model.hpp"
#include "dynamics/film/grid.hpp"

namespace clatter::film {

/// Outward normal at pad angle `angle` [rad].
Eigen::Vector3d pad_normal(double angle);

/// Shape of the skirt as relief: its radial distance inside a cylinder of the skirt's largest
/// radius.
///
/// relief(f, z) = barrel(z) + ovality sin^2 f; barrel by the table when it is given (linear
/// between its points, constant beyond), else two half parabolas from `barrel_apex`.
struct SkirtShape {
  std::vector<double> table_height;  // z from the pin centre, ascending [m]
  std::vector<double> table_relief;  // radial relief there [m]
  double barrel_apex = 0.0;          // z of the largest diameter [m]
  double barrel_top = 0.0;           // radial relief at the upper end of the pad [m]
  double barrel_bottom = 0.0;        // radial relief at the lower end of the pad [m]
  double ovality = 0.0;              // radial relief in the pin direction (f = 90 deg) [m]
};

/// Relief at the cell centres of `pad` [m], n. InputError when the table does not ascend.
Eigen::ArrayXd skirt_relief(const SkirtShape& shape, const PadGrid& pad);

/// Deviation of the liner (or skirt) from its cylinder, at rest: warm, bolted, worn. Bilinear,
/// constant beyond its ends.
struct LinerShape {
  Eigen::VectorXd angle;   // n_a, pad angles [rad], ascending, within one turn; closed periodically
  Eigen::VectorXd height;  // n_z, engine z (of a skirt: from the pin) [m], ascending
  Eigen::MatrixXd deviation;  // n_a x n_z, outward positive [m]
};

/// A body's surface described by mean radial displacements of patches.
struct ElasticSurface {
  rom::ContactGrid grid;  // patches, axis along +z or -z
  Eigen::MatrixXd
      rigid;  // n x 6: patch values under unit rigid motions x, y, z, rx, ry, rz about the
              // frame's origin (rows of ReducedModel::rigid); 0 rows: taken from the patch centres
};

/// Rigid motions x, y, rx, ry, which move a cylinder's surface radially.
constexpr int kFits = 4;

/// R_patches, n x 4: patch values of a surface under unit rigid motions x, y, rx, ry. InputError
/// when `surface.rigid` is of another shape.
Eigen::MatrixXd radial_motions(const ElasticSurface& surface);
/// R_patches^+, 4 x n: the rigid motion x, y, rx, ry about the frame's origin that fits the patches
/// best. Its transpose distributes a force or couple with exactly that resultant.
Eigen::MatrixXd rigid_fit(const ElasticSurface& surface);

/// Interpolates fields on a cylinder, given on angle x axial points, at the cells of a pad.
class CylinderStencil {
 public:
  /// `neighbours[i]`: true when angular point i and i + 1 (cyclic) belong to one connected range.
  CylinderStencil(Eigen::VectorXd angles, std::vector<char> neighbours, Eigen::VectorXd axials);

  struct Angular {
    int first, second;
    double weight;  // of second
  };
  struct Axial {
    int first, second;
    double weight, slope;  // of second; slope = d weight / d axial, 0 beyond the ends
  };
  Angular at_angle(double angle) const;
  Axial at_axial(double axial) const;
  int n_axial() const { return static_cast<int>(axials_.size()); }

 private:
  Eigen::VectorXd angles_, axials_;
  std::vector<char> neighbours_;
};

/// A matrix with few entries in a row; of cells by coordinates.
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// From patch means u to cell displacements, exact for rigid motions of the body:
///
///   G u = B u + D w,   D = R_cells - B R_patches,   w = R_patches^+ u
///
/// B is bilinear between the patch centres; R holds the rigid motions x, y, rx, ry that move a
/// cylinder surface radially, w the rigid motion that fits the patches best. So G^T gives exact
/// resultants of the cell forces. u and w are separate columns of the map, [B | D], so that a cell
/// has eight entries: w is made a coordinate of its own (System::combined_coordinate).
class PatchMap {
 public:
  /// Cells of `pad` are at axial position pad.axial(j) + offset in the frame of `surface`. A
  /// periodic pad also has cells between strips of patches that are not adjacent: there B goes
  /// linearly in the angle from one strip to the next, so that the gap is continuous around.
  PatchMap(const ElasticSurface& surface, const PadGrid& pad);

  int patches() const { return static_cast<int>(rigid_.rows()); }
  int columns() const { return patches() + kFits; }
  /// Writes [B | D] at `offset` [m] into `map`, n x columns, and its derivative by the offset, with
  /// the same pattern, into `slope` when given.
  void at(double offset, SparseRows& map, SparseRows* slope = nullptr);

 private:
  PadGrid pad_;
  CylinderStencil stencil_;
  double axis_origin_ = 0.0, axis_sign_ = 1.0;
  /// A point of one direction of the stencil.
  struct Point {
    int at;
    double weight, slope;
  };
  /// Its points in ascending order, each once.
  struct Points {
    std::array<Point, 2> of;
    int count;
  };
  static Points points(int first, int second, double weight, double slope);

  std::vector<Points> columns_, rows_;                                   // of the pad's cells
  Eigen::Matrix<double, Eigen::Dynamic, kFits, Eigen::RowMajor> rigid_;  // R_patches
};

/// The deviation of the liner at rest at the cells of a pad.
class LinerShapeMap {
 public:
  /// InputError when the tables do not ascend or the shapes differ.
  LinerShapeMap(const LinerShape& shape, const PadGrid& pad);
  /// Adds deviation and its slope along z at stroke position `offset` [m] to `h` and `slope`, n.
  void add(double offset, Eigen::ArrayXd& h, Eigen::ArrayXd& slope) const;

 private:
  LinerShape shape_;
  PadGrid pad_;
  CylinderStencil stencil_;
  std::vector<CylinderStencil::Angular> columns_;  // of the pad's cells
  // Mutable: working memory of add(), so that no evaluation takes memory.
  mutable std::vector<CylinderStencil::Axial> rows_;  // at the last offset
};

/// Radial displacement of the cells under unit rigid motions x, y, z, rx, ry, rz about the origin
/// of the frame in which cell heights are pad.axial(j) + offset and the cylinder's axis is at
/// (x, y) = `axis` [m]; n x 6.
RowMatrix rigid_radial(const PadGrid& pad, double offset = 0.0,
                       const Eigen::Vector2d& axis = Eigen::Vector2d::Zero());

}  // namespace clatter::film
