# find_package(kds) in a build tree of kds: the target kds::kds, and all libraries behind it, as they have been built there.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3)
find_dependency(Boost 1.74)
find_dependency(TBB)
find_dependency(ZLIB)
find_dependency(fmt)
include("${CMAKE_CURRENT_LIST_DIR}/kdsTargets.cmake")
