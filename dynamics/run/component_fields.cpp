// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/component_fields.hpp"

#include "core/run/run_layout.hpp"

namespace clatter::dynamics {

ComponentFields::ComponentFields(const Model& model, const FieldSource& source, H5File& file,
                                 double begin, double cycle)
    : model_(&model),
      source_(&source),
      clock_(file, source.field_plan().group),
      fields_(file),
      every_(source.field_plan().interval(cycle)),
      next_(begin) {
  clock_.add_column(run::kTime, "s");
  if (model.clock) clock_.add_column(run::kCrankAngle, "deg");
  source.write_outlines(file);
}

void ComponentFields::record(const StageState& now) {
  if (now.time < next_) return;
  if (model_->clock)
    clock_.add({now.time, model_->clock->angle_deg(now.time)});
  else
    clock_.add({now.time});
  source_->record_fields(now, fields_);
  while (next_ <= now.time) next_ += every_;
}

void ComponentFields::finish() {
  clock_.finish();
  fields_.finish();
}

}  // namespace clatter::dynamics
