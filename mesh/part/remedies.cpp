// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/part/remedies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/stopwatch.hpp"
#include "core/base/units.hpp"
#include "mesh/cad/gmsh_small_features.hpp"
#include "mesh/part/mesh_wire.hpp"

namespace clatter::mesh {

template <class Archive, SelfOf<SmallFeature> Self>
void wire(Archive& archive, Self& s) {
  auto& [size, position] = s;
  archive(size, position);
}

template <class Archive, SelfOf<SmallFeatures> Self>
void wire(Archive& archive, Self& s) {
  auto& [edges, faces, radii] = s;
  archive(edges, faces, radii);
}

namespace {

constexpr double kSmaller = 0.7, kLarger = 1.4;  // sizes that are tried, of the refused one
constexpr int kPerTurn = 12;
constexpr double kFarBelow = 0.2;  // features below this share of the size matter
constexpr double kCluster = 3.0;   // widths within this factor are removed together
constexpr double kWider = 1.5;     // than the widest of those

/// What matters for the choice of remedies.
struct PartFacts {
  SmallFeatures small;
  int64_t solids = 0;     // of a CAD file with several
  double coarsest = 0.0;  // larger sizes are reduced to it [part's unit]
};

template <class Archive, SelfOf<PartFacts> Self>
void wire(Archive& archive, Self& s) {
  auto& [small, solids, coarsest] = s;
  archive(small, solids, coarsest);
}

struct Remedy {
  std::string text;
  MeshSettings settings;
  double defeature_below = 0.0, join_within = 0.0;  // of [cad], where above 0
};

void be_silent() {
  set_log_sink([](bool, const std::string&) {});
}

// None when the geometry cannot be built.
std::optional<PartFacts> facts_of(const PartJob& job, double size, const ChildLimits& limits) {
  try {
    const ChildEnd end = run_in_child(limits, [&] {
      be_silent();
      GmshSession session(job.part->name);
      const PartGeometry part = build_part(session, job.part->shape);
      const std::vector<FaceFacts> faces = session.boundary_faces();
      return to_wire(PartFacts{find_small_features(session, faces, kFarBelow * size),
                               static_cast<int64_t>(part.cad_solids.size()),
                               kCoarsest * size_of_part(faces)});
    });
    if (!end.done()) return std::nullopt;
    return from_wire<PartFacts>(end.result);
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// The number of cells, if these settings give a mesh that is not refused.
std::optional<int64_t> cells_with(const PartJob& job, const Remedy& remedy,
                                  const ChildLimits& limits) {
  try {
    const ChildEnd end = run_in_child(limits, [&] {
      be_silent();
      PartShape shape = job.part->shape;
      if (remedy.defeature_below > 0.0) shape.cad.defeature_below = remedy.defeature_below;
      if (remedy.join_within > 0.0) shape.cad.join_within = remedy.join_within;
      const LengthUnit& unit = shape.unit;
      GmshSession session(job.part->name);
      const PartGeometry part = build_part(session, shape);
      const PartMesh made =
          mesh_part(session, part, remedy.settings, unit.metres, job.part->name, job.where);
      const QualityLimits aims = aims_of(remedy.settings);
      const std::string refusal =
          refusal_of_poor_cells(find_poor_cells(made.mesh, made.quality, aims), made.mesh, aims,
                                {unit.name, unit.metres}, remedy.settings.accept_poor_cells);
      return refusal.empty() ? std::to_string(made.mesh.cell_count()) : "";
    });
    if (!end.done() || end.result.empty()) return std::nullopt;
    return std::stoll(end.result);
  } catch (const Error&) {
    return std::nullopt;
  }
}

double two_digits(double value) { return rounded(value, 2); }

/// A width just above the narrowest faces and those of about their width; 0 without narrow faces.
double narrow_width(const std::vector<SmallFeature>& faces) {
  if (faces.empty()) return 0.0;
  double widest = faces.front().size;
  for (const SmallFeature& face : faces)
    if (face.size < kCluster * widest) widest = face.size;
  return two_digits(kWider * widest);
}

std::vector<Remedy> remedies_for(const PartJob& job, const MeshSettings& refused,
                                 const PartFacts& facts, double metres_per_unit) {
  std::vector<Remedy> list;
  const bool has_description = std::filesystem::path(job.where).extension() == ".toml";
  const char* where = has_description ? "" : ", in a description with kind = \"cad\"";
  const char* size =
      !has_description || job.element_size > 0.0 ? "--element-size-mm" : "element_size_mm =";
  const double narrow = narrow_width(facts.small.faces);
  const PartShape& shape = job.part->shape;
  if (shape.kind == "cad" && narrow > 0.0) {
    if (facts.solids > 1 && shape.cad.join_within == 0.0)
      list.push_back(
          {fmt::format("[cad] join_within = {:g}{}", narrow, where), refused, 0.0, narrow});
    if (shape.cad.defeature_below == 0.0)
      list.push_back(
          {fmt::format("[cad] defeature_below = {:g}{}", narrow, where), refused, narrow, 0.0});
  }
  const double coarsest = metres_per_unit * facts.coarsest;
  const auto with_size = [&](double factor) {
    MeshSettings settings = refused;
    const double size_now = std::min(refused.element_size, coarsest);
    settings.element_size = 1e-3 * two_digits(1e3 * factor * size_now);
    if (settings.element_size < settings.min_size || settings.element_size > coarsest) return;
    list.push_back({fmt::format("{} {:g}", size, 1e3 * settings.element_size), settings});
  };
  with_size(kSmaller);
  if (refused.elements_per_turn == 0) {
    MeshSettings settings = refused;
    settings.elements_per_turn = kPerTurn;
    list.push_back({fmt::format("elements_per_turn = {}{}", kPerTurn, where), settings});
  }
  with_size(kLarger);
  return list;
}

}  // namespace

std::string tried_advice(const PartJob& job, const MeshSettings& refused, const ChildLimits& limits,
                         double seconds) {
  if (seconds < 1.0) return "";
  const Stopwatch clock;
  ChildLimits mine = limits;
  const auto left = [&] { return seconds - clock.seconds(); };
  const LengthUnit& unit = job.part->shape.unit;
  mine.seconds = seconds;
  const auto facts = facts_of(job, refused.element_size / unit.metres, mine);
  if (!facts) return "";
  std::vector<std::string> failed, untried;
  for (const Remedy& remedy : remedies_for(job, refused, *facts, unit.metres)) {
    if (left() < 1.0) {
      untried.push_back(remedy.text);
      continue;
    }
    mine.seconds = left();
    say(fmt::format("mesh: that is refused; trying {}, {:.0f} s at most", remedy.text, left()));
    if (const auto cells = cells_with(job, remedy, mine))
      return fmt::format("; this works, it was tried: {} ({} cells)", remedy.text, *cells);
    (left() <= 0.0 ? untried : failed).push_back(remedy.text);
  }
  std::string text;
  if (!failed.empty()) text += fmt::format("; tried in vain: {}", fmt::join(failed, "; "));
  if (!untried.empty())
    text += fmt::format("; not known after {:.0f} s: {}", seconds, fmt::join(untried, "; "));
  if (facts->small.count() > 0)
    text += fmt::format("; mend its smallest features in the CAD program: {} ({})",
                        describe_small_features(facts->small), unit.name);
  return text;
}

}  // namespace clatter::mesh
