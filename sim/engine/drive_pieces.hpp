#pragma once
/// A drive that is a polynomial in each piece: a ramp, a noise from draw to draw, a chirp between its nodes, a
/// sampled signal from node to node. A piece is computed at each call; none is stored.

#include <memory>

#include "sim/excitation.hpp"
#include "sim/sampled_signal.hpp"

namespace dualdamp::sim {

class DrivePieces {
 public:
  virtual ~DrivePieces() = default;

  /// Piece n, counted from 0; it begins where piece n - 1 ends. In m or N.
  [[nodiscard]] virtual PolynomialPiece piece(long n) const = 0;
  /// Time at which piece n begins [s].
  [[nodiscard]] virtual double begin(long n) const = 0;
  /// Highest power of time in all pieces.
  [[nodiscard]] virtual int degree() const = 0;
  /// Size of the drive: a level or a standard deviation [m or N].
  [[nodiscard]] virtual double size() const = 0;
};

/// A null pointer for an excitation that has no pieces.
[[nodiscard]] std::shared_ptr<const DrivePieces> make_pieces(const Excitation& excitation);

/// Number of pieces of a chirp.
[[nodiscard]] double chirp_pieces(const Chirp& chirp);

}  // namespace dualdamp::sim
