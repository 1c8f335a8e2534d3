#pragma once
/// Makes a stepper for any number of equations from a one-step method that is a template of this number. The most
/// frequent numbers, two, three and four, have code of their own, so the compiler can unroll the loops.

#include <cstddef>
#include <memory>
#include <span>

#include "sim/steppers/lu_factors.hpp"
#include "sim/steppers/stepper.hpp"

namespace dualdamp::sim {

template <template <std::size_t> class Method>
class SizedStepper final : public Stepper {
 public:
  [[nodiscard]] bool step(const VectorField& field, std::span<const double> x, double t, double h,
                          std::span<const double> allowed, std::span<double> end,
                          std::span<double> error) override {
    if (size_ != x.size()) resize(x.size());
    return method_->step(field, x, t, h, allowed, end, error);
  }

  void at(double part, std::span<double> x) const override { method_->at(part, x); }
  [[nodiscard]] bool end_rates(std::span<double> rates) const override {
    return method_ != nullptr && method_->end_rates(rates);
  }
  [[nodiscard]] int order() const override { return Method<any_size>::estimate_order; }
  [[nodiscard]] double stiffness() const override { return method_ == nullptr ? 0.0 : method_->stiffness(); }
  [[nodiscard]] long operations() const override {
    return earlier_operations_ + (method_ == nullptr ? 0 : method_->operations());
  }

 private:
  void resize(std::size_t size) {
    earlier_operations_ = operations();
    size_ = size;
    switch (size) {
      case 2:
        method_ = std::make_unique<Method<2>>(size);
        break;
      case 3:
        method_ = std::make_unique<Method<3>>(size);
        break;
      case 4:
        method_ = std::make_unique<Method<4>>(size);
        break;
      default:
        method_ = std::make_unique<Method<any_size>>(size);
    }
  }

  std::size_t size_ = 0;
  long earlier_operations_ = 0;  ///< of methods for other sizes
  std::unique_ptr<Stepper> method_;
};

}  // namespace dualdamp::sim
