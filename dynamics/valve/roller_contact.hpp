// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Contact of a roller with a cam.
#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/body/port.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/profile/mattress.hpp"
#include "dynamics/valve/contact_watch.hpp"

namespace clatter::dynamics {

/// The cam on its body.
struct CamCarrier {
  std::unique_ptr<Port> port;  // at the centre of the profile
  PlaneAxes plane;             // the axes of the follower's plane
  Eigen::Vector3d direction;   // of the profile's x axis in the body's axes
};

/// A roller and a cam by an elastic foundation (profile/mattress.hpp), in the follower's plane. The
/// roller turns freely on its pin: no friction. Force on the roller's centre; the cam takes the
/// reaction at the same line. Refuses a state in which the roller is deeper than half its radius.
class RollerContact : public ForceElement {
 public:
  /// @param roller port of its centre. @param profile of the cam.
  RollerContact(std::string name, std::unique_ptr<Port> roller, CamCarrier cam,
                std::shared_ptr<const Profile> profile, double radius, const MattressLaw& law);

  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void finish_stage(const Stage&) override { finished_ = last_; }
  /// Where the cam was lost it finds the gap.
  void accept_step(double time) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  /// `<name>_force` [N] and `_gap` [m]: below 0 it is the depth of the contact; `_losses`, how
  /// often the roller has lost the cam. Spaces of the name are underscores.
  void record(History& history) const override;
  std::vector<double> save() const override { return losses_.save(); }
  /// Also forgets where the roller was clear of the cam.
  void restore(const std::vector<double>& state) override {
    losses_.restore(state, name_);
    hint_ = {};
  }

  struct Instant {
    double force = 0.0, depth = 0.0, gap = 0.0;  // [N], [m]
    double moment = 0.0;  // on the cam about first x second of the plane [N m]
    double stored = 0.0, lost = 0.0, input = 0.0;  // [J], [W]
    double angle = 0.0;                            // of the profile in the plane [rad]
    Eigen::Vector2d on_roller = Eigen::Vector2d::Zero(), place = on_roller;
  };
  const Instant& accepted() const { return accepted_; }
  const Instant& finished() const { return finished_; }
  /// Times at which the roller was off the cam by more than kLostGap.
  const ContactWatch& losses() const { return losses_; }
  static constexpr double kLostGap = 5e-6;  // [m]

 private:
  using Planar = Eigen::Matrix<double, 5, Eigen::Dynamic>;
  /// x, y of the roller and x, y, angle of the cam by the coordinates of both ports.
  struct Motion {
    Eigen::Vector2d distance, velocity, direction;  // of roller from cam; the profile's x axis
    double spin = 0.0;
    Planar by_y, rate_by_y, rate_by_v, work;
  };
  void move(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v, bool with_rows);
  void fill_tangent(double kappa, Eigen::MatrixXd& tangent);
  double driven_power() const;

  std::string name_;
  std::array<std::string, 4> recorded_;
  std::unique_ptr<Port> roller_;
  CamCarrier cam_;
  std::shared_ptr<const Profile> profile_;
  MattressContact contact_;
  ContactHint hint_;
  MattressForce force_;
  Motion motion_;
  Planar change_;
  PlanarPose pose_;
  PlanarRate rate_;
  PortState at_roller_, at_cam_;
  Eigen::VectorXd y_roller_, v_roller_, y_cam_, v_cam_;
  Instant last_, finished_, accepted_;
  ContactWatch losses_;
};

}  // namespace clatter::dynamics
