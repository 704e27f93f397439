#pragma once
// Shape functions of each cell at the points of its quadrature rules, computed once a program.
#include <Eigen/Core>
#include <vector>

#include "assembly/material.hpp"
#include "mesh/shape.hpp"

namespace clatter::assembly {

/// One point of a rule on the reference cell.
struct CellPoint {
  mesh::CellShape shape;
  Eigen::Vector3d xi;
  double weight;
};

using CellPoints = std::vector<CellPoint>;

/// How the material wants the stiffness of that cell integrated.
Integration integration_of(mesh::CellType type, const IntegrationChoice& choice);

/// Points for K_e; `straight`: middle nodes in the middles of their edges.
const CellPoints& stiffness_points(mesh::CellType type, Integration integration, bool straight);

/// Points for m, exact for N_a N_b det J.
const CellPoints& mass_points(mesh::CellType type, bool straight);

}  // namespace clatter::assembly
