// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/quality.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "core/mesh/validity.hpp"

namespace clatter::mesh {
namespace {

Measure make_measure(double low, double high, double best) {
  Measure m;
  m.low = low;
  m.high = high;
  m.worst = best;
  return m;
}

struct CellRecord {
  CellType type;
  int32_t block, cell, label;
  Eigen::Vector3d centre;
};

// `sign` 1: small is bad; -1: large is bad.
void record(Measure& m, double value, double sign, const CellRecord& cell) {
  const double bins = static_cast<double>(m.histogram.size());
  const double position = (value - m.low) / (m.high - m.low) * bins;
  const auto bin = static_cast<size_t>(std::clamp(position, 0.0, bins - 1.0));
  ++m.histogram[bin];
  auto& of_type = m.by_type[cell.type];
  of_type.resize(m.histogram.size());
  ++of_type[bin];
  const auto worse = [&](const WorstCell& a, const WorstCell& b) {
    return sign * a.value < sign * b.value;
  };
  const WorstCell here{value, cell.block, cell.cell, cell.label, cell.centre};
  if (m.worst_cells.size() < kWorstCells || worse(here, m.worst_cells.back())) {
    m.worst_cells.insert(std::upper_bound(m.worst_cells.begin(), m.worst_cells.end(), here, worse),
                         here);
    if (m.worst_cells.size() > kWorstCells) m.worst_cells.pop_back();
  }
  if (sign * value >= sign * m.worst) return;
  m.worst = value;
  m.block = cell.block;
  m.cell = cell.cell;
  m.label = cell.label;
  m.position = cell.centre;
}

// One end of an edge with the next corner of each of the two faces that meet there.
struct EdgeEnd {
  int here, other, left, right;
};

// The corner that follows `here` in the face on the side away from `other`.
int next_corner(const CellFace& face, int here, int other) {
  const int n = traits(face.type).corners;
  for (int i = 0; i < n; ++i) {
    if (face.nodes[i] != here) continue;
    const int next = face.nodes[(i + 1) % n];
    return next == other ? face.nodes[(i + n - 1) % n] : next;
  }
  return -1;
}

bool holds(const CellFace& face, int a, int b) {
  const int n = traits(face.type).corners;
  for (int i = 0; i < n; ++i) {
    const int p = face.nodes[i], q = face.nodes[(i + 1) % n];
    if ((p == a && q == b) || (p == b && q == a)) return true;
  }
  return false;
}

std::vector<EdgeEnd> edge_ends(CellType type) {
  std::vector<EdgeEnd> ends;
  for (const auto& [a, b] : traits(type).edges) {
    std::vector<const CellFace*> pair;
    for (const CellFace& face : traits(type).faces)
      if (holds(face, a, b)) pair.push_back(&face);
    ends.push_back({a, b, next_corner(*pair[0], a, b), next_corner(*pair[1], a, b)});
    ends.push_back({b, a, next_corner(*pair[0], b, a), next_corner(*pair[1], b, a)});
  }
  return ends;
}

double angle_at(const EdgeEnd& end, const CellNodes& x) {
  const Eigen::Vector3d edge = (x.row(end.other) - x.row(end.here)).normalized();
  Eigen::Vector3d left = x.row(end.left) - x.row(end.here);
  Eigen::Vector3d right = x.row(end.right) - x.row(end.here);
  left -= edge * edge.dot(left);
  right -= edge * edge.dot(right);
  return std::atan2(left.cross(right).norm(), left.dot(right)) * 180.0 / std::numbers::pi;
}

const std::vector<EdgeEnd>& ends_of(CellType type) {
  static const auto all = [] {
    std::array<std::vector<EdgeEnd>, kCellTypes> ends;
    for (int t = 0; t < kCellTypes; ++t) ends[t] = edge_ends(static_cast<CellType>(t));
    return ends;
  }();
  return all[static_cast<size_t>(type)];
}

std::pair<double, double> extreme_angles(CellType type, const CellNodes& x) {
  double low = 180.0, high = 0.0;
  for (const EdgeEnd& end : ends_of(type)) {
    const double angle = angle_at(end, x);
    low = std::min(low, angle);
    high = std::max(high, angle);
  }
  return {low, high};
}

void write_measure(H5File& file, const std::string& name, const Measure& m) {
  const std::string group = "quality/" + name;
  file.write(group + "/histogram", m.histogram);
  file.set(group, "low", m.low);
  file.set(group, "high", m.high);
  file.set(group, "worst", m.worst);
  file.set(group, "worst_block", static_cast<int64_t>(m.block));
  file.set(group, "worst_cell", static_cast<int64_t>(m.cell));
  file.set(group, "worst_label", static_cast<int64_t>(m.label));
  file.write(group + "/worst_place", Eigen::VectorXd(m.position));
  for (const auto& [type, histogram] : m.by_type)
    file.write(fmt::format("{}/by_type/{}", group, traits(type).name), histogram);
  std::vector<int32_t> labels;
  std::vector<double> values;
  RowMatrix positions(static_cast<Eigen::Index>(m.worst_cells.size()), 3);
  for (const WorstCell& cell : m.worst_cells) {
    positions.row(static_cast<Eigen::Index>(labels.size())) = cell.position.transpose();
    labels.push_back(cell.label);
    values.push_back(cell.value);
  }
  file.write(group + "/worst_cells", labels);
  file.write(group + "/worst_values", values);
  file.write(group + "/worst_places", positions);
}

}  // namespace

Eigen::Matrix<double, 6, 1> dihedral_angles(const Eigen::Matrix<double, 4, 3>& corners) {
  Eigen::Matrix<double, 6, 1> angles;
  for (int e = 0; e < 6; ++e) {
    const auto [a, b] = kTetEdges[e];
    int c = 0;
    while (c == a || c == b) ++c;
    const int d = 6 - a - b - c;
    const Eigen::Vector3d edge = (corners.row(b) - corners.row(a)).normalized();
    Eigen::Vector3d to_c = (corners.row(c) - corners.row(a)).transpose();
    Eigen::Vector3d to_d = (corners.row(d) - corners.row(a)).transpose();
    to_c -= edge * edge.dot(to_c);
    to_d -= edge * edge.dot(to_d);
    angles[e] = std::atan2(to_c.cross(to_d).norm(), to_c.dot(to_d)) * 180.0 / std::numbers::pi;
  }
  return angles;
}

double largest_cosine(const Eigen::Matrix<double, 4, 3>& corners) {
  constexpr double kFlat = 1e-6;  // |n| >= kFlat L^2: the cosines are accurate to 4e-10
  const Eigen::Vector3d a = corners.row(1) - corners.row(0), b = corners.row(2) - corners.row(0),
                        c = corners.row(3) - corners.row(0);
  const Eigen::Vector3d ab = b - a, ac = c - a;
  const std::array<Eigen::Vector3d, 4> normals = {b.cross(a), a.cross(c), c.cross(b), ab.cross(ac)};
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm(),
                                   ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  std::array<double, 4> lengths;
  for (size_t i = 0; i < 4; ++i) {
    lengths[i] = normals[i].norm();
    if (!(lengths[i] >= kFlat * longest)) return std::numeric_limits<double>::quiet_NaN();
  }
  double largest = -1.0;
  for (size_t i = 0; i < 4; ++i)
    for (size_t j = 0; j < i; ++j)
      largest = std::max(largest, -normals[i].dot(normals[j]) / (lengths[i] * lengths[j]));
  return largest;
}

double smallest_dihedral(const Eigen::Matrix<double, 4, 3>& corners, double limit_deg) {
  const double limit = std::cos(limit_deg * std::numbers::pi / 180.0);
  if (largest_cosine(corners) < limit - kCosineError) return limit_deg;
  return dihedral_angles(corners).minCoeff();
}

std::vector<double> dihedral_angles(CellType type, const CellNodes& x) {
  std::vector<double> angles;
  for (const EdgeEnd& end : ends_of(type)) angles.push_back(angle_at(end, x));
  return angles;
}

double smallest_angle_of(CellType type, const CellNodes& x) {
  return extreme_angles(type, x).first;
}

double radius_ratio(const Eigen::Matrix<double, 4, 3>& corners) {
  const Eigen::Vector3d a = corners.row(1) - corners.row(0);
  const Eigen::Vector3d b = corners.row(2) - corners.row(0);
  const Eigen::Vector3d c = corners.row(3) - corners.row(0);
  const double volume6 = a.dot(b.cross(c));
  if (volume6 <= 0.0) return 0.0;
  const double area2 =
      a.cross(b).norm() + b.cross(c).norm() + c.cross(a).norm() + (b - a).cross(c - a).norm();
  const double r_in = volume6 / area2;
  const double r_circum =
      (a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b))
          .norm() /
      (2.0 * volume6);
  return 3.0 * r_in / r_circum;
}

