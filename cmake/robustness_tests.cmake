# A little of the campaigns of benchmarks/robustness with every run of the tests: mutated input for
# each reader, and a few kills of the commands that are quick.
# Sanitizers see what a release would only suffer: they get the time, a release shows that it runs.
set(mutation_s 0.3)
if(REGOPLAN_DEV)
  set(mutation_s 3)
endif()
foreach(reader ${REGOPLAN_READERS})
  add_test(NAME robustness.${reader}
           COMMAND mutation_campaign ${reader} --seconds ${mutation_s} --runs 20000
                   --keep ${CMAKE_BINARY_DIR}/robustness-findings)
  set_tests_properties(robustness.${reader} PROPERTIES LABELS robustness TIMEOUT 120)
endforeach()
if(Python3_FOUND AND NOT REGOPLAN_DEV)
  add_test(NAME robustness.kills
           COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/benchmarks/robustness/kill_campaign.py
                   --program $<TARGET_FILE:regoplan> --kills 4 "map make" "map import" wheel
                   "wheel figures" evaluate drive)
  set_tests_properties(robustness.kills PROPERTIES LABELS robustness TIMEOUT 300)
endif()
