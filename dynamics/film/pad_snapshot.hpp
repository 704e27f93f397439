// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Fields of one pad for reports.
#include <Eigen/Core>
#include <string>

#include "core/base/matrix.hpp"

namespace clatter::film {

/// Fields of one pad at the last evaluated state, n_angle x n_axial each.
struct PadSnapshot {
  std::string name;              // "thrust", "antithrust"; "skirt" of the entire one
  Eigen::VectorXd angle;         // cell centres, from the thrust side [rad]
  Eigen::VectorXd axial;         // cell centres, z from the pin centre [m]
  RowMatrix gap;                 // h [m]
  RowMatrix pressure;            // film [Pa]; empty without film
  RowMatrix fill;                // theta [1]; empty without film
  RowMatrix contact_pressure;    // asperities [Pa]; empty without asperities
  Eigen::VectorXd liner_height;  // cells of the layer on the liner, engine z [m]; empty without
  RowMatrix liner_oil;           // its thickness, n_angle x cells [m], 0 under the pad
};

}  // namespace clatter::film
