#include "structures/hierarchy/wrapped_hierarchy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "motions/base/floating_point_scope.h"
#include "motions/base/require_index.h"
#include "motions/curves/positions.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "structures/enclosing_sphere/integer_balls.h"
#include "structures/hierarchy/node_certificates.h"
#include "structures/hierarchy/node_proofs.h"
#include "structures/hierarchy/signs_just_after.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

namespace {

template <int Dimension>
[[nodiscard]] const MotionRef<Dimension>& accepted(const MotionRef<Dimension>& motion) {
  if (motion.is_lifted()) throw std::invalid_argument("radii mean nothing in lifted motion");
  return motion;
}

template <int Dimension>
[[nodiscard]] Balls<Dimension> balls_at_start(const Curves<Dimension>& curves) {
  return Balls<Dimension>(control_points(curves, 0), control_radii(curves, 0));
}

[[nodiscard]] std::span<const BeadId> beads_of(const Basis& basis) { return {basis.begin(), basis.end()}; }

/// Returns the distance from a point to the farthest point of a ball, rounded up.
template <int Dimension>
[[nodiscard]] double reach_of(const Balls<Dimension>& balls, BeadId bead, const Eigen::Vector3d& from) {
  double square = 0;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    const double d = balls.coordinate(bead, axis) - from[static_cast<Eigen::Index>(axis)];
    square += d * d;
  }
  return (std::sqrt(square) + balls.radius(bead)) * (1 + 0x1p-48);
}

/// Finds the beads of a range that may touch its smallest sphere. The others are strictly inside, and stay
/// so for a while.
///
/// Let c and R be the exact centre and radius, z the rounded centre, and M the farthest reach of a basis
/// bead from z. Seen from c, some basis bead p of radius r lies at an angle of at least 90 degrees to z. So
/// |p - z|^2 >= (R - r)^2 + |c - z|^2, and |c - z|^2 <= (M - r)^2 - (R - r)^2 <= (M - R)(M + R). R is known
/// to 1e-12 (enclosing_sphere.h).
template <int Dimension>
void find_touching(const Balls<Dimension>& balls, const BeadRange& range, const SmallestSphere& smallest,
                   std::vector<BeadId>& touching) {
  touching.clear();
  const Eigen::Vector3d& center = smallest.sphere.center;
  const double least_radius = smallest.sphere.radius * (1 - 0x1p-39);
  double most = least_radius;
  for (const BeadId b : smallest.basis) most = std::max(most, reach_of(balls, b, center));
  const double off = std::sqrt((most - least_radius) * (most + least_radius)) * (1 + 0x1p-48);
  const bool is_normal = least_radius > 0x1p-400;  // squares do not underflow
  for (BeadId b = range.first; b <= range.last; ++b)
    if (!is_normal || !(reach_of(balls, b, center) + off < least_radius)) touching.push_back(b);
}

}  // namespace

template <int Dimension>
WrappedHierarchy<Dimension>::WrappedHierarchy(Simulator& simulator, const MotionRef<Dimension>& motion,
                                              std::span<const BeadRange> necklaces, Radii radii,
                                              const NodeSelection& selection)
    : simulator_(simulator),
      motion_(accepted(motion)),
      radii_(radii),
      tree_(necklaces),
      bases_(tree_.node_count()),
      kept_(select_nodes(tree_, selection)),
      index_(simulator.add(*this)),
      proofs_(std::make_unique<NodeProofs<Dimension>>(simulator, tree_, curves_, motion.degree(), radii)),
      certificates_(std::make_unique<NodeCertificates<Dimension>>(simulator, *this, index_, motion, curves_,
                                                                  radii, tree_.node_count(), *proofs_)),
      repair_(std::make_unique<BasisRepair<Dimension>>(radii, *proofs_, certificates_->signs())) {
  sort_kept_nodes();
}

template <int Dimension>
WrappedHierarchy<Dimension>::~WrappedHierarchy() = default;

