#pragma once
/// The path of the source tree. Only one translation unit contains it, so that compiled files are equal in every
/// clone.

#include <filesystem>
#include <string>

namespace dualdamp::testing {

/// The path of a file, given from the root of the tree.
std::filesystem::path in_tree(const std::string& path);

}  // namespace dualdamp::testing
