// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/predict/predicted_cost.hpp"

#include <algorithm>
#include <ctime>
#include <numeric>

#include "condense/basis/dof_partition.hpp"
#include "core/base/blas_kernel.hpp"
#include "core/base/h5_file.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fe/stored_pattern.hpp"
#include "core/sparse/dense_product.hpp"

namespace clatter::condense {
namespace {

// Measured with MUMPS 5.5.1 on the block of the truck diesel, by bench/predict_ranks.py
// (docs/accuracy.md).
constexpr double kShareOfProduct = 0.3;  // of a factorisation's flops, in those of a product
constexpr double kSolveShare = 0.75;     // of a solve's flops, in those of a factorisation
constexpr double kWorkspace = 1.3;       // ICNTL(14) = 30 of MUMPS
constexpr double kBuffers = 4.0;         // [GiB] at most: messages are counted in 32 bits
constexpr double kModelBytes = 400.0;    // of a DoF on every rank
constexpr double kPatternBytes = 16.0;   // of an entry of K, in MUMPS's analysis on rank 0
constexpr double kColumns = 64.0;        // right-hand sides of a solve

template <class Value>
double most(const std::vector<sparse::RankLoad>& load, Value sparse::RankLoad::*value) {
  double most = 0.0;
  for (const sparse::RankLoad& one : load) most = std::max(most, one.*value);
  return most;
}

/// Of a product of two matrices by one thread [1e9/s]; the best of four, by processor seconds.
double measured_product_gflops() {
  constexpr int kSize = 768;
  const BlasThreads one(1);
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(kSize, kSize);
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(kSize, kSize);
  double best = 0.0;
  for (int run = 0; run < 4; ++run) {
    const std::clock_t begin = std::clock();
    sparse::add_product(1.0, A, A, C);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    best = std::max(best, 2e-9 * kSize * kSize * kSize / std::max(seconds, 1e-3));
  }
  return best;
}

int64_t stored_entries(const std::filesystem::path& path, const std::string& group) {
  return H5File::open(path).shape(group + "/indices").at(0);
}

}  // namespace

double PredictedCost::most_flops() const { return most(load, &sparse::RankLoad::flops); }

double PredictedCost::factor_gib() const {
  const auto front = static_cast<double>(largest_front);
  const double buffers =
      ranks() > 1 ? std::min(2.0 * gib_of_doubles(front * front), kBuffers) : 0.0;
  return kWorkspace * gib_of_doubles(most(load, &sparse::RankLoad::peak)) + buffers;
}

double PredictedCost::matrices_gib() const {
  // Rows of both triangles: 16 bytes as read, 12 in each of two products; MUMPS gets 16 bytes of
  // each entry of one triangle and keeps as many.
  const double both = 2.0 * static_cast<double>(K_entries + M_entries);
  return (40.0 * both + 32.0 * static_cast<double>(K_entries)) / ranks() / kBytesPerGib;
}

double PredictedCost::model_gib() const {
  return kModelBytes * static_cast<double>(size + boundary) / kBytesPerGib;
}

double PredictedCost::analysis_gib() const {
  return std::max(count_gib, matrices_gib() + model_gib() +
                                 kPatternBytes * static_cast<double>(K_entries) / kBytesPerGib);
}

double PredictedCost::sent_gib() const {
  double sum = 0.0;
  for (const sparse::RankLoad& one : load) sum += one.sent;
  return gib_of_doubles(sum);
}

double PredictedCost::factor_seconds() const { return most_flops() / (1e9 * gflops); }

double PredictedCost::solve_seconds() const {
  return 4e-9 * kColumns * most(load, &sparse::RankLoad::entries) / (kSolveShare * gflops);
}

PredictedCost predict_cost(const CostRequest& request) {
  const Stopwatch clock;
  const fe::FeModel model = fe::read_fe_model(request.model, fe::FeMatrices::kLeftOut);
  fe::require_unknowns(model, "a reduction");
  DofPartition dofs;
  if (request.boundary.empty()) {
    dofs.interior.resize(model.size());
    std::iota(dofs.interior.begin(), dofs.interior.end(), 0);
  } else {
    dofs = partition_dofs(model, request.boundary);
  }
  PredictedCost out;
  out.K_entries = stored_entries(request.model, "K");
  out.M_entries = stored_entries(request.model, "M");
  const fe::StiffnessPattern K =
      fe::read_stiffness_pattern(request.model, dofs.interior, dofs.boundary);
  const sparse::FrontSizes fronts = sparse::count_fronts(K.ii, K.ib);
  out.size = fronts.size;
  out.boundary = fronts.boundary;
  out.ordering = fronts.ordering;
  out.entries = static_cast<double>(fronts.entries());
  out.flops = fronts.flops();
  out.largest_front = *std::max_element(fronts.height.begin(), fronts.height.end());
  out.load = sparse::map_to_ranks(fronts, request.ranks);
  out.count_gib = static_cast<double>(peak_memory_bytes()) / kBytesPerGib;
  out.count_seconds = clock.seconds();
  out.gflops = request.gflops;
  if (out.gflops <= 0.0) {
    out.product_gflops = measured_product_gflops();
    out.gflops = kShareOfProduct * out.product_gflops;
  }
  return out;
}

}  // namespace clatter::condense
