#include "motions/models/model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/interruption.h"
#include "motions/models/shape_motion.h"
#include "motions/models/shapes.h"

namespace kds::models {

namespace {

constexpr std::array kShape{Setting::motion, Setting::step, Setting::bond};
constexpr std::array kSpline{Setting::motion, Setting::step, Setting::bond, Setting::dimension};
constexpr std::array kHelix{Setting::motion, Setting::step, Setting::bond, Setting::turns};
constexpr std::array kScalingHelix{Setting::motion, Setting::step, Setting::bond, Setting::pitch};
constexpr std::array kGrid{Setting::motion, Setting::step,      Setting::bond,
                           Setting::gap,    Setting::dimension, Setting::jitter};
constexpr std::array kChain{Setting::motion, Setting::step, Setting::bond, Setting::fill};
constexpr std::array kSpiral{Setting::bond, Setting::turns, Setting::rolled};
constexpr std::array kTwoSpirals{Setting::bond, Setting::turns, Setting::rolled, Setting::distance};

Trajectory trajectory(std::string name, std::vector<Shape> frames) {
  Trajectory result;
  result.file = std::move(name);
  for (std::size_t k = 0; k < frames.size(); ++k) result.frame_numbers.push_back(k);
  result.frames = std::move(frames);
  return result;
}

std::vector<Trajectory> moved(std::string name, const Shape& shape, const Settings& settings,
                              Random& random) {
  const int dimension = settings.dimension.value_or(3);
  std::vector<Shape> frames;
  switch (*settings.motion) {
    case ShapeMotion::rest:
      frames.assign(settings.frames, shape);
      break;
    case ShapeMotion::rotate:
      frames = rotating(shape, settings.frames, *settings.step, dimension);
      break;
    case ShapeMotion::wander:
      frames = wandering(shape, settings.frames, *settings.step, random, dimension);
      break;
  }
  return {trajectory(std::move(name), std::move(frames))};
}

std::vector<Trajectory> moved(std::string name, const Shape& shape, const Settings& settings) {
  Random random(settings.seed);
  return moved(std::move(name), shape, settings, random);
}

double at(const Span& span, std::size_t frame, std::size_t frames) {
  if (frame == 0) return span.first;
  if (frame + 1 == frames) return span.last;
  return span.first +
         (span.last - span.first) * (static_cast<double>(frame) / static_cast<double>(frames - 1));
}

std::vector<Shape> rolling(const Settings& s) {
  std::vector<Shape> frames;
  for (std::size_t k = 0; k < s.frames; ++k) {
    InterruptionCheck::ask();
    frames.push_back(spiral(s.beads, *s.turns, at(*s.rolled, k, s.frames), *s.bond));
  }
  return frames;
}

std::vector<Trajectory> make_spline(const Settings& s) {
  return moved("spline", spline(s.beads, *s.bond, *s.dimension), s);
}

std::vector<Trajectory> make_helix(const Settings& s) {
  return moved("helix", helix(s.beads, *s.turns, *s.bond), s);
}

std::vector<Trajectory> make_scaling_helix(const Settings& s) {
  return moved("scaling-helix", helix(s.beads, turns_at_pitch(s.beads, *s.pitch), *s.bond), s);
}

std::vector<Trajectory> make_grill(const Settings& s) { return moved("grill", grill(s.beads, *s.bond), s); }

std::vector<Trajectory> make_grid(const Settings& s) {
  if (!(*s.bond > (1 + *s.gap) / 2))
    throw InputError("--bond", "too short to join the rows of a grid; expected more than (1 + gap) / 2");
  Random random(s.seed);
  Shape grid = packed_grid(s.beads, *s.dimension, *s.gap, *s.bond);
  if (*s.jitter > 0) grid = jittered(std::move(grid), *s.jitter, random, *s.dimension);
  return moved("grid", grid, s, random);
}

std::vector<Trajectory> make_random_chain(const Settings& s) {
  Random random(s.seed);
  const Shape chain = random_chain(s.beads, *s.fill, random, *s.bond);
  return moved("random-chain", chain, s, random);
}

std::vector<Trajectory> make_spiral(const Settings& s) { return {trajectory("spiral", rolling(s))}; }

std::vector<Trajectory> make_two_spirals(const Settings& s) {
  std::vector<Shape> first = rolling(s), second;
  for (std::size_t k = 0; k < s.frames; ++k)
    second.push_back(facing_spiral(first[k], at(*s.distance, k, s.frames), *s.bond));
  return {trajectory("two-spirals 1", std::move(first)), trajectory("two-spirals 2", std::move(second))};
}

// Returns the turns of a curve that needs `bonds_a_squared_turn` bonds per squared turn, rounded down to
// tenths.
double root_of_share(std::size_t beads, double bonds_a_squared_turn) {
  return std::floor(10 * std::sqrt(static_cast<double>(beads - 1) / bonds_a_squared_turn)) / 10;
}
double turns_of_helix(std::size_t beads) { return root_of_share(beads, 3.3); }
double turns_of_spiral(std::size_t beads) { return root_of_share(beads, 10.5); }

Settings shape_defaults(ShapeMotion motion) {
  Settings settings;
  settings.motion = motion;
  settings.step = 0.1;
  settings.bond = usual_bond;
  return settings;
}

std::vector<Model> make_models() {
  Settings shape = shape_defaults(ShapeMotion::rotate), chain = shape_defaults(ShapeMotion::wander);
  Settings spline = shape, helix = shape, scaling = shape, grid = shape;
  spline.dimension = 3;
  helix.turns = 10;
  scaling.pitch = 2;
  grid.gap = 0.05;
  grid.dimension = 3;
  grid.jitter = 0;
  chain.fill = 0.2;
  Settings spiral;
  spiral.bond = usual_bond;
  spiral.turns = 18;
  spiral.rolled = Span{0, 1};
  Settings two = spiral;
  two.distance = Span{1.5, 1.5};
  return {{"spline", "a quadratic spline with five control points", kSpline, make_spline, spline},
          {"helix", "a helix in a cube, with a constant number of turns", kHelix, make_helix, helix,
           turns_of_helix},
          {"scaling-helix", "a helix in a cube whose turns grow with the root of the beads", kScalingHelix,
           make_scaling_helix, scaling},
          {"spiral", "a straight chain that rolls up into a logarithmic spiral", kSpiral, make_spiral, spiral,
           turns_of_spiral},
          {"two-spirals", "two such chains some way apart, two files", kTwoSpirals, make_two_spirals, two,
           turns_of_spiral},
          {"grill", "six parallel segments connected by parabolic arcs", kShape, make_grill, shape},
          {"grid", "rows that trace a square or a cube, tightly packed", kGrid, make_grid, grid},
          {"random-chain", "a random chain that avoids itself", kChain, make_random_chain, chain}};
}

}  // namespace

bool Model::takes(Setting setting) const {
  return std::find(settings.begin(), settings.end(), setting) != settings.end();
}

std::span<const Model> all_models() {
  static const std::vector<Model> models = make_models();
  return models;
}

const Model* find_model(std::string_view name) {
  for (const Model& model : all_models())
    if (model.name == name) return &model;
  return nullptr;
}

Settings completed(const Model& model, const Settings& settings) {
  Settings full = settings;
  const Settings& defaults = model.defaults;
  const auto complete = [](auto& value, const auto& otherwise) {
    if (!value) value = otherwise;
  };
  complete(full.motion, defaults.motion);
  complete(full.step, defaults.step);
  complete(full.bond, defaults.bond);
  complete(full.turns, defaults.turns);
  if (!settings.turns && model.most_turns != nullptr)
    full.turns = std::min(*full.turns, model.most_turns(full.beads));
  complete(full.pitch, defaults.pitch);
  complete(full.gap, defaults.gap);
  complete(full.dimension, defaults.dimension);
  complete(full.jitter, defaults.jitter);
  complete(full.fill, defaults.fill);
  complete(full.rolled, defaults.rolled);
  complete(full.distance, defaults.distance);
  return full;
}

std::vector<Trajectory> generate(const Model& model, const Settings& settings) {
  return model.make(completed(model, settings));
}

}  // namespace kds::models
