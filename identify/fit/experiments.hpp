#pragma once
/// The kinds of experiments, each made of its part of a record; a null pointer with a fault where it is of no use.

#include <memory>
#include <string>

#include "identify/fit/experiment.hpp"

namespace dualdamp::identify {

[[nodiscard]] std::unique_ptr<Experiment> steady_states(const PairRecord& record, const ExperimentOptions& options,
                                                        std::string& fault);
[[nodiscard]] std::unique_ptr<Experiment> free_vibration(const DecayRecord& record,
                                                         const ExperimentOptions& options, std::string& fault);
[[nodiscard]] std::unique_ptr<Experiment> motion(const History& history, const ExperimentOptions& options,
                                                 std::string& fault);
[[nodiscard]] std::unique_ptr<Experiment> friction_loop(const History& history, const ExperimentOptions& options,
                                                        std::string& fault);

}  // namespace dualdamp::identify
