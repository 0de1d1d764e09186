#include "certificates/exact/wide_roots.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>
#include <variant>

#include "certificates/exact/halves.h"

namespace kds {

namespace {

using Level = std::int64_t;
using Part = WidePolynomial::Part;
using Stretches = decltype(WidePolynomial::Found::roots);

/// Returns the scale of a number between 0 and 1: 0 in [1/2, 1), -1 in [1/4, 1/2), and so on towards 0.
/// Scales towards 1 are positive and mirror this.
Level level_of(const Dyadic& u) {
  const auto power_of = [](const Integer& numerator, unsigned exponent) {
    return static_cast<Level>(bit_length(numerator)) - 1 - static_cast<Level>(exponent);
  };
  const Level power = power_of(u.numerator(), u.exponent());
  if (power < -1 || (u.numerator() == 1 && u.exponent() == 1)) return power + 1;
  return -(power_of((Integer(1) << u.exponent()) - u.numerator(), u.exponent()) + 1);
}

/// Returns the simplest number of a scale: its end towards 0 or 1.
Dyadic at_level(Level level) {
  if (level <= 0) return {1, static_cast<unsigned>(1 - level)};
  const auto bits = static_cast<unsigned>(level + 1);
  return {(Integer(1) << bits) - 1, bits};
}

/// An interval divided into 2^digits equal cells.
struct Cells {
  Integer from, length;
  unsigned exponent;

  Cells(const Dyadic& lower, const Dyadic& upper, unsigned digits)
      : exponent(std::max(lower.exponent(), upper.exponent())) {
    from = lower.numerator() << (exponent - lower.exponent());
    length = (upper.numerator() << (exponent - upper.exponent())) - from;
    from <<= digits;
    exponent += digits;
  }
  [[nodiscard]] Dyadic border(const Integer& number) const { return {from + number * length, exponent}; }
};

/// Returns the cell, of `cells` equal parts of an interval, in which the linear interpolation between the
/// values at both ends is zero.
Integer straight_zero(const BallNumber& at_lower, const BallNumber& at_upper, const Integer& cells) {
  if (at_lower.is_zero() || at_upper.is_zero()) return at_lower.is_zero() ? Integer(0) : Integer(cells - 1);
  const std::int64_t unit = std::min(at_lower.lowest_bit(), at_upper.lowest_bit());
  Integer error, from = abs(at_lower.in_units(unit, error)), to = abs(at_upper.in_units(unit, error));
  if (from + to == 0) return 0;
  const Integer cell = from * cells / (from + to);
  return cell < cells ? cell : Integer(cells - 1);
}

/// Subdivides intervals until each holds one root or none: first by scales, then by halving, which takes only
/// additions. If halving loses no sign change for long, the roots form a cluster and are approached like one
/// multiple root (Sagraloff's Descartes method with Newton steps). If the cells that the Newton step predicts
/// contain all sign changes, the rest has no root, and the number of digits doubles.
class WideIsolation {
 public:
  /// Isolates the roots in [from, to].
  WideIsolation(const WidePolynomial& polynomial, const Dyadic& from, const Dyadic& to)
      : polynomial_(polynomial), from_(from), to_(to) {}

  /// Divides `part` into stretches. Up to the first root wanted, these are isolated roots and the gaps
  /// between them; after it, parts are left as they are.
  [[nodiscard]] Stretches of(Part part) && {
    visit(std::move(part));
    return std::move(stretches_);
  }

  /// Returns whether this part may contain roots of [from, to].
  [[nodiscard]] static bool is_wanted(const Part& part, const Dyadic& from, const Dyadic& to) {
    return from < part.upper && (part.lower < to || (part.lower == to && has_root_at_lower(part)));
  }

 private:
  // Examining a part costs about as much as this number of halvings.
  static constexpr unsigned fewest_digits = 16, most_digits = 2048;

  [[nodiscard]] static bool has_root_at_lower(const Part& part) {
    return part.with_lower && part.sign_at_lower == 0;
  }

  [[nodiscard]] bool is_past(const Part& part) const { return !(from_ < part.upper); }
  /// Returns whether the part is left as it is.
  bool puts_off(const Part& part) {
    if (!is_done_ && is_wanted(part, from_, to_)) return false;
    stretches_.emplace_back(part);
    return true;
  }

