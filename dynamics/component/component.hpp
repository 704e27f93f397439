// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Interface of what a scene consists of.
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/config.hpp"
#include "core/base/h5_file.hpp"
#include "dynamics/component/effects.hpp"
#include "dynamics/component/loaded_body.hpp"
#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/law/history.hpp"

namespace clatter::film {
class PistonLiner;
}

namespace clatter::dynamics {

class FieldStream;
class ModelBuilder;
class System;

/// Elements of one component in a system.
struct ElementRange {
  int first = 0, end = 0;
};

/// What a component adds to a run, for the prediction of its size.
struct ComponentSize {
  int modes = 0;           // of bodies without a reduced model, which the run file does not contain
  int64_t film_cells = 0;  // of all pads
};

/// Where in the run file a component records fields, and how often.
struct FieldPlan {
  std::string group;   // empty: it has none
  double every = 0.0;  // between instants [s]
  int instants = 0;    // if `every` is 0: so many of a span, equally spaced

  /// Between instants of a span, both in [s].
  double interval(double span) const { return every > 0.0 ? every : span / instants; }
};

/// One entry of a scene: it reads its own TOML table, adds bodies, elements and loads to a model,
/// and reports their effects and histories.
///
/// A scene has its components as they were read. Each model has copies of them: build_model() calls
/// the functions add_... of all components in the order in which they are declared here, so that
/// elements find all bodies and loads find all elements, and a copy keeps what it needs for its
/// reports.
class Component {
 public:
  virtual ~Component() = default;
  virtual std::unique_ptr<Component> clone() const = 0;
  /// Its name in files and messages, empty where a scene has one of its kind.
  virtual std::string name() const { return ""; }

  /// Reduced models to be read; their bodies are the first ones of the model.
  virtual std::vector<BodySpec> reduced_bodies() const { return {}; }
  /// Further files that it reads.
  virtual std::vector<std::filesystem::path> inputs() const { return {}; }
  virtual ComponentSize size() const { return {}; }
  /// It has an oil film, whose rates jump where a cell fills.
  virtual bool has_film() const { return false; }
  /// A run starts from static equilibrium: at the places that bodies are given its forces do not
  /// balance.
  virtual bool needs_equilibrium() const { return false; }
  /// Where on it a body of a model is, for messages; empty: not on it.
  virtual std::string place_of(int /*body*/) const { return ""; }
  /// What it prescribes is the same after a time `cycle` [s].
  virtual bool repeats(double /*cycle*/) const { return true; }

  /// Adds bodies without a reduced model, and points where elements may act.
  virtual void add_bodies(ModelBuilder&) {}
  /// Requests coordinates, in the order in which they are to be numbered, and adds elements.
  virtual void add_elements(ModelBuilder&) {}
  virtual void add_loads(ModelBuilder&) {}
  /// Rows of the table of effects, on and off with the keys that decide: which bodies move and how,
  /// then all others.
  virtual void add_body_effects(const ModelBuilder&, EffectTable&) const {}
  virtual void add_effects(const ModelBuilder&, EffectTable&) const {}

  /// Histories of an accepted state; those of its elements, where it has no others.
  virtual void record(const System& system, const StageState& state, History& history) const;
  /// The body that in the cycle before was where `body` is now, after a time `cycle` [s]: chains
  /// move on by some links.
  virtual int body_before(int body, double /*cycle*/) const { return body; }
  /// What the user has to know at the end of a run or cycle, one line each.
  virtual std::vector<std::string> warnings() const { return {}; }
  /// It has a motion by which successive cycles are compared: secondary_motion().
  virtual bool has_secondary_motion() const { return false; }
  /// (lateral [m], tilt [rad]) of a piston against its liner, linear in `y`.
  virtual Eigen::Vector2d secondary_motion(double /*time*/, const Eigen::VectorXd& /*y*/) const {
    return Eigen::Vector2d::Zero();
  }
  /// Of its bodies in a model whose frames do not rest at the origin: where they are [m], by index.
  virtual std::map<int, Eigen::Vector3d> frames(double /*time*/) const { return {}; }
  /// The contact whose fields are recorded; owned by the model's system.
  virtual const film::PistonLiner* contact() const { return nullptr; }

  /// Fields of a model's component at intervals, for pictures. The group gets what does not change
  /// by write_outlines() and the fields of an accepted state by record_fields().
  virtual FieldPlan field_plan() const { return {}; }
  virtual void write_outlines(H5File&) const {}
  virtual void record_fields(const StageState&, FieldStream&) const {}

  void set_elements(const ElementRange& elements) { elements_ = elements; }

 protected:
  ElementRange elements_;
};

/// The components of one kind, as read from a scene.
using ComponentList = std::vector<std::shared_ptr<const Component>>;

}  // namespace clatter::dynamics
