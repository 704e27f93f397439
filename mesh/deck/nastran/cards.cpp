// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace clatter::mesh::deck::nastran {
namespace {

struct Kind {
  std::string_view name;
  void (*read)(const Card&, Bulk&);  // null: harmless
  size_t most_fields;                // 0: any number
};

// Sorted by name. Harmless ones control solvers, output or plots and do not change the model.
constexpr std::array kKinds = {Kind{"ASET", read_aset, 8},      Kind{"ASET1", read_aset1, 0},
                               Kind{"BSET", read_aset, 8},      Kind{"BSET1", read_aset1, 0},
                               Kind{"CELAS1", read_celas1, 8},  Kind{"CELAS2", read_celas2, 8},
                               Kind{"CHEXA", read_cell, 24},    Kind{"CONM2", read_conm2, 16},
                               Kind{"CORD1C", read_cord1, 8},   Kind{"CORD1R", read_cord1, 8},
                               Kind{"CORD1S", read_cord1, 8},   Kind{"CORD2C", read_cord2, 16},
                               Kind{"CORD2R", read_cord2, 16},  Kind{"CORD2S", read_cord2, 16},
                               Kind{"CPENTA", read_cell, 24},   Kind{"CPYRA", read_cell, 16},
                               Kind{"CPYRAM", read_cell, 16},   Kind{"CTETRA", read_cell, 16},
                               Kind{"ECHOOFF", nullptr, 0},     Kind{"ECHOON", nullptr, 0},
                               Kind{"EIGR", read_eigr, 16},     Kind{"EIGRL", read_eigrl, 0},
                               Kind{"FORCE", read_force, 8},    Kind{"GRAV", read_grav, 8},
                               Kind{"GRDSET", read_grdset, 8},  Kind{"GRID", read_grid, 8},
                               Kind{"LOAD", read_load, 0},      Kind{"MAT1", read_mat1, 16},
                               Kind{"MAT9", read_mat9, 32},     Kind{"MOMENT", read_force, 8},
                               Kind{"MPC", read_mpc, 0},        Kind{"MPCADD", read_mpcadd, 0},
                               Kind{"PARAM", nullptr, 8},       Kind{"PELAS", read_pelas, 8},
                               Kind{"PLOAD4", read_pload4, 16}, Kind{"PLOTEL", nullptr, 8},
                               Kind{"PSOLID", read_psolid, 8},  Kind{"RBE2", read_rbe2, 0},
                               Kind{"RBE3", read_rbe3, 0},      Kind{"RFORCE", read_rforce, 24},
                               Kind{"SET1", read_set1, 0},      Kind{"SPC", read_spc, 8},
                               Kind{"SPC1", read_spc1, 0},      Kind{"SPCADD", read_spcadd, 0},
                               Kind{"TEMP", read_temp, 8},      Kind{"TEMPD", read_tempd, 8}};

static_assert(std::is_sorted(kKinds.begin(), kKinds.end(),
                             [](const Kind& a, const Kind& b) { return a.name < b.name; }));

const Kind* find_kind(std::string_view name) {
  const auto at =
      std::lower_bound(kKinds.begin(), kKinds.end(), name,
                       [](const Kind& kind, std::string_view n) { return kind.name < n; });
  return at != kKinds.end() && at->name == name ? &*at : nullptr;
}

class BulkSink : public CardSink {
 public:
  BulkSink(const Source& source, Bulk& bulk, Ignored& ignored, Refusals& refusals)
      : source_(source), bulk_(bulk), ignored_(ignored), refusals_(refusals) {}

  /// False when a card was refused, so that others may have missing references.
  bool complete() const { return complete_; }

  size_t begin(std::string_view name, Origin origin) override {
    if (kind_ && kind_->name == name) return kind_->most_fields;
    kind_ = nullptr;
    if (ignored_.skip(name)) return 0;
    kind_ = find_kind(name);
    if (kind_) return kind_->most_fields;
    refused_.emplace(name);
    refusals_.attempt([&] { refuse(name, origin); });
    return 0;
  }

  void card(const Card& card) override {
    const bool current = kind_ && kind_->name == card.name();
    if (!current && (ignored_.lists(card.name()) || refused_.contains(card.name()))) return;
    complete_ = refusals_.attempt([&] { read(card, current); }) && complete_;
  }

  void comment(std::string_view line, Origin origin) override {
    constexpr std::string_view kOurs = "$ clatter ";
    if (line.starts_with(kOurs)) {
      read_comment(line.substr(kOurs.size()), origin, source_, bulk_);
    }
  }

 private:
  void read(const Card& card, bool current) {
    const Kind& kind = current ? *kind_ : *find_kind(card.name());
    if (kind.name == "PARAM") {
      read_parameter(bulk_.control, card.text(0), card.text(1), source_, card.origin());
    }
    if (!kind.read) return;
    if (kind.most_fields > 0) card.expect_end(kind.most_fields);
    kind.read(card, bulk_);
  }

  [[noreturn]] void refuse(std::string_view name, Origin origin) {
    const bool word = name.size() <= 16 && std::all_of(name.begin(), name.end(), [](char c) {
                        return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
                      });
    if (!word) {
      complete_ = false;
      source_.fail(origin, fmt::format("found {}, expected a card of bulk data", shown(name)));
    }
    const bool shell = name.starts_with("CQUAD") || name.starts_with("CTRIA");
    const bool beam = name == "CBAR" || name == "CBEAM" || name == "CROD";
    const char* why = shell ? " (no shells yet)" : beam ? " (no beams yet)" : "";
    source_.fail(origin, fmt::format("card {0} is not supported{1}; ignore = [\"{0}\"] skips it",
                                     name, why));
  }

  const Source& source_;
  Bulk& bulk_;
  Ignored& ignored_;
  Refusals& refusals_;
  bool complete_ = true;
  std::set<std::string, std::less<>> refused_;  // names of unsupported cards
  const Kind* kind_ = nullptr;                  // of the current card; null when it is ignored
};

}  // namespace

Bulk read_bulk(Source& source, Control control, Ignored& ignored, Refusals& refusals) {
  Bulk bulk;
  bulk.control = std::move(control);
  BulkSink sink(source, bulk, ignored, refusals);
  const CardsEnd end = read_cards(source, sink, refusals);
  if (!end.complete || !sink.complete()) refusals.raise();
  if (!end.end_data && !end.last.empty()) {
    const std::string missing =
        end.missing_continuation.empty()
            ? ""
            : fmt::format(" whose continuation {} is missing", shown(end.missing_continuation));
    bulk.notes.push_back(
        fmt::format("{}: the deck ends here, after card {}{}, without ENDDATA: "
                    "the file may be truncated",
                    source.where(source.origin()), end.last, missing));
  }
  return bulk;
}

}  // namespace clatter::mesh::deck::nastran
