// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/deck_origin.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/base/error.hpp"
#include "core/base/h5_file.hpp"
#include "core/base/units.hpp"

namespace clatter {
namespace {

int32_t number_of(const H5File& file, const std::string& name) {
  const int64_t number = file.get_int("/", name);
  if (number < 0 || number > std::numeric_limits<int32_t>::max())
    throw InputError(fmt::format("{}: attribute {}: found {}, expected a number of a deck",
                                 file.path().string(), name, number));
  return static_cast<int32_t>(number);
}

}  // namespace

void write_deck_origin(H5File& file, const DeckOrigin& deck) {
  if (!deck.known()) return;
  file.set("/", "deck_units", deck.units);
  file.set("/", "deck_largest_node", static_cast<int64_t>(deck.largest_node));
  file.set("/", "deck_largest_element", static_cast<int64_t>(deck.largest_element));
}

DeckOrigin read_deck_origin(const H5File& file) {
  if (!file.has_attribute("/", "deck_units")) return {};
  const std::string units = file.get_string("/", "deck_units");
  return {unit_system_named(units, file.path().string() + ": attribute deck_units").name,
          number_of(file, "deck_largest_node"), number_of(file, "deck_largest_element")};
}

}  // namespace clatter
