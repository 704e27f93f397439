// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/mirrored.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

namespace clatter::dynamics::testing {
namespace {

/// The strip of the grid that the mirror puts in the place of `strip`.
int opposite(const rom::ContactGrid& grid, int strip) {
  for (int other = 0; other < grid.angle.size(); ++other) {
    const double turns =  // angle 0 is at +y
        (grid.angle(strip) + grid.angle(other) - std::numbers::pi) / (2.0 * std::numbers::pi);
    if (std::abs(turns - std::round(turns)) < 1e-9) return other;
  }
  return -1;
}

void exchange_patches(const rom::ReducedModel& model, const std::string& name, Mirror& mirror) {
  const rom::ContactGrid& grid = model.grid(name);
  const std::vector<int32_t>& dofs = model.set(name).dofs;
  const auto rows = static_cast<int>(grid.axial.size());
  for (int i = 0; i < grid.angle.size(); ++i) {
    const int j = opposite(grid, i);
    for (int row = 0; row < rows; ++row) mirror.place[dofs[i * rows + row]] = dofs[j * rows + row];
  }
}

void mirror_positions(const std::vector<int>& place, rom::DofSet& set) {
  const Eigen::MatrixXd from = set.position;
  for (size_t i = 0; i < set.dofs.size(); ++i) {
    const int target = place[set.dofs[i]];
    for (size_t j = 0; j < set.dofs.size(); ++j) {
      if (set.dofs[j] != target) continue;
      const auto to = static_cast<Eigen::Index>(j);
      set.position.row(to) = from.row(static_cast<Eigen::Index>(i));
      set.position(to, 1) *= -1.0;
    }
  }
}

}  // namespace

rom::ReducedModel mirrored(const rom::ReducedModel& model, Mirror& mirror) {
  const int r = model.size();
  mirror.place.resize(r);
  std::iota(mirror.place.begin(), mirror.place.end(), 0);
  mirror.sign.assign(r, 1.0);
  rom::ReducedModel image = model;
  for (auto& [name, set] : image.sets) {
    if (model.grids.contains(name)) {
      exchange_patches(model, name, mirror);
    } else {
      for (size_t i = 0; i < set.dofs.size(); ++i) {
        const bool along_y = std::abs(set.direction(static_cast<Eigen::Index>(i), 1)) > 0.5;
        const bool changes = along_y != (set.is_rotation[i] == 1);
        if (changes) mirror.sign[set.dofs[i]] = -1.0;
      }
    }
    mirror_positions(mirror.place, set);
  }
  for (auto& [name, grid] : image.grids) grid.axis_point.y() *= -1.0;
  Eigen::MatrixXd map = Eigen::MatrixXd::Zero(r, r);  // q' = map q
  for (int k = 0; k < r; ++k) map(mirror.place[k], k) = mirror.sign[k];
  image.M_rr = map * model.M_rr * map.transpose();
  image.K_rr = map * model.K_rr * map.transpose();
  const Eigen::Vector<double, 6> motions(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  image.rigid = map * model.rigid * motions.asDiagonal();
  for (auto& [name, load] : image.loads) load = map * load;
  return image;
}

}  // namespace clatter::dynamics::testing
