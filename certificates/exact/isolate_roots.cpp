#include "certificates/exact/isolate_roots.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "certificates/exact/precise_values.h"

namespace kds {

namespace {

using Level = std::int64_t;

/// Which scale a number between 0 and 1 is of: 0 from 1/2 on, -1 from 1/4 on, and so on towards 0; the same
/// upwards towards 1.
Level level_of(const Dyadic& u) {
  const auto power_of = [](const Integer& numerator, unsigned exponent) {
    return static_cast<Level>(mpz_sizeinbase(numerator.backend().data(), 2)) - 1 -
           static_cast<Level>(exponent);
  };
  const Level power = power_of(u.numerator(), u.exponent());
  if (power < -1 || (u.numerator() == 1 && u.exponent() == 1)) return power + 1;
  return -(power_of((Integer(1) << u.exponent()) - u.numerator(), u.exponent()) + 1);
}

/// The simplest number of a scale, its end towards 0 or 1.
Dyadic at_level(Level level) {
  if (level <= 0) return {1, static_cast<unsigned>(1 - level)};
  const auto bits = static_cast<unsigned>(level + 1);
  return {(Integer(1) << bits) - 1, bits};
}

/// Splits intervals until they hold one root or none. Where leading digits leave open how often coefficients
/// change sign it splits a few times before it asks for more digits, which is mostly cheaper and enough.
/// Roots that lie close together are approached as one multiple root (Sagraloff's Descartes with Newton's
/// steps): as long as all changes of sign are in the part that the step points to, the other parts have no
/// root, and the number of digits doubles with each step.
class Isolation {
 public:
  Isolation(const ExactPolynomial& polynomial, const RootVisitor& visit)
      : polynomial_(polynomial), visit_(visit) {}

  struct Part {
    Dyadic lower, upper;
    int sign_at_lower = 0, sign_at_upper = 0;
    int patience = most_patience;
    unsigned digits = fewest_digits;  ///< of the next step towards a cluster
  };

  // Roots in the open interval, and at `lower` if `with_lower`; false if the visitor wants no more.
  bool visit(Part part, bool with_lower) {
    if (part.sign_at_lower == 0 && with_lower && !visit_({part.lower, part.lower})) return false;
    while (true) {
      const Variations variations = variations_on(part);
      if (variations.most == 0) return true;
      if (part.sign_at_lower != 0 && part.sign_at_upper != 0) {
        if (variations.least == 1 && variations.most == 1) return visit_({part.lower, part.upper});
        if (variations.least == variations.most && narrow_to_cluster(part, variations.least)) continue;
      }
      part.digits = std::max(fewest_digits, part.digits / 2);
      break;
    }
    const Dyadic middle = split_point(part.lower, part.upper);
    const int sign = polynomial_.sign_at(middle);
    return visit({part.lower, middle, part.sign_at_lower, sign, part.patience, part.digits}, false) &&
           visit({middle, part.upper, sign, part.sign_at_upper, part.patience, part.digits}, true);
  }

 private:
  static constexpr int most_patience = 4;
  static constexpr unsigned fewest_digits = 2, most_digits = 2048;

  [[nodiscard]] Variations variations_on(Part& part) const {
    const Variations rough =
        polynomial_.variations_on(part.lower, part.upper, part.sign_at_lower, part.sign_at_upper);
    const bool unclear = rough.least < 2 && rough.least != rough.most;
    if (unclear && --part.patience >= 0) return rough;
    part.patience = most_patience;
    return unclear ? exact_variations(polynomial_, part.lower, part.upper) : rough;
  }

