// SPDX-License-Identifier: GPL-3.0-or-later
// Stresses of a static solution as text.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/base/error.hpp"
#include "modal/number_list.hpp"
#include "modal/statics.hpp"

namespace clatter::modal {
namespace {

int32_t nearest_node(const fe::FeModel& model, const Eigen::Vector3d& position) {
  Eigen::Index node = 0;
  (model.nodes.rowwise() - position.transpose()).rowwise().squaredNorm().minCoeff(&node);
  return static_cast<int32_t>(node);
}

std::optional<int32_t> node_labelled(const fe::FeModel& model, double label) {
  for (int32_t a = 0; a < model.nodes.rows(); ++a)
    if (model.cells.label(a) == label) return a;
  return std::nullopt;
}

std::set<int32_t> nodes_of(const fe::FeModel& model, const std::string& location) {
  const std::vector<double> numbers = numbers_in(location);
  if (numbers.size() == 3) return {nearest_node(model, Eigen::Vector3d(numbers.data()))};
  if (numbers.size() == 1)
    if (const auto node = node_labelled(model, numbers[0])) return {*node};
  std::vector<std::string> sensors;
  for (const auto& [name, set] : model.sets) {
    if (set.kind != "sensor") continue;
    sensors.push_back(name);
    if (name != location) continue;
    std::set<int32_t> nodes;
    for (Eigen::Index k = 0; k < set.position.rows(); ++k)
      nodes.insert(nearest_node(model, set.position.row(k).transpose()));
    return nodes;
  }
  throw InputError(fmt::format(
      "{}: --stress-at: found \"{}\", expected a node number, a position x,y,z in metres{}{}",
      model.name, location, sensors.empty() ? "" : ", or one of: ", fmt::join(sensors, ", ")));
}

std::string place_of(const fe::FeModel& model, int32_t node) {
  return fmt::format("node {} at ({:.4f}, {:.4f}, {:.4f}) m", model.cells.label(node),
                     model.nodes(node, 0), model.nodes(node, 1), model.nodes(node, 2));
}

}  // namespace

NodeStress largest_stress(const StaticCase& solved) {
  NodeStress out;
  out.von_mises = -1.0;
  for (const fe::RegionStress& region : solved.stress) {
    if (region.nodes.empty()) continue;
    Eigen::Index row = 0;
    if (const double most = region.von_mises.maxCoeff(&row); most > out.von_mises)
      out = {region.name, region.nodes[row], region.stress.row(row).transpose(), most};
  }
  return out;
}

std::string describe_largest_stress(const fe::FeModel& model, const StaticCase& solved) {
  const NodeStress most = largest_stress(solved);
  return fmt::format("  largest von Mises stress {:.6g} Pa in {}, {}", most.von_mises, most.region,
                     place_of(model, most.node));
}

std::vector<int32_t> nodes_at(const fe::FeModel& model, const std::vector<std::string>& locations) {
  if (!locations.empty() && model.cells.regions.empty())
    throw InputError(fmt::format(
        "{}: --stress-at: found a model without cells, expected one of clatter-assembly",
        model.name));
  std::vector<int32_t> nodes;
  for (const std::string& location : locations)
    for (const int32_t node : nodes_of(model, location)) nodes.push_back(node);
  return nodes;
}

std::vector<std::string> describe_stress(const fe::FeModel& model, const StaticCase& solved,
                                         int32_t node) {
  std::vector<std::string> lines;
  for (const fe::RegionStress& region : solved.stress) {
    const std::vector<int32_t>& nodes = region.nodes;
    const auto found = std::lower_bound(nodes.begin(), nodes.end(), node);
    if (found == nodes.end() || *found != node) continue;
    const Eigen::Index row = found - nodes.begin();
    const auto s = region.stress.row(row);
    lines.push_back(fmt::format(
        "{}: {}, {}: xx {:.6g} yy {:.6g} zz {:.6g} xy {:.6g} yz {:.6g} zx {:.6g}, von Mises "
        "{:.6g} Pa",
        solved.name, place_of(model, node), region.name, s(0), s(1), s(2), s(3), s(4), s(5),
        region.von_mises(row)));
  }
  return lines;
}

}  // namespace clatter::modal
