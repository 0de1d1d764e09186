#include "python/frames_in_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/frames/periodic.h"
#include "motions/readers/atom_frames.h"
#include "motions/readers/nanometres.h"
#include "motions/readers/reader_registry.h"
#include "motions/readers/vdw_radii.h"

namespace kds::python {

namespace py = pybind11;

/// Positions of beads in memory, in one of two types.
struct MemoryNumbers {
  const float* singles = nullptr;
  const double* doubles = nullptr;

  [[nodiscard]] double at(std::size_t i, bool nanometres) const {
    if (singles != nullptr)
      return nanometres ? angstrom_of_nanometres(double{singles[i]}) : double{singles[i]};
    return nanometres ? 10 * doubles[i] : doubles[i];
  }
  [[nodiscard]] bool empty() const { return singles == nullptr && doubles == nullptr; }
  /// Returns a hash of `count` numbers, which is not 0.
  [[nodiscard]] std::size_t hash(std::size_t first, std::size_t count) const {
    const void* const bytes =
        singles != nullptr ? static_cast<const void*>(singles + first) : doubles + first;
    const std::size_t size = count * (singles != nullptr ? sizeof(float) : sizeof(double));
    const std::size_t hash = std::hash<std::string_view>()({static_cast<const char*>(bytes), size});
    return hash == 0 ? 1 : hash;
  }
};

struct FramesInMemory::Content {
  BeadsInMemory beads;
  std::size_t frame_count = 0, bead_count = 0;
  MemoryNumbers numbers, velocities;  // of all frames; unused if `frame` is set
  py::object owner;                   // of both
  py::object frame;                   // or a function that returns one frame
  /// The hash of each frame when it was read first, 0 before.
  std::unique_ptr<std::atomic<std::size_t>[]> hashes;
  /// A frame whose hash has changed, or -1. From then on no frame is read, because a reader that has failed
  /// does not repeat its frame.
  mutable std::atomic<std::size_t> changed = std::numeric_limits<std::size_t>::max();

  ~Content() {
    const py::gil_scoped_acquire gil;
    owner = py::object();
    frame = py::object();
  }
};

namespace {

// Returns the array's numbers. The package has copied all arrays that are laid out differently.
MemoryNumbers numbers_of(const py::array& array) {
  constexpr int plain = int{py::array::c_style} | int{py::detail::npy_api::NPY_ARRAY_ALIGNED_};
  const bool singles = array.dtype().equal(py::dtype::of<float>());
  if ((array.flags() & plain) != plain || (!singles && !array.dtype().equal(py::dtype::of<double>())))
    throw std::logic_error("positions: expected float32 or float64, aligned and in C order");
  if (singles) return {static_cast<const float*>(array.data()), nullptr};
  return {nullptr, static_cast<const double*>(array.data())};
}

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }

std::optional<Cell> cell_of(std::span<const double> numbers, std::string& doubt) {
  const CellRead read =
      read_cell_from_angles({numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]});
  doubt = read.doubt;
  return read.cell;
}

class AtomsInMemory final : public AtomFrames {
 public:
  AtomsInMemory(std::shared_ptr<const FramesInMemory::Content> content, bool velocities)
      : content_(std::move(content)), velocities_(velocities) {}

  [[nodiscard]] std::size_t atom_count() const override { return content_->bead_count; }
  [[nodiscard]] FramesHeld held() const override { return {.whole = content_->frame_count}; }
  [[nodiscard]] bool may_have_cell() const override {
    return content_->frame || !content_->beads.cells.empty();
  }
  void read(std::size_t k, std::span<const std::size_t> atoms, FrameRead& frame) override {
    if (content_->frame) return call(k, atoms, frame);
    const BeadsInMemory& beads = content_->beads;
    frame.stamp.number = beads.first_frame + beads.frame_step * k;
    if (!beads.times.empty()) frame.stamp.picoseconds = beads.times[k];
    if (!beads.cells.empty())
      frame.cell = cell_of(std::span(beads.cells).subspan(6 * k, 6), frame.cell_doubt);
    copy(content_->numbers, content_->velocities, k, 3 * k * content_->bead_count, atoms, frame);
  }
  [[nodiscard]] std::vector<double> element_radii(std::vector<std::string>&) const override {
    if (!content_->beads.radii.empty()) return content_->beads.radii;
    std::vector<double> radii;
    for (const std::string& element : content_->beads.elements) {
      const std::optional<double> radius = van_der_waals_radius(element);
      if (!radius)
        throw InputError(fmt::format("{}: bead {} is of the element '{}', which has no van der Waals radius",
                                     content_->beads.label, radii.size(), element));
      radii.push_back(*radius);
    }
    return radii;
  }

