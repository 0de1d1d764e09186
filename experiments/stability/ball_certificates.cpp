// Makes each certificate type of balls a subject of `kds stability`, with one line per type.

#include "certificates/types/ball_in_sphere.h"
#include "certificates/types/contact.h"
#include "experiments/stability/certificate_trial.h"

namespace kds {

std::vector<StabilitySubject> ball_certificates(int degree) {
  return {
      certificate_subject<Contact, 1>("contact", degree),
      certificate_subject<Contact, 2>("contact", degree),
      certificate_subject<Contact, 3>("contact", degree),
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
