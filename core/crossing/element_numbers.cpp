#include "core/crossing/element_numbers.hpp"

namespace dualdamp::core {

void ElementNumbers::grow(std::size_t size) {
  auto* const numbers = new double[2 * size];
  if (re.first_ != few_) delete[] re.first_;
  use(numbers, size);
}

}  // namespace dualdamp::core
