// modes_below model.fe.h5 threads hz...: how many modes lie below each frequency, by the inertia of
// K - mu M, one a line.
#include <fmt/format.h>

#include <cstdlib>

#include "assembly/fe_model.hpp"
#include "core/blas_kernel.hpp"
#include "core/error.hpp"
#include "core/threads.hpp"
#include "modal/eigen/mode_values.hpp"
#include "modal/factor/inertia.hpp"

namespace {

int run(int argc, char** argv) {
  if (argc < 4) throw clatter::InputError("expected model.fe.h5 threads hz...");
  clatter::set_thread_count(std::atoi(argv[2]));
  const auto model = clatter::assembly::read_fe_model(argv[1]);
  for (int k = 3; k < argc; ++k) {
    const double mu = clatter::modal::value_of_hz(std::atof(argv[k]));
    fmt::print("{}\n", clatter::modal::count_below(model.K, model.M, mu).negative);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  clatter::ensure_fast_blas(argv);
  return clatter::run_guarded("modes_below", [&] { return run(argc, argv); });
}
