// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[cam_torque]]: the torque of valves on their cams, quasi-static.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/component/component.hpp"
#include "dynamics/shaft/torque_component.hpp"

namespace clatter::dynamics {

/// A cam law as its keys say.
struct CamLawSpec {
  enum class Kind : char { kPolynomial, kTable, kRadius };
  Kind kind = Kind::kPolynomial;
  double lift = 0.0, half_angle = 0.0;  // of a polynomial [m], [rad]
  std::filesystem::path file;           // of a table; empty: none
  std::string column;
  int degree = 5;  // of its spline
};
/// The keys of the laws; those of a table need one of the values `by_table` of the key "law".
template <class S>
void cam_law_rows(Keys<S>& key, CamLawSpec& law, const keys::Values& by_table) {
  key.number("lift_mm", law.lift, Range::between(1e-6, 1e4), "full lift of a polynomial")
      .of("law", "polynomial");
  key.number("half_angle_deg", law.half_angle, Range::between(1e-3, 180.0),
             "from full lift to the end of a polynomial, of the cam")
      .of("law", "polynomial");
  key.path("table", law.file, "CSV over the angle of the cam, one turn").of("law", by_table);
  key.text("column", law.column, "column of the table; without it the second one").needs("table");
  key.choice("spline", law.degree, {{"quintic", 5}, {"cubic", 3}}, "between the rows of the table")
      .needs("table");
}
/// A polynomial, or a table of the lift.
CamLaw make_cam_law(const CamLawSpec& spec);

/// The keys of one [[cam_torque]].
struct CamTorqueTable {
  std::string name;
  TurnBodies bodies;
  CamLawSpec law;
  std::vector<double> lobes;                        // [rad]
  int valves = 1;                                   // of each
  double force = 0.0, stiffness = 0.0, mass = 0.0;  // [N], [N/m], [kg]
};
const Keys<CamTorqueTable>& cam_torque_keys();

/// One [[cam_torque]].
struct CamTorqueSpec {
  std::string name;  // "cam_torque 1", or with its own name
  TurnBodies bodies;
  CamTrain train;
  std::filesystem::path file;  // of the lift table; empty: the polynomial law
};

/// All cam torques of a scene, which grow over the ramp of the start.
class CamTorqueComponent : public Component {
 public:
  explicit CamTorqueComponent(std::vector<CamTorqueSpec> torques) : torques_(std::move(torques)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<CamTorqueComponent>(*this);
  }
  std::vector<std::filesystem::path> inputs() const override;
  void add_elements(ModelBuilder& model) override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;

 private:
  std::vector<CamTorqueSpec> torques_;
};

ComponentList read_cam_torques(const Config& root);

}  // namespace clatter::dynamics
