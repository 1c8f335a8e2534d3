#include "identify/assumption.hpp"

namespace dualdamp::identify {

namespace {

struct Words {
  std::string_view name;
  std::string_view statement;
};

constexpr std::array<Words, assumption_count> words = {{
    {"constants", "mass, stiffness and frequency are as stated"},
    {"sensors", "the sensors have their zero and gain, no delay and enough range"},
    {"spring", "the spring is linear"},
    {"one_mode", "the structure moves in one mode"},
    {"drive", "the drive is harmonic and steady"},
    {"stationarity", "nothing drifts"},
    {"friction_velocity", "friction over speed is a constant and a straight line"},
    {"friction_displacement",
     "friction does not depend on the position or on the distance since the last reversal"},
    {"symmetry", "friction is the same in both directions"},
}};

const Words& words_of(Assumption assumption) { return words[static_cast<std::size_t>(assumption)]; }

}  // namespace

std::string_view name_of(Assumption assumption) { return words_of(assumption).name; }
std::string_view statement_of(Assumption assumption) { return words_of(assumption).statement; }

}  // namespace dualdamp::identify
