// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Interface of what a scene consists of.
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/config.hpp"
#include "dynamics/component/effects.hpp"
#include "dynamics/component/loaded_body.hpp"
#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/law/history.hpp"

namespace clatter::dynamics {

class ModelBuilder;
class System;

/// Elements of one component in a system.
struct ElementRange {
  int first = 0, end = 0;
};

/// What a component brings to a run.
struct ComponentTraits {
  int modes = 0;           // of bodies without a reduced model, which the run file does not contain
  int64_t film_cells = 0;  // of all pads
  bool has_film = false;   // of oil, whose rates jump where a cell fills
  /// A run starts from static equilibrium: at the places that bodies are given its forces do not
  /// balance.
  bool needs_equilibrium = false;
};

/// One entry of a scene: it reads its own TOML table, adds bodies, elements and loads to a model,
/// and reports their effects and histories.
///
/// A scene has its components as they were read. Each model has copies of them: build_model() calls
/// the functions add_... of all components in the order in which they are declared here, so that
/// elements find all bodies and loads find all elements, and a copy keeps what it needs for its
/// reports. What only some components offer is in component_interfaces.hpp.
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
  virtual ComponentTraits traits() const { return {}; }
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
  /// What the user has to know at the end of a run or cycle, one line each.
  virtual std::vector<std::string> warnings() const { return {}; }

  void set_elements(const ElementRange& elements) { elements_ = elements; }

 protected:
  ElementRange elements_;
};

/// The components of one kind, as read from a scene.
using ComponentList = std::vector<std::shared_ptr<const Component>>;

}  // namespace clatter::dynamics
