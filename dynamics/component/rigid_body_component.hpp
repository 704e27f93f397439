// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[rigid_body]]: rigid bodies with large motion.
#include <Eigen/Core>
#include <array>
#include <utility>

#include "core/keys/keys.hpp"
#include "dynamics/component/component.hpp"
#include "dynamics/component/model_builder.hpp"
#include "dynamics/integrate/spatial_body.hpp"

namespace clatter::dynamics {

/// One [[rigid_body]]; vectors in the scene's axes.
struct RigidBodySpec {
  std::string name, where;
  enum class Path : char { kYz, kZx, kXy, kSpace, kSlide };  // planes by the axis across them
  Path path = Path::kXy;
  enum class Freedom : char { kPlane, kSpace, kSlide };
  Freedom motion = Freedom::kPlane;
  int normal = 2;     // in a plane: the axis about which it turns, 0 to 2
  double mass = 0.0;  // [kg]
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();  // principal; in a plane only inertia(0)
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   // of mass at the start [m]
  double angle = 0.0;                                 // in a plane, at the start [rad]
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  // in space
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();               // of a slide, of length 1
  PointSpec guide;                                               // of a slide; no body: the ground
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();            // at the start [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();                // [rad/s]; in a plane only spin(0)
  double displacement_scale = 0.0, velocity_scale = 0.0;  // of the error test; 0: those of the run
  std::vector<double> moments, spins;                     // as given: one number, in space three
};
const keys::Keys<RigidBodySpec>& rigid_body_keys();

/// A rigid body: three coordinates in a plane, ten in space, one on a slide. Elements may act on
/// each of its points, forces on its centre of mass. Its histories are those of its centre [m] and
/// of its angle [rad] or quaternion; of a slide its displacement along the axis [m].
class RigidBodyComponent : public Component {
 public:
  explicit RigidBodyComponent(RigidBodySpec spec) : spec_(std::move(spec)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<RigidBodyComponent>(*this);
  }
  std::string name() const override { return spec_.name; }
  ComponentTraits traits() const override;
  /// Unless in space: attitudes are states whose clock goes on.
  bool repeats(double) const override { return spec_.motion != RigidBodySpec::Freedom::kSpace; }
  /// InputError for masses and moments that no body has.
  void add_bodies(ModelBuilder& model) override;
  void add_elements(ModelBuilder& model) override;
  void add_body_effects(const ModelBuilder& model, EffectTable& effects) const override;
  void record(const System& system, const StageState& state, History& history) const override;

 private:
  void add_planar(ModelBuilder& model);
  void add_slide(ModelBuilder& model);
  void add_spatial(ModelBuilder& model);
  RigidBodySpec spec_;
  struct Recorded {
    std::string name, unit;
    int coordinate;  // y index
  };
  std::vector<Recorded> recorded_;
  SpatialBody spatial_;  // in space
};

/// Histories of the centre of mass and the quaternion of a spatial body.
void record_attitude(const std::string& name, const SpatialBody& body, const StageState& state,
                     History& history);

ComponentList read_rigid_bodies(const Config& root);

}  // namespace clatter::dynamics
