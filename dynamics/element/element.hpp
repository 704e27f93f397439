// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Interface of force elements: forces and their tangent at an implicit stage, internal states under
// the same tableau, power, and reported scalars.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/law/archive.hpp"
#include "dynamics/law/history.hpp"
#include "dynamics/law/stage.hpp"

namespace clatter::dynamics {

/// A part of an element's tangent that couples few of its coordinates: those of its group, n_g.
struct TangentBlock {
  bool active = false;     // else zero, whatever the values
  Eigen::MatrixXd values;  // n_g x n_g; df/dy + df/dv / kappa at fixed stage
};

/// Force on the element's coordinates and its derivative.
struct Response {
  Eigen::VectorXd force;    // n_e; works on y: [N] on displacements, [N m] on rotations
  Eigen::MatrixXd tangent;  // n_t x n_t; df/dy + df/dv / kappa at fixed stage
  /// The n_t of the element's coordinates on which its force depends at this state and acts, where
  /// it touches few of them; ascending. Empty: all, n_t = n_e. Set by every evaluation.
  std::vector<int> touched;
  /// One per group, of an element that has groups; then `tangent` and `touched` have no meaning.
  std::vector<TangentBlock> blocks;
};

/// Energy and power of an element.
struct Power {
  double stored = 0;  // potential energy [J]
  double lost = 0;    // dissipated power [W], positive
  double input = 0;   // power from prescribed motion or supply [W]
};

/// A force between interface coordinates y of the bodies (see system.hpp).
///
/// The order of calls in one step: begin_step; for each stage evaluate (as often as Newton needs),
/// then finish_stage; accept_step at the end, or begin_step again when the step was rejected. The
/// last evaluate before finish_stage was at the state that is kept: its forces are those of the
/// stage (to the small part of the error limit that StageNewton names).
class ForceElement {
 public:
  virtual ~ForceElement() = default;
  virtual std::string name() const = 0;

  /// Indices of the element's coordinates in the system's y; n_e of them.
  const std::vector<int>& coordinates() const { return coordinates_; }

  /// Groups of the element's coordinates (places in coordinates(), n_g each) where its tangent is a
  /// sum of small blocks, each in one group: a chain couples each link with its neighbours and with
  /// what it touches. Fixed; a group may have no block at the moment. Empty: one dense tangent.
  virtual const std::vector<std::vector<int>>& groups() const {
    static const std::vector<std::vector<int>> none;
    return none;
  }

  /// Forces at a trial state. `y`, `v`: n_e displacements and velocities; `response.tangent` is
  /// computed only if `with_tangent`. Resizes the response. Throws StepRefused.
  virtual void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                        bool with_tangent, Response& response) = 0;

  /// Before the first stage of a step from `time`; also discards the states of a rejected step.
  virtual void begin_step(double /*time*/) {}
  /// The stage converged: stores its internal states and rates.
  virtual void finish_stage(const Stage&) {}
  /// The internal state of the last stage becomes the state.
  virtual void accept_step(double /*time*/) {}

  /// Number of event functions. A change of their sign is an event: the step is repeated to end
  /// there, and the element changes its own mode by at_event().
  virtual int events() const { return 0; }
  /// Value of an event function, continuous along the motion.
  virtual double event_function(int /*index*/, double /*time*/, const Eigen::VectorXd& /*y*/,
                                const Eigen::VectorXd& /*v*/) const {
    return 1.0;
  }
  /// The function may not be negative, as the gap of a rigid contact: after its event it counts as
  /// positive whatever rounding left, so that a motion into the forbidden side is the next event.
  virtual bool is_one_sided(int /*index*/) const { return false; }
  /// The event happens now. That of an impact is not told: see rigid_contact.hpp.
  virtual void at_event(int /*index*/, double /*time*/) {}
  /// Events of this function follow each other without end, as the impacts of a bouncing ball do.
  /// True when the element takes a mode in which they do not; false ends the run.
  virtual bool at_accumulation(int /*index*/) { return false; }

  /// Energy and power at the last evaluation: that of a finished stage, or of the state that an
  /// event left; `y`, `v` are of that state.
  virtual Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const = 0;
  /// Named scalars of the last accepted state.
  virtual void record(History&) const {}
  /// Internal state as numbers, for checkpoints; `restore` takes the result of `save`.
  virtual std::vector<double> save() const { return {}; }
  virtual void restore(const std::vector<double>& /*state*/) {}
  /// What it has watched of the recorded span, for a checkpoint within that.
  virtual void archive(Archive&) {}
  /// The longest way that one of its contacts crept at rest, so far [m]: creep_watch.hpp. Empty
  /// where no friction of it creeps.
  virtual std::optional<double> crept() const { return std::nullopt; }

 protected:
  ForceElement() = default;
  explicit ForceElement(std::vector<int> coordinates) : coordinates_(std::move(coordinates)) {}
  std::vector<int> coordinates_;
};

}  // namespace clatter::dynamics