 private:
  // Copies frame k, whose numbers begin at `first`. Refuses a frame that has changed since it was read first,
  // because later results would belong to other positions than earlier ones.
  void copy(const MemoryNumbers& positions, const MemoryNumbers& velocities, std::size_t k, std::size_t first,
            std::span<const std::size_t> atoms, FrameRead& frame) const {
    const std::size_t count = 3 * content_->bead_count;
    const std::size_t hash =
        positions.hash(first, count) + (velocities.empty() ? 0 : 3 * velocities.hash(first, count));
    std::size_t before = 0;
    if (!content_->hashes[k].compare_exchange_strong(before, hash) && before != hash) content_->changed = k;
    if (const std::size_t changed = content_->changed; changed < content_->frame_count)
      throw InputError(fmt::format(
          "{}: frame {}: the input has changed since it was read first; expected the same positions and "
          "velocities, such as "
          "those of a copy",
          content_->beads.label, content_->beads.first_frame + content_->beads.frame_step * changed));
    const auto take = [&](const MemoryNumbers& numbers, Eigen::Matrix3Xd& to) {
      to.resize(3, static_cast<Eigen::Index>(atoms.size()));
      for (std::size_t i = 0; i < atoms.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
          to(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(i)) =
              numbers.at(first + 3 * atoms[i] + axis, content_->beads.nanometres);
    };
    take(positions, frame.positions);
    if (velocities_ && frame.asked && !velocities.empty()) take(velocities, frame.velocities);
  }

  void call(std::size_t k, std::span<const std::size_t> atoms, FrameRead& frame) const {
    const py::gil_scoped_acquire gil;
    const std::string label = fmt::format("{}: frame {}", content_->beads.label, k);
    const auto read = content_->frame(k).cast<py::tuple>();
    const auto positions = read[0].cast<py::array>();
    if (positions.ndim() != 2 || static_cast<std::size_t>(positions.shape(0)) != content_->bead_count ||
        positions.shape(1) != 3)
      throw InputError(fmt::format("{} has the shape {}; expected ({}, 3) as in the first frame", label,
                                   shape_text(positions), content_->bead_count));
    if (!read[1].is_none()) frame.stamp.picoseconds = read[1].cast<double>();
    if (!read[2].is_none()) {
      const auto cell = read[2].cast<std::vector<double>>();
      if (cell.size() != 6)
        throw InputError(fmt::format("{}: its cell has {} numbers; expected three lengths and three angles",
                                     label, cell.size()));
      frame.cell = cell_of(cell, frame.cell_doubt);
    }
    const py::object velocities = read[3];
    if (!velocities.is_none() && !velocities.attr("shape").equal(positions.attr("shape")))
      throw InputError(fmt::format("{}: velocities have another shape than positions", label));
    copy(numbers_of(positions),
         velocities.is_none() ? MemoryNumbers() : numbers_of(velocities.cast<py::array>()), k, 0, atoms,
         frame);
  }

  std::shared_ptr<const FramesInMemory::Content> content_;
  bool velocities_;  // are asked for
};

// The frames that Python has registered, by their paths.
class Registered {
 public:
  std::filesystem::path add(std::shared_ptr<const FramesInMemory::Content> content) {
    const std::lock_guard lock(mutex_);
    const std::filesystem::path path =
        std::filesystem::path("memory") / std::to_string(++last_) / content->beads.label;
    all_[path.string()] = std::move(content);
    return path;
  }
  void remove(const std::filesystem::path& path) {
    std::shared_ptr<const FramesInMemory::Content> removed;  // destroyed after the lock
    const std::lock_guard lock(mutex_);
    removed = std::move(all_.at(path.string()));
    all_.erase(path.string());
  }
  std::shared_ptr<const FramesInMemory::Content> find(const std::filesystem::path& path) {
    const std::lock_guard lock(mutex_);
    const auto found = all_.find(path.string());
    if (found == all_.end())
      throw InputError(fmt::format("{}: is not in memory; expected a file of another format", path.string()));
    return found->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const FramesInMemory::Content>> all_;
  std::size_t last_ = 0;
};

// Is never destroyed: frames may outlive the interpreter, and then their objects must not be released.
Registered& registered() {
  static auto* const frames = new Registered;
  return *frames;
}

FramesOpened open_memory(const std::filesystem::path& path, const ReadOptions& options) {
  const auto content = registered().find(path);
  FramesOpened opened =
      open_atom_frames(path, options, std::make_unique<AtomsInMemory>(content, options.velocities));
  opened.file = content->beads.label;
  opened.chains = content->beads.chains;
  opened.bead_names = content->beads.names;
  opened.bead_groups = content->beads.groups;
  return opened;
}

}  // namespace

std::optional<Cell> cell_given(std::span<const double> numbers, int dimension) {
  if (numbers.empty()) return std::nullopt;
  std::string doubt;
  std::optional<Cell> cell = cell_of(numbers, doubt);
  if (!cell)
    throw InputError(
        fmt::format("cell: {}", doubt.empty() ? "expected three lengths above 1 and three angles" : doubt));
  if (dimension == 2) cell->col(2).setZero();
  return cell;
}

FramesInMemory::FramesInMemory(const py::array& positions, const std::optional<py::array>& velocities,
                               BeadsInMemory beads) {
  const std::string& label = beads.label;
  if (positions.ndim() != 3 || positions.shape(2) != 3)
    throw InputError(fmt::format("{}: has the shape {}; expected (frames, beads, 3){}", label,
                                 shape_text(positions),
                                 positions.ndim() == 3 && positions.shape(2) == 2
                                     ? ", where points in a plane have 0 as the third coordinate"
                                     : ""));
  auto content = std::make_shared<Content>();
  content->numbers = numbers_of(positions);
  if (velocities) {
    if (!velocities->attr("shape").equal(positions.attr("shape")))
      throw InputError(fmt::format("velocities: have the shape {}; expected {} as the positions",
                                   shape_text(*velocities), shape_text(positions)));
    content->velocities = numbers_of(*velocities);
  }
  content->owner = py::make_tuple(positions, velocities);
  content->frame_count = static_cast<std::size_t>(positions.shape(0));
  content->bead_count = static_cast<std::size_t>(positions.shape(1));
  content->beads = std::move(beads);
  enter(std::move(content));
}

FramesInMemory::FramesInMemory(py::function frame, std::size_t frames, std::size_t bead_count,
                               BeadsInMemory beads) {
  auto content = std::make_shared<Content>();
  content->frame = std::move(frame);
  content->frame_count = frames;
  content->bead_count = bead_count;
  content->beads = std::move(beads);
  enter(std::move(content));
}

void FramesInMemory::enter(std::shared_ptr<Content> content) {
  content->hashes = std::make_unique<std::atomic<std::size_t>[]>(content->frame_count);
  content_ = std::move(content);
  const std::string& label = content_->beads.label;
  const auto check = [&](std::size_t length, std::size_t expected, const char* what, const char* of) {
    if (length != 0 && length != expected)
      throw InputError(
          fmt::format("{}: has {} {}; expected {}, one for each {}", label, length, what, expected, of));
  };
  if (content_->frame_count == 0)
    throw InputError(fmt::format("{}: has no frames; expected two or more", label));
  if (content_->bead_count == 0)
    throw InputError(fmt::format("{}: has no beads; expected two or more", label));
  const BeadsInMemory& beads = content_->beads;
  check(beads.names.size(), content_->bead_count, "names", "bead");
  check(beads.elements.size(), content_->bead_count, "elements", "bead");
  check(beads.radii.size(), content_->bead_count, "radii", "bead");
  for (const double radius : beads.radii)
    if (!(radius >= 0) || !std::isfinite(radius))
      throw InputError(fmt::format("radius: {} is no radius; expected finite numbers from 0", radius));
  check(beads.groups.size(), content_->bead_count, "groups", "bead");
  check(beads.times.size(), content_->frame_count, "times", "frame");
  check(beads.cells.size(), 6 * content_->frame_count, "numbers of cells", "length and angle of each frame");
  std::size_t in_chains = 0;
  for (const ChainRead& chain : beads.chains) in_chains += chain.bead_count;
  if (!beads.chains.empty() && in_chains != content_->bead_count)
    throw InputError(fmt::format("{}: its necklaces have {} beads; expected {}, all beads of the input",
                                 label, in_chains, content_->bead_count));
  path_ = registered().add(content_);
}

FramesInMemory::~FramesInMemory() {
  if (!path_.empty()) registered().remove(path_);
}

const std::string& FramesInMemory::label() const { return content_->beads.label; }

void add_memory_reader() {
  ReaderSpec reader{"memory", {}, false};
  reader.open = open_memory;
  reader_registry().add(std::move(reader));
}

}  // namespace kds::python