template <int Dimension>
std::span<const EventKind> WrappedHierarchy<Dimension>::kinds() const {
  static constexpr std::array<IdRole, 2> roles{{{"node", 2, IdRole::Of::node}, {"basis", 0}}};
  static constexpr std::array<IdRole, 1> bead{{{"bead"}}};
  static constexpr std::array<EventKind, 4> kinds{{{"enter", true, false, roles},
                                                   {"leave", true, false, roles},
                                                   {"pivot", true, false, roles},
                                                   {"change", false, true, bead}}};
  return kinds;
}

template <int Dimension>
void WrappedHierarchy<Dimension>::keep_what_is_asked_for(NodeQuery query) {
  query_ = std::move(query);
}

template <int Dimension>
bool WrappedHierarchy<Dimension>::keeps(NodeId node) const {
  require_index("node", node, kept_.size());
  return kept_[node] != 0;
}

template <int Dimension>
const Basis& WrappedHierarchy<Dimension>::basis(NodeId node) const {
  require_index("node", node, bases_.size());
  return bases_[node];
}

template <int Dimension>
bool WrappedHierarchy<Dimension>::move_together(BeadId a, BeadId b) const {
  for (int k = 0; k <= curves_.own_degree(); ++k) {
    for (int axis = 0; axis < Dimension; ++axis) {
      if (curves_.coordinate(a, k, axis) != curves_.coordinate(b, k, axis)) return false;
    }
  }
  return true;
}

template <int Dimension>
bool WrappedHierarchy<Dimension>::is_lone_pair(NodeId id) const {
  const BeadRange& range = tree_.range(id);
  return radii_ == Radii::equal && bases_[id].size == 2 && range.last - range.first == 1;
}

template <int Dimension>
bool WrappedHierarchy<Dimension>::is_one_bead(NodeId id) const {
  const Basis& basis = bases_[id];
  return radii_ == Radii::equal && basis.size == 2 && move_together(basis.beads[0], basis.beads[1]);
}

template <int Dimension>
std::string WrappedHierarchy<Dimension>::name_of(NodeId id) const {
  const BeadRange& range = tree_.range(id);
  return "node " + std::to_string(range.first) + "-" + std::to_string(range.last);
}

// Bases at the start of a run, and queries.

template <int Dimension>
SmallestSphere WrappedHierarchy<Dimension>::build_node(NodeId id, const Balls<Dimension>& balls) {
  const BeadRange range = tree_.range(id);
  std::vector<BeadId> guess{range.first, range.last};
  for (const NodeId child : {tree_.left(id), tree_.right(id)}) {
    if (child != NecklaceTree::leaf) guess.insert(guess.end(), bases_[child].begin(), bases_[child].end());
  }
  const SmallestSphere smallest = smallest_sphere(balls, range.first, range.last, guess);
  bases_[id] = smallest.basis;
  proofs_->forget(id);
  return smallest;
}

template <int Dimension>
void WrappedHierarchy<Dimension>::build() {
  curves_ = motion_.curves();
  proofs_->take_curves();
  if (query_) kept_.assign(bases_.size(), 0);  // the query has not run yet
  const Balls<Dimension> balls = balls_at_start(curves_);
  SignsJustAfter<Dimension>& signs = certificates_->signs();
  std::vector<BeadId> touching;
  for (auto id = static_cast<NodeId>(bases_.size()); id-- > 0;) {  // children first
    if (!keeps(id)) continue;
    find_touching(balls, tree_.range(id), build_node(id, balls), touching);
    // Settled for the moment just after the start, when beads on the sphere may leave it.
    bool settled = false;
    while (!settled) {
      settled = true;
      const int orientation = orientation_of(bases_[id], signs);
      for (const BeadId b : touching) {
        if (bases_[id].contains(b) || is_inside(bases_[id], b, orientation, signs)) continue;
        settled = !repair(id, b);
        break;
      }
    }
  }
}

template <int Dimension>
void WrappedHierarchy<Dimension>::ask_query() {
  const Balls<Dimension> balls = balls_at_start(curves_);
  const std::vector<std::uint8_t> known = std::exchange(kept_, std::vector<std::uint8_t>(bases_.size(), 0));
  query_([&](NodeId id) {
    require_index("node", id, bases_.size());
    if (kept_[id] == 0 && known[id] == 0) static_cast<void>(build_node(id, balls));
    kept_[id] = 1;
    return exact_sphere_of(bases_[id], balls);
  });
  sort_kept_nodes();
}

