// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Contact of all links of a chain with one profile.
#include <Eigen/Core>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dynamics/body/port.hpp"
#include "dynamics/chain/link.hpp"
#include "dynamics/chain/tooth_count.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/law/creep_watch.hpp"
#include "dynamics/profile/mattress.hpp"

namespace clatter::dynamics {

/// What carries a profile: a port of its body, and how the profile is on it.
struct ProfileCarrier {
  std::unique_ptr<Port> port;
  PlaneAxes plane;     // of the chain
  double angle = 0.0;  // of the profile's x axis in the body's axes [rad]
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // of the port in the profile's axes [m]
};

/// Parts of a link that may touch the profile, by the kind of the link.
struct LinkOutlines {
  std::vector<LinkOutline> inner, outer;
};

/// Winkler mattresses between the outlines of all links and a profile on a body: force and moment
/// on each link, and their reaction at the same points of space on the body. Each contact couples
/// one link with the body; a link that is far from the profile costs a comparison.
/// Refuses a state in which a contact is deeper than its law bears.
class ProfileContact : public ForceElement {
 public:
  /// @param links y indices of u, v, angle of all links, 3 n. @param teeth counts the jumps on
  /// a sprocket. @param name of its histories
  /// `<name>_force_x`, `_force_y` [N] on the body in the plane's axes, `<name>_depth` [m],
  /// `<name>_contacts`.
  ProfileContact(std::string name, const std::vector<int>& links, const ChainMake& make,
                 std::shared_ptr<const Profile> profile, const LinkOutlines& outlines,
                 const MattressLaw& law, ProfileCarrier carrier, ToothCount teeth = {});

  std::string name() const override { return name_; }
  const std::vector<std::vector<int>>& groups() const override { return groups_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void finish_stage(const Stage&) override { finished_ = last_; }
  void accept_step(double time) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  void record(History& history) const override;
  std::vector<double> save() const override { return teeth_.save(); }
  /// Also forgets where links were clear of the profile: the same motion then has the same bits.
  void restore(const std::vector<double>& state) override;
  void begin_step(double time) override { creep_.begin_step(time); }
  void archive(Archive& archive) override { creep_.archive(archive); }
  std::optional<double> crept() const override;

  /// Outlines of all links: bushes or plates.
  int outlines() const;
  /// The gap of each of them from the profile [m]: negative by its depth where it touches, else a
  /// lower bound of the distance, above 0 and finite. For integrators that look for the instants at
  /// which contacts begin and end; forces are continuous there, so the kernel's do not.
  void find_gaps(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                 std::span<double> gaps);
  /// Where the profile's axes are: origin [m] and angle [rad, -pi to pi], in the plane's axes.
  /// @param y, v of the system.
  Eigen::Vector3d place(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;
  /// Angular velocity of what carries the profile, counter-clockwise in the plane [rad/s].
  double spin(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;
  const Profile& profile() const { return *profile_; }

  /// Links in contact at the last accepted state.
  int contacts() const { return accepted_.contacts; }
  /// Jumps of the chain on a sprocket.
  const ToothCount& teeth() const { return teeth_; }

 private:
  using Planar = Eigen::Matrix<double, 3, Eigen::Dynamic>;
  /// The port's motion in the plane, its derivatives by its coordinates, and the direction of the
  /// profile's axes.
  struct Motion {
    Eigen::Vector2d position, velocity;
    double cosine = 1.0, sine = 0.0, angle = 0.0, spin = 0.0;
    Eigen::Vector2d middle;  // of the profile
    Eigen::Vector3d driven;  // prescribed part of velocity and spin, of a driven port
    Planar by_y, rate_by_y, rate_by_v, work;
  };
  struct Totals {
    Eigen::Vector2d force = Eigen::Vector2d::Zero();  // on the body [N]
    double depth = 0.0;                               // [m]
    double stored = 0.0, lost = 0.0, input = 0.0;     // [J], [W]
    int contacts = 0;
  };
  void move(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v, Motion& motion) const;
  /// A link relative to the port, in the profile's axes.
  struct Relative {
    Eigen::Vector2d position, velocity;
    double spin = 0.0;
  };
  /// Where a link was found not to touch, and how far from the profile it was at least.
  struct Clear {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();  // relative to the port
    double angle = 0.0, distance = 0.0;
  };
  Motion motion_at(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;
  void find_reach();
  void make_blocks(Response& response) const;
  int gap_of(const PlanarPose& pose, const LinkOutline& bush) const;
  bool is_far(int link, const Motion& motion, const Eigen::VectorXd& y);
  Relative relative(int link, const Motion& motion, const Eigen::VectorXd& y,
                    const Eigen::VectorXd& v) const;
  PlanarPose pose_of(const Motion& motion, const Relative& at, double angle) const;
  bool touch(int link, const Motion& motion, const Relative& at, double angle, bool with_tangent,
             MattressForce& sum);
  void fill_tangent(const Motion& motion, const Relative& at, const MattressForce& contact,
                    double kappa, TangentBlock& block) const;
  void add_forces(int link, const Motion& motion, const Relative& at, const MattressForce& contact,
                  Response& response);

  std::string name_;
  std::array<std::string, 4> recorded_;
  int links_;
  std::vector<LinkKind> kinds_;
  std::vector<std::vector<MattressContact>> contacts_;  // per link
  std::shared_ptr<const Profile> profile_;
  ProfileCarrier carrier_;
  Eigen::Vector2d middle_;  // of the profile, in its axes [m]
  double reach_ = 0.0;      // a link whose centre is farther from there does not touch [m]
  double size_ = 0.0;       // largest distance of an outline's point from its link's centre [m]
  std::vector<std::vector<int>> groups_;  // per link; the last one: the carrier
  std::vector<std::vector<ContactHint>> hints_;
  std::vector<Clear> clear_;  // per link
  // Mutable: working memory of the carrier's motion, which power() looks at as well.
  mutable PortState at_;
  mutable Eigen::VectorXd y_port_, v_port_;
  Motion motion_;
  Totals last_, finished_, accepted_;
  std::vector<int> gap_;  // per link that touches: the tooth gap of its rear pin; else negative
  ToothCount teeth_;
  double friction_;           // its coefficient
  std::vector<double> slip_;  // per link at the last state [m/s]; nan: it does not touch
  CreepWatch creep_;
};

}  // namespace clatter::dynamics
