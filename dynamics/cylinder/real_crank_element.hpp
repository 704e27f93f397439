// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// An element of a cylinder whose crank turns freely.
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/cylinder/cylinder_bodies.hpp"
#include "dynamics/cylinder/real_crank.hpp"
#include "dynamics/element/element.hpp"

namespace clatter::dynamics {

/// A coordinate of an element that counts from the ideal motion: which, and that motion over theta.
struct ReferredCoordinate {
  int coordinate;  // y index
  std::function<Motion<double>(const SliderCrank&, const Motion<double>& theta)> ideal;
};

/// An element that is made for the ideal motion, at the angle d from its clock at which the crank
/// really is.
///
/// Its coordinate s counts from the ideal motion z(theta) of the clock. The element gets s - D from
/// that of the real crank instead, and sees it by CrankMotion,
///
///   D = z(theta + d) - z(theta),   by the tableau as s is, from its exact value at the start
///
/// so positions are as before, while what depends on theta, on its rate, and on z' is that of the
/// real crank. Forces do not act on d, on which they depend: one more column of the tangent, by a
/// difference. The work of the force on s by D' is input, as that of z'(theta) is.
class RealCrankElement : public ForceElement {
 public:
  /// @param crank which the element sees. @param turn y index of the rotation about +x from that
  /// of the clock. @param referred s, among the coordinates of the element; absent: none.
  RealCrankElement(std::unique_ptr<ForceElement> element, std::shared_ptr<RealCrank> crank,
                   int turn, std::optional<ReferredCoordinate> referred);

  std::string name() const override { return element_->name(); }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void begin_step(double time) override { element_->begin_step(time); }
  void finish_stage(const Stage& stage) override;
  void accept_step(double time) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  void record(History& history) const override { element_->record(history); }
  std::vector<double> save() const override;
  void restore(const std::vector<double>& state) override;

 private:
  /// The element's response where the crank is at `turn`, in at_.
  void evaluate_at(const Stage& stage, double turn, double rate, bool with_tangent);
  void add_column(const Eigen::VectorXd& moved, double step, Response& response) const;

  std::unique_ptr<ForceElement> element_;
  std::shared_ptr<RealCrank> crank_;
  std::optional<ReferredCoordinate> referred_;
  Eigen::Index place_ = -1;                    // of s
  Eigen::VectorXd given_y_, given_v_, y_, v_;  // without d; of the element
  Response at_;
  struct Shift {
    double value = 0.0, rate = 0.0;  // D and D'
    double force = 0.0;              // on s
  };
  Shift last_;
  std::vector<double> rates_;  // D' at the finished stages of this step
};

/// How one element of a cylinder sees its crank: `motion` goes into the element, which follow()
/// then completes. With a prescribed crank it is that of the clock, and the element stays as it is.
class CrankView {
 public:
  CrankView(const CylinderBodies& bodies, const SliderCrank& crank);
  const CrankMotion& motion() const { return motion_; }
  std::unique_ptr<ForceElement> follow(
      std::unique_ptr<ForceElement> element,
      std::optional<ReferredCoordinate> referred = std::nullopt) const;

 private:
  std::shared_ptr<RealCrank> crank_;  // of a free one
  int turn_ = -1;
  CrankMotion motion_;
};

/// The pin's coordinate along the stroke, which counts from the ideal stroke.
ReferredCoordinate along_stroke(int coordinate);

}  // namespace clatter::dynamics
