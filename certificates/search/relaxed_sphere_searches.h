#pragma once
// Declares search_over for the certificates of balls in relaxed spheres, for code that makes tables of them.

#include "certificates/search/certificate_search.h"
#include "certificates/types/ball_in_sphere.h"

namespace kds {

template <>
std::unique_ptr<CertificateSearch<BallInSphere<2, 1, true>>> search_over(const MotionRef<2>& motion);
template <>
std::unique_ptr<CertificateSearch<BallInSphere<2, 2, true>>> search_over(const MotionRef<2>& motion);
template <>
std::unique_ptr<CertificateSearch<BallInSphere<2, 3, true>>> search_over(const MotionRef<2>& motion);
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 1, true>>> search_over(const MotionRef<3>& motion);
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 2, true>>> search_over(const MotionRef<3>& motion);
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 3, true>>> search_over(const MotionRef<3>& motion);
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 4, true>>> search_over(const MotionRef<3>& motion);

}  // namespace kds
