#include "bench/vector_costs.h"

#include <cmath>

#include "propagation/engine/random.h"
#include "propagation/engine/vector_math.h"

namespace floe::vector_costs {

void fill(Data& data) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < lanes; ++i) {
    data.in[i] = random.uniform();
    data.out[i] = 0;
    data.random0[i] = random.bits();
    data.random1[i] = random.bits();
    data.random2[i] = random.bits();
    data.random3[i] = random.bits() | 1;
    data.index[i] = static_cast<std::int32_t>(random.bits() % table_size);
  }
  for (float& value : data.table) value = random.uniform();
  for (TableRow& row : data.rows)
    for (float& value : row.values) value = random.uniform();
}

void random_numbers(Data& data) {
#pragma omp simd
  for (int i = 0; i < lanes; ++i)
    data.out[i] = RandomStream::to_uniform(
        RandomStream::next(data.random0[i], data.random1[i], data.random2[i], data.random3[i]));
}

void logarithms(Data& data) {
#pragma omp simd
  for (int i = 0; i < lanes; ++i) data.out[i] = natural_log(data.in[i]);
}

void exponentials(Data& data) {
#pragma omp simd
  for (int i = 0; i < lanes; ++i) data.out[i] = decay(-data.in[i]);
}

void sines_and_cosines(Data& data) {
#pragma omp simd
  for (int i = 0; i < lanes; ++i) {
    const TurnFunctions<float> turn = turn_functions(data.in[i]);
    data.out[i] = turn.sine + 2 * turn.cosine;
  }
}

void square_roots(Data& data) {
#pragma omp simd
  for (int i = 0; i < lanes; ++i) data.out[i] = std::sqrt(data.in[i]);
}

void divisions(Data& data) {
#pragma omp simd
  for (int i = 0; i < lanes; ++i) data.out[i] = 1 / data.in[i];
}

void table_lookups(Data& data) {
  const float* table = data.table;
#pragma omp simd
  for (int i = 0; i < lanes; ++i) data.out[i] = table[data.index[i]];
}

void table_rows(Data& data) {
  fetch_rows(data.rows, data.index, data.columns);
}

void loads_and_stores(Data& data) {
#pragma omp simd
  for (int i = 0; i < lanes; ++i) data.out[i] = data.in[i] + 1;
}

}  // namespace floe::vector_costs
