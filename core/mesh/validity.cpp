// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/validity.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <mutex>
#include <tuple>

#include "core/base/threads.hpp"
#include "core/mesh/cube_bernstein.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"

namespace clatter::mesh {
namespace {

// Deep enough to decide cells whose minimum is above a thousandth of the mean; cells still
// undecided then are unproved and count as invalid.
constexpr int kMaxHalvings = 18;
// Of one cell. Cells of a mesh take tens; only numbers of very different size take more.
constexpr int kMostParts = 4096;

// The symmetric trilinear (polar) form of the cubic: entry (j, l, m) is the Bezier coefficient of
// the multiset {j, l, m}. Coefficients over a part of the cell are the form at the part's corners.
using PolarForm = std::array<std::array<std::array<double, 4>, 4>, 4>;
using ControlPoints = std::array<std::array<Eigen::Vector3d, 4>, 4>;

ControlPoints control_points(const Tet10Nodes& x) {
  ControlPoints c;
  for (int i = 0; i < 4; ++i) c[i][i] = x.row(i);
  for (size_t e = 0; e < kTetEdges.size(); ++e) {
    const auto [i, j] = kTetEdges[e];
    c[i][j] = 2.0 * x.row(4 + static_cast<int>(e)) - 0.5 * (x.row(i) + x.row(j));
    c[j][i] = c[i][j];
  }
  return c;
}

PolarForm polar_form(const Tet10Nodes& x) {
  const ControlPoints c = control_points(x);
  // dx/dxi_k = sum_j lambda_j d[k-1][j]
  std::array<std::array<Eigen::Vector3d, 4>, 3> d;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 4; ++j) d[k][j] = 2.0 * (c[k + 1][j] - c[0][j]);
  }
  PolarForm raw, form;
  for (int j = 0; j < 4; ++j) {
    for (int l = 0; l < 4; ++l) {
      const Eigen::Vector3d normal = d[0][j].cross(d[1][l]);
      for (int m = 0; m < 4; ++m) raw[j][l][m] = normal.dot(d[2][m]);
    }
  }
  for (int j = 0; j < 4; ++j) {
    for (int l = 0; l < 4; ++l) {
      for (int m = 0; m < 4; ++m) {
        form[j][l][m] = (raw[j][l][m] + raw[j][m][l] + raw[l][j][m] + raw[l][m][j] + raw[m][j][l] +
                         raw[m][l][j]) /
                        6.0;
      }
    }
  }
  return form;
}

double smallest(const PolarForm& form) {
  double low = form[0][0][0];
  for (int j = 0; j < 4; ++j) {
    for (int l = j; l < 4; ++l) {
      for (int m = l; m < 4; ++m) low = std::min(low, form[j][l][m]);
    }
  }
  return low;
}

double smallest_corner(const PolarForm& form) {
  return std::min(std::min(form[0][0][0], form[1][1][1]), std::min(form[2][2][2], form[3][3][3]));
}

// Replaces corner `b` by the midpoint of edge a-b: v_b' = (v_a + v_b) / 2 in each argument.
PolarForm half(const PolarForm& form, int a, int b) {
  PolarForm out = form;
  for (int l = 0; l < 4; ++l) {
    for (int m = 0; m < 4; ++m) out[b][l][m] = 0.5 * (out[a][l][m] + out[b][l][m]);
  }
  for (int j = 0; j < 4; ++j) {
    for (int m = 0; m < 4; ++m) out[j][b][m] = 0.5 * (out[j][a][m] + out[j][b][m]);
  }
  for (int j = 0; j < 4; ++j) {
    for (int l = 0; l < 4; ++l) out[j][l][b] = 0.5 * (out[j][l][a] + out[j][l][b]);
  }
  return out;
}

// The edge along which the form varies most is bisected: that separates high from low values first.
std::array<int, 2> steepest_edge(const PolarForm& form) {
  std::array<int, 2> best = {0, 1};
  double steepest = -1.0;
  for (const auto& [a, b] : kTetEdges) {
    double jump = 0.0;
    for (int l = 0; l < 4; ++l) {
      for (int m = 0; m < 4; ++m) jump = std::max(jump, std::abs(form[a][l][m] - form[b][l][m]));
    }
    if (jump > steepest) {
      steepest = jump;
      best = {a, b};
    }
  }
  return best;
}

// Lower bound of the form over its simplex; positive only if proved. `parts` counts down.
double lower_bound(const PolarForm& form, int halvings, int& parts) {
  const double low = smallest(form);
  if (low > 0.0) return low;
  const double corner = smallest_corner(form);
  if (corner <= 0.0 || halvings == kMaxHalvings || --parts < 0) return low;
  const auto [a, b] = steepest_edge(form);
  const double first = lower_bound(half(form, a, b), halvings + 1, parts);
  if (first <= 0.0) return first;
  return std::min(first, lower_bound(half(form, b, a), halvings + 1, parts));
}

// The same over the cube, for the other cells.
double lower_bound(const CubePolynomial& p, int halvings, int& parts) {
  const double low = p.coefficients.minCoeff();
  if (low > 0.0) return low;
  if (p.smallest_corner() <= 0.0 || halvings == kMaxHalvings || --parts < 0) return low;
  const int axis = p.steepest_axis();
  const double first = lower_bound(p.half(axis, false), halvings + 1, parts);
  if (first <= 0.0) return first;
  return std::min(first, lower_bound(p.half(axis, true), halvings + 1, parts));
}

// A quadrature rule that integrates det J exactly.
const CellRule& volume_rule(CellType type) {
  switch (type) {
    case CellType::kHex8:
      return hex_rule(2);
    case CellType::kHex20:
      return hex_rule(3);
    case CellType::kWedge6:
      return wedge_rule(3, 2);
    case CellType::kWedge15:
      return wedge_rule(6, 3);
    case CellType::kPyramid5:
      return pyramid_rule(2);
    default:
      return pyramid_rule(4);
  }
}

