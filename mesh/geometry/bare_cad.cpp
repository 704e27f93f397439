// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/bare_cad.hpp"

#include <fmt/format.h>

#include "core/base/json_line.hpp"
#include "core/base/log.hpp"
#include "core/base/whole_file.hpp"
#include "core/keys/schema_line.hpp"
#include "mesh/geometry/cad_unit.hpp"

namespace clatter::mesh {

std::filesystem::path description_beside(const std::filesystem::path& output) {
  std::filesystem::path stem = output;
  if (stem.extension() == ".h5") stem.replace_extension();
  if (stem.extension() == ".mesh" || stem.extension() == ".faces") stem.replace_extension();
  return stem += ".mesh.toml";
}

std::string cad_description(const std::filesystem::path& source,
                            const std::filesystem::path& description, double element_size_mm) {
  std::error_code unrelated;
  const std::filesystem::path folder = std::filesystem::absolute(description).parent_path();
  std::filesystem::path relative =
      std::filesystem::relative(std::filesystem::absolute(source), folder, unrelated);
  if (unrelated || relative.empty()) relative = std::filesystem::absolute(source);
  const std::string unit = cad_unit(source);
  std::string text =
      keys::schema_line("mesh") +
      fmt::format(
          "name = {}\nkind = \"cad\"\nlength_unit = \"mm\"         # of this description; "
          "{}\n\n[cad]\n"
          "source = {}\n",
          json_text(source.stem().string()),
          unit.empty() ? "the file gives no unit" : fmt::format("the file is in {}", unit),
          json_text(relative.string()));
  if (element_size_mm > 0.0)
    text += fmt::format(
        "\n[mesh]\nelement_size_mm = {}\n\n"
        "# [surface.NAME]             # `clatter-mesh faces` lists the faces\n"
        "# cylinder = {{ radius = 10, point = [0, 0, 0], axis = [0, 0, 1] }}\n",
        element_size_mm);
  return text;
}

void keep_description(const std::filesystem::path& description, const std::string& text) {
  if (!std::filesystem::exists(description)) {
    write_whole_file(description, text);
    say(fmt::format("{}: written: the description that was meshed, for changes",
                    description.string()));
    return;
  }
  if (read_whole_file(description) == text) return;
  say(fmt::format("{}: exists and is left as it is: the CAD file was meshed with defaults",
                  description.string()));
}

}  // namespace clatter::mesh
