// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-assembly: from a mesh to sparse mass and stiffness matrices.
#include "assembly/assemble.hpp"
#include "core/base/blas_kernel.hpp"
#include "core/base/command_line.hpp"
#include "core/base/log.hpp"
#include "core/base/write_artefact.hpp"
#include "core/keys/describe.hpp"

namespace {

constexpr const char* kEpilog = R"(Sample:
  clatter-assembly block.mesh.h5 -c block.fe.toml -o block.fe.h5

The smallest fe.toml has a material for each region of the mesh:
  [material.cast_iron]
  regions = ["block"]
  E_gpa = 110.0        # or E [Pa]
  nu = 0.26
  rho = 7200.0         # [kg/m3]
Matrices that another program assembled, instead of all these tables:
  [matrices]
  K = "stiffness.mtx"  # Matrix Market, or lines "i j value" as Abaqus writes
  M = "mass.mtx"
  dofs = "dofs.tsv"    # meaning of each row (docs/formats.md); default: x y z of the mesh's nodes
  units = "mm-t-s"     # of K and M, default "m-kg-s"
Parts that were reduced before stand in an assembly with [[part]], beside a mesh or alone:
  clatter-assembly -c engine.fe.toml -o engine.fe.h5
  [[part]]
  name = "pan"
  file = "pan.rom.h5"  # its set "flange" is the surface and node set "pan_flange" here
  [[tie]]              # or [[gasket]], [[spring]], [[coupling]], [[equation]]
  slave = "pan_flange"
  master = "block_pan_face"
clatter-assembly keys prints every key; samples/truck_diesel/block.fe.toml is a complete sample.
Next: clatter-modal block.fe.h5 (modes), clatter-modal statics block.fe.h5 (load cases),
 clatter-condense block.fe.h5 -c block.rom.toml -o block.rom.h5)";

struct Arguments {
  std::filesystem::path mesh, config, output;
};

void assemble_part(const Arguments& a, const clatter::CommonOptions& common) {
  using namespace clatter;
  StepClock clock;
  const assembly::AssembledPart part = assembly::assemble(a.mesh, a.config, clock);
  for (const std::string& line : assembly::describe(part.built.model)) print_result(line);
  write_artefact(a.output, part.provenance, clock, common, [&](H5File& file) {
    fe::write_fe_model(file, part.built.model);
    write_certificate(file, part.built.certificate);
    clock.lap("write");
  });
  print_json_result(a.output, assembly::json_of(part.built.model), clock, common);
}

}  // namespace

int main(int argc, char** argv) {
  clatter::ensure_fast_blas(argv);
  clatter::CommandLine line("clatter-assembly",
                            "Assembles a part's mass and stiffness matrices, adds couplings, "
                            "supports and contact patches, and builds unit load cases.",
                            kEpilog);
  Arguments a;
  line.positional(
      "mesh", a.mesh,
      "mesh of the part (.mesh.h5); none with [matrices] and dofs, or with [[part]] alone", false);
  line.option("-c,--config", a.config, "materials, couplings, sets, loads (.fe.toml)", true);
  line.output("-o,--output", a.output, "the model to write (.fe.h5)", true);
  line.blas();
  line.memory_limit("a temperature field ([[heat]]) is refused when it cannot be");
  clatter::keys::add_keys_command(line, {&clatter::recipe::file_keys().table()});
  line.action([&a](const clatter::CommonOptions& common) { assemble_part(a, common); });
  return line.run(argc, argv);
}
