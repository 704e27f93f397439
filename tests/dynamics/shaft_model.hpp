// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Shafts of TOML text as systems, and their linearised motion.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/component/model_builder.hpp"
#include "dynamics/shaft/shaft_component.hpp"

namespace clatter::dynamics::testing {

/// The shafts of a text in a model.
struct ShaftModelOf {
  LoadedBodies loaded;
  TimeSpec time;
  std::optional<CrankClock> clock;
  std::vector<ShaftComponent> shafts;
  ModelBuilder builder{loaded, time, clock};

  explicit ShaftModelOf(const std::string& text);
  System& system() { return builder.system; }
  /// y index of a DoF of a body.
  int y(const std::string& body, int dof) {
    return builder.system.coordinate(builder.body(body), dof);
  }
};

/// M y'' + C y' + K y = 0 in the interface coordinates of a system whose bodies have one coordinate
/// each DoF, about a motion (y, v).
struct LinearMotion {
  Eigen::VectorXd M;
  Eigen::MatrixXd C, K;
};
LinearMotion linearised(System& system, const Eigen::VectorXd& y, const Eigen::VectorXd& v);

/// Frequencies [Hz] of the undamped motion at rest, ascending, without the `rigid` first ones.
Eigen::VectorXd frequencies(System& system, int rigid);

/// Eigenvalues of M y'' + C y' + K y = 0.
Eigen::VectorXcd eigenvalues(const LinearMotion& motion);

/// A shaft of steel of 24 x 330 mm along z, with more keys and tables.
std::string steel_shaft(const std::string& more);

}  // namespace clatter::dynamics::testing
