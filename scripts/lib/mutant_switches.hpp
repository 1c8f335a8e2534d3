#pragma once
/// Changes of the program that wait in it, one of which a process may switch on. scripts/mutants writes them into a
/// copy of the sources and includes this header in front of each: `a < b` becomes `a < mutant::Op{7} < b`, which is
/// `a <= b` in a process with DUALDAMP_MUTANT=7. A process with DUALDAMP_MUTANTS_REACHED=FILE adds to that file the
/// numbers it came past.

#include <algorithm>
#include <complex>
#include <cstdlib>
#include <fstream>
#include <type_traits>
#include <utility>

namespace mutant {

constexpr int capacity = 1 << 16;
inline unsigned char reached[capacity];

/// Zero, which no change has, before the objects of the program are made and where none is asked for.
inline const int active = [] {
  const char* number = std::getenv("DUALDAMP_MUTANT");
  return number == nullptr ? 0 : std::atoi(number);
}();

struct Report {
  ~Report() {
    const char* name = std::getenv("DUALDAMP_MUTANTS_REACHED");
    if (name == nullptr) return;
    std::ofstream file(name, std::ios::app);
    for (int i = 0; i < capacity; ++i)
      if (reached[i] != 0) file << i << '\n';
  }
};
inline const Report report;

inline bool passed(int number) {
  reached[number] = 1;
  return number == active;
}

/// Whether a change is on. What the compiler evaluates stays as it is.
constexpr bool on(int number) { return !std::is_constant_evaluated() && passed(number); }

constexpr bool flipped(int number, bool value) { return value != on(number); }

template <class T>
constexpr T number(int number, T value) {
  if (!on(number)) return value;
  if constexpr (std::is_integral_v<T>) return static_cast<T>(value + 1);
  return value == T{} ? T{1} : static_cast<T>(1.5 * value);
}

struct Min {
  int number;
  template <class T>
  constexpr T operator()(const T& a, const T& b) const {
    return on(number) ? std::max(a, b) : std::min(a, b);
  }
  template <class T>
  constexpr T operator()(std::initializer_list<T> list) const {
    return on(number) ? std::max(list) : std::min(list);
  }
};

struct Max {
  int number;
  template <class T>
  constexpr T operator()(const T& a, const T& b) const {
    return on(number) ? std::min(a, b) : std::max(a, b);
  }
  template <class T>
  constexpr T operator()(std::initializer_list<T> list) const {
    return on(number) ? std::min(list) : std::max(list);
  }
};

/// Stands between two operators of one kind: `a + Op + b` has the precedence of `a + b`.
struct Op {
  int number;
};

template <class A>
struct Left {
  A&& a;
  int number;
};

template <class B>
struct Right {
  B&& b;
  int number;
};

template <class T>
struct IsNumber : std::is_arithmetic<T> {};
template <class T>
struct IsNumber<std::complex<T>> : std::true_type {};

template <class A, class B>
constexpr bool are_numbers = IsNumber<std::remove_cvref_t<A>>::value && IsNumber<std::remove_cvref_t<B>>::value;

/// Anything but numbers goes through: matrices, texts, iterators.
#define DUALDAMP_MUTANT_OPERATOR(sign, other)                                  \
  template <class A>                                                           \
  constexpr Left<A> operator sign(A && a, Op op) {                             \
    return {std::forward<A>(a), op.number};                                    \
  }                                                                            \
  template <class A, class B>                                                  \
  constexpr decltype(auto) operator sign(Left<A> left, B&& b) {                \
    if constexpr (are_numbers<A, B>) {                                         \
      using Result = std::remove_cvref_t<decltype(left.a sign b)>;             \
      return on(left.number) ? Result(left.a other b) : Result(left.a sign b); \
    } else {                                                                   \
      return std::forward<A>(left.a) sign std::forward<B>(b);                  \
    }                                                                          \
  }
DUALDAMP_MUTANT_OPERATOR(+, -)
DUALDAMP_MUTANT_OPERATOR(-, +)
DUALDAMP_MUTANT_OPERATOR(*, /)
DUALDAMP_MUTANT_OPERATOR(/, *)
DUALDAMP_MUTANT_OPERATOR(<, <=)
DUALDAMP_MUTANT_OPERATOR(<=, <)
DUALDAMP_MUTANT_OPERATOR(>, >=)
DUALDAMP_MUTANT_OPERATOR(>=, >)

#define DUALDAMP_MUTANT_EQUALITY(sign)                          \
  template <class A>                                            \
  constexpr Left<A> operator sign(A && a, Op op) {              \
    return {std::forward<A>(a), op.number};                     \
  }                                                             \
  template <class A, class B>                                   \
  constexpr bool operator sign(Left<A> left, B&& b) {           \
    return static_cast<bool>(left.a sign b) != on(left.number); \
  }
DUALDAMP_MUTANT_EQUALITY(==)
DUALDAMP_MUTANT_EQUALITY(!=)

/// `a += Op += b` assigns from the right.
#define DUALDAMP_MUTANT_ASSIGNMENT(sign, other)                   \
  template <class B>                                              \
  constexpr Right<B> operator sign(Op op, B && b) {               \
    return {std::forward<B>(b), op.number};                       \
  }                                                               \
  template <class A, class B>                                     \
  constexpr decltype(auto) operator sign(A&& a, Right<B> right) { \
    if constexpr (are_numbers<A, B>) {                            \
      if (on(right.number)) return a other right.b;               \
      return a sign right.b;                                      \
    } else {                                                      \
      return a sign std::forward<B>(right.b);                     \
    }                                                             \
  }
DUALDAMP_MUTANT_ASSIGNMENT(+=, -=)
DUALDAMP_MUTANT_ASSIGNMENT(-=, +=)
DUALDAMP_MUTANT_ASSIGNMENT(*=, /=)
DUALDAMP_MUTANT_ASSIGNMENT(/=, *=)

}  // namespace mutant
