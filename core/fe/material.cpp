// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/material.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/dense/cholesky.hpp"

namespace clatter::fe {
namespace {

/// Pairs of directions of the six components.
constexpr int kPair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};

/// Q with sigma_basic = Q sigma_local for axes R (columns: local directions), that is sigma_basic =
/// R sigma_local R^T by components; then C_basic = Q C_local Q^T (Bond's matrix; Auld 1973).
Elasticity stress_rotation(const Eigen::Matrix3d& R) {
  Elasticity Q;
  for (int I = 0; I < 6; ++I) {
    const auto [i, j] = kPair[I];
    for (int J = 0; J < 6; ++J) {
      const auto [k, l] = kPair[J];
      Q(I, J) = J < 3 ? R(i, k) * R(j, k) : R(i, k) * R(j, l) + R(i, l) * R(j, k);
    }
  }
  return Q;
}

void require_count(const keys::Source& table, std::string_view key,
                   const std::vector<double>& values, size_t expected) {
  if (values.size() != expected)
    table.fail(key, fmt::format("found {} numbers, expected {}", values.size(), expected));
}

Elasticity orthotropic(const keys::Source& table, const MaterialTable& m) {
  const std::vector<double>&E = m.E, &nu = m.nu, &G = m.G;
  require_count(table, "E", E, 3);
  require_count(table, "nu", nu, 3);
  require_count(table, "G", G, 3);
  Elasticity compliance = Elasticity::Zero();
  for (int i = 0; i < 3; ++i) compliance(i, i) = 1.0 / E[i];
  compliance(0, 1) = compliance(1, 0) = -nu[0] / E[0];
  compliance(0, 2) = compliance(2, 0) = -nu[1] / E[0];
  compliance(1, 2) = compliance(2, 1) = -nu[2] / E[1];
  compliance(3, 3) = 1.0 / G[0];
  compliance(5, 5) = 1.0 / G[1];  // 13
  compliance(4, 4) = 1.0 / G[2];  // 23
  const dense::Cholesky factor(compliance);
  if (!factor.ok())
    table.fail("nu",
               "found constants without positive elastic energy, expected e.g. nu12^2 < E1/E2");
  return factor.solve(Elasticity::Identity());
}

Elasticity anisotropic(const keys::Source& table, const std::vector<double>& upper) {
  require_count(table, "C", upper, 21);
  Elasticity C;
  size_t at = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) C(i, j) = C(j, i) = upper[at++];
  if (!dense::Cholesky(C).ok())
    table.fail("C",
               "found a matrix that is not positive definite, expected a positive definite one");
  return C;
}

}  // namespace

Material Material::scaled(double factor) const {
  Material out = *this;
  out.youngs *= factor;
  if (out.elasticity) *out.elasticity *= factor;
  return out;
}

Material Material::seen_from(const Eigen::Vector3d& origin) const {
  Material out = *this;
  if (out.axes) out.axes->origin -= origin;
  return out;
}

Elasticity Material::elasticity_at(const Eigen::Vector3d& x) const {
  Elasticity C;
  if (is_isotropic()) {
    C = Elasticity::Zero();
    C.topLeftCorner<3, 3>().setConstant(lambda());
    C.diagonal() += (Voigt() << 2 * mu(), 2 * mu(), 2 * mu(), mu(), mu(), mu()).finished();
    return C;
  }
  if (!axes) return *elasticity;
  const Elasticity Q = stress_rotation(axes->at(x));
  return Q * *elasticity * Q.transpose();
}

Voigt Material::expansion_at(const Eigen::Vector3d& x) const {
  if (!axes || expansion.isZero(0.0)) return expansion;
  // A strain transforms like a stress when its shear components are halved.
  Voigt tensor = expansion;
  tensor.tail<3>() *= 0.5;
  Voigt turned = stress_rotation(axes->at(x)) * tensor;
  turned.tail<3>() *= 2.0;
  return turned;
}

Eigen::Matrix3d Material::conductivity_at(const Eigen::Vector3d& x) const {
  if (!axes) return conductivity.asDiagonal();
  const Eigen::Matrix3d R = axes->at(x);
  return R * conductivity.asDiagonal() * R.transpose();
}

void finish(const keys::Source& table, MaterialTable& m) {
  Material& material = m.material;
  if (!m.C.empty()) {
    material.elasticity = anisotropic(table, m.C);
  } else if (m.E.size() != 1) {
    material.elasticity = orthotropic(table, m);
  } else {
    require_count(table, "nu", m.nu, 1);
    material.youngs = m.E[0];
    material.poisson = m.nu[0];
    if (!(material.poisson > -1.0 && material.poisson < 0.5))
      table.fail("nu", fmt::format("found {:g}, expected -1 < nu < 0.5", material.poisson));
  }
  const auto along_axes = [&](const char* key, const std::vector<double>& given, auto along) {
    if (given.empty()) return;
    if (given.size() != 1) require_count(table, key, given, 3);
    for (int i = 0; i < 3; ++i) along(i) = given[given.size() == 1 ? 0 : static_cast<size_t>(i)];
  };
  along_axes("expansion", m.expansion, material.expansion.head<3>());
  along_axes("conductivity", m.conductivity, material.conductivity.head<3>());
}

}  // namespace clatter::fe
