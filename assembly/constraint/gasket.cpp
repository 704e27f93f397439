// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/gasket.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assembly/constraint/tie_relations.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/mesh/face_points.hpp"

namespace clatter::assembly {
namespace {

constexpr double kSamePoint = 1e-3;  // of the size of its area

using Triplets = std::vector<Eigen::Triplet<double, int32_t>>;

/// d of the tied nodes by all ids, rows 3 k + direction; place[node] is k, or -1.
struct Jumps {
  SparseMatrix D;
  std::vector<int32_t> place;
};

Jumps jumps_of(const PartData& part, const GasketSpec& spec, const Projection& found) {
  Jumps jumps{{}, std::vector<int32_t>(static_cast<size_t>(part.mesh.nodes.rows()), -1)};
  Triplets entries;
  const double size = mean_size(tie_faces(part.mesh.nodes, part.mesh.surface(spec.slave)));
  int32_t rows = 0;
  for (const ProjectedNode& row : found.tied) {
    jumps.place[row.node] = rows / 3;
    const PointMotion follows = following(part, row, size, spec.where);
    for (int d = 0; d < 3; ++d, ++rows) {
      entries.emplace_back(rows, 3 * row.node + d, 1.0);
      for (size_t k = 0; k < follows[d].dofs.size(); ++k)
        entries.emplace_back(rows, follows[d].dofs[k], -follows[d].values[k]);
    }
  }
  jumps.D.resize(rows, part.numbers.count());
  jumps.D.setFromTriplets(entries.begin(), entries.end());
  return jumps;
}

/// A layer at the integration points of its faces.
struct Layer {
  SparseMatrix K;        // on d
  SparseMatrix closing;  // m x rows of d
  RowMatrix points;      // m x 3
  Eigen::VectorXd area;  // m
};

/// Points and stiffness of the faces whose nodes all have a d.
class LayerPoints {
 public:
  LayerPoints(const GasketSpec& spec, const Jumps& jumps) : spec_(spec), jumps_(jumps) {}

  template <typename Nodes, typename Values>
  void add(const Nodes& nodes, const Values& N, const Eigen::Vector3d& x,
           const Eigen::Vector3d& n_dA) {
    for (const int32_t node : nodes)
      if (jumps_.place[node] < 0) return;
    const double dA = n_dA.norm();
    const Eigen::Vector3d n = n_dA / dA;
    const auto point = static_cast<int32_t>(area_.size());
    check_pressed(point, x, std::sqrt(dA));
    x_.push_back(x);
    area_.push_back(dA);
    for (Eigen::Index a = 0; a < nodes.size(); ++a)
      for (int i = 0; i < 3; ++i)
        closing_.emplace_back(point, 3 * jumps_.place[nodes(a)] + i, N(a) * n(i));
    if (spec_.pressed && !(spec_.pressed->pressure(point) > 0.0)) return;
    const Eigen::Matrix3d k = dA * (spec_.tangential * Eigen::Matrix3d::Identity() +
                                    (spec_.normal - spec_.tangential) * n * n.transpose());
    for (Eigen::Index a = 0; a < nodes.size(); ++a)
      for (Eigen::Index b = 0; b < nodes.size(); ++b)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            if (k(i, j) != 0.0)
              stiffness_.emplace_back(3 * jumps_.place[nodes(a)] + i,
                                      3 * jumps_.place[nodes(b)] + j, N(a) * N(b) * k(i, j));
  }

  Layer finish() const {
    const auto m = static_cast<Eigen::Index>(area_.size());
    const Eigen::Index rows = jumps_.D.rows();
    if (spec_.pressed && spec_.pressed->pressure.size() != m) refuse_other_faces();
    Layer layer{SparseMatrix(rows, rows), SparseMatrix(m, rows), RowMatrix(m, 3),
                Eigen::Map<const Eigen::VectorXd>(area_.data(), m)};
    layer.K.setFromTriplets(stiffness_.begin(), stiffness_.end());
    layer.closing.setFromTriplets(closing_.begin(), closing_.end());
    for (Eigen::Index k = 0; k < m; ++k) layer.points.row(k) = x_[k].transpose();
    return layer;
  }

 private:
  void check_pressed(int32_t point, const Eigen::Vector3d& x, double size) const {
    if (!spec_.pressed) return;
    if (point >= spec_.pressed->points.rows() ||
        (spec_.pressed->points.row(point).transpose() - x).norm() > kSamePoint * size)
      refuse_other_faces();
  }
  [[noreturn]] void refuse_other_faces() const {
    throw InputError(fmt::format(
        "{}: pressed: found points that are not those of the faces of {}, expected static results "
        "of the same mesh and the same two surfaces",
        spec_.where, spec_.slave));
  }

  const GasketSpec& spec_;
  const Jumps& jumps_;
  Triplets stiffness_, closing_;
  std::vector<Eigen::Vector3d> x_;
  std::vector<double> area_;
};

Layer layer_of(const PartData& part, const GasketSpec& spec, const Jumps& jumps) {
  LayerPoints points(spec, jumps);
  mesh::for_each_face_point(
      part.mesh.nodes, part.mesh.surface(spec.slave),
      [&](const auto& nodes, const auto& N, const Eigen::Vector3d& x, double weight,
          const Eigen::Vector3d& normal) { points.add(nodes, N, x, weight * normal); });
  return points.finish();
}

/// The gasket in words, with what is open of it.
std::string described(const GasketSpec& spec, const Projection& found, const Layer& layer) {
  std::string text =
      fmt::format("{}: {:.4g} m2, {:.1f} % of the slave surface, largest gap {:.3g} m", spec.name,
                  layer.area.sum(), 100.0 * layer.area.sum() / found.slave_area, found.largest_gap);
  if (spec.pressed)
    text += fmt::format(
        "; pressed on {:.1f} %, without stiffness elsewhere",
        100.0 * (spec.pressed->pressure.array() > 0.0).cast<double>().matrix().dot(layer.area) /
            layer.area.sum());
  if (!spec.curve.closure.empty())
    text += "; statics follow its curve, all else has normal_stiffness";
  return text;
}

}  // namespace

GasketStiffness gasket_stiffness(const PartData& part) {
  const auto size = static_cast<Eigen::Index>(part.numbers.count());
  GasketStiffness out{SparseMatrix(size, size), {}, {}};
  for (GasketSpec spec : part.recipe.gaskets) {
    const Projection found = project_tie(part, spec);
    const Jumps jumps = jumps_of(part, spec, found);
    const Layer layer = layer_of(part, spec, jumps);
    if (layer.area.size() == 0)
      throw InputError(fmt::format(
          "{}: found no face of {} whose nodes all face {} within {:.3g} m, expected some",
          spec.where, spec.slave, spec.master, *spec.distance));
    const SparseMatrix K =
        SparseMatrix(jumps.D.transpose() * layer.K * jumps.D).triangularView<Eigen::Lower>();
    out.K += K;
    if (spec.loss_factor > 0.0) {
      if (out.loss.rows() == 0) out.loss.resize(size, size);
      out.loss += spec.loss_factor * K;
    }
    if (!spec.curve.closure.empty())
      out.curves.push_back({spec.name,
                            spec.curve,
                            spec.normal,
                            layer.points,
                            layer.area,
                            layer.closing * jumps.D,
                            {}});
    say(described(spec, found, layer));
  }
  return out;
}

}  // namespace clatter::assembly
