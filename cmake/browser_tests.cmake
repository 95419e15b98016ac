# The reports in a headless Chromium, as people meet them: tests/browser, where Chromium, node and
# playwright-core (npm ci in tests/browser; ./regoplan test does it) are there; else they skip,
# saying so.
set(browser_pages ${CMAKE_BINARY_DIR}/browser_pages)
set(browser_driver ${CMAKE_SOURCE_DIR}/tests/browser/run.sh)
# The demo's pages are those of the test that drives it (cmake/long_tests.cmake).
add_test(NAME Browser.MakesThePages COMMAND ${browser_driver} node make_pages.mjs
                                            $<TARGET_FILE:regoplan> ${CMAKE_SOURCE_DIR} ${browser_pages}
                                            ${CMAKE_BINARY_DIR}/demo)
set_tests_properties(Browser.MakesThePages PROPERTIES FIXTURES_SETUP browser_pages
                                                      FIXTURES_REQUIRED demo COST 60)
file(GLOB browser_tests CONFIGURE_DEPENDS tests/browser/*.test.mjs)
foreach(file ${browser_tests})
  get_filename_component(name ${file} NAME)
  string(REPLACE ".test.mjs" "" title ${name})
  add_test(NAME Browser.${title} COMMAND ${browser_driver} node --test ${name})
  set_tests_properties(
    Browser.${title} PROPERTIES FIXTURES_REQUIRED browser_pages
                                ENVIRONMENT REGOPLAN_PAGES=${browser_pages})
  list(APPEND browser_names Browser.${title})
endforeach()
set_tests_properties(Browser.MakesThePages ${browser_names}
                     PROPERTIES LABELS browser TIMEOUT 300 SKIP_RETURN_CODE 77)
# It holds in how long a page opens: beside other tests that would say how busy the machine is.
set_tests_properties(Browser.opens_soon PROPERTIES RUN_SERIAL ON)
