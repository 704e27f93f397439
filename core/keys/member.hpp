// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A member of a struct by its bytes, for the rows of keys.hpp.
#include <cstddef>
#include <string>
#include <string_view>

namespace clatter::keys {

template <class T>
T& member(std::byte* bytes) {
  return *reinterpret_cast<T*>(bytes);
}

template <class T>
const T& member(const std::byte* bytes) {
  return *reinterpret_cast<const T*>(bytes);
}

/// A TOML string, quoted and escaped.
std::string toml_text(std::string_view text);
/// A TOML key: bare where it may be.
std::string toml_key(std::string_view text);

}  // namespace clatter::keys
