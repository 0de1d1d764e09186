#include "experiments/bench_chains.h"

#include "motions/models/model.h"
#include "motions/models/random.h"

namespace kds {

Eigen::Matrix3Xd model_at_rest(std::string_view name, std::size_t beads, double jitter) {
  const models::Model* model = models::find_model(name);
  models::Settings settings{.beads = beads, .motion = models::ShapeMotion::rest};
  if (model->takes(models::Setting::jitter)) settings.jitter = jitter;
  return models::generate(*model, settings).front().frames.front();
}

std::vector<Eigen::Matrix3Xd> jostled_frames(const Eigen::Matrix3Xd& start, double distance,
                                             std::size_t frames) {
  models::Random random(1);
  std::vector<Eigen::Matrix3Xd> all{start};
  while (all.size() < frames) {
    all.push_back(all.back());
    for (Eigen::Index b = 0; b < start.cols(); ++b) all.back().col(b) += distance * random.direction();
  }
  return all;
}

}  // namespace kds
