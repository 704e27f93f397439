// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/force_record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/base/error.hpp"
#include "core/run/run_layout.hpp"

namespace clatter::dynamics {
namespace {

int body_index(const LoadedBodies& bodies, const ForceRecordSpec& spec) {
  std::vector<std::string> names;
  for (size_t i = 0; i < bodies.size(); ++i) {
    const LoadedBody& body = bodies[i];
    if (body.spec.motion != BodyMotion::kGiven) continue;
    if (body.spec.name == spec.body) return static_cast<int>(i);
    names.push_back(body.spec.name);
  }
  throw InputError(
      fmt::format("{}: body: found \"{}\", expected a reduced part whose frame is given: {}",
                  spec.where, spec.body, fmt::join(names, ", ")));
}

bool is_listed(const ForceRecordSpec& spec, const std::string& name) {
  return std::find(spec.of.begin(), spec.of.end(), name) != spec.of.end();
}

}  // namespace

ForceRecord::ForceRecord(Model& model, const LoadedBodies& bodies, const ForceRecordSpec& spec,
                         const Tableau& method, H5File& file, double begin, double end, double step)
    : model_(model),
      method_(method),
      file_(file),
      body_(body_index(bodies, spec)),
      dataset_(run::path(run::path(run::kForces, spec.body), spec.name)),
      stages_(static_cast<size_t>(method.stages) + 1),
      samples_(begin, end, step, model.system.bodies()[body_].modes(),
               [this](const SampleBlock& block) { write(block); }) {
  const LoadedBody& body = bodies[body_];
  to_reduced_ = body.model.M_rr * body.sampled;
  find(spec);
  model.system.keep_forces();
}

void ForceRecord::find(const ForceRecordSpec& spec) {
  const System& system = model_.system;
  const std::vector<int>& rows = system.rows(body_);
  std::set<std::string> known, found;
  const auto is_wanted = [&](const std::string& name) {
    known.insert(name);
    if (is_listed(spec, name)) found.insert(name);
    return is_listed(spec, name);
  };
  for (int e = 0; e < system.elements(); ++e) {
    Part part{e, {}, {}};
    const std::vector<int>& coordinates = system.element(e).coordinates();
    for (size_t i = 0; i < coordinates.size(); ++i) {
      if (system.owner(coordinates[i]) != body_) continue;
      part.place.push_back(static_cast<int>(i));
      const auto row = std::find(rows.begin(), rows.end(), coordinates[i]);
      part.row.push_back(static_cast<int>(row - rows.begin()));
    }
    if (!part.row.empty() && is_wanted(system.element(e).name())) parts_.push_back(std::move(part));
  }
  for (size_t l = 0; l < system.loads().size(); ++l)
    if (system.loads()[l].body == body_ && is_wanted(system.loads()[l].term))
      loads_.push_back(static_cast<int>(l));
  for (const std::string& name : spec.of)
    if (found.count(name) == 0)
      throw InputError(fmt::format("{}: of: found \"{}\", expected forces on {}: {}", spec.where,
                                   name, spec.body, fmt::join(known, ", ")));
}

Eigen::VectorXd ForceRecord::force(double time) const {
  const System& system = model_.system;
  const Eigen::MatrixXd& P = system.P(body_);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(P.cols());
  for (const Part& part : parts_) {
    const Eigen::VectorXd& f = system.passed_force(part.element);
    if (f.size() == 0) continue;  // before the first evaluation
    for (size_t i = 0; i < part.row.size(); ++i)
      sum += f(part.place[i]) * P.row(part.row[i]).transpose();
  }
  for (const int l : loads_) {
    const Load& load = system.loads()[l];
    sum += load.value(time) * load.direction;
  }
  return sum;
}

void ForceRecord::stage(int index, const StageState& state) {
  stages_[index] = force(state.time);
  time_ = state.time;
}

void ForceRecord::start(double time) {
  now_.time = time_ = time;
  now_.eta = now_.v = now_.a = Eigen::VectorXd::Zero(to_reduced_.cols());
  samples_.start(now_);
}

void ForceRecord::accept(double dt) {
  if (stages_[0].size() == 0) now_.a = stages_[0] = stages_[1];
  before_ = now_;
  for (int i = 0; i <= method_.stages; ++i) {
    const double weight = dt * method_.b[i];
    if (weight != 0.0) now_.v += weight * stages_[i];
  }
  stages_[0] = stages_[method_.stages];
  now_.a = stages_[0];
  now_.time = time_;
  samples_.add(before_, now_);
}

void ForceRecord::archive(Archive& archive) {
  samples_.archive(archive);
  archive(stages_[0]);
  archive(time_);
  archive(now_.time);
  archive(now_.eta);
  archive(now_.v);
  archive(now_.a);
}

void ForceRecord::write(const SampleBlock& block) {
  file_.append(dataset_, RowMatrix(block.a.topRows(block.count) * to_reduced_.transpose()));
  if (block.first == 0) file_.set(dataset_, "unit", "N");
}

void ForceRecords::stage(int index, const StageState& state) {
  next_.stage(index, state);
  for (const auto& record : records_) record->stage(index, state);
}

void ForceRecords::accept(double dt) {
  next_.accept(dt);
  for (const auto& record : records_) record->accept(dt);
}

void ForceRecords::start(double time) {
  for (const auto& record : records_) record->start(time);
}

void ForceRecords::finish() {
  for (const auto& record : records_) record->finish();
}

void ForceRecords::archive(Archive& archive) {
  for (const auto& record : records_) record->archive(archive);
}

int64_t ForceRecords::held() const {
  int64_t sum = 0;
  for (const auto& record : records_) sum += record->held();
  return sum;
}

}  // namespace clatter::dynamics
