// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Predicts the number of cells of a part from its geometry and the sizes, before meshing.
#include <string>
#include <vector>

#include "mesh/cad/gmsh_session.hpp"
#include "mesh/part/mesher.hpp"

namespace clatter::mesh {

/// The requested sizes on a face.
struct FaceSizes {
  double area = 0.0;               // in the part's unit squared, as all lengths here
  std::vector<double> at_samples;  // edge length over the surface
  struct Edge {
    double length = 0.0, size = 0.0;
  };
  std::vector<Edge> edges;
};

/// Sizes on a face by SizeSettings: the target, the curvature of the face and of its edges
/// (2 pi r / per_turn, not below min_size), and local sizes.
FaceSizes sizes_on(GmshSession& session, const FaceFacts& face, const SizeSettings& settings);

/// Expected number of tetrahedra.
///
/// Triangles: T = sum over the faces of all solids of A mean(1 / h^2) / 0.433, which is A over the
/// area of an equilateral triangle, plus a band along each edge that is finer than its face: for a
/// size that grows by g = 0.5 per distance, L / (0.433 g) (1 / h_e - 1 / h_f). Walls thinner than
/// the size have about one layer between two triangulated faces, 2 T as measured. Thick bodies have
/// V / (0.17 h^3), and below each face that is finer than the target a layer that grows to it
/// within the mean wall thickness 2 V / A. The larger of the two counts. Refinement passes at
/// slivers and folds add more.
double predict_cells(const std::vector<FaceSizes>& faces, double volume, double target);

/// Prints the prediction and returns it. InputError, beginning with `where`, when it is above
/// settings.max_cells: with the prediction, the sizes in mm, and the box of the part in mm.
double require_few_cells(GmshSession& session, double volume, const SizeSettings& sizes,
                         const MeshSettings& settings, double metres_per_unit,
                         const std::string& where);

/// The same for shells on all faces: T, half as many where they are quadrilaterals.
double require_few_shells(GmshSession& session, const SizeSettings& sizes, bool triangles,
                          const MeshSettings& settings, double metres_per_unit,
                          const std::string& where);

}  // namespace clatter::mesh
