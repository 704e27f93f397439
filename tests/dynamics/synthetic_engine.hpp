// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Engine scenes of synthetic bodies: a block, a piston and a rod at 2000 rpm.
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "dynamics/cylinder/cylinder_component.hpp"
#include "dynamics/run/model.hpp"

namespace clatter::dynamics::testing {

/// What differs between the scenes.
struct EngineVariant {
  std::string name;
  bool elastic_piston = true;
  bool liner_axial = true;
  bool contact = true;  // between piston and liner
  bool film = true;
  bool balanced = false;
  bool rings = false;             // with friction, as the pin has
  double pin_offset = 0.0;        // [m]
  double dry_clearance = 0.5e-6;  // without film [m]
  std::vector<std::string> bearings{"main_4", "main_5"};
};

inline void PrintTo(const EngineVariant& variant, std::ostream* out) { *out << variant.name; }

/// A scene with an elastic block on mounts, without gas or a ramp of the start, and its bodies.
struct SyntheticEngine {
  explicit SyntheticEngine(const EngineVariant& variant);
  std::unique_ptr<Model> model() const { return build_model(scene, bodies); }

  CylinderSpec cylinder;
  Scene scene;
  LoadedBodies bodies;
};

/// The cylinder of a model that has one.
inline const CylinderComponent& cylinder_of(const Model& model) {
  return *components_of<CylinderComponent>(model).at(0);
}

/// Modal coordinates (N x 6) when block, rod and piston, ideally placed at `time`, move together as
/// one rigid body: unit motions x, y, z, rx, ry, rz about the engine's origin.
Eigen::MatrixXd modal_rigid_motions(const Model& model, const SyntheticEngine& engine, double time);
/// The same of all interface coordinates, n_y x 6.
Eigen::MatrixXd rigid_motions(const Model& model, const SyntheticEngine& engine, double time);

}  // namespace clatter::dynamics::testing
