# scripts/packages has a complete row for each package that CMake looks for, and no other rows.
# cmake -DROOT=<source tree> -P check_packages.cmake
cmake_minimum_required(VERSION 3.25)
file(STRINGS "${ROOT}/scripts/packages" rows REGEX "^[^#]")
set(named "")
foreach(row IN LISTS rows)
  if(NOT row MATCHES "^(program|tests) +([^ ]+) +[^ ]+ +[^ ]+ +[^ ]+ +[^ ]+ +[^ ]+$")
    message(SEND_ERROR "scripts/packages: expected seven columns, the first of them program or tests: '${row}'")
  elseif(NOT CMAKE_MATCH_2 STREQUAL "-")
    list(APPEND named ${CMAKE_MATCH_2})
  endif()
endforeach()

file(READ "${ROOT}/CMakeLists.txt" text)
string(REGEX MATCHALL "kds_find_package[(][A-Za-z0-9_]+" found "${text}")
list(TRANSFORM found REPLACE ".*[(]" "")
list(APPEND found Doxygen)  # cmake/KdsDocs.cmake
list(SORT named)
list(SORT found)
if(NOT named STREQUAL found)
  message(SEND_ERROR "scripts/packages names '${named}', CMake looks for '${found}'")
endif()
