#include "experiments/view/replay_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <variant>

#include "experiments/output/output_files.h"
#include "experiments/output/page_data.h"
#include "experiments/output/page_templates.h"
#include "experiments/view/replay_columns.h"
#include "motions/base/input_error.h"
#include "motions/readers/bead_name.h"
#include "structures/session/scene_motion.h"

namespace kds {

namespace {

constexpr double kAngstromQuantum = 0.02;
/// Browsers square lengths in 32-bit floats.
constexpr double kMostLength = 1e18, kLeastLength = 1e-15;
/// Rounded coordinates stay below this number, so that their differences have 32 bits.
constexpr double kMostQuanta = 1 << 28;
constexpr double kMostSphereQuanta = 1 << 30;  // spheres are larger than the scene
constexpr int kVersion = 2;
/// In the order of DecidedBy. No text: the page names no stage.
const std::vector<std::string> kStages{"", "floating point, with proved error bounds",
                                       "floating point, with errors followed through each operation",
                                       "integers"};

/// Returns the roles of an event's ids. A count of 0 means all ids that are left.
Json roles_json(const EventKind& kind) {
  constexpr std::array<std::string_view, 3> names{"beads", "node", "number"};
  Json roles = Json::array();
  for (const IdRole& role : kind.roles)
    roles.push_back(
        {{"name", role.name}, {"count", role.count}, {"of", names[static_cast<std::size_t>(role.of)]}});
  return roles;
}

/// Returns the name of a bead as A/LEU42/CA, or an empty text.
std::string short_name(const Scene& scene, BeadId bead) {
  const std::string& text = scene.bead_name(bead);
  const auto name = bead_name_of(text);
  return name ? fmt::format("{}/{}{}/{}", name->chain, name->residue, name->number, name->atom) : text;
}

std::string_view note_on(const ReplayRecorder::Structure& structure) {
  if (!structure.layers.empty() || !structure.sphere_nodes.empty()) return "";
  return structure.kinds.empty() ? "This structure has no events, and the scene does not show it."
                                 : "The scene does not show this structure; its events are on the timeline.";
}

std::string motion_name(const Scene& scene) {
  if (scene.is_lifted()) return "lifted";
  return scene.degree() == 1 ? "linear" : scene.degree() == 3 && scene.has_radii() ? "hermite" : "curves";
}

template <class Numbers>
void add_words(BlockBytes& block, const Numbers& numbers) {
  for (const auto number : numbers) block.add_word(number);
}

Json numbers_json(std::span<const double> numbers) {
  Json items = Json::array();
  for (const double number : numbers) items.push_back(number);
  return items;
}

}  // namespace

ReplayPage::ReplayPage(std::ostream& stream, const Scene& scene, ReplayPageOptions options)
    : stream_(stream), scene_(scene), options_(std::move(options)) {
  for (const std::string_view piece : replay_template()) page_ += piece;
  const std::size_t mark = page_.find(page_data_mark);
  rest_of_page_ = std::string_view(page_).substr(mark + page_data_mark.size());
  put(std::string_view(page_).substr(0, mark));
}

void ReplayPage::choose_quantum(const Eigen::Matrix3Xd& first) {
  if (options_.quantum) {
    quantum_ = *options_.quantum;
    quantum_note_ = "as --quantum says";
  } else if (options_.labels.in_angstrom) {
    quantum_ = kAngstromQuantum;
    quantum_note_ = "the default for lengths in angstrom";
  } else if (scene_.has_radii()) {
    quantum_ = *std::min_element(scene_.radii().begin(), scene_.radii().end()) / 100;
    quantum_note_ = "a hundredth of the least radius, because the input names no unit";
  } else {
    quantum_ = (first.rowwise().maxCoeff() - first.rowwise().minCoeff()).maxCoeff() * 0x1p-16;
    quantum_note_ = "a 65,536th of the extent of the first frame, because the input names no unit";
  }
  if (!(quantum_ > 0)) quantum_ = 1;  // points without extent, or radii that are zero
  const double largest =
      scene_.has_radii() ? *std::max_element(scene_.radii().begin(), scene_.radii().end()) : 0;
  const double size = (first.rowwise().maxCoeff() - first.rowwise().minCoeff()).maxCoeff() + 2 * largest;
  if (size == 0) return;
  if (!(size >= kLeastLength && size < kMostLength))
    throw InputError(fmt::format(
        "frame {}: all beads lie within {:.3g}, and a page shows lengths from {} to {}; expected an input in "
        "another unit",
        scene_.frame_number(0), size, kLeastLength, kMostLength));
  if (quantum_ > size && quantum_ > farthest())
    throw InputError(fmt::format(
        "--quantum {}: the scene is smaller than one step; all beads of frame {} lie within {:.3g}; expected "
        "at most --quantum {:.1g}",
        quantum_, scene_.frame_number(0), size, size / 100));
}

double ReplayPage::farthest() const {
  double farthest = 0;
  const Eigen::Vector3d corner(origin_[0], origin_[1], origin_[2]);
  for (std::size_t frame = 0; frame < scene_.frame_count(); ++frame)
    farthest = std::max(farthest, (scene_.centers(frame).colwise() - corner).cwiseAbs().maxCoeff());
  return farthest;
}

std::int32_t ReplayPage::rounded(double value, int axis, BeadId bead, std::size_t frame) const {
  const double away = value - origin_[static_cast<std::size_t>(axis)];
  if (!(std::abs(away) < kMostLength))
    throw InputError(
        fmt::format("frame {}, bead {} lies {:.3g} from the corner of the first frame, and a page shows "
                    "lengths up to {}; expected an input in another unit",
                    scene_.frame_number(frame), bead, std::abs(away), kMostLength));
  const double quanta = std::floor(away / quantum_ + 0.5);
  if (!(std::abs(quanta) < kMostQuanta))
    throw InputError(
        fmt::format("--quantum {}: frame {}, bead {} lies {:.6g} from the corner of the first frame, too far "
                    "for this step; expected kds view with at least --quantum {:.3g}",
                    quantum_, scene_.frame_number(frame), bead, std::abs(away),
                    2 * std::max(std::abs(away), farthest()) / kMostQuanta));
  return static_cast<std::int32_t>(quanta);
}

FrameBlocks::Numbers ReplayPage::numbers_of(const Eigen::Matrix3Xd& points, std::size_t frame) const {
  FrameBlocks::Numbers numbers;
  numbers.reserve(scene_.bead_count() * static_cast<std::size_t>(scene_.dimension()));
  for (int axis = 0; axis < scene_.dimension(); ++axis)
    for (Eigen::Index bead = 0; bead < points.cols(); ++bead)
      numbers.push_back(rounded(points(axis, bead), axis, static_cast<BeadId>(bead), frame));
  return numbers;
}

void ReplayPage::write_frames() {
  constexpr std::size_t most_frames = 64, beads_of_block = 300'000;
  const std::size_t beads = scene_.bead_count(), frames = frame_count();
  const int degree = scene_.degree(), dimension = scene_.dimension();
  block_frames_ = std::clamp<std::size_t>(beads_of_block / beads, 1, most_frames);
  FrameBlocks blocks(beads, degree, block_frames_,
                     [this](const std::string& name, std::string_view bytes) { put_block(name, bytes); });
  const auto motion = degree > 1 ? make_scene_motion(scene_) : nullptr;
  BlockBytes numbers, times;
  const std::uint64_t before = written_;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    std::vector<FrameBlocks::Numbers> controls;
    if (motion && frame > 0) {
      motion->load(frame - 1);
      std::visit(
          [&](const auto& ref) {
            const auto curves = ref.curves();
            for (int j = 1; j < degree; ++j) {
              Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(beads));
              for (BeadId bead = 0; bead < beads; ++bead)
                for (int axis = 0; axis < dimension; ++axis)
                  points(axis, bead) = curves.coordinate(bead, j, axis);
              controls.push_back(numbers_of(points, frame));
            }
          },
          motion->ref());
    }
    const Eigen::Matrix3Xd centers = scene_.centers(frame);
    const Eigen::Vector3d low = centers.rowwise().minCoeff(), high = centers.rowwise().maxCoeff();
    const FrameStamp stamp = scene_.stamp(frame);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (frame == 0) origin_[a] = low_[a] = low[axis], high_[a] = high[axis];
      low_[a] = std::min(low_[a], low[axis]);
      high_[a] = std::max(high_[a], high[axis]);
    }
    if (frame == 0) {
      choose_quantum(centers);
      has_times_ = stamp.picoseconds.has_value();
    }
    blocks.add(numbers_of(centers, frame), controls);
    numbers.add_word(static_cast<std::uint32_t>(stamp.number));
    has_times_ = has_times_ && stamp.picoseconds;
    times.add_double(stamp.picoseconds.value_or(0));
    if ((frame + 1) % block_frames_ == 0)
      require_size(page_.size() + (written_ - before) * frames / (frame + 1));
  }
  blocks.finish();
  put_block("frames", numbers.bytes());
  if (has_times_) put_block("times", times.bytes());
  require_size(written_);
}

