#pragma once
// Counts the work of the exact stage in *limb operations*. With one version of Arb the count is the same on
// every machine. One limb operation passes over a polynomial's coefficient once, for each 64 bits of its
// length. Evaluating n coefficients of 128 bits takes about 2 n operations. Restricting the polynomial to a
// part of the step, or forming it, takes about 2 n^2. The count is only a measure, but every long computation
// is counted, so work can be limited, watched and interrupted (motions/base/interruption.h).
//
// A thread charges its work to the account that it has open (ExactWork::Open), or to an account without a
// limit.

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "certificates/base/certificate_type.h"

namespace kds {

class RecentFunctions;

/// Thrown if more work is requested after the limit is reached.
class WorkLimitReached : public std::runtime_error {
 public:
  explicit WorkLimitReached(const std::optional<Identity>& subject)
      : std::runtime_error("the limit of exact work is reached"), subject_(subject) {}

  /// Returns the certificate that was being worked on, if any.
  [[nodiscard]] const std::optional<Identity>& subject() const { return subject_; }

 private:
  std::optional<Identity> subject_;
};

class ExactWork {
 public:
  static constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

  ExactWork();
  ~ExactWork();
  ExactWork(const ExactWork&) = delete;
  ExactWork& operator=(const ExactWork&) = delete;

  /// Sets the limit. Requesting more than `most` operations in total throws WorkLimitReached.
  void set_limit(std::uint64_t most);
  /// Sets a function that is called after each `every` operations of work. The function may throw.
  void set_watcher(std::function<void()> watcher, std::uint64_t every);

  [[nodiscard]] std::uint64_t done() const { return done_; }
  /// Returns the certificate that is being worked on, if any.
  [[nodiscard]] std::optional<Identity> subject() const;
  /// Returns this account's recent functions.
  [[nodiscard]] RecentFunctions& recent_functions() { return *recent_; }

  /// Returns the account of this thread.
  [[nodiscard]] static ExactWork& current();
  static void spend(std::uint64_t operations) { current().add(operations); }

  /// Opens an account in this thread, replacing the current one until this object is destroyed.
  class Open {
   public:
    explicit Open(ExactWork& account) : before_(current_) { current_ = &account; }
    ~Open() { current_ = before_; }
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;

   private:
    ExactWork* before_;
  };

  /// Attributes work to `subject` during this object's life, if the subject has an identity. The subject must
  /// live as long.
  class About {
   public:
    template <class Named>
    explicit About(const Named& subject) : account_(current()), before_(account_.subject_) {
      if constexpr (requires { subject.identity(); })
        account_.subject_ = {
            &subject, [](const void* of) -> Identity { return static_cast<const Named*>(of)->identity(); }};
    }
    ~About() { account_.subject_ = before_; }
    About(const About&) = delete;
    About& operator=(const About&) = delete;

   private:
    friend class ExactWork;
    struct Subject {
      const void* of = nullptr;
      Identity (*identity)(const void*) = nullptr;
    };

    ExactWork& account_;
    Subject before_;
  };

 private:
  void add(std::uint64_t operations) {
    done_ += operations;
    if (done_ >= next_stop_) [[unlikely]]
      stop();
  }
  /// Asks the checks of this thread, and calls the watcher if it is due. Throws above the limit.
  void stop();
  void set_next_stop();

  static thread_local constinit inline ExactWork* current_ = nullptr;

  std::uint64_t done_ = 0;
  std::uint64_t next_stop_ = no_limit;
  std::uint64_t limit_ = no_limit, next_watch_ = no_limit, watch_every_ = 0;
  std::function<void()> watcher_;
  About::Subject subject_;
  std::unique_ptr<RecentFunctions> recent_;
};

}  // namespace kds
