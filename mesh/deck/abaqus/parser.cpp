// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/parser.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/deck/abaqus/cards.hpp"
#include "mesh/deck/abaqus/damping.hpp"
#include "mesh/deck/abaqus/generate.hpp"
#include "mesh/deck/abaqus/read_cells.hpp"
#include "mesh/deck/abaqus/read_sets.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

class Parser {
 public:
  Parser(Source& source, Ignore& ignore, Refusals& refusals)
      : lines_(source), source_(source), ignore_(ignore), refusals_(refusals) {}

  RawDeck run() {
    Lines::Kind kind = go_on([&] { return lines_.next(); });
    while (kind != Lines::Kind::kEnd) {
      if (kind == Lines::Kind::kData) {
        kind = go_on([&]() -> Lines::Kind {
          source_.fail(lines_.origin(),
                       fmt::format("found {}, expected a keyword (*...)", shown(lines_.data())));
        });
        continue;
      }
      last_ = lines_.keyword();
      kind = go_on([&] { return read_keyword(); });
    }
    refusals_.attempt([&] { check_end(); });
    if (incomplete_) refusals_.raise();
    for (const auto& [type, note] : variants_) deck_.notes.push_back(note);
    deck_.marked_shells = lines_.marked_shells();
    return std::move(deck_);
  }

 private:
  // Runs one step of the parser; goes to the next keyword if it was refused: tables then have gaps,
  // and references to their nodes and elements are not checked.
  template <class Body>
  Lines::Kind go_on(const Body& body) {
    Lines::Kind kind = Lines::Kind::kEnd;
    bool done = refusals_.attempt([&] { kind = body(); });
    if (done) return kind;
    incomplete_ = true;
    while (!done || kind == Lines::Kind::kData) {
      done = refusals_.attempt([&] { kind = lines_.next(); });
    }
    return kind;
  }

  // A deck truncated at the end of a line has open blocks.
  void check_end() {
    if (scope_ != &deck_.model) {
      source_.fail(scope_->origin,
                   fmt::format("found *{0} without *END {0}, the deck ends before it",
                               in_instance_ ? "INSTANCE" : "PART"));
    }
    if (assembly_ >= 0) {
      source_.fail(assembly_, "found *ASSEMBLY without *END ASSEMBLY, the deck ends before it");
    }
    if (step_ >= 0 && last_.key == "STEP" && steps_ > 1 && !lines_.open_keyword()) {
      // An empty step; CalculiX accepts such a deck, too.
      if (!left_out_) scope_->cards.pop_back();
      deck_.notes.push_back(fmt::format(
          "{}: the deck ends here, with an empty *STEP, which is left out; the file may be "
          "truncated",
          source_.where(step_)));
      return;
    }
    if (step_ >= 0) {
      source_.fail(step_, "found *STEP without *END STEP, the deck ends before it");
    }
    if (lines_.open_keyword()) {
      source_.fail(last_.origin, fmt::format("the deck ends after the comma of {}, expected the "
                                             "rest of the line",
                                             last_.name));
    }
    if (lines_.bare_keyword() && needs_data(last_)) {
      source_.fail(last_.origin,
                   fmt::format("the deck ends with {}, expected its data lines", last_.name));
    }
    if (steps_ > 0 || lines_.marked_end()) return;
    deck_.notes.push_back(fmt::format(
        "{}: the deck ends here, in {}, without a *STEP: read as a model without loads; the "
        "file may be truncated",
        source_.where(source_.origin()), last_.name.empty() ? "nothing" : last_.name));
  }

  static bool needs_data(const Keyword& keyword) {
    switch (role_of(keyword.key)) {
      case Role::kNode:
      case Role::kElement:
      case Role::kMaterialPart:
        return true;
      case Role::kSet:
        return keyword.key == "ELSET" || !keyword.has("ELSET");
      case Role::kModel:
        return keyword.key != "RIGIDBODY" && keyword.key != "SOLIDSECTION";
      default:
        return false;
    }
  }

