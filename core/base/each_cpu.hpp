// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Compiles inner loops for several generations of a processor family; the loader selects the
// version for the CPU.

#if defined(__x86_64__)
#define CLATTER_EACH_CPU \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define CLATTER_EACH_CPU
#endif
