// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// One [[chain]] of a scene.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/config.hpp"
#include "core/keys/table.hpp"
#include "dynamics/chain/belt.hpp"
#include "dynamics/chain/link.hpp"
#include "dynamics/chain/link_joints.hpp"
#include "dynamics/component/model_builder.hpp"
#include "dynamics/profile/mattress.hpp"
#include "dynamics/profile/profile.hpp"

namespace clatter::dynamics {

/// What a chain runs over: a sprocket, or a guide.
struct ChainOver {
  std::string name, where;
  PointSpec on;                            // the body that carries it; of a sprocket its centre
  Turn turn = Turn::kClockwise;            // of the chain around it
  std::shared_ptr<const Profile> profile;  // of a sprocket about its centre, first gap on +x; of a
                                           // guide in the plane's axes at the start
  MattressLaw law;
  int teeth = 0;                 // of a sprocket; 0: a guide
  double pitch_radius = 0.0;     // [m]
  std::optional<double> gap;     // polar angle of a tooth gap at the start [rad]
  std::vector<BeltCircle> belt;  // where the pins' line passes
};

struct ChainSpec {
  std::string name, where;
  int normal = 2;  // axis across the plane, 0 to 2
  ChainMake make;
  JointLaw joint{.damping = 0.0};
  std::filesystem::path pitch_table;  // of each link's pitch error; empty: none
  double bush_radius = 0.0;           // [m]
  double half_height = 0.0;           // of the plates from the line of the pins [m]
  std::vector<ChainOver> over;        // in running order; the first is a sprocket
  /// Its shape is recorded every so many seconds, or degrees of the first sprocket at its speed at
  /// the start; without both kShapes times in the run, with 0 never.
  std::optional<double> shape_every, shape_every_deg;
  static constexpr int kShapes = 300;

  std::vector<std::string> over_names() const;
  /// A vector of the scene in the plane of the chain.
  Eigen::Vector2d in_plane(const Eigen::Vector3d& vector) const;
  /// The plane through the origin in which the links move.
  PlaneAxes plane() const;
};

std::vector<ChainSpec> read_chain_specs(const Config& root);
/// The keys of [[chain]].
const keys::Table& chain_table();

}  // namespace clatter::dynamics
