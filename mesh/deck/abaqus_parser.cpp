#include "mesh/deck/abaqus_parser.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

#include "mesh/deck/abaqus_elements.hpp"
#include "mesh/deck/abaqus_keywords.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// An entry of a set: a number, or the name of another set.
void add_member(std::string_view field, Spot spot, SetChunk* chunk) {
  if (field.empty()) return;
  if (const auto id = to_integer(field)) {
    chunk->ids.push_back(*id);
  } else {
    chunk->names.emplace_back(std::string(field), spot);
  }
}

SetChunk::Range range_of(const Lines& lines) {
  const Fields fields(lines.data(), lines.source(), lines.spot());
  constexpr int32_t kMost = std::numeric_limits<int32_t>::max();
  SetChunk::Range range{};
  range.spot = lines.spot();
  range.first = fields.integer(0, "first number", 1, kMost);
  range.last = fields.empty(1) ? range.first : fields.integer(1, "last number", 1, kMost);
  range.step = fields.empty(2) ? 1 : fields.integer(2, "step", 1, kMost);
  fields.at_most(3, "first, last, step");
  if (range.last < range.first) {
    fields.fail(fmt::format("found {} to {}, expected ascending numbers", range.first, range.last));
  }
  return range;
}

class Parser {
 public:
  Parser(Source* source, Ignore* ignore) : lines_(source), source_(*source), ignore_(ignore) {}

  RawDeck run() {
    Lines::Kind kind = lines_.next();
    while (kind != Lines::Kind::kEnd) {
      if (kind == Lines::Kind::kData) {
        source_.fail(lines_.spot(), fmt::format("found '{}', expected a keyword (*...)",
                                                lines_.data().substr(0, 40)));
      }
      kind = read_keyword();
    }
    if (scope_ != &deck_.model) source_.fail(scope_->spot, "found *PART without *END PART");
    if (step_ >= 0) source_.fail(step_, "found *STEP without *END STEP");
    return std::move(deck_);
  }

 private:
  Lines::Kind read_keyword() {
    const Keyword& keyword = lines_.keyword();
    if (ignore_->skips(keyword.name)) return skip_data();
    const Role role = role_of(keyword.key);
    check_place(keyword, role);
    if (role == Role::kMaterial) parent_ = Role::kMaterial;
    if (role == Role::kCoupling) parent_ = Role::kCoupling;
    switch (role) {
      case Role::kUnknown:
        source_.fail(keyword.spot, fmt::format("keyword {} is not supported; ignore = [\"{}\"] "
                                               "skips it with its data lines",
                                               keyword.name, keyword.name));
      case Role::kHarmless:
      case Role::kMaterialIdle:
        return skip_data();
      case Role::kNode:
        return read_nodes(&lines_, scope_, ignore_);
      case Role::kElement:
        return read_elements(&lines_, scope_, ignore_);
      case Role::kSet:
        return read_set();
      case Role::kStructure:
        return read_structure();
      case Role::kStepBegin:
        step_ = keyword.spot;
        return read_card();
      case Role::kStepEnd:
        step_ = -1;
        return read_card();
      default:
        return read_card();
    }
  }

  // What stands behind *MATERIAL describes it, until a keyword of another kind comes.
  void check_place(const Keyword& keyword, Role role) {
    const bool material = role == Role::kMaterialPart || role == Role::kMaterialIdle;
    const bool coupling = role == Role::kCouplingPart;
    if (material && parent_ != Role::kMaterial) misplaced(keyword, "behind *MATERIAL");
    if (coupling && parent_ != Role::kCoupling) misplaced(keyword, "behind *COUPLING");
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

  [[noreturn]] void misplaced(const Keyword& keyword, std::string_view place) const {
    source_.fail(keyword.spot, fmt::format("found {}, expected it {}", keyword.name, place));
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
    for (; kind == Lines::Kind::kData; kind = lines_.next()) card.add(lines_.data(), lines_.spot());
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
        new_chunk(&sets, keyword.required(of_nodes ? "NSET" : "ELSET", source_), keyword.spot);
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
      chunk.id_lines.emplace_back(chunk.ids.size(), lines_.spot());
      FieldWalk walk(lines_.data());
      std::string_view field;
      while (walk.next(&field)) add_member(field, lines_.spot(), &chunk);
    }
    return kind;
  }

