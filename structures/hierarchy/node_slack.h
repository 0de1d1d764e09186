#pragma once
// Computes how far the balls of a node may move from their positions before the node's basis can change. The
// bound stays valid, without certificates, for as many steps as the balls stay that near. For balls of any
// constant radii, in the plane and in space.
//
// All positions are relative to the basis' first ball: centres d_i and radii s_i of the others. Let z = sum
// w_i d_i be the centre and rho the radius, less the first ball's, of the sphere that touches all balls from
// outside, and T_i = rho - s_i. Let every ball move by at most t <= D. Relative to z' = sum w_i d_i', which
// keeps its weights, each centre moves by at most 2 (1 - w_i) t. The distance of each centre from z' is
// therefore T_i to within v = 2 (1 - min w) t.
//
// Twice the residuals of z' and rho are differences of two such squared distances less T_i^2, each up to v
// (2 T + v), where T is the largest T_i. Let g_i be the gradients of the barycentric coordinates, which sum
// to zero. The touching sphere is at z' + A + (rho' - rho) q, where
//
//   |A| <= K v (T + D),  K = 2 max |sum of some g_i|,  |q| <= sum |g_i s_i| < 1.
//
// The g_i are rows of a pseudo-inverse P. As the balls move, P changes by at most w = sqrt(2) |P| |P'| 2 D
// sqrt(m) (Wedin), |P'| <= |P| / (1 - 2 |P| D sqrt(m)), in Frobenius norms. So does each g_i but the first,
// which changes by at most sqrt(m) times that. While the weights are positive, the sphere is the minimum
// enclosing one, and its radius changes by at most t. The weights change by at most |g_i'| times the movement
// of the centre, which continues from t = 0, where all this holds. So while
//
//   3 t + |A| + |q| t  <=  rho - s_j - |d_j - z|     for all other balls j,
//   max |g_i'| (|A| + |q| t) < min w,  t < min T
//
// the basis stays and all other balls are inside. All bounds are linear in t. Computed in double, with the
// margins of sphere_chord.h for rounding.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "certificates/types/relaxed_membership.h"
#include "motions/base/back_off.h"
#include "motions/base/bead_range.h"
#include "motions/curves/curves.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/moving_sphere/bead_paths.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// Computes how far the balls of up to four nodes with bases of one size may move from the start of the step.
/// The results are lower bounds; a result of 0 or below means that nothing is proved. No result exceeds
/// `wanted`.
template <int Dimension>
void sphere_slack(const BeadPaths<Dimension>& paths, std::span<const BeadRange> nodes,
                  std::span<const Basis> bases, std::span<const double> wanted, std::span<double> slack);

// Finds nodes of a wrapped hierarchy that rest in a step: their beads have moved from an earlier frame by
// less than their sphere's slack (sphere_slack.h), apart from the common drift. These nodes need no
// certificates. All slack refers to one reference frame, which is renewed when too much slack is used up. If
// motion is too fast, no slack is computed; a sample of nodes decides. In a relaxed hierarchy, relaxation
// allows balls to be out by more (RelaxedAllowance).

/// Computes how far every ball of a necklace, of any radius, may be out of the sphere of a basis during a
/// whole step while its relaxed certificate (relaxed_membership.h) holds. Bounds of the sphere's path can
/// then prove the certificate.
///
/// Let |d| >= least and p >= p' for the distance and the sum of radii of the basis' two balls farthest apart,
/// let r be the largest radius of all balls, and let R' >= R. Suppose least >= r and p' >= r. Then all
/// certificates of unequal balls are relaxed. In their tau, |d|^2 + p^2 - 2 p r_j >= least^2 + p' (p' - 2 r)
/// =: q, since p^2 - 2 p r grows for p >= r. Let h = eps q / 2 / ((2 + eps) R'). As q <= 4 R^2, h <= eps R,
/// and (R - r_j + h)^2 - (R - r_j)^2 <= h (2 R + h) <= tau.
///
/// A ball that is out by h is therefore allowed. The certificate of equal radii allows it too: there q <=
/// |d|^2 <= 4 R_c^2, and h <= eps R_c. The radius is at most that of the centres' sphere, which is at most
/// sqrt(3/8) times their largest distance (Jung), plus the largest radius: this sum is R'.
class RelaxedAllowance {
 public:
  /// Without a relaxation nothing is allowed.
  explicit RelaxedAllowance(const Relaxation& relaxation) : share_(relaxation.share()) {}

