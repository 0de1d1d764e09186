#pragma once
// Finds nodes of a wrapped hierarchy that a step can skip: their beads have moved from an earlier frame by
// less than their sphere's slack (sphere_slack), apart from the common drift. These nodes need no
// certificates. All slack refers to one reference frame, which is renewed when too much slack is used up. If
// motion is too fast, no slack is computed; a sample of nodes decides.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "motions/base/back_off.h"
#include "motions/base/bead.h"
#include "motions/curves/curves.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/moving_sphere/bead_paths.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

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
// sqrt(m) (Wedin), |P'| <= |P| / (1 - 2 |P| D sqrt(m)), in Frobenius norms. Each g_i but the first also
// changes by at most w, and the first by at most sqrt(m) w. While the weights are positive, the sphere is the
// minimum enclosing one, and its radius changes by at most t. The weights change by at most |g_i'| times the
// movement of the centre, which continues from t = 0, where all this holds. So while
//
//   3 t + |A| + |q| t  <=  rho - s_j - |d_j - z|     for all other balls j,
//   max |g_i'| (|A| + |q| t) < min w,  t < min T
//
// the basis stays and all other balls are inside. All bounds are linear in t. Computed in double, with the
// margins of sphere_chord.h for rounding.

/// Computes how far the balls of up to four nodes with bases of one size may move from the start of the step.
/// The results are lower bounds; a result of 0 or below means that nothing is proved. No result exceeds
/// `wanted`.
template <int Dimension>
void sphere_slack(const BeadPaths<Dimension>& paths, std::span<const BeadRange> nodes,
                  std::span<const Basis> bases, std::span<const double> wanted, std::span<double> slack);

template <int Dimension>
class NodeSlack {
 public:
  explicit NodeSlack(const NecklaceTree& tree);

  /// Removes from `nodes` the nodes that the step skips. Call it at the start of a step. `bases` are those
  /// of all nodes.
  void take_out_skipped(const BeadPaths<Dimension>& paths, std::span<const Basis> bases,
                        std::vector<NodeId>& nodes);
  /// Must be called when the node's basis changes.
  void forget(NodeId node) { slack_[node] = none; }

 private:
  static constexpr double none = -1;
  static constexpr std::size_t sample_size = 16;
  /// Least share of nodes that must be skipped. Finding slack costs nearly as much as it saves in one step. A
  /// reference must also last for another step.
  static constexpr double least_share = 0.7;
  /// A reference stays while this fraction of the share that was skipped at its frame is still skipped.
  static constexpr double still_worth = 0.72;
  /// Slack is limited to the distance that a node strays in this many steps.
  static constexpr double steps_ahead = 16;

  void set_reference(const BeadPaths<Dimension>& paths);
  /// Computes how far beads and nodes stray in the step from the reference.
  void look_at(const BeadPaths<Dimension>& paths);
  void forget_all();
  /// Stops for now because motion is too fast.
  void give_up();
  [[nodiscard]] bool is_skipped(NodeId node) const { return stray_[node] <= slack_[node]; }
  /// Returns the share of the given nodes that is skipped.
  [[nodiscard]] double share_skipped(std::span<const NodeId> nodes) const;
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
  std::vector<double> slack_;  ///< for each node, or `none`
  std::array<std::vector<double>, Dimension + 1> reference_;  ///< beads at the reference
  std::array<Waiting, Basis::max_size> waiting_;
  bool has_reference_ = false, lasted_ = false;
  double worth_keeping_ = 0;
  BackOff samples_{0, 31};
};

}  // namespace kds
