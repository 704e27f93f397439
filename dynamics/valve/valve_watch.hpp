// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Looks whether a valve closes.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/element/element.hpp"
#include "dynamics/valve/cam_profile.hpp"
#include "dynamics/valve/contact_watch.hpp"
#include "dynamics/valve/roller_contact.hpp"

namespace clatter::dynamics {

/// An element without force. A valve that is open by more than kOpen where the base circle has
/// faced the roller for kSettled, and goes on to do so, has not closed: its lash adjuster has
/// pumped up, or it bounces on its seat.
class ValveWatch : public ForceElement {
 public:
  static constexpr double kOpen = 10e-6;     // [m]
  static constexpr double kSettled = 0.175;  // 10 deg of the cam [rad]
  /// @param coordinates y indices of the valve's displacement and, where there is one, of the
  /// adjuster's plunger. @param roller added to the system before.
  ValveWatch(std::string name, std::vector<int> coordinates, const RollerContact& roller,
             CamProfile profile)
      : ForceElement(std::move(coordinates)),
        name_(std::move(name)),
        roller_(roller),
        profile_(std::move(profile)) {}
  std::string name() const override { return name_; }
  void evaluate(const Stage&, const Eigen::VectorXd& y, const Eigen::VectorXd&, bool with_tangent,
                Response& response) override {
    last_ = {y(0), y(y.size() - 1)};
    response.force.setZero(y.size());
    if (with_tangent) response.tangent.setZero(y.size(), y.size());
  }
  void finish_stage(const Stage&) override { finished_ = last_; }
  void accept_step(double time) override {
    const double angle = profile_.turn() * roller_.accepted().angle;
    const bool open = finished_.lift > kOpen && profile_.rests(angle, kSettled);
    open_.look(time, open, finished_.lift, roller_.accepted().angle);
    if (open && coordinates_.size() > 1) pumped_ = std::max(pumped_, finished_.plunger);
  }
  Power power(const Eigen::VectorXd&, const Eigen::VectorXd&) const override { return {}; }
  std::vector<double> save() const override {
    std::vector<double> state = open_.save();
    state.push_back(pumped_);
    return state;
  }
  void restore(const std::vector<double>& state) override {
    if (state.empty()) throw InputError(name_ + ": the saved state belongs to another scene");
    open_.restore({state.begin(), state.end() - 1}, name_);
    pumped_ = state.back();
  }
  const ContactWatch& open() const { return open_; }
  /// Largest travel of the plunger, out of its housing, while the valve had not closed [m].
  double pumped() const { return pumped_; }

 private:
  std::string name_;
  const RollerContact& roller_;
  CamProfile profile_;
  struct At {
    double lift = 0.0, plunger = 0.0;  // [m]
  };
  At last_, finished_;
  ContactWatch open_;
  double pumped_ = 0.0;
};

}  // namespace clatter::dynamics
