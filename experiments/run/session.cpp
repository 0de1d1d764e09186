#include "experiments/run/session.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/run/make_session_of.h"
#include "motions/base/input_error.h"
#include "motions/curves/elevated_motion.h"
#include "motions/curves/lifted_motion.h"

namespace kds {

namespace {

template <int Dimension>
std::unique_ptr<Session> make_session_in(const Scene& scene, const SessionOptions& options) {
  switch (scene.degree()) {
    case 1:
      return make_session_of<BezierMotion<Dimension, 1>>(scene, options);
    case 2:
      return make_session_of<BezierMotion<Dimension, 2>>(scene, options);
    case 3:
      return make_session_of<BezierMotion<Dimension, 3>>(scene, options);
  }
  if (scene.degree() > highest_degree) {
    throw InputError(
        fmt::format("motions of degree {}: expected a degree from 1 to {}", scene.degree(), highest_degree));
  }
  if (options.kernel == KernelName::fast) {
    throw InputError(
        fmt::format("--kernel fast: motions of degree {} (above {}) run in whole numbers only; expected "
                    "filtered or exact",
                    scene.degree(), highest_filtered_degree));
  }
  return make_session_of<ElevatedMotion<Dimension, highest_degree>>(scene, options);
}

}  // namespace

std::unique_ptr<Session> make_session(const Scene& scene, const SessionOptions& options) {
  if (std::ranges::find(options.structures, "power") != options.structures.end()) scene.require_weights();
  if (scene.is_lifted()) {
    return scene.dimension() == 2 ? make_session_of<LiftedMotion<2>>(scene, options)
                                  : make_session_of<LiftedMotion<3>>(scene, options);
  }
  switch (scene.dimension()) {
    case 1:
      return make_session_in<1>(scene, options);
    case 2:
      return make_session_in<2>(scene, options);
    default:
      return make_session_in<3>(scene, options);
  }
}

}  // namespace kds
