#pragma once
/// Channels that hold no signal of their own: sensors that were not connected, cables that fell off, columns that a
/// spreadsheet copied.

#include <optional>
#include <string>
#include <vector>

#include "identify/readers/data_table.hpp"
#include "identify/readers/problems.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Why a test is refused.
struct ChannelFault {
  std::string column;
  std::string message;
  std::string allowed;
};

/// The columns of histories. A constant `y`, `force`, `v` or `a` is left out with a warning. A constant `x`, or a
/// constant `v` or `a` without another motion of the mass, is a problem. `is_imposed`: a drive moves the mass along
/// x, perhaps at constant speed, at which `v` is constant; a constant force is a problem if the motion turns back.
/// False after a problem.
[[nodiscard]] bool check_channels(DataTable& table, bool is_imposed, Problems& problems,
                                  std::vector<std::string>& warnings);

/// The columns of pairs. `phase`, `fundamental` and `mean_square_speed` that cannot be constant are left out with a
/// warning. An `x` that stays while `Y` changes at one frequency is a problem, and so is one with the numbers of
/// `Y`.
void check_pair_channels(DataTable& table, Problems& problems, std::vector<std::string>& warnings);

/// Channels that are dead for a part of one test. A `v` or `a` is left out if it stays at one value for a tenth of
/// the samples while `x` turns back as no motion with this speed or acceleration does. A warning names a `y`,
/// `force` or `x` that stays at one value for half of the samples while its counterpart goes on swinging as before:
/// it may really rest. Returns why the test is refused: `x` rests and `v` or `a` goes on, or two channels are
/// copies.
[[nodiscard]] std::optional<ChannelFault> check_test(History& history, bool is_imposed,
                                                     std::vector<std::string>& warnings);

}  // namespace dualdamp::identify
