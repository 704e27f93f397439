// SPDX-License-Identifier: GPL-3.0-or-later
// Responses of a reduced body besides its frequencies (hard case B2), its number of rigid motions
// (B4), and the location of an unconnected part (C1).
#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "condense/condense.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/dense/complex.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "tests/condense/box_model.hpp"
#include "tests/observed.hpp"

namespace clatter::condense {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using test::box_model;

/// A box whose fixed-interface modes number 50, 100 and 200 end at 3.5, 4.6 and 5.8 kHz.
fe::FeModel heavy_box() {
  fe::FeModel model = box_model(10, 6, 6);
  model.M *= 3.0;
  model.mass.mass *= 3.0;
  model.mass.inertia *= 3.0;
  model.alpha = 1e-6;
  model.beta = 200.0;
  return model;
}

rom::ReducedModel reduce_for_response(const fe::FeModel& model, int count, double frequency_error) {
  CondenseOptions options;
  options.boundary = {"left", "right", "point"};
  options.modes.count = count;
  options.modes.frequency_error = frequency_error;
  set_quiet(true);
  StepClock clock;
  return condense(model, options, clock);
}

/// Responses of a body, held at its boundary, to the load "pull" at each frequency: velocities of
/// the skin, one column a frequency, and the forces that hold the boundary.
struct Response {
  Eigen::MatrixXcd velocity, force;
};

Response respond(const MatrixXd& K, const MatrixXd& M, double alpha, double beta,
                 const VectorXd& load, const std::vector<int32_t>& held, const MatrixXd& T_skin,
                 const VectorXd& hz) {
  std::vector<int32_t> left;
  for (int32_t dof = 0; dof < K.rows(); ++dof) {
    if (std::find(held.begin(), held.end(), dof) == held.end()) left.push_back(dof);
  }
  Response out{Eigen::MatrixXcd(T_skin.rows(), hz.size()),
               Eigen::MatrixXcd(static_cast<Eigen::Index>(held.size()), hz.size())};
  for (Eigen::Index j = 0; j < hz.size(); ++j) {
    const std::complex<double> s(0.0, 2.0 * std::numbers::pi * hz[j]);
    const Eigen::MatrixXcd Z = (1.0 + alpha * s) * K + (s * s + beta * s) * M;
    const Eigen::MatrixXcd Z_ll = Z(left, left);
    const VectorXcd load_l = load(left);
    VectorXcd q = VectorXcd::Zero(K.rows());
    const VectorXcd moved = dense::solve_complex(Z_ll, load_l);
    q(left) = moved;
    out.velocity.col(j) = s * (T_skin * q);
    out.force.col(j) = (Z * q)(held)-load(held);
  }
  return out;
}

VectorXd band() { return VectorXd::LinSpaced(10, 300.0, 3000.0); }

Response full_response(const fe::FeModel& model, const RowMatrix& skin_nodes) {
  MatrixXd T_skin = MatrixXd::Zero(3 * skin_nodes.rows(), model.size());
  for (Eigen::Index a = 0; a < skin_nodes.rows(); ++a) {
    Eigen::Index node = 0;
    (model.nodes.rowwise() - skin_nodes.row(a)).rowwise().norm().minCoeff(&node);
    T_skin.block<3, 3>(3 * a, 3 * node).setIdentity();  // the box's DoFs are its displacements
  }
  return respond(sparse::dense_symmetric(model.K), sparse::dense_symmetric(model.M), model.alpha,
                 model.beta, model.loads.at("pull"), model.sets.at("left").dofs, T_skin, band());
}

Response reduced_response(const rom::ReducedModel& reduced) {
  return respond(reduced.K_rr, reduced.M_rr, reduced.alpha, reduced.beta, reduced.loads.at("pull"),
                 reduced.set("left").dofs, reduced.skin.T, band());
}

/// Root mean square of the difference over the band and all rows, over that of the response.
double error_of(const Eigen::MatrixXcd& found, const Eigen::MatrixXcd& expected) {
  return (found - expected).norm() / expected.norm();
}

TEST(HardB2, SurfaceVelocityAndForcesTo3KilohertzConvergeWithTheModes) {
  const fe::FeModel model = heavy_box();
  const Response full = full_response(model, reduce_for_response(model, 50, 0.0).skin.nodes);
  double velocity = 1.0, force = 1.0;
  for (const int count : {50, 100, 200}) {
    const Response plain = reduced_response(reduce_for_response(model, count, 0.0));
    const double v = error_of(plain.velocity, full.velocity);
    const double f = error_of(plain.force, full.force);
    EXPECT_LT(v, 0.5 * velocity) << count;
    EXPECT_LT(f, 0.5 * force) << count;
    const Response corrected =
        reduced_response(reduce_for_response(model, count, 5e-4));  // residual modes
    EXPECT_LT(error_of(corrected.velocity, full.velocity), v) << count;
    EXPECT_LT(error_of(corrected.force, full.force), f) << count;
    velocity = v;
    force = f;
  }
  // The usual requirement for an FRF is 0.1 dB, 1.2 %; forces at the boundary get the static part.
  test::expect_at_most("error of the velocity with all modes", velocity, 1.2e-2);
  test::expect_at_most("error of the force with all modes", force, 2e-3);
}

TEST(HardB4, ExactlySixEigenvaluesVanish) {
  const fe::FeModel model = box_model();
  for (const int count : {1, 25}) {
    const rom::ReducedModel reduced = reduce_for_response(model, count, 5e-4);
    const VectorXd values =
        dense::symmetric_eigen(reduced.K_rr, reduced.M_rr, dense::EigenParts::kValues).values;
    // Rounding of a dense solver is eps of the largest, 1e4 times the first elastic value.
    EXPECT_LT(values.head(6).cwiseAbs().maxCoeff(), 1e-9 * values[6]);
    EXPECT_GT(values[6], 1e-6 * values.tail(1)[0]);
  }
}

/// The box and two masses that are connected only to each other.
fe::FeModel with_loose_pair(const fe::FeModel& box) {
  fe::FeModel model = box;
  const int n = box.size(), all = n + 6;
  std::vector<Eigen::Triplet<double>> stiffness, mass, identity;
  for (int j = 0; j < n; ++j) {
    for (SparseMatrix::InnerIterator it(box.K, j); it; ++it)
      stiffness.emplace_back(static_cast<int>(it.row()), j, it.value());
    for (SparseMatrix::InnerIterator it(box.M, j); it; ++it)
      mass.emplace_back(static_cast<int>(it.row()), j, it.value());
  }
  for (int d = 0; d < 3; ++d) {
    stiffness.emplace_back(n + d, n + d, 1e8);
    stiffness.emplace_back(n + 3 + d, n + 3 + d, 1e8);
    stiffness.emplace_back(n + 3 + d, n + d, -1e8);
  }
  for (int j = n; j < all; ++j) mass.emplace_back(j, j, 0.05);
  model.K = test::from_triplets(all, stiffness);
  model.M = test::from_triplets(all, mass);
  model.T.resize(all, all);
  model.T.setIdentity();
  const Eigen::Index nodes = box.nodes.rows();
  model.nodes.conservativeResize(nodes + 2, Eigen::NoChange);
  model.nodes.row(nodes) << 0.7, 0.8, 0.9;
  model.nodes.row(nodes + 1) << 0.71, 0.8, 0.9;
  model.rigid.conservativeResize(all, Eigen::NoChange);
  for (Eigen::Index a = nodes; a < nodes + 2; ++a) {
    const Eigen::RowVector3d r = model.nodes.row(a);
    model.rigid.block<3, 3>(3 * a, 0).setIdentity();
    model.rigid.block<3, 3>(3 * a, 3) << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  }
  model.loads.clear();
  model.load_units.clear();
  return model;
}

TEST(HardC1, APartThatHangsOnNothingIsNamedByItsNode) {
  const fe::FeModel model = with_loose_pair(box_model());
  const Eigen::Index loose = model.nodes.rows() - 2;
  try {
    (void)reduce_for_response(model, 10, 0.0);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string text = error.what();
    const bool first = text.find("node " + std::to_string(loose)) != std::string::npos;
    const bool second = text.find("node " + std::to_string(loose + 1)) != std::string::npos;
    EXPECT_TRUE(first || second) << text;
    EXPECT_NE(text.find("0.8, 0.9"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace clatter::condense
