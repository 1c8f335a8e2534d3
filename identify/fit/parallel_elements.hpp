#pragma once
/// Springs in parallel that slip one after the other: the items of a list of a law, each with a stiffness k_i and a
/// limit f_i, or a share of one level (`iwan`, `generalized_maxwell_slip`).
///
///   F = sum of k_i z(x; d_i),  d_i = f_i/k_i   [N]
///
/// z is the deflection of a spring that slips at d_i, along the path x. It does not depend on k_i. Of a friction
/// loop the k_i of given d_i therefore follow from linear least squares, and the search begins with the d_i of a
/// grid that leave the least. The level of a law whose level falls with speed counts as constant there.
///
/// Each permutation of the items is the same law. The items of a fit are told in the order of d_i, if the law and
/// the caller allow the same of each of them.
///
/// Source: iwan1966. Cost: some 40 predictions of each loop.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "identify/experiments/experiment.hpp"
#include "identify/experiments/rig.hpp"

namespace dualdamp::identify {

class ParallelElements {
 public:
  /// Those of each list of which all stiffnesses and limits are sought. If the rig has no other law, they look at
  /// the loops to find where a search begins.
  [[nodiscard]] static std::vector<ParallelElements> of(const Rig& rig, const std::vector<FitParameter>& parameters,
                                                        const Experiments& experiments);

  /// Values of all parameters of the problem at start `number`. The first start has the stated values, the others
  /// have elements from the data. Equal elements are moved apart: no derivative does that.
  void begin(Eigen::VectorXd& values, int number) const;

  /// The way in which start `number` gets its elements; 0: as they are stated. Starts of each way lead to different
  /// minima.
  [[nodiscard]] std::size_t kind(int number) const;

  /// The same law with its elements in the order of d_i.
  void sort(Eigen::VectorXd& values) const;

 private:
  struct Element {
    double stiffness = 0.0;  ///< k_i [N/m]
    double limit = 0.0;      ///< f_i [N], or a share
  };

  void look_at(const Rig& rig, const std::vector<FitParameter>& parameters, const Experiments& experiments);
  [[nodiscard]] std::vector<Element> elements(const Eigen::VectorXd& values) const;
  void set(const std::vector<Element>& elements, Eigen::VectorXd& values) const;
  void set_found(const std::vector<Element>& found, Eigen::VectorXd& values) const;

  std::size_t law_ = 0;
  std::vector<std::size_t> stiffness_;  ///< indices of the parameters
  std::vector<std::size_t> limits_;     ///< one less than `stiffness_` if they are shares
  bool are_shares_ = false;
  std::optional<std::size_t> kinetic_, static_;  ///< the level of shares, if it is sought
  std::vector<std::vector<Element>> found_;      ///< from the data, in several ways
};

}  // namespace dualdamp::identify
