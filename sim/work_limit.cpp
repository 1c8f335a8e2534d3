#include "sim/work_limit.hpp"

namespace dualdamp::sim {

namespace {

thread_local WorkLimit* innermost = nullptr;

}  // namespace

WorkLimit::WorkLimit(long most) : outer_(innermost), most_(most) { innermost = this; }

WorkLimit::~WorkLimit() { innermost = outer_; }

bool WorkLimit::allows(long work) {
  if (innermost == nullptr || work <= innermost->most_) return true;
  innermost->is_exceeded_ = true;
  return false;
}

long WorkLimit::most() { return innermost == nullptr ? std::numeric_limits<long>::max() : innermost->most_; }

}  // namespace dualdamp::sim
