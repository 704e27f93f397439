// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/parser.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

#include "mesh/deck/abaqus/cards.hpp"
#include "mesh/deck/abaqus/read_cells.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// An entry of a set: a number, or the name of another set.
void add_member(std::string_view field, Origin origin, SetChunk& chunk) {
  if (field.empty()) return;
  if (const auto id = to_integer(field)) {
    chunk.ids.push_back(*id);
  } else {
    chunk.names.emplace_back(std::string(field), origin);
  }
}

IdRange range_of(const Lines& lines) {
  const Fields fields(lines.data(), lines.source(), lines.origin());
  constexpr int32_t kMost = std::numeric_limits<int32_t>::max();
  IdRange range;
  range.first = fields.integer(0, "first number", 1, kMost);
  range.last = fields.blank(1) ? range.first : fields.integer(1, "last number", 1, kMost);
  range.step = fields.blank(2) ? 1 : fields.integer(2, "step", 1, kMost);
  fields.at_most(3, "first, last, step");
  if (range.last < range.first) {
    fields.fail(fmt::format("found {} to {}, expected ascending numbers", range.first, range.last));
  }
  return range;
}

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
      source_.fail(scope_->origin, "found *PART without *END PART, the deck ends before it");
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
    if (left_out) return left_out_ ? read_left_out(role) : begin_left_out(keyword);
    check_context(keyword, role);
    if (role == Role::kMaterial) parent_ = Role::kMaterial;
    if (role == Role::kCoupling) parent_ = Role::kCoupling;
    switch (role) {
      case Role::kUnknown:
      case Role::kProcedure:
        refuse(keyword);
        return skip_data();
      case Role::kHarmless:
      case Role::kMaterialIdle:
        return skip_data();
      case Role::kNode:
        return read_nodes(lines_, *scope_, ignore_);
      case Role::kElement:
        return read_elements(lines_, *scope_, ignore_, refusals_);
      case Role::kSet:
        return read_set();
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
    if (row != nullptr) content.meaning = row->meaning;
    if (ignored) content.fate = Fate::kIgnored;
    if (left_out) content.fate = Fate::kPassed;
  }

  void refuse(const Keyword& keyword) {
    const KeywordRole* row = row_of(keyword.key);
    const bool known = row != nullptr && row->role == Role::kUnknown;
    refusals_.add(fmt::format(
        "{}: keyword {} is not supported{}; ignore = [\"{}\"] skips it with its data lines",
        source_.where(keyword.origin), keyword.name,
        known ? fmt::format(" ({})", row->meaning) : "", keyword.name));
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
    if (!material && !coupling) parent_ = Role::kUnknown;
    const bool inside = role == Role::kStep || role == Role::kStepEnd;
    if (inside && step_ < 0) misplaced(keyword, "inside a step");
    if ((role == Role::kStepBegin || role == Role::kStructure || role == Role::kElement ||
         role == Role::kNode) &&
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
    Card& card = scope_->cards.back();
    Lines::Kind kind = lines_.next();
    for (; kind == Lines::Kind::kData; kind = lines_.next())
      card.add(lines_.data(), lines_.origin());
    return kind;
  }

  Lines::Kind read_set() {
    const Keyword keyword = lines_.keyword();
    const bool of_nodes = keyword.key == "NSET";
    keyword.allow({of_nodes ? "NSET" : "ELSET", "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED",
                   of_nodes ? "ELSET" : "ELSET"},
                  source_, ignore_);
    IdSets& sets = of_nodes ? scope_->node_sets : scope_->element_sets;
    SetChunk& chunk =
        new_chunk(sets, keyword.required(of_nodes ? "NSET" : "ELSET", source_), keyword.origin);
    if (const std::string* instance = keyword.find("INSTANCE")) chunk.instance = *instance;
    if (of_nodes && keyword.has("ELSET")) {
      chunk.elements_of.push_back(keyword.required("ELSET", source_));
    }
    const bool generate = keyword.has("GENERATE");
    Lines::Kind kind = lines_.next();
    for (; kind == Lines::Kind::kData; kind = lines_.next()) {
      if (generate) {
        chunk.ranges.push_back(range_of(lines_));
        continue;
      }
      chunk.id_lines.emplace_back(chunk.ids.size(), lines_.origin());
      FieldWalk walk(lines_.data());
      std::string_view field;
      while (walk.next(&field)) add_member(field, lines_.origin(), chunk);
    }
    return kind;
  }

  Lines::Kind read_structure() {
    const Keyword keyword = lines_.keyword();
    if (keyword.key == "PART") {
      begin_part(keyword);
    } else if (keyword.key == "ENDPART") {
      if (scope_ == &deck_.model) misplaced(keyword, "after *PART");
      deck_.parts.push_back(std::move(part_));
      scope_ = &deck_.model;
    } else if (keyword.key == "INSTANCE") {
      return read_instance(keyword);
    } else if (keyword.key == "ASSEMBLY") {
      assembly_ = keyword.origin;
    } else if (keyword.key == "ENDASSEMBLY") {
      assembly_ = -1;
    } else if (keyword.key == "ENDINSTANCE") {
      if (refusals_.any()) throw FollowUp();
      misplaced(keyword, "after *INSTANCE");
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
  }

  Lines::Kind no_data(const Keyword& keyword) {
    const Lines::Kind kind = lines_.next();
    if (kind == Lines::Kind::kData) {
      source_.fail(lines_.origin(), fmt::format("found {}, expected no data after {}",
                                                shown(lines_.data()), keyword.name));
    }
    return kind;
  }

  // Translation in the first line; two points of an axis and an angle in degrees in the second.
  Lines::Kind read_instance(const Keyword& keyword) {
    if (scope_ != &deck_.model) misplaced(keyword, "outside of parts");
    keyword.allow({"NAME", "PART"}, source_, ignore_);
    InstanceLine instance;
    instance.name = keyword.required("NAME", source_);
    instance.part = keyword.required("PART", source_);
    instance.origin = keyword.origin;
    Lines::Kind kind = lines_.next();
    for (int line = 0; kind == Lines::Kind::kData; kind = lines_.next(), ++line) {
      set_position(Fields(lines_.data(), source_, lines_.origin()), line, instance);
    }
    if (kind == Lines::Kind::kEnd || lines_.keyword().key != "ENDINSTANCE") {
      source_.fail(keyword.origin,
                   "expected *END INSTANCE after the lines of *INSTANCE: additions "
                   "of an instance to its part are not supported");
    }
    deck_.instances.push_back(instance);
    return no_data(lines_.keyword());
  }

  static void set_position(const Fields& fields, int line, InstanceLine& instance) {
    if (line == 0) {
      fields.at_most(3, "translation of an instance");
      for (int k = 0; k < 3; ++k) instance.shift[k] = fields.number_or(k, "translation", 0.0);
      return;
    }
    if (line > 1) fields.fail("expected at most two lines of an instance");
    fields.at_most(7, "axis and angle of an instance");
    Eigen::Vector3d a, b;
    for (int k = 0; k < 3; ++k) {
      a[k] = fields.number(k, "first point of the axis");
      b[k] = fields.number(3 + k, "second point of the axis");
    }
    const double length = (b - a).norm();
    if (!(length > 0.0)) fields.fail("expected two different points of the axis");
    const double angle = fields.number(6, "angle in degrees") * std::numbers::pi / 180.0;
    instance.rotation = Eigen::AngleAxisd(angle, (b - a) / length).toRotationMatrix();
    instance.shift = instance.rotation * (instance.shift - a) + a;
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
  Origin step_ = -1;  // of the open step
  Role parent_ = Role::kUnknown;
};

}  // namespace

SetChunk& new_chunk(IdSets& sets, const std::string& name, Origin origin) {
  IdSet& set = sets[folded(name)];
  if (set.chunks.empty()) set.name = name;
  set.chunks.emplace_back();
  set.chunks.back().origin = origin;
  return set.chunks.back();
}

RawDeck parse(Source& source, Ignore& ignore, Refusals& refusals) {
  return Parser(source, ignore, refusals).run();
}

}  // namespace clatter::mesh::deck::abaqus
