// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[shaft]]: elastic shafts with discs in journal bearings.
#include <string>
#include <utility>
#include <vector>

#include "dynamics/component/component.hpp"
#include "dynamics/shaft/shaft_elements.hpp"
#include "dynamics/shaft/shaft_spec.hpp"

namespace clatter::dynamics {

/// A shaft of rigid slices and massless beams. Elements may act on each point of a disc or journal,
/// bodies `<shaft>.<disc>` and `<shaft>.<bearing>`, in every model: full, torsion, rigid. Histories
/// of each disc: `<shaft>.<disc>_angle`, `_speed`, and in the full model the displacements `_x`,
/// `_y`, `_z` of the centre of mass of its slice; of each bearing its force, eccentricity,
/// friction.
class ShaftComponent : public Component {
 public:
  explicit ShaftComponent(ShaftSpec spec) : spec_(std::move(spec)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<ShaftComponent>(*this);
  }
  std::string name() const override { return spec_.name; }
  ComponentTraits traits() const override;
  void add_bodies(ModelBuilder& model) override;
  /// InputError for housings that the scene lacks or that are not on the axis.
  void add_elements(ModelBuilder& model) override;
  void add_body_effects(const ModelBuilder& model, EffectTable& effects) const override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;
  void record(const System& system, const StageState& state, History& history) const override;

 private:
  int add_body(ModelBuilder& model, const std::string& part, const DiscInertia& inertia) const;
  void add_points(ModelBuilder& model, const std::string& part, size_t station,
                  const BodyDof& angle) const;
  bool has_wheel(size_t disc) const;

  ShaftSpec spec_;
  ShaftBodies bodies_;
  struct Recorded {
    std::string name, unit;
    int coordinate;  // y index
    bool rate;
  };
  std::vector<Recorded> recorded_;
};

ComponentList read_shafts(const Config& root);

}  // namespace clatter::dynamics
