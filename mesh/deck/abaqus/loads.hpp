// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// *CLOAD, *DLOAD, *DSLOAD, *TEMPERATURE: the active loads, step by step. A load that a step
// redefines replaces that of earlier steps (OP=MOD) or all of its kind (OP=NEW); within one step
// loads on the same node or face add up, as in CalculiX.
#include <array>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/deck/abaqus/supports.hpp"

namespace clatter::mesh::deck::abaqus {

class Loads {
 public:
  explicit Loads(Model& model) : model_(&model) {}

  void read_forces(size_t use, const Card& card, StepNumber step);         // *CLOAD
  void read_element_loads(size_t use, const Card& card, StepNumber step);  // *DLOAD
  void read_pressures(size_t use, const Card& card, StepNumber step);      // *DSLOAD
  void read_temperatures(size_t use, const Card& card, StepNumber step);   // *TEMPERATURE

  bool empty() const;
  /// Writes all active loads into `out`, with the surfaces and fields of the mesh that they need.
  /// InputError where gravity or a force per volume acts on some elements only.
  void list(Step& out, StepNumber step);

 private:
  struct Value {
    double value = 0.0;
    StepNumber step = 0;
    const std::string* system = nullptr;
  };
  struct Gravity {
    std::vector<int> times;  // by element: the same load twice acts twice
    StepNumber step = 0;
    Origin origin = 0;
  };
  using Vector = std::array<double, 3>;
  // One line of CENTRIF: the same axis and cells again replace it.
  struct Rotation {
    Step::Rotation what;
    std::vector<bool> covered;  // by element
    StepNumber step = 0;
    Origin origin = 0;
  };

  double begin(const Card& card);
  void add_gravity(size_t use, const Fields& fields, double factor, StepNumber step);
  void add_force_per_volume(size_t use, const Fields& fields, int direction, double factor,
                            StepNumber step);
  void add_acceleration(size_t use, const Fields& fields, const Eigen::Vector3d& a,
                        StepNumber step);
  void read_element_load(size_t use, const Fields& fields, double factor, StepNumber step);
  void add_shell_pressure(size_t use, const Fields& fields, double factor, StepNumber step);
  std::vector<bool> covered_by(size_t use, const Fields& fields) const;
  void add_rotation(size_t use, const Fields& fields, double factor, StepNumber step);
  void list_pressures(Step& out);
  void list_rotations(Step& out) const;
  void list_gravity(Step& out) const;
  bool has_mass(int32_t element) const;
  std::vector<Rotation> united_rotations() const;
  void list_temperature(Step& out, StepNumber step);
  std::vector<double> initial_field() const;

  Model* model_;
  std::map<std::pair<NodeIndex, int>, Value> forces_;
  std::map<CellFaceId, Value> faces_;
  std::map<std::string, Value> surfaces_;
  std::map<Vector, Gravity> gravity_;
  std::vector<Rotation> rotations_;
  std::vector<double> temperature_;  // by row; empty: none given
  std::map<std::vector<CellFaceId>, std::string> made_surfaces_;
};

}  // namespace clatter::mesh::deck::abaqus
