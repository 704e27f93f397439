// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [engine] ... [contact] or [[cylinder]]: a slider-crank with piston, rod, joints, guide, contact
// and gas.
#include <optional>
#include <utility>

#include "dynamics/component/component.hpp"
#include "dynamics/component/component_interfaces.hpp"
#include "dynamics/cylinder/cylinder_elements.hpp"
#include "dynamics/cylinder/cylinder_spec.hpp"
#include "dynamics/element/crank_angle.hpp"
#include "dynamics/given/spline.hpp"

namespace clatter::dynamics {

/// One cylinder. Its bodies are "piston", with a reduced model, and "rod"; its elements "pin",
/// "crank_pin", "pin_guide", "piston_liner" and "rings"; its histories those of the elements and
/// piston_lateral [m], piston_tilt [rad] (against the liner) and gas_pressure [Pa]. All names of a
/// named cylinder "c1" begin with "c1_".
class CylinderComponent : public Component, public PistonInLiner, public MovingFrames {
 public:
  explicit CylinderComponent(CylinderSpec spec)
      : spec_(std::move(spec)), crank_(spec_.engine.crank()) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<CylinderComponent>(*this);
  }
  std::string name() const override { return spec_.name; }
  std::vector<BodySpec> reduced_bodies() const override;
  std::vector<std::filesystem::path> inputs() const override;
  ComponentTraits traits() const override;

  void add_bodies(ModelBuilder& model) override;
  /// InputError for sets and grids that a body lacks and for inconsistent geometry.
  void add_elements(ModelBuilder& model) override;
  void add_loads(ModelBuilder& model) override;
  void add_body_effects(const ModelBuilder& model, EffectTable& effects) const override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;

  void record(const System& system, const StageState& state, History& history) const override;
  Eigen::Vector2d secondary_motion(double time, const Eigen::VectorXd& y) const override;
  std::map<int, Eigen::Vector3d> frames(double time) const override;
  const film::PistonLiner* contact() const override { return contact_; }

  const CylinderSpec& spec() const { return spec_; }
  const SliderCrank& crank() const { return crank_; }
  /// y indices of the pin's node, in a model.
  const PinNode& pin() const { return pin_; }

 private:
  CylinderSpec spec_;
  SliderCrank crank_;
  std::optional<Spline> gas_;
  int piston_ = -1, rod_ = -1;                          // indices in a model
  CrankAngle angle_;                                    // of a model
  Eigen::Vector2d pin_axis_ = Eigen::Vector2d::Zero();  // (x, y) of the pin's centre [m]
  PinNode pin_{-1, -1, -1, -1, -1, -1};
  const film::PistonLiner* contact_ = nullptr;
  const ForceElement* rings_ = nullptr;
  std::optional<LinerFit> liner_;
};

/// The cylinder of an engine scene, or those of its [[cylinder]] tables.
ComponentList read_cylinders(const Config& root);

}  // namespace clatter::dynamics
