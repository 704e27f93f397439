// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-condense-mpi: clatter-condense by several processes, for parts that outgrow one.
#include "condense/ranks/shared_condense.hpp"
#include "core/base/blas_kernel.hpp"

int main(int argc, char** argv) {
  using namespace clatter;
  ensure_fast_blas(argv);
  constexpr const char* kProgram = "clatter-condense-mpi";
  return ranks::run_ranks(kProgram, argc, argv, [&](const ranks::Ranks& all) {
    CommandLine program(
        kProgram, "clatter-condense by several processes, for parts that outgrow one.",
        "samples: mpirun -n 4 clatter-condense-mpi block.fe.h5 -c block.rom.toml -o block.rom.h5");
    condense::declare_condense(program, condense::shared_source(all));
    return program.run_or_throw(argc, argv);
  });
}
