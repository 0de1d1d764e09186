# Configures, builds and runs a copy of the consumer's project with the kds that was built in KDS_BUILD.
# cmake -DKDS_BUILD=<build tree> -DGENERATOR=<generator> -DCOMPILER=<c++> -DBUILD_TYPE=<type> -DPLACE=<folder>
#   -P build_consumer.cmake
file(REMOVE_RECURSE "${PLACE}")
file(COPY "${CMAKE_CURRENT_LIST_DIR}/" DESTINATION "${PLACE}/source")

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    message(FATAL_ERROR "${ARGN} failed:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} -S "${PLACE}/source" -B "${PLACE}/build" -G "${GENERATOR}" "-Dkds_DIR=${KDS_BUILD}"
    "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}")
run(${CMAKE_COMMAND} --build "${PLACE}/build")
if(output MATCHES "warning:|note:")
  message(FATAL_ERROR "the consumer's compiler complains of kds:\n${output}")
endif()
run("${PLACE}/build/consumer")
if(NOT output STREQUAL "events: 3\n")
  message(FATAL_ERROR "expected 3 events, got '${output}'")
endif()