  Lines::Kind read_structure() {
    const Keyword keyword = lines_.keyword();
    if (keyword.key == "PART") {
      begin_part(keyword);
    } else if (keyword.key == "ENDPART") {
      if (scope_ == &deck_.model) misplaced(keyword, "behind *PART");
      deck_.parts.push_back(std::move(part_));
      scope_ = &deck_.model;
    } else if (keyword.key == "INSTANCE") {
      return read_instance(keyword);
    } else if (keyword.key == "ENDINSTANCE") {
      misplaced(keyword, "behind *INSTANCE");
    }
    return no_data(keyword);
  }

  void begin_part(const Keyword& keyword) {
    if (scope_ != &deck_.model) misplaced(keyword, "behind *END PART");
    keyword.allow({"NAME"}, source_, ignore_);
    part_ = Scope();
    part_.name = keyword.required("NAME", source_);
    part_.spot = keyword.spot;
    for (const Scope& part : deck_.parts) {
      if (folded(part.name) == folded(part_.name)) {
        source_.fail(keyword.spot, fmt::format("found a second part {}", part_.name));
      }
    }
    scope_ = &part_;
  }

  Lines::Kind no_data(const Keyword& keyword) {
    const Lines::Kind kind = lines_.next();
    if (kind == Lines::Kind::kData) {
      source_.fail(lines_.spot(), fmt::format("found '{}', expected no data behind {}",
                                              lines_.data().substr(0, 40), keyword.name));
    }
    return kind;
  }

  // Shift in the first line; two points of an axis and an angle in degrees in the second.
  Lines::Kind read_instance(const Keyword& keyword) {
    if (scope_ != &deck_.model) misplaced(keyword, "outside of parts");
    keyword.allow({"NAME", "PART"}, source_, ignore_);
    InstanceLine instance;
    instance.name = keyword.required("NAME", source_);
    instance.part = keyword.required("PART", source_);
    instance.spot = keyword.spot;
    Lines::Kind kind = lines_.next();
    for (int line = 0; kind == Lines::Kind::kData; kind = lines_.next(), ++line) {
      place(Fields(lines_.data(), source_, lines_.spot()), line, &instance);
    }
    if (kind == Lines::Kind::kEnd || lines_.keyword().key != "ENDINSTANCE") {
      source_.fail(keyword.spot,
                   "expected *END INSTANCE behind the lines of *INSTANCE: what an "
                   "instance adds to its part is not supported");
    }
    deck_.instances.push_back(instance);
    return no_data(lines_.keyword());
  }

  static void place(const Fields& fields, int line, InstanceLine* instance) {
    if (line == 0) {
      fields.at_most(3, "translation of an instance");
      for (int k = 0; k < 3; ++k) instance->shift[k] = fields.number_or(k, 0.0, "translation");
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
    instance->rotation = Eigen::AngleAxisd(angle, (b - a) / length).toRotationMatrix();
    instance->shift = instance->rotation * (instance->shift - a) + a;
  }

  Lines lines_;
  const Source& source_;
  Ignore* ignore_;
  RawDeck deck_;
  Scope part_;
  Scope* scope_ = &deck_.model;
  Spot step_ = -1;  // of the step that is open
  Role parent_ = Role::kUnknown;
};

}  // namespace

SetChunk& new_chunk(IdSets* sets, const std::string& name, Spot spot) {
  IdSet& set = (*sets)[folded(name)];
  if (set.chunks.empty()) set.name = name;
  set.chunks.emplace_back();
  set.chunks.back().spot = spot;
  return set.chunks.back();
}

RawDeck parse(Source* source, Ignore* ignore) { return Parser(source, ignore).run(); }

}  // namespace clatter::mesh::deck::abaqus
