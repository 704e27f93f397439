// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-modal-mpi: the modes of clatter-modal by several processes, for parts that outgrow one.
#include "core/base/blas_kernel.hpp"
#include "modal/ranks/shared_modes.hpp"

int main(int argc, char** argv) {
  using namespace clatter;
  ensure_fast_blas(argv);
  constexpr const char* kProgram = "clatter-modal-mpi";
  return ranks::run_ranks(kProgram, argc, argv, [&](const ranks::Ranks& all) {
    CommandLine program(
        kProgram, "Modes of an assembled part by several processes, for parts that outgrow one.",
        "samples: mpirun -n 4 clatter-modal-mpi block.fe.h5 --fmax-hz 2000 -o block.modes.h5");
    modal::declare_modes(program, modal::shared_finder(all));
    return program.run_or_throw(argc, argv);
  });
}
