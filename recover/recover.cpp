// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/recover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/whole_file.hpp"
#include "recover/sound/acoustic_velocity.hpp"
#include "recover/sound/sound_file.hpp"
#include "recover/spectrum/piece_samples.hpp"

namespace clatter::recover {
namespace {

/// Omits a default piece that does not fit the run, with a warning; throws for a requested one.
template <typename Make>
std::optional<Piece> optional_piece(bool requested, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    if (requested) throw;
    warn(std::string(error.what()) + ": omitted");
    return std::nullopt;
  }
}

Piece whole_run(const RunClock& clock, const std::string& origin) {
  const Span span{clock.time[0], clock.time[clock.time.size() - 1], true};
  return window(clock, {.name = "whole", .span = span}, origin);
}

std::vector<Piece> choose_pieces(const RunClock& clock, const Options& options,
                                 const std::string& origin) {
  std::vector<Piece> pieces;
  const auto keep = [&](std::optional<Piece> piece) {
    if (piece) pieces.push_back(*piece);
  };
  if (options.cycle && (clock.has_crank() || options.cycle_requested))
    keep(optional_piece(options.cycle_requested, [&] { return last_cycle(clock, origin); }));
  for (const WindowRule& rule : options.windows)
    if (clock.has_crank() || options.windows_requested)
      keep(optional_piece(options.windows_requested, [&] { return window(clock, rule, origin); }));
  if (pieces.empty()) pieces.push_back(whole_run(clock, origin));
  return pieces;
}

struct FrameChoice {
  Piece piece{};
  std::vector<int64_t> samples{};
};

/// The requested frames; when the default does not fit the run, sixty over the entire run.
FrameChoice choose_frames(const RunClock& clock, const Options& options,
                          const std::string& origin) {
  const FrameRule& rule = options.frames;
  const auto with_end = [&](Piece piece) {
    piece.count = std::min<int64_t>(piece.count + 1, clock.time.size() - piece.first);
    return piece;
  };
  std::optional<Piece> piece;
  if (clock.has_crank() || options.frames_requested)
    piece = optional_piece(options.frames_requested, [&] {
      return with_end(window(clock, {.name = "frames", .span = rule.span}, origin));
    });
  if (piece) return {*piece, frame_samples(clock, *piece, rule.span, rule.step)};
  piece = with_end(whole_run(clock, origin));
  constexpr double kFrames = 60.0;
  return {*piece, frame_samples(clock, *piece, {0.0, 0.0, true}, piece->duration_s() / kFrames)};
}

std::vector<PanelRule> panel_rules(const Options& options, const rom::Skin& skin) {
  if (options.panels.empty()) return default_panels(skin);
  std::vector<PanelRule> rules{{.name = "skin"}};
  rules.insert(rules.end(), options.panels.begin(), options.panels.end());
  return rules;
}

/// Warns where the spectra of a run without cycles leave out its largest motion, or a taper takes
/// most of its energy away.
void warn_of_lost_motion(const RunBody& body, const PanelForm& skin, const Piece& piece) {
  const RunClock& clock = body.clock();
  if (piece.periodic || piece.domain == Domain::kAngle || piece.segments() > 1) return;
  constexpr double kMost = 0.5;
  Eigen::Index largest = 0;
  Eigen::VectorXd square(clock.time.size());
  const Eigen::Index rows = block_rows(skin.W.rows());
  for (Eigen::Index first = 0; first < square.size(); first += rows) {
    const Eigen::Index count = std::min(rows, square.size() - first);
    square.segment(first, count) =
        normal_velocity_integral(skin.W, body.samples("v", first, count));
  }
  if (!(square.maxCoeff(&largest) > 0.0)) return;
  const Eigen::Index at = largest - piece.first;
  const std::string where = fmt::format("{}: the largest motion of the run, at {:.4g} s, lies",
                                        body.path().string(), clock.time[largest]);
  if (at < 0 || at >= piece.count)
    warn(fmt::format("{} outside '{}', {:.4g} to {:.4g} s: spectra and levels lack it", where,
                     piece.name, piece.first_s, piece.first_s + piece.duration_s()));
  else if (const double w = taper_values(piece.taper, piece.count)[at]; w * w < kMost)
    warn(
        fmt::format("{} under the edge of '{}', where taper = \"{}\" leaves {:.2g} % of its "
                    "energy: taper = \"none\" keeps it",
                    where, piece.name, name_of(piece.taper), 100.0 * w * w));
}

/// Fraction of the mean square normal velocity of the skin above the spectra's limit.
double share_above_limit(const Analysis& analysis) {
  const PanelResult& skin = analysis.panels.front();
  const double all = skin.instant_mean_square.mean();
  return all > 0.0 ? std::max(1.0 - skin.mean_square_velocity.sum() / all, 0.0) : 0.0;
}

/// Closure of the faces of solids: sheets have a border.
double closure(const rom::Skin& skin, const SkinGeometry& geometry) {
  if (skin.sheet.empty()) return geometry.closure;
  IndexMatrix solids(skin.triangles.rows() - static_cast<Eigen::Index>(skin.sheet.size()), 6);
  Eigen::Index row = 0;
  for (int32_t face = 0; face < skin.triangles.rows(); ++face)
    if (!std::binary_search(skin.sheet.begin(), skin.sheet.end(), face))
      solids.row(row++) = skin.triangles.row(face);
  return measure_skin(skin.nodes, solids).closure;
}

FieldCertificate certify(const RunBody& body, const Analysis& analysis, const rom::Skin& faces,
                         const SkinGeometry& geometry, const PanelForm& skin) {
  FieldCertificate certificate{.skin_area_m2 = geometry.area,
                               .skin_closure = closure(faces, geometry),
                               .run_complete = body.complete() ? 1.0 : 0.0};
  if (!analysis.piece.periodic) return certificate;
  certificate.mean_square_share_above_spectra = share_above_limit(analysis);
  const Piece cycle = segment_of(analysis.piece, analysis.piece.segments() - 1);
  const double drift = cycle_to_cycle_difference(body, cycle, skin);
  const double jump = cycle_end_jump(body, cycle, skin);
  if (drift >= 0.0) certificate.cycle_to_cycle_velocity_difference = drift;
  if (jump >= 0.0) certificate.cycle_end_velocity_jump = jump;
  return certificate;
}

void require_same_air(const SoundTable& table, const Options& options) {
  const Air& air = options.air;
  if (table.fluid.density != air.density || table.fluid.sound_speed != air.sound_speed)
    throw InputError(fmt::format(
        "{}: air: found {:g} kg/m3 and {:g} m/s, expected {:g} kg/m3 and {:g} m/s as in {}",
        options.origin, air.density, air.sound_speed, table.fluid.density, table.fluid.sound_speed,
        options.sound.string()));
}

std::vector<RunSound> radiate(const RunBody& body, const rom::ReducedModel& model,
                              const rom::SkinRows& T, const Summary& summary,
                              const std::vector<PanelForm>& forms) {
  const Options& options = summary.options;
  if (options.sound.empty()) return {};
  const SoundTable table = read_sound(options.sound, body.rom_sha256(), model.size());
  require_same_air(table, options);
  const PanelParts parts = with_context(options.sound.string(), [&] {
    return panel_parts(table, model.skin.triangles, T, summary.panels);
  });
  std::vector<RunSound> sounds;
  for (const Analysis& analysis : summary.analyses) {
    const auto segment = [&](int64_t k) -> SegmentLines {
      if (analysis.piece.segments() == 1)
        return {analysis.velocity, radiating_panel(analysis.panels).erp};
      return segment_lines(body, segment_of(analysis.piece, k), radiating_panel(forms), options.air,
                           summary.limit.to_hz);
    };
    sounds.push_back(run_sound(table, analysis, segment, parts, options));
  }
  return sounds;
}

void certify_sound(const Summary& summary, FieldCertificate& certificate) {
  if (!has_sound(summary)) return;
  const RunSound& sound = summary.sounds.front();
  certificate.panel_power_difference = sound.panels.sum_difference;
  certificate.directivity_power_difference = sound.directivity.power_difference;
  certificate.resistance_power_difference = sound.resistance_difference;
}

/// The sound power of an analysis, or else its ERP, n_l [W].
const Eigen::VectorXd& radiated_power(const Summary& summary, const Analysis& analysis) {
  const auto at = static_cast<size_t>(&analysis - summary.analyses.data());
  if (at < summary.sounds.size() && summary.sounds[at].power.size() > 0)
    return summary.sounds[at].power;
  return radiating_panel(analysis.panels).erp;
}

/// The first analysis that has complex lines; null when all are averaged over segments.
const Analysis* analysis_with_lines(const std::vector<Analysis>& analyses) {
  for (const Analysis& analysis : analyses)
    if (analysis.piece.segments() == 1) return &analysis;
  return nullptr;
}

/// Lines of the skin, with the limit of their analysis.
std::vector<ChosenLine> choose_lines_of(const Analysis* analysis, const Summary& summary,
                                        double step_s) {
  const Options& options = summary.options;
  FrequencyLimit limit = summary.limit;
  if (analysis == nullptr) {
    if (options.lines.requested())
      throw InputError(
          "lines need a cycle or a window in one segment, which have amplitudes and phases: all "
          "windows are averaged over segments");
    return {};
  }
  const double to_hz = analysis->piece.limit_hz(limit.to_hz, step_s);
  if (to_hz < limit.to_hz)
    limit = {to_hz,
             fmt::format("'{}' at its mean speed, so that no order leaves the spectra at its "
                         "highest speed",
                         analysis->piece.name)};
  return choose_lines(options.lines, options.spectrum, *analysis,
                      radiated_power(summary, *analysis), limit);
}

void write_skin(H5File& file, const rom::Skin& skin, const SkinGeometry& geometry,
                const std::vector<Panel>& panels, const OutputRule& output) {
  if (output.skin) {
    file.store_single(output.single);
    write_skin_geometry(file, skin, geometry);
    file.store_single(false);
  }
  write_panels(file, panels, output.skin);
}

void write_analyses(H5File& file, const Summary& summary) {
  const Options& options = summary.options;
  for (size_t i = 0; i < summary.analyses.size(); ++i) {
    write_analysis(file, summary.analyses[i], options.references, options.output);
    if (i < summary.sounds.size() && summary.sounds[i].power.size() > 0)
      write_run_sound(file, summary.analyses[i], summary.sounds[i], options.references);
  }
}

}  // namespace

