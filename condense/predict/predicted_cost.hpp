// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the condensation of a part over several processes will cost, from the graph of its matrices.
#include <filesystem>
#include <string>
#include <vector>

#include "core/sparse/factor/rank_mapping.hpp"

namespace clatter::condense {

struct CostRequest {
  std::filesystem::path model;        // .fe.h5
  std::vector<std::string> boundary;  // sets; empty: all DoFs are eliminated
  int ranks = 32;
  double gflops = 0.0;  // of one core in a factorisation [1e9/s]; 0: measured here
};

/// Counts, and what follows from them.
struct PredictedCost {
  int64_t size = 0, boundary = 0;  // DoFs eliminated, and retained
  std::string ordering;
  double entries = 0.0, flops = 0.0;     // of L, and of one factorisation; exact
  int64_t largest_front = 0;             // rows
  int64_t K_entries = 0, M_entries = 0;  // stored
  std::vector<sparse::RankLoad> load;    // of each rank
  double product_gflops = 0.0;           // of one core in a matrix product here; 0: not measured
  double gflops = 0.0;                   // of one core in a factorisation
  double count_gib = 0.0;                // peak of this process, which ordered as rank 0 does
  double count_seconds = 0.0;

  int ranks() const { return static_cast<int>(load.size()); }
  double most_flops() const;  // of a rank
  /// Memory of the rank with the most [GiB]: its part of L with fronts, update matrices and
  /// buffers; of K and M; of the model, which is on every rank.
  double factor_gib() const;
  double matrices_gib() const;
  double model_gib() const;
  double total_gib() const { return factor_gib() + matrices_gib() + model_gib(); }
  /// Of rank 0 while it orders, or while it analyses for all.
  double analysis_gib() const;
  double sent_gib() const;  // by all ranks, in one factorisation
  /// Wall time without that of messages: of the rank with the most operations, or entries of L.
  double factor_seconds() const;
  double solve_seconds() const;  // of 64 right-hand sides
};

/// Reads the model without its values, orders it as clatter-condense does, counts, and maps the
/// fronts to ranks. InputError as read_fe_model and partition_dofs.
PredictedCost predict_cost(const CostRequest& request);

}  // namespace clatter::condense
