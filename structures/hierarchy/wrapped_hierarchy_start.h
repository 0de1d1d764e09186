#pragma once
// Kinetic wrapped hierarchy: the start of a step. Certificates of all nodes are looked at together, since
// four cost little more than one; nodes whose basis is not right any more come after that, one by one.

#include "structures/hierarchy/wrapped_hierarchy.h"

namespace kds {

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::list_guarded_nodes() {
  if constexpr (prunes && radii == Radii::any) paths_.find_apart_from_next(apart_from_next_);
  guarded_.resize(wide_.size() + pairs_.size());
  std::copy(wide_.begin(), wide_.end(), guarded_.begin());
  std::size_t count = wide_.size();
  for (const NodeId id : pairs_) {
    const BeadId first = tree_.range(id).first, last = first + 1;
    bool settled = nodes_[id].basis.size == 2;
    if constexpr (radii == Radii::equal) {
      const auto x = [this](BeadId b) {
        return prunes ? paths_.column(0, 0)[b] : motion_.coordinate(b, 0, 0);
      };
      settled &= x(first) != x(last);
    } else {
      settled &= prunes && apart_from_next_[first] != 0;
    }
    guarded_[count] = id;
    count += settled ? 0 : 1;
  }
  guarded_.resize(count);
}

/// Half of all nodes are pairs.
template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::sort_kept_nodes() {
  wide_.clear();
  pairs_.clear();
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    const BeadRange& range = tree_.range(id);
    if (keeps(id)) (range.last - range.first == 1 ? pairs_ : wide_).push_back(id);
  }
}

template <Motion M, Kernel K, Radii radii>
bool WrappedHierarchy<M, K, radii>::is_proper_at_start(const Basis& basis) const {
  std::array<std::array<double, dimension>, full> centers;
  std::array<double, full> own_radii;
  for (std::size_t i = 0; i < basis.size; ++i) {
    for (int axis = 0; axis < dimension; ++axis)
      centers[i][static_cast<std::size_t>(axis)] = motion_.coordinate(basis.beads[i], 0, axis);
    own_radii[i] = motion_.radius(basis.beads[i], 0);
  }
  return is_certainly_proper<dimension>(std::span(centers).first(basis.size),
                                        std::span(own_radii).first(basis.size));
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::watch_all_nodes() {
  amiss_.assign(nodes_.size(), BasisFault::no);
  watched_ends_.clear();
  all_watched_.clear();
  named_.clear();
  std::size_t begin = 0;
  for (const ChordCandidate& doubtful : doubtful_) {
    const NodeId id = doubtful.node;
    const Basis& basis = nodes_[id].basis;
    const SphereChord<dimension>& chord = doubtful.chord;
    beyond_.assign(all_beyond_.begin() + static_cast<std::ptrdiff_t>(begin),
                   all_beyond_.begin() + static_cast<std::ptrdiff_t>(doubtful.end));
    begin = doubtful.end;
    bool proper = radii == Radii::equal || (chord.proved && chord.stays == all_of(basis));
    if (!proper) {
      // Balls that are not independent need not have a sphere.
      proper = is_proper_at_start(basis);
    }
    if (!proper) {
      amiss_[id] = BasisFault::improper;
    } else if (is_one_bead(id)) {
      amiss_[id] = BasisFault::violated;
    } else if (!is_lone_pair(id)) {
      enqueue_basis(id, take_out_staying(id, &chord, {}));
      all_watched_.insert(all_watched_.end(), beyond_.begin(), beyond_.end());
    }
    watched_ends_.push_back(all_watched_.size());
  }
  const auto report = [this](NodeId id, BeadId) { amiss_[id] = BasisFault::violated; };
  watch_enqueued(false, report);
  begin = 0;
  for (std::size_t i = 0; i < doubtful_.size(); ++i) {
    const NodeId id = doubtful_[i].node;
    const auto beyond = std::span(all_watched_).subspan(begin, watched_ends_[i] - begin);
    begin = watched_ends_[i];
    if (beyond.empty() || amiss_[id] != BasisFault::no) continue;
    beyond_.assign(beyond.begin(), beyond.end());
    take_out_later(id);
    enqueue_beyond(id, beyond_);
  }
  watch_enqueued(true, report);
}

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::start_step() {
  if (query_) ask_query();
  for (const ChordCandidate& doubtful : doubtful_) {  // no others held any
    nodes_[doubtful.node].held = none;
    nodes_[doubtful.node].never_failing = 0;
  }
  held_.clear();
  free_.clear();
  if constexpr (prunes) {
    paths_.template set<radii == Radii::equal>(motion_);
    gap_roots_.forget();
    chord_cache_.forget();
  }
  list_guarded_nodes();
  if constexpr (prunes) {
    resting_.take_out_resting(paths_, guarded_,
                              [this](NodeId id) -> const Basis& { return nodes_[id].basis; });
  }
  find_doubtful_nodes();
  watch_all_nodes();
  std::vector<NamedBead>& named = named_at_start_;
  named.clear();
  for (const NamedBead& one : named_)
    if (amiss_[one.node] == BasisFault::no) named.push_back(one);
  std::vector<NodeId>& repaired = guarded_;  // in order, as changes are recorded
  repaired.clear();
  for (const ChordCandidate& doubtful : doubtful_)
    if (amiss_[doubtful.node] != BasisFault::no) repaired.push_back(doubtful.node);
  std::sort(repaired.begin(), repaired.end());
  for (const NodeId id : repaired) {
    const Basis before = nodes_[id].basis;
    drop_node(id);
    if (amiss_[id] == BasisFault::improper) static_cast<void>(repair(id, no_bead));
    guard_node(id, before);
    named.insert(named.end(), named_.begin(), named_.end());
  }
  count_per_bead(named);
}

/// How many certificates name a bead, the most of all beads.
template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::count_per_bead(std::span<const NamedBead> named) {
  per_bead_.resize(motion_.bead_count());  // all zero in between
  std::uint64_t& most = statistics.certificates.per_bead_max;
  for (const NamedBead& one : named) most = std::max<std::uint64_t>(most, ++per_bead_[one.bead]);
  for (const NamedBead& one : named) per_bead_[one.bead] = 0;
}

}  // namespace kds