/// Pairs have a list of their own because they are half of all nodes.
template <int Dimension>
void WrappedHierarchy<Dimension>::sort_kept_nodes() {
  wide_.clear();
  pairs_.clear();
  for (NodeId id = 0; id < bases_.size(); ++id) {
    const BeadRange& range = tree_.range(id);
    if (keeps(id)) (range.last - range.first == 1 ? pairs_ : wide_).push_back(id);
  }
}

// The start of a step. Certificates of all nodes are watched together, because four cost little more than
// one. Nodes whose basis is no longer right follow, one by one.

template <int Dimension>
void WrappedHierarchy<Dimension>::start_step() {
  curves_ = motion_.curves();
  if (query_) ask_query();
  certificates_->start_step();
  proofs_->take_curves();
  to_certify_ = wide_;
  proofs_->add_unsettled(pairs_, bases_, to_certify_);
  proofs_->take_out_skipped(bases_, to_certify_);
  proofs_->find_candidates(to_certify_, bases_);
  watch_all_nodes();
  repair_faults();
}

template <int Dimension>
void WrappedHierarchy<Dimension>::watch_all_nodes() {
  faults_.assign(bases_.size(), BasisFault::no);
  watched_ends_.clear();
  all_watched_.clear();
  const std::span<const BeadId> all_beyond = proofs_->beyond();
  std::size_t begin = 0;
  for (const ChordCandidate<Dimension>& candidate : proofs_->candidates()) {
    const NodeId id = candidate.node;
    const Basis& basis = bases_[id];
    const SphereChord<Dimension>& chord = candidate.chord;
    const auto beyond = all_beyond.subspan(begin, candidate.end - begin);
    beyond_.assign(beyond.begin(), beyond.end());
    begin = candidate.end;
    // Balls that are not independent need not have a sphere.
    const bool proper = radii_ == Radii::equal || (chord.proved && chord.stays == (1U << basis.size) - 1U) ||
                        proofs_->is_proper_at_start(basis);
    if (!proper) {
      faults_[id] = BasisFault::improper;
    } else if (is_one_bead(id)) {
      faults_[id] = BasisFault::violated;
    } else if (!is_lone_pair(id)) {
      certificates_->enqueue_basis(id, basis,
                                   proofs_->take_out_staying(basis, tree_.range(id), chord, beyond_));
      all_watched_.insert(all_watched_.end(), beyond_.begin(), beyond_.end());
    }
    watched_ends_.push_back(all_watched_.size());
  }
  for (const NamedBead& violated : certificates_->watch_enqueued(false))
    faults_[violated.node] = BasisFault::violated;
  begin = 0;
  for (std::size_t i = 0; i < watched_ends_.size(); ++i) {
    const NodeId id = proofs_->candidates()[i].node;
    const auto beyond = std::span(all_watched_).subspan(begin, watched_ends_[i] - begin);
    begin = watched_ends_[i];
    if (beyond.empty() || faults_[id] != BasisFault::no) continue;
    beyond_.assign(beyond.begin(), beyond.end());
    enqueue_beyond(id);
  }
  for (const NamedBead& violated : certificates_->watch_enqueued(true))
    faults_[violated.node] = BasisFault::violated;
}

template <int Dimension>
void WrappedHierarchy<Dimension>::repair_faults() {
  certificates_->forget_named_if([this](NodeId id) { return faults_[id] != BasisFault::no; });
  std::vector<NodeId>& repaired = to_certify_;  // in order, as changes are recorded
  repaired.clear();
  for (const ChordCandidate<Dimension>& candidate : proofs_->candidates())
    if (faults_[candidate.node] != BasisFault::no) repaired.push_back(candidate.node);
  std::sort(repaired.begin(), repaired.end());
  for (const NodeId id : repaired) {
    const Basis before = bases_[id];
    certificates_->drop(id);
    if (faults_[id] == BasisFault::improper) static_cast<void>(repair(id, no_bead));
    certify_node(id, before, no_bead);
  }
  certificates_->count_per_bead();
}

