#include "experiments/session.h"

#include <fmt/format.h>

#include "experiments/sessions.h"

namespace kds {

InputError unsupported_degree(int degree) {
  return InputError(fmt::format("motions of degree {} are not supported yet, only up to 3", degree));
}

std::unique_ptr<Session> make_session(const Scene& scene, const std::vector<std::string>& structures,
                                      KernelName kernel, AuditMode audits) {
  switch (scene.dimension()) {
    case 1:
      return make_session_in_line(scene, structures, kernel, audits);
    case 2:
      return make_session_in_plane(scene, structures, kernel, audits);
    default:
      return make_session_in_space(scene, structures, kernel, audits);
  }
}

}  // namespace kds
