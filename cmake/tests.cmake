# One test program a folder of the house: tests/<folder>/*_test.cpp. Tests run from the source
# root, find measured data through REGOPLAN_DATA and skip, saying so, where they are absent.
include(GoogleTest)

# Each suite is one of CTest's: a program with OMPL and GDAL takes .07 s to start, longer than most tests
# do, and what a suite sets up is made once for all that look at it. Of suites in <folder>_long, each test is
# one of CTest's, run by itself, so that two processors share them; and so are all tests of a program
# that starts at once. Under sanitizers every suite is one: a program of theirs takes .1 s to start, and ends
# with a search for leaks.
set(app_long BenchmarkProgram DemoProgram Diagnose DiagnosisReportInTheBrowser DriveDiagnosisProgram
             Evaluate Faults PlanReportInTheBrowser Schemas Slurm)
set(planner_long All/EveryPlanner Evaluation Plan RelaxedProblem)
set(drive_diagnosis_long ColumnsOfWheels TorqueSign VehicleEffects)
set(journeys_long ALL)
set(diagnosis_long ALL)
set(diagnosis_challenge_long ALL)
set(terramech_long ALL)
function(regoplan_tests folder)
  file(GLOB sources CONFIGURE_DEPENDS tests/${folder}/*.cpp)
  add_executable(${folder}_tests ${sources})
  target_compile_definitions(${folder}_tests PRIVATE REGOPLAN_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  target_link_libraries(${folder}_tests PRIVATE regoplan_options ${ARGN} GTest::gtest_main)
  # Where all sources are one unit (CMAKE_UNITY_BUILD_BATCH_SIZE), the header is read once anyway.
  list(LENGTH sources count)
  if(count GREATER 8)
    target_precompile_headers(${folder}_tests PRIVATE <gtest/gtest.h>)
  endif()
  # What takes time is in the libraries; tests compile a third faster so.
  target_compile_options(${folder}_tests PRIVATE -O1)
  set(by_itself ${${folder}_long})
  if(REGOPLAN_DEV)
    set(by_itself "")
  endif()
  if(NOT "ALL" IN_LIST by_itself)
    file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/${folder}_suites.cmake CONTENT
         "include(${CMAKE_SOURCE_DIR}/cmake/suites.cmake)
regoplan_add_suites($<TARGET_FILE:${folder}_tests> ${folder} ${CMAKE_SOURCE_DIR} ${by_itself})\n")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES
                 ${CMAKE_BINARY_DIR}/${folder}_suites.cmake)
  endif()
  if(by_itself)
    set(filter "")
    if(NOT "ALL" IN_LIST by_itself)
      list(JOIN by_itself ".*:" filter)
      set(filter "${filter}.*")
    endif()
    gtest_discover_tests(${folder}_tests WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
                         TEST_FILTER "${filter}"
                         PROPERTIES TIMEOUT 600 LABELS ${folder} DISCOVERY_TIMEOUT 60)
  endif()
endfunction()

regoplan_tests(terramech regoplan_terramech)
regoplan_tests(driving regoplan_driving)
regoplan_tests(diagnosis regoplan_diagnosis)
regoplan_tests(diagnosis_challenge regoplan_challenge)
regoplan_tests(drive_diagnosis regoplan_drive_diagnosis)
regoplan_tests(maps regoplan_maps GDAL::GDAL)
regoplan_tests(planner regoplan_planner regoplan_random_problem ompl::ompl)
regoplan_tests(benchmarking regoplan_benchmarking nlohmann_json::nlohmann_json SQLite::SQLite3)
# Whole journeys over large maps: too long for a build with sanitizers.
regoplan_tests(journeys regoplan_app)
regoplan_tests(app regoplan_app nlohmann_json::nlohmann_json yaml-cpp SQLite::SQLite3)
# The command line is tested as a person uses it: as a program.
add_dependencies(app_tests regoplan)
# Files and options do not wait for the optimiser, and build in two thirds of the time.
target_compile_options(app_tests PRIVATE -O0)
if(REGOPLAN_DEV)
  target_compile_options(regoplan_app PRIVATE -O0)
endif()
target_compile_definitions(app_tests PRIVATE REGOPLAN_PROGRAM="$<TARGET_FILE:regoplan>")

add_test(NAME include_directions COMMAND ${CMAKE_COMMAND} -DROOT=${CMAKE_SOURCE_DIR} -P
                                         ${CMAKE_SOURCE_DIR}/cmake/include_directions.cmake)
add_test(NAME type_names COMMAND ${CMAKE_COMMAND} -DROOT=${CMAKE_SOURCE_DIR} -P
                                 ${CMAKE_SOURCE_DIR}/cmake/type_names.cmake)
find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
  add_test(NAME clang_tidy.manifest COMMAND ${Python3_EXECUTABLE}
                                            ${CMAKE_SOURCE_DIR}/tests/tooling/clang_tidy_test.py)
endif()
if(Python3_FOUND AND NOT REGOPLAN_DEV)
  # Some scripts take numpy or yaml: an interpreter that has them, where there is one.
  set(script_python ${Python3_EXECUTABLE})
  foreach(candidate ${Python3_EXECUTABLE} /usr/bin/python3)
    execute_process(COMMAND ${candidate} -c "import numpy, yaml" RESULT_VARIABLE failed OUTPUT_QUIET
                    ERROR_QUIET)
    if(failed STREQUAL "0")
      set(script_python ${candidate})
      break()
    endif()
  endforeach()
  add_test(NAME benchmark_scripts COMMAND ${script_python}
                                          ${CMAKE_SOURCE_DIR}/tests/tooling/benchmark_scripts_test.py
                                          $<TARGET_FILE:regoplan>)
  set_tests_properties(benchmark_scripts PROPERTIES TIMEOUT 120)
endif()
include(cmake/browser_tests.cmake)
include(cmake/robustness_tests.cmake)

# The package as others take it: found installed, as a subfolder, and the program from a prefix.
if(NOT REGOPLAN_DEV)
  set(package_ways find_package add_subdirectory program)
  find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
  if(DPKG_SHLIBDEPS)
    list(APPEND package_ways deb)
  endif()
  foreach(how ${package_ways})
    add_test(NAME package.${how}
             COMMAND ${CMAKE_SOURCE_DIR}/tests/package/run.sh ${how} ${CMAKE_BINARY_DIR}
                     ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}/package/${how})
    set_tests_properties(package.${how} PROPERTIES LABELS package TIMEOUT 900 COST 50)
  endforeach()
  add_test(NAME package.newer_ompl
           COMMAND ${CMAKE_COMMAND} -S ${CMAKE_SOURCE_DIR}/tests/package/newer_ompl -B
                   ${CMAKE_BINARY_DIR}/package/newer_ompl -DREGOPLAN_SOURCE=${CMAKE_SOURCE_DIR})
  set_tests_properties(package.newer_ompl PROPERTIES LABELS package)
endif()

# After the tests that their programs list, which are read in the same way.
configure_file(cmake/long_tests.cmake ${CMAKE_BINARY_DIR}/long_tests.cmake @ONLY)
set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_BINARY_DIR}/long_tests.cmake)
