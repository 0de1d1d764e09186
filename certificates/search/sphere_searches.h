#pragma once
// Declares search_over for the certificates of balls in spheres. Code that makes tables of them includes this
// header, because a specialization must be declared before it is used.

#include "certificates/search/certificate_search.h"
#include "certificates/types/ball_in_sphere.h"

namespace kds {

template <>
std::unique_ptr<CertificateSearch<BallInSphere<2, 1>>> search_over(const MotionRef<2>& motion);
template <>
std::unique_ptr<CertificateSearch<BallInSphere<2, 2>>> search_over(const MotionRef<2>& motion);
template <>
std::unique_ptr<CertificateSearch<BallInSphere<2, 3>>> search_over(const MotionRef<2>& motion);
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 1>>> search_over(const MotionRef<3>& motion);
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 2>>> search_over(const MotionRef<3>& motion);
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 3>>> search_over(const MotionRef<3>& motion);
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 4>>> search_over(const MotionRef<3>& motion);

}  // namespace kds
