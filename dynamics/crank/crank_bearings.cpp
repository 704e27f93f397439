// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/crank/crank_bearings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/bearing/bearing_laws.hpp"
#include "dynamics/bearing/film_bearing.hpp"
#include "dynamics/body/crank_port.hpp"
#include "dynamics/component/law_table.hpp"
#include "dynamics/element/pair_element.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kBesideAxis = 1e-3;  // [m]: a set may be so far beside the axis
constexpr ShaftAxes kAxes{0};

/// A bearing's housing: port, and its position at rest.
struct Housing {
  std::unique_ptr<Port> port;
  Eigen::Vector3d position;
  int lateral[2] = {-1, -1};
};

Housing housing_on_block(const CrankBearingSpec& bearing, const LoadedBody& block,
                         ModelBuilder& model) {
  System& system = model.system;
  const int body = model.body("block");
  const Node node = with_context(bearing.where + ": crank.bearing.set",
                                 [&] { return node_of(block.model, bearing.set); });
  std::vector<int> coordinates;
  for (const int dof : node.dofs) coordinates.push_back(system.coordinate(body, dof));
  for (int k = static_cast<int>(coordinates.size()); k < 6; ++k)
    coordinates.push_back(system.frame_coordinate(body, k));
  return {std::make_unique<NodePort>(node.position, coordinates),
          node.position,
          {coordinates[1], coordinates[2]}};
}

std::unique_ptr<PairLaw> bearing_law(const CrankBearingSpec& bearing, const BearingPlace& place) {
  if (const auto* linear = std::get_if<LinearBearingSpec>(&bearing.law))
    return std::make_unique<RadialBearing>(
        place, RadialLaw{0.0, linear->stiffness, 0.0, 1.0, linear->damping});
  if (const auto* spec = std::get_if<TableBearingSpec>(&bearing.law)) {
    const RisingTable table = read_rising_table({spec->table, spec->column, "m", "N"});
    return std::make_unique<RadialBearing>(place, RadialTable(table, spec->damping), table.last());
  }
  if (const auto* film = std::get_if<JournalFilmOptions>(&bearing.law))
    return std::make_unique<FilmBearing>(place, *film);
  const auto& impedance = std::get<ImpedanceSpec>(bearing.law);
  return std::make_unique<ImpedanceBearing>(place, BearingFilm(impedance.size, impedance.model));
}

}  // namespace

std::vector<int> crank_coordinates(const CrankBody& crank, ModelBuilder& model) {
  const int body = model.body(CrankBody::kName);
  std::vector<int> coordinates;
  for (const int dof : {CrankBody::kY, CrankBody::kZ, CrankBody::kTiltY, CrankBody::kTiltZ})
    coordinates.push_back(model.system.coordinate(body, dof));
  if (crank.is_free) coordinates.push_back(model.system.coordinate(body, crank.turn()));
  return coordinates;
}

std::vector<BearingOrbit> add_crank_bearings(const CrankSpec& crank, ModelBuilder& model) {
  std::vector<BearingOrbit> orbits;
  const LoadedBody* block = find_body(model.loaded, "block");
  for (const CrankBearingSpec& bearing : crank.bearings) {
    Housing housing;
    if (block != nullptr) {
      housing = housing_on_block(bearing, *block, model);
    } else {
      housing.position = {bearing.at.value_or(0.0), 0.0, 0.0};
      housing.port = std::make_unique<GroundPort>(housing.position);
    }
    const double x = bearing.at.value_or(housing.position.x());
    const double beside = housing.position.tail<2>().norm();
    if (beside > kBesideAxis)
      throw InputError(
          fmt::format("{}: crank.bearing.set: \"{}\" is {:.4g} mm beside the crank's "
                      "axis, y = z = 0, expected on it",
                      bearing.where, bearing.set, beside / kMilli));
    const double arm = x - crank.body.centre;
    auto journal = std::make_unique<CrankPort>(crank_coordinates(crank.body, model), x, arm,
                                               crank.clock, crank.rotation);
    const Eigen::Vector3d offset = Eigen::Vector3d(x, 0.0, 0.0) - housing.position;
    model.system.add_element(std::make_unique<PairElement>(
        fmt::format("bearing {} {}", CrankBody::kName, bearing.name), std::move(journal),
        std::move(housing.port), bearing_law(bearing, {kAxes, offset})));
    orbits.push_back({fmt::format("bearing_{}_{}", CrankBody::kName, bearing.name),
                      arm,
                      {housing.lateral[0], housing.lateral[1]}});
  }
  return orbits;
}

}  // namespace clatter::dynamics
