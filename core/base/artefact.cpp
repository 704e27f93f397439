// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/artefact.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>

#include "core/base/changed_inputs.hpp"
#include "core/base/error.hpp"

namespace clatter {

namespace {

// Instead of the hash of an input that changed while the stage worked (hard case P5).
constexpr const char* kChangedInput = "changed while it was in use";

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr);
  }
  void add(std::string_view bytes) { EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()); }
  /// 64 hexadecimal digits; no more data can be added.
  std::string finish() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int length = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &length);
    std::string hex;
    for (unsigned int i = 0; i < length; ++i) hex += fmt::format("{:02x}", digest[i]);
    return hex;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string sha256_of_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(fmt::format("{}: cannot be read", path.string()));
  Sha256 hash;
  std::vector<char> buffer(1 << 20);
  while (stream) {
    stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    hash.add({buffer.data(), static_cast<size_t>(stream.gcount())});
  }
  return hash.finish();
}

std::string sha256_of_bytes(std::initializer_list<std::string_view> pieces) {
  Sha256 hash;
  for (const std::string_view piece : pieces) hash.add(piece);
  return hash.finish();
}

void write_provenance(H5File& file, const Provenance& provenance) {
  file.set("/", "schema", provenance.schema);
  file.set("/", "version", version());
  file.set("/", "config", provenance.config);
  std::vector<std::string> paths, hashes;
  for (const auto& input : provenance.inputs) {
    paths.push_back(input.string());
    hashes.push_back(changed_since_planned(input) ? kChangedInput : sha256_of_file(input));
  }
  file.write("inputs/path", paths);
  file.write("inputs/sha256", hashes);
}

void write_timing(H5File& file, const StepClock& clock) {
  std::vector<std::string> names;
  std::vector<double> seconds, peak;
  for (const auto& step : clock.steps()) {
    names.push_back(step.name);
    seconds.push_back(step.seconds);
    peak.push_back(step.peak_gib);
  }
  file.write("timing/step", names);
  file.write("timing/seconds", seconds);
  file.write("timing/peak_gib", peak);
  file.set("timing", "total_seconds", clock.total_seconds());
  // Steps of a child process have their own peaks.
  peak.push_back(static_cast<double>(peak_memory_bytes()) / 1073741824.0);
  file.set("timing", "peak_gib", *std::max_element(peak.begin(), peak.end()));
}

H5File open_artefact(const std::filesystem::path& path, const std::string& schema) {
  H5File file = H5File::open(path);
  const std::string found =
      file.has_attribute("/", "schema") ? file.get_string("/", "schema") : "no schema";
  if (found != schema) {
    throw InputError(
        fmt::format("{}: schema: found {}, expected {}", path.string(), found, schema));
  }
  return file;
}

std::string version() { return CLATTER_VERSION; }

}  // namespace clatter
