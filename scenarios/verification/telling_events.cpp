#include "scenarios/verification/telling_events.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace dualdamp::scenarios {

namespace {

constexpr double same_place = 1e-8;
constexpr double same_time = 1e-5;

/// The rows of a table of events at which the mass turns, stops or is released.
class Turns {
 public:
  Turns(const Table& table, const std::vector<std::size_t>& rows, double length)
      : kind_(*table.find("kind")),
        x_(table.find("x")->numbers),
        t_(table.find("t")->numbers),
        place_(same_place * length),
        time_(t_.empty() ? 0.0 : same_time * std::abs(t_.back())) {
    std::ranges::copy_if(rows, std::back_inserter(turns_), [&](std::size_t row) {
      const std::string kind = kind_.text(row);
      return kind == "reversal" || kind == "stop" || kind == "release";
    });
  }

  /// Those that tell nothing.
  std::vector<std::size_t> idle() {
    std::vector<std::size_t> result;
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < turns_.size(); ++i) (hardly_moves(i) ? result : left).push_back(turns_[i]);
    turns_ = std::move(left);
    for (std::size_t i = 0; i + 1 < turns_.size(); ++i) {
      if (!goes_on_at_once(i)) continue;
      result.push_back(turns_[i]);
      result.push_back(turns_[i + 1]);
      ++i;
    }
    return result;
  }

 private:
  [[nodiscard]] double moved(std::size_t i, std::size_t j) const { return x_[turns_[j]] - x_[turns_[i]]; }

  /// Before turn i and after it. How far the mass moves from the last release on is not known here.
  [[nodiscard]] bool hardly_moves(std::size_t i) const {
    if (i == 0 || std::abs(moved(i - 1, i)) > place_) return false;
    if (i + 1 == turns_.size()) return kind_.text(turns_[i]) != "release";
    return std::abs(moved(i, i + 1)) <= place_;
  }

  /// Whether turns i and i + 1 are a grazing.
  [[nodiscard]] bool goes_on_at_once(std::size_t i) const {
    if (std::abs(moved(i, i + 1)) > place_ || std::abs(t_[turns_[i + 1]] - t_[turns_[i]]) > time_) return false;
    const std::string first = kind_.text(turns_[i]);
    const std::string second = kind_.text(turns_[i + 1]);
    if (first == "reversal" && second == "reversal") return true;
    if (first != "stop" || second != "release" || i == 0 || i + 2 >= turns_.size()) return false;
    return moved(i - 1, i) * moved(i + 1, i + 2) > 0.0;
  }

  const Column& kind_;
  const std::vector<double>& x_;
  const std::vector<double>& t_;
  double place_;
  double time_;
  std::vector<std::size_t> turns_;
};

/// Whether it is one of events that has their places.
bool has_places(const Table& table) {
  return table.key == "events" && table.find("kind") != nullptr && table.find("x") != nullptr &&
         table.find("t") != nullptr;
}

}  // namespace

std::vector<std::size_t> telling_rows(const Table& table, const std::vector<std::size_t>& rows, double length) {
  if (!has_places(table)) return rows;
  std::vector<std::size_t> idle = Turns(table, rows, length).idle();
  std::ranges::sort(idle);
  std::vector<std::size_t> result;
  std::ranges::set_difference(rows, idle, std::back_inserter(result));
  return result;
}

std::vector<char> rows_with_times(const Table& table, const std::vector<std::size_t>& rows, double swing) {
  std::vector<char> result(rows.size(), 1);
  if (!has_places(table)) return result;
  const std::vector<double>& x = table.find("x")->numbers;
  // How far the mass moves before the first event is not known here.
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::size_t next = std::min(i + 1, rows.size() - 1);
    result[i] = std::abs(x[rows[i]] - x[rows[i - 1]]) >= swing || std::abs(x[rows[next]] - x[rows[i]]) >= swing;
  }
  return result;
}

}  // namespace dualdamp::scenarios
