# Options and functions that all targets of the project share.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_SCAN_FOR_MODULES OFF)  # there are no modules, and clang scans with a tool of another package
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without these two settings, ccache does not cache files with a precompiled header. No source uses __TIME__.
  set(CMAKE_CXX_COMPILER_LAUNCHER
    "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE_PROGRAM}")
endif()

# Requirements of users: C++20, the include folder, and no fused multiply-add (-ffp-contract=off), because the filters' error
# bounds assume that products are rounded before they are added.
add_library(kds_requirements INTERFACE)
target_compile_features(kds_requirements INTERFACE cxx_std_20)
target_include_directories(kds_requirements INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>")
target_compile_options(kds_requirements INTERFACE -ffp-contract=off)
# Vectors of four doubles are passed between inlined functions only (motions/numbers/lanes.h), so differences between the
# calling conventions of compilers do not matter.
target_compile_options(kds_requirements INTERFACE -Wno-psabi)

# Loops over lanes (motions/numbers/lanes.h) are compiled for AVX2, which x86-64 processors have since about 2013. With
# KDS_ANY_PROCESSOR they are compiled a second time for processors without AVX2, which doubles their compile time.
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

# Options of this project only, not of its users.
add_library(kds_options INTERFACE)
target_link_libraries(kds_options INTERFACE kds_requirements)
# By default g++ collects garbage from 128 MB on, which takes a tenth of its time. None of the files uses two gigabytes.
target_compile_options(kds_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=2000000>)
target_compile_options(kds_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wextra-semi)
if(KDS_TOGETHER)
  # In a unity build, g++ takes the local declarations of a source file for declarations of a header.
  target_compile_options(kds_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
if(KDS_ANY_PROCESSOR)
  # Lanes stay uninitialized until they are set (motions/numbers/lanes.h). Without vectors, g++ 12 warns of this wrongly.
  target_compile_options(kds_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()
if(KDS_WERROR)
  target_compile_options(kds_options INTERFACE -Werror)
endif()
if(KDS_SANITIZE)
  # The address sanitizer finds bad pointers. Checking each pointer for null and alignment too would take at least a quarter of
  # the compile time. Checking pointer arithmetic for overflow doubles the compile time of files of lanes. Only the motions
  # library has that check, because its readers compute addresses from the bytes of files.
  set(reads_files "$<STREQUAL:$<TARGET_PROPERTY:NAME>,kds_motions>")
  target_compile_options(kds_options INTERFACE -fsanitize=${KDS_SANITIZE} -fno-sanitize=null,alignment,object-size
                                               "$<$<NOT:${reads_files}>:-fno-sanitize=pointer-overflow>"
                                               -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(kds_options INTERFACE -fsanitize=${KDS_SANITIZE})
endif()

# kds_add_library(<name> [FOLDER folder] [EXCEPT regex] [PRIVATE_HEADERS regex] [PUBLIC deps ...] [PRIVATE deps ...])
# Adds one library with all files of a folder. The target all_verify_interface_header_sets compiles each header alone, except
# PRIVATE_HEADERS, which only the folder's own files may include, and headers that their own source file includes first. The
# preset debug finds an include that such a header lacks, because it does not precompile headers.
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

# kds_precompile(<target> <header>... | REUSE_FROM <target>): precompiles headers of other projects that most files of the target
# include. This only saves time: each file includes the headers it uses, and also compiles with
# CMAKE_DISABLE_PRECOMPILE_HEADERS. A target or file with other compile options needs its own precompiled headers or none
# (SKIP_PRECOMPILE_HEADERS), because g++ accepts foreign ones and with them some of their options.
function(kds_precompile target)
  if(ARGV1 STREQUAL "REUSE_FROM")
    target_precompile_headers(${target} ${ARGN})
  else()
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
  # ccache requires these options.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)
  elseif(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(${target} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
  endif()
endfunction()

# kds_compile_together(<target> <group> <pattern>...): compiles files that use the same library templates in one compiler run (a
# unity build). Files without a group are compiled alone. With -DKDS_TOGETHER=OFF all files are compiled alone, which finds
# missing includes. If several groups name a file, the last one has it.
function(kds_compile_together target group)
  file(GLOB files CONFIGURE_DEPENDS RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" ${ARGN})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${KDS_TOGETHER} UNITY_BUILD_MODE GROUP)
  set_source_files_properties(${files} PROPERTIES UNITY_GROUP ${group})
endfunction()
