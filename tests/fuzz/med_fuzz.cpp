// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever the HDF5 file holds, it is either a mesh of MED or an InputError. The library itself is
// not fuzzed: the input is a script that makes the file, a line for each dataset or attribute.
//
//   i ENS_MAA/a/-1/MAI/TE4/NOD 1 2 3 4     integers
//   d ENS_MAA/a/-1/NOE/COO 0 0 0           floating-point numbers
//   n FAS/a/ELEME/f/GRO/NOM body foot      names of 80 bytes
//   a ENS_MAA/a ESP 3                      integer attribute of what a line before made
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/plain_h5.hpp"
#include "mesh/deck/msh/med_reader.hpp"
#include "tests/fuzz/whole_deck.hpp"

namespace {

template <class T>
std::vector<T> rest(std::istream& words) {
  std::vector<T> values;
  for (T value; words >> value;) values.push_back(value);
  return values;
}

void add(const std::string& line, clatter::PlainH5& file) {
  std::istringstream words(line);
  std::string kind, name, attribute;
  words >> kind >> name;
  if (kind == "i") file.write(name, rest<int32_t>(words));
  if (kind == "d") file.write(name, rest<double>(words));
  if (kind == "n") file.write_fixed(name, rest<std::string>(words), 80);
  int32_t value = 0;
  if (kind == "a" && words >> attribute >> value) file.set(name, attribute, value);
}

/// False for a script that makes no file.
bool make(std::istream& script, const std::filesystem::path& path) {
  try {
    clatter::PlainH5 file(path);
    for (std::string line; std::getline(script, line);) add(line, file);
    file.commit();
  } catch (const std::exception&) {
    return false;
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::filesystem::path path =
      "/dev/shm/clatter-fuzz-" + std::to_string(getpid()) + ".med";
  auto script = clatter::test::stream_of(data, size);
  if (!make(script, path)) return -1;
  try {
    clatter::test::finish(clatter::mesh::read_med(path, {}));
  } catch (const clatter::InputError&) {
  }
  std::filesystem::remove(path);
  return 0;
}
