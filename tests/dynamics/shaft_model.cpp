// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/shaft_model.hpp"

#include <cmath>
#include <numbers>

#include "core/dense/complex.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "tests/dynamics/fixtures.hpp"

namespace clatter::dynamics::testing {

ShaftModelOf::ShaftModelOf(const std::string& text) {
  const Config root = Config::parse(text, "shaft.toml");
  for (const Config& table : root.tables("shaft")) shafts.emplace_back(read_shaft(root, table));
  root.finish();
  for (ShaftComponent& shaft : shafts) shaft.add_bodies(builder);
  for (ShaftComponent& shaft : shafts) shaft.add_elements(builder);
}

LinearMotion linearised(System& system, const Eigen::VectorXd& y, const Eigen::VectorXd& v) {
  const int n = system.interface_size();
  LinearMotion motion{Eigen::VectorXd(n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  StageState state;
  state.eta = state.v = Eigen::VectorXd::Zero(system.modes());
  state.y = y;
  state.v_y = v;
  for (int i = 0; i < n; ++i) motion.M(i) = 1.0 / testing::inverse_mass(system, i, state);
  Eigen::VectorXd f;
  // df/dy alone, then with df/dv / kappa.
  for (const double kappa : {1e300, 1.0}) {
    const Stage stage{0.0, kappa, 1, {}};
    system.evaluate(stage, y, v, true, f);
    Eigen::MatrixXd& sum = kappa > 1.0 ? motion.K : motion.C;
    for (int e = 0; e < system.elements(); ++e) {
      const Response& response = system.response(e);
      for (size_t g = 0; g < system.groups(e).size(); ++g) {
        const bool whole = !system.has_groups(e);
        if (whole || response.blocks[g].active)
          sum(system.groups(e)[g], system.groups(e)[g]) -=
              whole ? response.tangent : response.blocks[g].values;
      }
    }
  }
  motion.C -= motion.K;
  return motion;
}

Eigen::VectorXd frequencies(System& system, int rigid) {
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(system.interface_size());
  const LinearMotion motion = linearised(system, rest, rest);
  const Eigen::VectorXd root = motion.M.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = root.asDiagonal() * motion.K * root.asDiagonal();
  const Eigen::VectorXd values = dense::symmetric_eigen(scaled, dense::EigenParts::kValues).values;
  const Eigen::Index count = scaled.rows() - rigid;
  return values.tail(count).cwiseSqrt() / (2.0 * std::numbers::pi);
}

Eigen::VectorXcd eigenvalues(const LinearMotion& motion) {
  const Eigen::Index n = motion.M.size();
  const auto inverse = motion.M.cwiseInverse().asDiagonal();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -(inverse * motion.K);
  A.bottomRightCorner(n, n) = -(inverse * motion.C);
  return dense::eigenvalues(A);
}

std::string steel_shaft(const std::string& more) {
  return "[[shaft]]\nname = \"shaft\"\n" + more +
         "[[shaft.section]]\nfrom_mm = 0\nto_mm = 330\ndiameter_mm = 24\n";
}

}  // namespace clatter::dynamics::testing
