// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/part/part_in_child.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/whole_file.hpp"
#include "mesh/part/gmsh_in_child.hpp"
#include "mesh/part/mesh_wire.hpp"
#include "mesh/part/remedies.hpp"

namespace clatter {

template <class Archive, SelfOf<StepClock::Step> Self>
void wire(Archive& archive, Self& s) {
  auto& [name, seconds, peak_gib] = s;
  archive(name, seconds, peak_gib);
}

}  // namespace clatter

namespace clatter::mesh {

template <class Archive, SelfOf<MadePart> Self>
void wire(Archive& archive, Self& s) {
  auto& [part, steps, cad, refusal] = s;
  archive(part, steps, cad, refusal);
}

namespace {

constexpr double kLeastTrial = 30.0;  // [s] for trying advice, where the mesh took less

// A temporary folder under $TMPDIR.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string path = (std::filesystem::temp_directory_path() / "clatter-mesh-XXXXXX").string();
    if (::mkdtemp(path.data()) == nullptr)
      throw FileError(fmt::format("{}: cannot be created: {}", path, std::strerror(errno)));
    path_ = path;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// In the child.
MadePart make_part(const PartJob& job, const MeshSettings& settings,
                   const std::filesystem::path& scratch) {
  const LengthUnit& unit = job.part->shape.unit;
  StepClock clock;
  MadePart made;
  GmshSession session(job.part->name);
  const PartGeometry part = build_part(session, job.part->shape);
  clock.lap("geometry");
  if (!job.cad_extension.empty()) {
    const std::filesystem::path file = scratch / ("part" + job.cad_extension);
    session.write_cad(file, unit.name);
    made.cad = read_whole_file(file);
  }
  try {
    made.part = mesh_part(session, part, settings, unit.metres, job.part->name, job.where);
  } catch (const NumericsError& error) {
    made.refusal = error.what();
    return made;
  }
  clock.lap("mesh");
  made.steps = clock.steps();
  return made;
}

std::string sizes_of(const MeshSettings& settings) {
  std::string text = fmt::format("element_size_mm = {:g}", 1e3 * settings.element_size);
  if (settings.elements_per_turn > 0)
    text += fmt::format(", elements_per_turn = {}", settings.elements_per_turn);
  if (!settings.local.empty()) text += fmt::format(", {} local sizes", settings.local.size());
  return text;
}

bool limit_ended(const ChildEnd& end) {
  return end.kind == ChildEnd::Kind::kTimeLimit || end.kind == ChildEnd::Kind::kMemoryLimit;
}

// Names of meshing steps begin with "gmsh: ", those of geometry do not (gmsh_call).
bool fell_while_meshing(const ChildEnd& end) {
  return !limit_ended(end) && end.step.starts_with("gmsh: ");
}

std::string advice_of(const ChildEnd& end) {
  if (end.kind == ChildEnd::Kind::kTimeLimit) return "raise the limit or choose larger elements";
  if (end.kind == ChildEnd::Kind::kMemoryLimit)
    return "choose larger elements, or raise the limit if the machine has more memory";
  return "heal the part in its CAD program (tiny edges, overlapping faces) or export it in "
         "another format (STEP, BREP)";
}

/// Why the mesh is refused, or nothing; its poor cells are said and noted.
std::string refusal_of(MadePart& made, const PartJob& job, const MeshSettings& settings) {
  if (!made.refusal.empty()) return made.refusal;
  const LengthUnit& unit = job.part->shape.unit;
  const QualityLimits aims = aims_of(settings);
  const PoorCells poor = find_poor_cells(made.part.mesh, made.part.quality, aims);
  note_poor_cells(poor, made.part.certificate);
  const std::string refusal = refusal_of_poor_cells(
      poor, made.part.mesh, aims, {unit.name, unit.metres}, settings.accept_poor_cells);
  if (refusal.empty()) return "";
  return refusal + "; --accept-poor-cells ([mesh] accept_poor_cells = true) takes it nevertheless";
}

struct Attempt {
  MeshSettings settings;
  std::string difference;  // from the requested settings
};

Attempt simpler_than(MeshSettings settings) {
  if (settings.elements_per_turn > 0) {
    settings.elements_per_turn = 0;
    return {settings, "without elements_per_turn (local sizes are kept)"};
  }
  settings.adaptive_faces = true;
  return {settings, "with Gmsh's MeshAdapt on the faces"};
}

}  // namespace

MadePart make_part_in_child(const PartJob& job, const ChildLimits& limits) {
  const Stopwatch clock;
  MeshSettings requested = job.part->mesh;
  if (job.element_size > 0.0) requested.element_size = job.element_size;
  requested.accept_poor_cells = requested.accept_poor_cells || job.accept_poor_cells;
  std::optional<ScratchFolder> scratch;
  ChildLimits mine = with_news(limits);
  if (!job.cad_extension.empty()) mine.scratch = scratch.emplace().path();
  const auto attempt = [&](const MeshSettings& settings) {
    return run_in_child(mine, [&] { return to_wire(make_part(job, settings, mine.scratch)); });
  };
  const auto advice = [&] {
    const double took = clock.seconds();
    double most = std::max(kLeastTrial, took);
    if (limits.seconds > 0.0) most = std::min(most, limits.seconds - took);
    return tried_advice(job, requested, mine, most);
  };
  const auto made_of = [&](const ChildEnd& end, double simpler) {
    auto made = from_wire<MadePart>(end.result);
    made.part.certificate.simpler_setting = simpler;
    if (const std::string refusal = refusal_of(made, job, requested); !refusal.empty())
      throw NumericsError(refusal + advice());
    return made;
  };

  const ChildEnd first = attempt(requested);
  if (first.done()) return made_of(first, 0.0);
  const std::string fall =
      fmt::format("{}: {}, with {}", job.where, describe_end(first, limits), sizes_of(requested));
  if (!fell_while_meshing(first))
    throw NumericsError(fmt::format("{}; {}", fall, advice_of(first)));

  const Attempt simpler = simpler_than(requested);
  warn(fmt::format("{}; trying again {}", fall, simpler.difference));
  if (limits.seconds > 0.0) mine.seconds = std::max(1.0, limits.seconds - clock.seconds());
  const ChildEnd second = attempt(simpler.settings);
  if (second.done()) {
    warn(fmt::format("{}: meshed {}: Gmsh crashes with the requested settings", job.where,
                     simpler.difference));
    return made_of(second, requested.elements_per_turn > 0 ? 1.0 : 2.0);
  }
  const std::string both =
      fmt::format("{}; then, {}: {}", fall, simpler.difference, describe_end(second, limits));
  if (!fell_while_meshing(second))
    throw NumericsError(fmt::format("{}; {}", both, advice_of(second)));
  throw NumericsError(fmt::format("{}{}; or {}", both, advice(), advice_of(second)));
}

}  // namespace clatter::mesh
