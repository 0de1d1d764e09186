#include "structures/session/replay_recorder.h"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

#include "motions/base/floating_point_scope.h"
#include "motions/base/require_index.h"

namespace kds {

namespace {

/// Returns the first ids of the element, which are its place; the others are no_bead.
ReplayElement place_of(const ReplayLayer& layer, ReplayElement element) {
  std::fill(element.begin() + static_cast<std::ptrdiff_t>(layer.place_ids), element.end(), no_bead);
  return element;
}

/// Appends the ids of elements, which are sorted.
void append_ids(const ReplayLayer& layer, std::vector<ReplayElement> elements, std::vector<BeadId>& ids) {
  std::sort(elements.begin(), elements.end());
  for (const ReplayElement& element : elements)
    ids.insert(ids.end(), element.begin(), element.begin() + static_cast<std::ptrdiff_t>(layer.arity));
}

}  // namespace

ReplayRecorder::ReplayRecorder(KineticRun& run) : run_(run) {
  for (std::size_t s = 0; s < run.structures().size(); ++s) {
    const KineticStructure& kinetic = *run.structures()[s];
    ReplayScheme scheme = run.running(s).replay_scheme();
    Structure& structure = structures_.emplace_back();
    structure.name = kinetic.name();
    structure.kinds.assign(kinetic.kinds().begin(), kinetic.kinds().end());
    for (const ReplayLayer& layer : scheme.layers) structure.layers.push_back({layer, {}, {}, 0});
    structure.nodes = std::move(scheme.nodes);
    structure.sphere_nodes = std::move(scheme.sphere_nodes);
    now_.emplace_back(scheme.layers.size());
  }
}

void ReplayRecorder::begin() {
  const FloatingPointScope to_nearest;
  begun_ = true;
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    rebuilds_.push_back(run_.structures()[s]->statistics.rebuilds);
    const auto elements = run_.running(s).replay_elements(true);
    for (std::size_t l = 0; l < elements.size(); ++l) {
      Layer& layer = structures_[s].layers[l];
      for (const ReplayElement& element : elements[l])
        now_[s][l].emplace(place_of(layer.layer, element), element);
      append_ids(layer.layer, elements[l], layer.initial);
    }
    add_spheres(s, true);
  }
}

void ReplayRecorder::add_spheres(std::size_t structure, bool built) {
  if (structures_[structure].sphere_nodes.empty()) return;
  for (const Sphere& sphere : run_.running(structure).replay_spheres(built)) {
    std::array<float, 4>& numbers = structures_[structure].spheres.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis)
      numbers[axis] = static_cast<float>(sphere.center[static_cast<Eigen::Index>(axis)]);
    numbers[3] = static_cast<float>(sphere.radius);
  }
}

void ReplayRecorder::on_event(const Event& event) {
  if (!begun_) throw std::logic_error("a replay is recorded from the first frame on: call begin() first");
  const std::size_t s = event.structure_index;
  add_event(s, static_cast<std::uint32_t>(event.step), event.lower, event.upper, event.change.kind,
            event.decided_by, event.ids());
  edits_.clear();
  if (run_.running(s).replay_edits(event.change, edits_)) {
    if (!edits_.empty()) add_changes(s, changes_by(s, edits_));
  } else {
    add_changes(s, changes_to_now(s));
  }
}

void ReplayRecorder::reach_frame() {
  const FloatingPointScope to_nearest;
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    Structure& structure = structures_[s];
    const KineticStructure& kinetic = *run_.structures()[s];
    add_spheres(s, false);
    if (kinetic.statistics.rebuilds == rebuilds_[s]) continue;
    rebuilds_[s] = kinetic.statistics.rebuilds;
    const std::vector<LayerChange> changes = changes_to_now(s);
    if (std::all_of(changes.begin(), changes.end(),
                    [](const LayerChange& change) { return change.removed.empty() && change.added.empty(); }))
      continue;
    const std::size_t own_kinds = kinetic.kinds().size();
    if (structure.kinds.size() == own_kinds) structure.kinds.push_back(rebuilt_at_frame);
    const std::size_t step = run_.simulator().step() - 1;
    add_event(s, static_cast<std::uint32_t>(step), 1, 1, static_cast<std::uint8_t>(own_kinds),
              DecidedBy::unknown, {});
    add_changes(s, changes);
  }
}

