// Makes each certificate type of beads a subject of `kds stability`, with one line per type.

#include "certificates/types/bead_in_sphere.h"
#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "certificates/types/precedes.h"
#include "experiments/stability/certificate_trial.h"

namespace kds {

std::vector<StabilitySubject> bead_certificates(int degree) {
  return {
      certificate_subject<Precedes, 1>("precedes", degree),
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

}  // namespace kds
