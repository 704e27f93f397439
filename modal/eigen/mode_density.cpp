#include "modal/eigen/mode_density.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/sparse.hpp"
#include "modal/factor/sweep_kernel.hpp"

namespace clatter::modal {
namespace {

constexpr int kSteps = 10;  // nodes of a quadrature
constexpr int kVectors = 2 * kLanes;

struct Node {
  double nu, weight;
};

using Eigen::MatrixXd;
using Columns = Eigen::Array<double, 1, kVectors>;

/// Recurrence coefficients of all vectors, side by side.
struct Recurrence {
  Eigen::Array<double, kSteps, kVectors> alpha, beta;
};

Recurrence lanczos(const SubtreeProduct& A, int64_t size, uint64_t seed) {
  std::mt19937_64 engine(seed);
  RowMatrix q(size, kVectors), before = RowMatrix::Zero(size, kVectors), x, z(size, kVectors);
  std::normal_distribution<double> normal;
  for (Eigen::Index i = 0; i < q.size(); ++i) q.data()[i] = normal(engine);
  q.array().rowwise() /= q.colwise().norm().array().eval();
  Recurrence out;
  Columns last = Columns::Zero();
  for (int step = 0; step < kSteps; ++step) {
    x = q;
    A.apply(A.whole(), x.data(), z.data(), kVectors, true);
    z.array() -= before.array().rowwise() * last;
    const Columns alpha = z.cwiseProduct(q).colwise().sum().array();
    z.array() -= q.array().rowwise() * alpha;
    last = z.colwise().norm().array();
    out.alpha.row(step) = alpha;
    out.beta.row(step) = last;
    before.swap(q);
    q = z.array().rowwise() / last.max(1e-300);
  }
  return out;
}

}  // namespace

double density_cut(const SubtreeProduct& A, int64_t size, double count, uint64_t seed) {
  const Recurrence found = lanczos(A, size, seed);
  std::vector<Node> nodes;
  Eigen::SelfAdjointEigenSolver<MatrixXd> solver;
  for (int v = 0; v < kVectors; ++v) {
    solver.computeFromTridiagonal(found.alpha.col(v).matrix(),
                                  found.beta.col(v).head(kSteps - 1).matrix());
    for (int k = 0; k < kSteps; ++k)
      nodes.push_back({solver.eigenvalues()[k], std::pow(solver.eigenvectors()(0, k), 2) *
                                                    static_cast<double>(size) / kVectors});
  }
  std::sort(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.nu > b.nu; });
  double above = 0.0, last_count = 0.0, last_nu = nodes.front().nu;
  for (const Node& node : nodes) {  // half of a node's weight lies on each side of it
    const double here = above + 0.5 * node.weight;
    if (here >= count && last_count > 0.0) {
      const double part = std::log(count / last_count) / std::log(here / last_count);
      return last_nu * std::pow(node.nu / last_nu, std::clamp(part, 0.0, 1.0));
    }
    if (here >= count || node.nu <= 0.0) break;
    above += node.weight;
    last_count = here;
    last_nu = node.nu;
  }
  return last_nu;
}

}  // namespace clatter::modal