Summary recover(const RunBody& body, const rom::ReducedModel& model, const Options& options,
                H5File& file, StepClock& clock) {
  const rom::Skin& skin = model.skin;
  Summary summary{.options = options};
  const SkinGeometry geometry = measure_skin(skin.nodes, skin.triangles);
  summary.n_nodes = skin.nodes.rows();
  summary.n_faces = skin.triangles.rows();
  summary.limit = with_context(options.origin, [&] {
    return frequency_limit(options.spectrum, model.valid_to_hz, body.clock().step_s);
  });
  if (model.valid_to_hz <= 0.0)
    warn(body.rom_path().filename().string() +
         ": valid_to_hz is not stated: spectra are not checked against the basis");
  const rom::SkinRows T = body.skin_rows();
  summary.sensors = with_context(options.origin,
                                 [&] { return find_sensors(options.sensors, model, T, geometry); });
  const std::string origin = body.path().string();
  const std::vector<Piece> pieces = choose_pieces(body.clock(), options, origin);
  FrameChoice frames;
  if (options.frames.on) frames = choose_frames(body.clock(), options, origin);
  summary.panels = with_context(
      options.origin, [&] { return choose_panels(panel_rules(options, skin), skin, geometry); });
  clock.lap("skin and panels");

  const std::vector<PanelForm> forms = normal_velocity_forms(skin, T, geometry, summary.panels);
  clock.lap("normal velocity forms");

  for (const Piece& piece : pieces)
    summary.analyses.push_back(
        analyse(body, piece, options, summary.limit.to_hz, forms, summary.sensors));
  if (pieces.size() == 1) warn_of_lost_motion(body, forms.front(), pieces.front());
  summary.certificate = certify(body, summary.analyses.front(), skin, geometry, forms.front());
  clock.lap("spectra and radiated power");
  summary.sounds = radiate(body, model, T, summary, forms);
  if (!options.sound.empty()) clock.lap("radiated sound");
  certify_sound(summary, summary.certificate);
  const Analysis* const of_lines = analysis_with_lines(summary.analyses);
  const std::vector<ChosenLine> lines = with_context(
      options.origin, [&] { return choose_lines_of(of_lines, summary, body.clock().step_s); });

  file.set("/", "body", body.name());
  if (body.clock().has_crank()) file.set("/", run::kAngleZero, body.clock().angle_zero);
  write_conventions(file, options, summary.limit, model.valid_to_hz);
  write_certificate(file, summary.certificate);
  write_skin(file, skin, geometry, summary.panels, options.output);
  write_analyses(file, summary);
  const SkinWriter writer(T, face_normal_operator(skin.nodes, skin.triangles, geometry));
  if (of_lines != nullptr)
    summary.lines = write_lines(file, *of_lines, lines, writer, options.lines.quantities,
                                options.output.single);
  if (of_lines != nullptr && !options.sound.empty())
    if (const auto acoustic = read_acoustic_velocity(options.sound, model.size()))
      write_acoustic_lines(file, *acoustic, of_lines->velocity, lines);
  if (options.frames.on)
    summary.frames =
        write_frames(file, body, writer, frames.piece, frames.samples, options.frames.quantities);
  clock.lap("skin fields");
  return summary;
}

void write_exports(const std::filesystem::path& field_file, const Summary& summary) {
  const auto write = [](const std::filesystem::path& path, const XdmfSeries& series) {
    std::error_code ignored;
    if (series.values.empty())
      std::filesystem::remove(path, ignored);
    else
      write_whole_file(path, xdmf_text(series));
  };
  XdmfSeries frames = frame_series(field_file, summary.n_nodes, summary.n_faces, summary.frames);
  XdmfSeries lines = line_series(field_file, summary.n_nodes, summary.n_faces, summary.lines);
  if (summary.options.output.single) frames.precision = lines.precision = 4;
  write(frame_export_path(field_file), frames);
  write(line_export_path(field_file), lines);
}

}  // namespace clatter::recover
