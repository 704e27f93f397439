// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-condense: reduces an assembled part to boundary coordinates and modes.
#include "condense/add_rows_command.hpp"
#include "condense/condense.hpp"
#include "condense/condense_command.hpp"
#include "condense/export_command.hpp"
#include "condense/predict_command.hpp"
#include "core/base/blas_kernel.hpp"
#include "core/base/command_line.hpp"
#include "core/keys/describe.hpp"

int main(int argc, char** argv) {
  using namespace clatter;
  ensure_fast_blas(argv);
  CommandLine program(
      "clatter-condense",
      "Reduces an assembled part by Craig-Bampton, Craig-Chang or Guyan and certifies the result.",
      "samples: clatter-condense block.fe.h5 -c block.rom.toml -o block.rom.h5\n"
      "         clatter-condense piston.fe.h5 -c piston.rom.toml -o piston.rom.h5 --json\n"
      "         clatter-condense export block.rom.h5 block.mtx\n"
      "         clatter-condense add-rows block.fe.h5 --of block.rom.h5 --surface liner_2_bore "
      "--set sensor_x -o block2.rom.h5\n"
      "         clatter-condense predict block.fe.h5 -c block.rom.toml --ranks 32");
  condense::declare_condense(program);
  condense::declare_export(program);
  condense::declare_add_rows(program);
  condense::declare_predict(program);
  keys::add_keys_command(program, {&condense::condense_keys().table()});
  program.moved("--export", "clatter-condense export REDUCED FILE ...");
  program.moved("--add-rows",
                "clatter-condense add-rows MODEL --of REDUCED --surface NAME --set NAME -o OUTPUT");
  return program.run(argc, argv);
}
