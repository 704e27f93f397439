// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Rotation of a body in space and its coupling to the body's vibration.
#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/body/spatial_frame.hpp"
#include "dynamics/element/element.hpp"

namespace clatter::dynamics {

/// Inertia of a spatial body in its own frame (spatial_frame.hpp): eq. (9) of the paper with a
/// frame that the body's own motion decides. Without modes it is Euler's equations.
///
///   p' = (Omega p - p Omega_f) / 2,    L' = 0    (moments are added by others)
///   eta'' = ... + 1/2 w^T dJ/d eta w + w^T dH/d eta eta' - h',    h = H^T w
///
/// The last two are Lagrange's equations of the modes: Coriolis, centrifugal and Euler forces. They
/// depend on accelerations only by h', which is found as the rate of an internal state: under the
/// tableau it is (h - h~) / kappa, so that the method integrates the momenta eta' + h. After an
/// event h' is that of before, until the next stage.
///
/// Rotation does not stiffen the body: linear strains only. Stored energy: w^T (J w / 2 + H eta').
class SpinElement : public ForceElement {
 public:
  /// @param coordinates y indices of p, L and the n modes, 7 + n. @param frame of the body.
  /// @param eta_start, v_start coordinates and rates at the start, n.
  SpinElement(std::string body, std::vector<int> coordinates, std::shared_ptr<SpatialFrame> frame,
              const Eigen::VectorXd& y_start, const Eigen::VectorXd& v_start);

  std::string name() const override { return body_ + " rotation"; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void begin_step(double time) override;
  void finish_stage(const Stage& stage) override;
  void accept_step(double time) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  std::vector<double> save() const override;
  void restore(const std::vector<double>& state) override;

 private:
  void rotate(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;
  void add_modes(const Stage& stage, bool with_tangent, Response& response);

  std::string body_;
  std::shared_ptr<SpatialFrame> frame_;
  double time_ = 0.0;  // of the last evaluation
  // Mutable: the state of the last rotate(), which power() calls too.
  mutable Eigen::VectorXd all_y_, all_v_;  // with the centre, which has no part in it
  mutable SpatialState state_;
  bool started_ = false;
  Eigen::VectorXd h_, h_rate_;                 // at the last accepted state
  Eigen::VectorXd h_stage_, h_before_;         // of the trial state, and h~
  std::array<Eigen::VectorXd, 3> stage_rate_;  // h' of the stages of this step
  int stages_ = 0;
};

}  // namespace clatter::dynamics
