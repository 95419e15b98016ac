#pragma once

/// One build serves every x86-64: a function so marked is compiled for the plain instruction set,
/// for AVX2 (x86-64-v3) and for AVX-512 (x86-64-v4), and the machine chooses when the program is
/// loaded. The same machine always gives the same bits; machines with and without AVX2 differ by
/// rounding, as the former fuse (CMakeLists.txt). REGOPLAN_PLAIN_VECTORS leaves the plain
/// instruction set alone. So do sanitizers: what chooses would run before they have begun. So does
/// clang, which makes no clone that other sources can be linked with.
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(REGOPLAN_PLAIN_VECTORS)
#define REGOPLAN_VECTOR_CLONES \
  __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define REGOPLAN_VECTOR_CLONES
#endif