std::vector<ReplayElement> ReplayRecorder::elements(std::size_t structure, std::size_t layer) const {
  require_index("structure", structure, now_.size());
  require_index("layer", layer, now_[structure].size());
  std::vector<ReplayElement> elements;
  for (const auto& [place, element] : now_[structure][layer]) elements.push_back(element);
  std::sort(elements.begin(), elements.end());
  return elements;
}

void ReplayRecorder::add_event(std::size_t structure, std::uint32_t step, double lower, double upper,
                               std::uint8_t kind, DecidedBy stage, std::span<const BeadId> ids) {
  Events& events = structures_[structure].events;
  events.order.push_back(order_++);
  events.step.push_back(step);
  events.lower.push_back(lower);
  events.upper.push_back(upper);
  events.kind.push_back(kind);
  events.stage.push_back(stage);
  events.size.push_back(static_cast<std::uint8_t>(ids.size()));
  events.ids.insert(events.ids.end(), ids.begin(), ids.end());
}

auto ReplayRecorder::changes_to_now(std::size_t structure) -> std::vector<LayerChange> {
  std::vector<LayerChange> changes(now_[structure].size());
  const auto elements = run_.running(structure).replay_elements(false);
  for (std::size_t l = 0; l < elements.size(); ++l) {
    const ReplayLayer& layer = structures_[structure].layers[l].layer;
    Elements& before = now_[structure][l];
    Elements after;
    for (const ReplayElement& element : elements[l]) {
      const ReplayElement place = place_of(layer, element);
      after.emplace(place, element);
      const auto old = before.find(place);
      if (old == before.end() || old->second != element) changes[l].added.push_back(element);
    }
    for (const auto& [place, element] : before) {
      const auto kept = after.find(place);
      if (kept == after.end() || kept->second != element) changes[l].removed.push_back(element);
    }
    before = std::move(after);
  }
  return changes;
}

auto ReplayRecorder::changes_by(std::size_t structure, const std::vector<ReplayEdit>& edits)
    -> std::vector<LayerChange> {
  std::vector<LayerChange> changes(now_[structure].size());
  for (const ReplayEdit& edit : edits) {
    const ReplayLayer& layer = structures_[structure].layers[edit.layer].layer;
    Elements& now = now_[structure][edit.layer];
    const ReplayElement place = place_of(layer, edit.element);
    const auto old = now.find(place);
    const bool is_known = old != now.end();
    if (edit.adds ? is_known && old->second == edit.element : !is_known)
      throw std::logic_error("replay: an event of " + structures_[structure].name +
                             (edit.adds ? " adds what is there already" : " removes what is not there"));
    if (is_known) {
      changes[edit.layer].removed.push_back(old->second);
      now.erase(old);
    }
    if (edit.adds) {
      changes[edit.layer].added.push_back(edit.element);
      now.emplace(place, edit.element);
    }
  }
  return changes;
}

void ReplayRecorder::add_changes(std::size_t structure, const std::vector<LayerChange>& changes) {
  const auto event = static_cast<std::uint32_t>(structures_[structure].events.count() - 1);
  for (std::size_t l = 0; l < changes.size(); ++l) {
    const LayerChange& change = changes[l];
    if (change.removed.empty() && change.added.empty()) continue;
    Layer& layer = structures_[structure].layers[l];
    ++layer.change_count;
    layer.changes.insert(layer.changes.end(), {event, static_cast<std::uint32_t>(change.removed.size()),
                                               static_cast<std::uint32_t>(change.added.size())});
    append_ids(layer.layer, change.removed, layer.changes);
    append_ids(layer.layer, change.added, layer.changes);
  }
}

}  // namespace kds
