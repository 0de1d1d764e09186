// Certificate types under straight motion: one line each. They take long to compile.

#include "certificates/bead_in_sphere.h"
#include "certificates/orientation.h"
#include "certificates/power_test.h"
#include "certificates/precedes.h"
#include "experiments/certificate_trial.h"

namespace kds {

std::vector<StabilitySubject> linear_certificates() {
  using Line = BezierMotion<1, 1>;
  using Plane = BezierMotion<2, 1>;
  using Space = BezierMotion<3, 1>;
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
