# What every target of the project shares.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without the two, ccache keeps nothing that uses a precompiled header; none of our sources asks what time it is.
  set(CMAKE_CXX_COMPILER_LAUNCHER
    "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE_PROGRAM}")
endif()

# What a consumer needs: C++20, the folders' includes, and products that are rounded before they are added, as the error
# bounds of the filters have it.
add_library(kds_requirements INTERFACE)
target_compile_features(kds_requirements INTERFACE cxx_std_20)
target_include_directories(kds_requirements INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>")
target_compile_options(kds_requirements INTERFACE -ffp-contract=off)
# Vectors of four doubles are passed between inlined functions only (motions/numbers/lanes.h): that other compilers pass them
# in other ways concerns nobody.
target_compile_options(kds_requirements INTERFACE -Wno-psabi)

# Loops over lanes (motions/numbers/lanes.h) are compiled for AVX2, which x86-64 processors have since about 2013. For others they
# are compiled once more, without vectors: code that takes as long to compile again and that hardly anybody runs.
include(CheckCXXSourceRuns)
if(NOT CMAKE_CROSSCOMPILING)
  check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") ? 0 : 1; }" KDS_HERE_IS_AVX2)
endif()
if(KDS_HERE_IS_AVX2)
  set(KDS_HERE_IS_NO_AVX2 OFF)
else()
  set(KDS_HERE_IS_NO_AVX2 ON)
endif()
option(KDS_ANY_PROCESSOR "Serve processors without AVX2, too" ${KDS_HERE_IS_NO_AVX2})
if(NOT KDS_ANY_PROCESSOR)
  target_compile_definitions(kds_requirements INTERFACE KDS_NEEDS_AVX2)
  set(KDS_PKGCONFIG_DEFINITIONS " -DKDS_NEEDS_AVX2")
endif()

# What is ours alone.
add_library(kds_options INTERFACE)
target_link_libraries(kds_options INTERFACE kds_requirements)
# g++ collects its garbage from 128 MB on: a tenth of its time. No file of ours has two gigabytes of it.
target_compile_options(kds_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=2000000>)
target_compile_options(kds_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wextra-semi)
if(KDS_TOGETHER)
  # What a file that is compiled with others declares for itself alone looks as if it were a header's.
  target_compile_options(kds_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
if(KDS_ANY_PROCESSOR)
  # Lanes are left as they are until they are set (motions/numbers/lanes.h), which g++ 12 does not see where there are no vectors.
  target_compile_options(kds_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()
if(KDS_WERROR)
  target_compile_options(kds_options INTERFACE -Werror)
endif()
if(KDS_SANITIZE)
  # Bad pointers are the address sanitizer's; checking each for null and alignment as well takes a quarter of the time to
  # compile, and more.
  target_compile_options(kds_options INTERFACE -fsanitize=${KDS_SANITIZE} -fno-sanitize=null,alignment,object-size
                                               -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(kds_options INTERFACE -fsanitize=${KDS_SANITIZE})
endif()

# kds_add_library(<name> [FOLDER folder] [EXCEPT regex] [PRIVATE_HEADERS regex] [PUBLIC deps ...] [PRIVATE deps ...])
# One library a folder, of all that is in it. Each header is compiled alone by the target all_verify_interface_header_sets,
# but for those that only the folder's own files may include and those that their own source file includes first. What such a
# one forgot to include, because it is precompiled, preset debug shows.
function(kds_add_library name)
  cmake_parse_arguments(ARG "" "FOLDER;EXCEPT;PRIVATE_HEADERS" "PUBLIC;PRIVATE" ${ARGN})
  if(NOT ARG_FOLDER)
    set(ARG_FOLDER ${name})
  endif()
  set(folder "${PROJECT_SOURCE_DIR}/${ARG_FOLDER}")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${folder}/*.cpp")
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS "${folder}/*.h")
  if(ARG_EXCEPT)
    list(FILTER sources EXCLUDE REGEX "${ARG_EXCEPT}")
  endif()
  if(ARG_PRIVATE_HEADERS)
    list(FILTER headers EXCLUDE REGEX "${ARG_PRIVATE_HEADERS}")
  endif()
  add_library(kds_${name} STATIC ${sources})
  add_library(kds::${name} ALIAS kds_${name})
  set_target_properties(kds_${name} PROPERTIES EXPORT_NAME ${name})
  set(compiled_with_source)
  foreach(header IN LISTS headers)
    string(REGEX REPLACE "[.]h$" ".cpp" source "${header}")
    if(source IN_LIST sources)
      list(APPEND compiled_with_source "${header}")
    endif()
  endforeach()
  if(compiled_with_source)
    list(REMOVE_ITEM headers ${compiled_with_source})
    target_sources(kds_${name} PUBLIC FILE_SET with_source TYPE HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}"
                                      FILES ${compiled_with_source})
  endif()
  target_sources(kds_${name} PUBLIC FILE_SET alone TYPE HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}" FILES ${headers})
  set_target_properties(kds_${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON INTERFACE_HEADER_SETS_TO_VERIFY alone)
  target_link_libraries(kds_${name} PUBLIC kds_requirements ${ARG_PUBLIC} PRIVATE kds_options ${ARG_PRIVATE})
endfunction()

# kds_precompile(<target> <header>... | REUSE_FROM <target>): headers of others that most files of the target include, parsed
# once for all of them. Only a saving: each file includes what it uses, and compiles as well with
# CMAKE_DISABLE_PRECOMPILE_HEADERS. A target, or a file, that is compiled with other options has headers of its own or none
# (SKIP_PRECOMPILE_HEADERS): g++ takes them all the same, and with them some of the options that they were compiled with.
function(kds_precompile target)
  if(ARGV1 STREQUAL "REUSE_FROM")
    target_precompile_headers(${target} ${ARGN})
  else()
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
  # ccache asks for these.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)
  elseif(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(${target} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
  endif()
endfunction()

# kds_compile_together(<target> <group> <pattern>...): one compiler run for files that use the same library templates. A file that
# is in no group is compiled alone, and so is each with -DKDS_TOGETHER=OFF, which shows what a file forgot to include. The
# last group that names a file has it.
function(kds_compile_together target group)
  file(GLOB files CONFIGURE_DEPENDS RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" ${ARGN})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${KDS_TOGETHER} UNITY_BUILD_MODE GROUP)
  set_source_files_properties(${files} PROPERTIES UNITY_GROUP ${group})
endfunction()
