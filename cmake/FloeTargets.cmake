# How every room of floe is compiled, in one place.
include_guard()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

add_library(floe_options INTERFACE)
target_compile_options(floe_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                              $<$<BOOL:${FLOE_WERROR}>:-Werror>)
if(FLOE_SANITIZE)
  target_compile_options(floe_options INTERFACE -fsanitize=${FLOE_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(floe_options INTERFACE -fsanitize=${FLOE_SANITIZE})
  # Eigen takes the sanitizer's malloc for less aligned than it is, and would free what a Ceres built without
  # sanitizers has allocated in a way of its own.
  target_compile_definitions(floe_options INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

# Files of a target compiled together, so many at a time: headers are read once for all of them. Names in
# anonymous namespaces must then differ between the files.
function(floe_compile_together target files_at_a_time)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${files_at_a_time})
  # Said of types of anonymous namespaces in any file that another one includes.
  target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
endfunction()

# floe_room(NAME SOURCES ... DEPENDS ...): a static library floe::NAME. Headers are included by
# their path from the project's root, e.g. "geometry/detector.h".
function(floe_room name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(floe_${name} STATIC ${ARG_SOURCES})
  add_library(floe::${name} ALIAS floe_${name})
  target_include_directories(floe_${name} PUBLIC "${PROJECT_SOURCE_DIR}")
  target_link_libraries(floe_${name} PUBLIC ${ARG_DEPENDS} PRIVATE floe_options)
endfunction()

# floe_embed(TARGET FILE...): text files that become constants of the program, named after the file: page.js is
# floe::page_js, a std::string_view to be declared where it is used.
function(floe_embed target)
  foreach(file ${ARGN})
    get_filename_component(base "${file}" NAME)
    string(MAKE_C_IDENTIFIER "${base}" name)
    set(source "${CMAKE_CURRENT_SOURCE_DIR}/${file}")
    set(made "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp")
    add_custom_command(OUTPUT "${made}"
      COMMAND ${CMAKE_COMMAND} "-DSOURCE=${source}" "-DTARGET=${made}" "-DNAME=${name}"
              -P "${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake"
      DEPENDS "${source}" "${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake" VERBATIM)
    target_sources(${target} PRIVATE "${made}")
  endforeach()
endfunction()

# What all code of tests is compiled with. It calls what is optimised, and is compiled in two thirds of the
# time when it is not optimised as much itself.
function(floe_is_test_code target)
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${target} PRIVATE floe_options GTest::gtest)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  # Tests that compare with files outside the project look for them here, and are skipped without.
  target_compile_definitions(${target} PRIVATE FLOE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                               FLOE_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
endfunction()

# floe_test(NAME LABEL unit|physics|regression|app SOURCES ... DEPENDS ...): one GoogleTest
# program, registered as one CTest test with the label and a time limit.
function(floe_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  floe_is_test_code(${name})
  floe_compile_together(${name} 6)
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS} GTest::gtest_main)
  add_test(NAME ${name} COMMAND ${name})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABEL}" TIMEOUT ${ARG_TIMEOUT})
endfunction()
