#pragma once
// Makes, for typed tests, a random certificate of any type over beads 0, 1, 2, ..., and its negation.

#include <algorithm>
#include <tuple>

#include "certificates/types/bead_in_sphere.h"
#include "certificates/types/distances.h"
#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "certificates/types/precedes.h"
#include "tests/support/inputs/polynomials.h"

namespace kds::test {

template <class Certificate, class MotionType>
struct Subject {
  using C = Certificate;
  using M = MotionType;
  static constexpr std::size_t beads = std::tuple_size_v<decltype(Certificate{}.beads)>;
};

template <class C>
C random_certificate(Random& random) {
  C certificate;
  auto beads = certificate.beads;
  for (std::size_t i = 0; i < beads.size(); ++i) beads[i] = static_cast<BeadId>(i);
  std::shuffle(beads.begin(), beads.end(), random);
  const int sign = random() % 2 ? 1 : -1;
  if constexpr (std::is_constructible_v<C, decltype(beads), int>) {
    return C(beads, sign);
  } else if constexpr (requires { certificate.inside; }) {
    std::sort(beads.begin(), beads.end() - 1);
    return {beads, sign > 0};
  } else {
    return {beads};
  }
}

template <class C>
C opposite(C certificate) {
  if constexpr (requires { certificate.sign; }) {
    certificate.sign = -certificate.sign;
  } else if constexpr (requires { certificate.inside; }) {
    certificate.inside = !certificate.inside;
  } else {
    std::swap(certificate.beads[0], certificate.beads[1]);
  }
  return certificate;
}

}  // namespace kds::test
