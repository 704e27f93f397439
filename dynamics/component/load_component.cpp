// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/load_component.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "dynamics/body/spatial_frame.hpp"
#include "dynamics/component/component_keys.hpp"
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
  const std::string component(kComponents[load.component]);
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

/// The body of the system on which a load acts: a disc or journal may be a part of one.
int body_of(const ModelBuilder& model, const LoadSpec& load) {
  if (model.has_body(load.body)) return model.body(load.body);
  if (const TurningBody* part = model.find_turn(load.body)) return part->body;
  throw InputError(
      fmt::format("{}: load.body: no body \"{}\" in the scene", load.where, load.body));
}

}  // namespace

const Keys<LoadSpec>& load_keys() {
  static const Keys<LoadSpec> keys(
      "load", "a known force over time or crank angle", [](auto& key, LoadSpec& load) {
        const Range factor = Range::between(-1e15, 1e15);
        key.where(load.where);
        key.text("body", load.body,
                 "the body on which it acts; of a shaft a disc or bearing, as cam.wheel")
            .required();
        key.text("load", load.load, "unit load of the body's reduced model");
        const char* has_all = "a unit load has points and directions";
        key.text("set", load.set,
                 "set of the reduced model on which it acts, of one node; of a "
                 "rigid body its centre of mass without it")
            .excludes("load", has_all);
        key.choice("component", load.component,
                   {{"x", 0}, {"y", 1}, {"z", 2}, {"rx", 3}, {"ry", 4}, {"rz", 5}},
                   "force along, or moment about an axis")
            .excludes("load", has_all);
        key.number("value", load.value, factor,
                   "constant force, moment, or factor of the unit load")
            .shown_in("SI");
        key.path("table", load.table,
                 "CSV of it over time, with an engine or cycle_of over the crank angle");
        key.one_of({"value", "table"});
        key.all_need("table", {}, "", [&] {
          key.text("column", load.column, "column of the table; without it the second one");
          key.text("unit", load.unit, "unit of the column; N, of moments N m without it");
          interpolation_row(key, load.interpolation);
          key.number("scale", load.scale, factor, "factor of the table");
        });
        key.check([](const Config& table, LoadSpec& found) {
          if (found.value) found.scale = *found.value;
          if (!found.table.empty() && found.unit.empty())
            found.unit = table.text_or("unit", found.component < 3 ? "N" : "N m");
        });
      });
  return keys;
}

std::vector<std::filesystem::path> LoadComponent::inputs() const {
  std::vector<std::filesystem::path> tables;
  for (const LoadSpec& load : loads_)
    if (!load.table.empty()) tables.push_back(load.table);
  return tables;
}

void LoadComponent::add_loads(ModelBuilder& model) {
  int count = 0;
  for (const LoadSpec& load : loads_) {
    const int body = body_of(model, load);
    const LoadedBody* loaded = find_body(model.loaded, load.body);
    const Eigen::VectorXd modal = loaded != nullptr && !loaded->shapes
                                      ? modal_force(*loaded, load)
                                      : force_at_centre(model.system.bodies()[body], load);
    LoadInTime in_time = load_in_time(model, load);
    model.system.add_load({fmt::format("load {} on {}", ++count, load.body), body, modal,
                           ramped(model.time, std::move(in_time.value)),
                           std::move(in_time.next_row)});
  }
}

ComponentList read_loads(const Config& root) {
  std::vector<LoadSpec> loads;
  for (const Config& table : root.tables("load")) loads.push_back(load_keys().read(table));
  return {std::make_shared<LoadComponent>(std::move(loads))};
}

}  // namespace clatter::dynamics
