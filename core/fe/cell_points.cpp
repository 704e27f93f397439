// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/cell_points.hpp"

#include <array>

#include "core/dense/least_squares.hpp"
#include "core/mesh/quadrature.hpp"

namespace clatter::fe {
namespace {

using mesh::CellRule;
using mesh::CellType;

CellPoints tabulate(CellType type, const CellRule& rule) {
  CellPoints points;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const Eigen::Vector3d xi = rule.points.row(q);
    points.push_back({mesh::cell_shape(type, xi), xi, rule.weights(q)});
  }
  return points;
}

const CellRule& full_rule(CellType type, bool straight) {
  switch (type) {
    case CellType::kTet4:
      return mesh::tet_rule_1();
    case CellType::kTet10:
      return straight ? mesh::tet_rule_4() : mesh::tet_rule_14();
    case CellType::kHex8:
      return mesh::hex_rule(2);
    case CellType::kHex20:
      return mesh::hex_rule(3);
    case CellType::kWedge6:
      return mesh::wedge_rule(3, 2);
    case CellType::kWedge15:
      return mesh::wedge_rule(6, 3);
    case CellType::kPyramid5:
      return mesh::pyramid_rule(2);
    default:
      return mesh::pyramid_rule(straight ? 3 : 4);
  }
}

/// The reduced rule of cells that have one, else the full rule.
const CellRule& reduced_rule(CellType type) {
  switch (type) {
    case CellType::kHex20:
      return mesh::hex_rule(2);
    case CellType::kWedge6:
      return mesh::wedge_rule(1, 2);
    case CellType::kWedge15:
      return mesh::wedge_rule(3, 3);
    default:
      return full_rule(type, false);
  }
}

/// One order more than the full rule of the cells of corners alone.
const CellRule& fine_stiffness_rule(CellType type) {
  switch (type) {
    case CellType::kHex8:
      return mesh::hex_rule(3);
    case CellType::kWedge6:
      return mesh::wedge_rule(6, 3);
    default:
      return full_rule(type, false);
  }
}

const CellRule& mass_rule(CellType type, bool straight) {
  switch (type) {
    case CellType::kTet4:
    case CellType::kTet10:
      return mesh::tet_rule_64();
    case CellType::kHex8:
      return mesh::hex_rule(3);
    case CellType::kHex20:
      return mesh::hex_rule(straight ? 4 : 5);
    case CellType::kWedge6:
      return mesh::wedge_rule(6, 3);
    case CellType::kWedge15:
      return mesh::wedge_rule(25, 5);
    case CellType::kPyramid5:
      return mesh::pyramid_rule(3);
    default:
      return mesh::pyramid_rule(5);
  }
}

const CellRule& stress_rule(CellType type) {
  switch (mesh::traits(type).corners) {
    case 4:
      return type == CellType::kTet4 ? mesh::tet_rule_1() : mesh::tet_rule_4();
    case 5:
      return mesh::pyramid_rule(2);
    case 6:
      return mesh::wedge_rule(3, 2);
    default:
      return mesh::hex_rule(2);
  }
}

/// The linear cell with the same corners.
CellType linear_cell(CellType type) {
  switch (mesh::traits(type).corners) {
    case 4:
      return CellType::kTet4;
    case 5:
      return CellType::kPyramid5;
    case 6:
      return CellType::kWedge6;
    default:
      return CellType::kHex8;
  }
}

Eigen::MatrixXd fit_corners(CellType type) {
  const CellRule& rule = stress_rule(type);
  const Eigen::Index n = rule.weights.size(), corners = mesh::traits(type).corners;
  if (n == 1) return Eigen::MatrixXd::Ones(corners, 1);
  Eigen::MatrixXd N(n, corners);
  for (Eigen::Index q = 0; q < n; ++q)
    N.row(q) = mesh::cell_shape(linear_cell(type), rule.points.row(q)).value.transpose();
  return dense::pseudo_inverse(N);
}

/// Tables of all cell types.
class Tables {
 public:
  template <class RuleOf>
  explicit Tables(const RuleOf& rule_of) {
    for (int t = 0; t < mesh::kCellTypes; ++t) {
      const auto type = static_cast<CellType>(t);
      tables_[t] = tabulate(type, rule_of(type));
    }
  }
  const CellPoints& of(CellType type) const { return tables_[static_cast<size_t>(type)]; }

 private:
  std::array<CellPoints, mesh::kCellTypes> tables_;
};

}  // namespace

Integration integration_of(CellType type, const IntegrationChoice& choice) {
  switch (type) {
    case CellType::kHex8:
      return choice.hex8;
    case CellType::kHex20:
      return choice.hex20;
    case CellType::kWedge6:
      return choice.wedge6;
    case CellType::kWedge15:
      return choice.wedge15;
    default:
      return Integration::kFull;
  }
}

const CellPoints& stiffness_points(CellType type, Integration integration, bool straight) {
  static const Tables simple([](CellType t) -> const CellRule& { return full_rule(t, true); });
  static const Tables curved([](CellType t) -> const CellRule& { return full_rule(t, false); });
  static const Tables reduced(reduced_rule);
  static const Tables fine(fine_stiffness_rule);
  if (integration == Integration::kReduced) return reduced.of(type);
  if (integration == Integration::kFine) return fine.of(type);
  return straight ? simple.of(type) : curved.of(type);
}

const CellPoints& stress_points(CellType type) {
  static const Tables tables(stress_rule);
  return tables.of(type);
}

const Eigen::MatrixXd& stress_smoothing(CellType type) {
  static const auto all = [] {
    std::array<Eigen::MatrixXd, mesh::kCellTypes> out;
    for (size_t t = 0; t < out.size(); ++t) out[t] = fit_corners(static_cast<CellType>(t));
    return out;
  }();
  return all[static_cast<size_t>(type)];
}

const CellPoints& mass_points(CellType type, bool straight) {
  static const Tables simple([](CellType t) -> const CellRule& { return mass_rule(t, true); });
  static const Tables curved([](CellType t) -> const CellRule& { return mass_rule(t, false); });
  return straight ? simple.of(type) : curved.of(type);
}

}  // namespace clatter::fe
