#pragma once
/// The problems of an input that is refused.

#include <vector>

#include "core/diagnostics.hpp"

namespace dualdamp::test {

/// Empty if `read` accepts its input.
template <typename Read>
std::vector<core::Diagnostic> problems_of(Read read) {
  try {
    (void)read();
  } catch (const core::InputError& error) {
    return error.diagnostics();
  }
  return {};
}

}  // namespace dualdamp::test
