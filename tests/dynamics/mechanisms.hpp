// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Mechanisms of rigid bodies for the tests.
#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/body/rigid_body.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/integrate/integrator.hpp"
#include "dynamics/integrate/spatial_body.hpp"
#include "dynamics/integrate/system.hpp"
#include "dynamics/law/joint_laws.hpp"

namespace clatter::dynamics::testing {

/// Adds a planar body; the y indices of its three coordinates.
inline std::vector<int> add_planar(System& system, const std::string& name, double mass,
                                   double inertia, const PlanarMotion& start) {
  const int body = system.add_body(make_planar_body(name, mass, inertia, start));
  return {system.coordinate(body, 0), system.coordinate(body, 1), system.coordinate(body, 2)};
}

/// Adds a mass that moves along x; the y indices of its displacements x, y, z.
inline std::vector<int> add_slider(System& system, double mass, double position, double velocity) {
  ModalBody body;
  body.name = "slider";
  body.shapes = Eigen::Vector3d(1.0 / std::sqrt(mass), 0.0, 0.0);
  body.omega_squared = body.damping = Eigen::VectorXd::Zero(1);
  body.inertia = Eigen::VectorXd::Ones(1);
  body.rigid = Eigen::MatrixXd::Zero(1, 6);
  body.is_rotation = {0, 0, 0};
  body.mass = mass;
  body.eta_start = Eigen::VectorXd::Constant(1, std::sqrt(mass) * position);
  body.v_start = Eigen::VectorXd::Constant(1, std::sqrt(mass) * velocity);
  const int added = system.add_body(body);
  return {system.coordinate(added, 0), system.coordinate(added, 1), system.coordinate(added, 2)};
}

/// A method that starts from the system's own state at time 0.
inline std::unique_ptr<Integrator> started(System& system, const StepOptions& options) {
  auto method = make_integrator(system, options);
  method->start(-options.first, system.eta_start(), system.v_start());
  return method;
}

/// Numbers between -1 and 1.
Eigen::VectorXd arbitrary(int n, unsigned seed);

/// The largest difference of an element's tangent from central differences, relative to its largest
/// entry. @param step of the differences. @param kappa of the stage [s].
double tangent_error(ForceElement& element, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                     double step = 1e-6, double kappa = 0.03);

/// A moment on coordinates, constant.
class Moment : public ForceElement {
 public:
  Moment(int coordinate, double value) : ForceElement({coordinate}), value_(value) {}
  std::string name() const override { return "moment"; }
  void evaluate(const Stage&, const Eigen::VectorXd&, const Eigen::VectorXd&, bool with_tangent,
                Response& response) override {
    response.force.setConstant(1, value_);
    if (with_tangent) response.tangent.setZero(1, 1);
  }
  Power power(const Eigen::VectorXd&, const Eigen::VectorXd& v) const override {
    return {0.0, 0.0, value_ * v(0)};
  }

 private:
  double value_;
};

/// Andrews' squeezing mechanism (Hairer and Wanner 1996, section VII.7; parameters and reference of
/// the Test Set for IVP Solvers): seven planar bodies, revolute joints of a stiffness, a spring.
struct Andrews {
  System system;
  std::vector<std::vector<int>> bodies;  // y indices of K1 .. K7
  explicit Andrews(double joint_stiffness, double joint_damping);
  /// beta, theta, gamma, phi, delta, omega, epsilon of the state y.
  Eigen::Matrix<double, 7, 1> angles(const Eigen::VectorXd& y) const;
};

}  // namespace clatter::dynamics::testing
