// SPDX-License-Identifier: GPL-3.0-or-later
// modes_below model.fe.h5 threads hz...: the number of modes below each frequency, by the inertia
// of K - mu M, one per line.
#include <fmt/format.h>

#include <cstdlib>

#include "core/base/blas_kernel.hpp"
#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "core/fe/fe_model.hpp"
#include "core/sparse/eigen/mode_values.hpp"
#include "core/sparse/factor/inertia.hpp"

namespace {

int run(int argc, char** argv) {
  if (argc < 4) throw clatter::InputError("expected model.fe.h5 threads hz...");
  clatter::set_thread_count(std::atoi(argv[2]));
  const auto model = clatter::fe::read_fe_model(argv[1]);
  for (int k = 3; k < argc; ++k) {
    const double mu = clatter::sparse::value_of_hz(std::atof(argv[k]));
    fmt::print("{}\n", clatter::sparse::count_below(model.K, model.M, mu).negative);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  clatter::ensure_fast_blas(argv);
  return clatter::run_guarded("modes_below", [&] { return run(argc, argv); });
}