  Lines::Kind read_keyword() {
    const Keyword& keyword = lines_.keyword();
    const bool ignored = ignore_.skips(keyword.name);
    const Role role = role_of(keyword.key);
    const bool frozen = keyword.key == "BOUNDARY" && keyword.has("FIXED");
    const bool last = (role == Role::kProcedure || frozen) && steps_before_ > 0;
    const bool left_out = step_ >= 0 && (left_out_ || last);
    record(keyword, ignored, left_out);
    if (ignored) return skip_data();
    if (role == Role::kDamping) return read_damping();
    if (left_out) return left_out_ ? read_left_out(role) : begin_left_out(keyword);
    check_context(keyword, role);
    if (role == Role::kMaterial) parent_ = Role::kMaterial;
    if (role == Role::kCoupling) parent_ = Role::kCoupling;
    switch (role) {
      case Role::kUnknown:
      case Role::kProcedure:
        refusals_.add(fmt::format(
            "{}: keyword {} is not supported; ignore = [\"{}\"] skips it "
            "with its data lines{}",
            source_.where(keyword.origin), keyword.name, keyword.name, advice_of(keyword.key)));
        return skip_data();
      case Role::kHarmless:
      case Role::kMaterialIdle:
        deck_.is_calculix |= is_calculix_output(keyword);
        return skip_data();
      case Role::kNode:
        return read_nodes(lines_, *scope_, system_, ignore_);
      case Role::kElement:
        return read_elements(lines_, *scope_, ignore_, refusals_, variants_);
      case Role::kParameter:
        return read_parameters();
      case Role::kSystem:
      case Role::kGenerate:
        return generate_rows();
      case Role::kSet:
        return read_set(lines_, *scope_, ignore_);
      case Role::kStructure:
        return read_structure();
      case Role::kStepBegin:
        step_ = keyword.origin;
        ++steps_;
        cards_before_step_ = scope_->cards.size();
        steps_before_ = linear_steps_;
        if (!left_out_) return read_card();
        deck_.notes.push_back(fmt::format("{}: *STEP is left out: it continues a step that is",
                                          source_.where(keyword.origin)));
        return skip_data();
      case Role::kStepEnd:
        step_ = -1;
        return read_card();
      default:
        if (keyword.key == "STATIC" || keyword.key == "FREQUENCY") ++linear_steps_;
        return read_card();
    }
  }

  void record(const Keyword& keyword, bool ignored, bool left_out) {
    Content& content = refusals_.contents().count("keyword", keyword.name, source_, keyword.origin);
    if (content.count > 1) return;
    const KeywordRole* row = row_of(keyword.key);
    content.fate = row == nullptr ? Fate::kRefused : fate_of(row->role);
    if (row != nullptr) content.meaning = row->role == Role::kDamping ? "damping" : row->meaning;
    if (ignored) content.fate = Fate::kIgnored;
    if (!left_out || (row != nullptr && row->role == Role::kDamping)) return;
    content.fate = Fate::kPassed;
    content.meaning = "in a step that is left out";
  }

  // Drops the open step and those that follow from it.
  Lines::Kind begin_left_out(const Keyword& keyword) {
    left_out_ = true;
    scope_->cards.erase(scope_->cards.begin() + static_cast<long>(cards_before_step_),
                        scope_->cards.end());
    linear_steps_ = steps_before_;
    deck_.notes.push_back(
        fmt::format("{}: the step with {} is left out: clatter reads linear statics and "
                    "frequencies, here those of the {} before it",
                    source_.where(keyword.origin), keyword.name,
                    steps_before_ == 1 ? "step" : fmt::format("{} steps", steps_before_)));
    return skip_data();
  }

  Lines::Kind read_left_out(Role role) {
    if (role == Role::kStepEnd) step_ = -1;
    return skip_data();
  }

