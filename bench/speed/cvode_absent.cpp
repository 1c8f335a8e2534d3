// In place of cvode_contender.cpp where SUNDIALS is not installed.
#include "bench/speed/contender.hpp"

namespace dualdamp::bench::speed {

std::vector<Contender> cvode_contenders(const StandardCase&) { return {}; }

}  // namespace dualdamp::bench::speed
