#pragma once
// The search of certificates with constants or positions (certificates/base/constants.h). Part of
// define_certificate_search.h.
//
// The constants are represented by *anchors*, extra beads of the search next to the certificate's beads. The
// first anchor is at the origin with all channels zero; one anchor per constant follows. A length is an
// anchor's radius, a squared length its weight, a vector or point its centre. This turns the certificate's
// function into a function of beads alone, AnchoredFunction, so that all views, error bounds and exact stages
// work unchanged. The curves of the certificate's beads are copied next to the anchors.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "certificates/base/certificate.h"
#include "certificates/base/constants.h"
#include "certificates/formulas/function_values.h"
#include "certificates/search/certificate_search.h"

namespace kds {

/// A view that knows a certificate's constants. `anchors` is the first anchor.
template <class View, class Certificate>
class AnchoredView {
  using Constants = ConstantsOf<Certificate>;

 public:
  using Number = typename View::Number;
  static constexpr int dimension = View::dimension;
  static constexpr int degree = View::degree;

  [[gnu::always_inline]] AnchoredView(const View& view, const BeadId* anchors)
      : view_(view), anchors_(anchors) {}

  [[nodiscard, gnu::always_inline]] BernsteinVector<Number, degree, dimension> difference(BeadId i,
                                                                                          BeadId j) const {
    return view_.difference(i, j);
  }
  [[nodiscard, gnu::always_inline]] auto weight(BeadId i) const { return view_.weight(i); }
  [[nodiscard, gnu::always_inline]] auto weight_difference(BeadId i, BeadId j) const {
    return view_.weight_difference(i, j);
  }
  [[nodiscard, gnu::always_inline]] auto radius_difference(BeadId i, BeadId j) const {
    return view_.radius_difference(i, j);
  }
  [[nodiscard, gnu::always_inline]] auto radius_sum(BeadId i, BeadId j) const {
    return view_.radius_sum(i, j);
  }

  [[nodiscard, gnu::always_inline]] BernsteinVector<Number, degree, dimension> position(BeadId bead) const {
    return view_.difference(bead, anchors_[0]);
  }
  template <int Power>
  [[nodiscard, gnu::always_inline]] Bernstein<Number, degree> constant(
      Constant<Power> Constants::*member) const {
    const BeadId anchor = anchor_of(member);
    if constexpr (Power == 1) {
      return view_.radius_difference(anchor, anchors_[0]);
    } else {
      // Also read the radius, a length not below the constant's square root, for filters whose bound is in
      // powers of the largest length.
      if constexpr (requires { view_.largest_length(); } || std::is_same_v<Number, Recorded>)
        static_cast<void>(view_.radius_difference(anchor, anchors_[0]));
      return view_.weight_difference(anchor, anchors_[0]);
    }
  }
  template <int Dimension>
  [[nodiscard, gnu::always_inline]] BernsteinVector<Number, degree, Dimension> constant(
      ConstantVector<Dimension> Constants::*member) const {
    return view_.difference(anchor_of(member), anchors_[0]);
  }
  template <int Dimension>
  [[nodiscard, gnu::always_inline]] BeadId bead(ConstantPoint<Dimension> Constants::*member) const {
    return anchor_of(member);
  }
  [[nodiscard, gnu::always_inline]] BeadId bead(ConstantBead Constants::*member) const {
    return anchor_of(member);
  }

 private:
  template <class Member>
  [[nodiscard, gnu::always_inline]] BeadId anchor_of(Member Constants::*member) const {
    return anchors_[1 + index_of_constant(member)];
  }

  const View& view_;
  const BeadId* anchors_;
};

template <class Certificate>
struct AnchoredFunction {
  static constexpr std::size_t own_beads = std::tuple_size_v<decltype(Certificate{}.beads)>;
  static constexpr std::size_t anchors = 1 + std::tuple_size_v<ConstantMembers<Certificate>>;
  static constexpr bool has_length = detail::is_among<Constant<1>, ConstantMembers<Certificate>>;
  static constexpr bool has_square = detail::is_among<Constant<2>, ConstantMembers<Certificate>>;
  static constexpr bool uses_weights = channels_of<Certificate>.weights || has_square;
  static constexpr bool uses_radii = channels_of<Certificate>.radii || has_length || has_square;
  static constexpr int lanes_up_to_degree = kds::lanes_up_to_degree<Certificate>;
  static constexpr CertificateType type = Certificate::type;

