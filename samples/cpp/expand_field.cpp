// SPDX-License-Identifier: GPL-3.0-or-later
// Expands the static response of a reduced part to its skin.
//   expand_field part.rom.h5 load          a load of the model, on a part that is supported
#include <Eigen/Cholesky>
#include <cstdio>
#include <exception>

#include "core/base/error.hpp"
#include "core/rom/reduced_model.hpp"
#include "recover/field/expand.hpp"

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: expand_field part.rom.h5 load\n", stderr);
    return 2;
  }
  try {
    const auto model = clatter::rom::read_reduced_model(argv[1]);
    const auto load = model.loads.find(argv[2]);
    if (load == model.loads.end())
      throw clatter::InputError(std::string("no load named ") + argv[2]);
    const Eigen::MatrixXd q = model.K_rr.ldlt().solve(load->second);

    const clatter::rom::SkinRows T(model.skin.T);
    clatter::recover::expand(T, q, {T.rows(), 1}, [&](int64_t, int64_t, const Eigen::MatrixXd& u) {
      Eigen::Index node = 0;
      const double largest = u.reshaped(3, u.size() / 3).colwise().norm().maxCoeff(&node);
      const Eigen::RowVector3d at = model.skin.nodes.row(node);
      std::printf("largest displacement %.6g m per unit load, at (%.4g, %.4g, %.4g) m\n", largest,
                  at[0], at[1], at[2]);
    });
  } catch (const std::exception& error) {
    std::fprintf(stderr, "expand_field: %s\n", error.what());
    return 2;
  }
}
