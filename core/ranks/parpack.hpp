// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// ARPACK with the rows of its vectors spread over all ranks (Maschhoff and Sorensen 1996).
#include "core/ranks/ranks.hpp"
#include "core/sparse/eigen/arpack_solver.hpp"

namespace clatter::ranks {

class ParpackRoutines : public sparse::ArpackRoutines {
 public:
  explicit ParpackRoutines(const Ranks& ranks) : all_(ranks.fortran_handle()) {}
  void iterate(sparse::ArpackArrays& arrays) const override;  // pdsaupd
  void extract(sparse::ArpackArrays& arrays) const override;  // pdseupd

 private:
  int all_;
};

}  // namespace clatter::ranks
