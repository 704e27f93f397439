// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[load]]: known forces on bodies.
#include <optional>
#include <utility>

#include "core/keys/keys.hpp"
#include "dynamics/component/component.hpp"
#include "dynamics/component/run_time.hpp"
#include "dynamics/given/spline.hpp"

namespace clatter::dynamics {

/// A force on a body: a unit load of its reduced model, one coordinate of a set of it, or a
/// component at the centre of a rigid body.
struct LoadSpec {
  std::string body, where;
  std::string load;             // name among the model's loads, or:
  std::string set;              // a set of the model
  int component = 0;            // 0..5: x, y, z, rx, ry, rz
  std::optional<double> value;  // instead of a table
  double scale = 1.0;           // of the table; or `value`
  std::filesystem::path table;  // over time [s], or over the crank angle in an engine scene
  std::string column, unit;
  Spline::Kind interpolation = Spline::Kind::kLinear;
};
const keys::Keys<LoadSpec>& load_keys();

/// All loads of a scene, which grow over the ramp of the start.
class LoadComponent : public Component {
 public:
  explicit LoadComponent(std::vector<LoadSpec> loads) : loads_(std::move(loads)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<LoadComponent>(*this);
  }
  std::vector<std::filesystem::path> inputs() const override;
  /// InputError for bodies, unit loads and sets that do not exist.
  void add_loads(ModelBuilder& model) override;

 private:
  std::vector<LoadSpec> loads_;
};

ComponentList read_loads(const Config& root);

}  // namespace clatter::dynamics