  std::array<BeadId, own_beads + anchors> beads{};
  bool wanted_side = true;
  const Certificate* certificate = nullptr;  ///< used in messages during a search

  [[nodiscard]] Identity identity() const { return certificate->identity(); }
  [[nodiscard]] bool side() const { return wanted_side; }

  template <MotionView View>
  [[nodiscard, gnu::always_inline]] static auto formula(const View& view,
                                                        const std::array<BeadId, own_beads + anchors>& of) {
    std::array<BeadId, own_beads> own;
    std::copy_n(of.begin(), own_beads, own.begin());
    return Certificate::formula(AnchoredView<View, Certificate>(view, of.data() + own_beads), own);
  }
};

namespace detail {

template <class Certificate, int Dimension>
[[nodiscard]] std::unique_ptr<CertificateSearch<Certificate>> filtered_search(
    const MotionRef<Dimension>& motion);

/// A motion that holds copies of the curves of selected beads.
template <int DimensionValue>
class GatheredCurves {
 public:
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = any_degree;

  explicit GatheredCurves(int own_degree) : own_degree_(own_degree) {}

  [[nodiscard]] int own_degree() const { return own_degree_; }
  [[nodiscard]] std::size_t bead_count() const { return beads_; }
  [[nodiscard]] const double* control_point(BeadId bead, int k) const {
    return control_.data() + row_of(bead, k) * (dimension + 1);
  }
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const { return control_point(bead, k)[axis]; }
  [[nodiscard]] double weight(BeadId bead, int k) const { return control_point(bead, k)[dimension]; }
  [[nodiscard]] const double* radii(BeadId bead) const { return radii_.data() + row_of(bead, 0); }
  [[nodiscard]] double radius(BeadId bead, int k) const { return radii(bead)[k]; }

  /// Resizes. Existing beads are kept; new ones are zero.
  void resize(std::size_t beads) {
    beads_ = beads;
    control_.resize(row_of(beads, 0) * (dimension + 1));
    radii_.resize(row_of(beads, 0));
  }
  void set_coordinate(BeadId bead, int k, int axis, double value) {
    control_[row_of(bead, k) * (dimension + 1) + static_cast<std::size_t>(axis)] = value;
  }
  void set_weight(BeadId bead, int k, double value) { set_coordinate(bead, k, dimension, value); }
  void set_radius(BeadId bead, int k, double value) { radii_[row_of(bead, k)] = value; }

  /// Copies the channels of a bead that `channels` selects; the others are zero.
  template <Channels channels>
  void copy(BeadId to, const Curves<dimension>& from, BeadId bead) {
    const std::size_t row = row_of(1, 0);
    double* const points = control_.data() + row_of(to, 0) * (dimension + 1);
    std::copy_n(from.control_point(bead, 0), row * (dimension + 1), points);
    if constexpr (!channels.weights)
      for (int k = 0; k <= own_degree_; ++k) set_weight(to, k, 0);
    if constexpr (channels.radii) {
      std::copy_n(from.radii(bead), row, radii_.data() + row_of(to, 0));
    } else {
      std::fill_n(radii_.data() + row_of(to, 0), row, 0.0);
    }
  }

 private:
  [[nodiscard]] std::size_t row_of(std::size_t bead, int k) const {
    return bead * (static_cast<std::size_t>(own_degree_) + 1) + static_cast<std::size_t>(k);
  }

  int own_degree_;
  std::size_t beads_ = 0;
  std::vector<double> control_, radii_;
};

/// The anchors of a certificate type's constants.
template <class Certificate, int Dimension>
class Anchors {
 public:
  static constexpr std::size_t count = AnchoredFunction<Certificate>::anchors;

  explicit Anchors(int degree) : curves_(degree) { curves_.resize(count); }

