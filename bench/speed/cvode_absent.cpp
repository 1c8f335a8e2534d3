// In place of cvode_contender.cpp where SUNDIALS is not installed.
#include "bench/speed/contender.hpp"
#include "bench/speed/smooth_contender.hpp"

namespace dualdamp::bench::speed {

std::vector<Contender> cvode_contenders(const StandardCase&) { return {}; }
std::vector<SmoothContender> cvode_smooth(const SmoothCase&, double) { return {}; }

}  // namespace dualdamp::bench::speed
