# Which tests of GoogleTest passed, and how many, where CTest runs a suite at once (its log tells them).
/^\[       OK \]/ { print "passed " $4, $5, $6; count++ }
END { print count + 0 " tests of GoogleTest passed" }
