// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The stiffness of connector elements.
#include <Eigen/Core>
#include <map>
#include <string>

#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {

/// *CONNECTOR BEHAVIOR with what follows it.
struct ConnectorBehavior {
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
  DofMask elastic = 0, rigid = 0;
  bool coupled = false;  // all components that the connection has
};

/// All of the deck, by folded name. Refused ones are missing.
std::map<std::string, ConnectorBehavior> connector_behaviors(const Model& model);

}  // namespace clatter::mesh::deck::abaqus
