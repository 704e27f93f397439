// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Load vectors of a recipe in the model's coordinates.
#include <Eigen/Core>
#include <map>
#include <string>

#include "assembly/constraint/constrain.hpp"
#include "assembly/constraint/part_data.hpp"
#include "core/fe/fe_model.hpp"

namespace clatter::assembly {

/// The unit load cases of a recipe, by name.
struct LoadVectors {
  std::map<std::string, Eigen::VectorXd> forces;            // n, on the coordinates q
  std::map<std::string, Eigen::VectorXd> support_forces;    // n_s, on s; empty without supports
  std::map<std::string, Eigen::VectorXd> prescribed;        // n_s: s of prescribed displacements
  std::map<std::string, Eigen::VectorXd> temperature_rise;  // n_nodes [K], of temperature loads
  std::map<std::string, std::string> units;                 // "gas" -> "Pa": unit of the load
};

using HeatFields = std::map<std::string, fe::HeatField>;

/// What some loads need in addition to the recipe.
struct LoadInputs {
  // In the ids of nodes alone (3 n_nodes), or of all DoFs where there are shells.
  Eigen::MatrixXd momentum;  // M times unit accelerations of all nodes (3 columns); or empty
  std::map<std::string, Eigen::VectorXd> of_fields;  // M a of acceleration fields
  std::map<std::string, Eigen::VectorXd> of_sheets;  // M a of shells and surface masses that rotate
  HeatFields heat;                                   // of the [[heat]] tables
};

/// Builds all loads and prints the resultant of each. InputError for a load on a direction that
/// the model lacks.
LoadVectors load_vectors(const PartData& part, const Constrained& constrained,
                         const LoadInputs& inputs);

}  // namespace clatter::assembly
