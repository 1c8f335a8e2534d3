#include "identify/validate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dualdamp::identify {

namespace {

using Faults = std::vector<core::Diagnostic>;

void add(Faults& faults, const std::string& where, const std::string& message, const std::string& allowed) {
  faults.push_back({{}, where + message, allowed, {}, {}});
}

bool is_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

bool is_positive(double value) { return value > 0.0 && std::isfinite(value); }

/// A quantity that may be unknown.
void check(double value, bool may_be_zero, const std::string& name, Faults& faults) {
  if (std::isnan(value) || is_positive(value) || (may_be_zero && value == 0.0)) return;
  add(faults, name, may_be_zero ? " must be finite and not negative" : " must be positive and finite",
      "a finite number " + std::string(may_be_zero ? ">= 0" : "> 0"));
}

void check(const Pair& pair, const std::string& where, Faults& faults) {
  check(pair.omega, false, where + "the forcing frequency", faults);
  // By noise the reading of a small amplitude may be below zero.
  for (const auto& [value, name] : {std::pair{pair.fundamental, "fundamental amplitude"},
                                    {pair.mean_square_speed, "mean square speed"},
                                    {pair.phase, "phase"}})
    if (std::isinf(value)) add(faults, where, std::string("the ") + name + " is not finite", "a finite number");
}

void check(const DecayRecord& decay, Faults& faults) {
  if (!is_finite(decay.extremes)) add(faults, "decay: ", "an extreme is not finite", "finite numbers");
  if (decay.times.empty()) return;
  if (decay.times.size() != decay.extremes.size())
    add(faults, "decay: ", "there are not as many times as extremes", "one time for each extreme");
  if (!is_finite(decay.times) || !std::ranges::is_sorted(decay.times))
    add(faults, "decay: ", "the times are not finite and increasing", "finite increasing numbers");
}

void check(const History& history, const std::string& where, Faults& faults) {
  if (std::string fault = shape_fault(history); !fault.empty()) add(faults, where, fault, {});
  if (!std::isfinite(history.start)) add(faults, where, "the time of the first sample is not finite", {});
  if (std::string fault = sample_fault(history); !fault.empty()) add(faults, where, fault, "finite numbers");
}

}  // namespace

std::vector<core::Diagnostic> faults_of(const Record& record) {
  Faults faults;
  if (record.pairs)
    for (std::size_t i = 0; i < record.pairs->pairs.size(); ++i)
      check(record.pairs->pairs[i], "pair " + std::to_string(i + 1) + ": ", faults);
  if (record.decay) check(*record.decay, faults);
  for (std::size_t i = 0; i < record.histories.size(); ++i)
    check(record.histories[i], "history " + std::to_string(i + 1) + ": ", faults);
  return faults;
}

std::vector<core::Diagnostic> faults_of(const KnownConstants& constants) {
  Faults faults;
  check(constants.mass, false, "the mass", faults);
  check(constants.stiffness, true, "the stiffness", faults);
  check(constants.frequency, false, "the forcing frequency", faults);
  return faults;
}

void require_sound(const Record& record) {
  if (std::vector<core::Diagnostic> faults = faults_of(record); !faults.empty())
    throw core::InputError(std::move(faults));
}

std::string sample_fault(const History& history) {
  for (const auto* signal : {&history.y, &history.x, &history.v, &history.a, &history.force})
    if (!is_finite(*signal)) return "a sample is not finite";
  return {};
}

std::string shape_fault(const History& history) {
  if (!is_positive(history.sample_rate)) return "the sample rate is not positive";
  std::size_t length = 0;
  for (const auto* signal : {&history.y, &history.x, &history.v, &history.a, &history.force})
    length = std::max(length, signal->size());
  for (const auto* signal : {&history.y, &history.x, &history.v, &history.a, &history.force})
    if (!signal->empty() && signal->size() != length) return "the signals are of different length";
  return {};
}

}  // namespace dualdamp::identify
