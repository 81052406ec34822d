// How many threads work on something.
#pragma once

#include <omp.h>

namespace floe {

// As many as are asked for; 0: one for each core that this process may use.
inline int thread_count(int asked) {
  return asked > 0 ? asked : omp_get_num_procs();
}

}  // namespace floe