template <int Dimension>
void WrappedHierarchy<Dimension>::follow_certificates() {
  certificates_->follow_names();
}

template <int Dimension>
void WrappedHierarchy<Dimension>::count_certificates() {
  certificates_->count_followed();
}

// Single nodes at any time.

template <int Dimension>
void WrappedHierarchy<Dimension>::enqueue_beyond(NodeId id) {
  if (proofs_->worth_another_look(beyond_.size()) && certificates_->holds_any(id))
    proofs_->take_out_until(certificates_->certified_until(id), bases_[id], beyond_);
  certificates_->enqueue_beyond(id, bases_[id], beyond_);
}

template <int Dimension>
std::optional<BeadId> WrappedHierarchy<Dimension>::watch_node(NodeId id, BeadId risen) {
  certificates_->forget_named_of(id);
  if (is_one_bead(id)) return bases_[id].beads[1];
  if (is_lone_pair(id)) return std::nullopt;
  // Basis beads come first: if one leaves, or is superfluous all the time so that its function is zero, the
  // other certificates mean nothing.
  const unsigned stays = proofs_->find_beads_to_watch(bases_[id], tree_.range(id), risen, beyond_);
  certificates_->enqueue_basis(id, bases_[id], stays);
  if (const auto to_spare = certificates_->watch_enqueued_of_one(false)) return to_spare;
  enqueue_beyond(id);
  return certificates_->watch_enqueued_of_one(true);
}

template <int Dimension>
void WrappedHierarchy<Dimension>::certify_node(NodeId id, Basis before, BeadId risen) {
  while (const std::optional<BeadId> violated = watch_node(id, risen)) {
    certificates_->drop(id);
    risen = no_bead;
    if (!repair(id, *violated))
      throw std::logic_error(name_of(id) + ": a basis is violated and right at once, at bead " +
                             std::to_string(*violated));
  }
  if (!(bases_[id] == before)) record(id, before);
}

template <int Dimension>
bool WrappedHierarchy<Dimension>::repair(NodeId id, BeadId bead, bool failed) {
  proofs_->forget(id);
  const Basis next = repair_->next_basis(bases_[id], bead, failed);
  if (next == bases_[id]) return false;
  bases_[id] = next;
  return true;
}

template <int Dimension>
void WrappedHierarchy<Dimension>::fail(unsigned table, std::uint32_t slot) {
  const auto [id, bead, touches] = certificates_->take_failed(table, slot, bases_);
  const Basis before = bases_[id];
  BeadId risen = no_bead;
  if (!touches) {
    static_cast<void>(repair(id, bead, true));
    risen = proofs_->risen_bead(before, bases_[id], bead);
  } else if (radii_ == Radii::any) {
    // The simplex of a full basis may turn over without losing a bead: when all beads meet, or when each
    // touches the sphere of the others. The basis then stays, and its certificates, which turn too, are made
    // anew.
    static_cast<void>(repair(id, no_bead));
  }
  certify_node(id, before, risen);
  certificates_->forget_failure();
}

template <int Dimension>
void WrappedHierarchy<Dimension>::record(NodeId id, const Basis& before) {
  const Basis& after = bases_[id];
  const auto misses = [](const Basis& basis, const Basis& of) {
    bool any = false;
    for (const BeadId b : of) any |= !basis.contains(b);
    return any;
  };
  const bool entered = misses(before, after);
  const bool left = misses(after, before);
  Change change{entered && left ? pivot
                : entered       ? enter
                                : leave,
                static_cast<std::uint8_t>(2 + after.size),
                {tree_.range(id).first, tree_.range(id).last}};
  std::copy(after.begin(), after.end(), change.ids.begin() + 2);
  simulator_.record(index_, change);
}

// Changes of course.

template <int Dimension>
void WrappedHierarchy<Dimension>::require_release(std::span<const BeadId> beads) const {
  for (const BeadId bead : beads) require_index("bead", bead, motion_.bead_count());
}

