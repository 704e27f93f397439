// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Load vectors of a recipe in the model's coordinates.
#include <Eigen/Core>
#include <string>

#include "assembly/constraint/constrain.hpp"
#include "assembly/recipe/recipe.hpp"
#include "assembly/surface/surface_cache.hpp"
#include "core/fe/fe_model.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// Builds the loads of a model whose coordinates and sets exist.
class LoadBuilder {
 public:
  /// `momentum` (3 n_nodes x 3): M times unit accelerations of all nodes; empty when no load needs
  /// it.
  LoadBuilder(const mesh::Mesh& mesh, const Recipe& recipe, const DofNumbers& numbers,
              const Constrained& constrained, SurfaceCache& surfaces,
              const Eigen::MatrixXd& momentum)
      : mesh_(mesh),
        recipe_(recipe),
        numbers_(numbers),
        constrained_(constrained),
        surfaces_(surfaces),
        momentum_(momentum) {}

  /// Fills loads, support_loads, prescribed, load_units and cases; prints each load's resultant.
  void build(fe::FeModel& model);

 private:
  Eigen::VectorXd forces(const LoadSpec& load) const;
  Eigen::VectorXd temperature_rise(const LoadSpec& load) const;
  void add_body_force(const Eigen::Vector3d& acceleration, Eigen::VectorXd& forces) const;
  void add_centrifugal(const LoadSpec& load, Eigen::VectorXd& forces) const;
  void add_to_sets(const fe::FeModel& model, const LoadSpec& load, Eigen::VectorXd& f) const;
  Eigen::VectorXd prescribed(const LoadSpec& load) const;
  int32_t point_named(const std::string& name) const;
  bool all_attached(const Eigen::VectorXd& forces) const;  // -1: no such point

  const mesh::Mesh& mesh_;
  const Recipe& recipe_;
  const DofNumbers& numbers_;
  const Constrained& constrained_;
  SurfaceCache& surfaces_;
  const Eigen::MatrixXd& momentum_;
};

}  // namespace clatter::assembly
