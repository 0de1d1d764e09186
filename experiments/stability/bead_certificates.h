#pragma once
// Certificate types of beads: one line each, for one degree of motion. They take long to
// compile: each degree in a file of its own (stability_certificates.cpp.in).

#include "certificates/types/bead_in_sphere.h"
#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "certificates/types/precedes.h"
#include "experiments/stability/certificate_trial.h"

namespace kds {

template <int degree>
std::vector<StabilitySubject> bead_certificates() {
  using Line = BezierMotion<1, degree>;
  using Plane = BezierMotion<2, degree>;
  using Space = BezierMotion<3, degree>;
  return {
      certificate_subject<Precedes, Line>("precedes"),
      certificate_subject<Orientation<2>, Plane>("orientation"),
      certificate_subject<Orientation<3>, Space>("orientation"),
      certificate_subject<PowerTest<2>, Plane>("power_test"),
      certificate_subject<PowerTest<3>, Space>("power_test"),
      certificate_subject<BeadInSphere<1>, Space>("bead_in_sphere_1"),
      certificate_subject<BeadInSphere<2>, Plane>("bead_in_sphere_2"),
      certificate_subject<BeadInSphere<2>, Space>("bead_in_sphere_2"),
      certificate_subject<BeadInSphere<3>, Space>("bead_in_sphere_3"),
  };
}

}  // namespace kds
