// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/load_component.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/force/spatial_frame.hpp"
#include "dynamics/given/load_table.hpp"

namespace clatter::dynamics {
namespace {

constexpr std::string_view kComponents[] = {"x", "y", "z", "rx", "ry", "rz"};

/// A [[load]] over time, without the ramp of the start.
struct LoadInTime {
  TimeFunction value, next_row;
};

LoadInTime load_in_time(const ModelBuilder& model, const LoadSpec& load) {
  if (load.table.empty()) return {[value = load.scale](double) { return value; }, {}};
  if (model.clock) {
    const auto table = read_cycle_table(load.table, load.column, load.unit, load.interpolation);
    return {[table, scale = load.scale, clock = *model.clock](double t) {
              return scale * table(clock.angle(t));
            },
            rows_in_time(
                table, [clock = *model.clock](double t) { return clock.angle(t); },
                [clock = *model.clock](double angle) { return clock.time(angle); })};
  }
  const auto table = read_time_table(load.table, load.column, load.unit, load.interpolation,
                                     model.time.begin, model.time.end);
  return {[table, scale = load.scale](double t) { return scale * table(t); },
          [table](double t) { return table.next_point(t); }};
}

/// On a body with a reduced model.
Eigen::VectorXd modal_force(const LoadedBody& body, const LoadSpec& load) {
  if (!load.load.empty()) return body.modal.shapes.transpose() * unit_load(body.model, load.load);
  if (load.set.empty())
    throw InputError(
        fmt::format("{}: load.set: found nothing, expected a set of the reduced model "
                    "of \"{}\"",
                    load.where, load.body));
  const int dof = with_context(load.where + ": load.set", [&] {
    return set_dof(body.model, load.set, load.component % 3, load.component >= 3);
  });
  return body.modal.row_of(dof).transpose();
}

/// At the centre of mass of a body with large motion: unit forces and moments move one of its
/// coordinates.
Eigen::VectorXd force_at_centre(const ModalBody& body, const LoadSpec& load) {
  const std::string component(kComponents[static_cast<size_t>(load.component)]);
  if (!load.load.empty() || !load.set.empty())
    throw InputError(fmt::format(
        "{}: load.{}: \"{}\" {}, expected component only, at its centre of mass", load.where,
        load.load.empty() ? "set" : "load", load.body,
        body.frame && body.frame->modes() > 0 ? "moves in space" : "has no reduced model"));
  Eigen::Index moved = 0;
  const double size = body.rigid.col(load.component).cwiseAbs().maxCoeff(&moved);
  if (size == 0.0)
    throw InputError(
        fmt::format("{}: load.component: found \"{}\", expected one that \"{}\" "
                    "follows as a single coordinate",
                    load.where, component, load.body));
  // A coordinate along an oblique axis gets the component of the force along it.
  return body.shapes(moved, moved) * body.rigid(moved, load.component) *
         body.shapes.row(moved).transpose();
}

LoadSpec read_load(const Config& table) {
  const Range factor = Range::between(-1e15, 1e15);
  LoadSpec load;
  load.where = table.where();
  load.body = table.text("body");
  if (table.has("load")) {
    load.load = table.text("load");
  } else {
    if (table.has("set")) load.set = table.text("set");
    const auto name = table.choice("component", {"x", "y", "z", "rx", "ry", "rz"});
    load.component = static_cast<int>(
        std::find(std::begin(kComponents), std::end(kComponents), name) - std::begin(kComponents));
  }
  if (table.has("table")) {
    load.table = table.path("table");
    load.column = table.text_or("column", "");
    load.unit = table.text_or("unit", load.component < 3 ? "N" : "N m");
    load.interpolation = read_interpolation(table, "linear");
    load.scale = table.number_or("scale", 1.0, factor);
  } else {
    load.scale = table.number("value", factor);
  }
  return load;
}

}  // namespace

std::vector<std::filesystem::path> LoadComponent::inputs() const {
  std::vector<std::filesystem::path> tables;
  for (const LoadSpec& load : loads_)
    if (!load.table.empty()) tables.push_back(load.table);
  return tables;
}

void LoadComponent::add_loads(ModelBuilder& model) {
  int count = 0;
  for (const LoadSpec& load : loads_) {
    if (!model.has_body(load.body)) {
      throw InputError(
          fmt::format("{}: load.body: no body \"{}\" in the scene", load.where, load.body));
    }
    const int body = model.body(load.body);
    const LoadedBody* loaded = find_body(model.loaded, load.body);
    const Eigen::VectorXd modal =
        loaded != nullptr && !loaded->shapes
            ? modal_force(*loaded, load)
            : force_at_centre(model.system.bodies()[static_cast<size_t>(body)], load);
    LoadInTime in_time = load_in_time(model, load);
    model.system.add_load({fmt::format("load {} on {}", ++count, load.body), body, modal,
                           ramped(model.time, std::move(in_time.value)),
                           std::move(in_time.next_row)});
  }
}

ComponentList read_loads(const Config& root) {
  std::vector<LoadSpec> loads;
  for (const Config& table : root.tables("load")) loads.push_back(read_load(table));
  return {std::make_shared<LoadComponent>(std::move(loads))};
}

}  // namespace clatter::dynamics
