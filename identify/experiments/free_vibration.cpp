#include <numbers>
#include <utility>

#include "identify/experiments/experiment.hpp"
#include "sim/law_host/loaded_contacts.hpp"
#include "sim/motion/free_decay.hpp"

namespace dualdamp::identify {

namespace {

class FreeVibration final : public Experiment {
 public:
  FreeVibration(const DecayRecord& record, const ExperimentOptions& options) {
    kind = ExperimentKind::decay;
    const bool timed = !record.times.empty();
    Signal x{.name = "x",
             .unit = "m",
             .measured = record.extremes,
             .at = record.times,
             .at_name = timed ? "t" : "number",
             .at_unit = timed ? "s" : "",
             .noise = options.sigma_x,
             .is_stated = options.sigma_x > 0.0};
    for (std::size_t i = 0; !timed && i < record.extremes.size(); ++i) x.at.push_back(static_cast<double>(i));
    // The mean of the last three extremes, with weights 1 2 1, is roughly the offset.
    const std::size_t n = record.extremes.size();
    const double offset = 0.25 * (record.extremes[n - 3] + 2.0 * record.extremes[n - 2] + record.extremes[n - 1]);
    record_start[RecordParameter::position] = record.extremes.front() - offset;
    record_start[RecordParameter::offset] = offset;
    record_free = {RecordParameter::position, RecordParameter::offset};
    record_others = {RecordParameter::travel};
    signals.push_back(std::move(x));
    if (!timed) return;
    Signal t{.name = "t", .unit = "s", .measured = record.times, .at_name = "number"};
    for (std::size_t i = 0; i < n; ++i) t.at.push_back(static_cast<double>(i));
    record_start[RecordParameter::release] = record.times.front();
    record_free.push_back(RecordParameter::release);
    signals.push_back(std::move(t));
  }

  [[nodiscard]] bool predict(const sim::Model& model, const RecordValues& of_record,
                             Eigen::VectorXd& outputs) const override {
    sim::Model free = model;
    free.excitation = {};
    free.initial = {of_record[RecordParameter::position], 0.0};
    if (!sim::load_contacts(free, of_record[RecordParameter::travel])) return false;
    const std::size_t wanted = signals.front().measured.size();
    const sim::FreeDecay decay = sim::free_decay(free, static_cast<int>(wanted));
    *work += decay.work;
    if (!decay.outcome.ok()) return false;
    outputs.resize(size());
    const double swing = std::numbers::pi / sim::natural_frequency(model.oscillator);
    const double offset = of_record[RecordParameter::offset];
    sim::Extreme last{0.0, free.initial.position};
    for (std::size_t i = 0; i < wanted; ++i) {
      // After the last stop, the position is repeated at each half swing, so that the prediction is continuous.
      last = i < decay.extremes.size() ? decay.extremes[i] : sim::Extreme{last.t + swing, last.x};
      outputs[static_cast<Eigen::Index>(i)] = last.x + offset;
      if (signals.size() > 1)
        outputs[static_cast<Eigen::Index>(wanted + i)] = last.t + of_record[RecordParameter::release];
    }
    return true;
  }
};

}  // namespace

std::unique_ptr<Experiment> free_vibration(const DecayRecord& record, const ExperimentOptions& options,
                                           std::string& fault) {
  constexpr std::size_t least = 4;
  const std::vector<double>& x = record.extremes;
  for (std::size_t i = 2; i < x.size(); ++i) {
    if (!((x[i] - x[i - 1]) * (x[i - 1] - x[i - 2]) > 0.0)) continue;
    fault =
        "x without samples of time is read as the extremes of a free vibration, which alternate, and number " +
        std::to_string(i) +
        " lies between its neighbours. Samples need their times t; extremes of one side, or without signs, need "
        "those of the other side; those after the mass has come to rest must be left out";
    return nullptr;
  }
  if (record.extremes.size() >= least) return std::make_unique<FreeVibration>(record, options);
  fault = "a decay needs four extremes, and the record has " + std::to_string(record.extremes.size());
  return nullptr;
}

}  // namespace dualdamp::identify
