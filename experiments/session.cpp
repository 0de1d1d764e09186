#include "experiments/session.h"

#include <fmt/format.h>

#include "experiments/make_session_of.h"
#include "motions/input_error.h"

namespace kds {

namespace {

template <int Dimension>
std::unique_ptr<Session> make_session_in(const Scene& scene, const std::vector<std::string>& structures,
                                         KernelName kernel, AuditMode audits) {
  switch (scene.degree()) {
    case 1:
      return make_session_of<BezierMotion<Dimension, 1>>(scene, structures, kernel, audits);
    case 2:
      return make_session_of<BezierMotion<Dimension, 2>>(scene, structures, kernel, audits);
    case 3:
      return make_session_of<BezierMotion<Dimension, 3>>(scene, structures, kernel, audits);
    default:
      throw InputError(
          fmt::format("motions of degree {} are not supported yet, only up to 3", scene.degree()));
  }
}

}  // namespace

std::unique_ptr<Session> make_session(const Scene& scene, const std::vector<std::string>& structures,
                                      KernelName kernel, AuditMode audits) {
  switch (scene.dimension()) {
    case 1:
      return make_session_in<1>(scene, structures, kernel, audits);
    case 2:
      return make_session_in<2>(scene, structures, kernel, audits);
    default:
      return make_session_in<3>(scene, structures, kernel, audits);
  }
}

}  // namespace kds
