// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/resumed_within.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "dynamics/run/run_file.hpp"
#include "tests/dynamics/slap_scene.hpp"

namespace clatter::dynamics::testing {
namespace {

bool is_group(const H5File& file, const std::string& name) {
  try {
    file.list(name);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

RunResult run_into(const Scene& scene, const LoadedBodies& bodies,
                   const std::filesystem::path& output, double checkpoint_seconds,
                   std::optional<Checkpoint> from) {
  RunControl control;
  control.output = output;
  control.checkpoint_seconds = checkpoint_seconds;
  control.resume_from = std::move(from);
  return simulate(scene, bodies, control);
}

}  // namespace

int expect_same_bits(const H5File& one, const H5File& other, const std::string& group) {
  EXPECT_EQ(one.list(group), other.list(group)) << group;
  int count = 0;
  for (const std::string& member : one.list(group)) {
    const std::string name = group + "/" + member;
    if (is_group(one, name)) {
      count += expect_same_bits(one, other, name);
      continue;
    }
    ++count;
    const auto shape = one.shape(name);
    EXPECT_EQ(shape, other.shape(name)) << name;
    if (shape.size() == 1) {
      EXPECT_EQ(one.read_doubles(name), other.read_doubles(name)) << name;
    } else if (shape.size() == 2) {
      EXPECT_EQ(one.read_rows(name), other.read_rows(name)) << name;
    }
  }
  return count;
}

Checkpoint expect_same_bits_when_resumed(const Scene& scene, const std::filesystem::path& folder) {
  const LoadedBodies bodies = load_bodies(scene);
  const auto saving = folder / "saving.run.h5", resumed = folder / "resumed.run.h5";
  RunResult plain = run_into(scene, bodies, folder / "plain.run.h5", 1e9, std::nullopt);
  EXPECT_FALSE(std::filesystem::exists(checkpoint_path(folder / "plain.run.h5")));
  RunResult whole = run_into(scene, bodies, saving, 0.0, std::nullopt);
  std::filesystem::copy_file(checkpoint_path(saving), checkpoint_path(resumed));
  const Checkpoint from = read_checkpoint(checkpoint_path(resumed), fingerprint(scene)).value();
  RunResult rest = run_into(scene, bodies, resumed, 1e9, from);
  EXPECT_EQ(rest.statistics.accepted, plain.statistics.accepted);
  const H5File expected = finished_file(scene, bodies, plain);
  for (RunResult* other : {&whole, &rest}) {
    EXPECT_EQ(run_certificate(*other), run_certificate(plain));
    EXPECT_EQ(other->warnings, plain.warnings);
    const H5File found = finished_file(scene, bodies, *other);
    EXPECT_EQ(expected.list("/"), found.list("/"));
    int equal = 0;
    for (const char* group : {"output", "history", "energy", "bodies", "chain"})
      equal += expect_same_bits(expected, found, group);
    EXPECT_GT(equal, 10);
  }
  return from;
}

}  // namespace clatter::dynamics::testing
