# Each file of tests/ and each example is a test of its own, with Debian's pytest.
execute_process(COMMAND ${Python_EXECUTABLE} -c "import pytest" RESULT_VARIABLE no_pytest OUTPUT_QUIET
                ERROR_QUIET)
file(GLOB test_files CONFIGURE_DEPENDS tests/test_*.py)
foreach(file ${test_files})
  get_filename_component(name ${file} NAME_WE)
  string(REPLACE "test_" "" name ${name})
  if(no_pytest STREQUAL "0")
    add_test(NAME python.${name} COMMAND ${Python_EXECUTABLE} -m pytest -q -rs -p no:cacheprovider ${file})
  else()
    add_test(NAME python.${name} COMMAND ${CMAKE_COMMAND} -E echo "skipped: no pytest (Debian: python3-pytest)")
  endif()
  list(APPEND names python.${name})
endforeach()
file(GLOB examples CONFIGURE_DEPENDS examples/*.py)
foreach(file ${examples})
  get_filename_component(name ${file} NAME_WE)
  add_test(NAME python.example.${name} COMMAND ${Python_EXECUTABLE} ${file}
           WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  list(APPEND names python.example.${name})
endforeach()
if(names)
  set_tests_properties(
    ${names}
    PROPERTIES LABELS python TIMEOUT 300 SKIP_REGULAR_EXPRESSION "^skipped: " ENVIRONMENT
               "PYTHONPATH=${CMAKE_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;REGOPLAN_PROGRAM=$<TARGET_FILE:regoplan>;REGOPLAN_SOURCE_DIR=${PROJECT_SOURCE_DIR};REGOPLAN_BUILD_DIR=${CMAKE_BINARY_DIR}")
  if("python.commands" IN_LIST names)
    set_tests_properties(python.commands PROPERTIES COST 20)  # long: starts first (cmake/long_tests.cmake)
  endif()
endif()
