// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/cam_torque_component.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/shaft/shaft_catalogue.hpp"

namespace clatter::dynamics {
namespace {

std::vector<double> read_lobes(const Config& table) {
  std::vector<double> lobes = table.numbers("lobes_deg");
  if (lobes.empty()) table.fail("lobes_deg", "found no lobe, expected the angle of each");
  for (double& lobe : lobes) {
    if (!(std::abs(lobe) <= 1e6))
      table.fail("lobes_deg", fmt::format("found {:g}, expected at most 1e6 in size", lobe));
    lobe *= kDegree;
  }
  return lobes;
}

CamTorqueSpec read_cam_torque(const Config& table, size_t number) {
  std::filesystem::path file;
  CamTrain train{read_cam_law(table, file),
                 read_lobes(table),
                 static_cast<double>(table.integer_or("valves", 1, Range::between(1, 64))),
                 table.number("spring_force_n", Range::between(1e-6, 1e9)),
                 table.number_or("spring_stiffness_n_m", 0.0, Range::between(0.0, 1e12)),
                 table.number_or("mass_kg", 0.0, Range::between(0.0, 1e6))};
  return {"cam_torque " + (table.has("name") ? read_name(table) : fmt::format("{}", number)),
          read_turn_bodies(table), std::move(train), file};
}

}  // namespace

CamLaw read_cam_law(const Config& table, std::filesystem::path& file) {
  if (table.choice("law", {"polynomial", "table"}) == "polynomial") {
    const double lift = table.number("lift_mm", Range::between(1e-6, 1e4)) * kMilli;
    return CamLaw::polynomial(
        lift, table.number("half_angle_deg", Range::between(1e-3, 180.0)) * kDegree);
  }
  file = table.path("table");
  const int degree = table.choice("spline", {"quintic", "cubic"}) == "cubic" ? 3 : 5;
  return read_cam_table(file, table.text_or("column", ""), degree);
}

std::vector<std::filesystem::path> CamTorqueComponent::inputs() const {
  std::vector<std::filesystem::path> tables;
  for (const CamTorqueSpec& torque : torques_)
    if (!torque.file.empty()) tables.push_back(torque.file);
  return tables;
}

void CamTorqueComponent::add_elements(ModelBuilder& model) {
  for (const CamTorqueSpec& torque : torques_) {
    const TurnAngles at = angles_of(torque.bodies, model);
    model.system.add_element(
        std::make_unique<CamTorque>(torque.name, at.angle, at.reaction, torque.train,
                                    ramped(model.time, [](double) { return 1.0; })));
  }
}

void CamTorqueComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  if (torques_.empty()) return;
  effects.add(find_effect(kShaftEffects, "cam torque"), true,
              "[[cam_torque]]: springs and inertia, quasi-static", "cam_torque");
}

ComponentList read_cam_torques(const Config& root) {
  std::vector<CamTorqueSpec> torques;
  for (const Config& table : root.tables("cam_torque"))
    torques.push_back(read_cam_torque(table, torques.size() + 1));
  return {std::make_shared<CamTorqueComponent>(std::move(torques))};
}

}  // namespace clatter::dynamics
