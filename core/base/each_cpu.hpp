#pragma once
// Inner loops compiled for several generations of one processor family; the right one is chosen
// when the program starts.

#if defined(__x86_64__)
#define CLATTER_EACH_CPU \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define CLATTER_EACH_CPU
#endif
