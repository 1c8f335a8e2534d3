#pragma once
/// Makes the experiments of each kind from a part of a record. Null, with a fault, if the part cannot be used.

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
