#include "experiments/run/certify_stride.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
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

ContactBounds bound_contacts(const RunOptions& options, const Scene& scene, const StrideDeviation& deviation,
                             const std::optional<double>& tolerance) {
  const SceneSurvey survey =
      open_frames(options, options.reading.frames.stride)->survey(false, [](const std::string&) {});
  RadiiWithin radii;
  try {
    radii = radii_within(deviation, scene.radii());
  } catch (const InputError& error) {
    throw InputError(std::string("--certify: ") + error.what());
  }
  ContactBounds bounds;
  bounds.found = pairs_met(options, survey, scene.radii(), tolerance);
  bounds.possible = pairs_met(options, survey, std::move(radii.larger), tolerance);
  bounds.sure = pairs_met(options, survey, std::move(radii.smaller), tolerance);
  std::erase_if(bounds.sure, [&](const std::pair<BeadId, BeadId>& pair) {
    return radii.has_a_ball[pair.first] == 0 || radii.has_a_ball[pair.second] == 0;
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
  const std::size_t stride = options.reading.frames.stride;
  std::optional<double> tolerance;
  if (options.tolerance) tolerance = options.tolerance->length(scene.radii());
  StrideCertificate certificate;
  certificate.deviation =
      deviation_of_stride(scene, *open_frames(options, 1), stride,
                          stride == 1 ? tolerance : std::nullopt);  // proved of all frames
  const auto& names = options.structures;
  if (std::find(names.begin(), names.end(), "contacts") != names.end())
    certificate.contacts = bound_contacts(options, scene, certificate.deviation, tolerance);
  return certificate;
}

}  // namespace kds