  void add(RootInterval root) {
    is_done_ |= from_ < root.upper || (root.lower == root.upper && root.lower == from_);
    stretches_.emplace_back(std::move(root));
  }

  void visit(Part part) {
    if (puts_off(part)) return;
    if (has_root_at_lower(part)) add({part.lower, part.lower});
    part.with_lower = false;
    if (puts_off(part)) return;
    if (is_of_one_scale(part))
      return visit_closely(seen_closely(polynomial_, part.lower, part.upper, part.bits), part);
    Variations variations =
        polynomial_.variations_on(part.lower, part.upper, part.sign_at_lower, part.sign_at_upper);
    if (is_unclear(variations))
      variations = variations_closely(polynomial_, part.lower, part.upper, part.bits);
    if (variations.most == 0) return;
    if (has_one_root(part, variations)) return add({part.lower, part.upper, 1, part.sign_at_lower});
    const Dyadic middle = split_point(part.lower, part.upper);
    auto [left, right] = split(part, middle, polynomial_.sign_at(middle));
    right.with_lower = true;
    visit(left);
    visit(right);
  }

  [[nodiscard]] static bool is_unclear(const Variations& v) { return v.least < 2 && v.least != v.most; }
  [[nodiscard]] static bool is_of_one_scale(const Part& part) {
    return !(part.lower == Dyadic(0.0)) && !(part.upper == Dyadic(1.0)) &&
           split_point(part.lower, part.upper) == Dyadic::midpoint(part.lower, part.upper);
  }
  [[nodiscard]] static bool has_one_root(const Part& part, const Variations& v) {
    return part.sign_at_lower != 0 && part.sign_at_upper != 0 && v.least == 1 && v.most == 1;
  }
  [[nodiscard]] static std::pair<Part, Part> split(const Part& part, const Dyadic& point, int sign) {
    Part left = part, right = part;
    left.upper = right.lower = point;
    left.sign_at_upper = right.sign_at_lower = sign;
    return {std::move(left), std::move(right)};
  }

  // Visits the roots of a part of one scale that has no root at `lower`. Halves the polynomial restricted to
  // that part, and takes twice as many bits if signs stay unknown. Later parts are put off if they would have
  // to be examined again.
  void visit_closely(Halves seen, Part part) {
    if (is_past(part) && puts_off(part)) return;
    const Variations variations = seen.variations(part.sign_at_lower, part.sign_at_upper);
    if (variations.most == 0) return;
    if (has_one_root(part, variations)) return add({part.lower, part.upper, 1, part.sign_at_lower});
    if (is_unclear(variations)) {
      if (puts_off(part)) return;
      // The part has become small compared with the error of its numbers, or the numbers were too short from
      // the start.
      if (seen.depth() == 0) part.bits *= 2;
      return visit_closely(seen_closely(polynomial_, part.lower, part.upper, part.bits), part);
    }
    if (variations.least == variations.most) {
      part.digits = variations.least == part.changes ? part.digits + 1 : 0;
      part.changes = variations.least;
      if (part.digits >= fewest_digits) {
        if (puts_off(part)) return;
        if (std::optional<Halves> closer = narrow_to_cluster(seen, part))
          return visit_closely(std::move(*closer), std::move(part));
      }
    }
    const Dyadic middle = Dyadic::midpoint(part.lower, part.upper);
    const Halves left_half = seen.halve();
    const int sign = sign_of(left_half.sign_at_upper(), middle);
    auto [left, right] = split(part, middle, sign);
    visit_closely(left_half, left);
    if (sign == 0) add({middle, middle});
    visit_closely(std::move(seen), right);
  }

