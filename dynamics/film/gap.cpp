// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/gap.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"

namespace clatter::film {
namespace {

double table_value(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (at <= x.front()) return y.front();
  if (at >= x.back()) return y.back();
  size_t k = 1;
  while (x[k] < at) ++k;
  return y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1]);
}

// 1 at the end `end`, 0 at the apex; an apex beyond the end makes that side straight.
double parabola(double z, double apex, double end) {
  if ((end - apex) * (z - apex) <= 0.0) return 0.0;
  const double t = (z - apex) / (end - apex);
  return t * t;
}

}  // namespace

Eigen::Vector3d pad_normal(double angle) { return {-std::sin(angle), std::cos(angle), 0.0}; }

Eigen::ArrayXd skirt_relief(const SkirtShape& shape, const PadGrid& pad) {
  const bool table = !shape.table_height.empty();
  if (shape.table_height.size() != shape.table_relief.size())
    throw InputError(
        fmt::format("skirt profile: found {} heights and {} reliefs, expected equal numbers",
                    shape.table_height.size(), shape.table_relief.size()));
  for (size_t k = 1; k < shape.table_height.size(); ++k)
    if (!(shape.table_height[k] > shape.table_height[k - 1]))
      throw InputError(
          fmt::format("skirt profile: height {} is {} m after {} m, expected ascending heights", k,
                      shape.table_height[k], shape.table_height[k - 1]));
  const double bottom = pad.axial_edges()[0], top = pad.axial_edges()[pad.n_axial()];
  Eigen::ArrayXd relief(pad.size());
  for (int j = 0; j < pad.n_axial(); ++j) {
    const double z = pad.axial(j);
    const double barrel = table ? table_value(shape.table_height, shape.table_relief, z)
                                : shape.barrel_top * parabola(z, shape.barrel_apex, top) +
                                      shape.barrel_bottom * parabola(z, shape.barrel_apex, bottom);
    for (int i = 0; i < pad.n_angle(); ++i) {
      const double sine = std::sin(pad.angle(i));
      relief[pad.cell(i, j)] = barrel + shape.ovality * sine * sine;
    }
  }
  return relief;
}

RowMatrix rigid_radial(const PadGrid& pad, double offset, const Eigen::Vector2d& axis) {
  RowMatrix rigid(pad.size(), 6);
  for (int i = 0; i < pad.n_angle(); ++i) {
    const Eigen::Vector3d n = pad_normal(pad.angle(i));
    for (int j = 0; j < pad.n_axial(); ++j) {
      const double z = pad.axial(j) + offset;
      rigid.row(pad.cell(i, j)) << n.x(), n.y(), 0.0, -z * n.y(), z * n.x(),
          n.y() * axis.x() - n.x() * axis.y();
    }
  }
  return rigid;
}

LinerShapeMap::LinerShapeMap(const LinerShape& shape, const PadGrid& pad)
    : shape_(shape),
      pad_(pad),
      stencil_(shape.angle, std::vector<char>(shape.angle.size(), 1), shape.height) {
  if (shape.deviation.rows() != shape.angle.size() || shape.deviation.cols() != shape.height.size())
    throw InputError(fmt::format(
        "liner shape: found {} x {} deviations, expected {} angles x {} heights",
        shape.deviation.rows(), shape.deviation.cols(), shape.angle.size(), shape.height.size()));
  for (int i = 0; i < pad.n_angle(); ++i) columns_.push_back(stencil_.at_angle(pad.angle(i)));
}

void LinerShapeMap::add(double offset, Eigen::ArrayXd& h, Eigen::ArrayXd& slope) const {
  for (int j = 0; j < pad_.n_axial(); ++j) {
    const CylinderStencil::Axial along = stencil_.at_axial(pad_.axial(j) + offset);
    for (int i = 0; i < pad_.n_angle(); ++i) {
      const CylinderStencil::Angular& around = columns_[i];
      auto line = [&](int k) {
        return (1.0 - around.weight) * shape_.deviation(around.first, k) +
               around.weight * shape_.deviation(around.second, k);
      };
      const double low = line(along.first), high = line(along.second);
      h[pad_.cell(i, j)] += low + along.weight * (high - low);
      slope[pad_.cell(i, j)] += along.slope * (high - low);
    }
  }
}

}  // namespace clatter::film