  // Keywords after *MATERIAL belong to it, until one of another kind.
  void check_context(const Keyword& keyword, Role role) {
    const bool material = role == Role::kMaterialPart || role == Role::kMaterialIdle;
    const bool coupling = role == Role::kCouplingPart;
    if (material && parent_ != Role::kMaterial) misplaced(keyword, "after *MATERIAL");
    if (coupling && parent_ != Role::kCoupling) misplaced(keyword, "after *COUPLING");
    const bool anywhere = role == Role::kHarmless || role == Role::kInteraction;
    if (!material && !coupling && !anywhere) parent_ = Role::kUnknown;
    const bool inside = role == Role::kStep || role == Role::kStepEnd;
    if (inside && step_ < 0) misplaced(keyword, "inside a step");
    if ((role == Role::kStepBegin || role == Role::kStructure || role == Role::kElement ||
         role == Role::kNode || role == Role::kGenerate) &&
        step_ >= 0) {
      misplaced(keyword, "outside of steps");
    }
    if (role == Role::kStepBegin && scope_ != &deck_.model) misplaced(keyword, "outside of parts");
  }

  [[noreturn]] void misplaced(const Keyword& keyword, std::string_view expected) const {
    source_.fail(keyword.origin, fmt::format("found {}, expected it {}", keyword.name, expected));
  }

  Lines::Kind skip_data() {
    Lines::Kind kind = lines_.next();
    while (kind == Lines::Kind::kData) kind = lines_.next();
    return kind;
  }

  Lines::Kind read_card() {
    scope_->cards.emplace_back(lines_.keyword());
    return read_data(scope_->cards.back());
  }

  // Damping of a step, also of one that is left out: D = alpha M + beta K, or nothing to offer.
  Lines::Kind read_damping() {
    Card card(lines_.keyword());
    const Lines::Kind kind = read_data(card);
    refusals_.attempt([&] {
      const auto found = rayleigh_of(card, source_);
      if (!found) return;
      deck_.damping.push_back(*found);
      constexpr int64_t kNoMore = 0;  // it is counted
      refusals_.contents().pass("keyword", card.keyword().name, source_, card.origin(),
                                "damping, offered to the recipe", kNoMore);
    });
    return kind;
  }

  Lines::Kind read_data(Card& card) {
    Lines::Kind kind = lines_.next();
    for (; kind == Lines::Kind::kData; kind = lines_.next())
      card.add(lines_.data(), lines_.origin());
    return kind;
  }

  Lines::Kind read_parameters() {
    const Keyword keyword = lines_.keyword();
    keyword.allow({}, source_, ignore_);
    Lines::Kind kind = lines_.next();
    for (; kind == Lines::Kind::kData; kind = lines_.next()) {
      lines_.parameters().define(lines_.data(), source_, lines_.origin());
    }
    return kind;
  }

  // *SYSTEM and the keywords that make nodes and elements from those before.
  Lines::Kind generate_rows() {
    Card card(lines_.keyword());
    const Lines::Kind kind = read_data(card);
    if (incomplete_) return kind;  // tables have gaps
    const bool done = refusals_.attempt([&] {
      if (card.keyword().key == "SYSTEM") {
        system_ = local_system(card, source_);
      } else {
        generate(card, *scope_, system_, source_, ignore_);
      }
    });
    incomplete_ = incomplete_ || !done;
    return kind;
  }

  Lines::Kind read_structure() {
    const Keyword keyword = lines_.keyword();
    if (keyword.key == "PART") {
      begin_part(keyword);
    } else if (keyword.key == "ENDPART" || keyword.key == "ENDINSTANCE") {
      end_part(keyword, keyword.key == "ENDINSTANCE");
    } else if (keyword.key == "INSTANCE") {
      return read_instance(keyword);
    } else if (keyword.key == "ASSEMBLY") {
      assembly_ = keyword.origin;
    } else if (keyword.key == "ENDASSEMBLY") {
      assembly_ = -1;
    }
    return no_data(keyword);
  }