  /// Narrows the part to a cluster that holds all its sign changes, if both ends predict such a cluster.
  /// Returns the polynomial restricted to it.
  [[nodiscard]] std::optional<Halves> narrow_to_cluster(const Halves& seen, Part& part) const {
    const unsigned digits = part.digits;
    part.digits /= 2;
    const std::optional<Halves::Cells> cluster = seen.cells_of_cluster(part.changes, digits);
    if (!cluster) return std::nullopt;
    const Cells cells(part.lower, part.upper, digits);
    Part around = part;
    around.lower = cells.border(cluster->first);
    around.upper = cells.border(cluster->last + 1);
    around.digits = std::min(2 * digits, most_digits);
    while (true) {
      Halves closer = seen_closely(polynomial_, around.lower, around.upper, around.bits);
      around.sign_at_lower = sign_of(closer.sign_at_lower(), around.lower);
      around.sign_at_upper = sign_of(closer.sign_at_upper(), around.upper);
      if (around.sign_at_lower == 0 || around.sign_at_upper == 0) return std::nullopt;
      const Variations inside = closer.variations(around.sign_at_lower, around.sign_at_upper);
      if (inside.most < part.changes) return std::nullopt;
      if (inside.least == part.changes) {
        part = std::move(around);
        return closer;
      }
      around.bits *= 2;
    }
  }
  [[nodiscard]] int sign_of(const std::optional<int>& known, const Dyadic& u) const {
    return known ? *known : polynomial_.sign_at(u);
  }

