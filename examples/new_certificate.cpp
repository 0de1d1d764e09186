// Computes when two certificate types defined outside the framework fail. The exact failure times, the filter
// and the statistics follow from the formulas of the certificates.
#include "examples/new_certificate.h"

#include <cstdio>
#include <vector>

#include "certificates/search/define_certificate_search.h"
#include "motions/curves/bezier_motion.h"

namespace {

constexpr kds::BeadId beads = 40;
using Motion = kds::BezierMotion<3, 1>;  // in space, linear in u

/// Makes a cloud that turns inside out: each bead moves through the origin to the opposite side.
Motion cloud() {
  Motion motion(beads);
  for (kds::BeadId bead = 0; bead < beads; ++bead) {
    for (int axis = 0; axis < 3; ++axis) {
      const double start = (bead * (7 + 10 * axis) + 3 * axis) % 41 - 20.0;
      motion.set_coordinate(bead, 0, axis, start);
      motion.set_coordinate(bead, 1, axis, axis == 0 ? 3 - start : -start / 2);
    }
  }
  return motion;
}

/// Searches for the first failures of the certificates that hold at the start, and prints the earliest.
template <class Certificate>
void tell(const Motion& motion, const typename Certificate::Constants& constants,
          const std::vector<Certificate>& certificates) {
  const auto search = kds::search_over<Certificate>(kds::MotionRef<3>(motion));
  search->set_constants(constants);
  std::vector<kds::KnownAtStart> known(certificates.size(), kds::KnownAtStart::unknown);
  std::vector<kds::Failure> failures(certificates.size());
  kds::StageCounts stages;
  search->first_failures(kds::Kernel::filtered, certificates, kds::Instant(0), known, stages,
                         kds::TouchPolicy::ignored, failures);
  std::size_t first = certificates.size(), later = 0;
  for (std::size_t i = 0; i < failures.size(); ++i) {
    if (failures[i].kind != kds::Failure::Kind::later) continue;
    ++later;
    if (first == certificates.size() || failures[i].time.upper < failures[first].time.lower) first = i;
  }
  std::printf("%s: %d of %d fail in the step, bead %u first, at u = %.10f\n", Certificate::type.name.data(),
              static_cast<int>(later), static_cast<int>(certificates.size()), certificates[first].beads[0],
              failures[first].time.lower);
  std::printf("  decided in double %d, on integers %d\n",
              static_cast<int>(stages.coefficients + stages.isolation + stages.refined),
              static_cast<int>(stages.exact + stages.identically_zero));
}

}  // namespace

int main() {
  const Motion motion = cloud();
  std::vector<Near> pairs;
  for (kds::BeadId b = 1; b < beads; ++b)
    for (kds::BeadId a = 0; a < b; ++a) pairs.push_back({{a, b}, /*near=*/false});
  tell(motion, {.cutoff = {1, 9}}, pairs);  // the cutoff grows from 1 to 9

  std::vector<Above> sides;
  for (kds::BeadId b = 0; b < beads; ++b) sides.push_back({{b}});
  // The plane rises along its normal, and the normal turns meanwhile.
  tell(motion, {.foot = {{0, 0, -30}, {0, 0, 10}}, .normal = {{0, 0, 1}, {0.5, 0, 1}}}, sides);
}
