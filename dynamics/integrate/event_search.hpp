// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// State events: changes of sign of the elements' event functions within a step.
#include <optional>
#include <vector>

#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

struct Event {
  double time;         // [s]
  int element, index;  // the element's number and that of its event function
};

/// Finds the first event of a step on its cubic interpolant and remembers on which side of zero
/// each function is.
///
/// A step is looked at in parts: a function that is on the other side at the end of a part has a
/// root in it, and one that turns around within a part has two where its extreme is on the other
/// side (a root of even multiplicity that was entered).
class EventSearch {
 public:
  explicit EventSearch(const System& system);

  bool any() const { return !functions_.empty(); }
  /// Takes the sides at the start of the motion; a function that is zero there is on the side to
  /// which it moves.
  void start(const StageState& state);
  std::optional<Event> first(const StageState& from, const StageState& to) const;
  /// After an event, with the velocities that it left: the side to which its function moves.
  void passed(const Event& event, const StageState& state);

 private:
  struct Function {
    int element, index;
    double side = 0.0;  // 1 or -1
  };
  double value(const Function& function, double time, const Eigen::VectorXd& y,
               const Eigen::VectorXd& v) const;
  /// On the step's cubic at `t`, 0 to 1.
  double value_between(const Function& function, const StageState& from, const StageState& to,
                       double t) const;
  bool is_one_sided(const Function& function) const;
  /// The side to which a function moves.
  double direction(const Function& function, const StageState& state) const;
  Eigen::VectorXd interface_acceleration(const StageState& state) const;
  std::optional<double> root(const Function& function, const StageState& from,
                             const StageState& to) const;

  const System* system_;
  std::vector<Function> functions_;
  mutable Eigen::VectorXd y_, v_;  // of one element: working memory, so that no step takes memory
};

}  // namespace clatter::dynamics
