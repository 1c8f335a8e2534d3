#include "identify/methods/any_law/joined_readings.hpp"

#include <utility>

namespace dualdamp::identify {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct JoinedOrbits final : NearbyOrbits {
  std::unique_ptr<NearbyOrbits> first, second;
};

class JoinedReadings final : public ReadingModel {
 public:
  JoinedReadings(const ReadingModel& first, std::unique_ptr<const ReadingModel> second, const VectorXd& start)
      : first_(first), second_(std::move(second)) {
    nuisances_ = first_.nuisances();
    place_ = {0, 1};
    for (const Nuisance& own : second_->nuisances()) {
      const auto same = std::ranges::find(nuisances_, own.name, &Nuisance::name);
      place_.push_back(2 + (same - nuisances_.begin()));
      if (same == nuisances_.end()) nuisances_.push_back(own);
    }
    F0_unit_ = first_.F0_unit();
    c_unit_ = first_.c_unit();
    reference_ = first_.reference();
    driven_ = first_.is_driven();
    start_ = VectorXd::Zero(unknowns());
    start_.head(start.size()) = start;
    readings_.resize(rows() + second_->readings().size());
    readings_ << first_.readings(), second_->readings();
    channels_ = first_.channels();
    channels_.insert(channels_.end(), second_->channels().begin(), second_->channels().end());
    known_deviations_ = first_.known_deviations();
    for (std::size_t i = 0; i < known_deviations_.size(); ++i)
      least_deviations_.push_back(first_.least_deviation(static_cast<int>(i)));
    const MatrixXd& above = first_.smooth_curve();
    const MatrixXd& below = second_->smooth_curve();
    smooth_curve_.setZero(readings_.size(), above.cols() + below.cols());
    smooth_curve_.topLeftCorner(above.rows(), above.cols()) = above;
    smooth_curve_.bottomRightCorner(below.rows(), below.cols()) = below;
    numbers_ = first_.numbers();
    data_ = first_.data() + " and further readings";
  }

  [[nodiscard]] std::unique_ptr<NearbyOrbits> no_orbits(const std::vector<double>& deviations) const override {
    auto none = std::make_unique<JoinedOrbits>();
    const auto channels = static_cast<std::ptrdiff_t>(second_->known_deviations().size());
    none->first = first_.no_orbits(deviations);
    none->second = second_->no_orbits({deviations.begin(), deviations.begin() + channels});
    return none;
  }

  [[nodiscard]] std::optional<VectorXd> residuals(const LawAt& law, const VectorXd& p,
                                                  NearbyOrbits& near) const override {
    auto& orbits = static_cast<JoinedOrbits&>(near);
    const auto above = first_.residuals(law, p.head(first_.unknowns()), *orbits.first);
    if (!above) return std::nullopt;
    const auto below = second_->residuals(law, p(place_), *orbits.second);
    if (!below) return std::nullopt;
    VectorXd all(readings_.size());
    all << *above, *below;
    return all;
  }

  [[nodiscard]] std::optional<MatrixXd> derivatives(const LawAt& law, const VectorXd& p, const VectorXd& here,
                                                    NearbyOrbits& near) const override {
    auto& orbits = static_cast<JoinedOrbits&>(near);
    const auto above = first_.derivatives(law, p.head(first_.unknowns()), here.head(rows()), *orbits.first);
    if (!above) return std::nullopt;
    const auto below = second_->derivatives(law, p(place_), here.tail(here.size() - rows()), *orbits.second);
    if (!below) return std::nullopt;
    MatrixXd all = MatrixXd::Zero(here.size(), unknowns());
    all.topLeftCorner(rows(), first_.unknowns()) = *above;
    for (std::size_t j = 0; j < place_.size(); ++j)
      all.col(place_[j]).tail(below->rows()) = below->col(static_cast<Index>(j));
    return all;
  }

 private:
  [[nodiscard]] Index rows() const { return first_.readings().size(); }

  const ReadingModel& first_;
  std::unique_ptr<const ReadingModel> second_;
  std::vector<Index> place_;  ///< of each unknown of the second test among all
};

}  // namespace

std::unique_ptr<const ReadingModel> joined_readings(const ReadingModel& first,
                                                    std::unique_ptr<const ReadingModel> second,
                                                    const VectorXd& start) {
  return std::make_unique<const JoinedReadings>(first, std::move(second), start);
}

}  // namespace dualdamp::identify
