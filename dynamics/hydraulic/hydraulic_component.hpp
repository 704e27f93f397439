// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[tensioner]] and [[lash_adjuster]]: hydraulic plungers between two points.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>

#include "core/keys/keys.hpp"
#include "dynamics/component/component.hpp"
#include "dynamics/component/model_builder.hpp"
#include "dynamics/component/run_time.hpp"
#include "dynamics/given/spline.hpp"
#include "dynamics/hydraulic/hydraulic_element.hpp"

namespace clatter::dynamics {

/// Absolute pressure of the oil supply.
struct SupplySpec {
  double pressure = 3.5e5;      // constant [Pa]
  std::filesystem::path table;  // or over time [s], in an engine scene over the crank angle
  std::string column;
  Spline::Kind interpolation = Spline::Kind::kLinear;
};

/// One [[tensioner]] or [[lash_adjuster]]; the defaults are those of a timing drive's tensioner.
struct HydraulicSpec {
  std::string kind, name, where;                    // "tensioner", its name; for messages
  PointSpec a, b;                                   // of housing and plunger
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // from housing to plunger, at the start
  HydraulicModel model = HydraulicModel::kHydraulic;
  double travel = 0.0;                   // at the start [m]
  std::optional<double> start_pressure;  // of the chamber [Pa]; else that of the supply
  ChamberSpec chamber;
  PlungerSpring spring{90.0, 2000.0};
  PlungerStops stops;
  SupplySpec supply;
};

const keys::Keys<HydraulicSpec>& tensioner_keys();
/// With the defaults of a roller finger follower's adjuster.
const keys::Keys<HydraulicSpec>& lash_adjuster_keys();
/// Their sizes alone, with ends of the travel: of the adjusters in a valve train.
const keys::Keys<HydraulicSpec>& train_adjuster_keys();
/// The pressure of the supply over time. InputError for a table that does not cover the run.
TimeFunction supply_pressure(const SupplySpec& supply, const ModelBuilder& model);

/// A hydraulic element and, for the hydraulic model, the body "<name>_chamber" of its own
/// coordinates. Its element and histories are named "<kind> <name>".
class HydraulicComponent : public Component {
 public:
  explicit HydraulicComponent(HydraulicSpec spec) : spec_(std::move(spec)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<HydraulicComponent>(*this);
  }
  std::string name() const override { return spec_.name; }
  std::vector<std::filesystem::path> inputs() const override;
  ComponentTraits traits() const override;
  void add_bodies(ModelBuilder& model) override;
  /// InputError for points that no body has and tables that do not cover the run.
  void add_elements(ModelBuilder& model) override;
  void add_body_effects(const ModelBuilder& model, EffectTable& effects) const override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;

 private:
  bool is_hydraulic() const { return spec_.model == HydraulicModel::kHydraulic; }
  bool has_moving_ball() const { return spec_.chamber.valve.ball == CheckValveSpec::Ball::kMoving; }
  std::string element_name() const { return spec_.kind + " " + spec_.name; }
  PlungerAxis axis(ModelBuilder& model) const;
  HydraulicSpec spec_;
};

ComponentList read_tensioners(const Config& root);
ComponentList read_lash_adjusters(const Config& root);

}  // namespace clatter::dynamics
