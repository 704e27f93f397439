// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The gap between skirt and liner: cold shape, and its change by displacements of the two bodies.
//
// Angles of pads count from the thrust side (+y) right-handed about z: the outward normal at angle
// f is n = (-sin f, cos f, 0).
#include <Eigen/Core>
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

/// Deviation of the liner from its cylinder, at rest: warm, bolted, worn. Bilinear, constant beyond
/// its ends.
struct LinerShape {
  Eigen::VectorXd angle;   // n_a, pad angles [rad], ascending, within one turn; closed periodically
  Eigen::VectorXd height;  // n_z, engine z [m], ascending
  Eigen::MatrixXd deviation;  // n_a x n_z, outward positive [m]
};

/// A body's surface described by mean radial displacements of patches.
struct ElasticSurface {
  rom::ContactGrid grid;  // patches, axis along +z or -z
  Eigen::MatrixXd
      rigid;  // n x 6: patch values under unit rigid motions x, y, z, rx, ry, rz about the
              // frame's origin (rows of ReducedModel::rigid); 0 rows: taken from the patch centres
};

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

/// From patch means to cell displacements, exact for rigid motions of the body.
///
///   G = B + (R_cells - B R_patches) R_patches^+
///
/// B is bilinear between the patch centres; R holds the rigid motions x, y, rx, ry that move a
/// cylinder surface radially. So G^T gives exact resultants of the cell forces.
class PatchMap {
 public:
  /// Cells of `pad` are at axial position pad.axial(j) + offset in the frame of `surface`.
  PatchMap(const ElasticSurface& surface, const PadGrid& pad);

  int patches() const { return static_cast<int>(inverse_.cols()); }
  /// R_patches^+, 4 x patches: the rigid motion x, y, rx, ry about the frame's origin that fits the
  /// patches best. Its transpose distributes a force or couple with exactly that resultant.
  const Eigen::Matrix<double, 4, Eigen::Dynamic>& rigid_fit() const { return inverse_; }
  /// Writes G at `offset` [m] into `map`, and dG/d(offset) into `slope` when given; n x patches.
  void at(double offset, RowMatrix& map, RowMatrix* slope = nullptr);

 private:
  PadGrid pad_;
  CylinderStencil stencil_;
  double axis_origin_ = 0.0, axis_sign_ = 1.0;
  std::vector<CylinderStencil::Angular> columns_;
  Eigen::Matrix<double, Eigen::Dynamic, 4> rigid_;    // R_patches
  Eigen::Matrix<double, 4, Eigen::Dynamic> inverse_;  // R_patches^+
  RowMatrix defect_, defect_slope_;                   // R_cells - B R_patches, n x 4
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
};

/// Radial displacement of the cells under unit rigid motions x, y, z, rx, ry, rz about the origin
/// of the frame in which cell heights are pad.axial(j) + offset and the cylinder's axis is at
/// (x, y) = `axis` [m]; n x 6.
RowMatrix rigid_radial(const PadGrid& pad, double offset = 0.0,
                       const Eigen::Vector2d& axis = Eigen::Vector2d::Zero());

}  // namespace clatter::film
