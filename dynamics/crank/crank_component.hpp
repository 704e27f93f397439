// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [crank]: the crankshaft as a rigid body in main bearings, with a prescribed or a free speed.
#include <utility>
#include <vector>

#include "dynamics/component/component.hpp"
#include "dynamics/component/component_interfaces.hpp"
#include "dynamics/crank/crank_bearings.hpp"
#include "dynamics/crank/crank_spec.hpp"

namespace clatter::dynamics {

/// The body "crankshaft" on whose pins the cylinders act. Histories: those of bearings and load;
/// crankshaft_y, _z [m], crankshaft_tilt_y, _tilt_z [rad] of the centre of mass;
/// `<bearing>_offset_y`, `_offset_z` [m] of the journal in its bearing.
class CrankComponent : public Component, public MovingFrames {
 public:
  explicit CrankComponent(CrankSpec spec) : spec_(std::move(spec)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<CrankComponent>(*this);
  }
  std::vector<std::filesystem::path> inputs() const override;
  ComponentTraits traits() const override;

  void add_bodies(ModelBuilder& model) override;
  void add_elements(ModelBuilder& model) override;
  void add_loads(ModelBuilder& model) override;
  void add_body_effects(const ModelBuilder& model, EffectTable& effects) const override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;

  void record(const System& system, const StageState& state, History& history) const override;
  std::map<int, Eigen::Vector3d> frames(double time) const override;

  const CrankSpec& spec() const { return spec_; }

 private:
  void add_load(ModelBuilder& model);
  CrankSpec spec_;
  int body_ = -1;                 // in a model
  std::vector<int> coordinates_;  // y indices of y, z, ry, rz in bearings
  std::vector<BearingOrbit> orbits_;
};

/// The crankshaft of an engine scene, if it has one.
ComponentList read_crank(const Config& root);

}  // namespace clatter::dynamics
