// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// FORCE, MOMENT, PLOAD, PLOAD2, PLOAD4, GRAV, ACCEL, ACCEL1, RFORCE, SPCD, LOAD, TEMP, TEMPD: the
// loads of sets.
#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {

class Loads {
 public:
  explicit Loads(Model& model) : model_(model), raw_(model.raw) {}

  /// Makes every pressure of every load set a surface of the mesh.
  void build_surfaces();
  /// Load sets that belong to no LOAD, and LOADs.
  std::set<int32_t> top_loads() const;
  Origin origin_of(int32_t load) const;
  /// Adds a load set or a LOAD to a step. InputError at `origin` for a missing set.
  void list(Step& step, int32_t load, Origin origin);
  /// Sets the temperature of a step, with the field of the mesh that it needs.
  void list_temperature(Step& step, int32_t id, Origin origin);

 private:
  void list_set(Step& step, int32_t id, double factor, Origin origin);
  void list_force(Step& step, const RawForce& raw, double factor);
  void name_surfaces(int32_t id, const std::map<double, SurfaceBuilder>& surfaces);
  Eigen::Vector3d vector_of(const RawForce& raw, NodeIndex node_index) const;
  void list_moved(Step& step, int32_t id, const LoadSet& set, double factor);
  void list_gravity(Step& step, const RawGravity& raw, double factor);
  void list_rotation(Step& step, const RawRotation& raw, double factor);
  RowMatrix temperatures(int32_t id, const TemperatureSet& set);

  Model& model_;
  const RawDeck& raw_;
  std::map<int32_t, std::map<double, std::string>> pressure_names_;  // by load set and value
  std::map<int32_t, std::vector<Step::NodalForce>> face_forces_;     // by load set
};

}  // namespace clatter::mesh::deck::nastran
