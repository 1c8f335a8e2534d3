#include "identify/readers/channel_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/numbers.hpp"
#include "identify/readers/signal_checks.hpp"
#include "identify/records/turning_points.hpp"

namespace dualdamp::identify {

namespace {

using Samples = std::span<const double>;

void leave_out(DataTable& table, std::string_view name) {
  std::erase_if(table.columns, [name](const DataColumn& column) { return column.known->name == name; });
}

void complain(const DataTable& table, std::string_view name, std::string message, std::string allowed,
              Problems& problems) {
  core::Diagnostic problem = table.show(0, *known_column(name));
  problem.message = std::move(message);
  problem.allowed = std::move(allowed);
  problems.add(std::move(problem));
}

/// The constant factor of two columns, to the last digit; nothing if there is none.
std::optional<double> factor_between(Samples a, Samples b) {
  constexpr double rounding = 1e-12;
  double largest = 0.0;
  double factor = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i]) > largest) {
      largest = std::abs(a[i]);
      factor = b[i] / a[i];
    }
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(std::abs(b[i] - factor * a[i]) <= rounding * std::abs(b[i]))) return std::nullopt;
  return factor == 0.0 ? std::nullopt : std::optional(factor);
}

/// "hold the same numbers" where both have one unit, or units that differ by a thousand.
bool is_factor_of_units(double factor) {
  constexpr double rounding = 1e-9;
  return std::ranges::any_of(std::array{1.0, 1e3, 1e-3},
                             [factor](double unit) { return std::abs(factor / unit - 1.0) <= rounding; });
}

/// Whether both hold the same numbers.
bool are_copies(Samples a, Samples b) {
  constexpr std::size_t fewest = 3;
  if (a.size() < fewest || a.size() != b.size() || is_constant(a)) return false;
  const auto factor = factor_between(a, b);
  return factor && is_factor_of_units(*factor);
}

std::string copies(std::string_view first, std::string_view second) {
  return "columns " + std::string(first) + " and " + std::string(second) + " hold the same numbers: one is a copy";
}

constexpr const char* measured_columns = "two columns that were measured";

/// How often the signal turns back by more than `height`.
std::size_t turns(Samples signal, double height) {
  const std::size_t extremes = zigzag(signal, height).size();
  return extremes < 2 ? 0 : extremes - 2;  // the first and the last one are its ends
}

/// The longest run of equal values.
std::pair<std::size_t, std::size_t> longest_rest(Samples signal) {
  std::pair<std::size_t, std::size_t> longest{0, 0};
  for (std::size_t i = 0; i < signal.size();) {
    std::size_t end = i + 1;
    while (end < signal.size() && signal[end] == signal[i]) ++end;
    if (end - i > longest.second - longest.first) longest = {i, end};
    i = end;
  }
  return longest;
}

/// Where one signal rests at one value for a share of the test, and what another one does meanwhile.
class Rest {
 public:
  Rest(Samples resting, Samples other, double least_share)
      : whole_(other), share_(least_share), count_(resting.size()) {
    std::tie(first_, last_) = longest_rest(resting);
    if (!other.empty()) other_ = other.subspan(first_, last_ - first_);
  }

  [[nodiscard]] bool is_long() const {
    constexpr std::size_t fewest = 16;
    const std::size_t length = last_ - first_;
    return length >= fewest && static_cast<double>(length) >= share_ * static_cast<double>(count_);
  }

  /// Of the other signal, by more than a fifth of its range in the test.
  [[nodiscard]] std::size_t turns_meanwhile() const {
    constexpr double height = 0.2;
    return turns(other_, height * range_of(whole_));
  }

  /// Whether the other signal goes on swinging without a decay.
  [[nodiscard]] bool goes_on() const {
    constexpr std::size_t fewest_turns = 10;
    constexpr double least = 0.9;
    if (turns_meanwhile() < fewest_turns) return false;
    const std::size_t quarter = other_.size() / 4;
    return range_of(other_.last(quarter)) >= least * range_of(other_.first(quarter)) &&
           range_of(other_.first(quarter)) >= least * range_of(whole_.first(first_));
  }

  [[nodiscard]] std::string where(const History& history) const {
    const auto time = [&history](std::size_t i) {
      return core::format_number(history.start + static_cast<double>(i) / history.sample_rate, 4) + " s";
    };
    if (last_ == count_) return "from " + time(first_) + " on";
    return "from " + time(first_) + " to " + time(last_ - 1);
  }

