#pragma once
/// What every fuzzing harness shares. A harness is one source `fuzz_NAME.cpp` that defines `consume`.
///
/// It is linked twice: with libFuzzer (preset `fuzz`: clang, coverage, sanitizers), and with replay.cpp, which
/// needs no clang and runs it over given files and simple mutations of them, as the test suite does.

#include <stdexcept>
#include <string>
#include <string_view>

namespace dualdamp::fuzz {

/// Gives the input to the code under test. Throws, or ends by a signal, where that does what it does not promise:
/// another exception than `core::InputError`, a number that is not finite.
void consume(std::string_view input);

/// A promise of the code under test: throws where it is broken.
inline void require(bool holds, const std::string& promise) {
  if (!holds) throw std::logic_error("broken promise: " + promise);
}

}  // namespace dualdamp::fuzz