  [[nodiscard]] bool any() const { return share_ > 0; }
  template <int Dimension>
  void start_step(const Curves<Dimension>& curves) {
    if (!any()) return;
    largest_ = 0;
    for (BeadId b = 0; b < curves.bead_count(); ++b)
      for (int k = 0; k <= curves.own_degree(); ++k) largest_ = std::max(largest_, curves.radius(b, k));
  }
  /// Returns zero if nothing is known.
  template <int Dimension>
  [[nodiscard]] double of(const Curves<Dimension>& curves, const Basis& basis) const {
    if (basis.size < 2) return 0;
    std::array<BeadId, Basis::max_size> beads = basis.beads;
    const auto ordered = std::span(beads).first(basis.size);
    detail::put_farthest_first(curves, ordered);
    const double least = detail::least_distance(curves, beads[0], beads[1]);
    double sum = HUGE_VAL, square = 0;
    for (int k = 0; k <= curves.own_degree(); ++k) {
      sum = std::min(sum, (curves.radius(beads[0], k) + curves.radius(beads[1], k)) * (1 - 0x1p-50));
      for (std::size_t i = 0; i < ordered.size(); ++i) {
        for (std::size_t j = i + 1; j < ordered.size(); ++j) {
          const auto d = detail::control_difference(curves, beads[i], beads[j], k);
          square = std::max(square, detail::product(d, d));
        }
      }
    }
    if (!(least >= largest_ && sum >= largest_)) return 0;
    const double room = least * least + sum * (sum - 2 * largest_);
    const double radius = 0.6124 * std::sqrt(square) + largest_;
    const double allowed = 0.5 * share_ * room / ((2 + share_) * radius) * (1 - 0x1p-30);
    return allowed > 0 && allowed < HUGE_VAL ? allowed : 0;
  }

 private:
  double share_;
  double largest_ = 0;  ///< largest radius in the step
};

template <int Dimension>
class NodeSlack {
 public:
  explicit NodeSlack(const NecklaceTree& tree);

  /// Removes from `nodes` the nodes that rest in the step. Call it at the start of a step. `bases` are those
  /// of all nodes.
  void take_out_resting(const BeadPaths<Dimension>& paths, std::span<const Basis> bases,
                        std::vector<NodeId>& nodes);
  /// Must be called when the node's basis changes.
  void forget(NodeId node) { slack_[node] = none; }

 private:
  static constexpr double none = -1;
  static constexpr std::size_t sample_size = 16;
  /// Least share of nodes that must rest. Finding slack costs nearly as much as it saves in one step. A
  /// reference must also last for another step.
  static constexpr double least_share = 0.7;
  /// A reference stays while this fraction of the share that rested at its frame still rests.
  static constexpr double still_worth = 0.72;
  /// Slack is limited to the distance that a node strays in this many steps.
  static constexpr double steps_ahead = 16;

  void set_reference(const BeadPaths<Dimension>& paths);
  /// Computes how far beads and nodes stray in the step from the reference.
  void look_at(const BeadPaths<Dimension>& paths);
  void forget_all();
  /// Stops for now because motion is too fast.
  void give_up();
  [[nodiscard]] bool rests(NodeId node) const { return stray_[node] <= slack_[node]; }
  /// Returns the share of the given nodes that rests.
  [[nodiscard]] double resting(std::span<const NodeId> nodes) const;
  void take_out(std::vector<NodeId>& nodes) const;

  void take_slack(const BeadPaths<Dimension>& paths, std::span<const Basis> bases,
                  std::span<const NodeId> nodes);

  /// Nodes with bases of one size.
  struct Waiting {
    static constexpr std::size_t at_once = 4;
    std::array<NodeId, at_once> nodes;
    std::array<BeadRange, at_once> ranges;
    std::array<Basis, at_once> bases;
    std::array<double, at_once> wanted;
    std::size_t count = 0;
  };
  void add(const BeadPaths<Dimension>& paths, NodeId node, const Basis& basis);
  void find(const BeadPaths<Dimension>& paths, Waiting& some);

  const NecklaceTree& tree_;
  /// Indices in stray_ of the two halves of each node.
  std::vector<std::array<std::uint32_t, 2>> halves_;
  std::vector<double> stray_;  ///< maximum over each node's beads; then each bead's
  std::vector<double> slack_;  ///< of each node, or `none`
  std::array<std::vector<double>, Dimension + 1> reference_;  ///< of beads at the reference
  std::array<Waiting, Basis::max_size> waiting_;
  bool has_reference_ = false, lasted_ = false;
  double worth_keeping_ = 0;
  BackOff samples_{0, 31};
};

}  // namespace kds