  /// Narrows the part to one around a cluster that holds all changes of sign.
  [[nodiscard]] bool narrow_to_cluster(Part& part, int variations) const {
    const bool one_scale = split_point(part.lower, part.upper) == Dyadic::midpoint(part.lower, part.upper);
    if (!one_scale) return false;
    const unsigned digits = part.digits;
    const unsigned exponent = std::max(part.lower.exponent(), part.upper.exponent());
    const Integer from = part.lower.numerator() << (exponent - part.lower.exponent());
    const Integer to = part.upper.numerator() << (exponent - part.upper.exponent());
    const Integer last = (Integer(1) << digits) - 1;
    for (const bool upwards : {true, false}) {
      Integer cell = upwards ? newton_cell(polynomial_, part.lower, part.upper, variations, digits)
                             : newton_cell(polynomial_, part.upper, part.lower, variations, digits);
      if (cell < 0) continue;
      if (!upwards) cell = last - cell;
      const auto border = [&](const Integer& number) {
        return Dyadic((from << digits) + number * (to - from), exponent + digits);
      };
      Part around = part;
      // The cell and its neighbours, of which there are at least four.
      if (cell > 0) around.lower = border(cell - 1);
      if (cell < last) around.upper = border(cell + 2 > last ? Integer(last + 1) : Integer(cell + 2));
      around.sign_at_lower = polynomial_.sign_at(around.lower);
      around.sign_at_upper = polynomial_.sign_at(around.upper);
      if (around.sign_at_lower == 0 || around.sign_at_upper == 0) continue;
      Variations inside =
          polynomial_.variations_on(around.lower, around.upper, around.sign_at_lower, around.sign_at_upper);
      if (inside.least != inside.most && inside.most >= variations)
        inside = exact_variations(polynomial_, around.lower, around.upper);
      if (inside.least != variations || inside.most != variations) continue;
      around.digits = std::min(2 * digits, most_digits);
      around.patience = most_patience;
      part = std::move(around);
      return true;
    }
    return false;
  }

  const ExactPolynomial& polynomial_;
  const RootVisitor& visit_;
};

}  // namespace

Dyadic split_point(const Dyadic& lower, const Dyadic& upper) {
  const bool endless_below = lower == Dyadic(0.0), endless_above = upper == Dyadic(1.0);
  const Level from = endless_below ? 0 : level_of(lower), to = endless_above ? 0 : level_of(upper);
  Level level = 0;
  if (!endless_below && !endless_above) {
    if (to - from <= 2) return Dyadic::midpoint(lower, upper);
    level = (from + to) / 2;
  } else if (!endless_above) {
    level = to > 0 ? 0 : 2 * to - 2;
  } else if (!endless_below) {
    level = from < 0 ? 0 : 2 * from + 2;
  }
  Dyadic point = at_level(level);
  return lower < point && point < upper ? point : Dyadic::midpoint(lower, upper);
}

namespace {

/// All roots in [0,1], found once.
std::vector<RootInterval>& all_roots(const ExactPolynomial& square_free) {
  std::optional<std::vector<RootInterval>>& known = square_free.isolated();
  if (!known) {
    const Dyadic start(0.0), end(1.0);
    std::vector<RootInterval> roots;
    const RootVisitor keep = [&roots](RootInterval root) {
      roots.push_back(std::move(root));
      return true;
    };
    const int sign_at_end = square_free.sign_at(end);
    Isolation(square_free, keep).visit({start, end, square_free.sign_at(start), sign_at_end}, true);
    if (sign_at_end == 0) roots.push_back({end, end});
    known = std::move(roots);
  }
  return *known;
}

/// Cuts a root's interval at a point, so that it is on one side of it.
void cut(RootInterval& root, const Dyadic& point, const ExactPolynomial& square_free) {
  if (!(root.lower < point && point < root.upper)) return;
  const int sign = square_free.sign_at(point);
  if (sign == 0) {
    root = {point, point};
  } else {
    (sign == square_free.sign_at(root.lower) ? root.lower : root.upper) = point;
  }
}

}  // namespace

void visit_roots(const ExactPolynomial& square_free, const Dyadic& lower, const Dyadic& upper,
                 const RootVisitor& visit) {
  if (square_free.is_zero()) return;
  if (lower == upper) {
    if (square_free.sign_at(lower) == 0) visit({lower, lower});
    return;
  }
  for (RootInterval& root : all_roots(square_free)) {
    cut(root, lower, square_free);
    if (root.lower < lower) continue;
    cut(root, upper, square_free);
    if (upper < root.upper || !visit(root)) return;
  }
}

std::vector<RootInterval> isolate_roots(const ExactPolynomial& square_free, const Dyadic& lower,
                                        const Dyadic& upper) {
  std::vector<RootInterval> roots;
  visit_roots(square_free, lower, upper, [&roots](RootInterval root) {
    roots.push_back(std::move(root));
    return true;
  });
  return roots;
}

}  // namespace kds
