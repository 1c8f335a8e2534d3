#pragma once
/// A drive that is a polynomial piece by piece: a ramp, a noise from draw to draw, a chirp between points of its
/// own, a sampled signal from node to node. Pieces are made when they are asked for; none is kept.

#include <memory>

#include "sim/excitation.hpp"
#include "sim/sampled_signal.hpp"

namespace dualdamp::sim {

class DrivePieces {
 public:
  virtual ~DrivePieces() = default;

  /// Piece n, counted from 0, which begins where the piece before ends; m or N.
  [[nodiscard]] virtual PolynomialPiece piece(long n) const = 0;
  /// Time at which it begins [s].
  [[nodiscard]] virtual double begin(long n) const = 0;
  /// Of all pieces: the highest power of time.
  [[nodiscard]] virtual int degree() const = 0;
  /// How large the drive becomes: a level or a standard deviation [m or N].
  [[nodiscard]] virtual double size() const = 0;
};

/// A null pointer for an excitation that is none of these.
[[nodiscard]] std::shared_ptr<const DrivePieces> make_pieces(const Excitation& excitation);

/// Pieces of a chirp.
[[nodiscard]] double chirp_pieces(const Chirp& chirp);

}  // namespace dualdamp::sim
