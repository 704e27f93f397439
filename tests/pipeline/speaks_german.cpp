// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded first (LD_PRELOAD): a library that takes the language of the session for all of its
// process, in C and in C++, before main().
#include <clocale>
#include <locale>

namespace {

[[gnu::constructor]] void speak_as_the_session_does() {
  std::setlocale(LC_ALL, "");
  std::locale::global(std::locale(""));
}

}  // namespace
