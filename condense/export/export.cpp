// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/export.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>

#include "condense/export/calculix.hpp"
#include "condense/export/dmig.hpp"
#include "condense/export/exudyn.hpp"
#include "condense/export/flex_ascii.hpp"
#include "condense/export/matrix_market.hpp"
#include "condense/export/mbdyn.hpp"
#include "condense/export/op4.hpp"
#include "condense/export/sid.hpp"
#include "condense/export/superelement.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"

namespace clatter::condense {

namespace {

using Path = std::filesystem::path;

/// The units that a format has where the user names none.
enum class Units { kDeck, kSi, kOnlySi };

struct Format {
  const char* extension;
  const char* program;
  Units units;
  std::vector<Path> (*files)(const Path&);
  void (*write)(const ExportedPart&, const Path&);
  bool skin = false;
};

std::vector<Path> one_file(const Path& path) { return {path}; }

/// Files that meet the rest of a deck are in its units; others in SI.
constexpr std::array kFormats = {
    Format{".mtx", "Matrix Market", Units::kSi, matrix_market_files, export_matrix_market},
    Format{".inp", "CalculiX", Units::kDeck, calculix_files, export_calculix},
    Format{".pch", "Nastran DMIG", Units::kDeck, one_file, export_dmig},
    Format{".asm", "Nastran superelement", Units::kDeck, superelement_files, export_superelement},
    Format{".op4", "Nastran OUTPUT4", Units::kDeck, one_file, export_op4},
    Format{".SID_FEM", "standard input data", Units::kOnlySi, one_file, export_sid},
    Format{".fem", "MBDyn", Units::kSi, one_file, export_mbdyn},
    Format{".npy", "Exudyn", Units::kSi, one_file, export_exudyn, true},
    Format{".flexascii", "OpenFAST", Units::kOnlySi, one_file, export_flex_ascii}};

const Format& format_of(const Path& path) {
  const std::string extension = path.extension().string();
  for (const Format& format : kFormats)
    if (extension == format.extension) return format;
  throw InputError(fmt::format("{}: found extension \"{}\", expected {}", path.string(), extension,
                               export_formats()));
}

UnitSystem units_of(const Format& format, const rom::ReducedModel& model, const Path& path,
                    const ExportOptions& options) {
  const UnitSystem si;
  if (options.units && format.units == Units::kOnlySi && options.units->name != si.name)
    throw InputError(fmt::format("{}: --units {} and {} exclude each other: it is in SI",
                                 path.string(), options.units->name, format.program));
  if (options.units) return *options.units;
  if (format.units != Units::kDeck || !model.deck.known()) return si;
  return unit_system_named(model.deck.units, model.name);
}

/// ", 8 nodes have the numbers of the deck, others begin at 1001"
std::string numbers_text(const ExportedPart& part) {
  std::set<int> of_deck, others;
  for (const rom::MappedDof& dof : part.map) (dof.of_deck ? of_deck : others).insert(dof.node);
  if (of_deck.empty()) return "";
  const std::string text = fmt::format(", {} nodes have the numbers of the deck", of_deck.size());
  return others.empty() ? text : fmt::format("{}, others begin at {}", text, *others.begin());
}

/// Without the sets that are no coordinates: other programs have no rows for them.
rom::ReducedModel coordinates_only(rom::ReducedModel model) {
  Eigen::Index rows = 0;
  for (const std::string& name : model.recovered_sets) {
    for (const int32_t dof : model.set(name).dofs) rows += dof >= model.size() ? 1 : 0;
    model.sets.erase(name);
    model.grids.erase(name);
  }
  model.recovered_sets.clear();
  model.combined.conservativeResize(model.combined.rows() - rows, Eigen::NoChange);
  return model;
}

}  // namespace

std::string export_formats() {
  std::vector<std::string> texts;
  for (const Format& format : kFormats)
    texts.push_back(fmt::format("{} ({})", format.extension, format.program));
  const std::string last = texts.back();
  texts.pop_back();
  return fmt::format("{} or {}", fmt::join(texts, ", "), last);
}

bool exports_skin(const Path& path) { return format_of(path).skin; }

std::vector<Path> exported_files(const Path& path) { return format_of(path).files(path); }

std::vector<Path> export_reduced(const rom::ReducedModel& with_rows, const Path& path,
                                 const ExportOptions& options) {
  const Format& format = format_of(path);
  const rom::ReducedModel model = coordinates_only(with_rows);
  if (model.combined.rows() > 0)
    throw InputError(fmt::format(
        "{}: found {} boundary coordinates that became interface modes, expected a part "
        "without [interface] for other programs",
        model.name, model.combined.rows()));
  ExportOptions in_deck = options;
  in_deck.numbering.deck_axes = format.units == Units::kDeck;
  const ExportedPart part = exported_part(model, units_of(format, model, path, options), in_deck);
  say(fmt::format("{}: {}{}", path.string(), text_of(part.units), numbers_text(part)));
  format.write(part, path);
  return format.files(path);
}

}  // namespace clatter::condense
