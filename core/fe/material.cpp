// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/material.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "core/dense/cholesky.hpp"

namespace clatter::fe {
namespace {

constexpr double kGiga = 1e9;

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

/// A number or a list of them.
std::vector<double> one_or_more(const Config& table, const std::string& key) {
  return table.is_list(key) ? table.numbers(key) : std::vector<double>{table.number(key)};
}

/// Numbers of `key` in Pa or `key`_gpa in GPa.
std::vector<double> pascals(const Config& table, const std::string& key) {
  const std::string giga = key + "_gpa";
  if (table.has(key) && table.has(giga))
    table.fail(giga, fmt::format("found {} as well, expected one", key));
  const bool in_pa = table.has(key);
  std::vector<double> values = one_or_more(table, in_pa ? key : giga);
  if (!in_pa)
    for (double& value : values) value *= kGiga;
  return values;
}

void require_count(const Config& table, std::string_view key, const std::vector<double>& values,
                   size_t expected) {
  if (values.size() != expected)
    table.fail(key, fmt::format("found {} numbers, expected {}", values.size(), expected));
}

Elasticity orthotropic(const Config& table, const std::vector<double>& E) {
  require_count(table, "E", E, 3);
  const std::vector<double> nu = table.numbers("nu", 3);
  const std::vector<double> G = pascals(table, "G");
  require_count(table, "G", G, 3);
  Elasticity compliance = Elasticity::Zero();
  for (int i = 0; i < 3; ++i) {
    if (!(E[static_cast<size_t>(i)] > 0.0 && G[static_cast<size_t>(i)] > 0.0))
      table.fail("E", "expected moduli above zero");
    compliance(i, i) = 1.0 / E[static_cast<size_t>(i)];
  }
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

Elasticity anisotropic(const Config& table) {
  const std::vector<double> upper = pascals(table, "C");
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

void read_elasticity(const Config& table, Material& material) {
  if (table.has("C") || table.has("C_gpa")) {
    material.elasticity = anisotropic(table);
    return;
  }
  const std::vector<double> E = pascals(table, "E");
  if (E.size() != 1) {
    material.elasticity = orthotropic(table, E);
    return;
  }
  material.youngs = E[0];
  if (!(E[0] > 0.0)) table.fail("E", fmt::format("found {:g}, expected above 0", E[0]));
  material.poisson = table.number("nu");
  if (!(material.poisson > -1.0 && material.poisson < 0.5))
    table.fail("nu", fmt::format("found {:g}, expected -1 < nu < 0.5", material.poisson));
}

void read_expansion(const Config& table, Material& material) {
  if (!table.has("expansion")) return;
  const std::vector<double> a = one_or_more(table, "expansion");
  if (a.size() != 1) require_count(table, "expansion", a, 3);
  for (int i = 0; i < 3; ++i) material.expansion(i) = a[a.size() == 1 ? 0 : static_cast<size_t>(i)];
}

void read_conductivity(const Config& table, Material& material) {
  if (!table.has("conductivity")) return;
  const std::vector<double> k = one_or_more(table, "conductivity");
  if (k.size() != 1) require_count(table, "conductivity", k, 3);
  for (int i = 0; i < 3; ++i)
    material.conductivity(i) = k[k.size() == 1 ? 0 : static_cast<size_t>(i)];
  if (!(material.conductivity.minCoeff() > 0.0))
    table.fail("conductivity",
               fmt::format("found {:g}, expected above 0", material.conductivity.minCoeff()));
}

Integration choose(const Config& table, std::string_view key,
                   std::initializer_list<std::string_view> known) {
  const std::string name = table.choice(key, known);
  return name == "full"      ? Integration::kFull
         : name == "reduced" ? Integration::kReduced
         : name == "fine"    ? Integration::kFine
                             : Integration::kIncompatible;
}

}  // namespace

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

Material read_material(const Config& table, const std::map<std::string, Axes>& systems) {
  Material material;
  read_elasticity(table, material);
  material.density = table.number("rho", Range::positive());
  read_expansion(table, material);
  read_conductivity(table, material);
  if (table.has("system")) {
    const std::string name = table.text("system");
    const auto found = systems.find(name);
    if (found == systems.end()) {
      std::vector<std::string> present;
      for (const auto& entry : systems) present.push_back(entry.first);
      table.fail("system",
                 fmt::format("found \"{}\", expected one of: {}", name, fmt::join(present, ", ")));
    }
    material.axes = found->second;
  }
  material.integration = {choose(table, "hex8", {"incompatible", "full", "fine"}),
                          choose(table, "hex20", {"full", "reduced"}),
                          choose(table, "wedge6", {"full", "reduced", "fine"}),
                          choose(table, "wedge15", {"full", "reduced"})};
  return material;
}

}  // namespace clatter::fe
