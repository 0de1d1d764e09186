#pragma once
// Bernstein subdivision: halves a part of the step by de Casteljau's algorithm on integers, using only
// additions.

#include <optional>
#include <vector>

#include "certificates/exact/wide_polynomial.h"
#include "motions/numbers/exact_number.h"

namespace kds {

/// The plain Bernstein coefficients of a polynomial given in scaled form, times `multiple`, a common
/// multiple of the binomials. Additions alone halve them.
struct Unscaled {
  std::vector<Integer> coefficients;
  Integer multiple;
};
[[nodiscard]] Unscaled unscaled(const std::vector<Integer>& scaled);

/// Computes both halves, times 2^degree. `local` becomes the right half.
void halve(std::vector<Integer>& local, std::vector<Integer>& left);

/// A polynomial restricted to a part of the step: integers with a common error bound.
class Halves {
 public:
  /// Takes scaled coefficients with an error of at most `error` each.
  Halves(const std::vector<Integer>& scaled, const Integer& error);

  /// Counts the sign changes, given the signs at both ends (0 stands for a root).
  [[nodiscard]] Variations variations(int sign_at_lower, int sign_at_upper) const;
  /// Returns the sign at an end if it is certain.
  [[nodiscard]] std::optional<int> sign_at_lower() const { return sign_of(c_.front()); }
  [[nodiscard]] std::optional<int> sign_at_upper() const { return sign_of(c_.back()); }
  /// Divides the part into 2^digits equal cells and returns the cells that would hold a cluster of
  /// `multiplicity` roots, with one more cell on each side. The cluster is located from the values and slopes
  /// at both ends, by Newton's step for a root of that multiplicity. Returns nothing if the two ends
  /// disagree. The result is a guess, not a proof.
  struct Cells {
    Integer first, last;
  };
  [[nodiscard]] std::optional<Cells> cells_of_cluster(int multiplicity, unsigned digits) const;
  /// Becomes the right half and returns the left half.
  [[nodiscard]] Halves halve();
  /// Returns how many times the part has been halved.
  [[nodiscard]] int depth() const { return depth_; }

 private:
  Halves() = default;

  [[nodiscard]] std::optional<int> sign_of(const Integer& x) const;

  std::vector<Integer> c_;
  Integer error_;
  int depth_ = 0;
};

}  // namespace kds
