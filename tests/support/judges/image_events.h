#pragma once
// Judges the contact events of each pair of balls in a periodic cell: the polynomials of all images of the
// second ball within a box of shifts, over rationals, and all of their roots by Sturm sequences. The judge
// uses nothing of certificates/ or structures/contacts.

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "tests/support/judges/contact_events.h"

namespace kds::test {

/// A motion of two balls, the second of which is shifted by whole multiples of the cell's vectors. Its
/// coordinates are rational.
template <Motion M>
struct ShiftedPair {
  static constexpr int dimension = M::dimension;
  static constexpr int degree = M::degree;
  const M& motion;
  BeadPair pair;
  std::array<int, static_cast<std::size_t>(M::dimension)> shift;

  [[nodiscard]] Rational coordinate(BeadId bead, int k, int axis) const {
    Rational x(motion.coordinate(bead, k, axis));
    if (bead != pair.second) return x;
    for (int vector = 0; vector < dimension; ++vector)
      x += shift[static_cast<std::size_t>(vector)] *
           Rational(motion.cell()[(vector * (degree + 1) + k) * dimension + axis]);
    return x;
  }
  [[nodiscard]] double radius(BeadId bead, int k) const { return motion.radius(bead, k); }

  /// Returns whether the balls are plainly apart along an axis at all control points, and so at all times.
  [[nodiscard]] bool are_plainly_apart() const {
    for (int axis = 0; axis < dimension; ++axis) {
      bool above = true, below = true;
      for (int k = 0; k <= degree; ++k) {
        double d = motion.coordinate(pair.second, k, axis) - motion.coordinate(pair.first, k, axis);
        for (int vector = 0; vector < dimension; ++vector)
          d += shift[static_cast<std::size_t>(vector)] *
               motion.cell()[(vector * (degree + 1) + k) * dimension + axis];
        const double reach = motion.radius(pair.first, k) + motion.radius(pair.second, k) + 1e-6;
        above = above && d > reach;
        below = below && d < -reach;
      }
      if (above || below) return true;
    }
    return false;
  }
};

/// Returns the history of a pair, with the shifts from -most to most of every cell vector.
template <Motion M>
PairHistory history_of_images(const std::vector<M>& steps, const BeadPair& pair, int most) {
  enum : std::uint8_t { begin, end, touch };
  PairHistory history;
  bool in_contact = false;
  const auto at_start = std::make_shared<const sturm::Sequence>(sturm::Polynomial{0, 1});
  for (std::size_t step = 0; step < steps.size(); ++step) {
    std::vector<sturm::Polynomial> images;
    ShiftedPair<M> image{steps[step], pair, {}};
    const auto fill = [&](const auto& self, std::size_t vector) -> void {
      if (vector == image.shift.size()) {
        if (!image.are_plainly_apart()) images.push_back(contact_polynomial(image, pair));
        return;
      }
      for (int multiple = -most; multiple <= most; ++multiple) {
        image.shift[vector] = multiple;
        self(self, vector + 1);
      }
    };
    fill(fill, 0);
    const auto any = [&](const auto& meets) {
      return std::any_of(images.begin(), images.end(),
                         [&](const sturm::Polynomial& f) { return f.empty() || meets(f); });
    };
    const auto change = [&](bool meets, bool after, const auto& sequence, const sturm::Root& root) {
      if (in_contact != after)
        history.events.push_back({step, after ? begin : end, sequence, root});
      else if (!in_contact && meets)
        history.events.push_back({step, touch, sequence, root});
      in_contact = after;
    };
    const bool after = any([](const auto& f) { return sturm::sign_after(f, 0) < 0; });
    if (step == 0) in_contact = history.in_contact_at_start = after;
    change(any([](const auto& f) { return sturm::sign_at(f, 0) <= 0; }), after, at_start, {0, 0});
    // All roots of all images, in order.
    sturm::Polynomial product{1};
    for (const sturm::Polynomial& f : images) {
      if (f.size() < 2 || sturm::Sequence(f).roots_on(0, 1) == 0) continue;
      sturm::Polynomial longer(product.size() + f.size() - 1);
      for (std::size_t a = 0; a < product.size(); ++a)
        for (std::size_t b = 0; b < f.size(); ++b) longer[a + b] += product[a] * f[b];
      product = sturm::square_free(longer);
    }
    if (product.size() < 2) continue;
    const auto sequence = std::make_shared<const sturm::Sequence>(product);
    for (const sturm::Root& root : sturm::roots_on(*sequence, 0, 1)) {
      if (root.is_number() && (root.lower == 0 || root.lower == 1)) continue;
      const bool meets = any([&](const auto& f) { return sturm::shares(*sequence, root, f); });
      const bool stays = any([&](const auto& f) { return sturm::sign_after(f, *sequence, root) < 0; });
      change(meets, stays, sequence, root);
    }
  }
  history.in_contact_at_end = in_contact;
  return history;
}

}  // namespace kds::test
