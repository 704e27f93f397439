// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-dynamics: runs a scene in the time domain.
#include "core/base/blas_kernel.hpp"
#include "core/base/command_line.hpp"
#include "core/keys/describe.hpp"
#include "dynamics/response_command.hpp"
#include "dynamics/run_command.hpp"
#include "dynamics/scene/registry.hpp"

namespace {

constexpr const char* kEpilog =
    R"(A scene is a TOML file: [engine] [rod] [piston] [block] [gas] [contact] [[mount]] for piston slap
([[cylinder]] for several), or [[body]] [[rigid_body]] [[drive]] [[bushing]] [[spring]] [[mount]]
[[load]] for any bodies and mechanisms without an engine. `base = "other.toml"` takes all
keys that a scene does not set from another scene, so a variant is a few lines:

    base = "slap.run.toml"
    [contact]
    lubrication = "none"
    [drive.crank]             # the base's [[drive]] of this name
    speed_rpm = 1000

clatter-dynamics keys contact prints the keys of a table; docs/dynamics has the equations and the error test. Ctrl-C or SIGTERM stops after a step with a valid
file, stem.run.interrupted.h5 (attribute complete = 0); --resume continues from the last finished cycle.

sample commands
  clatter-dynamics slap.run.toml -o slap.run.h5
  clatter-dynamics slap.run.toml -o slap.run.h5 --resume
  clatter-dynamics --effects slap.run.toml

see also: clatter motored-cycle (the pressure table of a motored engine), clatter-condense (makes .rom.h5),
clatter-recover (surface velocity from .run.h5))";

}  // namespace

int main(int argc, char** argv) {
  clatter::ensure_fast_blas(argv);
  clatter::CommandLine program(
      "clatter-dynamics",
      "Runs a scene of reduced elastic bodies, joints and a lubricated piston-liner contact in the "
      "time domain.",
      kEpilog);
  clatter::dynamics::declare_run(program);
  clatter::dynamics::declare_response(program);
  clatter::keys::add_keys_command(program, {&clatter::dynamics::scene_table()});
  program.moved("--write-motored-cycle", "clatter motored-cycle OUT.csv --bore-mm ...");
  return program.run(argc, argv);
}
