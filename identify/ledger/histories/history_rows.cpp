#include "identify/ledger/histories/history_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/random.hpp"
#include "identify/ledger/histories/lasting_errors.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/noise_level.hpp"

namespace dualdamp::identify {

void Channel::add(const Eigen::MatrixXd& more) {
  blocks.push_back(rows.rows());
  Eigen::MatrixXd all(rows.rows() + more.rows(), more.cols());
  if (rows.rows() > 0) all.topRows(rows.rows()) = rows;
  all.bottomRows(more.rows()) = more;
  rows = std::move(all);
}

void SensorRows::append(const SensorRows& more) {
  for (const auto part : {&SensorRows::x, &SensorRows::v, &SensorRows::a}) {
    Eigen::MatrixXd& rows = this->*part;
    const Eigen::Index own = rows.cols();
    rows.conservativeResize(Eigen::NoChange, own + (more.*part).cols());
    rows.rightCols((more.*part).cols()) = more.*part;
  }
}

WhiteRows made_white(const Channel& channel, Eigen::Index count_of_columns, const Autoregression* known,
                     bool is_unit) {
  const auto count = static_cast<double>(channel.rows.rows());
  if (known != nullptr)
    return {whitened(channel.rows, channel.blocks, *known), 2.0 * count * std::log(known->deviation), *known};
  const int most = std::clamp(static_cast<int>(count / 20.0), 0, channel.most_lags);
  const Eigen::VectorXd target = channel.rows.col(0);
  LastingErrors found =
      lasting_errors({channel.rows.middleCols(1, count_of_columns), target, channel.blocks, channel.at_rest, most});
  Autoregression& errors = found.autoregression;
  if (is_unit && found.scatter > 0.0) errors.deviation /= found.scatter;
  errors.deviation = std::max(errors.deviation, 1e-13 * target.cwiseAbs().maxCoeff() + 1e-300);
  WhiteRows white{whitened(channel.rows, channel.blocks, errors), 2.0 * count * std::log(errors.deviation)};
  white.errors = std::move(errors);
  white.scatter = found.scatter;
  white.freedom = found.freedom;
  return white;
}

Eigen::VectorXd course_of(Eigen::Index samples) { return Eigen::VectorXd::LinSpaced(samples, 0.0, 1.0); }

Eigen::MatrixXd delayed(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& slopes, double rate, double delay) {
  if (delay == 0.0 || columns.rows() < 2) return columns;
  Eigen::MatrixXd earlier(columns.rows(), columns.cols());
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    const double place = static_cast<double>(i) - delay * rate;
    const auto last = static_cast<double>(columns.rows() - 2);
    const auto j = static_cast<Eigen::Index>(std::clamp(std::floor(place), 0.0, last));
    const double u = place - static_cast<double>(j);
    const double w = 1.0 - u;
    earlier.row(i) = w * w * ((1.0 + 2.0 * u) * columns.row(j) + u / rate * slopes.row(j)) +
                     u * u * ((1.0 + 2.0 * w) * columns.row(j + 1) - w / rate * slopes.row(j + 1));
  }
  return earlier;
}

namespace {

/// (1 - exp(-u))/u
double mean_decay(double u) { return std::abs(u) < 1e-9 ? 1.0 : -std::expm1(-u) / u; }

}  // namespace

Eigen::MatrixXd high_passed(const Eigen::MatrixXd& columns, double rate, double corner) {
  if (corner == 0.0) return columns;
  const double u = corner / rate;
  Eigen::MatrixXd passed = columns;
  for (Eigen::Index i = 1; i < columns.rows(); ++i)
    passed.row(i) = std::exp(-u) * passed.row(i - 1) + mean_decay(u) * (columns.row(i) - columns.row(i - 1));
  return passed;
}

Eigen::VectorXd by_corner(const Eigen::VectorXd& passed, double rate, double corner) {
  const double u = corner / rate;
  Eigen::VectorXd change = Eigen::VectorXd::Zero(passed.size());
  for (Eigen::Index i = 1; i < passed.size(); ++i)
    change[i] = std::exp(-u) * change[i - 1] - mean_decay(u) * 0.5 * (passed[i] + passed[i - 1]) / rate;
  return change;
}

Eigen::MatrixXd as_read(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& slopes, const SensorErrors& errors,
                        double rate) {
  return high_passed(delayed(columns, slopes, rate, errors.delay), rate, errors.corner);
}

Eigen::MatrixXd reading_rows(const std::vector<double>& measured, const SensorMotion& motion,
                             const SensorErrors& errors, const Eigen::MatrixXd& columns,
                             const Eigen::MatrixXd& slopes) {
  const Eigen::Index count = motion.value.size();
  Eigen::MatrixXd rows(count, columns.cols() + 1);
  const Eigen::ArrayXd u = as_read(motion.value, motion.slope, errors, motion.rate).array();
  rows.col(0) = Eigen::Map<const Eigen::VectorXd>(measured.data(), count);
  rows.col(0) -= errors.gain * errors.reading(u).matrix();
  rows.col(0) -= Eigen::VectorXd::Constant(count, errors.zero) + errors.drift * course_of(count);
  rows.rightCols(columns.cols()) = as_read(columns, slopes, errors, motion.rate);
  rows.rightCols(columns.cols()).array().colwise() *= errors.gain * errors.slope(u);
  return rows;
}

