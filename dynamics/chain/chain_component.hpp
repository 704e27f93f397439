// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[chain]]: a chain that runs over sprockets and guides.
#include <memory>
#include <string>
#include <vector>

#include "dynamics/chain/chain_spec.hpp"
#include "dynamics/chain/layout.hpp"
#include "dynamics/chain/profile_contact.hpp"
#include "dynamics/component/component.hpp"
#include "dynamics/component/component_interfaces.hpp"

namespace clatter::dynamics {

/// A chain: its links as bodies, its joints, its contacts with each sprocket and guide.
class ChainComponent : public Component, public MovingRow, public FieldSource {
 public:
  /// InputError where the chain does not fit around what it runs over.
  explicit ChainComponent(ChainSpec spec);
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<ChainComponent>(*this);
  }
  std::string name() const override { return spec_.name; }
  ComponentTraits traits() const override {
    ComponentTraits traits;
    traits.modes = 3 * spec_.make.links();
    traits.needs_equilibrium = true;
    return traits;
  }
  std::vector<std::filesystem::path> inputs() const override {
    if (spec_.pitch_table.empty()) return {};
    return {spec_.pitch_table};
  }
  /// Links on the layout, moving with the first sprocket.
  void add_bodies(ModelBuilder& model) override;
  void add_elements(ModelBuilder& model) override;
  void add_body_effects(const ModelBuilder& model, EffectTable& effects) const override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;
  std::string place_of(int body) const override;
  int body_before(int body, double cycle) const override;
  /// Sprockets on which it jumped, with the time.
  std::vector<std::string> warnings() const override;
  /// `<chain>_tension_min`, `_max` of all joints, `<chain>_tension_<a>_<b>` in the middle of each
  /// span [N]; `<chain>_<sprocket>_speed`, positive where it moves the chain forwards [rad/s]; what
  /// the contacts record; `<chain>_jumps` of teeth.
  void record(const System& system, const StageState& state, History& history) const override;
  /// Group `chain/<chain>`; fields `x`, `y` [m], `angle` [rad] of the links, `tension` of the
  /// joints [N], `over/<name>/place` of each sprocket's and guide's axes.
  FieldPlan field_plan() const override;
  void write_outlines(H5File& file) const override;
  void record_fields(const StageState& state, FieldStream& fields) const override;

 private:
  /// A straight span of the layout between two sprockets or guides.
  struct SpanPoint {
    std::string recorded;
    Eigen::Vector2d middle, along;
  };
  ProfileCarrier carrier(ModelBuilder& model, size_t over) const;
  ToothCount tooth_count(size_t over) const;
  double start_speed(ModelBuilder& model) const;
  double shape_interval(double speed) const;
  double tension_at(const SpanPoint& span, const StageState& state) const;

  ChainSpec spec_;
  ChainLayout layout_;
  std::vector<SpanPoint> spans_;
  std::vector<std::string> recorded_, speeds_;
  double shape_every_ = 0.0;  // [s]
  int first_body_ = 0;
  double speed_ = 0.0;                           // at the start [m/s]
  std::vector<int> y_;                           // of all links, 3 n
  const LinkJoints* joints_ = nullptr;           // owned by the model's system
  std::vector<const ProfileContact*> contacts_;  // the same
};

ComponentList read_chains(const Config& root);

}  // namespace clatter::dynamics
