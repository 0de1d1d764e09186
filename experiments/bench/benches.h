#pragma once
// The subjects of `kds bench`, each measured beside a peer in the same process.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/bench/bench_chains.h"
#include "experiments/bench/bench_report.h"
#include "motions/scene/scene.h"
#include "structures/session/structure_spec.h"

namespace kds {

/// Processor seconds and events of all steps.
struct StepsRun {
  double seconds = 0;  ///< including the construction of motions from frames
  double own = 0;      ///< `seconds` minus the time to load the same steps again: engine and structure alone
  std::uint64_t events = 0;
};

[[nodiscard]] Scene scene_of(const BenchChain& chain, FrameMotion motion);
/// Runs all steps of a scene with one structure. The build at the first frame is not timed.
[[nodiscard]] StepsRun run_all_steps(const Scene& scene, const std::string& structure,
                                     const StructureSettings& settings);

inline constexpr std::string_view sphere_peer = "CGAL Min_sphere_of_spheres_d";

/// Adds rows for linear motion. `factor`, if given, is the goal: how many times as fast as the peer a step
/// should be. A step includes the construction of its motion from the frames.
void bench_kinetic_steps(const BenchChain& chain, std::size_t rounds, std::optional<double> factor,
                         std::vector<BenchRow>& rows);

/// Adds rows for linear and for Hermite motion.
void bench_kinetic_events(const BenchChain& chain, std::vector<BenchRow>& rows);

// `kds bench hierarchies`. Measures wrapped and layered hierarchies that are built, updated from frame to
// frame, and updated kinetically. Their peer is CGAL's Min_sphere_of_spheres_d at every node. Also compares
// the number of events with the net change.

struct HierarchyBenchOptions {
  std::vector<std::size_t> sizes{640, 10240, 102400};  ///< numbers of beads of generated chains
  std::vector<std::filesystem::path> trajectories;     ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;                              ///< at least; more if rounds are short
};

[[nodiscard]] std::vector<BenchRow> bench_hierarchies(
    const HierarchyBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

// The rows of `kds bench collision` about contacts. They compare the computation of all begin and end times
// with a cell list that examines only frames.

/// Measures consecutive frames; both methods start from the positions that were read. Radii are
/// `radius_factor` times the chain's. Pairs are at least 5 beads apart along the chain.
void bench_contacts(const BenchChain& chain, double radius_factor, std::optional<double> goal,
                    std::size_t rounds, std::vector<BenchRow>& rows);

/// Compares the time per bead with the time per bead for ten times as many beads. The time covers the build
/// at a frame and the steps to the next two frames.
void bench_contacts_growth(std::string_view model, std::size_t beads, std::optional<double> goal,
                           std::size_t rounds, std::vector<BenchRow>& rows);

// `kds bench collision`. Measures the detector of kds beside the common alternatives in one process: a cell
// list on single scenes, a Verlet list from frame to frame, and the trees of FCL and Bullet if this program
// was built with them. All frames are distinct, and the detectors see the same frames in turn. Also measures
// the computation of the times at which contacts begin and end beside the cell list.

struct CollisionBenchOptions {
  std::vector<std::size_t> sizes{1000, 10240, 102400};  ///< numbers of beads of generated chains
  std::vector<std::filesystem::path> trajectories;      ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;
};

/// Runs the benchmark. Throws std::logic_error if two detectors find different pairs.
[[nodiscard]] std::vector<BenchRow> bench_collision(
    const CollisionBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

// `kds bench power`. Measures the power diagram from frame to frame, kinetically with an exact order of
// events, and by the other techniques of structures/power_diagram/diagram_update.h. The peer is CGAL's static
// build. Regular scenes, in which many balls lie on one sphere and many events coincide, are measured only
// kinetically. Their peer is CGAL's static build of both frames.

struct PowerBenchOptions {
  std::vector<std::size_t> sizes{10240};            ///< numbers of beads of generated chains
  std::vector<std::size_t> regular{1000, 8000};     ///< numbers of beads of regular scenes
  std::vector<std::filesystem::path> trajectories;  ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;                           ///< at least; more if rounds are short
};

[[nodiscard]] std::vector<BenchRow> bench_power(
    const PowerBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

// `kds bench trade`. Measures levers that trade accuracy for speed beside the exact run of the same structure
// in the same process: the steps alone, as in `kds trade`, and with the construction of the motion from the
// frames.

struct TradeBenchOptions {
  std::vector<std::filesystem::path> trajectories;  ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;                           ///< at least; more if rounds are short
};

[[nodiscard]] std::vector<BenchRow> bench_trade(
    const TradeBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

// `kds bench certificates` and `kds bench engine`. They report the subjects of kds_benchmarks as rows.

struct SubjectBenchOptions {
  std::filesystem::path instances;  ///< the folder of moving-point files
  std::size_t rounds = 5;
};

/// Measures certificates from beads to answers, in nanoseconds each. Throws InputError if an instance is
/// missing.
[[nodiscard]] std::vector<BenchRow> bench_certificates(
    const SubjectBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

/// Measures whole runs of all d1_*, d2_* and d3_* files: the time per event, and a run compared with a static
/// build. Throws InputError if there are no such files.
[[nodiscard]] std::vector<BenchRow> bench_engine(
    const SubjectBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
