#include "identify/records/usable_histories.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/validate.hpp"

namespace dualdamp::identify {

namespace {

double mean_square(std::span<const double> signal) {
  double mean = 0.0;
  for (const double value : signal) mean += value;
  mean /= static_cast<double>(signal.size());
  double sum = 0.0;
  for (const double value : signal) sum += (value - mean) * (value - mean);
  return sum / static_cast<double>(signal.size());
}

}  // namespace

double mean_frequency(const History& history) {
  const std::size_t step = std::max<std::size_t>(1, history.x.size() / 2000);
  std::vector<double> thinned;
  for (std::size_t i = 0; i < history.x.size(); i += step) thinned.push_back(history.x[i]);
  const double rate = history.sample_rate / static_cast<double>(step);
  const double motion = mean_square(thinned);
  return motion > 0.0 ? std::sqrt(mean_square(central_difference(thinned, rate)) / motion) / core::two_pi : 0.0;
}

std::vector<double> cutoffs_for(const History& history, const FilterOptions& options) {
  if (!options.cutoffs.empty()) return options.cutoffs;
  if (!history.v.empty() && !history.a.empty()) return {0.0};
  const double rate = history.sample_rate;
  const double first = std::min(std::max(rate / 20.0, 8.0 * mean_frequency(history)), 0.2 * rate);
  return {first, 0.6 * first, 0.4 * first};
}

std::string fault_of(const History& history) {
  if (std::string fault = shape_fault(history); !fault.empty()) return fault;
  if (history.x.empty()) return std::string(without_displacement);
  if (history.x.size() < 16) return "there are fewer than 16 samples";
  return sample_fault(history);
}

std::string fault_of_drive(const History& history) {
  if (history.unknown_drive.empty()) return {};
  return history.unknown_drive +
         ": record the force or the motion of the base too, or keep the part in which nothing drives the mass";
}

std::string fault_of_cutoff(const History& history, double cutoff) {
  if (cutoff == 0.0) return {};
  const std::string text = "a cut-off frequency of " + core::format_number(cutoff, 4) + " Hz ";
  if (!(cutoff > 0.0)) return text + "is not positive";
  if (cutoff > 0.45 * history.sample_rate) return text + "is above 0.45 of the sample rate";
  const std::size_t fewest = 4 * ZeroPhaseFilter(cutoff, history.sample_rate).edge();
  if (history.x.size() < fewest)
    return "the record is too short for its filter: it has " + std::to_string(history.x.size()) + " samples, and " +
           text + "needs " + std::to_string(fewest);
  return {};
}

std::vector<NumberedHistory> usable_histories(const Record& record, const FilterOptions& options,
                                              Estimate& estimate, UnmeasuredDrive drive) {
  std::vector<NumberedHistory> usable;
  if (std::string lack = lacks_histories(record); !lack.empty()) {
    refuse(estimate, std::move(lack));
    return usable;
  }
  for (std::size_t i = 0; i < record.histories.size(); ++i) {
    const History& history = record.histories[i];
    std::string fault = fault_of(history);
    if (fault.empty() && drive == UnmeasuredDrive::none) fault = fault_of_drive(history);
    if (fault.empty()) {
      for (const double cutoff : cutoffs_for(history, options))
        if (fault.empty()) fault = fault_of_cutoff(history, cutoff);
    }
    const int number = static_cast<int>(i) + 1;
    if (fault.empty())
      usable.push_back({number, &history});
    else
      estimate.excluded.push_back({number, std::move(fault)});
  }
  if (usable.empty()) refuse(estimate, "no history can be used: " + estimate.excluded.front().reason);
  return usable;
}

std::optional<NumberedHistory> longest_history(const Record& record, const KnownConstants& constants,
                                               Estimate& estimate, UnmeasuredDrive drive) {
  const std::vector<NumberedHistory> histories = usable_histories(record, {.cutoffs = {0.0}}, estimate, drive);
  if (histories.empty()) return std::nullopt;
  if (std::string fault = lacks_constants(constants); !fault.empty()) {
    refuse(estimate, std::move(fault));
    return std::nullopt;
  }
  const auto length = [](const NumberedHistory& item) { return item.history->x.size(); };
  const NumberedHistory longest = *std::ranges::max_element(histories, {}, length);
  for (const NumberedHistory& item : histories)
    if (item.number != longest.number)
      estimate.excluded.push_back({item.number, "the method takes the longest history"});
  return longest;
}

double largest_speed(const PreparedHistory& motion) {
  double fastest = 0.0;
  for (const double v : motion.v) fastest = std::max(fastest, std::abs(v));
  return fastest;
}

double least_speed_for(double largest_speed, double share, const RegressionOptions& options) {
  return options.least_speed > 0.0 ? options.least_speed : share * largest_speed;
}

std::string lacks_histories(const Record& record) {
  return record.histories.empty() ? "the record holds no time histories" : "";
}

}  // namespace dualdamp::identify
