#pragma once
/// A law broke its contract while it was at work: what was computed with it is worth nothing.

#include <stdexcept>

namespace dualdamp::friction {

class LawFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace dualdamp::friction
