#include "experiments/session_of_motion.h"
#include "experiments/sessions.h"

namespace kds {

std::unique_ptr<Session> make_session_in_line(const Scene& scene, const std::vector<std::string>& structures,
                                              KernelName kernel, AuditMode audits) {
  switch (scene.degree()) {
    case 1:
      return make_session_of<BezierMotion<1, 1>>(scene, structures, kernel, audits);
    case 2:
      return make_session_of<BezierMotion<1, 2>>(scene, structures, kernel, audits);
    case 3:
      return make_session_of<BezierMotion<1, 3>>(scene, structures, kernel, audits);
    default:
      throw unsupported_degree(scene.degree());
  }
}

}  // namespace kds
