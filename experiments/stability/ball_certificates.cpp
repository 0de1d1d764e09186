// Certificate types of balls as subjects of `kds stability`: one line each.

#include "certificates/types/ball_in_sphere.h"
#include "certificates/types/contact.h"
#include "experiments/stability/certificate_trial.h"

namespace kds {

template <int degree>
std::vector<StabilitySubject> ball_certificates() {
  using Line = BezierMotion<1, degree>;
  using Plane = BezierMotion<2, degree>;
  using Space = BezierMotion<3, degree>;
  return {
      certificate_subject<Contact, Line>("contact"),
      certificate_subject<Contact, Plane>("contact"),
      certificate_subject<Contact, Space>("contact"),
      certificate_subject<BallInSphere<2, 1>, Plane>("ball_in_sphere_1"),
      certificate_subject<BallInSphere<3, 1>, Space>("ball_in_sphere_1"),
      certificate_subject<BallInSphere<2, 2>, Plane>("ball_in_sphere_2"),
      certificate_subject<BallInSphere<3, 2>, Space>("ball_in_sphere_2"),
      certificate_subject<BallInSphere<2, 3>, Plane>("ball_in_sphere_3"),
      certificate_subject<BallInSphere<3, 3>, Space>("ball_in_sphere_3"),
      certificate_subject<BallInSphere<3, 4>, Space>("ball_in_sphere_4"),
  };
}

template std::vector<StabilitySubject> ball_certificates<1>();
template std::vector<StabilitySubject> ball_certificates<3>();

}  // namespace kds