 private:
  Samples whole_;
  Samples other_;
  double share_;
  std::size_t count_;
  std::size_t first_ = 0;
  std::size_t last_ = 0;
};

std::string subject_of(const History& history, std::string_view name) {
  return (history.sweep.empty() ? "" : "test '" + history.sweep + "': ") + "column " + std::string(name);
}

/// A channel of the mass that x contradicts.
void leave_out_dead(std::vector<double>& channel, std::string_view name, std::size_t fewest_turns,
                    const History& history, std::vector<std::string>& warnings) {
  constexpr double share = 0.1;
  if (channel.empty() || history.x.empty()) return;
  const Rest rest(channel, history.x, share);
  if (!rest.is_long() || rest.turns_meanwhile() < fewest_turns) return;
  warnings.push_back(subject_of(history, name) + " stays at one value " + rest.where(history) +
                     " while x moves: its sensor gave no signal, and the column is not used");
  channel.clear();
}

/// Whether the test has x and another signal, and x rests while that one goes on.
bool x_is_dead(const History& history, const std::vector<double>& other) {
  constexpr double share = 0.5;
  if (history.x.empty() || other.empty()) return false;
  const Rest rest(history.x, other, share);
  return rest.is_long() && rest.turns_meanwhile() > 2;
}

void warn_of_rest(const std::vector<double>& channel, std::string_view name, const std::vector<double>& other,
                  std::string_view other_name, const History& history, std::vector<std::string>& warnings) {
  constexpr double share = 0.5;
  if (channel.empty() || other.empty() || is_constant(channel)) return;
  const Rest rest(channel, other, share);
  if (!rest.is_long() || !rest.goes_on()) return;
  warnings.push_back(subject_of(history, name) + " stays at one value " + rest.where(history) + " while " +
                     std::string(other_name) +
                     " goes on as before: if its sensor gave no signal there, leave these rows out");
}

/// v and a are not needed beside another motion of the mass.
bool check_derivative(DataTable& table, std::string_view name, bool is_imposed, Problems& problems,
                      std::vector<std::string>& warnings) {
  const DataColumn* column = table.find(name);
  if (column == nullptr || column->values.size() < 2 || !is_constant(column->values)) return true;
  if (is_imposed && (name == "a" || column->values.front() != 0.0)) return true;
  const std::string subject = "column " + std::string(name) + " is constant: ";
  const bool is_needed = std::ranges::none_of(std::array{"x", "v", "a"}, [&](std::string_view other) {
    const DataColumn* found = table.find(other);
    return found != nullptr && !is_constant(found->values);
  });
  if (is_needed) {
    complain(table, name, subject + "its sensor gave no signal", "the signal of a motion", problems);
    return false;
  }
  warnings.push_back(subject + "its sensor gave no signal, and the column is not used");
  leave_out(table, name);
  return true;
}

/// Whether a column changes by more than a twentieth of its largest value.
bool changes(const DataColumn* column) {
  constexpr double least = 0.05;
  return column != nullptr && range_of(column->values) > least * std::ranges::max(column->values);
}

/// Phases that no row of these pairs can have in common with another one.
bool is_dead_phase(const DataTable& table) {
  constexpr double zero = 1e-6;
  const DataColumn* phase = table.find("phase");
  if (phase == nullptr) return false;
  std::vector<double> measured;
  std::ranges::copy_if(phase->values, std::back_inserter(measured),
                       [](double value) { return !std::isnan(value); });
  constexpr std::size_t fewest = 3;
  if (measured.size() < fewest || !is_constant(measured)) return false;
  // Without a lag no work is done. At one frequency a phase may be constant: at resonance all are a quarter of a
  // period. Whether it is in another unit than stated is asked later.
  return std::abs(std::sin(measured.front())) < zero || changes(table.find("omega"));
}

/// Two copies of a signal that swings. Two ramps may be alike: a mass that is carried along.
std::optional<ChannelFault> copy_in(const History& history) {
  constexpr double height = 0.2;
  const std::array<std::pair<const char*, const std::vector<double>*>, 5> channels = {
      {{"x", &history.x}, {"y", &history.y}, {"v", &history.v}, {"a", &history.a}, {"force", &history.force}}};
  for (std::size_t i = 0; i < channels.size(); ++i)
    for (std::size_t k = i + 1; k < channels.size(); ++k) {
      const auto& [name, samples] = channels[i];
      if (are_copies(*samples, *channels[k].second) && turns(*samples, height * range_of(*samples)) > 1)
        return ChannelFault{channels[k].first, copies(name, channels[k].first), measured_columns};
    }
  return std::nullopt;
}

