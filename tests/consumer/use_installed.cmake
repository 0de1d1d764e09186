# Installs kds from its build tree into a prefix, moves the prefix elsewhere, and configures, builds and runs
# three users' projects with it: one with the engine alone, the first example, and one with structures. Then
# compiles the last project by pkg-config, if pkg-config is available.
# cmake -DKDS_BUILD=<build tree> -DGENERATOR=<generator> -DCOMPILER=<c++> -DBUILD_TYPE=<type> -DPLACE=<folder>
#   -P use_installed.cmake
file(REMOVE_RECURSE "${PLACE}")

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    message(FATAL_ERROR "${ARGN} failed:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect program events)
  run("${program}")
  if(NOT output STREQUAL "events: ${events}\n")
    message(FATAL_ERROR "${program}: expected ${events} events, got '${output}'")
  endif()
endfunction()

foreach(component motions certificates engine structures kds)
  run(${CMAKE_COMMAND} --install "${KDS_BUILD}" --prefix "${PLACE}/first" --component ${component})
endforeach()
file(RENAME "${PLACE}/first" "${PLACE}/prefix")

# The installed files must not name the build folder or the first prefix, and must not include headers that
# include CGAL or gemmi.
cmake_path(GET KDS_BUILD PARENT_PATH home)
file(GLOB_RECURSE texts "${PLACE}/prefix/*.cmake" "${PLACE}/prefix/*.pc" "${PLACE}/prefix/*.h")
if(NOT texts)
  message(FATAL_ERROR "nothing was installed")
endif()
foreach(file IN LISTS texts)
  file(READ "${file}" text)
  string(FIND "${text}" "${home}" at)
  if(NOT at EQUAL -1)
    message(SEND_ERROR "${file} says where it comes from: ${home}")
  endif()
  if(file MATCHES "[.]h$" AND text MATCHES "#include <(CGAL|gemmi|flint|tao|boost)/")
    message(SEND_ERROR "${file} includes ${CMAKE_MATCH_1}")
  endif()
endforeach()

file(COPY "${CMAKE_CURRENT_LIST_DIR}/" DESTINATION "${PLACE}/source")
function(build_project source name)
  run(${CMAKE_COMMAND} -S "${source}" -B "${PLACE}/${name}" -G "${GENERATOR}" "-DCMAKE_PREFIX_PATH=${PLACE}/prefix"
      "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}")
  run(${CMAKE_COMMAND} --build "${PLACE}/${name}")
  if(output MATCHES "warning:|note:")
    message(FATAL_ERROR "the compiler complains of kds:\n${output}")
  endif()
endfunction()
build_project("${PLACE}/source/engine_only" engine_only)
expect("${PLACE}/engine_only/engine_only" 1)
file(COPY "${CMAKE_CURRENT_LIST_DIR}/../../examples/first_run.cpp" DESTINATION "${PLACE}/source/first_run")
build_project("${PLACE}/source/first_run" first_run)
run("${PLACE}/first_run/first_run")
if(NOT output STREQUAL "flips: 1\n")
  message(FATAL_ERROR "first_run: expected 'flips: 1', got '${output}'")
endif()
build_project("${PLACE}/source" structures)
expect("${PLACE}/structures/consumer" 3)

find_program(PKG_CONFIG pkg-config)
if(PKG_CONFIG AND NOT SANITIZE)
  set(ENV{PKG_CONFIG_PATH} "${PLACE}/prefix/lib/pkgconfig")
  run(${PKG_CONFIG} --cflags --libs kds)
  separate_arguments(flags UNIX_COMMAND "${output}")
  # Inline vector code in headers must be compiled for the same processors as the libraries.
  file(GLOB_RECURSE targets "${PLACE}/prefix/*/kds-motions.cmake")
  file(STRINGS "${targets}" definitions REGEX "INTERFACE_COMPILE_DEFINITIONS")
  string(REGEX MATCHALL "KDS_[A-Z0-9_]+" by_cmake "${definitions}")
  string(REGEX MATCHALL "-DKDS_[A-Z0-9_]+" by_pkg_config "${output}")
  list(TRANSFORM by_pkg_config REPLACE "^-D" "")
  list(REMOVE_DUPLICATES by_pkg_config)
  if(NOT by_cmake STREQUAL by_pkg_config)
    message(FATAL_ERROR "CMake defines '${by_cmake}' for users, pkg-config '${by_pkg_config}'")
  endif()
  # Object files come before the libraries that they need.
  run(${COMPILER} -std=c++20 "${PLACE}/source/consumer.cpp" -o "${PLACE}/by_pkg_config" ${flags})
  expect("${PLACE}/by_pkg_config" 3)
endif()
