// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/cad_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "mesh/cad/gmsh_defeature.hpp"

namespace clatter::mesh {
namespace {

constexpr double kBoxTolerance = 0.01;  // a wrong unit gives a factor of at least 2.54

void check_box(GmshSession& session, const CadParameters& p, const std::string& unit) {
  if (!p.expected_box) return;
  const Eigen::Vector3d& expected = *p.expected_box;
  const BoxFilter box = session.extent();
  const Eigen::Vector3d found = box.max - box.min;
  for (int d = 0; d < 3; ++d) {
    if (std::abs(found[d] - expected[d]) <= kBoxTolerance * expected[d]) continue;
    throw InputError(fmt::format(
        "{}: found a part of {:.6g} x {:.6g} x {:.6g} {}, expected {:.6g} x {:.6g} x {:.6g}: is "
        "the file in another unit?",
        p.where_box, found[0], found[1], found[2], unit, expected[0], expected[1], expected[2]));
  }
}

Solids without_small_features(GmshSession& session, const Solids& solids, double below,
                              const std::string& unit) {
  const Defeatured d = defeature(session, solids, below);
  say(fmt::format(
      "mesh: {} faces are narrower than {:g} {}; after their removal and merging of "
      "faces {} of {} faces remain; volume {:+.3g} %, box {:.6g} x {:.6g} x "
      "{:.6g} {} (before {:.6g} x {:.6g} x {:.6g})",
      d.narrow_faces, below, unit, d.faces_after, d.faces_before,
      100.0 * (d.volume_after / d.volume_before - 1.0), d.box_after.x(), d.box_after.y(),
      d.box_after.z(), unit, d.box_before.x(), d.box_before.y(), d.box_before.z()));
  if (!d.kept.empty()) {
    const auto& [width, position] = d.kept.front();
    warn(
        fmt::format("mesh: {} narrow faces are kept, as their neighbours do not meet: "
                    "{:.3g} {} wide at ({:.5g}, {:.5g}, {:.5g}){}",
                    d.kept.size(), width, unit, position.x(), position.y(), position.z(),
                    d.kept.size() > 1 ? ", ..." : ""));
  }
  return d.solids;
}

// Ordered by position, as import tags are arbitrary.
Solids in_order(const GmshSession& session, Solids solids) {
  std::sort(solids.begin(), solids.end(), [&](Solid a, Solid b) {
    const Eigen::Vector3d p = session.centre(a), q = session.centre(b);
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  });
  return solids;
}

// Joins the solids at shared faces and records their original volumes.
std::vector<CadSolid> join_solids(GmshSession& session, const Solids& solids, double within) {
  std::vector<CadSolid> known;
  for (size_t i = 0; i < solids.size(); ++i) {
    CadSolid solid{session.name_of(solids[i]), i + 1, solids.size(), session.centre(solids[i])};
    solid.volume = session.volume({solids[i]});
    if (within > 0.0) solid.slack = within * session.area({solids[i]});
    known.push_back(std::move(solid));
  }
  const std::vector<Solids> pieces = session.join(solids, within);
  for (size_t i = 0; i < solids.size(); ++i) {
    known[i].pieces = pieces[i];
    known[i].joined = session.volume(pieces[i]);
  }
  return known;
}

}  // namespace

const keys::Keys<CadParameters>& cad_keys() {
  static const keys::Keys<CadParameters> keys(
      "cad", "a part of a CAD program", [](auto& key, CadParameters& p) {
        key.path("source", p.source, "STEP, BREP or IGES file").required();
        key.text("region", p.region, "name of the region; NAME_1, NAME_2, ... of several solids");
        key.vector("expected_box", p.expected_box, Range::positive(),
                   "size of the part within 1 %, against a wrong unit")
            .shown_in("length_unit");
        key.number("volume_tolerance", p.volume_tolerance, {0.0, 1.0, true},
                   "largest relative error of the volume of each of several solids in the mesh");
        key.number("defeature_below", p.defeature_below, Range::not_negative(),
                   "narrower faces are removed: fillets, chamfers, tiny holes")
            .shown_in("length_unit");
        key.number("join_within", p.join_within, Range::not_negative(),
                   "faces of different solids that are nearer become one")
            .shown_in("length_unit");
        key.check([](const Config& table, CadParameters& c) {
          c.where_box = table.where("expected_box");
          if (table.has("join_within")) c.where_join = table.where("join_within");
        });
      });
  return keys;
}

PartGeometry build_cad(GmshSession& session, const CadParameters& p, const std::string& unit) {
  Solids solids = session.import_cad(p.source, unit);
  if (p.defeature_below > 0.0)
    solids = without_small_features(session, solids, p.defeature_below, unit);
  if (solids.size() < 2 && !p.where_join.empty())
    throw InputError(p.where_join +
                     ": found one solid, expected several whose faces are to be joined");
  PartGeometry part;
  part.volume_tolerance = p.volume_tolerance;
  if (solids.size() > 1) {
    part.cad_solids = join_solids(session, solids, p.join_within);
    Solids pieces;
    for (const CadSolid& solid : part.cad_solids)
      pieces.insert(pieces.end(), solid.pieces.begin(), solid.pieces.end());
    std::sort(pieces.begin(), pieces.end());
    pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
    solids = in_order(session, pieces);
  }
  check_box(session, p, unit);
  for (size_t i = 0; i < solids.size(); ++i) {
    const std::string name = solids.size() == 1 ? p.region : fmt::format("{}_{}", p.region, i + 1);
    part.regions.push_back({name, {solids[i]}});
  }
  return part;
}

}  // namespace clatter::mesh
