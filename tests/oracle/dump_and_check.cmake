# Runs `kds run` with dumps and with audits at frames, then judges the dumps by check_dumps:
#   cmake -DKDS=<program> -DCHECK=<check_dumps> -DSCRATCH=<directory of its own> "-DRUN=<arguments of kds run>"
#         "-DINPUT=<the same input in the words of check_dumps>" ["-DGENERATE=<arguments of kds generate>"]
#         -P dump_and_check.cmake
cmake_minimum_required(VERSION 3.25)

foreach(needed KDS CHECK SCRATCH RUN INPUT)
  if(NOT DEFINED ${needed} OR "${${needed}}" STREQUAL "")
    message(FATAL_ERROR "-D${needed}=... is missing")
  endif()
endforeach()

function(must_succeed)
  string(JOIN " " line ${ARGN})
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  message("${line}\n${errors}${output}")
  if(NOT result STREQUAL "0")
    file(REMOVE_RECURSE "${SCRATCH}")
    message(FATAL_ERROR "${line}\nended with ${result}")
  endif()
  set(said "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
file(MAKE_DIRECTORY "${SCRATCH}")
if(GENERATE)
  must_succeed("${KDS}" generate ${GENERATE} --quiet)
endif()
must_succeed("${KDS}" run ${RUN} --audit frames --dump "${SCRATCH}/dump" --quiet)
must_succeed("${CHECK}" --dump "${SCRATCH}/dump" ${INPUT})
file(REMOVE_RECURSE "${SCRATCH}")
# A run that checks nothing would also succeed, so the counts must not be zero.
if(NOT said MATCHES "^[1-9][0-9]* frames, [1-9][0-9]* cells, [1-9][0-9]* nodes .* 0 mismatches\n$")
  message(FATAL_ERROR "check_dumps looked at no frames, no cells or no nodes:\n${said}")
endif()
