// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Direct solves of small test models by Eigen alone.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "assembly/model/build.hpp"
#include "core/base/sparse.hpp"
#include "core/fe/material.hpp"

namespace clatter::assembly::testing {

inline const fe::Material kSteel{2.1e11, 0.3, 7800.0};

/// One material for all regions.
std::vector<fe::Material> materials_of(const mesh::Mesh& mesh,
                                       const fe::Material& material = kSteel);

/// Solves K u = f for the displacements that are not in `fixed`; those take their values from
/// `given`. K is a lower triangle.
Eigen::VectorXd solve_fixed(const SparseMatrix& K, const Eigen::VectorXd& f,
                            const std::vector<bool>& fixed, const Eigen::VectorXd& given);

/// The lowest natural frequencies [Hz], ascending, of a supported model by subspace iteration.
Eigen::VectorXd lowest_hz(const SparseMatrix& K, const SparseMatrix& M, int count);

/// Both triangles, dense.
Eigen::MatrixXd full(const SparseMatrix& lower);

/// Model from a recipe in TOML with its materials.
BuiltModel build_all(mesh::Mesh mesh, const std::string& toml);

/// Model from a recipe in TOML; preceded by a steel for all regions.
BuiltModel build(const mesh::Mesh& mesh, const std::string& toml);

}  // namespace clatter::assembly::testing
