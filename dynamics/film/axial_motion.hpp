// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// How axial forces between skirt and liner act on the element's coordinates.
#include <Eigen/Core>
#include <utility>
#include <vector>

namespace clatter::film {

/// Where an axial force on the liner acts.
struct LinerAxial {
  int coordinate = 0;  // mean axial displacement of the liner among the element's coordinates
  int tilt = 0;        // the first of the rotations rx, ry that fit the liner's patches best
};

/// Motion of the skirt against the liner along the stroke, linear in the element's coordinates.
///
/// Axial forces f on the skirt, at (x, y) from the pin's centre, have the wrench
///   F = sum f,   M_x = sum f y,   M_y = -sum f x,
/// which acts on the pin's z, rx and ry. The reaction on the liner is the force -F on its axial
/// coordinate, at (x_m, y_m), and the rest of the moment as a couple on the tilt of its patches:
/// axial traction on one side of the bore bends the liner as a beam, and the couple is spread over
/// the same surface as the force. So force and moment of both sides cancel.
struct AxialMotion {
  Eigen::Vector2d reaction;  // (x_m, y_m) from the pin's centre [m]
  /// 3 x n_e: relative displacement along z at the pin's centre, relative rotations about x and y.
  /// Its transpose distributes (F, M_x, M_y).
  Eigen::Matrix3Xd slide;
  /// Coordinates with their factors in the relative axial displacement at (x_m, y_m), which moves
  /// the skirt along the liner's shape.
  std::vector<std::pair<int, double>> height;
};

/// @param size n_e. @param pin the first of the pin's six coordinates x, y, z, rx, ry, rz.
/// @param reaction (x_m, y_m), where the axial coordinate of the liner is, or the bore's axis where
/// the liner is at rest; from the pin's centre [m]. @param liner absent (nullptr): at rest.
AxialMotion axial_motion(int size, int pin, const Eigen::Vector2d& reaction,
                         const LinerAxial* liner);

}  // namespace clatter::film
