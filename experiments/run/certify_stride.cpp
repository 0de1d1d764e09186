#include "experiments/run/certify_stride.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "experiments/program/input_options.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/run_scene.h"
#include "motions/base/input_error.h"
#include "motions/scene/straightened_frames.h"
#include "structures/contacts/contact_distance.h"

namespace kds {

namespace {

// The end of a step equals the start of the next step.
MetContacts::Moment moment_of(const Event& event, double u) {
  return u < 1 ? MetContacts::Moment{event.step, u} : MetContacts::Moment{event.step + 1, 0};
}

}  // namespace

void MetContacts::on_event(const Event& event) {
  if (event.kind.counted_apart) return;
  const Pair pair{event.ids()[0], event.ids()[1]};
  if (event.kind.name != "end") {
    events_.push_back({event, contacts_.size()});
    contacts_.push_back({pair, moment_of(event, event.lower)});
    if (event.kind.name == "begin") open_[pair] = contacts_.size() - 1;
    if (event.kind.name == "touch") contacts_.back().latest = moment_of(event, event.upper);
    return;
  }
  const auto begun = open_.find(pair);
  if (begun == open_.end()) throw std::logic_error("a contact ends that has not begun");
  events_.push_back({event, begun->second});
  contacts_[begun->second].latest = moment_of(event, event.upper);
  open_.erase(begun);
}

std::vector<std::uint8_t> holding(std::span<const MetContacts::Contact> contacts,
                                  std::span<const MetContacts::Contact> within) {
  std::map<MetContacts::Pair, std::vector<std::size_t>> of_pair;
  for (std::size_t k = 0; k < contacts.size(); ++k) of_pair[contacts[k].pair].push_back(k);
  std::vector<std::uint8_t> holds(contacts.size(), 0);
  for (const MetContacts::Contact& inner : within) {
    const auto same = of_pair.find(inner.pair);
    if (same == of_pair.end()) continue;
    std::vector<std::size_t> may_hold;
    for (const std::size_t k : same->second)
      if (contacts[k].earliest <= inner.latest && contacts[k].latest >= inner.earliest) may_hold.push_back(k);
    if (may_hold.size() == 1) holds[may_hold.front()] = 1;
  }
  return holds;
}

namespace {

std::unique_ptr<FrameSource> frames_of(const RunOptions& options, std::size_t stride) {
  InputOptions input = options;
  input.reading.frames.stride = stride;
  return open_frames(input, [](const std::string&) {});
}

/// Returns all contacts of the run with these radii.
std::shared_ptr<const MetContacts> contacts_met(const RunOptions& options, const FrameSurvey& survey,
                                                std::vector<double> radii,
                                                const std::optional<double>& tolerance) {
  auto frames = frames_of(options, options.reading.frames.stride);
  if (tolerance) frames = std::make_unique<StraightenedFrames>(std::move(frames), *tolerance);
  const Scene scene(std::move(frames), survey, std::move(radii), options.motion);
  RunOptions contacts;
  contacts.structures = {"contacts"};
  contacts.kernel = options.kernel;
  contacts.apart = options.apart;
  const auto run = open_run(contacts, scene, AuditMode::none);
  auto met = std::make_shared<MetContacts>();
  run->listen(*met);
  run_steps(*run, contacts, [&](std::size_t frame) {
    if (frame != 0) return;
    for (const Event& event : run->built(0)) met->on_event(event);
  });
  return met;
}

using ContactSpan = std::span<const MetContacts::Contact>;

PairsMet pairs_of(ContactSpan contacts) {
  PairsMet pairs;
  for (const MetContacts::Contact& contact : contacts) pairs.insert(contact.pair);
  return pairs;
}

void bound_contacts(const RunOptions& options, const Scene& scene, const std::optional<double>& tolerance,
                    StrideCertificate& certificate) {
  const FrameSurvey survey = survey_frames(*frames_of(options, options.reading.frames.stride), false);
  const auto distance = options.distances.first();
  const std::vector<double> own = distance ? contact_radii(*distance, scene.radii()) : scene.radii();
  RadiiWithin radii = certified_radii(certificate.deviation, own);
  const auto found = contacts_met(options, survey, own, tolerance);
  const auto possible = contacts_met(options, survey, std::move(radii.larger), tolerance);
  const auto smaller = contacts_met(options, survey, std::move(radii.smaller), tolerance);
  std::vector<MetContacts::Contact> sure(smaller->contacts().begin(), smaller->contacts().end());
  std::erase_if(sure, [&](const MetContacts::Contact& contact) {
    return radii.has_a_ball[contact.pair.first] == 0 || radii.has_a_ball[contact.pair.second] == 0;
  });
  certificate.contacts = {pairs_of(found->contacts()), pairs_of(sure), pairs_of(possible->contacts())};
  certificate.listed = {{found, holding(found->contacts(), sure)},
                        {possible, holding(possible->contacts(), found->contacts())}};
}

}  // namespace

RadiiWithin certified_radii(const StrideDeviation& deviation, std::span<const double> radii) {
  try {
    return radii_within(deviation, radii);
  } catch (const InputError& error) {
    throw InputError("--certify", error.what());
  }
}

void refuse_needless_certificate(const InputOptions& input, std::string_view otherwise) {
  if (input.reading.frames.stride == 1)
    throw InputError("--certify",
                     fmt::format("the run leaves out no frame; expected {} above 1{}",
                                 words("--frames FIRST:LAST:STRIDE with a stride", "step"), otherwise));
}

StrideCertificate certify_stride(const RunOptions& options, const Scene& scene) {
  const std::size_t stride = options.reading.frames.stride;
  std::optional<double> tolerance;
  if (options.tolerance) tolerance = options.tolerance->length(scene.radii());
  StrideCertificate certificate;
  certificate.deviation =
      deviation_of_stride(scene, *frames_of(options, 1), stride,
                          stride == 1 ? tolerance : std::nullopt);  // the tolerance is proved for all frames
  const auto& names = options.structures;
  if (std::find(names.begin(), names.end(), "contacts") != names.end())
    bound_contacts(options, scene, tolerance, certificate);
  return certificate;
}

}  // namespace kds
