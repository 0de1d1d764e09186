// Certificate types of balls under straight motion: one line each. They take long to compile.

#include "certificates/ball_in_sphere.h"
#include "certificates/contact.h"
#include "experiments/certificate_trial.h"

namespace kds {

std::vector<StabilitySubject> linear_ball_certificates() {
  using Line = BezierMotion<1, 1>;
  using Plane = BezierMotion<2, 1>;
  using Space = BezierMotion<3, 1>;
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

}  // namespace kds