void ReplayPage::write_beads() {
  if (scene_.has_radii() && !scene_.equal_radii()) {
    BlockBytes radii;
    for (const double radius : scene_.radii()) radii.add_double(radius);
    put_block("radii", radii.bytes());
  }
  if (!scene_.names_beads()) return;
  std::vector<std::string> names;
  for (BeadId bead = 0; bead < scene_.bead_count(); ++bead) names.push_back(short_name(scene_, bead));
  put_block("names", text_of(Json(names)));
}

Json ReplayPage::write_structure(std::size_t index, const ReplayRecorder::Structure& structure) {
  const ReplayRecorder::Events& events = structure.events;
  put_block(fmt::format("events-{}", index), event_columns(events).bytes());

  Json kinds = Json::array(), layers = Json::array();
  for (const EventKind& kind : structure.kinds)
    kinds.push_back({{"name", kind.name}, {"external", kind.external}, {"roles", roles_json(kind)}});
  for (std::size_t l = 0; l < structure.layers.size(); ++l) {
    const ReplayRecorder::Layer& layer = structure.layers[l];
    BlockBytes initial;
    add_words(initial, layer.initial);
    put_block(fmt::format("initial-{}-{}", index, l), initial.bytes());
    put_block(fmt::format("changes-{}-{}", index, l), change_columns(layer, events).bytes());
    layers.push_back({{"name", layer.layer.name},
                      {"arity", layer.layer.arity},
                      {"initial", layer.initial.size() / layer.layer.arity},
                      {"changes", layer.change_count}});
  }
  if (!structure.nodes.empty()) {
    BlockBytes nodes;
    for (const ReplayNode& node : structure.nodes)
      add_words(nodes, std::array{node.beads.first, node.beads.last + 1, node.level, node.parent});
    put_block(fmt::format("nodes-{}", index), nodes.bytes());
  }
  if (!structure.sphere_nodes.empty()) write_spheres(index, structure);
  return {{"name", structure.name},
          {"kinds", kinds},
          {"stages", kStages},
          {"events", events.count()},
          {"layers", layers},
          {"nodes", structure.nodes.size()},
          {"spheres", structure.sphere_nodes.size()},
          {"note", note_on(structure)}};
}

