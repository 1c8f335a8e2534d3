#include "tests/support/source_tree.hpp"

namespace dualdamp::testing {

std::filesystem::path in_tree(const std::string& path) { return std::filesystem::path(DUALDAMP_SOURCE_DIR) / path; }

}  // namespace dualdamp::testing
