// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A model while components are added to it: its system, its bodies by name, points of bodies.
#include <Eigen/Core>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "dynamics/body/port.hpp"
#include "dynamics/component/loaded_body.hpp"
#include "dynamics/component/run_time.hpp"
#include "dynamics/given/crank_clock.hpp"
#include "dynamics/given/drive.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// A point of a body where an element acts: keys body, set or at_mm.
struct PointSpec {
  std::string body;                   // empty: the ground
  std::string set;                    // of a reduced model: its node; else `at` is given
  std::optional<Eigen::Vector3d> at;  // in the scene's axes at the start [m]
  std::string where;                  // "file:line: bushing[0].a", for messages
};

/// A body that turns about one of the scene's axes: torques may act on its angle.
struct TurningBody {
  int body = 0, dof = 0;  // in the system; the DoF that is the angle [rad]
  int axis = 0;           // 0, 1 or 2: x, y or z, right-handed
};

/// A shaft that a drive turns.
struct Shaft {
  Drive drive;
  Eigen::Vector3d centre, axis;  // a point of its axis [m]; unit vector
};

class ModelBuilder {
 public:
  /// A port of a body at a point, given in the scene's axes at the start [m].
  using PortMaker = std::function<std::unique_ptr<Port>(System&, const Eigen::Vector3d&)>;

  /// The bodies that were read are the first ones of the system. All arguments outlive the builder.
  ModelBuilder(const LoadedBodies& loaded, const TimeSpec& time,
               const std::optional<CrankClock>& clock);

  System system;
  const LoadedBodies& loaded;
  const TimeSpec& time;
  const std::optional<CrankClock>& clock;
  /// What is driven rests where it is at the beginning: for a static equilibrium.
  bool at_rest = false;

  /// Adds a body without a reduced model. InputError at `where` when its name is taken.
  int add_body(ModalBody body, const std::string& where);
  /// Elements may act on any point of `body`, a body of the system or a driven shaft. InputError at
  /// `where` when the name has ports.
  void add_ports(const std::string& body, PortMaker maker, const std::string& where);
  /// `name`, a body of the system or a part of one, turns about a fixed direction.
  void add_turn(const std::string& name, const TurningBody& turn) { turns_[name] = turn; }
  /// nullptr when no body of that name turns.
  const TurningBody* find_turn(const std::string& name) const;
  /// InputError at `where` when no body of that name turns.
  const TurningBody& turn(const std::string& name, const std::string& where) const;
  /// The reference frame of a body with a reduced model moves: points of it are no ports.
  void set_moving_frame(const std::string& body) { moving_.insert(body); }
  /// Bodies may turn with this shaft.
  void add_shaft(const std::string& name, Shaft shaft) { shafts_.emplace(name, std::move(shaft)); }
  /// The shaft that turns the frame of a body with a reduced model, nullptr: none does. InputError
  /// when the scene lacks it.
  const Shaft* shaft_of(const BodySpec& body) const;

  /// Indices in the system by name, in alphabetical order.
  const std::map<std::string, int>& bodies() const { return index_; }
  bool has_body(const std::string& name) const { return index_.count(name) != 0; }
  int body(const std::string& name) const { return index_.at(name); }

  /// The y index of the coordinate of a set of a reduced model along (or, for rotations, about)
  /// axis 0, 1 or 2, which is requested of the system. InputError naming the set when it has none.
  int y(const std::string& body, const std::string& set, int axis, bool rotation);

  /// Position of a point at the start [m]; of one that gives neither set nor position `fallback`.
  Eigen::Vector3d position(const PointSpec& point,
                           const std::optional<Eigen::Vector3d>& fallback) const;
  /// The port of a point. InputError at its `where` for a body that is not in the scene, a set that
  /// its model lacks, or a point of a body whose frame moves.
  std::unique_ptr<Port> port(const PointSpec& point,
                             const std::optional<Eigen::Vector3d>& fallback = std::nullopt);
  /// Its motion at the start of the run.
  PortState at_start(Port& port) const;

 private:
  std::unique_ptr<Port> node_port(const LoadedBody& body, const PointSpec& point);
  std::unique_ptr<Port> floating_port(const LoadedBody& body, const Node& node);
  ModalBody add_floating(const LoadedBody& body);
  struct Floating {
    FloatingBody body;
    SpatialMotion start;  // of its frame
  };
  std::map<std::string, int> index_;
  std::map<std::string, PortMaker> ports_;
  std::map<std::string, TurningBody> turns_;
  std::set<std::string> moving_;
  std::map<std::string, Shaft> shafts_;
  std::map<std::string, Floating> floating_;
};

/// Modal force of gravity or of an accelerated frame per unit acceleration along (or, for 3 to 5,
/// about) an axis: -M r.
Eigen::VectorXd frame_force(const System& system, int body, int direction);

/// The names of a map's entries in one line, for messages.
template <class Map>
std::string names_of(const Map& entries) {
  std::string names;
  for (const auto& entry : entries) names += (names.empty() ? "" : ", ") + entry.first;
  return names.empty() ? "none" : names;
}

}  // namespace clatter::dynamics