void ReplayPage::write_spheres(std::size_t index, const ReplayRecorder::Structure& structure) {
  BlockBytes nodes;
  add_words(nodes, structure.sphere_nodes);
  put_block(fmt::format("sphere-nodes-{}", index), nodes.bytes());
  const std::size_t count = structure.sphere_nodes.size();
  std::size_t at = 0;
  const auto next = [&] {
    FrameBlocks::Numbers numbers;
    numbers.reserve(4 * count);
    for (std::size_t axis = 0; axis < 4; ++axis)
      for (std::size_t k = at; k < at + count; ++k) {
        const double value = structure.spheres[k][axis] - (axis < 3 ? origin_[axis] : 0);
        numbers.push_back(static_cast<std::int32_t>(
            std::clamp(std::round(value / quantum_), -kMostSphereQuanta, kMostSphereQuanta)));
      }
    at += count;
    return numbers;
  };
  FrameBlocks blocks(count, scene_.degree(), block_frames_,
                     [&](const std::string& name, std::string_view bytes) {
                       put_block(fmt::format("spheres-{}-{}", index, name), bytes);
                     });
  blocks.add(next(), {});
  while (at < structure.spheres.size()) {
    std::vector<FrameBlocks::Numbers> controls;
    for (int j = 1; j < scene_.degree(); ++j) controls.push_back(next());
    blocks.add(next(), controls);
  }
  blocks.finish();
}

