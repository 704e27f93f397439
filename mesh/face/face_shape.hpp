// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The shape of a face: plane, cylinder, cone, sphere, torus or spline, with radius, axis and
// position, found from points and normals of its underlying surface.
#include <Eigen/Core>
#include <string>
#include <vector>

namespace clatter::mesh {

enum class ShapeKind { kPlane, kCylinder, kCone, kSphere, kTorus, kRevolved, kSpline, kOther };

/// One word: "plane", "cylinder", "cone", "sphere", "torus", "revolved", "spline", "other".
std::string name_of(ShapeKind kind);

/// A surface; members that its kind does not have are zero. Lengths in the part's unit.
struct SurfaceShape {
  ShapeKind kind = ShapeKind::kOther;
  bool is_spline = false;       // stored as a spline, though it is of that kind
  bool is_concave = false;      // a bore, an inner fillet; set by orient()
  double radius = 0.0;          // cylinder, sphere; torus: of the circle that the tube follows
  double minor_radius = 0.0;    // of the torus' tube
  double half_angle_deg = 0.0;  // of a cone, between axis and surface
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // plane: normal; else the axis, unit
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // on the axis nearest to the face; cone: its
                                                    // apex; sphere, torus: the centre
};

/// The shape of a face that the CAD kernel calls `cad_kind` ("Plane", "Cylinder", "BSpline surface"
/// ...) from at least four points on it, not collinear, and unit normals there, of either sign.
/// A spline gets the simplest shape that all points fit to 1e-5 of their extent. The
/// least squares problems are linear: with normals n_i,
///   plane       n = mean n_i
///   sphere      x_i = c + r n_i
///   cylinder    n_i . a = 0, then x_i = c + r n_i across a
///   cone        n_i . a = const, then n_i . (x_i - apex) = 0
///   torus       all lines (x_i, n_i) meet the axis (Pottmann and Wallner, Computational Line
///               Geometry, 2001), then a circle in the half-plane of radius and height
SurfaceShape find_shape(const std::string& cad_kind, const std::vector<Eigen::Vector3d>& points,
                        const std::vector<Eigen::Vector3d>& normals);

/// Cylinder, cone, sphere or torus?
bool is_round(ShapeKind kind);

/// Points a plane's normal out of the solid and finds whether a curved face is concave, from the
/// outward normal at one of its points.
void orient(SurfaceShape& shape, const Eigen::Vector3d& position, const Eigen::Vector3d& outward);

/// Distance of x from the surface; infinite where the kind has no formula.
double distance_to(const SurfaceShape& shape, const Eigen::Vector3d& x);

/// "cylinder of radius 46.5 mm", "plane", "torus of radii 20 and 3 mm".
std::string describe(const SurfaceShape& shape, const std::string& unit);

}  // namespace clatter::mesh
