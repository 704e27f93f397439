// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Fields that a component records at intervals.
#include <cstdint>

#include "dynamics/component/component_interfaces.hpp"
#include "dynamics/component/field_stream.hpp"
#include "dynamics/law/archive.hpp"
#include "dynamics/run/column_stream.hpp"
#include "dynamics/run/model.hpp"

namespace clatter::dynamics {

/// The fields of one component over its own clock, `<group>/time` and, with a crank,
/// `<group>/crank_angle_deg`.
class ComponentFields {
 public:
  /// Of a component of `model` whose plan has a group; model and file outlive this. @param begin
  /// of the recorded span, @param cycle length of a cycle, or of the span without one [s].
  ComponentFields(const Model& model, const FieldSource& source, H5File& file, double begin,
                  double cycle);
  /// After each accepted step.
  void record(const StageState& now);
  /// Writes what is held, at the end or before.
  void finish();
  /// When the next fields are due.
  void archive(Archive& archive) { archive(next_); }
  /// Numbers in memory.
  int64_t held() const { return clock_.held() + fields_.held(); }

 private:
  const Model* model_;
  const FieldSource* source_;
  ColumnStream clock_;
  FieldStream fields_;
  double every_, next_;
};

}  // namespace clatter::dynamics