void ReplayPage::write_record(const ReplayRecorder& recorder) {
  write_beads();
  Json structures = Json::array();
  for (std::size_t s = 0; s < recorder.structures().size(); ++s)
    structures.push_back(write_structure(s, recorder.structures()[s]));
  Json necklaces = Json::array();
  for (const BeadRange& necklace : scene_.necklaces())
    necklaces.push_back(necklace.last - necklace.first + 1);
  const Json radius = !scene_.has_radii()    ? Json(0)
                      : scene_.equal_radii() ? Json(scene_.radii().front())
                                             : Json(nullptr);
  const ReplayLabels& labels = options_.labels;
  const Json meta{{"format", "kds-replay"},
                  {"version", kVersion},
                  {"program", "kds " + program_version()},
                  {"title", labels.title},
                  {"inputs", labels.inputs},
                  {"command", labels.command},
                  {"dimension", scene_.dimension()},
                  {"degree", scene_.degree()},
                  {"motion", motion_name(scene_)},
                  {"frames", frame_count()},
                  {"stride", labels.stride},
                  {"has_times", has_times_},
                  {"length_unit", labels.in_angstrom ? "angstrom" : ""},
                  {"quantum", quantum_},
                  {"quantum_note", quantum_note_},
                  {"origin", numbers_json(origin_)},
                  {"block_frames", block_frames_},
                  {"necklaces", necklaces},
                  {"beads", scene_.bead_count()},
                  {"radius", radius},
                  {"box", {{"low", numbers_json(low_)}, {"high", numbers_json(high_)}}},
                  {"names", scene_.names_beads()},
                  {"structures", structures},
                  {"blocks", blocks_}};
  put("<script type=\"application/json\" id=\"kds-replay\">\n");
  put(without_tags(text_of(meta)));
  put("</script>\n");
  put(rest_of_page_);
  require_size(written_);
}

void ReplayPage::put(std::string_view text) {
  stream_ << text;
  written_ += text.size();
}

void ReplayPage::put_block(const std::string& name, std::string_view bytes) {
  put(fmt::format("<script type=\"text/plain\" class=\"kds-block\" id=\"kds-block-{}\">", name));
  put(base64(compressed(bytes)));
  put("</script>\n");
  blocks_[name] = Json(bytes.size());
}

void ReplayPage::require_size(std::uint64_t expected) const {
  if (options_.most_bytes && expected > *options_.most_bytes) throw ReplayTooLarge(expected);
}

void write_replay_page(std::ostream& stream, const Scene& scene, const ReplayRecorder& recorder,
                       const ReplayPageOptions& options) {
  ReplayPage page(stream, scene, options);
  page.write_frames();
  page.write_record(recorder);
}

void write_replay_page(const std::filesystem::path& file, const Scene& scene, const ReplayRecorder& recorder,
                       const ReplayPageOptions& options) {
  AtomicFiles files;
  write_replay_page(files.open(file), scene, recorder, options);
  commit_together({&files});
}

}  // namespace kds
