# The README shows examples/first_run.cpp as it is.
file(READ "${ROOT}/README.md" readme)
file(READ "${ROOT}/examples/first_run.cpp" example)
string(FIND "${readme}" "```cpp\n${example}```" place)
if(place EQUAL -1)
  message(FATAL_ERROR "README.md does not show examples/first_run.cpp as it is")
endif()
