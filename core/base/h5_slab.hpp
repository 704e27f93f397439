#pragma once
// One entry of a dataset of three extents, so that many shapes need not be in memory at once.
#include <filesystem>
#include <string>

#include "core/base/h5_file.hpp"

namespace clatter {

/// Entry `index` of the first extent of dataset `name`, (second, third). InputError when it is not
/// of three extents, of numbers, or shorter.
RowMatrix read_slab(const std::filesystem::path& path, const std::string& name, int64_t index);

}  // namespace clatter