bool is_tet(CellType type) { return traits(type).corners == 4; }

Tet10Nodes with_mid_side_nodes(CellType type, const CellNodes& given) {
  Tet10Nodes x;
  x.topRows(given.rows()) = given;
  if (type == CellType::kTet10) return x;
  for (size_t e = 0; e < kTetEdges.size(); ++e) {
    const auto [i, j] = kTetEdges[e];
    x.row(4 + static_cast<int>(e)) = 0.5 * (x.row(i) + x.row(j));
  }
  return x;
}

double mean_of(const PolarForm& form) {
  double sum = 0.0;
  for (int j = 0; j < 4; ++j) {
    for (int l = j; l < 4; ++l) {
      for (int m = l; m < 4; ++m) sum += form[j][l][m];
    }
  }
  return sum / 20.0;  // each cubic Bernstein polynomial has the same integral
}

}  // namespace

JacobianBounds jacobian_bounds(const Tet10Nodes& x) {
  const PolarForm form = polar_form(x);
  int parts = kMostParts;
  const double low = lower_bound(form, 0, parts);
  // Not positive in a part of the cell: the bound is the smallest coefficient of the cell.
  return {low > 0.0 ? low : smallest(form), mean_of(form)};
}

double volume_of(const Tet10Nodes& x) { return mean_of(polar_form(x)) / 6.0; }

JacobianBounds jacobian_bounds(CellType type, const CellNodes& x) {
  if (is_tet(type)) return jacobian_bounds(with_mid_side_nodes(type, x));
  const CubePolynomial p = jacobian_polynomial(type, x);
  int parts = kMostParts;
  const double low = lower_bound(p, 0, parts);
  // The basis polynomials have equal integrals over the cube, of which a hexahedron is a linear
  // image.
  const double mean = traits(type).corners == 8
                          ? p.coefficients.mean()
                          : volume_of(type, x) / volume_rule(type).weights.sum();
  return {low > 0.0 ? low : p.coefficients.minCoeff(), mean};
}

double volume_of(CellType type, const CellNodes& x) {
  if (is_tet(type)) return volume_of(with_mid_side_nodes(type, x));
  static const auto gradients = [] {
    std::array<std::vector<CellShape>, kCellTypes> out;
    for (int t = 2; t < kCellTypes; ++t) {
      const auto cell = static_cast<CellType>(t);
      for (const auto& point : volume_rule(cell).points.rowwise())
        out[t].push_back(cell_shape(cell, point.transpose()));
    }
    return out;
  }();
  const std::vector<CellShape>& at = gradients[static_cast<size_t>(type)];
  double volume = 0.0;
  for (size_t q = 0; q < at.size(); ++q) {
    const Eigen::Matrix3d J = x.transpose() * at[q].gradient;
    volume += volume_rule(type).weights(static_cast<Eigen::Index>(q)) * J.determinant();
  }
  return volume;
}

CellNodes cell_nodes(const Mesh& mesh, const CellBlock& block, Eigen::Index cell) {
  CellNodes x(block.nodes.cols(), 3);
  for (Eigen::Index i = 0; i < x.rows(); ++i) x.row(i) = mesh.nodes.row(block.nodes(cell, i));
  return x;
}

Tet10Nodes tet_nodes(const Mesh& mesh, const CellBlock& block, Eigen::Index cell) {
  return with_mid_side_nodes(block.type, cell_nodes(mesh, block, cell));
}

int32_t cell_label(const CellBlock& block, Eigen::Index cell) {
  return block.ids.empty() ? static_cast<int32_t>(cell) : block.ids[cell];
}

ValidityReport check_validity(const Mesh& mesh) {
  ValidityReport report;
  std::mutex merging;
  for (size_t b = 0; b < mesh.cells.size(); ++b) {
    const CellBlock& block = mesh.cells[b];
    parallel_pieces(block.nodes.rows(), [&](int64_t begin, int64_t end) {
      ValidityReport piece;
      for (int64_t c = begin; c < end; ++c) {
        const CellNodes x = cell_nodes(mesh, block, c);
        const double ratio = jacobian_bounds(block.type, x).ratio();
        piece.min_ratio = std::min(piece.min_ratio, ratio);
        if (ratio > 0.0) continue;
        const Eigen::Vector3d centre = x.topRows(traits(block.type).corners).colwise().mean();
        piece.invalid.push_back({static_cast<int32_t>(b), static_cast<int32_t>(c),
                                 cell_label(block, c), centre, ratio});
      }
      const std::lock_guard lock(merging);
      report.min_ratio = std::min(report.min_ratio, piece.min_ratio);
      report.invalid.insert(report.invalid.end(), piece.invalid.begin(), piece.invalid.end());
    });
  }
  std::ranges::sort(report.invalid, {}, [](const InvalidCell& bad) {
    return std::tuple(bad.ratio, bad.block, bad.cell);
  });
  return report;
}

std::string describe_invalid(const ValidityReport& report, size_t count) {
  std::string text;
  for (size_t i = 0; i < std::min(count, report.invalid.size()); ++i) {
    const InvalidCell& bad = report.invalid[i];
    text += fmt::format(
        "{}cell {} of block {} at ({:.6g}, {:.6g}, {:.6g}) m: min det J / mean = {:.3g}",
        i == 0 ? "" : "; ", bad.label, bad.block, bad.centre.x(), bad.centre.y(), bad.centre.z(),
        bad.ratio);
  }
  return text;
}

}  // namespace clatter::mesh