  /// Sets the constants. Throws std::invalid_argument if a value cannot be a constant over a motion of
  /// `bead_count` beads.
  void set(const ConstantsOf<Certificate>& constants, std::size_t bead_count) {
    Anchors anchors(curves_.own_degree());
    BeadId anchor = 0;
    std::apply([&](const auto&... constant) { (anchors.set(++anchor, constant, bead_count), ...); },
               members_of(constants));
    *this = std::move(anchors);
  }
  /// Copies the anchors to the first beads of `gathered`. Constants that are beads are copied from their
  /// present curves.
  void copy_to(GatheredCurves<Dimension>& gathered, const Curves<Dimension>& motion) const {
    constexpr Channels all{true, true};
    const Curves<Dimension> own(curves_);
    for (BeadId anchor = 0; anchor < count; ++anchor) gathered.template copy<all>(anchor, own, anchor);
    for (const auto& [anchor, bead] : beads_)
      gathered.template copy<channels_of<Certificate>>(anchor, motion, bead);
  }

 private:
  [[noreturn]] static void refuse(BeadId anchor, const std::string& why) {
    throw std::invalid_argument(std::string(Certificate::type.name) + ": constant " + std::to_string(anchor) +
                                " of " + std::to_string(count - 1) + " " + why);
  }

  /// Calls `set_number(k, axis, value)` for each number of the control points.
  template <class SetNumber>
  void set_curve(BeadId anchor, const ConstantCurve& constant, std::size_t width, SetNumber set_number) {
    const int degree = curves_.own_degree();
    const std::vector<double>& numbers = constant.numbers();
    const std::size_t points = numbers.size() / width, wanted = static_cast<std::size_t>(degree) + 1;
    if (points != 1 && points != wanted)
      refuse(anchor, "has " + std::to_string(points) + " control points: expected 1, or " +
                         std::to_string(wanted) + " as the motion's curves have");
    for (int k = 0; k <= degree; ++k) {
      for (std::size_t axis = 0; axis < width; ++axis) {
        const double number = numbers[(points == 1 ? 0 : static_cast<std::size_t>(k)) * width + axis];
        if (!std::isfinite(number)) refuse(anchor, "is not finite");
        set_number(k, static_cast<int>(axis), number);
      }
    }
  }
  void set(BeadId anchor, const Constant<1>& length, std::size_t) {
    set_curve(anchor, length, 1, [&](int k, int, double number) { curves_.set_radius(anchor, k, number); });
  }
  void set(BeadId anchor, const Constant<2>& square, std::size_t) {
    double largest = 0;
    set_curve(anchor, square, 1, [&](int k, int, double number) {
      curves_.set_weight(anchor, k, number);
      largest = std::max(largest, std::abs(number));
    });
    if (largest == 0) return;
    // Take a power of two that is at least the square root of the constant.
    const int exponent = std::ilogb(largest) + 1;
    const double length = std::ldexp(1.0, exponent > 0 ? (exponent + 1) / 2 : exponent / 2);
    for (int k = 0; k <= curves_.own_degree(); ++k) curves_.set_radius(anchor, k, length);
  }
  void set(BeadId anchor, const ConstantVectorCurve<Dimension>& vector, std::size_t) {
    set_curve(anchor, vector, static_cast<std::size_t>(Dimension),
              [&](int k, int axis, double number) { curves_.set_coordinate(anchor, k, axis, number); });
  }
  void set(BeadId anchor, const ConstantBead& constant, std::size_t bead_count) {
    if (constant.bead() >= bead_count)
      refuse(anchor, "is no bead: expected one of " + std::to_string(bead_count));
    beads_.emplace_back(anchor, constant.bead());
  }

  GatheredCurves<Dimension> curves_;
  std::vector<std::pair<BeadId, BeadId>> beads_;  // anchors that stand for beads, with these
};

template <class Certificate, int Dimension>
class AnchoredSearch final : public CertificateSearch<Certificate> {
  using Function = AnchoredFunction<Certificate>;
  using Values = FunctionValues<Function, Curves<Dimension>>;

