// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/recorder.hpp"

#include "core/run/run_layout.hpp"

namespace clatter::dynamics {
namespace {

void add_clock_columns(ColumnStream& columns, const Model& model) {
  columns.add_column(run::kTime, "s");
  if (model.clock) columns.add_column(run::kCrankAngle, "deg");
}

}  // namespace

Recorder::Recorder(const Model& model, const RecordedSpan& span, H5File& file,
                   UniformSamples::Sink sink)
    : model_(model),
      samples_(span.begin, span.end, span.output_step, model.system.modes(), std::move(sink)),
      history_(file, "history"),
      energy_(file, "energy"),
      film_clock_(file, "film"),
      film_every_(span.film_every),
      next_film_(span.begin) {
  for (const FieldSource* source : components_of<FieldSource>(model))
    if (!source->field_plan().group.empty())
      fields_.emplace_back(model, *source, file, span.begin, span.cycle);
  for (const auto& [name, contact] : contacts_of(model))
    films_.emplace_back(file, *contact, name.empty() ? "film" : run::path("film", name));
  for (ColumnStream* columns : {&history_, &energy_, &film_clock_})
    add_clock_columns(*columns, model);
}

void Recorder::add_clock(double time) {
  row_.clear();
  row_.push_back(time);
  if (model_.clock) row_.push_back(model_.clock->angle_deg(time));
}

void Recorder::record(const Integrator& method, const EnergyBalance& energy) {
  const StageState& now = method.state();
  samples_.add(method.previous(), method.arrived());
  last_.clear();
  model_.record(now, last_);
  if (history_.rows() == 0)
    for (const History::Entry& entry : last_.entries()) history_.add_column(entry.name, entry.unit);
  add_clock(now.time);
  for (const History::Entry& entry : last_.entries()) row_.push_back(entry.value);
  history_.add(row_);
  add_clock(now.time);
  record_energy(energy);
  if (film_every_ > 0.0 && !films_.empty() && now.time >= next_film_) {
    add_clock(now.time);
    film_clock_.add(row_);
    for (FilmStream& film : films_) film.add();
    while (next_film_ <= now.time) next_film_ += film_every_;
  }
  for (ComponentFields& fields : fields_) fields.record(now);
}

// Appends to the clock in row_.
void Recorder::record_energy(const EnergyBalance& energy) {
  if (energy_.rows() == 0) {
    for (const char* name : {"kinetic", "strain", "element", "input", "lost", "imbalance"})
      energy_.add_column(name, "J");
    for (const std::string& name : energy.terms()) energy_.add_column("terms/" + name, "J");
  }
  const EnergyState& e = energy.now();
  row_.insert(row_.end(), {e.kinetic, e.strain, e.element, e.input, e.lost, energy.imbalance()});
  row_.insert(row_.end(), e.terms.begin(), e.terms.end());
  energy_.add(row_);
}

void Recorder::finish() {
  samples_.finish();
  write_held();
}

void Recorder::archive(Archive& archive) {
  write_held();
  samples_.archive(archive);
  archive(next_film_);
  for (FilmStream& film : films_) film.archive(archive);
  for (ComponentFields& fields : fields_) fields.archive(archive);
}

void Recorder::write_held() {
  history_.finish();
  energy_.finish();
  if (film_clock_.rows() > 0) film_clock_.finish();
  for (FilmStream& film : films_) film.finish();
  for (ComponentFields& fields : fields_) fields.finish();
}

int64_t Recorder::held() const {
  int64_t sum = samples_.held() + history_.held() + energy_.held() + film_clock_.held();
  for (const FilmStream& film : films_) sum += film.held();
  for (const ComponentFields& fields : fields_) sum += fields.held();
  return sum;
}

}  // namespace clatter::dynamics