Eigen::MatrixXd stacked(const std::vector<Eigen::MatrixXd>& parts) {
  Eigen::Index count = 0;
  for (const Eigen::MatrixXd& part : parts) count += part.rows();
  Eigen::MatrixXd rows(count, parts.front().cols());
  Eigen::Index row = 0;
  for (const Eigen::MatrixXd& part : parts) {
    rows.middleRows(row, part.rows()) = part;
    row += part.rows();
  }
  return rows;
}

History with_noisier_drive(History history) {
  // A fixed seed, so that a record has the same ledger each time; not the one that draws p-values.
  constexpr core::RandomStream stream{20261125, 1};
  std::uint64_t drawn = 0;
  for (std::vector<double>* signal : {&history.y, &history.force}) {
    const double deviation = signal->empty() ? 0.0 : sensor_noise_of(*signal);
    for (double& value : *signal) value += deviation * stream.normal(drawn++);
  }
  return history;
}

Eigen::MatrixXd averaged(const Eigen::MatrixXd& rows, Eigen::Index width) {
  Eigen::MatrixXd means(rows.rows() / width, rows.cols());
  for (Eigen::Index i = 0; i < means.rows(); ++i) means.row(i) = rows.middleRows(i * width, width).colwise().mean();
  return means;
}

Eigen::MatrixXd differentiated(const Eigen::MatrixXd& columns, double rate) {
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(columns.rows(), columns.cols());
  const Eigen::Index inner = columns.rows() - 2;
  slopes.middleRows(1, inner) = 0.5 * rate * (columns.bottomRows(inner) - columns.topRows(inner));
  return slopes;
}

Eigen::MatrixXd finely_differentiated(const Eigen::MatrixXd& columns, double rate) {
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(columns.rows(), columns.cols());
  const Eigen::Index inner = columns.rows() - 4;
  const auto later = [&](Eigen::Index samples) { return columns.middleRows(2 + samples, inner); };
  slopes.middleRows(2, inner) = rate / 12.0 * (8.0 * (later(1) - later(-1)) - (later(2) - later(-2)));
  return slopes;
}

void leave_out_reversals(const Eigen::VectorXd& v, Eigen::MatrixXd& rows) {
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const Eigen::Index first = std::max<Eigen::Index>(0, i - 2);
    const Eigen::Index last = std::min<Eigen::Index>(v.size() - 1, i + 2);
    const auto near = v.segment(first, last - first + 1);
    const bool at_end = last - first < 4;
    if (at_end || (!(near.minCoeff() > 0.0) && !(near.maxCoeff() < 0.0))) rows.row(i).setZero();
  }
}

Eigen::Index moving_rows(const History& history, const Eigen::VectorXd& x, double x_f) {
  if (history.has_drive()) return x.size();
  constexpr double least = 3.0;
  Eigen::Index last = x.size();
  while (last > 0 && !(std::abs(x[last - 1]) > least * x_f)) --last;
  // A vibration that is small from the start is used as a whole. A long record of the mass at rest does no harm.
  constexpr int fewest = 4;
  int crossings = 0;
  for (Eigen::Index i = 1; i < last; ++i) crossings += x[i - 1] * x[i] < 0.0 ? 1 : 0;
  return crossings < fewest ? x.size() : last;
}

double sensor_noise_of(const std::vector<double>& signal) {
  // If a converter's step is larger than the noise, most differences are zero.
  return std::max(robust_noise_level(signal), converter_step(signal) / std::sqrt(12.0));
}

ReadingNoise noise_levels(const History& history, double k, const MotionScale& scale, double sigma_x) {
  // Readings without noise are still rounded.
  constexpr double rounding = 1e-9;
  return {std::hypot(k * sensor_noise_of(history.y), sensor_noise_of(history.force)),
          sigma_x > 0.0 ? sigma_x : std::max(sensor_noise_of(history.x), rounding * scale.length),
          std::max(sensor_noise_of(history.v), rounding * scale.speed),
          std::max(sensor_noise_of(history.a), rounding * scale.speed * scale.speed / scale.length)};
}

bool noise_grows(const ForceParameters& force, const Record& record) {
  const double rate = -0.5 * force.c / force.m;
  return std::ranges::any_of(record.histories, [rate](const History& history) {
    return rate * static_cast<double>(history.x.size()) > history.sample_rate;
  });
}

std::string fault_of_histories(const Record& record) {
  constexpr std::size_t most_samples = 60'000;
  std::size_t samples = 0;
  for (const History& history : record.histories) {
    samples += history.x.size();
    const bool free = history.y.empty() && history.force.empty();
    if (!free) continue;
    if (DerivedDecay decay = decay_of(history); !decay.fault.empty() && !decay.is_coarse) return decay.fault;
  }
  if (samples > most_samples) return "tests take at most 60,000 samples: give a part, or every n-th sample";
  // Each history has a first state and zeros of its own, and the work of a fit is that of its samples times the
  // square of the number of its columns.
  constexpr double shared = 40.0;
  constexpr double own = 4.0;
  const double columns = shared + own * static_cast<double>(record.histories.size());
  constexpr double most_work = 1e8;  // some ten seconds
  if (record.pairs && static_cast<double>(samples) * columns * columns > most_work)
    return "the steady states of so many histories are tested in their place";
  return {};
}

}  // namespace dualdamp::identify
