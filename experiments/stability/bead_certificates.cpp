// Certificate types of beads as subjects of `kds stability`: one line each.

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

template std::vector<StabilitySubject> bead_certificates<1>();
template std::vector<StabilitySubject> bead_certificates<3>();

}  // namespace kds
