#include "bench/analyses.hpp"

#include "bench/mechanisms.hpp"
#include "bench/stress_test.hpp"
#include "scenarios/analyses.hpp"

namespace dualdamp::bench {

namespace {

scenarios::AnalysisList all() {
  scenarios::AnalysisList list = scenarios::analyses();
  // `formula`, which computes no motion, stays last.
  list.insert(list.end() - 1, {
                                  &stress_test_analysis(),
                                  &mechanisms_analysis(),
                              });
  return list;
}

}  // namespace

const scenarios::AnalysisList& analyses() {
  static const scenarios::AnalysisList list = all();
  return list;
}

}  // namespace dualdamp::bench
