#pragma once
// search_over for the certificates of beads in relaxed spheres: declared for whoever makes tables of them.
// Their first filter is a bound of the sphere's path (structures/moving_sphere), which leaves few: those are
// searched one by one.

#include "certificates/search/certificate_search.h"
#include "certificates/types/relaxed_bead_in_sphere.h"

namespace kds {

template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<2>>> search_over(const MotionRef<2>& motion);
template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<3>>> search_over(const MotionRef<2>& motion);
template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<2>>> search_over(const MotionRef<3>& motion);
template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<3>>> search_over(const MotionRef<3>& motion);
template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<4>>> search_over(const MotionRef<3>& motion);

}  // namespace kds
