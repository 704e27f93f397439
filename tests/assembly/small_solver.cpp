// SPDX-License-Identifier: GPL-3.0-or-later
#include "small_solver.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "core/base/log.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::assembly::testing {

std::vector<fe::Material> materials_of(const mesh::Mesh& mesh, const fe::Material& material) {
  return std::vector<fe::Material>(mesh.regions.size(), material);
}

Eigen::VectorXd solve_fixed(const SparseMatrix& K, const Eigen::VectorXd& f,
                            const std::vector<bool>& fixed, const Eigen::VectorXd& given) {
  std::vector<int32_t> index(fixed.size(), -1);
  int32_t n = 0;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(f.size());
  for (size_t i = 0; i < fixed.size(); ++i) {
    if (fixed[i])
      u(static_cast<Eigen::Index>(i)) = given(static_cast<Eigen::Index>(i));
    else
      index[i] = n++;
  }
  const Eigen::VectorXd rest = f - multiply_symmetric(K, u);
  std::vector<Eigen::Triplet<double, int32_t>> entries;
  for (Eigen::Index c = 0; c < K.cols(); ++c)
    for (SparseMatrix::InnerIterator it(K, c); it; ++it) {
      const int32_t i = index[it.row()], j = index[c];
      if (i >= 0 && j >= 0) entries.emplace_back(i, j, it.value());
    }
  SparseMatrix K_ii(n, n);
  K_ii.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd f_i(n);
  for (size_t i = 0; i < index.size(); ++i)
    if (index[i] >= 0) f_i(index[i]) = rest(static_cast<Eigen::Index>(i));
  const Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower> factor(K_ii);
  if (factor.info() != Eigen::Success) throw std::runtime_error("stiffness not definite");
  Eigen::VectorXd u_i = factor.solve(f_i);
  // One refinement: patch tests check the last digits.
  u_i += factor.solve(f_i - multiply_symmetric(K_ii, u_i));
  for (size_t i = 0; i < index.size(); ++i)
    if (index[i] >= 0) u(static_cast<Eigen::Index>(i)) = u_i(index[i]);
  return u;
}

Eigen::VectorXd lowest_hz(const SparseMatrix& K, const SparseMatrix& M, int count) {
  const Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower> factor(K);
  if (factor.info() != Eigen::Success) throw std::runtime_error("stiffness not definite");
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  const int block = 2 * count + 8;
  Eigen::MatrixXd X = Eigen::MatrixXd::NullaryExpr(K.rows(), block,
                                                   [&](Eigen::Index) { return normal(generator); });
  Eigen::VectorXd last = Eigen::VectorXd::Zero(count), lambda;
  for (int sweep = 0; sweep < 60; ++sweep) {
    X = factor.solve(multiply_symmetric(M, X));
    const Eigen::MatrixXd k = X.transpose() * multiply_symmetric(K, X);
    const Eigen::MatrixXd m = X.transpose() * multiply_symmetric(M, X);
    const dense::Eigenpairs ritz = dense::symmetric_eigen(k, m);
    X = X * ritz.vectors;
    lambda = ritz.values.head(count);
    if ((lambda - last).cwiseAbs().maxCoeff() < 1e-12 * lambda.maxCoeff()) break;
    last = lambda;
  }
  return lambda.cwiseSqrt() / (2.0 * std::numbers::pi);
}

Eigen::MatrixXd full(const SparseMatrix& lower) {
  const Eigen::MatrixXd dense = lower;
  return dense.selfadjointView<Eigen::Lower>();
}

BuiltModel build_all(mesh::Mesh mesh, const std::string& toml) {
  set_quiet(true);
  const Config config = Config::parse(toml, "test.fe.toml");
  const Recipe recipe = read_recipe(config, mesh);
  StepClock clock;
  return build_fe_model(mesh, recipe, clock);
}

BuiltModel build(const mesh::Mesh& mesh, const std::string& toml) {
  std::string regions;
  for (const std::string& region : mesh.regions) regions += "\"" + region + "\", ";
  const std::string steel =
      "[material.steel]\nregions = [" + regions + "]\nE_gpa = 210.0\nnu = 0.3\nrho = 7800.0\n";
  return build_all(mesh, steel + toml);
}

}  // namespace clatter::assembly::testing
