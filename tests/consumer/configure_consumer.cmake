# Configures a copy of the consumer's project with kds as a folder of it and builds nothing. Then checks how
# the consumer's own file would be compiled: with the flags that kds requires, and without flags that concern
# only the development of kds.
# cmake -DKDS_SOURCE=<source tree> -DGENERATOR=<generator> -DCOMPILER=<c++> -DPLACE=<folder>
#   -P configure_consumer.cmake
file(REMOVE_RECURSE "${PLACE}")
file(COPY "${CMAKE_CURRENT_LIST_DIR}/" DESTINATION "${PLACE}/source")
execute_process(COMMAND ${CMAKE_COMMAND} -S "${PLACE}/source" -B "${PLACE}/build" -G "${GENERATOR}"
                        "-DKDS_SOURCE=${KDS_SOURCE}" "-DCMAKE_CXX_COMPILER=${COMPILER}"
                RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(failed)
  message(FATAL_ERROR "configuring failed:\n${output}")
endif()

file(READ "${PLACE}/build/compile_commands.json" commands)
string(JSON count LENGTH "${commands}")
math(EXPR last "${count} - 1")
set(own "")
foreach(i RANGE ${last})
  string(JSON file GET "${commands}" ${i} file)
  string(JSON command GET "${commands}" ${i} command)
  if(file STREQUAL "${PLACE}/source/consumer.cpp")
    set(own "${command}")
  elseif(file MATCHES "^${KDS_SOURCE}/(tests|examples)/")
    message(SEND_ERROR "${file} is built in somebody else's project")
  endif()
endforeach()
if(NOT own)
  message(FATAL_ERROR "no command compiles consumer.cpp")
endif()
foreach(needed "-std=(gnu|c)[+][+]20" "-ffp-contract=off" "-I${KDS_SOURCE} " "-Wno-psabi")
  if(NOT own MATCHES "${needed}")
    message(SEND_ERROR "consumer.cpp would be compiled without ${needed}: ${own}")
  endif()
endforeach()
foreach(ours "-Wall" "-Wextra" "-Werror" "-Wpedantic" "-Wshadow" "-O[1-3]" "-fsanitize")
  if(own MATCHES "${ours}")
    message(SEND_ERROR "consumer.cpp would be compiled with ${ours}, which is ours: ${own}")
  endif()
endforeach()
