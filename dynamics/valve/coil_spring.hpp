// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Force of a coil spring with mass between two ports.
#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/body/modal_body.hpp"
#include "dynamics/body/port.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/valve/coil_law.hpp"

namespace clatter::dynamics {

/// Displacement [m] and velocity [m/s] along the spring of its ends at the start.
struct CoilStart {
  double a = 0.0, b = 0.0, a_rate = 0.0, b_rate = 0.0;
};

/// The masses of a spring: their displacements along its axis, which is fixed in space, from where
/// they are at the installed length.
/// @param axis unit vector from end a to end b. @param start of the ends, linear between them.
ModalBody make_coil_body(const std::string& name, const CoilSpringSpec& spec,
                         const Eigen::Vector3d& axis, const CoilStart& start);

/// A port at an end of a spring, which sees its motion along the spring's axis only.
class CoilEnd {
 public:
  /// @param origin where the end is at the installed length [m].
  CoilEnd(std::unique_ptr<Port> port, const Eigen::Vector3d& axis, const Eigen::Vector3d& origin)
      : port_(std::move(port)), axis_(axis), origin_(origin) {}
  const Port& port() const { return *port_; }
  int size() const { return port_->size(); }
  /// At coordinates `first`, `first` + 1, ... of y and v.
  void move(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v, Eigen::Index first);
  double travel() const { return axis_.dot(at_.position - origin_); }  // [m]
  double rate() const { return axis_.dot(at_.velocity); }              // [m/s]
  /// Forces on the coordinates by a unit force along the axis; after move().
  const Eigen::VectorXd& work() const { return work_; }
  /// Derivatives by the coordinates; differentiate() first, with v changing by per_kappa of y.
  void differentiate(double per_kappa);
  const Eigen::RowVectorXd& by_travel() const { return by_travel_; }
  const Eigen::RowVectorXd& by_rate() const { return by_rate_; }
  /// tangent += force d(work)/dy.
  void add_curvature(double force, Eigen::Ref<Eigen::MatrixXd> tangent) const;
  /// Power that what drives the port puts in against a force along the axis [W].
  double driven_power(double force) const;

 private:
  std::unique_ptr<Port> port_;
  Eigen::Vector3d axis_, origin_;
  PortState at_;
  Eigen::VectorXd y_, v_, work_;
  Eigen::RowVectorXd by_travel_, by_rate_;
};

/// A spring with mass whose coils may touch (coil_law.hpp), between two ports on one line along its
/// axis. The axis is fixed in space: where an end moves across it the force goes with that end, and
/// stays parallel. What acts on the ends and on the masses sums up to zero to rounding.
class CoilSpring : public ForceElement {
 public:
  /// @param masses y indices of the displacements of make_coil_body(), n.
  CoilSpring(std::string name, CoilEnd a, CoilEnd b, const std::vector<int>& masses,
             const CoilSpringSpec& spec);
  std::string name() const override { return name_; }
  const std::vector<std::vector<int>>& groups() const override { return groups_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void finish_stage(const Stage&) override { finished_ = last_; }
  void accept_step(double) override { accepted_ = finished_; }
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  /// `<name>_force` on end b, `_seat_force` on end a, both as pushes [N], and `_least_gap` between
  /// coils [m]; spaces of the name are underscores.
  void record(History& history) const override;

  struct Instant {
    double force = 0.0, seat_force = 0.0, least_gap = 0.0;
  };
  const Instant& accepted() const { return accepted_; }

 private:
  /// Of a part of the spring, from one mass or end to the next.
  struct Part {
    double change = 0.0, rate = 0.0;
  };
  Part part(size_t i, const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;
  void fill_inner(double slope, Eigen::MatrixXd& block) const;
  void fill_end(CoilEnd& end, bool is_first, const CoilForce& law, double kappa,
                Eigen::MatrixXd& block) const;

  std::string name_;
  std::array<std::string, 3> recorded_;
  mutable CoilEnd a_, b_;  // they keep their last motion, which power() looks at as well
  std::vector<CoilLaw> laws_;
  std::vector<std::vector<int>> groups_;  // one a part
  Eigen::Index first_;                    // place of the first mass among the coordinates
  double time_ = 0.0;
  Instant last_, finished_, accepted_;
};

}  // namespace clatter::dynamics