/// Fewer than two turns: the force of friction is constant in one direction.
bool is_dead_in_loop(const DataTable& table, const DataColumn& force) {
  constexpr double height = 0.2;
  const DataColumn* x = table.find("x") != nullptr ? table.find("x") : table.find("v");
  return is_constant(force.values) && x != nullptr && turns(x->values, height * range_of(x->values)) > 0;
}

}  // namespace

bool check_channels(DataTable& table, bool is_imposed, Problems& problems, std::vector<std::string>& warnings) {
  const DataColumn* force = table.find("force");
  if (is_imposed && force != nullptr && is_dead_in_loop(table, *force)) {
    complain(table, "force", "column force is constant: its sensor gave no signal", "the force of the loop",
             problems);
    return false;
  }
  const auto drop = [&](const char* name, const char* what) {
    const DataColumn* column = table.find(name);
    if (column == nullptr || !is_constant(column->values)) return;
    warnings.push_back("column " + std::string(name) + " is constant: " + what + ", and the column is not used");
    leave_out(table, name);
  };
  drop("y", "the base does not move");
  if (!is_imposed) drop("force", "no force drives the mass");
  if (const DataColumn* x = table.find("x"); x != nullptr && x->values.size() > 1 && is_constant(x->values)) {
    complain(table, "x", "column x is constant: the mass does not move", "the signal of a motion", problems);
    return false;
  }
  for (const std::string_view name : {"v", "a"})
    if (!check_derivative(table, name, is_imposed, problems, warnings)) return false;
  return true;
}

void check_pair_channels(DataTable& table, Problems& problems, std::vector<std::string>& warnings) {
  constexpr std::size_t fewest = 3;
  const DataColumn* x = table.find("x");
  if (x == nullptr || table.rows() < fewest) return;
  for (const char* other : {"x", "fundamental"})
    if (const DataColumn* copy = table.find(other);
        copy != nullptr && are_copies(table.find("Y")->values, copy->values)) {
      complain(table, other, copies("Y", other), measured_columns, problems);
      return;
    }
  const bool one_frequency = !changes(table.find("omega"));
  if (is_constant(x->values) && one_frequency && changes(table.find("Y"))) {
    complain(table, "x", "column x is constant while Y changes: its sensor gave no signal",
             "an amplitude that changes with Y", problems);
    return;
  }
  const auto drop = [&](const char* name, const char* why) {
    warnings.push_back("column " + std::string(name) + " is constant, " + why + ": the column is not used");
    leave_out(table, name);
  };
  if (is_dead_phase(table)) drop("phase", "and no states like these have one phase in common");
  for (const char* name : {"fundamental", "mean_square_speed"}) {
    const DataColumn* column = table.find(name);
    const bool follows_x = std::string_view(name) == "fundamental" || one_frequency;
    if (column != nullptr && follows_x && is_constant(column->values) && changes(table.find("x")))
      drop(name, "and x changes");
  }
}

std::optional<ChannelFault> check_test(History& history, bool is_imposed, std::vector<std::string>& warnings) {
  for (const auto& [name, channel] : {std::pair{"v", &history.v}, {"a", &history.a}})
    if (x_is_dead(history, *channel))
      return ChannelFault{"x",
                          "column x stays at one value for half of the test or longer while " + std::string(name) +
                              " moves: its sensor gave no signal",
                          "the part of the record in which x was measured"};
  if (auto copy = copy_in(history)) return copy;
  leave_out_dead(history.v, "v", 1, history, warnings);
  if (!is_imposed) leave_out_dead(history.a, "a", 2, history, warnings);  // at constant speed it is 0
  warn_of_rest(history.y, "y", history.x, "x", history, warnings);
  warn_of_rest(history.force, "force", history.x, "x", history, warnings);
  warn_of_rest(history.x, "x", history.y, "y", history, warnings);
  warn_of_rest(history.x, "x", history.force, "force", history, warnings);
  return std::nullopt;
}

}  // namespace dualdamp::identify
