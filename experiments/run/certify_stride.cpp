#include "experiments/run/certify_stride.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "experiments/program/input_options.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/run_steps.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

std::unique_ptr<SceneStream> open_frames(const RunOptions& options, std::size_t stride) {
  const InputOptions input{options.inputs, options.reading, options.radius};
  std::vector<NecklaceStream> files;
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    ReadOptions reading = reading_of(input, i);
    reading.frames.stride = stride;
    files.emplace_back(options.inputs[i], reading);
  }
  return std::make_unique<SceneStream>(std::move(files));
}

class PairsListener final : public EventListener {
 public:
  void on_event(const Event& event) override { pairs.emplace(event.ids()[0], event.ids()[1]); }

  PairsMet pairs;
};

/// All pairs in contact at some time of the run, with these radii.
PairsMet pairs_met(const RunOptions& options, const SceneSurvey& survey, std::vector<double> radii,
                   const std::optional<double>& tolerance) {
  auto frames = open_frames(options, options.reading.frames.stride);
  if (tolerance) frames->straighten(*tolerance);
  const Scene scene(std::move(frames), survey, std::move(radii), options.motion);
  RunOptions contacts;
  contacts.structures = {"contacts"};
  contacts.kernel =
      options.kernel == Kernel::exact ? Kernel::exact : Kernel::filtered;  // none but these is sure
  contacts.apart = options.apart;
  const auto session = open_session(contacts, scene, AuditMode::none);
  PairsListener listener;
  session->simulator().listen(listener);
  run_steps(*session, scene, contacts, [&](std::size_t frame) {
    if (frame != 0) return;
    for (const Event& event : session->built(0)) listener.on_event(event);
  });
  return listener.pairs;
}

ContactBounds bound_contacts(const RunOptions& options, const Scene& scene,
                             const StrideDeviation& deviation) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const SceneSurvey survey =
      open_frames(options, options.reading.frames.stride)->survey(false, [](const std::string&) {});
  std::vector<double> larger = scene.radii(), smaller = scene.radii();
  std::vector<std::uint8_t> has_a_ball(larger.size(), 1);
  for (std::size_t b = 0; b < larger.size(); ++b) {
    const double by = deviation.of_bead[b];
    larger[b] = std::nextafter(larger[b] + by, infinity);
    if (!std::isfinite(larger[b] * larger[b]))
      throw InputError(
          fmt::format("--certify: bead {} may be {} from where the run has it, too far to tell contacts by; "
                      "expected frames closer "
                      "to each other, or --structures without contacts",
                      b, by));
    smaller[b] = std::nextafter(smaller[b] - by, -infinity);
    if (smaller[b] > 0) continue;
    smaller[b] = 0;  // more than what is left of it: no pair with it is sure
    has_a_ball[b] = 0;
  }
  std::optional<double> tolerance;
  if (options.tolerance) tolerance = options.tolerance->length(scene.radii());
  ContactBounds bounds;
  bounds.found = pairs_met(options, survey, scene.radii(), tolerance);
  bounds.possible = pairs_met(options, survey, std::move(larger), tolerance);
  bounds.sure = pairs_met(options, survey, std::move(smaller), tolerance);
  std::erase_if(bounds.sure, [&](const std::pair<BeadId, BeadId>& pair) {
    return has_a_ball[pair.first] == 0 || has_a_ball[pair.second] == 0;
  });
  return bounds;
}

}  // namespace

void refuse_needless_certificate(const RunOptions& options) {
  if (options.certify && options.reading.frames.stride == 1 && !options.tolerance)
    throw InputError(
        "--certify: the run leaves out no frame; expected --frames FIRST:LAST:STRIDE with a stride above 1, "
        "or "
        "--tolerance");
}

StrideCertificate certify_stride(const RunOptions& options, const Scene& scene) {
  StrideCertificate certificate;
  certificate.deviation = deviation_of_stride(scene, *open_frames(options, 1), options.reading.frames.stride);
  const auto& names = options.structures;
  if (std::find(names.begin(), names.end(), "contacts") != names.end())
    certificate.contacts = bound_contacts(options, scene, certificate.deviation);
  return certificate;
}

}  // namespace kds