QualityReport measure_quality(const Mesh& mesh) {
  QualityReport report{make_measure(0.0, 90.0, 180.0), make_measure(60.0, 180.0, 0.0),
                       make_measure(0.0, 1.0, 2.0), make_measure(0.0, 1.0, 2.0)};
  for (size_t b = 0; b < mesh.cells.size(); ++b) {
    const CellBlock& block = mesh.cells[b];
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const CellNodes x = cell_nodes(mesh, block, c);
      const auto corners = x.topRows(traits(block.type).corners);
      const CellRecord cell{block.type, static_cast<int32_t>(b), static_cast<int32_t>(c),
                            cell_label(block, c), corners.colwise().mean().transpose()};
      const auto [low, high] = extreme_angles(block.type, x);
      record(report.min_dihedral_deg, low, 1.0, cell);
      record(report.max_dihedral_deg, high, -1.0, cell);
      if (corners.rows() == 4) record(report.radius_ratio, radius_ratio(x.topRows<4>()), 1.0, cell);
      record(report.scaled_jacobian, jacobian_bounds(block.type, x).ratio(), 1.0, cell);
    }
  }
  return report;
}

void write_quality(H5File& file, const QualityReport& report) {
  write_measure(file, "min_dihedral_deg", report.min_dihedral_deg);
  write_measure(file, "max_dihedral_deg", report.max_dihedral_deg);
  write_measure(file, "radius_ratio", report.radius_ratio);
  write_measure(file, "scaled_jacobian", report.scaled_jacobian);
}

}  // namespace clatter::mesh
