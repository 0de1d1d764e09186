#pragma once
// An invented small run with every kind of figure that a report shows.

#include <initializer_list>

#include "experiments/run/run_report.h"

namespace kds::test {

/// Starts at frame 0.
inline EventCourse course_of(std::initializer_list<std::uint64_t> events) {
  EventCourse course;
  for (const std::uint64_t count : events) course.add(count, {course.steps(), {}});
  return course;
}

inline RunReport sample_report() {
  StructureReport wrapped;
  wrapped.name = "wrapped";
  wrapped.events_total = 6;
  wrapped.events_by_kind = {{"enter", 3}, {"leave", 2}, {"pivot", 1}};
  wrapped.course = course_of({1, 2, 3});
  wrapped.created = 1234567;
  wrapped.never_failing = 1234000;
  wrapped.cancelled = 500;
  wrapped.failed = 67;
  wrapped.peak = 89;
  wrapped.per_bead_max = 11;
  wrapped.stages = {
      {"coefficients", 1000000}, {"isolation", 234567}, {"signs_double", 77}, {"largest_bits", 54}};
  wrapped.seconds = 0.5;
  wrapped.build_seconds = 0.25;
  wrapped.static_seconds = 2;
  wrapped.audits_run = 4;

  StructureReport power;
  power.name = "power";
  power.events_total = 30;
  power.events_by_kind = {{"2-3", 17}, {"3-2", 13}, {"wander", 5}};
  power.internal_kinds = {"wander"};
  power.course = course_of({10, 0, 20});
  power.stages = {{"coefficients", 40}, {"exact", 2}};
  power.rebuilds = 1;

  RunReport report;
  report.files = {"chain.pdb"};
  report.beads = 36;
  report.frames = 4;
  report.radius_min = report.radius_max = 1.5;
  report.settings = {{"motion", "linear"}, {"kernel", "filtered"}};
  report.structures = {wrapped, power};
  report.engine_seconds = 0.125;
  report.listeners_seconds = 0.0625;
  report.comparisons = {{"exact", 7}, {"ties", 2}};
  report.fingerprint = 0xabcdef;
  return report;
}

}  // namespace kds::test
