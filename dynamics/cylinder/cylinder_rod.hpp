// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The connecting rod of a cylinder in a model, by its kind.
#include <memory>
#include <vector>

#include "dynamics/body/mechanism_port.hpp"
#include "dynamics/component/effects.hpp"
#include "dynamics/cylinder/cylinder_bodies.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/given/crank.hpp"

namespace clatter::dynamics {

/// The rod's mass properties, of an elastic one by its reduced model. InputError unless its ends
/// are apart by rod.length_mm along z, the first the big end.
RodProperties rod_of(const CylinderSpec& spec, const LoadedBodies& loaded);
/// Adds the body of a rigid rod; an elastic one is in the model, a massless one is none.
void add_rod_body(const CylinderSpec& spec, ModelBuilder& model);

/// The rod's centre of mass, (y, z) [m].
Motion<Eigen::Vector2d> rod_centre(const RodProperties& rod, const SliderCrank& crank, double time);

/// An end of the rod, as joints see it. @param small the small end; else the big end.
std::unique_ptr<Port> rod_end(const CylinderBodies& bodies, const SliderCrank& crank, bool small);
/// Joins the two joints of a massless rod to one element.
std::unique_ptr<ForceElement> massless_rod(const CylinderBodies& bodies,
                                           std::unique_ptr<ForceElement> pin,
                                           std::unique_ptr<ForceElement> crank_pin);
/// Inertia and guide of an elastic rod; none for the others.
std::vector<std::unique_ptr<ForceElement>> elastic_rod_elements(const CylinderBodies& bodies,
                                                                const SliderCrank& crank);
/// Inertia of the moving frame, eq. (9) and (10), under the name `term`; with the ramp of the
/// start.
std::vector<Load> rod_inertia(const CylinderBodies& bodies, const SliderCrank& crank,
                              const std::string& term);

/// A row of the table of effects: inertia, and of an elastic rod its guide.
struct RodEffect {
  const EffectEntry* entry;
  bool on;
  std::string why, element;
};
std::vector<RodEffect> rod_effects(const CylinderSpec& spec);

}  // namespace clatter::dynamics
