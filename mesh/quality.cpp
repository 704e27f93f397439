#include "mesh/quality.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <numbers>
#include <utility>

#include "mesh/validity.hpp"

namespace clatter::mesh {
namespace {

Measure make_measure(double low, double high, double best) {
  Measure m;
  m.low = low;
  m.high = high;
  m.worst = best;
  return m;
}

// `sign` 1: small is bad; -1: large is bad.
void record(Measure& m, double value, double sign, int32_t block, int32_t cell,
            const Eigen::Vector3d& centre) {
  const double bins = static_cast<double>(m.histogram.size());
  const double position = (value - m.low) / (m.high - m.low) * bins;
  const auto bin = static_cast<size_t>(std::clamp(position, 0.0, bins - 1.0));
  ++m.histogram[bin];
  if (sign * value >= sign * m.worst) return;
  m.worst = value;
  m.block = block;
  m.cell = cell;
  m.place = centre;
}

void write_measure(H5File& file, const std::string& name, const Measure& m) {
  const std::string group = "quality/" + name;
  file.write(group + "/histogram", m.histogram);
  file.set(group, "low", m.low);
  file.set(group, "high", m.high);
  file.set(group, "worst", m.worst);
  file.set(group, "worst_block", static_cast<int64_t>(m.block));
  file.set(group, "worst_cell", static_cast<int64_t>(m.cell));
  file.write(group + "/worst_place", Eigen::VectorXd(m.place));
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
  QualityReport report{make_measure(0.0, 80.0, 180.0), make_measure(60.0, 180.0, 0.0),
                       make_measure(0.0, 1.0, 2.0), make_measure(0.0, 1.0, 2.0)};
  for (size_t b = 0; b < mesh.cells.size(); ++b) {
    const CellBlock& block = mesh.cells[b];
    const auto id = static_cast<int32_t>(b);
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      const Tet10Nodes x = cell_nodes(mesh, block, c);
      const Eigen::Matrix<double, 4, 3> corners = x.topRows<4>();
      const Eigen::Vector3d centre = corners.colwise().mean().transpose();
      const auto angles = dihedral_angles(corners);
      const auto cell = static_cast<int32_t>(c);
      record(report.min_dihedral_deg, angles.minCoeff(), 1.0, id, cell, centre);
      record(report.max_dihedral_deg, angles.maxCoeff(), -1.0, id, cell, centre);
      record(report.radius_ratio, radius_ratio(corners), 1.0, id, cell, centre);
      record(report.scaled_jacobian, jacobian_bounds(x).ratio(), 1.0, id, cell, centre);
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