template <int Dimension>
void WrappedHierarchy<Dimension>::release(std::span<const BeadId> beads) {
  std::vector<BeadId> sorted(beads.begin(), beads.end());
  std::sort(sorted.begin(), sorted.end());
  released_.clear();
  for (NodeId id = 0; id < bases_.size(); ++id) {
    const BeadRange& range = tree_.range(id);
    const auto first = std::lower_bound(sorted.begin(), sorted.end(), range.first);
    if (!keeps(id) || first == sorted.end() || *first > range.last) continue;
    certificates_->drop(id);
    proofs_->forget(id);
    released_.push_back(id);
  }
  certificates_->forget_named_if(
      [this](NodeId id) { return std::binary_search(released_.begin(), released_.end(), id); });
}

/// A released bead may be anywhere, so the old basis says nothing about the new one.
template <int Dimension>
void WrappedHierarchy<Dimension>::take_up(std::span<const BeadId> beads) {
  for (const BeadId bead : beads) simulator_.record(index_, Change{changes, 1, {bead}});
  curves_ = motion_.curves();
  proofs_->take_curves();
  for (const NodeId id : released_) {
    const Basis before = bases_[id];
    static_cast<void>(repair(id, no_bead));
    certify_node(id, before, no_bead);
  }
  certificates_->count_per_bead();
}

// Replay of changes, and audits of bases by their definition.

template <int Dimension>
void WrappedHierarchy<Dimension>::apply(const Change& change) {
  if (change.kind == changes) {
    if (change.size != 1) throw std::invalid_argument("a change of course is of one bead");
    return require_release({change.ids.data(), 1});
  }
  if (change.size < 3 || change.size > 2 + full)
    throw std::invalid_argument("a basis has one to " + std::to_string(full) + " beads");
  const auto node = tree_.find({change.ids[0], change.ids[1]});
  if (!node) throw std::invalid_argument("the hierarchy has no such node");
  if (!keeps(*node)) throw std::invalid_argument("the hierarchy does not keep this node");
  const Basis basis(std::span(change.ids).subspan(2, change.size - 2U));
  for (const BeadId b : basis) {
    if (b < change.ids[0] || b > change.ids[1])
      throw std::invalid_argument("a basis bead is not of its node");
  }
  if (std::adjacent_find(basis.begin(), basis.end()) != basis.end())
    throw std::invalid_argument("a basis bead stands twice");
  bases_[*node] = basis;
  proofs_->forget(*node);
}

template <int Dimension>
std::vector<Basis> WrappedHierarchy<Dimension>::bases_at(const Dyadic& time) const {
  const FloatingPointScope to_nearest;
  const IntegerBalls<Dimension> whole = integer_balls_at(motion_.curves(), time);
  std::vector<Basis> bases(bases_.size());
  for (NodeId id = 0; id < bases_.size(); ++id) {
    if (keeps(id)) bases[id] = proper_part(bases_[id], whole);
  }
  return bases;
}

/// If the sphere of a basis encloses all beads and no basis bead is superfluous, it is the unique minimum
/// enclosing sphere. Checking both conditions is therefore as good as building the sphere. Doubles with error
/// bounds prove most nodes; integers decide the rest. No certificate is used.
template <int Dimension>
std::optional<std::string> WrappedHierarchy<Dimension>::audit(const Dyadic& time) {
  const FloatingPointScope to_nearest;
  const RoundedPositions<Dimension> rounded(motion_, time);
  std::optional<IntegerBalls<Dimension>> whole;
  for (NodeId id = 0; id < bases_.size(); ++id) {
    if (!keeps(id)) continue;
    if (is_surely_basis_of(bases_[id], tree_.range(id), rounded)) continue;
    if (!whole) whole = integer_balls_at(motion_.curves(), time);
    if (const auto bead = bead_outside(proper_part(bases_[id], *whole), tree_.range(id), *whole)) {
      return name_of(id) + " with basis " + bead_names(beads_of(bases_[id])) + ": bead " +
             std::to_string(*bead) + " sticks out";
    }
  }
  return std::nullopt;
}

template class WrappedHierarchy<2>;
template class WrappedHierarchy<3>;

}  // namespace kds
