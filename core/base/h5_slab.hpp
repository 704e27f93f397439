// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Parts of datasets that need not all be in memory: a mode shape, some columns of a matrix.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"

namespace clatter {

/// Slab `index` along the first dimension of dataset `name`. InputError when the dataset is not
/// three-dimensional, not numeric, or too short.
RowMatrix read_slab(const std::filesystem::path& path, const std::string& name, int64_t index);

/// Values [first, first + count) of a list of numbers. InputError when the dataset is not a list of
/// such numbers, or too short.
std::vector<double> read_part_of_doubles(const std::filesystem::path& path, const std::string& name,
                                         int64_t first, int64_t count);
std::vector<int32_t> read_part_of_ints(const std::filesystem::path& path, const std::string& name,
                                       int64_t first, int64_t count);

}  // namespace clatter
