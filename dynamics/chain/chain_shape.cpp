// SPDX-License-Identifier: GPL-3.0-or-later
// The shape of a chain and of what it runs over, in the run file.
#include <cmath>
#include <numbers>

#include "core/run/run_layout.hpp"
#include "dynamics/chain/chain_component.hpp"
#include "dynamics/component/field_stream.hpp"

namespace clatter::dynamics {
namespace {

constexpr int kGapPoints = 32;     // of the outline of a tooth gap
constexpr int kGuidePoints = 256;  // of a guide

/// The profile as a polyline in its own axes, m x 2 [m].
RowMatrix outline(const Profile& profile) {
  const int points = profile.repeats() > 1 ? kGapPoints * profile.repeats() : kGuidePoints;
  const double between = profile.length() / points;
  RowMatrix line(points + 1, 2);
  for (int k = 0; k < points; ++k) line.row(k) = profile.at(k * between).position;
  // at() takes the end of a closed profile as its beginning.
  line.row(points) = profile.at(profile.length()).position;
  return line;
}

double within_half_turn(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

}  // namespace

FieldPlan ChainComponent::field_plan() const {
  const std::optional<double>& given =
      spec_.shape_every_deg ? spec_.shape_every_deg : spec_.shape_every;
  if (given && *given == 0.0) return {};
  return {run::path("chain", spec_.name), shape_every_, ChainSpec::kShapes};
}

void ChainComponent::write_outlines(H5File& file) const {
  const std::string group = run::path("chain", spec_.name);
  static constexpr const char* kPlanes[] = {"yz", "zx", "xy"};
  file.set(group, "plane", kPlanes[spec_.normal]);
  file.set(group, "bush_radius", spec_.bush_radius);
  file.set(group, "plate_half_height", spec_.half_height);
  std::vector<int32_t> inner;
  for (const LinkKind kind : spec_.make.kinds) inner.push_back(kind == LinkKind::kInner ? 1 : 0);
  file.write(run::path(group, "inner"), inner);
  file.write(run::path(group, "pitch"), spec_.make.pitches);
  for (size_t i = 0; i < spec_.over.size(); ++i) {
    const ChainOver& over = spec_.over[i];
    const std::string place = run::path(group, "over/" + over.name);
    file.set(place, "order", static_cast<int64_t>(i));
    file.set(place, "teeth", over.teeth);
    file.set(place, "turn", over.turn == Turn::kClockwise ? "clockwise" : "counter-clockwise");
    file.write(run::path(place, "outline"), outline(contacts_[i]->profile()));
  }
}

void ChainComponent::record_fields(const StageState& state, FieldStream& fields) const {
  const std::string group = run::path("chain", spec_.name);
  const int n = spec_.make.links();
  Eigen::VectorXd x(n), y(n), angle(n), tension(n);
  for (int j = 0; j < n; ++j) {
    const auto at = static_cast<size_t>(j);
    x(j) = state.y(y_[3 * at]);
    y(j) = state.y(y_[3 * at + 1]);
    angle(j) = within_half_turn(state.y(y_[3 * at + 2]));
    tension(j) = joints_->tensions()[at];
  }
  fields.add(run::path(group, "x"), x);
  fields.add(run::path(group, "y"), y);
  fields.add(run::path(group, "angle"), angle);
  fields.add(run::path(group, "tension"), tension);
  for (size_t i = 0; i < contacts_.size(); ++i)
    fields.add(run::path(group, "over/" + spec_.over[i].name + "/place"),
               Eigen::VectorXd(contacts_[i]->place(state.time, state.y, state.v_y)));
}

}  // namespace clatter::dynamics
