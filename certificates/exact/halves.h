#pragma once
// Halving a part of the step: de Casteljau on whole numbers, by additions alone.

#include <optional>
#include <vector>

#include "certificates/exact/wide_polynomial.h"
#include "motions/numbers/exact_number.h"

namespace kds {

/// Bernstein coefficients proper of a polynomial in scaled form, times a common multiple of the binomials,
/// which can be halved by additions, and that multiple.
struct Unscaled {
  std::vector<Integer> coefficients;
  Integer multiple;
};
[[nodiscard]] Unscaled unscaled(const std::vector<Integer>& scaled);

/// Both halves, times 2^degree; `local` becomes the right one.
void halve(std::vector<Integer>& local, std::vector<Integer>& left);

/// A polynomial as seen on a part of the step: whole numbers with a common bound of what they are wrong by.
class Halves {
 public:
  /// Of scaled coefficients that err by at most `error` each.
  Halves(const std::vector<Integer>& scaled, const Integer& error);

  /// The signs at both ends may be given.
  [[nodiscard]] Variations variations(int sign_at_lower, int sign_at_upper) const;
  /// The sign at an end, if it is certain.
  [[nodiscard]] std::optional<int> sign_at_lower() const { return sign_of(c_.front()); }
  [[nodiscard]] std::optional<int> sign_at_upper() const { return sign_of(c_.back()); }
  /// Where in 2^digits equal parts a cluster of so many roots would be by the values and slopes at both ends
  /// (Newton's step for a root of that multiplicity), with a part more on each side; none where these do not
  /// agree. No proof.
  struct Cells {
    Integer first, last;
  };
  [[nodiscard]] std::optional<Cells> cells_of_cluster(int multiplicity, unsigned digits) const;
  /// Becomes its right half; the left one.
  [[nodiscard]] Halves halve();
  /// How many times it has been halved.
  [[nodiscard]] int depth() const { return depth_; }

 private:
  Halves() = default;

  [[nodiscard]] std::optional<int> sign_of(const Integer& x) const;

  std::vector<Integer> c_;
  Integer error_;
  int depth_ = 0;
};

}  // namespace kds
