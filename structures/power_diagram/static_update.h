#pragma once
// Updates of a power diagram that use no time: rebuilding it, or taking beads out and inserting them again
// (diagram_update.h).

#include "motions/curves/snapshot.h"
#include "structures/power_diagram/diagram_update.h"
#include "structures/triangulation/snapshot_faults.h"

namespace kds {

/// Common part of the updates by CGAL. Hidden beads are the beads without a vertex.
template <int Dimension>
class StaticUpdate : public DiagramUpdate<Dimension> {
 public:
  void build(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;
  [[nodiscard]] StaticTriangulation<Dimension> diagram() const override;
  [[nodiscard]] std::optional<std::string> fault() const override;

 protected:
  void rebuild(const Eigen::Matrix3Xd& centers, std::span<const double> weights);
  void find_hidden();

  RegularTriangulation<Dimension> triangulation_;
  std::vector<BeadId> hidden_;  ///< ascending
  Snapshot<Dimension> frame_;   ///< the frame reached
  int affine_dimension_ = Dimension;
};

template <int Dimension>
class Rebuild final : public StaticUpdate<Dimension> {
 public:
  UpdateCounts advance(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;
};

/// Which bead of a failed certificate is taken out: any bead, or one with the most failed certificates.
enum class Choice : std::uint8_t { any, most_failed };

template <int Dimension>
class Reinsertion final : public StaticUpdate<Dimension> {
 public:
  explicit Reinsertion(Choice choice) : choice_(choice) {}
  UpdateCounts advance(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;

 private:
  [[nodiscard]] std::vector<BeadId> choose(const SnapshotFaults& faults) const;

  Choice choice_;
};

}  // namespace kds
