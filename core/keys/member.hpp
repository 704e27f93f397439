// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A member of a struct by its bytes, for the rows of keys.hpp.
#include <cstddef>
#include <string>

namespace clatter::keys {

template <class T>
T& member(std::byte* bytes) {
  return *reinterpret_cast<T*>(bytes);
}

template <class T>
const T& member(const std::byte* bytes) {
  return *reinterpret_cast<const T*>(bytes);
}

inline std::string quoted(const std::string& text) { return "\"" + text + "\""; }

}  // namespace clatter::keys
