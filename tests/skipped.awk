# The tests that CTest's log says were skipped, and why: CTest itself tells no more than their names.
function told(why) {
  if (!count++) print "Skipped, and why:"
  print "  " test ": " why
}
/^[0-9]+\/[0-9]+ Test: / { test = $3 }
/^skipped: / { told(substr($0, 10)) }                     # a script
/^SKIPPED \[/ { told($0) }                                # pytest, in a file that passes
inside && /^\[  SKIPPED \]/ { test = $4; told(reason); inside = 0 }  # GoogleTest
inside { reason = reason (reason == "" ? "" : "\n    ") $0 }
/: Skipped$/ { inside = 1; reason = "" }
