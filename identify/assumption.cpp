#include "identify/assumption.hpp"

namespace dualdamp::identify {

namespace {

struct Words {
  std::string_view name;
  std::string_view statement;
  std::string_view would_tell;
};

constexpr std::array<Words, assumption_count> words = {{
    {"constants", "mass, stiffness and frequency are as stated",
     "phases or several frequencies, times of the extremes, or a history"},
    {"sensors", "the sensors have their gain, no delay and enough range",
     "a second sensor on the mass, or phases at several frequencies"},
    {"spring", "the spring is linear", "phases at several amplitudes, times of the extremes, or a history"},
    {"one_mode", "the structure moves in one mode", "phases at several frequencies, or a history"},
    {"drive", "the drive is harmonic and steady", "the history of the drive"},
    {"stationarity", "nothing drifts", "repeated sweeps with their labels, or a history"},
    {"friction_velocity", "friction over speed is a constant and a straight line",
     "more levels, further apart, or a history"},
    {"friction_displacement", "friction does not depend on the position or on the way since the last reversal",
     "phases, a second frequency, or a history"},
    {"symmetry", "friction is the same in both directions", "a history or signed extremes"},
}};

const Words& words_of(Assumption assumption) { return words[static_cast<std::size_t>(assumption)]; }

}  // namespace

std::string_view name_of(Assumption assumption) { return words_of(assumption).name; }
std::string_view statement_of(Assumption assumption) { return words_of(assumption).statement; }
std::string_view what_would_tell(Assumption assumption) { return words_of(assumption).would_tell; }

}  // namespace dualdamp::identify
