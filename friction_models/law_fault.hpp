#pragma once
/// A law broke its contract while a motion was computed. The results are not valid.

#include <stdexcept>

namespace dualdamp::friction {

class LawFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace dualdamp::friction