  void begin_part(const Keyword& keyword) {
    if (scope_ != &deck_.model) misplaced(keyword, "after *END PART");
    keyword.allow({"NAME"}, source_, ignore_);
    part_ = Scope();
    part_.name = keyword.required("NAME", source_);
    part_.origin = keyword.origin;
    for (const Scope& part : deck_.parts) {
      if (folded(part.name) == folded(part_.name)) {
        source_.fail(keyword.origin, fmt::format("found a second part {}", part_.name));
      }
    }
    scope_ = &part_;
    system_ = LocalSystem();
  }

  Lines::Kind no_data(const Keyword& keyword) {
    const Lines::Kind kind = lines_.next();
    if (kind == Lines::Kind::kData) {
      source_.fail(lines_.origin(), fmt::format("found {}, expected no data after {}",
                                                shown(lines_.data()), keyword.name));
    }
    return kind;
  }

  // Its placement; then *END INSTANCE, or keywords that belong to this instance alone: a mesh on
  // the instance, as Abaqus/CAE writes it, or additions to its part.
  Lines::Kind read_instance(const Keyword& keyword) {
    if (scope_ != &deck_.model) misplaced(keyword, "outside of parts");
    keyword.allow({"NAME", "PART"}, source_, ignore_);
    InstanceLine instance;
    instance.name = keyword.required("NAME", source_);
    instance.part = keyword.required("PART", source_);
    instance.origin = keyword.origin;
    Lines::Kind kind = lines_.next();
    for (int line = 0; kind == Lines::Kind::kData; kind = lines_.next(), ++line) {
      instance.placement.read(Fields(lines_.data(), source_, lines_.origin()), line);
    }
    if (kind == Lines::Kind::kKeyword && lines_.keyword().key != "ENDINSTANCE") {
      begin_additions(instance);
      return kind;
    }
    if (kind == Lines::Kind::kEnd) {
      source_.fail(keyword.origin, "found *INSTANCE without *END INSTANCE");
    }
    deck_.instances.push_back(instance);
    return no_data(lines_.keyword());
  }

  // The instance gets a copy of its part for itself.
  void begin_additions(InstanceLine& instance) {
    const auto part = std::find_if(deck_.parts.begin(), deck_.parts.end(), [&](const Scope& one) {
      return folded(one.name) == folded(instance.part);
    });
    if (part == deck_.parts.end()) {
      source_.fail(instance.origin, fmt::format("found no part {}", shown(instance.part)));
    }
    part_ = *part;
    part_.name = instance.part = fmt::format("{} of instance {}", part->name, instance.name);
    part_.origin = instance.origin;
    scope_ = &part_;
    system_ = LocalSystem();
    deck_.instances.push_back(instance);
    in_instance_ = true;
  }

  void end_part(const Keyword& keyword, bool of_instance) {
    if (scope_ == &deck_.model || in_instance_ != of_instance) {
      if (refusals_.any()) throw FollowUp();
      misplaced(keyword, of_instance ? "after *INSTANCE" : "after *PART");
    }
    deck_.parts.push_back(std::move(part_));
    scope_ = &deck_.model;
    system_ = LocalSystem();
    in_instance_ = false;
  }

  Lines lines_;
  const Source& source_;
  Ignore& ignore_;
  Refusals& refusals_;
  bool incomplete_ = false;
  Keyword last_;
  int32_t steps_ = 0, linear_steps_ = 0, steps_before_ = 0;
  bool left_out_ = false;
  size_t cards_before_step_ = 0;
  Origin assembly_ = -1;
  RawDeck deck_;
  Scope part_;
  Scope* scope_ = &deck_.model;
  bool in_instance_ = false;                     // part_ is the copy of an instance
  LocalSystem system_;                           // of *SYSTEM
  std::map<std::string, std::string> variants_;  // by element type: read as another one
  Origin step_ = -1;                             // of the open step
  Role parent_ = Role::kUnknown;
};

}  // namespace

RawDeck parse(Source& source, Ignore& ignore, Refusals& refusals) {
  return Parser(source, ignore, refusals).run();
}

}  // namespace clatter::mesh::deck::abaqus
