#pragma once
// The subjects of `kds bench`, each compared with a peer in the same process: certificates, engine,
// hierarchies, power, collision, trade and readers.

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

struct HierarchyBenchOptions {
  std::vector<std::size_t> sizes{640, 10240, 102400};  ///< numbers of beads of generated chains
  std::vector<std::filesystem::path> trajectories;     ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;                              ///< at least; more if rounds are short
};

/// Measures wrapped and layered hierarchies that are built, updated from frame to frame, and run kinetically.
/// The peer is CGAL's Min_sphere_of_spheres_d at every node. Also compares the number of events with the net
/// change.
[[nodiscard]] std::vector<BenchRow> bench_hierarchies(
    const HierarchyBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

/// Adds the rows of `kds bench collision` about contacts: all begin and end times, compared with a cell list
/// that examines only frames. Measures consecutive frames; both methods start from the positions that were
/// read. Radii are `radius_factor` times the chain's. Pairs are at least 5 beads apart along the chain.
void bench_contacts(const BenchChain& chain, double radius_factor, std::optional<double> goal,
                    std::size_t rounds, std::vector<BenchRow>& rows);

/// Compares the time per bead with the time per bead for ten times as many beads. The time covers the build
/// at a frame and the steps to the next two frames.
void bench_contacts_growth(std::string_view model, std::size_t beads, std::optional<double> goal,
                           std::size_t rounds, std::vector<BenchRow>& rows);

struct CollisionBenchOptions {
  std::vector<std::size_t> sizes{1000, 10240, 102400};  ///< numbers of beads of generated chains
  std::vector<std::filesystem::path> trajectories;      ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;
};

/// Measures the detector of kds. The peers of the detector are a cell list on single scenes, a Verlet list
/// from frame to frame, and the trees of FCL and Bullet if this program was built with them. All frames are
/// distinct, and the detectors see the same frames in turn. Includes the rows of contacts. Throws
/// std::logic_error if two detectors find different pairs.
[[nodiscard]] std::vector<BenchRow> bench_collision(
    const CollisionBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

struct PowerBenchOptions {
  std::vector<std::size_t> sizes{10240};            ///< numbers of beads of generated chains
  std::vector<std::size_t> regular{1000, 8000};     ///< numbers of beads of regular scenes
  std::vector<std::filesystem::path> trajectories;  ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;                           ///< at least; more if rounds are short
};

/// Measures the power diagram from frame to frame, kinetically with an exact order of events, and by the
/// other techniques of structures/power_diagram/diagram_update.h. The peer is CGAL's static build. Regular
/// scenes, in which many balls lie on one sphere and many events coincide, are measured only kinetically. The
/// peer of these scenes is CGAL's static build of both frames.
[[nodiscard]] std::vector<BenchRow> bench_power(
    const PowerBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

struct TradeBenchOptions {
  std::vector<std::filesystem::path> trajectories;  ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;                           ///< at least; more if rounds are short
};

/// Compares levers that trade accuracy for speed with the exact run of one structure: the steps alone, as in
/// `kds trade`, and with the construction of the motion from the frames.
[[nodiscard]] std::vector<BenchRow> bench_trade(
    const TradeBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

struct ReaderBenchOptions {
  std::vector<std::filesystem::path> trajectories;  ///< inputs, in any format with frames
  std::size_t rounds = 5;
};

/// Measures how long a reader takes for all atoms of all frames of a file. The peer reads the bytes of the
/// file and nothing else. The time to open the file does not count.
[[nodiscard]] std::vector<BenchRow> bench_readers(
    const ReaderBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

/// Options of the two subjects that kds_benchmarks also has.
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
