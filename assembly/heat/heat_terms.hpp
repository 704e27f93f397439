// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a [[heat]] adds to the conduction of the cells.
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "assembly/constraint/part_data.hpp"
#include "assembly/tie/mortar.hpp"
#include "core/base/sparse.hpp"

namespace clatter::assembly {

/// Heat through one boundary, into the part: sum(q - H T) [W].
struct HeatTerms {
  std::string name;   // "film crown"
  SparseMatrix H;     // n_nodes x n_nodes, lower triangle [W/K]; without entries for a given heat
  Eigen::VectorXd q;  // n_nodes [W]

  double into_part(const Eigen::VectorXd& temperature) const;
};

/// Films, fluxes and sources. InputError for a film or flux on a face inside the part.
std::vector<HeatTerms> heat_terms(const PartData& part, const HeatSpec& spec);

/// Nodes with a fixed temperature.
struct FixedNodes {
  std::map<int32_t, size_t> which;      // node: index into HeatSpec::fixed
  std::map<int32_t, double> kelvin;     // node: [K]
  std::vector<std::string> boundaries;  // "fixed coolant", one for each of HeatSpec::fixed
};

/// InputError for a node with two different temperatures.
FixedNodes fixed_nodes(const PartData& part, const HeatSpec& spec);

/// Conduction across the gap of a tie: with the jump T_j - sum_k P_jk T_k of the slave nodes that
/// are tied, h J^T (int N^T N dA) J over the slave surface, n_nodes x n_nodes, lower triangle
/// [W/K].
/// @param conductance h [W/(m2 K)].
SparseMatrix contact_conduction(const PartData& part, const TieSpec& tie, const Projection& found,
                                double conductance);

}  // namespace clatter::assembly
