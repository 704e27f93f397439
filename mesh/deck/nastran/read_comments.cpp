// SPDX-License-Identifier: GPL-3.0-or-later
// "$ clatter" comments (writer.hpp): content that Nastran has no card for.
#include <fmt/format.h>

#include "mesh/deck/nastran/cards.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

// Removes and returns the first word of `text`.
std::string_view take_word(std::string_view& text) {
  text = trimmed(text);
  const auto word = text.substr(0, text.find(' '));
  text = trimmed(text.substr(word.size()));
  return word;
}

void read_name(std::string_view text, Origin origin, const Source& source,
               std::map<int32_t, std::string>& names) {
  const auto number = to_integer(take_word(text));
  if (!number || *number < 1 || text.empty()) {
    source.fail(origin, "comment of clatter: expected a number and a name");
  }
  names[*number] = text;
}

void read_face(FaceType type, std::string_view text, Origin origin, const Source& source,
               RawDeck::NamedSurface& surface) {
  surface.types.push_back(type);
  for (int i = 0; i < kMaxFaceNodes; ++i) {
    surface.nodes.push_back(0);
    if (i >= traits(type).nodes) continue;
    const auto node = to_integer(take_word(text));
    if (!node || *node < 1) {
      source.fail(origin, fmt::format("comment of clatter: expected the {} nodes of a {}",
                                      traits(type).nodes, traits(type).name));
    }
    surface.nodes.back() = *node;
  }
}

void read_exact(std::string_view text, RawDeck& raw) {
  const auto id = to_integer(take_word(text));
  const auto x = to_number(take_word(text)), y = to_number(take_word(text)),
             z = to_number(take_word(text));
  if (id && x && y && z) raw.exact[*id] = {*x, *y, *z};
}

}  // namespace

void read_comment(std::string_view text, Origin origin, const Source& source, RawDeck& raw) {
  const std::string_view word = take_word(text);
  if (word == "region") {
    read_name(text, origin, source, raw.region_names);
  } else if (word == "at") {
    read_exact(text, raw);
  } else if (word == "hanging") {
    const auto first = to_integer(take_word(text));
    if (!first || *first < 1) source.fail(origin, "comment of clatter: expected a number");
    raw.first_hanging = *first;
  } else if (word == "set") {
    read_name(text, origin, source, raw.set_names);
  } else if (word == "surface") {
    if (text.empty()) source.fail(origin, "comment of clatter: expected the name of a surface");
    raw.surfaces.push_back({std::string(text), origin, {}, {}});
  } else {
    for (int t = 0; t < kFaceTypes && !raw.surfaces.empty(); ++t) {
      const auto type = static_cast<FaceType>(t);
      if (word == traits(type).name) read_face(type, text, origin, source, raw.surfaces.back());
    }
  }
}

}  // namespace clatter::mesh::deck::nastran
