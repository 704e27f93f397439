// SPDX-License-Identifier: GPL-3.0-or-later
// assemble_mesh FILE.mesh.h5 [hrz]: assembles K and M of a mesh of steel and prints DoFs, cells,
// seconds of the pattern, seconds of K and M, and the bytes of both matrices.
#include <fmt/format.h>

#include <string_view>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fe/assemble.hpp"
#include "core/mesh/mesh_file.hpp"

namespace {

int64_t bytes(const clatter::SparseMatrix& A) {
  return A.nonZeros() * static_cast<int64_t>(sizeof(double) + sizeof(int32_t));
}

}  // namespace

int main(int argc, char** argv) {
  using namespace clatter;
  return run_guarded("assemble_mesh", [&] {
    if (argc < 2) throw InputError("expected a mesh file");
    const auto form = argc > 2 && std::string_view(argv[2]) == "hrz" ? fe::MassForm::kHrz
                                                                     : fe::MassForm::kConsistent;
    const mesh::Mesh mesh = mesh::read_mesh(argv[1]);
    fe::Material steel;
    steel.youngs = 2.1e11;
    steel.poisson = 0.3;
    steel.density = 7850.0;
    const std::vector<fe::Material> materials(mesh.regions.size(), steel);
    const Stopwatch pattern_watch;
    const fe::NodePattern pattern = fe::node_pattern(mesh);
    const double pattern_s = pattern_watch.seconds();
    const Stopwatch watch;
    const fe::NodalMatrices matrices = fe::assemble(mesh, materials, pattern, form);
    fmt::print("{} {} {:.3f} {:.3f} {}\n", 3 * mesh.nodes.rows(), mesh.cell_count(), pattern_s,
               watch.seconds(), bytes(matrices.K) + bytes(matrices.M));
    return 0;
  });
}
