# Read by ctest before it runs: each suite of a GoogleTest program is one of CTest's tests, but for those
# named behind, of which each test is one (cmake/tests.cmake). GTEST_FILTER,
# such as -Suite.Test*:Other.*, leaves tests out as it does of the program. A suite of which one test
# was skipped is not called skipped: that would hide those of it that failed (tests/skipped.awk tells).
function(regoplan_add_suites program folder source_dir)
  if(NOT EXISTS ${program})
    add_test(${folder}_tests_NOT_BUILT ${folder}_tests_NOT_BUILT)
    return()
  endif()
  execute_process(COMMAND ${program} --gtest_list_tests WORKING_DIRECTORY ${source_dir}
                  OUTPUT_VARIABLE listed RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${program} does not list its tests: ${failed}")
  endif()
  string(REGEX MATCHALL "\n[A-Za-z0-9_/]+\\.[ \n]" suites "\n${listed}")
  foreach(suite ${suites})
    string(REGEX REPLACE "\\..|\n" "" suite "${suite}")
    list(FIND ARGN "${suite}" named)  # ctest knows no IN_LIST
    if(NOT named EQUAL -1)
      continue()
    endif()
    add_test(${suite} ${program} "--gtest_filter=${suite}.*$ENV{GTEST_FILTER}")
    set_tests_properties(${suite} PROPERTIES WORKING_DIRECTORY ${source_dir} LABELS ${folder}
                                             TIMEOUT 1800)
  endforeach()
endfunction()
