// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What some components offer besides the functions of all: components_of<FieldSource>(model) gives
// those that have it.
#include <Eigen/Core>
#include <map>
#include <string>

#include "core/base/h5_file.hpp"
#include "dynamics/integrate/stage_state.hpp"

namespace clatter::film {
class PistonLiner;
}

namespace clatter::dynamics {

class FieldStream;

/// A piston in its liner.
class PistonInLiner {
 public:
  virtual ~PistonInLiner() = default;
  /// (lateral [m], tilt [rad]) of the piston against its liner, linear in `y`: the motion by which
  /// successive cycles are compared.
  virtual Eigen::Vector2d secondary_motion(double time, const Eigen::VectorXd& y) const = 0;
  /// The contact whose fields are recorded; owned by the model's system. nullptr: none.
  virtual const film::PistonLiner* contact() const = 0;
};

/// Bodies whose frames do not rest at the origin.
class MovingFrames {
 public:
  virtual ~MovingFrames() = default;
  /// Where they are [m], by the body's index in the model.
  virtual std::map<int, Eigen::Vector3d> frames(double time) const = 0;
};

/// A closed row of bodies that move on, as the links of a chain.
class MovingRow {
 public:
  virtual ~MovingRow() = default;
  /// Where on it a body of a model is, for messages; empty: not on it.
  virtual std::string place_of(int body) const = 0;
  /// The body that in the cycle before was where `body` is now, after a time `cycle` [s].
  virtual int body_before(int body, double cycle) const = 0;
};

/// Where in the run file a component records fields, and how often.
struct FieldPlan {
  std::string group;   // empty: it records none
  double every = 0.0;  // between instants [s]
  int instants = 0;    // if `every` is 0: so many of a cycle or run, equally spaced

  /// Between instants of a cycle, or of a run without cycles, both in [s].
  double interval(double cycle) const { return every > 0.0 ? every : cycle / instants; }
};

/// Fields at intervals, for pictures.
class FieldSource {
 public:
  virtual ~FieldSource() = default;
  virtual FieldPlan field_plan() const = 0;
  /// Writes to the plan's group what does not change.
  virtual void write_outlines(H5File& file) const = 0;
  /// The fields of an accepted state.
  virtual void record_fields(const StageState& state, FieldStream& fields) const = 0;
};

}  // namespace clatter::dynamics
