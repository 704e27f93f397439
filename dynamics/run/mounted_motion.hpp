// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The slow motion of an engine on its mounts, and how it will settle.
#include <Eigen/Core>
#include <optional>

#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/run/model.hpp"

namespace clatter::dynamics {

/// All bodies of a model as one rigid body on its mounts, in the modes of this oscillator that the
/// mounts hold, up to six: w'' + C w' + K w = loads. Nothing but the mounts works in such a motion,
/// so that its free part is linear, and decays over many cycles where the mounts are soft.
///
/// A cycle takes z = (w, w') to A z + b, A = exp of this oscillator over a cycle. From one cycle
/// z -> z + d follows the motion that repeats, z + (I - A)^-1 d: a step of Newton's method for
/// P(z) = z with the slow part of the Jacobian (shooting; the approach of recursive projection,
/// Shroff and Keller 1993).
class MountedMotion {
 public:
  /// Empty where no mount holds the bodies, or where one of them moves otherwise than by small
  /// deviations. `time`: the ends of cycles [s].
  static std::optional<MountedMotion> of(const Model& model, double time);

  /// Moves eta and v of the state at the end of a cycle of length `cycle` [s] to where the slow
  /// motion repeats. All bodies move together: gaps and forces between them stay as they are.
  /// @return by how much the origin moves [m].
  double predict(const StageState& begin, double cycle, StageState& end) const;

  /// Modal coordinates of the modes, N x h, of unit modal mass.
  const Eigen::MatrixXd& modes() const { return modes_; }
  /// K and C of the modes, h x h: the squares of their frequencies [rad2/s2] are K's diagonal.
  const Eigen::MatrixXd& stiffness() const { return stiffness_; }
  const Eigen::MatrixXd& damping() const { return damping_; }

 private:
  MountedMotion(const System& system, const Eigen::MatrixXd& motions);
  const System& system_;
  Eigen::MatrixXd modes_, stiffness_, damping_;
  Eigen::Matrix<double, 3, Eigen::Dynamic> origin_;  // its displacement, 3 x h
};

}  // namespace clatter::dynamics
