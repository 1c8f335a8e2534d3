/// libFuzzer's entry.

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/harness.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  dualdamp::fuzz::consume({reinterpret_cast<const char*>(data), size});
  return 0;
}
