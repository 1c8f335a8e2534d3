#pragma once
/// One complex number for each element of an exponential basis.
///
/// The basis of nearly every mode is small: its numbers are stored in the object and are unset until they are
/// written. A basis with more than `in_place` elements (many damped contacts, many harmonics) stores them on the
/// heap.
///
/// Cost: no allocation up to `in_place` elements, one for each object above.

#include <algorithm>
#include <cstddef>

namespace dualdamp::core {

class ElementNumbers {
 public:
  /// Constant, ramp, own motion, drive and eight harmonics, each perhaps with a chain.
  static constexpr std::size_t in_place = 40;

  /// All real or all imaginary parts; const if the object that holds them is const.
  class Part {
   public:
    double& operator[](std::size_t k) { return first_[k]; }
    double operator[](std::size_t k) const { return first_[k]; }

   private:
    friend class ElementNumbers;
    double* first_;
  };

  // The numbers in place are unset on purpose: most objects use three or four of them.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
  ElementNumbers() { use(few_, in_place); }
  ~ElementNumbers() {
    if (re.first_ != few_) delete[] re.first_;
  }
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
  ElementNumbers(const ElementNumbers& other) {
    use(few_, in_place);
    *this = other;
  }
  ElementNumbers& operator=(const ElementNumbers& other) {
    if (this == &other) return *this;
    fit(other.room_);
    std::copy_n(other.re.first_, other.room_, re.first_);
    std::copy_n(other.im.first_, other.room_, im.first_);
    return *this;
  }

  /// Makes room for `size` numbers. The present numbers are lost if the storage changes.
  void fit(std::size_t size) {
    if (size > room_) [[unlikely]]
      grow(size);
  }

  Part re;
  Part im;

 private:
  void use(double* numbers, std::size_t room) {
    re.first_ = numbers;
    im.first_ = numbers + room;
    room_ = room;
  }
  void grow(std::size_t size);

  std::size_t room_;
  double few_[2 * in_place];  // NOLINT(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
};

}  // namespace dualdamp::core
