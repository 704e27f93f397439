// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-modal: modes of a part, with a proof that none is missing; comparison of a reduced model
// with the full one; static solution of load cases.
#include "core/base/blas_kernel.hpp"
#include "core/base/command_line.hpp"
#include "core/keys/describe.hpp"
#include "core/modes/analysis.hpp"
#include "modal/compare_command.hpp"
#include "modal/export_command.hpp"
#include "modal/modes_command.hpp"
#include "modal/shape_command.hpp"
#include "modal/statics_command.hpp"

int main(int argc, char** argv) {
  using namespace clatter;
  ensure_fast_blas(argv);
  CommandLine program(
      "clatter-modal", "Modes of an assembled or reduced part, with a proof that none is missing.",
      "samples: clatter-modal block.fe.h5 --fmax-hz 2000 -o block.modes.h5\n"
      "         clatter-modal block.rom.h5 --count 40 -o block_rom.modes.h5\n"
      "         clatter-modal block.fe.h5 -o block.modes.h5 --export shapes.vtu\n"
      "         clatter-modal statics block.fe.h5 --case weight -o block.static.h5\n"
      "         clatter-modal shape block.static.h5 --surface liner_4_bore -o liner_4.shape.h5\n"
      "         clatter-modal compare block.fe.h5 block.rom.h5\n"
      "         clatter-modal export block.modes.h5 shapes.pvd --cells block.fe.h5");
  modal::declare_modes(program);
  modal::declare_statics(program);
  modal::declare_shape(program);
  modal::declare_compare(program);
  modal::declare_export(program);
  keys::add_keys_command(program, {&modes::modes_keys().table()});
  program.moved("--static", "clatter-modal statics MODEL -o OUTPUT");
  program.moved("--compare", "clatter-modal compare FULL REDUCED");
  return program.run(argc, argv);
}
