// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/cam_torque_component.hpp"

#include "dynamics/shaft/shaft_catalogue.hpp"

namespace clatter::dynamics {

CamLaw make_cam_law(const CamLawSpec& spec) {
  if (spec.kind == CamLawSpec::Kind::kPolynomial)
    return CamLaw::polynomial(spec.lift, spec.half_angle);
  return read_cam_table(spec.file, spec.column, spec.degree);
}

const Keys<CamTorqueTable>& cam_torque_keys() {
  using Kind = CamLawSpec::Kind;
  static const Keys<CamTorqueTable> keys(
      "cam_torque", "the torque of valves on their cams, quasi-static",
      [](auto& key, CamTorqueTable& torque) {
        name_row(key, torque.name);
        turn_body_rows(key, torque.bodies);
        key.choice("law", torque.law.kind,
                   {{"polynomial", Kind::kPolynomial}, {"table", Kind::kTable}},
                   "lift of the valve over the angle of the cam");
        cam_law_rows(key, torque.law, "table");
        key.numbers("lobes_deg", torque.lobes, kAngleDeg,
                    "angle of the body at the law's angle 0, of each lobe")
            .required();
        key.integer("valves", torque.valves, Range::between(1.0, 64.0), "valves of a lobe");
        key.number("spring_force_n", torque.force, Range::between(1e-6, 1e9),
                   "of a valve's spring at lift 0")
            .required();
        key.number("spring_stiffness_n_m", torque.stiffness, Range::between(0.0, 1e12),
                   "of a valve's spring");
        key.number("mass_kg", torque.mass, Range::between(0.0, 1e6), "reduced to a valve");
      });
  return keys;
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
  for (const CamTorqueTable& one : read_elements(root, "cam_torque", cam_torque_keys()))
    torques.push_back({one.name, one.bodies,
                       CamTrain{make_cam_law(one.law), one.lobes, static_cast<double>(one.valves),
                                one.force, one.stiffness, one.mass},
                       one.law.file});
  return {std::make_shared<CamTorqueComponent>(std::move(torques))};
}

}  // namespace clatter::dynamics
