# Configuring names each missing package in one line, with its names on several systems.
# cmake -DROOT=<source tree> -DGENERATOR=<generator> -DCOMPILER=<c++> -DPLACE=<folder> -P check_missing.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE "${PLACE}")
execute_process(COMMAND ${CMAKE_COMMAND} -S "${ROOT}" -B "${PLACE}" -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${COMPILER}"
                        -DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON -DCMAKE_DISABLE_FIND_PACKAGE_KdsGemmi=ON
                RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE errors)
if(NOT failed)
  message(FATAL_ERROR "configures without fmt and gemmi")
endif()
foreach(line "kds needs fmt: Debian libfmt-dev, Fedora fmt-devel, Arch fmt, Homebrew fmt, conda-forge fmt\n"
             "kds needs gemmi: Debian gemmi-dev, Fedora gemmi-devel, ")
  string(FIND "${errors}" "${line}" at)
  if(at EQUAL -1)
    message(SEND_ERROR "no line '${line}' in:\n${errors}")
  endif()
endforeach()
if(errors MATCHES "kds needs CGAL")
  message(SEND_ERROR "CGAL is there, but said to be missing:\n${errors}")
endif()
