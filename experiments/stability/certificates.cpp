// Makes each certificate type a subject of `kds stability`, with one line per type.

#include "certificates/search/support_searches.h"
#include "certificates/types/ball_in_sphere.h"
#include "certificates/types/bead_in_sphere.h"
#include "certificates/types/distances.h"
#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "certificates/types/precedes.h"
#include "certificates/types/reaches_further.h"
#include "experiments/stability/certificate_trial.h"

namespace kds {

std::vector<StabilitySubject> bead_certificates(int degree) {
  return {
      certificate_subject<Precedes, 1>("precedes", degree),
      certificate_subject<ReachesFurther, 2>("reaches_further", degree),
      certificate_subject<ReachesFurther, 3>("reaches_further", degree),
      certificate_subject<Orientation<2>, 2>("orientation", degree),
      certificate_subject<Orientation<3>, 3>("orientation", degree),
      certificate_subject<PowerTest<2>, 2>("power_test", degree),
      certificate_subject<PowerTest<3>, 3>("power_test", degree),
      certificate_subject<BeadInSphere<1>, 3>("bead_in_sphere_1", degree),
      certificate_subject<BeadInSphere<2>, 2>("bead_in_sphere_2", degree),
      certificate_subject<BeadInSphere<2>, 3>("bead_in_sphere_2", degree),
      certificate_subject<BeadInSphere<3>, 3>("bead_in_sphere_3", degree),
  };
}

std::vector<StabilitySubject> ball_certificates(int degree) {
  return {
      certificate_subject<Contact, 1>("contact", degree),
      certificate_subject<Contact, 2>("contact", degree),
      certificate_subject<Contact, 3>("contact", degree),
      certificate_subject<BallReachesFurther, 2>("ball_reaches_further", degree),
      certificate_subject<BallReachesFurther, 3>("ball_reaches_further", degree),
      certificate_subject<BallInSphere<2, 1>, 2>("ball_in_sphere_1", degree),
      certificate_subject<BallInSphere<3, 1>, 3>("ball_in_sphere_1", degree),
      certificate_subject<BallInSphere<2, 2>, 2>("ball_in_sphere_2", degree),
      certificate_subject<BallInSphere<3, 2>, 3>("ball_in_sphere_2", degree),
      certificate_subject<BallInSphere<2, 3>, 2>("ball_in_sphere_3", degree),
      certificate_subject<BallInSphere<3, 3>, 3>("ball_in_sphere_3", degree),
      certificate_subject<BallInSphere<3, 4>, 3>("ball_in_sphere_4", degree),
  };
}

}  // namespace kds
