// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// One slab of a three-dimensional dataset, so that mode shapes need not all be in memory.
#include <filesystem>
#include <string>

#include "core/base/h5_file.hpp"

namespace clatter {

/// Slab `index` along the first dimension of dataset `name`. InputError when the dataset is not
/// three-dimensional, not numeric, or too short.
RowMatrix read_slab(const std::filesystem::path& path, const std::string& name, int64_t index);

}  // namespace clatter
