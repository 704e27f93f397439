// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[valve]]: valve trains with finger followers.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/component/component.hpp"
#include "dynamics/element/stop.hpp"
#include "dynamics/hydraulic/hydraulic_component.hpp"
#include "dynamics/valve/coil_spring.hpp"
#include "dynamics/valve/follower_parts.hpp"
#include "dynamics/valve/valve_spring_component.hpp"
#include "dynamics/valve/valve_watch.hpp"

namespace clatter::dynamics {

/// One cam of a [[valve]] with what its valve is mounted on; points without body are the ground's.
struct ValveLobe : LobeSpec {
  PointSpec seat, spring_seat, adjuster;
  PointSpec on;  // what carries those of them that are not given
};

enum class ValveModel : char {
  kFull,         // bodies and contacts
  kQuasiStatic,  // the torque on the cam by the lift law
};

struct ValveSeatSpec {
  double stiffness = 5e7, damping = 2.0;  // [N/m], chi [s/m]
};

/// The lash adjuster of a valve.
struct TrainAdjusterSpec {
  bool is_hydraulic = true;  // else the ball does not move
  double plunger_mass = 0.010;
  Eigen::Vector2d axis = {0.0, 1.0};  // in the follower's plane, out of the housing
  HydraulicSpec sizes = train_adjuster_keys().standard();
};

/// One [[valve]]: equal valves of one camshaft.
struct ValveSpec {
  std::string name, where;
  ValveModel model = ValveModel::kFull;
  FollowerPlane plane;
  CamLawSpec law;
  CamSpec cam;  // by the law
  std::vector<ValveLobe> lobes;
  double mass = 0.053;  // of a valve with its retainer [kg]
  ValveSeatSpec seat;
  CoilSpringTable coil;
  FollowerSpec follower;
  TrainAdjusterSpec adjuster;
  /// Of valve, follower and a third of the spring, at the valve [kg].
  double reduced_mass() const;
  std::string name_of(const ValveLobe& lobe) const { return name + "_" + lobe.name; }
};
const Keys<ValveSpec>& valve_keys();

/// Valves, each with its body "<valve>_<lobe>" that slides along its axis,
/// "<valve>_<lobe>_follower" in a plane, "_plunger" that slides, "_chamber" of its oil and "_coils"
/// of its spring.
class ValveComponent : public Component {
 public:
  explicit ValveComponent(ValveSpec spec) : spec_(std::move(spec)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<ValveComponent>(*this);
  }
  std::string name() const override { return spec_.name; }
  std::vector<std::filesystem::path> inputs() const override;
  ComponentTraits traits() const override;
  /// At places and speeds that belong to the angle of the cams, with adjusters under the pressure
  /// that holds their valves.
  void add_bodies(ModelBuilder& model) override;
  void add_elements(ModelBuilder& model) override;
  void add_body_effects(const ModelBuilder& model, EffectTable& effects) const override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;
  /// Of each valve `<valve>_<lobe>_lift` [m], `_seat_force`, `_cam_force` [N], `_cam_torque` on the
  /// cam [N m], `_cam_gap` [m], `_cam_losses`, `_held_open`, `_spring_force`, `_spring_seat_force`
  /// [N], `_coil_gap` [m] and
  /// `_adjuster_travel` [m], `_adjuster_pressure` [Pa]; quasi-static the moment on the camshaft.
  void record(const System& system, const StageState& state, History& history) const override;
  /// Valves that lost their cam, and valves that did not close.
  std::vector<std::string> warnings() const override;

 private:
  /// A valve in a model; the elements are its system's.
  struct Train {
    std::string name;
    FollowerPlace place;
    FollowerStart start;
    int lift = 0;  // y index
    const RollerContact* roller = nullptr;
    const CompliantStop* seat = nullptr;
    const CoilSpring* spring = nullptr;
    const HydraulicElement* adjuster = nullptr;
    const ValveWatch* watch = nullptr;
    std::vector<std::string> recorded;
  };
  FollowerPlace place(const ValveLobe& lobe) const;
  Eigen::Vector3d axis(const Train& train) const;  // of the adjuster, in the scene
  Eigen::Vector3d on_axis(const Train& train, double beyond) const;
  Chamber chamber(const ModelBuilder& model) const;
  double start_pressure(const ModelBuilder& model, const Train& train) const;
  void add_train(ModelBuilder& model, const ValveLobe& lobe);
  void add_train_elements(ModelBuilder& model, const ValveLobe& lobe, Train& train);
  std::unique_ptr<Port> add_adjuster(ModelBuilder& model, const ValveLobe& lobe, Train& train);
  void add_torque(ModelBuilder& model);

  ValveSpec spec_;
  std::optional<CamProfile> profile_;
  std::vector<Train> trains_;
};

ComponentList read_valves(const Config& root);

}  // namespace clatter::dynamics
