#pragma once
/// Where the tree of sources lies; only one translation unit knows, so that the compiler cache serves every clone.

#include <filesystem>
#include <string>

namespace dualdamp::testing {

/// The path of a file, given from the root of the tree.
std::filesystem::path in_tree(const std::string& path);

}  // namespace dualdamp::testing
