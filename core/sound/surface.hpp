// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A closed surface of flat triangles.
#include <Eigen/Core>

#include "core/base/matrix.hpp"

namespace clatter::sound {

/// A checked surface and its measures; made by closed_surface().
struct Surface {
  RowMatrix nodes;                  // n_v x 3 [m]
  IndexMatrix triangles;            // n_f x 3, corners counterclockwise seen from the fluid
  Eigen::VectorXd face_area;        // n_f [m2]
  RowMatrix face_normal;            // n_f x 3, unit vectors into the fluid
  RowMatrix face_centre;            // n_f x 3 [m]
  double area = 0.0;                // [m2]
  double volume = 0.0;              // enclosed [m3]
  Eigen::Vector3d middle{0, 0, 0};  // of the nodes' bounding box [m]
  double radius = 0.0;              // of the smallest sphere about `middle` with all nodes [m]
  double mean_edge = 0.0;           // root of the mean square length of edges [m]
  double longest_edge = 0.0;        // [m]

  Eigen::Index node_count() const { return nodes.rows(); }
  Eigen::Index face_count() const { return triangles.rows(); }
};

/// Checks and measures a surface: of one or several closed shells, each edge shared by two faces
/// that run through it in opposite directions, each shell with a positive volume.
/// @param nodes n_v x 3 [m], each used by a face
/// @param triangles n_f x 3
/// @throws InputError "surface: ..." with the face or node where it is not so
Surface closed_surface(const RowMatrix& nodes, const IndexMatrix& triangles);

/// The frequency [Hz] with this number of mean edges a wavelength.
double mesh_limit_hz(const Surface& surface, double sound_speed, double edges_per_wavelength);

/// The number of times that the surface winds about a point: 1 inside, 0 outside, one of
/// them or 1/2 on it (solid angles by van Oosterom and Strackee 1983).
double winding_number(const Surface& surface, const Eigen::Vector3d& point);

/// The distance of a point from a face [m], not negative.
double distance_to_face(const Surface& surface, Eigen::Index face, const Eigen::Vector3d& point);

/// The distance of a point from the surface [m], not negative.
double distance_to(const Surface& surface, const Eigen::Vector3d& point);

}  // namespace clatter::sound
