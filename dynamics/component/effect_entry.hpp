// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The catalogue of effects: what each one is, whatever the scene.
#include <array>
#include <span>
#include <string_view>

namespace clatter::dynamics {

/// One kind of effect; a scene may have several rows of it, one a cylinder, a chain or a shaft.
struct EffectEntry {
  std::string_view name;
  std::string_view equation;  // what is computed, with its source
  std::string_view needs;     // data, by key
  std::string_view key;       // what switches it on; "always": nothing switches it off
  /// What it costs where it is on, measured: shares of the seconds of a sample's run; empty: not
  /// measured. docs/accuracy.md has the commands.
  std::string_view measured = "";
};

/// The entries of one folder.
struct EffectFamily {
  std::string_view heading;
  std::span<const EffectEntry> entries;
};

/// The entry of that name; a name that the catalogue lacks does not compile.
template <size_t kCount>
consteval const EffectEntry* find_effect(const std::array<EffectEntry, kCount>& catalogue,
                                         std::string_view name) {
  for (const EffectEntry& entry : catalogue)
    if (entry.name == name) return &entry;
  throw "no effect of that name in the catalogue";
}

}  // namespace clatter::dynamics
