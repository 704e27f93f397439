// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Mass, centre of gravity and inertia, two independent ways.
#include <Eigen/Core>
#include <vector>

#include "core/base/sparse.hpp"
#include "core/fe/material.hpp"
#include "core/fe/shell_section.hpp"
#include "core/mesh/mesh.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::assembly {

/// Moments of the mass distribution about its centre c: about the origin a part far from it, or a
/// heavy point mass, would lose the digits of the rest (hard cases F2, F3).
struct MassMoments {
  double mass = 0.0;                                 // int dm [kg]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // c [m]
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // int (x - c) (x - c)^T dm [kg m2]
};

/// Integrals of rho, rho x and rho x x^T over all cells; exact for curved cells too (degree 7).
MassMoments integrate_mass(const mesh::Mesh& mesh, const std::vector<fe::Material>& materials);

/// Adds the shells: integrals over their mid-surfaces, with the rotary inertia of the sheet, at the
/// points of their mass matrices.
void add_shells(MassMoments& moments, const mesh::Mesh& mesh,
                const std::vector<fe::Material>& materials,
                const std::vector<fe::ShellSection>& sections);

/// Adds a point mass [kg] at `position` [m] with inertia about its own centre [kg m2].
void add_point(MassMoments& moments, double mass, const Eigen::Vector3d& position,
               const Eigen::Matrix3d& inertia);

/// Inertia about the centre of mass: J = tr(S) I - S of the second moments.
rom::MassProperties properties_of(const MassMoments& moments);

/// The same from the matrices: R^T M R is [m I, -m c x; m c x, J] for rigid motions R about a
/// point, c from there; first about the origin, then about the centre that this gives.
rom::MassProperties properties_of(const SparseMatrix& M, const Eigen::MatrixXd& rigid);

/// Relative differences of mass, centre (over the radius of gyration) and inertia.
struct MassDifference {
  double mass, centre, inertia;
};
MassDifference compare(const rom::MassProperties& a, const rom::MassProperties& b);

}  // namespace clatter::assembly
