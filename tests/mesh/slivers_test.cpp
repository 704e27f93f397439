// SPDX-License-Identifier: GPL-3.0-or-later
// CAD parts with slivers: meshed where their effect is small; refused with advice that works.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mesh/part/part_in_child.hpp"
#include "mesh/repair/poor_cells.hpp"
#include "sliver_parts.hpp"
#include "support.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using testing::Folder;

std::string sliver_toml(const std::filesystem::path& file, const std::string& cad = "") {
  return fmt::format(
      "name = 'part'\nkind = 'cad'\n[cad]\nsource = '{}'\n{}\n[mesh]\nelement_size_mm = 6\n",
      file.string(), cad);
}

MadePart make_sliver_part(const std::string& toml) {
  const PartFile part = part_keys().read(Config::parse(toml, "part.toml"));
  return make_part_in_child({&part, "part.toml", ""}, {});
}

TEST(HardG11Slivers, ARocketWithCuspsIsMeshedAndTheEffectOfItsSliversSaid) {
  const Folder folder;
  testing::write_rocket(folder / "rocket.step");
  const MadePart made = make_sliver_part(sliver_toml(folder / "rocket.step"));
  const MeshCertificate& c = made.part.certificate;
  EXPECT_EQ(made.part.mesh.regions.size(), 3u);
  EXPECT_LT(c.min_dihedral_deg, 1.0);
  EXPECT_GT(c.poor_cells.value(), 0.0);
  EXPECT_LT(c.poor_cells_most_effect.value(), kMostEffect);
}

TEST(HardG11Slivers, ABoltedFlangeWithAClearanceOfMicrometresIsRefusedWithAdviceThatWorks) {
  const Folder folder;
  testing::write_bolted_flange(folder / "flange.step");
  const std::string toml = sliver_toml(folder / "flange.step");
  const std::string said = test::refusal_of<NumericsError>([&] { make_sliver_part(toml); });
  test::expect_parts(said,
                     {"intersecting faces: ", "; this works, it was tried: [cad] ", " cells)"});
  const size_t from = said.find("[cad] ") + 6;
  const std::string advice = said.substr(from, said.find(" (", from) - from);
  EXPECT_EQ(advice, "join_within = 0.003");
  const MadePart made = make_sliver_part(sliver_toml(folder / "flange.step", advice));
  EXPECT_EQ(made.part.mesh.regions.size(), 3u);
  EXPECT_NE(said.find(fmt::format("({} cells)", made.part.mesh.cell_count())), std::string::npos);
}

TEST(HardG11Slivers, AFlangeWithSpotFacesOfMicrometresIsMeshed) {
  const Folder folder;
  testing::write_spot_faced_flange(folder / "spots.step");
  const MadePart made = make_sliver_part(sliver_toml(folder / "spots.step"));
  EXPECT_GT(made.part.certificate.poor_cells.value(), 0.0);
  EXPECT_LT(made.part.certificate.poor_cells_most_effect.value(), kMostEffect);
}

TEST(HardG11Slivers, JoiningNeedsSeveralSolids) {
  const Folder folder;
  testing::write_spot_faced_flange(folder / "spots.step");
  test::expect_parts(
      test::refusal_of(
          [&] { make_sliver_part(sliver_toml(folder / "spots.step", "join_within = 0.003")); }),
      {"join_within: found one solid, expected several whose faces are to be joined"});
}

}  // namespace
}  // namespace clatter::mesh