 public:
  explicit AnchoredSearch(const MotionRef<Dimension>& motion)
      : motion_(motion),
        anchors_(motion.degree()),
        gathered_(motion.degree()),
        search_(filtered_search<Function>(MotionRef<Dimension>(gathered_))) {
    if (motion.is_lifted() && channels_of<Certificate>.weights)
      throw std::invalid_argument(
          std::string(Certificate::type.name) +
          ": weights are no curves in lifted motion, and it has constants or asks for "
          "positions");
  }

  void set_constants(const ConstantsOf<Certificate>& constants) override {
    anchors_.set(constants, motion_.bead_count());
    are_set_ = true;
  }

  void first_failures(Kernel kernel, std::span<const Certificate> certificates, const Instant& now,
                      std::span<const KnownAtStart> known, StageCounts& stages, TouchPolicy touches,
                      std::span<Failure> failures) const override {
    search_->first_failures(kernel, gather(certificates), now, known, stages, touches, failures);
  }
  [[nodiscard]] int sign_now(Kernel kernel, const Certificate& certificate, const Instant& now,
                             StageCounts& stages) const override {
    return search_->sign_now(kernel, gather({&certificate, 1})[0], now, stages);
  }
  [[nodiscard]] int sign_just_after(Kernel kernel, const Certificate& certificate, const Instant& now,
                                    StageCounts& stages) const override {
    return search_->sign_just_after(kernel, gather({&certificate, 1})[0], now, stages);
  }
  [[nodiscard]] bool all_positive_now(Kernel kernel, std::span<const Certificate> certificates,
                                      const Instant& now, StageCounts& stages) const override {
    return search_->all_positive_now(kernel, gather(certificates), now, stages);
  }
  [[nodiscard]] int sign_at(const Certificate& certificate, const Dyadic& time) const override {
    return alone(certificate,
                 [&](const Function& f, const Curves<Dimension>& c) { return Values::sign_at(f, c, time); });
  }
  [[nodiscard]] ExactFunction exact_function(const Certificate& certificate) const override {
    return alone(certificate, [](const Function& f, const Curves<Dimension>& c) -> ExactFunction {
      return std::make_shared<const ExactPolynomial>(Values::exact(f, c));
    });
  }

 private:
  void gather(std::span<const Certificate> certificates, GatheredCurves<Dimension>& gathered,
              std::vector<Function>& functions) const {
    if constexpr (HasConstants<Certificate>) {
      if (!are_set_)
        throw std::logic_error(std::string(Certificate::type.name) + ": its constants are not set");
    }
    const Curves<Dimension> motion = motion_.curves();
    gathered.resize(Function::anchors + certificates.size() * Function::own_beads);
    anchors_.copy_to(gathered, motion);
    functions.resize(certificates.size());
    BeadId next = Function::anchors;
    for (std::size_t i = 0; i < certificates.size(); ++i) {
      Function& function = functions[i];
      function.wanted_side = certificates[i].side();
      function.certificate = &certificates[i];
      for (std::size_t index = 0; index < Function::own_beads; ++index) {
        gathered.template copy<channels_of<Certificate>>(next, motion, certificates[i].beads[index]);
        function.beads[index] = next++;
      }
      for (std::size_t anchor = 0; anchor < Function::anchors; ++anchor)
        function.beads[Function::own_beads + anchor] = static_cast<BeadId>(anchor);
    }
  }
  [[nodiscard]] std::span<const Function> gather(std::span<const Certificate> certificates) const {
    gather(certificates, gathered_, functions_);
    return functions_;
  }
  /// Uses separate buffers, because a search in progress may ask for the exact function of the present
  /// failure.
  template <class Ask>
  [[nodiscard]] auto alone(const Certificate& certificate, Ask ask) const {
    GatheredCurves<Dimension> gathered(motion_.degree());
    std::vector<Function> functions;
    gather({&certificate, 1}, gathered, functions);
    return ask(functions[0], Curves<Dimension>(gathered));
  }

  MotionRef<Dimension> motion_;
  Anchors<Certificate, Dimension> anchors_;
  bool are_set_ = false;
  mutable GatheredCurves<Dimension> gathered_;  // reused buffers, like the next member
  mutable std::vector<Function> functions_;
  std::unique_ptr<CertificateSearch<Function>> search_;
};

}  // namespace detail

}  // namespace kds