  const WidePolynomial& polynomial_;
  const Dyadic &from_, &to_;
  bool is_done_ = false;  // the first root wanted is found
  Stretches stretches_;
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

/// Returns the polynomial that stores the results for `polynomial` and its negative.
const WidePolynomial& own_of(const WidePolynomial& polynomial) {
  return polynomial.opposite() ? *polynomial.opposite() : polynomial;
}
/// Converts a root between the polynomial that stores the results and its negative: the sign is flipped if
/// this polynomial is a negative.
RootInterval seen_by(const WidePolynomial& polynomial, RootInterval root) {
  if (polynomial.opposite()) root.sign_at_lower = -root.sign_at_lower;
  return root;
}

/// Returns what is known of the roots in [0,1]. Initially that is one part, which may contain any root.
Stretches& stretches_of(const WidePolynomial& own) {
  Stretches& known = own.found().roots;
  if (!known.empty()) return known;
  const Dyadic start(0.0), end(1.0);
  const int sign_at_start = own.sign_at(start), sign_at_end = own.sign_at(end);
  known.emplace_back(Part{start, end, sign_at_start, sign_at_end, true});
  // The entry for the end stays in the list, so the end is examined only once.
  known.emplace_back(sign_at_end == 0 ? Stretches::value_type(RootInterval{end, end})
                                      : Stretches::value_type(Part{end, end, sign_at_end, sign_at_end}));
  return known;
}

bool lies_in(const RootInterval& root, const Dyadic& lower, const Dyadic& upper) {
  return lower <= root.lower && root.upper <= upper;
}

/// Cuts a root's interval at a point, so that the interval lies on one side of it.
void cut(RootInterval& root, const Dyadic& point, const WidePolynomial& square_free) {
  if (!(root.lower < point && point < root.upper)) return;
  const int sign = square_free.sign_at(point);
  if (sign == 0) {
    root.lower = root.upper = point;
  } else {
    if (root.sign_at_lower == 0) root.sign_at_lower = square_free.sign_at(root.lower);
    (sign == root.sign_at_lower ? root.lower : root.upper) = point;
  }
}

}  // namespace

void visit_wide_roots(const WidePolynomial& square_free, const Dyadic& lower, const Dyadic& upper,
                      const RootVisitor& visit) {
  const WidePolynomial& own = own_of(square_free);
  Stretches& stretches = stretches_of(own);
  for (auto at = stretches.begin(); at != stretches.end();) {
    if (const Part* part = std::get_if<Part>(&*at)) {
      if (part->upper <= lower) {
        ++at;
        continue;
      }
      if (!WideIsolation::is_wanted(*part, lower, upper)) return;
      Stretches found = WideIsolation(own, lower, upper).of(*part);
      const auto next = stretches.erase(at);
      at = found.empty() ? next : found.begin();
      stretches.splice(next, found);
      continue;
    }
    RootInterval& root = std::get<RootInterval>(*at++);
    cut(root, lower, own);
    if (root.lower < lower) continue;
    cut(root, upper, own);
    if (upper < root.upper || !visit(seen_by(square_free, root))) return;
  }
}

std::optional<RootsAround> known_roots_around(const WidePolynomial& square_free, const Dyadic& lower,
                                              const Dyadic& upper) {
  const WidePolynomial::Found& found = square_free.found();
  for (const RootInterval& root : found.some_roots)
    if (lies_in({lower, upper}, root.lower, root.upper)) return RootsAround{1, seen_by(square_free, root)};
  if (found.roots.empty()) return std::nullopt;
  RootsAround around;
  for (const auto& stretch : found.roots) {
    if (const Part* part = std::get_if<Part>(&stretch)) {
      if (lower < part->upper && part->lower < upper) return std::nullopt;
      continue;
    }
    const RootInterval& root = std::get<RootInterval>(stretch);
    if (root.upper <= lower || upper <= root.lower) continue;
    if (around.count++ == 0) around.first = seen_by(square_free, root);
    if (around.count == 2) break;
  }
  return around;
}

bool has_digits(const RootInterval& root, unsigned digits) {
  const detail::Ends ends(root.lower, root.upper);
  return bit_length(ends.upper - ends.lower) + digits <
         std::min(bit_length(ends.upper), bit_length(ends.above_lower));
}

namespace {

void narrow(const WidePolynomial& polynomial, RootInterval& root) {
  unsigned& digits = root.digits;
  const auto take = [&](Dyadic point) {  // returns whether the root is after the point
    const int sign = polynomial.sign_at(point);
    if (sign == 0) {
      root.lower = root.upper = std::move(point);
      return false;
    }
    const bool after = sign == root.sign_at_lower;
    (after ? root.lower : root.upper) = std::move(point);
    return after;
  };
  if (Dyadic split = split_point(root.lower, root.upper);
      !(split == Dyadic::midpoint(root.lower, root.upper))) {
    take(std::move(split));
    return;
  }
  // Try one cell of 2^digits, or its neighbour if the guess is wrong.
  constexpr unsigned most_digits = 4096;
  const Integer cells = Integer(1) << digits;
  const Integer cell = straight_zero(value_at(polynomial, root.lower, digits + 2),
                                     value_at(polynomial, root.upper, digits + 2), cells);
  const Cells parts(root.lower, root.upper, digits);
  const bool after = cell == 0 || take(parts.border(cell));
  const bool before =
      !(root.lower == root.upper) && after && (cell + 1 == cells || !take(parts.border(cell + 1)));
  digits = after && before ? std::min(2 * digits, most_digits) : std::max(1U, digits / 2);
}

}  // namespace

// Replaces the known root whose interval contains this one, wherever it is stored. Roots in parts not yet
// isolated are stored too, but only the last few.
void keep_root(const WidePolynomial& polynomial, const RootInterval& root) {
  const RootInterval narrowed = seen_by(polynomial, root);
  WidePolynomial::Found& found = polynomial.found();
  bool kept = false;
  const auto keep_in = [&](RootInterval* known) {
    if (known == nullptr || !lies_in(narrowed, known->lower, known->upper)) return;
    *known = narrowed;
    kept = true;
  };
  for (auto& stretch : found.roots) keep_in(std::get_if<RootInterval>(&stretch));
  for (RootInterval& some : found.some_roots) keep_in(&some);
  if (kept) return;
  constexpr std::size_t few = 16;
  if (found.some_roots.size() == few) found.some_roots.erase(found.some_roots.begin());
  found.some_roots.push_back(narrowed);
}

void narrow_root(const WidePolynomial& polynomial, RootInterval& root) {
  narrow(polynomial, root);
  keep_root(polynomial, root);
}

RootInterval known_root(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper) {
  const WidePolynomial::Found& found = polynomial.found();
  for (const auto& stretch : found.roots) {
    const auto* known = std::get_if<RootInterval>(&stretch);
    if (known != nullptr && lies_in(*known, lower, upper)) return seen_by(polynomial, *known);
  }
  for (const RootInterval& known : found.some_roots)
    if (lies_in(known, lower, upper)) return seen_by(polynomial, known);
  return {lower, upper};
}

}  // namespace kds
