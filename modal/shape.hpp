// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The radial shape of a bore or skirt under static loads: deviations from the unloaded cylinder on
// a grid of heights and angles, and their Fourier orders around.
#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/h5_file.hpp"
#include "core/base/json_line.hpp"
#include "core/base/radial_shape_layout.hpp"
#include "modal/cylinder_points.hpp"

namespace clatter::modal {

/// What to compute.
struct ShapeOptions {
  std::string surface;
  std::vector<std::string> cases;    // of the static results; empty: all
  std::optional<CylinderAxes> axes;  // absent: those of the contact grid that lies on the surface
  std::optional<std::pair<double, double>> range;  // heights [m]; absent: the entire surface
  int heights = 41;                                // equally spaced, ends included
  int angles = 72;                                 // equally spaced from 0
  int orders = 8;                                  // the highest Fourier order
  bool keep_rigid = false;                         // translation and tilt stay in the deviation
};

/// The shape of one case.
struct ShapeCase {
  std::string name;
  Eigen::MatrixXd deviation;  // heights x angles [m], positive away from the axis
  Eigen::Vector4d rigid;  // of the axis at height h: rigid(0) + h rigid(2) [m] along zero_angle,
                          // rigid(1) + h rigid(3) along axis x zero_angle
  Eigen::MatrixXd order_re, order_im;  // heights x (orders + 1) [m]:
                                       // deviation = Re sum_m c_m exp(i m angle)
};

struct Shape {
  std::string name, surface;  // of the part; of the surface
  CylinderAxes axes;
  CylinderExtent extent;
  Eigen::VectorXd height;                                      // [m], ascending
  Eigen::VectorXd angle;                                       // [rad]
  Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic> covered;  // heights x angles: 1 on a face
  bool rigid_kept = false;
  std::vector<ShapeCase> cases;
};

/// The shape of a surface from its nodes' displacements. Deviations are those of the finite element
/// solution at the grid's points; where the surface has no face (windows of a skirt) they are
/// linear in the angle between the adjacent faces. Translation and tilt are the least squares fit
/// of
///   (a + h c) cos(angle) + (b + h d) sin(angle) + mean of each height
/// over the points on faces; without `keep_rigid` they are subtracted.
/// InputError, beginning with `where`, for a surface that is no cylinder about the axis, and for a
/// height without faces.
/// @param displacement of each case, 3 n_nodes [m]; `options.cases` are their names.
Shape shape_of(const RowMatrix& nodes, const mesh::Surface& surface,
               const std::vector<Eigen::VectorXd>& displacement, const ShapeOptions& options,
               const std::string& where);

/// Reads static results (.static.h5) and computes the shape. InputError for unknown surfaces and
/// cases, and without `axes` where not exactly one contact grid lies on the surface.
Shape shape_from_file(const std::filesystem::path& path, const ShapeOptions& options);

void write_shape(H5File& file, const Shape& shape);

/// Comma-separated values: height_m, angle_deg, covered, and the deviation of each case [um].
std::string csv_of(const Shape& shape);

/// For --json: surface, radius_m, covered, and of each case the name, smallest and largest
/// deviation and the largest amplitude of each order [m].
JsonMembers json_of(const Shape& shape);

/// A summary line for each case.
std::vector<std::string> describe(const Shape& shape);

}  // namespace clatter::modal
