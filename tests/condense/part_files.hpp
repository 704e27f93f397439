// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Parts that are reduced to files, and assemblies of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>

#include "block_mesh.hpp"
#include "condense/condense.hpp"
#include "core/base/log.hpp"
#include "core/fe/fe_model.hpp"
#include "small_solver.hpp"
#include "tests/scratch.hpp"
#include "two_parts.hpp"

namespace clatter::condense::testing {

using assembly::testing::block_mesh;
using assembly::testing::brick;
using assembly::testing::build_all;
using assembly::testing::free_hz;
using Eigen::Vector3d;
using Eigen::VectorXd;
using mesh::CellType;

inline const std::string kIron = "E_gpa = 110.0\nnu = 0.26\nrho = 7200.0\n";
inline const std::string kAluminium = "E_gpa = 70.0\nnu = 0.33\nrho = 2700.0\n";

/// A box from `low` on, of `size` [m].
inline mesh::Mesh box(const Vector3d& low, const Vector3d& size, const std::array<int, 3>& n,
                      CellType type = CellType::kHex20) {
  return block_mesh(n, [=](const Vector3d& x) -> Vector3d { return low + x.cwiseProduct(size); },
                    {type, false, false});
}

inline mesh::Mesh block(const std::array<int, 3>& n, CellType type = CellType::kHex20) {
  return box({0.0, 0.0, 0.0}, {0.24, 0.1, 0.06}, n, type);
}

inline mesh::Mesh plate(const std::array<int, 3>& n, CellType type = CellType::kHex20) {
  return box({0.0, 0.0, 0.06}, {0.24, 0.1, 0.012}, n, type);
}

inline std::string material(const std::string& region, const std::string& of) {
  return "[material." + region + "]\nregions = [\"" + region + "\"]\n" + of;
}

inline std::string kept(const std::string& surface) {
  return "[[nodes]]\nname = \"joint\"\nsurface = \"" + surface + "\"\n";
}

/// The file of a part whose `surface` is kept as the set "joint".
inline std::filesystem::path reduced_file(const std::string& name, const fe::FeModel& model,
                                          CondenseOptions options) {
  set_quiet(true);
  StepClock clock;
  if (options.boundary.empty()) options.boundary = {"joint"};
  options.modes.frequency_error = 0.0;
  const std::filesystem::path path = test::scratch_path(name + ".rom.h5");
  H5File file = H5File::create(path);
  write_provenance(file, {rom::kRomSchema, "", {}});
  rom::write_reduced_model(file, condense(model, options, clock));
  file.commit();
  return path;
}

inline CondenseOptions below(double hz) {
  CondenseOptions options;
  options.modes.fmax_hz = hz;
  return options;
}

/// The reduction of an assembly to one of its sets.
inline rom::ReducedModel reduced_again(const fe::FeModel& engine, const std::string& set,
                                       CondenseOptions options) {
  set_quiet(true);
  StepClock clock;
  options.boundary = {set};
  return condense(engine, options, clock);
}

/// All modes of the interior: nothing is lost.
inline CondenseOptions complete(const fe::FeModel& model) {
  CondenseOptions options;
  options.modes.count = model.size() - static_cast<int>(model.set("joint").dofs.size());
  return options;
}

inline std::string part(const std::string& name, const std::filesystem::path& file,
                        const std::string& more = "") {
  return fmt::format("[[part]]\nname = \"{}\"\nfile = \"{}\"\n{}", name, file.string(), more);
}

inline const std::string kTie = "[[tie]]\nslave = \"plate_joint\"\nmaster = \"block_joint\"\n";

inline assembly::BuiltModel joined(const std::string& toml) {
  mesh::Mesh none;
  none.name = "engine";
  none.nodes.resize(0, 3);
  return build_all(none, toml);
}

inline fe::FeModel whole(const mesh::Mesh& a, const mesh::Mesh& b) {
  return build_all(assembly::testing::two_parts(a, b),
                   "[material.a]\nregions = [\"a\"]\n" + kIron +
                       "[material.b]\nregions = [\"b\"]\n" + kAluminium +
                       "[[tie]]\nslave = \"b_z0\"\nmaster = \"a_z1\"\n")
      .model;
}

struct TwoFiles {
  std::filesystem::path block, plate;
};

/// The blocks of shells-and-joining, 3.2.
inline TwoFiles coarse_parts(double hz, const std::array<int, 3>& plate_cells) {
  const fe::FeModel a = build_all(block({12, 5, 3}), material("body", kIron) + kept("z1")).model;
  const fe::FeModel b =
      build_all(plate(plate_cells), material("body", kAluminium) + kept("z0")).model;
  return {reduced_file("block", a, below(hz)), reduced_file("plate", b, below(hz))};
}

inline std::string gasket(double normal, double tangential,
                          const std::string& slave = "plate_joint",
                          const std::string& master = "block_joint") {
  return fmt::format(
      "[[gasket]]\nslave = \"{}\"\nmaster = \"{}\"\nnormal_stiffness = {:.1f}\n"
      "tangential_stiffness = {:.1f}\n",
      slave, master, normal, tangential);
}

/// Parts with all their modes, and the same parts in one mesh.
class CompleteParts : public ::testing::Test {
 protected:
  CompleteParts()
      : a_(build_all(block({4, 2, 2}, CellType::kHex8), material("body", kIron) + kept("z1"))
               .model),
        b_(build_all(plate({3, 2, 1}, CellType::kHex8), material("body", kAluminium) + kept("z0"))
               .model),
        files_{reduced_file("block", a_, complete(a_)), reduced_file("plate", b_, complete(b_))},
        whole_(whole(block({4, 2, 2}, CellType::kHex8), plate({3, 2, 1}, CellType::kHex8))) {}

  fe::FeModel a_, b_;
  TwoFiles files_;
  fe::FeModel whole_;
};

inline void expect_same_elastic(const VectorXd& found, const VectorXd& expected, double error) {
  ASSERT_EQ(found.size(), expected.size());
  for (Eigen::Index k = 6; k < found.size(); ++k)
    EXPECT_NEAR(found(k) / expected(k), 1.0, error) << k;
}

}  // namespace clatter::condense::testing
