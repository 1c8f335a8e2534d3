#include "identify/records/derived_records.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/numbers.hpp"
#include "identify/records/sensor_zero.hpp"

namespace dualdamp::identify {

namespace {

void keep(std::vector<double>& signal, std::size_t first, std::size_t last) {
  if (signal.empty()) return;
  signal.erase(signal.begin() + static_cast<std::ptrdiff_t>(last), signal.end());
  signal.erase(signal.begin(), signal.begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace

std::string keep_free_motion(History& history, std::size_t first, std::size_t last) {
  const std::size_t size = std::max({history.x.size(), history.v.size(), history.a.size()});
  if (first == 0 && last == size) return {};
  for (std::vector<double>* signal : {&history.y, &history.x, &history.v, &history.a, &history.force})
    keep(*signal, first, last);
  history.start += static_cast<double>(first) / history.sample_rate;
  constexpr int digits = 4;
  const double end = history.start + static_cast<double>(last - first - 1) / history.sample_rate;
  return "the free motion lasts from t = " + core::format_number(history.start, digits) + " to " +
         core::format_number(end, digits) + " s: samples outside it are left out";
}

std::vector<std::string> complete(Record& record, double frequency, double stiffness) {
  if (record.pairs || record.decay || record.histories.empty()) return {};
  std::vector<std::string> warnings;
  const auto warn = [&warnings](const History& history, const std::string& warning) {
    if (!warning.empty())
      warnings.push_back((history.sweep.empty() ? "" : "test '" + history.sweep + "': ") + warning);
  };
  for (History& history : record.histories) warn(history, remove_zero(history, stiffness));
  DerivedPairs driven = pairs_of(record.histories, frequency);
  const bool has_pairs = !driven.record.pairs.empty();
  // Without a stated frequency, a motion that is not steady is as good as one that is.
  if (has_pairs || !std::isnan(frequency)) {
    std::ranges::move(driven.warnings, std::back_inserter(warnings));
    for (std::size_t i = 0; i < record.histories.size(); ++i)
      record.histories[i].no_pair = std::move(driven.lacking[i]);
  }
  if (has_pairs) {
    record.pairs = std::move(driven.record);
    return warnings;
  }
  const auto is_free = [](const History& history) { return !history.x.empty() && !history.has_drive(); };
  const bool all_are_free = std::ranges::all_of(record.histories, is_free);
  std::vector<DecayRecord> decays;
  for (History& history : record.histories) {
    if (!is_free(history)) continue;
    DerivedDecay decay = decay_of(history);
    if (decay.is_driven) history.unknown_drive = decay.fault;
    if (!all_are_free) continue;
    for (const std::string& warning : decay.warnings) warn(history, warning);
    if (decay.record.extremes.empty()) continue;
    if (decay.rests)
      history.at_rest.assign(history.x.begin() + static_cast<std::ptrdiff_t>(decay.last), history.x.end());
    warn(history, keep_free_motion(history, decay.first, decay.last));
    warn(history, remove_zero(history, decay.record));
    decays.push_back(std::move(decay.record));
  }
  if (!decays.empty()) record.decay = mean_decay(decays);
  if (decays.size() > 1) warnings.push_back(mean_decay_warning(decays.size(), record.decay->extremes.size()));
  return warnings;
}

std::string mean_decay_warning(std::size_t decays, std::size_t extremes) {
  return "the extremes are means over " + std::to_string(decays) + " free vibrations, " + std::to_string(extremes) +
         " of each";
}

DecayRecord mean_decay(const std::vector<DecayRecord>& decays) {
  const auto length = [](const DecayRecord& decay) { return decay.extremes.size(); };
  const std::size_t longest = std::ranges::max(decays, {}, length).extremes.size();
  std::vector<const DecayRecord*> used;
  for (const DecayRecord& decay : decays)
    if (2 * length(decay) >= longest) used.push_back(&decay);
  std::size_t count = longest;
  for (const DecayRecord* decay : used) count = std::min(count, length(*decay));
  DecayRecord mean;
  mean.extremes.resize(count);
  const bool timed = std::ranges::all_of(used, [](const DecayRecord* decay) { return !decay->times.empty(); });
  if (timed) mean.times.resize(count);
  const auto n = static_cast<double>(used.size());
  for (const DecayRecord* decay : used) {
    const bool falls = count < 2 || decay->extremes[1] < decay->extremes[0];
    for (std::size_t i = 0; i < count; ++i) {
      mean.extremes[i] += (falls || used.size() == 1 ? 1.0 : -1.0) * decay->extremes[i] / n;
      // Times count from the first extreme of each decay; the start of the first decay is added below.
      if (timed) mean.times[i] += (decay->times[i] - decay->times[0]) / n;
    }
  }
  for (double& time : mean.times) time += used.front()->times[0];
  return mean;
}

}  // namespace dualdamp::identify
