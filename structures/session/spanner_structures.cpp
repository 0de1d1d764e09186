#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kds/stopwatch.h"
#include "structures/session/own_structures.h"
#include "structures/spanner/spanner.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

template <int D>
class SpannerInRun final : public RunningStructure {
 public:
  SpannerInRun(Simulator& simulator, const Scene& scene, const MotionRef<D>& motion, double stretch)
      : scene_(scene), spanner_(simulator, motion, stretch) {}

  [[nodiscard]] KineticStructure& kinetic() override { return spanner_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override {
    std::string edges = "i,j\n", centres = "bead,parent,level\n";
    for (const BeadPair& edge : spanner_.edges()) edges += fmt::format("{},{}\n", edge.first, edge.second);
    for (const auto& [bead, parent, level] : spanner_.centres()) {
      if (parent == no_bead)
        centres += fmt::format("{},,\n", bead);
      else
        centres += fmt::format("{},{},{}\n", bead, parent, level);
    }
    return {{"spanner.csv", std::move(edges)}, {"centres.csv", std::move(centres)}};
  }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    CombinatorialElements elements{2, {}};
    for (const BeadPair& edge : spanner_.edges()) elements.add({edge.first, edge.second});
    for (const auto& [bead, parent, level] : spanner_.centres())
      elements.add({bead, no_bead}, std::array{parent, level});
    return elements;
  }
  [[nodiscard]] ReplayScheme replay_scheme() const override {
    return {{{"edges", 2, 2}, {"centres", 3, 1}}, {}};
  }
  [[nodiscard]] std::vector<std::vector<ReplayElement>> replay_elements(bool) const override {
    std::vector<std::vector<ReplayElement>> layers(2);
    for (const BeadPair& edge : spanner_.edges())
      layers[0].push_back(replay_element({edge.first, edge.second}));
    for (const auto& [bead, parent, level] : spanner_.centres())
      layers[1].push_back(replay_element({bead, parent, level}));
    return layers;
  }
  [[nodiscard]] bool replay_edits(const Change& change, std::vector<ReplayEdit>& edits) const override {
    using Kind = typename Spanner<D>::Kind;
    const auto& ids = change.ids;
    if (change.kind == Kind::join || change.kind == Kind::part)
      edits.push_back({0, change.kind == Kind::join, replay_element({ids[0], ids[1]})});
    else if (change.kind == Kind::erases)
      edits.push_back({1, false, replay_element({ids[0]})});
    else if (change.kind != Kind::rescale && change.kind != Kind::changes)
      edits.push_back({1, true, replay_element({ids[0], ids[1], ids[2]})});
    return true;
  }
  /// The time of the Delaunay triangulation, another graph over the same points, without a
  /// stated stretch.
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    const std::vector<double> no_weights(scene_.bead_count(), 0);
    return seconds_per_call<WallClock>(triangulation_by_cgal<D>(scene_.centers(frame), no_weights));
  }

 private:
  const Scene& scene_;
  Spanner<D> spanner_;
};

}  // namespace

void add_spanner_structures(StructureRegistry& registry) {
  registry.add({.name = "spanner",
                .about = "graph of the beads with short paths, on a hierarchy of discrete centres",
                .net_changes = "edges, and centres with another parent or level",
                .order = 18,
                .refusal = [](const Scene& scene) -> std::optional<std::string> {
                  if (scene.dimension() < 2) return needs_plane_or_space(scene);
                  return std::nullopt;
                },
                .lacks_images = true,
                .make = make_of_motion<2>(
                    []<int D>(Simulator& simulator, const Scene& scene, const MotionRef<D>& motion,
                              const StructureSettings& settings) -> std::unique_ptr<RunningStructure> {
                      return std::make_unique<SpannerInRun<D>>(simulator, scene, motion, settings.stretch);
                    })});
}

}  // namespace kds
