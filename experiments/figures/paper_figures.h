#pragma once
// The figures of Agarwal et al. (2004) that show hierarchies, drawn from data of kds.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/figures/circle_drawing.h"
#include "experiments/figures/stable_pair.h"

namespace kds {

enum class PaperFigure : std::uint8_t {
  hierarchies,  ///< 2: wrapped and layered hierarchy of one necklace
  stability,    ///< 3: two conformations between which only the root's basis changes
  tightness     ///< 5: the points of Lemma 2.5 and their layered hierarchy
};
/// The names of the enumerators in order.
inline constexpr std::array<std::string_view, 3> figure_names{"2", "3", "5"};
[[nodiscard]] constexpr std::string_view name_of(PaperFigure figure) {
  return figure_names[static_cast<std::size_t>(figure)];
}

/// One panel of a figure in numbers.
struct DrawnPanel {
  PaperFigure figure = PaperFigure::hierarchies;
  std::string panel;
  std::size_t beads = 0;
  double root_radius = 0;
  std::size_t sticking_out = 0;  ///< nodes whose circle is not inside their parent's
  std::string note;              ///< a sentence about the panel
};

struct DrawnFigure {
  std::string svg;
  std::vector<DrawnPanel> panels;
};

/// Draws a figure. Throws InputError if the search finds no pair for figure 3.
[[nodiscard]] DrawnFigure draw(PaperFigure figure, const StablePairSearch& search);

}  // namespace kds
