#pragma once
// Steps of the search for a minimum enclosing sphere from a likely basis: compute the basis' sphere in
// double, scan the beads, and pivot with the bead that sticks out most, until a scan proves the basis. If
// doubles cannot decide or the pivots are too many, exact arithmetic takes over (enclosing_sphere_exactly).

#include <span>

#include "structures/enclosing_sphere/exact_sphere.h"
#include "structures/enclosing_sphere/sphere_scan.h"

namespace kds::detail {

inline constexpr int most_pivots = 32;

/// Returns the sphere of a basis, in double.
template <class Form>
[[gnu::always_inline]] inline typename Form::Sphere sphere_of_basis(const Balls<Form::Dimension>& balls,
                                                                    const Basis& basis) {
  typename Form::Sphere sphere;
  visit_size<Form::Dimension>(
      basis.size, [&](auto m) __attribute__((always_inline)) {
        sphere = Form::sphere(basis_balls<m>(balls, basis));
      });
  return sphere;
}

/// Returns how many beads are not certainly inside. `visit(sphere, look)` calls look(first, last) for each
/// run of beads that may be outside.
template <class Form, class Visit>
[[gnu::always_inline]] inline std::size_t count_outside(const Balls<Form::Dimension>& balls,
                                                        const typename Form::Sphere& sphere,
                                                        const Visit& visit) {
  const auto measure = Form::measure(balls, sphere);
  OutsideCount count;
  visit(
      sphere, [&](BeadId first, BeadId last)
                  __attribute__((always_inline)) { count.scan(measure, first, last); });
  return count.result();
}

template <class Form>
[[gnu::always_inline]] inline bool is_proved(const Basis& basis, const typename Form::Sphere& sphere,
                                             std::size_t outside) {
  return sphere.certain & (outside == basis.size);
}

/// Returns the bead that sticks out farthest, or no_bead if none certainly sticks out. `visit` is as in
/// count_outside.
template <class Form, class Visit>
[[gnu::always_inline]] inline BeadId escaped_bead(const Balls<Form::Dimension>& balls,
                                                  const typename Form::Sphere& sphere, const Visit& visit) {
  const auto measure = Form::measure(balls, sphere);
  Farthest farthest;
  visit(
      sphere, [&](BeadId first, BeadId last)
                  __attribute__((always_inline)) { farthest.scan(measure, first, last); });
  const double value = farthest.result();
  if (!(value > sphere.outer)) return no_bead;
  BeadId escaped = no_bead;
  visit(
      sphere, [&](BeadId first, BeadId last) __attribute__((always_inline)) {
        if (escaped == no_bead) escaped = find_value(measure, first, last, value);
      });
  return escaped;
}

/// Replaces an unproved basis by the next one to try. `find_escaped()` searches for the bead to insert.
/// Returns false if doubles find no next basis.
template <class Form, class Find>
bool next_basis(const Balls<Form::Dimension>& balls, Basis& basis, const typename Form::Sphere& sphere,
                const Find& find_escaped) {
  if (basis.size > 1 && !(sphere.least > 0)) {
    if (!(sphere.least < -1e-9)) return false;  // a correct basis must not be changed
    std::size_t index = 0;
    visit_size<Form::Dimension>(basis.size, [&](auto m) {
      if constexpr (m > 0) index = lightest<m>(balls, basis);
    });
    erase_bead_at(basis, index);
    return true;
  }
  const BeadId escaped = find_escaped();
  return escaped != no_bead && !basis.contains(escaped) && Form::pivot(balls, basis, escaped);
}

/// Returns two beads that are far apart: the bead of `some` farthest from `from`, then the bead of `others`
/// farthest from the first.
template <class Form>
[[gnu::always_inline]] inline Basis far_pair(const Balls<Form::Dimension>& balls,
                                             std::span<const BeadId> some, std::span<const BeadId> others,
                                             const Point<Form::Dimension>& from) {
  const auto farthest = [&](std::span<const BeadId> beads, const Point<Form::Dimension>& p) {
    BeadId best = beads[0];
    double most = -1;
    for (std::size_t i = 0; i < Basis::max_size; ++i) {  // a fixed count avoids branches
      const BeadId b = beads[i < beads.size() ? i : 0];
      const double reach = Form::reach(balls, b, p);
      best = reach > most ? b : best;
      most = reach > most ? reach : most;
    }
    return best;
  };
  const BeadId a = farthest(some, from);
  Basis pair;
  insert_bead(pair, a);
  insert_bead(pair, farthest(others, center_of(balls, a)));
  return pair;
}

}  // namespace kds::detail
