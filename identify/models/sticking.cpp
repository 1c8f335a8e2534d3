#include "identify/models/sticking.hpp"

#include "sim/analytic/den_hartog.hpp"

namespace dualdamp::identify {

double Sticking::limit(double r) {
  if (r != r_) {
    r_ = r;
    limit_ = sim::analytic::non_sticking_limit(sim::analytic::den_hartog(zeta_, r));
  }
  return limit_;
}

}  // namespace dualdamp::identify
