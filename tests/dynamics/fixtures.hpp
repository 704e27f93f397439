// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Small bodies and elements for the dynamics tests.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/rom/reduced_model.hpp"
#include "dynamics/body/modal_body.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/element/rigid_contact.hpp"
#include "dynamics/integrate/dirk.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics::testing {

/// Parameters and names of tests that run by every method.
inline auto all_methods() {
  return ::testing::Values(&tr_bdf2(), &sdirk2(), &predictor_corrector());
}
inline std::string name_of_method(const ::testing::TestParamInfo<const Tableau*>& info) {
  std::string name = info.param->name;
  std::erase(name, '-');
  return name;
}

/// A mass on a line, q = position [m], on a spring to the ground (k = 0: free).
inline ModalBody point_mass(double mass, double k = 0.0, double damping = 0.0) {
  ModalBody body;
  body.name = "mass";
  body.shapes = Eigen::MatrixXd::Constant(1, 1, 1.0 / std::sqrt(mass));
  body.omega_squared = Eigen::VectorXd::Constant(1, k / mass);
  body.damping = Eigen::VectorXd::Constant(1, damping / mass);
  body.inertia = Eigen::VectorXd::Ones(1);
  body.rigid = Eigen::MatrixXd::Zero(1, 6);
  body.is_rotation = {0};
  body.rigid_modes = k > 0.0 ? 0 : 1;
  body.mass = mass;
  return body;
}

/// A wall at y = gap: force -k <y - gap>^1.5 - c <y - gap> v (compliant, no adhesion for small c).
class Wall : public ForceElement {
 public:
  Wall(int coordinate, double gap, double stiffness, double damping = 0.0, double exponent = 1.5)
      : ForceElement({coordinate}), gap_(gap), k_(stiffness), c_(damping), n_(exponent) {}
  std::string name() const override { return "wall"; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool tangent, Response& response) override {
    const double x = std::max(y(0) - gap_, 0.0);
    response.force = Eigen::VectorXd::Constant(1, -k_ * std::pow(x, n_) - c_ * x * v(0));
    if (!tangent) return;
    const double slope =
        x > 0.0 ? -k_ * n_ * std::pow(x, n_ - 1.0) - c_ * v(0) - c_ * x / stage.kappa : 0.0;
    response.tangent = Eigen::MatrixXd::Constant(1, 1, slope);
  }
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override {
    const double x = std::max(y(0) - gap_, 0.0);
    return {k_ * std::pow(x, n_ + 1.0) / (n_ + 1.0), c_ * x * v(0) * v(0), 0.0};
  }

 private:
  double gap_, k_, c_, n_;
};

/// A rigid floor at y = 0 with Newton's coefficient of restitution. Where impacts accumulate it
/// holds the body on a stiff spring.
class Floor : public ForceElement, public RigidContact {
 public:
  Floor(int coordinate, double restitution, bool may_rest = true)
      : ForceElement({coordinate}), restitution_(restitution), may_rest_(may_rest) {}
  std::string name() const override { return "floor"; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override {
    const double k = resting_ ? 1e8 : 0.0, c = resting_ ? 1e5 : 0.0;
    response.force = -k * y - c * v;
    if (with_tangent) response.tangent.setConstant(1, 1, -k - c / stage.kappa);
  }
  Power power(const Eigen::VectorXd&, const Eigen::VectorXd&) const override { return {}; }
  int events() const override { return resting_ ? 0 : 1; }
  double event_function(int, double, const Eigen::VectorXd& y,
                        const Eigen::VectorXd&) const override {
    return resting_ ? 1.0 : y(0);
  }
  std::optional<Touch> touch(double time, const Eigen::VectorXd& y,
                             const Eigen::VectorXd& v) const override {
    if (resting_ || y(0) > 1e-9) return std::nullopt;
    time_ = time;
    return Touch{{restitution_, 0.0, false},
                 {v(0), 0.0, 0.0},
                 Eigen::RowVector3d::UnitX(),
                 Eigen::Vector3d::Zero(),
                 Eigen::Vector3d::UnitX()};
  }
  void take_impulse(double, double) override { impacts.push_back(time_); }
  bool at_accumulation(int) override { return resting_ = may_rest_; }

  std::vector<double> impacts;  // [s]

 private:
  double restitution_;
  bool may_rest_, resting_ = false;
  mutable double time_ = 0.0;  // of the last touch
};

/// Change of the velocity of a coordinate by a unit impulse on it, at a state [1/kg].
inline double inverse_mass(const System& system, int y, const StageState& state = {}) {
  Eigen::VectorXd eta, v;
  system.jump(state, Eigen::VectorXd::Unit(system.interface_size(), y), eta, v);
  return system.interface(v)(y);
}

inline Eigen::VectorXd vector(double value) { return Eigen::VectorXd::Constant(1, value); }

/// Adds value(t) newtons along coordinate 0 of body 0.
inline void push(System& system, std::function<double(double)> value) {
  system.add_load({"push", 0, system.bodies()[0].shapes.row(0).transpose(), std::move(value)});
}

}  // namespace clatter::dynamics::testing
